#include "taut/core/error.h"

#include <cstdio>
#include <cstdlib>

namespace taut::core {

void failCheck(const char* condition, const char* file, int line) {
    std::fprintf(stderr, "taut: internal error: expected %s (%s:%d)\n", condition, file, line);
    std::abort();
}

}  // namespace taut::core
