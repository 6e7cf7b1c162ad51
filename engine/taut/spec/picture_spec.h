// Parts of a picture besides bodies: cameras, light, background, labels.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "taut/core/value.h"
#include "taut/spec/source.h"
#include "taut/view/frame_view.h"

namespace taut::world {

enum class Align { left, centre, right };

struct CameraKey {
    double t = 0.0;                     // [s]
    dvec3 eye{0.0}, target{0.0};        // [m]
    std::optional<double> fieldOfView;  // [rad]
    Ease ease = Ease::smooth;
};

struct CameraSpec {
    TAUT_VALUE(CameraSpec);
    std::string name;
    Source source;
    dvec3 eye{0.0, 1.5, 5.0}, target{0.0, 1.0, 0.0};  // [m]
    double fieldOfView = 0.66;                        // [rad] vertical
    std::vector<CameraKey> keys;
    std::optional<double> orbitPeriod;  // [s] one turn about the vertical through the target
    std::string follow;                 // bodies with whose middle it moves, e.g. "cloth.flag"; empty: none
    double followLag = 0.5;             // [s] by which it comes after
};

struct LightSpec {
    dvec3 direction{-0.5, -1.0, -0.4};  // the way the light travels
    dvec3 colour{1.0, 0.96, 0.9};
    double intensity = 2.9;  // factor on colour
    double softness = 0.03;  // [rad]
    dvec3 sky{0.70, 0.74, 0.80};
    dvec3 ground{0.50, 0.48, 0.45};
    double ambient = 1.1;  // factor on sky and ground: shade is 4 to 6 times darker than light, as by day
};

struct EnvironmentSpec {
    std::string image;      // path, resolved by the loader; empty: none
    double strength = 1.0;  // factor on its light
    double turn = 0.0;      // [rad] about y
    bool visible = true;
};

// A further light, as far away as the sun.
struct LampSpec {
    TAUT_VALUE(LampSpec);
    std::string name;
    Source source;
    dvec3 direction{0.5, -1.0, 0.4};  // the way the light travels
    dvec3 colour{1.0, 1.0, 1.0};
    double intensity = 1.0;  // factor on colour
    double softness = 0.03;  // [rad]
    bool shadow = true;      // whether things cast shadows in it
};
inline constexpr std::size_t mostLamps = view::mostLamps;

struct BackgroundSpec {
    dvec3 top{0.25, 0.32, 0.44};
    dvec3 horizon{0.60, 0.64, 0.70};
    double fadeStart = 8.0;       // [m]
    double fadeEnd = 30.0;        // [m]
    bool fadesWithCamera = true;  // if neither fade is given
};

// A line of text in the picture. It hangs above the body, unless a place is given. Once the body is frozen, a second
// line says so.
struct LabelSpec {
    TAUT_VALUE(LabelSpec);
    std::string name;
    Source source;
    std::optional<std::string> text;  // none: the method of the body
    std::optional<dvec3> at;          // [m] a place of the world
    std::optional<dvec2> screen;      // a place of the picture from its top left, as shares of width and height
    std::string of;                   // bodies, e.g. "cloth.*"; empty: none
    double size = 0.035;              // [picture heights]
    dvec3 colour{1.0, 1.0, 1.0};
    Align align = Align::centre;
    double plate = 0.0;              // darkness behind the text, 0 … 1
    std::optional<double> from, to;  // [s] it is shown from the first to just before the second; none: always

    bool isShown(double t) const { return t >= from.value_or(t) && (!to || t < *to); }
};

struct PictureSpec {
    ivec2 size{1280, 720};      // [px]
    std::string camera;         // name; empty: the first by name
    int samples = 4;            // samples per pixel: 1, 4, 8 or 16
    int shadowSize = 2048;      // [px] edge of the shadow map
    std::optional<int> smooth;  // in place of that of every finish
};

}  // namespace taut::world
