// The reference problems by name. A new one is a function here and a line in problems.cpp.
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

// The slides' own equations.
std::unique_ptr<Subject> makeGrowth();
std::unique_ptr<Subject> makeQuotient();

// One point mass.
std::unique_ptr<Subject> makeProjectile();
std::unique_ptr<Subject> makeUndamped();
std::unique_ptr<Subject> makeUnderdamped();
std::unique_ptr<Subject> makeCritical();
std::unique_ptr<Subject> makeOverdamped();
std::unique_ptr<Subject> makePendulum();

// Many.
std::unique_ptr<Subject> makeChain();
std::unique_ptr<Subject> makeNet();
std::unique_ptr<Subject> makeClothTop();
std::unique_ptr<Subject> makeClothCorners();
std::unique_ptr<Subject> makeClothEdge();

}  // namespace taut::study
