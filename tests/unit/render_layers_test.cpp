// The layers of pictures besides colours: alpha, depth, a mask. Expected numbers follow from the geometry, or from
// pictures that have none of it.
#include <gtest/gtest.h>

#include <set>

#include "render_support.h"
#include "taut/render/private/depth_layer.h"
#include "taut/render/private/flow_layer.h"
#include "taut/render/private/mask_layer.h"
#include "taut/render/private/surface_layers.h"
#include "taut/view/camera_axes.h"

namespace taut::render::test {
namespace {

int depthAt(const image::Image& picture, int x, int y) {
    return picture.layer("depth")->numbers[y * picture.width + x];
}

// A box of a metre in front of the camera, nothing else.
view::FrameView boxView() {
    view::FrameView view;
    view.camera.eye = {0.0F, 0.0F, 5.0F};
    view.camera.target = {0.0F, 0.0F, 0.0F};
    view.surfaces.push_back(surface(view::boxMesh(glm::vec3(0.5F), 0.0F), glm::vec3(0.0F), glm::vec3(0.5F)));
    view.surfaces.back().name = "box";
    return view;
}

TEST(RenderLayers, DepthIsTheDistanceAlongTheAxisToWithinAStep) {
    RendererOptions options = smallOptions();
    options.layers = {depthLayer(1e-3)};
    for (const int samples : {1, 4}) {
        options.samples = samples;
        view::FrameView view = boxView();
        view.camera.eye.z = 7.2506F;
        const image::Image picture = pictureOf(view, options);
        // The box's face is at z = 0.5, all of it as far along the axis. It covers 1 m of 6.7506 m · 2 tan(0.35): 36
        // pixels of 180.
        for (const int x : {144, 160, 175})
            for (const int y : {74, 90, 106}) EXPECT_NEAR(depthAt(picture, x, y), 6750.6, 0.51) << x << " " << y;
        EXPECT_EQ(depthAt(picture, 20, 20), image::farDepth);
    }
}

TEST(RenderLayers, DepthOfTheGroundIsThatOfThePlane) {
    RendererOptions options = smallOptions();
    options.layers = {depthLayer(1e-3)};
    const view::FrameView view = floorView();
    const image::Image picture = pictureOf(view, options);
    // Eye (0, 3, 5), axis to the origin: sine and cosine of its slope are 3/√34, 5/√34. A ray through the middle of row
    // y rises by t against it, and meets the plane where 3 = ahead (3 - 5 t) / √34.
    const double pixel = 2.0 * std::tan(0.35) / 180.0;
    for (const int y : {60, 90, 150}) {
        const double t = pixel * (89.5 - y);
        const double ahead = 3.0 * std::sqrt(34.0) / (3.0 - 5.0 * t);
        for (const int x : {100, 160, 200}) EXPECT_NEAR(depthAt(picture, x, y), 1000.0 * ahead, 0.51) << x << " " << y;
    }
}

TEST(RenderLayers, DepthBeyondItsRangeIsItsEnd) {
    RendererOptions options = smallOptions();
    options.layers = {depthLayer(1e-5)};  // 0.65534 m
    const image::Image picture = pictureOf(boxView(), options);
    EXPECT_EQ(depthAt(picture, 160, 90), image::farDepth - 1);
    EXPECT_EQ(depthAt(picture, 0, 0), image::farDepth);
}

TEST(RenderLayers, TheMaskHasTheColoursOfWhatIsSeenAndNoOthers) {
    view::FrameView view = floorView();
    const auto add = [&](const char* name, float size, glm::vec3 at) {
        view.surfaces.push_back(surface(view::sphereMesh(size), at, glm::vec3(0.5F)));
        view.surfaces.back().name = name;
    };
    add("large", 0.6F, {0.0F, 0.6F, 0.0F});
    add("beside", 0.3F, {1.2F, 0.3F, 0.0F});
    add("hidden", 0.1F, {0.0F, 0.4F, -1.0F});
    add("buried", 0.3F, {-1.2F, -0.5F, 0.0F});
    add("nameless", 0.2F, {-0.5F, 0.2F, 1.0F});
    RendererOptions options = smallOptions();
    options.layers = {
        maskLayer({{"large", 0x800000U}, {"beside", 0x0080c0U}, {"hidden", 0x00ff00U}, {"buried", 0x0000ffU}})};
    const image::Image picture = pictureOf(view, options);
    std::set<std::uint32_t> seen;
    const std::vector<std::uint8_t>& mask = picture.layer("mask")->rgb;
    for (std::size_t i = 0; i < mask.size(); i += 3)
        seen.insert(static_cast<std::uint32_t>(mask[i]) << 16 | static_cast<std::uint32_t>(mask[i + 1]) << 8 |
                    mask[i + 2]);
    EXPECT_EQ(seen, (std::set<std::uint32_t>{0, 0x800000U, 0x0080c0U}));
}

// The three numbers of a layer in a pixel.
std::array<int, 3> numbersAt(const image::Image& picture, const char* layer, int x, int y) {
    const auto* first = &picture.layer(layer)->numbers[3 * static_cast<std::size_t>(y * picture.width + x)];
    return {first[0], first[1], first[2]};
}

TEST(RenderLayers, NormalsAreThoseOfTheSideThatIsSeen) {
    RendererOptions options = smallOptions();
    options.layers = {normalsLayer()};
    view::FrameView view = boxView();
    view.surfaces[0].transform = glm::rotate(glm::mat4(1.0F), 0.25F * 3.14159265F, {0.0F, 1.0F, 0.0F});
    const image::Image picture = pictureOf(view, options);
    // (∓√½, 0, √½) left and right of the edge: 32767.5 (1 ± 0.70711), to a step of the kept normals, 2 of 65535.
    const auto expectNear = [](const std::array<int, 3>& pixel, const std::array<double, 3>& expected) {
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(pixel[c], expected[c], 3.0) << c;
    };
    expectNear(numbersAt(picture, "normals", 140, 90), {9597.4, 32767.5, 55937.6});
    expectNear(numbersAt(picture, "normals", 180, 90), {55937.6, 32767.5, 55937.6});
    EXPECT_EQ(numbersAt(picture, "normals", 5, 5), (std::array<int, 3>{}));
}

TEST(RenderLayers, AlbedoIsTheColourOfEachSideInAnyLight) {
    RendererOptions options = smallOptions();
    options.layers = {albedoLayer()};
    view::FrameView view = boxView();
    view::Finish finish = *view.surfaces[0].finish;
    finish.front = {0.5F, 0.2F, 0.02F};
    view.surfaces[0].finish = std::make_shared<const view::Finish>(finish);
    for (const glm::vec3 way : {glm::vec3(0.0F, -1.0F, -1.0F), glm::vec3(0.0F, 1.0F, 1.0F)}) {
        view.light.direction = way;
        const image::Image picture = pictureOf(view, options);
        // 16 bits of the root of the colour: 1e-5 of it.
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(numbersAt(picture, "albedo", 160, 90)[c], 257.0F * srgb(finish.front[static_cast<int>(c)]),
                        8.0F);
        EXPECT_EQ(numbersAt(picture, "albedo", 5, 5), (std::array<int, 3>{}));
    }
}

// Where a place is seen [px], from the top left.
glm::dvec2 seenAt(const view::Camera& camera, glm::vec3 place) {
    const glm::dvec4 clip = glm::dmat4(projectionOf(camera, 320.0F / 180.0F)) * glm::dvec4(place, 1.0);
    return glm::dvec2(320.0, 180.0) * (0.5 + glm::dvec2(0.5, -0.5) * glm::dvec2(clip) / clip.w);
}

// From the eye through the middle of a pixel, 1 m ahead.
glm::dvec3 wayThrough(const view::Camera& camera, int x, int y) {
    const view::CameraAxes axes = axesOf(camera);
    const double pixel = 2.0 * std::tan(0.5 * static_cast<double>(camera.fieldOfView)) / 180.0;
    return glm::dvec3(axes.forward) + pixel * ((x - 159.5) * glm::dvec3(axes.right) - (y - 89.5) * glm::dvec3(axes.up));
}

void expectFlow(const image::Image& picture, int x, int y, glm::dvec2 way) {
    const std::array<int, 3> numbers = numbersAt(picture, "flow", x, y);
    EXPECT_NEAR((numbers[0] - 32768) / 64.0, way.x, 0.6 / 64.0) << x << " " << y;  // rounding to a step
    EXPECT_NEAR((numbers[1] - 32768) / 64.0, way.y, 0.6 / 64.0) << x << " " << y;
    EXPECT_EQ(numbers[2], 1) << x << " " << y;
}

RendererOptions flowOptions() {
    RendererOptions options = smallOptions();
    options.layers = {flowLayer()};
    return options;
}

// A triangle whose corners all move in their own way, seen by a camera that moves: the place in a pixel's middle, by
// its ray and the plane, keeps its barycentric coordinates.
TEST(RenderLayers, FlowIsTheDifferenceOfWhereAPlaceIsSeenNowAndNext) {
    const std::array<glm::vec3, 3> now{glm::vec3(-1.5F, -1.0F, 0.3F), {1.6F, -0.8F, -0.5F}, {0.1F, 1.2F, 0.2F}};
    const std::array<glm::vec3, 3> then{glm::vec3(-1.2F, -1.1F, 0.9F), {1.5F, -0.2F, -0.4F}, {-0.3F, 1.3F, -0.6F}};
    view::FrameView view, next;
    view.camera.eye = {0.3F, 0.2F, 5.0F};
    view.camera.target = {0.0F, 0.0F, 0.0F};
    next.camera = view.camera;
    next.camera.eye = {0.6F, 0.1F, 4.7F};
    next.camera.fieldOfView = 0.68F;
    view::Mesh mesh;
    mesh.topology =
        std::make_shared<const view::Topology>(view::Topology{{0, 1, 2}, std::vector<glm::vec2>(3, glm::vec2(0.0F))});
    for (auto& [frame, corners] : {std::pair(&view, now), {&next, then}}) {
        mesh.geometry = std::make_shared<const view::Geometry>(
            view::Geometry{{corners.begin(), corners.end()}, std::vector<glm::vec3>(3, glm::vec3(0.0F, 0.0F, 1.0F))});
        frame->surfaces.push_back(surface(mesh, glm::vec3(0.0F), glm::vec3(0.5F)));
    }
    view.next = std::make_shared<const view::FrameView>(next);
    const image::Image picture = pictureOf(view, flowOptions());
    const glm::dmat3 sides(now[0], now[1], now[2]);
    for (const auto& [x, y] : {std::pair(140, 90), {170, 80}, {180, 105}, {160, 60}}) {
        const glm::dvec3 way = wayThrough(view.camera, x, y);
        // shares with Σ = 1 and Σ share · corner = eye + t · way.
        const glm::dvec3 ofEye = glm::inverse(sides) * glm::dvec3(view.camera.eye), ofWay = glm::inverse(sides) * way;
        const double t = (1.0 - ofEye.x - ofEye.y - ofEye.z) / (ofWay.x + ofWay.y + ofWay.z);
        const glm::dvec3 share = ofEye + t * ofWay;
        ASSERT_GT(std::min({share.x, share.y, share.z}), 0.0) << x << " " << y;
        const glm::dvec3 place = glm::dmat3(then[0], then[1], then[2]) * share;
        expectFlow(picture, x, y, seenAt(next.camera, glm::vec3(place)) - glm::dvec2(x + 0.5, y + 0.5));
    }
    const glm::vec3 far = next.camera.eye + 1e4F * glm::vec3(wayThrough(view.camera, 3, 3));  // sky
    expectFlow(picture, 3, 3, seenAt(next.camera, far) - glm::dvec2(3.5, 3.5));
}

TEST(RenderLayers, FlowOfTheGroundIsThatOfTheCamera) {
    view::FrameView view = floorView();
    auto next = std::make_shared<view::FrameView>(view);
    next->camera.eye += glm::vec3(0.2F, 0.0F, -0.1F);
    view.next = next;
    const image::Image picture = pictureOf(view, flowOptions());
    for (const auto& [x, y] : {std::pair(160, 100), {60, 150}, {300, 80}}) {
        const glm::vec3 way(wayThrough(view.camera, x, y));
        const glm::vec3 place = view.camera.eye - (view.camera.eye.y / way.y) * way;
        expectFlow(picture, x, y, seenAt(next->camera, place) - glm::dvec2(x + 0.5, y + 0.5));
    }
}

TEST(RenderLayers, FlowIsUnknownWithoutANextViewAndWhereTrianglesAreOthers) {
    view::FrameView view = boxView();
    EXPECT_EQ(numbersAt(pictureOf(view, flowOptions()), "flow", 5, 5), (std::array<int, 3>{}));
    auto next = std::make_shared<view::FrameView>(boxView());
    view.next = next;
    expectFlow(pictureOf(view, flowOptions()), 160, 90, glm::dvec2(0.0));
    next->surfaces[0] = surface(view::sphereMesh(0.5F), glm::vec3(0.0F), glm::vec3(0.5F));
    next->surfaces[0].name = "box";
    EXPECT_EQ(numbersAt(pictureOf(view, flowOptions()), "flow", 160, 90), (std::array<int, 3>{}));
}

// One byte laid over another, as programs do.
double over(int colour, int alpha, int below) {
    return colour * alpha / 255.0 + below * (1.0 - alpha / 255.0);
}

TEST(RenderLayers, WhereAlphaIsOneTheColoursAreThoseOfThePictureWithoutAndBetweenNothingBrightens) {
    // Sky alone behind: a pixel neither opaque nor clear is an edge, and lies between thing and background.
    RendererOptions options = smallOptions();
    view::FrameView view = boxView();
    view.surfaces[0].transform = glm::rotate(glm::mat4(1.0F), 0.5F, {0.3F, 1.0F, 0.2F});
    options.alpha = true;
    const image::Image clear = pictureOf(view, options);
    options.alpha = false;
    for (const float back : {0.05F, 0.8F}) {
        view.background.top = view.background.horizon = glm::vec3(back);
        const image::Image opaque = pictureOf(view, options);
        int edges = 0;
        for (std::size_t i = 0; i < clear.alpha.size(); ++i) {
            const int alpha = clear.alpha[i];
            edges += alpha > 0 && alpha < 255 ? 1 : 0;
            for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
                if (alpha == 255) EXPECT_EQ(clear.rgb[c], opaque.rgb[c]);
                // The background is dithered by half a step.
                if (alpha == 0) EXPECT_NEAR(opaque.rgb[c], srgb(back), 1.01);
            }
        }
        EXPECT_GT(edges, 100);
        EXPECT_LT(edges, 800);
    }
}

TEST(RenderLayers, ShadowsOverTheGroundsOwnColourAreThoseOfTheGround) {
    view::FrameView view = floorView();
    view.light.direction = {0.5F, -1.0F, -0.3F};
    view.surfaces.push_back(surface(view::sphereMesh(0.5F), {0.0F, 0.7F, 0.0F}, {0.6F, 0.2F, 0.1F}));
    view.surfaces.back().name = "ball";
    RendererOptions options = smallOptions();
    options.layers = {maskLayer({{"ball", 0xffffffU}})};
    options.alpha = true;
    const image::Image clear = pictureOf(view, options);
    options.alpha = false;
    // Over its own colour to rounding; over a deep blue, three channels of which one alpha serves, to a tenth.
    for (const auto& [colour, tolerance] :
         {std::pair(view.ground->colour, 2.0), {glm::vec3(0.1F, 0.25F, 0.5F), 25.5}}) {
        view.ground->colour = colour;
        const image::Image opaque = pictureOf(view, options);
        view::FrameView empty = view;
        empty.surfaces.clear();
        const image::Image ground = pictureOf(empty, options);
        double worst = 0.0;
        int shaded = 0;
        for (int y = 60; y < 179; ++y) {  // below the horizon's fading
            for (int x = 1; x < 319; ++x) {
                bool isGround = true;
                for (const int i : {-321, -320, -319, -1, 0, 1, 319, 320, 321})
                    isGround = isGround && clear.layer("mask")->rgb[3 * static_cast<std::size_t>(y * 320 + x + i)] == 0;
                if (!isGround) continue;
                const auto at = static_cast<std::size_t>(y * 320 + x);
                shaded += clear.alpha[at] > 64 ? 1 : 0;
                for (std::size_t c = 3 * at; c < 3 * at + 3; ++c)
                    worst =
                        std::max(worst, std::abs(over(clear.rgb[c], clear.alpha[at], ground.rgb[c]) - opaque.rgb[c]));
            }
        }
        EXPECT_GT(shaded, 500);
        EXPECT_LE(worst, tolerance);
    }
}

}  // namespace
}  // namespace taut::render::test
