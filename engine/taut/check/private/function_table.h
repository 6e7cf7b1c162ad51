// The functions that a claim may call: one row each. To add one, write a row and the function that it names.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "taut/check/private/evaluation.h"
#include "taut/island/metric_table.h"

namespace taut::check {

enum class Takes {
    bodies,  // KIND.NAME
    points,  // KIND.NAME@SELECTOR
    place,   // points, which stand for their centre of mass, or [x, y, z]
    number,
    vector,
    joint,  // the name of joints
    axis,   // x, y or z
};

struct Function {
    std::string name;
    std::vector<Takes> takes;
    bool mayBeBare = false;  // without arguments it is about everything
    bool isVector = false;
    std::string unit;  // "m"; empty: a plain number
    std::string help;
    std::function<Quantity(const Now& now, std::span<const Expression> arguments)> value;
    std::function<std::string(const Now& now, std::span<const Expression> arguments)> place;  // empty: nowhere

    world::Counts counts = world::Counts::everyBody;

    bool isBetween() const { return takes == std::vector{Takes::bodies, Takes::bodies}; }
    std::string signature() const;  // "distance(POINTS or [x, y, z], POINTS or [x, y, z])"
};

const std::vector<Function>& functionTable();

// The rows by topic.
std::vector<Function> pointFunctions();
std::vector<Function> bodyFunctions();
std::vector<Function> gapFunctions();
std::vector<Function> jointFunctions();
std::vector<Function> numberFunctions();

}  // namespace taut::check
