#include "taut/core/private/parallel.h"

#include <cstddef>
#include <vector>

namespace taut::core {

void parallelFor(int count, const std::function<bool(int)>& inTurn, const std::function<void(int)>& task) {
    int first = 0;
    while (first < count && !inTurn(first)) ++first;
    if (first == count) return parallelFor(count, task);
    std::vector<int> ordered, others;
    for (int i = 0; i < count; ++i) (i >= first && inTurn(i) ? ordered : others).push_back(i);
    // First, for they may take longest.
    parallelFor(static_cast<int>(others.size()) + 1, [&](int i) {
        if (i > 0) return task(others[static_cast<std::size_t>(i) - 1]);
        for (int k : ordered) task(k);
    });
}

double processorSeconds() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace taut::core
