#include "taut/pipeline/machine.h"

#include <fmt/format.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <fstream>
#include <thread>

#include "taut/core/private/instruction_set.h"

namespace taut::pipeline {
namespace {

std::string compilerName() {
#if defined(__clang__)
    return fmt::format("clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#else
    return fmt::format("g++ {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#endif
}

std::string processorName() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name")) return line.substr(std::min(line.find(':') + 2, line.size()));
    return "unknown";
}

}  // namespace

Machine machine() {
    utsname name{};
    ::uname(&name);
    return {
        .program = "taut " TAUT_VERSION,
        .compiler = fmt::format("{}, {}", compilerName(), TAUT_BUILD_TYPE),
        .processor = processorName(),
        .system = fmt::format("{} {} {}", name.sysname, name.release, name.machine),
        .simd = std::string(core::nameOf(core::instructionSet())),
        .simdReason = core::instructionSetReason(),
        .threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency())),
        .memory = static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGE_SIZE)),
    };
}

}  // namespace taut::pipeline
