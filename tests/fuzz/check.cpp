#include "fuzz.h"
#include "taut/check/check.h"
#include "taut/check/evaluation.h"
#include "taut/scene/load.h"

// A claim, read and then held against a small world.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const taut::world::World world(taut::scene::loadSceneText(taut::fuzz::smallScene, "fuzz.toml", {}).spec,
                                          {.threads = 1});
    return taut::fuzz::read([&] {
        try {
            const auto check = taut::check::Check::parse(taut::fuzz::textOf(data, size));
            taut::check::Selections selections;
            const taut::check::Now now(world, selections);
            check.evaluate(now);
            (void)check.where(now);
        } catch (const taut::check::Fault& fault) {
            if (fault.at > size) std::abort();
        }
    });
}
