#include "taut/world/private/actions/rows.h"

#include "taut/fields/private/problems.h"

namespace taut::world {

void reportLack(const fields::CheckInput& input, const char* what, const char* remedy) {
    input.problems.addError(input.place, "do = \"" + input.variant + "\" needs " + what, remedy);
}

void needsTarget(const fields::CheckInput& input, const ActionSpec&) {
    if (input.isClean && input.table.find("target") == nullptr)
        reportLack(input, "target", "write target = \"KIND.NAME@SELECTOR\"");
}

void needsId(const fields::CheckInput& input, const ActionSpec&) {
    if (input.isClean && input.table.find("id") == nullptr) reportLack(input, "id", "id is the name of the hand");
}

}  // namespace taut::world
