#include "taut/check/figures.h"

#include <limits>

#include "taut/check/private/evaluation.h"
#include "taut/check/private/parser.h"
#include "taut/core/error.h"

namespace taut::check {

Figures Figures::parse(std::string_view text) {
    Figures figures;
    figures.expressions_ = std::make_shared<const std::vector<Expression>>(expressionsOf(text, figures.mentions_));
    for (const Expression& expression : *figures.expressions_) {
        const std::string name(text.substr(expression.begin, expression.end - expression.begin));
        if (!expression.isVector)
            figures.names_.push_back(name);
        else
            for (const char* axis : {".x", ".y", ".z"}) figures.names_.push_back(name + axis);
    }
    return figures;
}

std::vector<double> Figures::of(const world::World& world) {
    const Now now(world, selections_);
    std::vector<double> values;
    for (const Expression& expression : *expressions_) {
        glm::dvec3 value(std::numeric_limits<double>::quiet_NaN());
        try {
            value = valueOf(expression, now).x;
        } catch (const core::Error& error) {  // no points yet
            if (error.kind() != core::ErrorKind::badContent) throw;
        }
        for (int i = 0; i < (expression.isVector ? 3 : 1); ++i) values.push_back(value[i]);
    }
    return values;
}

}  // namespace taut::check
