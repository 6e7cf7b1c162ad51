#include "taut/check/private/parser.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "taut/check/private/function_table.h"
#include "taut/core/private/edit_distance.h"

namespace taut::check {

namespace {

constexpr std::size_t maxLength = 1000;
constexpr int maxDepth = 40;

bool isNameStart(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool isDigit(char c) {
    return c >= '0' && c <= '9';
}

std::string likelyFunction(const std::string& name) {
    std::string best;
    int bestDistance = name.size() < 5 ? 3 : 4;
    for (const Function& function : functionTable()) {
        const bool isStart = name.size() >= 3 && function.name.find(name) != std::string::npos;
        const int distance = isStart ? 1 : core::editDistance(name, function.name);
        if (distance < bestDistance) {
            best = function.name;
            bestDistance = distance;
        }
    }
    return best;
}

class Parser {
  public:
    Parser(std::string_view text, std::vector<Mention>& mentions) : text_(text), mentions_(mentions) {}

    Claim claim() {
        if (text_.size() > maxLength) fail(maxLength, "this claim is too long");
        refuseUnseen();
        Claim claim;
        claim.text = text_;
        skipBlanks();
        if (isAtEnd()) fail(0, "this claim is empty", "write e.g. max_strain(cloth.*) < 0.1");
        claim.terms.push_back(scalar(sum()));
        while (!isAtEnd()) {
            const std::size_t at = at_;
            const Relation& relation = this->relation();
            const bool isOneWay = claim.relations.empty() || claim.relations.back()->way * relation.way == 1;
            if (!isOneWay) fail(at, "a chain of comparisons must go one way, as in 0.1 < x < 0.2");
            claim.relations.push_back(&relation);
            claim.terms.push_back(scalar(sum()));
        }
        if (claim.relations.empty()) fail(at_, "a claim compares two things", "add e.g. < 0.1");
        if (std::none_of(claim.terms.begin(), claim.terms.end(), [](const Expression& e) { return e.isMeasured(); }))
            fail(claim.terms.front().begin, "this claim does not depend on the scene");
        return claim;
    }

    std::vector<Expression> expressions() {
        if (text_.size() > maxLength) fail(maxLength, "this is too long");
        refuseUnseen();
        skipBlanks();
        if (isAtEnd()) fail(0, "this is empty", "write e.g. max_strain(cloth.*)");
        std::vector<Expression> all;
        do all.push_back(sum());
        while (take(","));
        if (!isAtEnd()) fail(at_, fmt::format("{} stands where a comma or the end is expected", found()));
        return all;
    }

  private:
    [[noreturn]] static void fail(std::size_t at, const std::string& message, std::string remedy = {}) {
        throw ClaimError(at, message, std::move(remedy));
    }
    // A message that shows one would break off there.
    void refuseUnseen() const {
        const auto isUnseen = [](char c) { return (c >= '\0' && c < ' ' && c != '\t') || c == '\x7F'; };
        const auto found = std::find_if(text_.begin(), text_.end(), isUnseen);
        if (found == text_.end()) return;
        fail(static_cast<std::size_t>(found - text_.begin()), "there is a control character here",
             "write it on one line");
    }
    bool isAtEnd() const { return at_ >= text_.size(); }
    char next() const { return isAtEnd() ? '\0' : text_[at_]; }
    void skipBlanks() {
        while (next() == ' ' || next() == '\t') ++at_;
    }
    // Whether a sign comes next; steps over it and the blanks behind.
    bool take(std::string_view sign) {
        if (text_.substr(at_, sign.size()) != sign) return false;
        at_ += sign.size();
        skipBlanks();
        return true;
    }
    void expect(std::string_view sign, const std::string& why) {
        if (!take(sign)) fail(at_, fmt::format("\"{}\" is missing {}", sign, why));
    }
    // The text here, for messages.
    std::string found() const {
        if (isAtEnd()) return "the end";
        std::size_t end = at_ + 1;
        while (end < text_.size() && (static_cast<unsigned char>(text_[end]) & 0xC0U) == 0x80U) ++end;
        return fmt::format("\"{}\"", text_.substr(at_, end - at_));
    }

    const Relation& relation() {
        for (const Relation& relation : relations())
            if (take(relation.sign)) return relation;
        if (next() == '=') fail(at_, "a claim compares with ==, not =");
        fail(at_, fmt::format("{} stands where a comparison is expected", found()), "use < <= > >= == or !=");
    }

    static Expression scalar(Expression expression) {
        if (!expression.isVector) return expression;
        fail(expression.begin, "this has three components", "add .x, .y or .z, or take length(…)");
    }

    Expression joined(Part part, Expression left, Expression right, std::size_t at) {
        const bool isSum = part == Part::sum || part == Part::difference;
        if (isSum && left.isVector != right.isVector) fail(at, "a number and a vector cannot be added or subtracted");
        if (part == Part::product && left.isVector && right.isVector) fail(at, "two vectors cannot be multiplied");
        if (part == Part::quotient && right.isVector) fail(at, "nothing can be divided by a vector");
        Expression whole;
        whole.part = part;
        whole.begin = left.begin;
        whole.end = right.end;
        whole.isVector = left.isVector || right.isVector;
        whole.inside.push_back(std::move(left));
        whole.inside.push_back(std::move(right));
        return whole;
    }

    Expression sum() {
        return series(
            {{{"+", Part::sum}, {"-", Part::difference}}}, [&] { return product(); });
    }
    Expression product() {
        return series(
            {{{"*", Part::product}, {"/", Part::quotient}}}, [&] { return factor(); });
    }
    template <class Operand>
    Expression series(std::array<std::pair<const char*, Part>, 2> signs, const Operand& operand) {
        Expression left = operand();
        while (true) {
            const std::size_t at = at_;
            const auto sign = std::find_if(signs.begin(), signs.end(), [&](const auto& s) { return take(s.first); });
            if (sign == signs.end()) return left;
            left = joined(sign->second, std::move(left), operand(), at);
        }
    }

    Expression factor() {
        if (++depth_ > maxDepth) fail(at_, "this claim is nested too deeply");
        const std::size_t begin = at_;
        Expression expression;
        if (take("-")) {
            Expression inner = factor();
            expression.part = Part::negative;
            expression.isVector = inner.isVector;
            expression.inside.push_back(std::move(inner));
        } else {
            expression = withComponent(primary());
        }
        expression.begin = begin;
        expression.end = lastEnd();
        --depth_;
        return expression;
    }

    // The end of the text read so far, without trailing blanks.
    std::size_t lastEnd() const {
        std::size_t end = at_;
        while (end > 0 && (text_[end - 1] == ' ' || text_[end - 1] == '\t')) --end;
        return end;
    }

    Expression withComponent(Expression inner) {
        if (next() != '.') return inner;
        const std::size_t at = at_++;
        const std::size_t axis = std::string_view("xyz").find(next());
        const bool isAxis =
            !isAtEnd() && axis != std::string_view::npos && (at_ + 1 >= text_.size() || !isNameStart(text_[at_ + 1]));
        if (!isAxis) fail(at, "behind the point stands x, y or z");
        if (!inner.isVector) fail(at, "only a vector has components");
        ++at_;
        skipBlanks();
        Expression expression;
        expression.part = Part::component;
        expression.axis = static_cast<int>(axis);
        expression.inside.push_back(std::move(inner));
        return expression;
    }

    Expression primary() {
        const char c = next();
        if (isDigit(c) || c == '.') return number();
        if (take("(")) {
            Expression inner = sum();
            expect(")", "behind this");
            return inner;
        }
        if (c == '[') return vectorLiteral();
        if (isNameStart(c)) return call();
        fail(at_, fmt::format("{} stands where a number or a function is expected", found()));
    }

    Expression number() {
        Expression expression;
        const char* begin = text_.data() + at_;
        const auto [end, code] = std::from_chars(begin, text_.data() + text_.size(), expression.number);
        if (code != std::errc() || !std::isfinite(expression.number)) fail(at_, "this is not a number");
        at_ += static_cast<std::size_t>(end - begin);
        if (isNameStart(next()))
            fail(at_, "a number has no unit behind it", "values are in SI units, see taut schema --manual");
        skipBlanks();
        return expression;
    }

    Expression vectorLiteral() {
        expect("[", "here");
        Expression expression;
        expression.part = Part::vector;
        expression.isVector = true;
        for (int i = 0; i < 3; ++i) {
            if (i > 0) expect(",", "between the three components");
            expression.inside.push_back(scalar(sum()));
        }
        expect("]", "behind the three components");
        return expression;
    }

    Expression call() {
        const std::size_t begin = at_;
        while (isNameStart(next()) || isDigit(next())) ++at_;
        const std::string name(text_.substr(begin, at_ - begin));
        skipBlanks();
        const auto& table = functionTable();
        const auto found = std::find_if(table.begin(), table.end(), [&](const Function& f) { return f.name == name; });
        if (found == table.end()) {
            const std::string likely = likelyFunction(name);
            fail(begin, fmt::format("there is no function \"{}\"", name),
                 likely.empty() ? "see taut schema --manual" : fmt::format("did you mean \"{}\"?", likely));
        }
        Expression expression;
        expression.part = Part::call;
        expression.begin = begin;
        expression.function = &*found;
        expression.isVector = found->isVector;
        if (next() == '(' && found->takes.empty()) {
            take("(");
            if (!take(")")) fail(begin, fmt::format("{} takes nothing", name), "write " + name);
        } else if (next() == '(') {
            readArguments(expression, begin);
        } else if (!found->mayBeBare && !found->takes.empty()) {
            fail(begin, fmt::format("{} needs its arguments", name), "write " + found->signature());
        }
        return expression;
    }

    void readArguments(Expression& expression, std::size_t begin) {
        const Function& function = *expression.function;
        take("(");
        if (function.mayBeBare && take(")")) return;
        for (std::size_t i = 0; i < function.takes.size(); ++i) {
            if (next() == ')' || isAtEnd()) wrongCount(function, begin);
            if (i > 0 && !take(","))
                fail(at_, fmt::format("\",\" is missing before the next argument, not {}", found()));
            expression.inside.push_back(argument(function, function.takes[i]));
            if (i == 1 && function.isBetween()) mentions_.back().against = expression.inside[0].target;
        }
        if (next() == ',') wrongCount(function, begin);
        expect(")", "behind the arguments of " + function.name);
    }

    [[noreturn]] static void wrongCount(const Function& function, std::size_t begin) {
        const std::size_t count = function.takes.size();
        fail(begin, fmt::format("{} takes {} argument{}", function.name, count, count == 1 ? "" : "s"),
             "write " + function.signature());
    }

    Expression argument(const Function& function, Takes takes) {
        if (takes == Takes::number) return scalar(sum());
        if (takes == Takes::axis) return axis(function);
        if (takes == Takes::vector || (takes == Takes::place && next() == '[')) {
            const std::size_t at = at_;
            Expression expression = sum();
            if (!expression.isVector) fail(at, fmt::format("{} takes a vector", function.name));
            return expression;
        }
        return target(function, takes);
    }

    Expression axis(const Function& function) {
        const std::size_t begin = at_, letter = std::string_view("xyz").find(next());
        if (isAtEnd() || letter == std::string_view::npos || (++at_, isNameStart(next()) || isDigit(next())))
            fail(begin, "an axis is x, y or z", "write " + function.signature());
        skipBlanks();
        Expression expression;
        expression.axis = static_cast<int>(letter);
        return expression;
    }

    // Up to the comma or the bracket that ends the argument; a selector such as @(0.5,1) has its own.
    Expression target(const Function& function, Takes takes) {
        const std::size_t begin = at_;
        for (int open = 0; !isAtEnd() && (open > 0 || (next() != ',' && next() != ')')); ++at_)
            open += next() == '(' ? 1 : next() == ')' ? -1 : 0;
        Expression expression;
        expression.part = Part::target;
        expression.begin = begin;
        expression.end = lastEnd();
        const bool isJoint = takes == Takes::joint;
        if (expression.end <= begin)
            fail(begin, isJoint ? "the name of a joint is missing" : "a target is missing",
                 isJoint ? "write " + function.signature() : "write KIND.NAME, e.g. cloth.flag");
        expression.target = text_.substr(begin, expression.end - begin);
        if (isJoint) {
            mentions_.push_back({.at = begin, .target = expression.target, .isJoint = true, .against = {}});
            return expression;
        }
        if (expression.target.find('.') == std::string::npos)
            fail(begin, fmt::format("\"{}\" is no target", expression.target), "write KIND.NAME, e.g. cloth.flag");
        const bool hasPoints = takes != Takes::bodies;
        mentions_.push_back({begin, expression.target, hasPoints, hasPoints || function.isBetween(), false, {}});
        return expression;
    }

    std::string_view text_;
    std::vector<Mention>& mentions_;
    std::size_t at_ = 0;
    int depth_ = 0;
};

}  // namespace

Claim claimOf(std::string_view text, std::vector<Mention>& mentions) {
    return Parser(text, mentions).claim();
}

std::vector<Expression> expressionsOf(std::string_view text, std::vector<Mention>& mentions) {
    return Parser(text, mentions).expressions();
}

}  // namespace taut::check
