#include "taut/core/error.h"

#include <cstdio>
#include <cstdlib>

namespace taut::core {
namespace {

std::string oneBelowTheOther(const std::vector<Finding>& findings) {
    std::string all = printed(findings.at(0));
    for (std::size_t i = 1; i < findings.size(); ++i) all += "\n" + printed(findings[i]);
    return all;
}

}  // namespace

Error::Error(ErrorKind kind, std::vector<Finding> findings)
    : std::runtime_error(oneBelowTheOther(findings)), kind_(kind), findings_(std::move(findings)) {}

void failCheck(const char* condition, const char* file, int line) {
    std::fprintf(stderr, "taut: internal error: expected %s (%s:%d)\n", condition, file, line);
    std::abort();
}

}  // namespace taut::core
