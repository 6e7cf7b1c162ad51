#include "taut/core/aligned_array.h"

#if defined(__linux__)
#include <sys/mman.h>
#endif

#include <cstdint>
#include <cstdlib>
#include <new>

namespace taut::core {
namespace {

std::size_t roundedUp(std::size_t bytes, std::size_t unit) {
    const std::size_t rounded = (bytes + unit - 1) / unit * unit;
    if (rounded < bytes) throw std::bad_alloc();
    return rounded;
}

#if defined(__linux__)
constexpr std::size_t largePage = std::size_t{1} << 21;  // [bytes] on x86-64

// Straight from the system: memory that the heap has used before keeps its small pages.
void* mapLarge(std::size_t bytes) {
    const std::size_t asked = roundedUp(bytes + largePage, largePage);
    void* mapped = ::mmap(nullptr, asked, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (mapped == MAP_FAILED) throw std::bad_alloc();
    // Cut off the parts before the first large page and after the last.
    char* begin = static_cast<char*>(mapped);
    const std::size_t past = reinterpret_cast<std::uintptr_t>(begin) % largePage;
    const std::size_t before = past == 0 ? 0 : largePage - past;
    if (before > 0) ::munmap(begin, before);
    const std::size_t after = asked - before - bytes;
    if (after > 0) ::munmap(begin + before + bytes, after);
    ::madvise(begin + before, bytes, MADV_HUGEPAGE);  // a wish: nothing is lost when it is not granted
    return begin + before;
}

void unmapLarge(void* data, std::size_t bytes) {
    ::munmap(data, bytes);
}
#else
constexpr std::size_t largePage = cacheLine;

void* mapLarge(std::size_t bytes) {
    void* data = std::aligned_alloc(cacheLine, bytes);
    if (data == nullptr) throw std::bad_alloc();
    return data;
}

void unmapLarge(void* data, std::size_t) {
    std::free(data);
}
#endif

}  // namespace

void* allocateAligned(std::size_t bytes) {
    if (bytes >= largePage) return mapLarge(roundedUp(bytes, largePage));
    void* data = std::aligned_alloc(cacheLine, roundedUp(bytes, cacheLine));
    if (data == nullptr) throw std::bad_alloc();
    return data;
}

void freeAligned(void* data, std::size_t bytes) {
    if (bytes >= largePage)
        unmapLarge(data, roundedUp(bytes, largePage));
    else
        std::free(data);
}

}  // namespace taut::core
