// Columns of numbers that expressions of the language of checks give, such as "position(net.p@bob).x, speed(cloth.*)".
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "taut/check/check.h"

namespace taut::check {

struct Expression;

class Figures {
  public:
    // Expressions with commas between them. Throws ClaimError.
    static Figures parse(std::string_view text);

    // In the order of the text.
    const std::vector<Mention>& mentions() const { return mentions_; }
    // (columns) the expressions; one of three components has a column for each, "….x".
    const std::vector<std::string>& names() const { return names_; }

    // (columns) at a published tick; not a number while a target of an expression is missing.
    std::vector<double> of(const world::World& world);

  private:
    std::shared_ptr<const std::vector<Expression>> expressions_;
    std::vector<Mention> mentions_;
    std::vector<std::string> names_;
    Selections selections_;
};

}  // namespace taut::check
