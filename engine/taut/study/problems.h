// The reference problems by name. A new one is a line in problems.cpp and its function.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "taut/study/subject.h"

namespace taut::study {

struct ProblemInfo {
    std::string_view name;
    std::string_view about;  // one line
    std::unique_ptr<Subject> (*make)();
};

std::span<const ProblemInfo> problems();

// nullptr when there is none of that name.
const ProblemInfo* findProblem(std::string_view name);

// The subject of one of them.
std::unique_ptr<Subject> makeProblem(std::string_view name);

}  // namespace taut::study
