#include "ode/method_table.h"

#include <array>

#include "core/error.h"

namespace taut::ode {
namespace {

constexpr std::array table{
    MethodInfo{"euler", "explicit Euler", 1, 1, 2, false, false,
               "motion that no dashpot damps, such as swinging, grows at every step", explicitEulerLargestStep},
    MethodInfo{"leapfrog", "leap-frog", 2, 1, 1, true, true, "", leapfrogLargestStep},
    MethodInfo{"velocity-verlet", "velocity Verlet", 2, 1, 3, true, true, "", leapfrogLargestStep},
};

template <class Real>
using Maker = std::unique_ptr<Method<Real>> (*)();

template <class Real>
constexpr std::array<Maker<Real>, table.size()> makers{
    makeExplicitEuler<Real>,
    makeLeapfrog<Real>,
    makeVelocityVerlet<Real>,
};

}  // namespace

std::span<const MethodInfo> methods() { return table; }

const MethodInfo* findMethod(std::string_view name) {
    for (const MethodInfo& info : table)
        if (info.name == name) return &info;
    return nullptr;
}

template <class Real>
std::unique_ptr<Method<Real>> makeMethod(std::string_view name) {
    const MethodInfo* info = findMethod(name);
    TAUT_EXPECTS(info != nullptr);
    return makers<Real>[static_cast<std::size_t>(info - table.data())]();
}

template std::unique_ptr<Method<float>> makeMethod(std::string_view);
template std::unique_ptr<Method<double>> makeMethod(std::string_view);

}  // namespace taut::ode
