#include "taut/study/one_method.h"
#include "taut/spec/spec.h"

namespace taut::study {

world::SceneSpec byMethod(const world::SceneSpec& spec, std::string_view method, world::Precision precision,
                          double shift) {
    world::SceneSpec scene = spec;
    scene.solver.integrator = method;
    scene.solver.precision = precision;
    scene.solver.onDivergence = world::OnDivergence::stop;
    scene.solver.sleepError = 0.0;
    scene.solver.dt.reset();
    for (world::BodySpec& body : scene.bodies) {
        body.solver = {};
        body.jitter += shift;  // moves points by the shift times a number between -1 and 1
    }
    return scene;
}

}  // namespace taut::study
