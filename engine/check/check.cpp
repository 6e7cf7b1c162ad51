#include "taut/check/check.h"

#include <algorithm>
#include <cmath>

#include "taut/check/evaluation.h"
#include "taut/check/parser.h"

namespace taut::check {

namespace {

const char* sign(Relation relation, bool isFlipped) {
    switch (relation) {
        case Relation::less:
            return isFlipped ? ">" : "<";
        case Relation::lessOrEqual:
            return isFlipped ? ">=" : "<=";
        case Relation::greater:
            return isFlipped ? "<" : ">";
        case Relation::greaterOrEqual:
            return isFlipped ? "<=" : ">=";
        case Relation::equal:
            return "==";
        case Relation::unequal:
            return "!=";
    }
    return "";
}

bool holds(double a, Relation relation, double b) {
    switch (relation) {
        case Relation::less:
            return a < b;
        case Relation::lessOrEqual:
            return a <= b;
        case Relation::greater:
            return a > b;
        case Relation::greaterOrEqual:
            return a >= b;
        case Relation::equal:
            return a == b;
        case Relation::unequal:
            return a != b && !std::isnan(a) && !std::isnan(b);
    }
    return false;
}

double margin(double a, Relation relation, double b) {
    switch (relation) {
        case Relation::less:
        case Relation::lessOrEqual:
            return b - a;
        case Relation::greater:
        case Relation::greaterOrEqual:
            return a - b;
        case Relation::equal:
            return -std::abs(a - b);
        case Relation::unequal:
            return std::abs(a - b);
    }
    return 0;
}

// One comparison of a claim: the side that is measured is the value, of two the left one.
struct Compared {
    Outcome outcome;
    const Expression* subject = nullptr;
};

Compared compared(const Claim& claim, std::size_t i, double left, double right) {
    const bool isFlipped = !claim.terms[i].isMeasured() && claim.terms[i + 1].isMeasured();
    const Expression& subject = claim.terms[isFlipped ? i + 1 : i];
    Compared result;
    result.subject = &subject;
    result.outcome.holds = holds(left, claim.relations[i], right);
    result.outcome.value = isFlipped ? right : left;
    result.outcome.bound = isFlipped ? left : right;
    result.outcome.relation = sign(claim.relations[i], isFlipped);
    result.outcome.margin = margin(left, claim.relations[i], right);
    result.outcome.unit = unitOf(subject);
    result.outcome.subject = claim.text.substr(subject.begin, subject.end - subject.begin);
    return result;
}

// The comparison that fails by most, or is nearest to it; one with what is no number comes first.
Compared worst(const Claim& claim, const Now& now) {
    Compared worst;
    double left = valueOf(claim.terms[0], now).x.x;
    for (std::size_t i = 0; i < claim.relations.size(); ++i) {
        const double right = valueOf(claim.terms[i + 1], now).x.x;
        Compared next = compared(claim, i, left, right);
        left = right;
        const bool isWorse = i == 0 || (worst.outcome.holds && !next.outcome.holds) ||
                             (worst.outcome.holds == next.outcome.holds &&
                              !(next.outcome.margin >= worst.outcome.margin) && !std::isnan(worst.outcome.margin));
        if (isWorse) worst = std::move(next);
    }
    return worst;
}

}  // namespace

Check Check::parse(std::string_view text) {
    Check check;
    check.claim_ = std::make_shared<const Claim>(claimOf(text, check.mentions_));
    return check;
}

const std::vector<Mention>& Check::mentions() const {
    return mentions_;
}

Outcome Check::evaluate(const world::World& world) const {
    return evaluate(Now(world));
}

Outcome Check::evaluate(const Now& now) const {
    return worst(*claim_, now).outcome;
}

std::string Check::where(const Now& now) const {
    return placeOf(*worst(*claim_, now).subject, now);
}

}  // namespace taut::check
