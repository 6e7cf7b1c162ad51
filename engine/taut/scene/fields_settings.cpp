// The field table, part one: settings of the whole scene.
#include "taut/fields/field_list.h"
#include "taut/fields/private/problems.h"
#include "taut/scene/private/sections.h"

namespace taut::scene {

using namespace world;

namespace {

constexpr Range seconds{1e-3, 1e6};
constexpr Range fieldOfView{1.0, 170.0};
constexpr Range lightSize{0.0, 45.0};  // [degrees]
constexpr auto inPicture = Affects::picture;

// Checks that one can look from one point to another with y up.
void checkView(const CheckInput& input, const Node& table, Place place, const dvec3& eye, const dvec3& target) {
    const Member* member = table.find("eye");
    const Place where = member != nullptr ? member->value.place : place;
    if (eye == target)
        input.problems.addError(where, "eye and target are the same point");
    else if (eye.x == target.x && eye.z == target.z)
        input.problems.addError(where, "the camera looks straight up or down", "move eye a little aside");
}

void checkCamera(const CheckInput& input, const CameraSpec& camera) {
    if (camera.orbitPeriod && *camera.orbitPeriod == 0.0)
        input.problems.addError(input.at("orbit_period_s"), "orbit_period_s must not be 0");
    if (camera.keys.empty()) checkView(input, input.table, input.place, camera.eye, camera.target);
    for (std::size_t i = 0; i < camera.keys.size(); ++i) {
        const Node& item = input.table.at("keys")->items[i];
        checkView(input, item, item.place, camera.keys[i].eye, camera.keys[i].target);
    }
}

}  // namespace

SceneSection fileSection() {
    SceneSection section;
    section.help = "Keys at the top of the file, before the first table.";
    section.enter = [](SceneSpec& scene, const std::string&, const Source&) -> void* { return &scene; };
    section.fields = FieldList<SceneSpec>().text("title", &SceneSpec::title, Role::none, "Title of the scene.").take();
    Field schema;
    schema.key = "schema";
    schema.kind = FieldKind::whole;
    schema.range = {1.0, 1.0};
    schema.required = true;
    schema.help = "Version of the format.";
    schema.write = [](void*, const Value&) {};
    schema.read = [](const void*) -> Value { return {}; };
    section.fields.insert(section.fields.begin(), schema);
    Field base = schema;
    base.key = "scene";
    base.kind = FieldKind::text;
    base.range = anyNumber;
    base.required = false;
    base.help =
        "Base scene, a file beside this one or a shipped scene, with \"shipped:NAME\" always the latter: tables are "
        "merged, all else is replaced.";
    section.fields.push_back(base);
    return section;
}

SceneSection needSection() {
    return sectionOf(
        "need", "Required accuracy of the scene.", &SceneSpec::need,
        FieldList<NeedSpec>()
            .number("rms_position_m", &NeedSpec::rmsPosition, "m", positive,
                    "Largest RMS error of positions, over points and time.")
            .number("rms_percent", &NeedSpec::rmsPercent, "%", Range{1e-9, 100.0},
                    "Largest RMS error as a share of the bounding box.")
            .number("rms_pixels", &NeedSpec::rmsPixels, "px", positive, "Largest RMS error in pixels of the picture.")
            .number("horizon_s", &NeedSpec::horizon, "s", seconds, "Time until which the error counts.")
            .number("budget_ms", &NeedSpec::budget, "ms", positive, "Largest processor time of a frame.")
            .take());
}

SceneSection solverSection() {
    return sectionOf(
        "solver", "Integration.", &SceneSpec::solver,
        FieldList<SolverSpec>()
            .choice("integrator", &SolverSpec::integrator, methodNames(), "Method of integration.")
            .role(Role::method)
            .stepLength("dt", &SolverSpec::dt, "Largest step; \"auto\" uses the stability limit.")
            .number("safety", &SolverSpec::safety, "", Range{0.01, 1.0},
                    "Share of the stability limit that \"auto\" uses.")
            .choice("precision", &SolverSpec::precision, {"single", "double"}, "Precision of the state.")
            .whole(
                "newton_steps", &SolverSpec::newtonSteps, "", Range{1, 100},
                "Largest number of Newton steps of a step of implicit Euler; 1 solves the linearised equations only.")
            .number("cg_tolerance", &SolverSpec::cgTolerance, "", Range{1e-12, 0.1},
                    "Residual over right-hand side at which a solve of implicit methods ends; at least 1e-6 in single "
                    "precision.")
            .whole("cg_iterations", &SolverSpec::cgIterations, "", Range{1, 1e6},
                   "Largest number of conjugate-gradient iterations of a solve of implicit methods.")
            .choice("on_divergence", &SolverSpec::onDivergence, {"stop", "freeze"},
                    "Whether a diverging body stops the run, or is frozen and marked in the picture.")
            .number("freeze_strain", &SolverSpec::freezeStrain, "", Range{0.01, 1e6},
                    "Strain of a spring that counts as diverged, with on_divergence = \"freeze\".")
            .number("sleep_error_m", &SolverSpec::sleepError, "m", Range{0.0, 1.0},
                    "Largest position error of sleeping bodies; 0: nothing sleeps.")
            .take());
}

SceneSection worldSection() {
    return sectionOf("world", "Surroundings.", &SceneSpec::world,
                     FieldList<WorldSpec>()
                         .vector("gravity", &WorldSpec::gravity, "m/s²", Range{-1e6, 1e6}, "Acceleration of gravity.")
                         .number("air_density_kg_per_m3", &WorldSpec::airDensity, "kg/m³", Range{0.0, 1e6},
                                 "Density of the air, for wind.")
                         .number("air_pressure_Pa", &WorldSpec::airPressure, "Pa", Range{0.0, 1e9},
                                 "Pressure of the air outside sealed fillings; 0: none.")
                         .allRamp(Affects::forces)
                         .take());
}

SceneSection contactSection() {
    return sectionOf("contact", "Contact between bodies with `touch`.", &SceneSpec::contact,
                     FieldList<ContactSpec>()
                         .number("friction", &ContactSpec::friction, "", Range{0.0, 100.0},
                                 "Coulomb's coefficient between two bodies, times the factors of the two bodies.")
                         .number("restitution", &ContactSpec::restitution, "", Range{0.0, 1.0},
                                 "Speed after a bounce over speed before, times the factors of the two bodies.")
                         .whole("detections", &ContactSpec::detections, "", Range{1, 1024},
                                "Smallest number of detections of contact pairs in a tick; default as speeds need.")
                         .take());
}

SceneSection runSection() {
    return sectionOf("run", "Length of the scene.", &SceneSpec::run,
                     FieldList<RunSpec>()
                         .number("fps", &RunSpec::fps, "1/s", Range{0.1, 1000.0}, "Pictures per second of scene time.")
                         .number("seconds", &RunSpec::seconds, "s", seconds, "Length of the run.")
                         .role(Role::time)
                         .text("start", &RunSpec::start, Role::state,
                               "File of a state of an earlier run of the same bodies (taut render --keep-state): the "
                               "run continues from it, at its time.")
                         .take());
}

SceneSection pictureSection() {
    return sectionOf(
        "picture", "Picture.", &SceneSpec::picture,
        FieldList<PictureSpec>()
            .vector("size", &PictureSpec::size, "px", Range{16, 16384}, "Width and height.")
            .text("camera", &PictureSpec::camera, Role::camera, "Name of the camera; default the first by name.")
            .whole("samples", &PictureSpec::samples, "", Range{1, 16},
                   "Anti-aliasing: samples per pixel; 8 and 16 draw a picture two and four times.")
            .oneOf({1, 4, 8, 16})
            .whole("shadow_size", &PictureSpec::shadowSize, "px", Range{128, 16384}, "Edge of the shadow map.")
            .multipleOf(128)
            .whole("smooth", &PictureSpec::smooth, "", Range{0.0, 3.0},
                   "Replaces finish.smooth of every cloth and rope.")
            .take());
}

SceneSection lightSection() {
    return sectionOf(
        "light", "The sun and the light of the sky.", &SceneSpec::light,
        FieldList<LightSpec>()
            .direction("direction", &LightSpec::direction, "Direction in which the light travels; any length.")
            .colour("colour", &LightSpec::colour, "Colour of the direct light.")
            .number("intensity", &LightSpec::intensity, "", Range{0.0, 1000.0}, "Strength of the direct light.")
            .degrees("softness_deg", &LightSpec::softness, lightSize,
                     "Apparent size of the sun: the width of a penumbra is 2 tan(size / 2) times the distance of the "
                     "object that casts it; 0: hard.")
            .colour("sky", &LightSpec::sky, "Ambient light from above.")
            .colour("ground", &LightSpec::ground, "Ambient light from below.")
            .number("ambient", &LightSpec::ambient, "", Range{0.0, 1000.0}, "Strength of the ambient light.")
            .allRamp(inPicture)
            .take());
}

SceneSection environmentSection() {
    return sectionOf(
        "environment", "A distant picture around the scene that replaces the light of sky and ground.",
        &SceneSpec::environment,
        FieldList<EnvironmentSpec>()
            .text("image", &EnvironmentSpec::image, Role::environment,
                  "Equirectangular Radiance HDR, PNG or JPEG, twice as wide as high; its middle lies at -z, its right "
                  "at +x.")
            .required()
            .number("strength", &EnvironmentSpec::strength, "", Range{0.0, 1000.0}, "Factor on its light.")
            .degrees("turn_deg", &EnvironmentSpec::turn, Range{-3600.0, 3600.0}, "Rotation about the vertical.")
            .flag("visible", &EnvironmentSpec::visible, "Whether it is visible in place of the background.")
            .allRamp(inPicture)
            .take());
}

SceneSection lampSection() {
    return sectionOf(
        "lamp", "A further distant light, e.g. to fill shadows or to draw an outline; at most two.", &SceneSpec::lamps,
        FieldList<LampSpec>()
            .direction("direction", &LampSpec::direction, "Direction in which the light travels; any length.")
            .colour("colour", &LampSpec::colour, "Colour.")
            .number("intensity", &LampSpec::intensity, "", Range{0.0, 1000.0}, "Strength.")
            .degrees("softness_deg", &LampSpec::softness, lightSize, "Apparent size, as that of the sun.")
            .flag("shadow", &LampSpec::shadow, "Whether it casts shadows, which cost as much as those of the sun.")
            .allRamp(inPicture)
            .take());
}

SceneSection backgroundSection() {
    SceneSection section = sectionOf(
        "background", "Background.", &SceneSpec::background,
        FieldList<BackgroundSpec>()
            .colour("top", &BackgroundSpec::top, "Colour at the top of the picture.")
            .colour("horizon", &BackgroundSpec::horizon, "Colour at the horizon.")
            .number("fade_start", &BackgroundSpec::fadeStart, "m", notNegative,
                    "Distance from the camera's target at which the ground begins to fade; by default larger for "
                    "distant cameras.")
            .number("fade_end", &BackgroundSpec::fadeEnd, "m", positive, "Distance at which the ground has faded.")
            .allRamp(inPicture)
            .take());
    section.check = [](const CheckInput& input, void* target) {
        auto& background = *static_cast<BackgroundSpec*>(target);
        background.fadesWithCamera =
            input.table.find("fade_start") == nullptr && input.table.find("fade_end") == nullptr;
        if (background.fadeEnd > background.fadeStart) return;
        const bool namesEnd = input.table.find("fade_end") != nullptr;
        input.problems.addError(input.at(namesEnd ? "fade_end" : "fade_start"), "fade_end must be above fade_start");
    };
    return section;
}

SceneSection cameraSection() {
    // A keyframe.
    Section key;
    key.fields =
        FieldList<CameraKey>()
            .number("t", &CameraKey::t, "s", Range{0.0, 1e6}, "Moment.")
            .required()
            .role(Role::time)
            .vector("eye", &CameraKey::eye, "m", Range{-1e6, 1e6}, "Position of the camera.")
            .required()
            .vector("target", &CameraKey::target, "m", Range{-1e6, 1e6}, "Point in the middle of the picture.")
            .required()
            .degrees("fov_deg", &CameraKey::fieldOfView, fieldOfView, "Field of view; default that of the camera.")
            .choice("ease", &CameraKey::ease, easeNames(), "Easing from the key before to this one.")
            .take();
    // The camera; with keys it has no place of its own.
    SceneSection section = sectionOf(
        "camera", "A camera.", &SceneSpec::cameras,
        FieldList<CameraSpec>()
            .vector("eye", &CameraSpec::eye, "m", Range{-1e6, 1e6}, "Position of the camera.")
            .ramps(inPicture)
            .only({"a still camera", "an orbiting camera"})
            .vector("target", &CameraSpec::target, "m", Range{-1e6, 1e6}, "Point in the middle of the picture.")
            .ramps(inPicture)
            .only({"a still camera", "an orbiting camera"})
            .degrees("fov_deg", &CameraSpec::fieldOfView, fieldOfView,
                     "Vertical field of view; pictures narrower than 16:9 keep the width of 16:9.")
            .ramps(inPicture)
            .number("orbit_period_s", &CameraSpec::orbitPeriod, "s", Range{-1e6, 1e6},
                    "Time of one turn about the vertical through the target.")
            .only({"an orbiting camera"})
            .text("follow", &CameraSpec::follow, Role::anyBodies,
                  "Bodies, e.g. \"cloth.flag\": the camera moves as the middle of their points does.")
            .number("follow_lag_s", &CameraSpec::followLag, "s", Range{0.0, 1e6},
                    "Time by which the camera comes after the followed body.")
            .tables("keys", &CameraSpec::keys, key, "Keyframes, in the order of time.")
            .only({"a camera with keys"})
            .take());
    section.variant = [](const Node& table) -> std::string {
        return table.find("keys") != nullptr             ? "a camera with keys"
               : table.find("orbit_period_s") != nullptr ? "an orbiting camera"
                                                         : "a still camera";
    };
    section.check = [](const CheckInput& input, void* target) {
        checkAscending(input);
        if (input.isClean) checkCamera(input, *static_cast<const CameraSpec*>(target));
    };
    return section;
}

}  // namespace taut::scene
