#include "taut/check/check.h"

#include "fuzz/support.h"
#include "taut/check/private/evaluation.h"
#include "taut/world/world.h"

// A claim, read and then held against a small world.
void taut::fuzz::readCheck(View bytes) {
    const world::World world(scene::loadSceneText(smallScene, "fuzz.toml", alone()).spec, {.threads = 1});
    try {
        const auto claim = check::Check::parse(textOf(bytes));
        check::Selections selections;
        const check::Now now(world, selections);
        claim.evaluate(now);
        (void)claim.where(now);
    } catch (const check::ClaimError& fault) {
        TAUT_EXPECTS(fault.at <= bytes.size());
    }
}
