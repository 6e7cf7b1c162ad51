#include "fuzz.h"
#include "taut/scene/obj_file.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return taut::fuzz::read([&] { taut::scene::objMeshText(taut::fuzz::textOf(data, size), "fuzz.obj"); });
}
