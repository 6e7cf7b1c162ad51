// Rows and checks that several kinds of action share.
#pragma once

#include "taut/spec/actions.h"
#include "taut/spec/common_rows.h"

namespace taut::world {

// Reports a missing key of an action where no single field is at fault.
void reportLack(const fields::CheckInput& input, const char* what, const char* remedy);
// Reports an action that names no target or no hand.
void needsTarget(const fields::CheckInput& input, const ActionSpec& action);
void needsId(const fields::CheckInput& input, const ActionSpec& action);

inline constexpr const char* endHelp = "Where the hand or the collider goes [m]; the value that a ramp ends at.";

inline constexpr const char* holdOnHelp =
    "The collider that carries the held points, e.g. \"collider.pole\": they go and turn with it. Without it they stay "
    "where they are.";

template <class Own>
fields::FieldList<Own> withId(fields::FieldList<Own> rows = {}) {
    return rows.text("id", &Own::id, fields::Role::none, "Name of the hand.");
}

template <class Own>
fields::FieldList<Own> withTarget(fields::FieldList<Own> rows = {}) {
    return rows.text("target", &Own::target, fields::Role::none,
                     "The points: KIND.NAME@SELECTOR, all if @SELECTOR is left out; of cut and spawn bodies, of move "
                     "collider.NAME.");
}

// Rows of an action on points.
template <class Own>
fields::FieldList<Own> withPoints(fields::FieldList<Own> rows = {}) {
    return withTarget(std::move(rows))
        .vector("near", &Own::near, "m", placeRange,
                "Of the target only the point that is nearest to this place when it happens.");
}

// Rows of an action that goes from one value to another.
template <class Own>
fields::FieldList<Own> withWay(fields::FieldList<Own> rows) {
    return rows.number("over_s", &Own::over, "s", momentRange, "How long it takes; 0 means at once.")
        .choice("ease", &Own::ease, easeNames(), "How it gets there.");
}

}  // namespace taut::world
