#include "core/aligned_array.h"

#include <sys/mman.h>

#include <new>

namespace taut::core {
namespace {

constexpr std::size_t largePage = std::size_t{1} << 21;  // [bytes] on x86-64

}  // namespace

void* allocateAligned(std::size_t bytes) {
    const bool isLarge = bytes >= largePage;
    const std::size_t alignment = isLarge ? largePage : cacheLine;
    const std::size_t rounded = (bytes + alignment - 1) / alignment * alignment;
    if (rounded < bytes) throw std::bad_alloc();
    void* data = std::aligned_alloc(alignment, rounded);
    if (data == nullptr) throw std::bad_alloc();
    if (isLarge) ::madvise(data, rounded, MADV_HUGEPAGE);  // a wish: nothing is lost when it is not granted
    return data;
}

}  // namespace taut::core
