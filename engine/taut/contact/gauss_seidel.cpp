#include "taut/contact/gauss_seidel.h"

#include <algorithm>
#include <vector>

#include "taut/core/private/instruction_set.h"

namespace taut::contact {

int projectedGaussSeidel(std::span<Row> rows, int sweeps, double tolerance, std::span<Four> velocities) {
    thread_local std::vector<Four> scratch;
    scratch.resize(std::max(scratch.size(), 2 * rows.size()));
    const Sweeps batch{rows.data(),    static_cast<int>(rows.size()),  velocities.data(),
                       scratch.data(), scratch.data() + rows.size(), sweeps, tolerance};
    switch (core::instructionSet()) {
        case core::InstructionSet::avx512: return avx512::sweep(batch);
        case core::InstructionSet::avx2: return avx2::sweep(batch);
        case core::InstructionSet::sse2: break;
    }
    return sse2::sweep(batch);
}

}  // namespace taut::contact
