#include "taut/check/check.h"

#include <algorithm>
#include <cmath>

#include "taut/check/private/evaluation.h"
#include "taut/check/private/parser.h"

namespace taut::check {

namespace {

double upTo(double a, double b) {
    return b - a;
}
double downTo(double a, double b) {
    return a - b;
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
    const Relation& relation = *claim.relations[i];
    result.outcome.holds = relation.holds(left, right);
    result.outcome.value = isFlipped ? right : left;
    result.outcome.bound = isFlipped ? left : right;
    result.outcome.relation = isFlipped ? relation.flipped : relation.sign;
    result.outcome.margin = relation.margin(left, right);
    result.outcome.unit = unitOf(subject);
    result.outcome.subject = claim.text.substr(subject.begin, subject.end - subject.begin);
    return result;
}

// The comparison that fails by most, or is nearest to it; one with NaN comes first.
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

void addCalls(const Expression& expression, std::span<const Mention> mentions, std::vector<Call>& calls) {
    if (expression.part == Part::call) {
        Call call{expression.begin, expression.function, {}};
        for (const Expression& inner : expression.inside)
            for (const Mention& mention : mentions)
                if (inner.part == Part::target && mention.at == inner.begin) call.targets.push_back(mention);
        calls.push_back(std::move(call));
    }
    for (const Expression& inner : expression.inside) addCalls(inner, mentions, calls);
}

}  // namespace

std::span<const Relation> relations() {
    static constexpr Relation all[] = {
        {"<=", ">=", 1, [](double a, double b) { return a <= b; }, upTo},
        {"<", ">", 1, [](double a, double b) { return a < b; }, upTo},
        {">=", "<=", -1, [](double a, double b) { return a >= b; }, downTo},
        {">", "<", -1, [](double a, double b) { return a > b; }, downTo},
        {"==", "==", 0, [](double a, double b) { return a == b; }, [](double a, double b) { return -std::abs(a - b); }},
        {"!=", "!=", 0, [](double a, double b) { return a < b || a > b; },
         [](double a, double b) { return std::abs(a - b); }},
    };
    return all;
}

Check Check::parse(std::string_view text) {
    Check check;
    check.claim_ = std::make_shared<const Claim>(claimOf(text, check.mentions_));
    return check;
}

const std::vector<Mention>& Check::mentions() const {
    return mentions_;
}

std::vector<Call> Check::calls() const {
    std::vector<Call> calls;
    for (const Expression& term : claim_->terms) addCalls(term, mentions_, calls);
    return calls;
}

Outcome Check::evaluate(const world::World& world) const {
    Selections selections;
    return evaluate(Now(world, selections));
}

Outcome Check::evaluate(const Now& now) const {
    return worst(*claim_, now).outcome;
}

std::string Check::where(const Now& now) const {
    return placeOf(*worst(*claim_, now).subject, now);
}

}  // namespace taut::check
