#include "taut/render/renderer.h"

#include <algorithm>
#include <numbers>
#include <optional>
#include <span>
#include <string>

#include "taut/core/error.h"
#include "taut/render/camera_axes.h"
#include "taut/render/context.h"
#include "taut/render/depth_layer.h"
#include "taut/render/edge_pass.h"
#include "taut/render/frame_block.h"
#include "taut/render/ground_pass.h"
#include "taut/render/label_pass.h"
#include "taut/render/light_box.h"
#include "taut/render/marks_pass.h"
#include "taut/render/mask_pass.h"
#include "taut/render/mesh_cache.h"
#include "taut/render/occlusion_pass.h"
#include "taut/render/program.h"
#include "taut/render/shadow_pass.h"
#include "taut/render/surface_pass.h"
#include "taut/render/targets.h"
#include "taut/render/transparency.h"

namespace taut::render {

namespace {

// Near things first: what they hide need not be shaded.
void sortByDistance(std::vector<DrawItem>& items, glm::vec3 eye) {
    const auto distance = [&](const DrawItem& item) {
        return glm::distance(eye, glm::clamp(eye, item.bounds.low, item.bounds.high));
    };
    std::stable_sort(items.begin(), items.end(),
                     [&](const DrawItem& a, const DrawItem& b) { return distance(a) < distance(b); });
}

FrameBlock blockOf(const view::FrameView& view, const glm::mat4& projection, const LightBox& box, int texels,
                   const std::optional<OcclusionArea>& occlusion) {
    FrameBlock block{};
    block.viewProjection = projection;
    block.toMap = box.toMap;
    block.toLight = glm::mat4(box.toLight);
    block.eye = glm::vec4(view.camera.eye, 1.0F);
    block.lightWay = glm::vec4(-glm::normalize(view.light.direction), view.light.softness);
    block.lightColour = glm::vec4(view.light.colour / std::numbers::pi_v<float>, 0.0F);
    block.skyLight = glm::vec4(view.light.sky, 0.0F);
    block.groundLight = glm::vec4(view.light.ground, 0.0F);
    block.backgroundTop = glm::vec4(view.background.top, 0.0F);
    block.backgroundHorizon = glm::vec4(view.background.horizon, 0.0F);
    const Fade fade = fadeOf(view);
    block.fade = {view.camera.target.x, view.camera.target.z, fade.start, fade.end};
    block.mapSize = glm::vec4(box.size, glm::max(box.size.x, box.size.y) / static_cast<float>(texels));
    if (occlusion) block.occlusionArea = glm::vec4(occlusion->low, 1.0F / (occlusion->high - occlusion->low));
    if (view.ground) block.groundColour = glm::vec4(view.ground->colour, view.ground->gridSpacing);
    block.debug = glm::vec4(view.showMarks ? 1.0F : 0.0F);
    return block;
}

// Rows from below.
struct Drawn {
    std::vector<std::uint32_t> colours;  // (pixels) the uppermost byte says nothing
    std::vector<std::uint8_t> alpha;     // (pixels) empty: opaque
};

template <class Value>
std::vector<Value> partOf(const std::vector<Value>& all, int width, const PixelBox& part) {
    std::vector<Value> result;
    if (all.empty()) return result;
    result.reserve(static_cast<std::size_t>(part.width) * static_cast<std::size_t>(part.height));
    for (int y = part.y; y < part.y + part.height; ++y) {
        const auto row = all.begin() + static_cast<std::ptrdiff_t>(y) * width + part.x;
        result.insert(result.end(), row, row + part.width);
    }
    return result;
}

// Without marks, and the rows from the top.
image::Image pictureOf(const Drawn& drawn, int width, int height) {
    image::Image picture{width, height, {}};
    picture.rgb.resize(3 * drawn.colours.size());
    std::uint8_t* to = picture.rgb.data();
    for (int y = height - 1; y >= 0; --y) {
        const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(y) * width;
        const std::uint32_t* from = drawn.colours.data() + first;
        for (int x = 0; x < width; ++x, to += 3) {
            to[0] = static_cast<std::uint8_t>(from[x]);
            to[1] = static_cast<std::uint8_t>(from[x] >> 8);
            to[2] = static_cast<std::uint8_t>(from[x] >> 16);
        }
        if (drawn.alpha.empty()) continue;
        const auto row = drawn.alpha.begin() + first;
        picture.alpha.insert(picture.alpha.end(), row, row + width);
    }
    return picture;
}

void expectSamples(int samples) {
    if (samples != 1 && samples != 4) {
        throw core::Error(core::ErrorKind::badContent,
                          "anti-aliasing takes 1 or 4 samples a pixel, not " + std::to_string(samples));
    }
}

}  // namespace

// Everything that lives in the context.
struct RendererParts {
    RendererParts(const Gl& gl, const RendererOptions& options)
        : shaders(gl, options.shaders),
          targets(gl, options.width, options.height),
          meshes(gl),
          shadow(gl, shaders, options.shadowSize),
          occlusion(gl, shaders),
          surfaces(gl, shaders),
          ground(gl, shaders, options.keepsStill, options.alpha),
          marks(gl, shaders),
          labels(options.font),
          frameBlock(gl, GlKind::buffer) {
        if (!options.maskColours.empty()) mask.emplace(gl, shaders, targets.size(), options.maskColours);
    }

    ShaderFolder shaders;
    Targets targets;
    MeshCache meshes;
    ShadowPass shadow;
    OcclusionPass occlusion;
    SurfacePass surfaces;
    GroundPass ground;
    MarksPass marks;
    LabelPass labels;
    std::optional<MaskPass> mask;
    GlObject frameBlock;
};

// What is drawn of a view from here on, and through which eyes.
struct Scene {
    const view::FrameView& view;
    std::vector<DrawItem> items;  // the nearest first
    std::vector<Bounds> casters;
    float aspect;
    glm::mat4 projection;
    PixelBox part;  // in which there are items
};

struct Renderer::Impl {
    RendererOptions options;
    std::unique_ptr<Context> context;
    std::unique_ptr<RendererParts> parts;

    const Gl& gl() const { return context->gl(); }
    void passDone(std::string_view pass) const {
        if (!options.passDone) return;
        gl().Finish();
        options.passDone(pass);
    }
    Scene sceneOf(const view::FrameView& view);
    void useBlock(const FrameBlock& block);
    Drawn draw(const Scene& scene);
    void smooth(const Scene& scene, const std::vector<float>& depths, Drawn& drawn);
    void addLayers(const Scene& scene, image::Image& picture);
};

Renderer::Renderer(const RendererOptions& options) : impl_(std::make_unique<Impl>()) {
    expectSamples(options.samples);
    impl_->options = options;
    impl_->context = makeContext(options.backend, options.device);
    const CurrentContext current(*impl_->context);
    impl_->parts = std::make_unique<RendererParts>(impl_->context->gl(), options);
}

Renderer::~Renderer() {
    const CurrentContext current(*impl_->context);
    impl_->parts.reset();
}

void Renderer::change(const RendererOptions& options) {
    expectSamples(options.samples);
    const CurrentContext current(*impl_->context);
    const Gl& gl = impl_->context->gl();
    RendererParts& parts = *impl_->parts;
    RendererOptions& now = impl_->options;
    if (options.width != now.width || options.height != now.height)
        parts.targets = Targets(gl, options.width, options.height);
    if (options.shadowSize != now.shadowSize) parts.shadow = ShadowPass(gl, parts.shaders, options.shadowSize);
    parts.ground.forget();
    now.width = options.width;
    now.height = options.height;
    now.samples = options.samples;
    now.shadowSize = options.shadowSize;
    now.occlusion = options.occlusion;
}

RendererInfo Renderer::info() const {
    return impl_->context->info();
}

Scene Renderer::Impl::sceneOf(const view::FrameView& view) {
    const float aspect = static_cast<float>(options.width) / static_cast<float>(options.height);
    Scene scene{view, parts->meshes.items(view.surfaces), {}, aspect, projectionOf(view.camera, aspect), {}};
    sortByDistance(scene.items, view.camera.eye);
    for (const DrawItem& item : scene.items) scene.casters.push_back(item.bounds);
    scene.part = pixelBox(scene.items, scene.projection, options.width, options.height);
    return scene;
}

void Renderer::Impl::useBlock(const FrameBlock& block) {
    gl().BindBufferBase(GL_UNIFORM_BUFFER, frameBlockBinding, parts->frameBlock.id());
    gl().BufferData(GL_UNIFORM_BUFFER, sizeof(block), &block, GL_STREAM_DRAW);
}

Drawn Renderer::Impl::draw(const Scene& scene) {
    const view::FrameView& view = scene.view;
    const std::vector<DrawItem>& items = scene.items;
    const LightBox box = lightBox(view, scene.casters, scene.aspect, options.shadowSize);
    std::optional<OcclusionArea> occlusion;
    if (view.ground && options.occlusion) occlusion = occlusionArea(scene.casters, view.ground->height);

    // The maps that shading reads.
    const std::span<const DrawItem> shadowed =
        options.shadows ? std::span<const DrawItem>(items) : std::span<const DrawItem>();
    passDone("meshes");
    parts->shadow.draw(shadowed, parts->meshes, box, !options.keepsStill);
    passDone("shadow");
    if (occlusion) parts->occlusion.draw(items, parts->meshes, *occlusion, view.ground->height, !options.keepsStill);
    passDone("occlusion");

    // The picture; ground and sky last, for what is hidden need not be shaded.
    const FrameBlock block = blockOf(view, scene.projection, box, options.shadowSize, occlusion);
    useBlock(block);
    parts->shadow.bindMaps();
    parts->occlusion.bindMap();
    parts->ground.begin(view, block, box, items, occlusion, parts->targets);
    parts->targets.bindSurfaces();
    gl().DepthMask(GL_TRUE);
    gl().Clear(GL_DEPTH_BUFFER_BIT);
    parts->surfaces.draw(items, parts->meshes);
    passDone("surfaces");
    parts->targets.bindShading();
    if (parts->ground.fills()) {
        gl().ClearColor(0.0F, 0.0F, 0.0F, 1.0F);
        gl().Clear(GL_COLOR_BUFFER_BIT);
    }
    parts->surfaces.light(view.camera, scene.part, parts->targets.size(), glm::vec2(0.0F));
    passDone("light");
    parts->ground.draw(scene.projection);
    passDone("ground");

    Drawn drawn{parts->targets.colours(), {}};
    std::vector<float> depths = parts->targets.depths(scene.part);
    passDone("read");
    parts->ground.fill(scene.part, depths, drawn.colours, options.width);
    smooth(scene, depths, drawn);
    passDone("edges");
    if (view.showMarks) {
        parts->targets.put(drawn.colours);
        parts->targets.bindShading();
        parts->marks.draw(view, scene.projection, options.width, options.height);
        drawn.colours = parts->targets.colours();
    }
    return drawn;
}

void Renderer::Impl::smooth(const Scene& scene, const std::vector<float>& depths, Drawn& drawn) {
    if (options.alpha) drawn.alpha = takeShadows(scene.view, drawn.colours);
    if (options.samples == 1) return;
    const EdgeView edges{scene.projection, seenSideOf(scene.view), parts->targets.size()};
    const ShadedPixels shaded{scene.part, partOf(drawn.colours, options.width, scene.part), depths,
                              partOf(drawn.alpha, options.width, scene.part)};
    smoothEdges(scene.items, edges, shaded, drawn.colours, drawn.alpha);
}

// Of each pixel's middle; without the maps that shading reads.
void Renderer::Impl::addLayers(const Scene& scene, image::Image& picture) {
    if (options.depthUnit > 0.0) {
        parts->targets.bindSurfaces();
        gl().DepthMask(GL_TRUE);
        gl().Clear(GL_DEPTH_BUFFER_BIT);
        parts->surfaces.draw(scene.items, parts->meshes);
        const std::vector<float> depths = parts->targets.depths(scene.part);
        const std::vector<float> nearness = parts->targets.nearness(scene.part);
        picture.depth =
            depthLayer(scene.view, {options.width, options.height, scene.part, depths, nearness}, options.depthUnit);
    }
    if (parts->mask) picture.mask = parts->mask->draw(scene.items, parts->meshes, seenSideOf(scene.view));
}

image::Image Renderer::draw(const view::FrameView& view) {
    const CurrentContext current(*impl_->context);
    const Scene scene = impl_->sceneOf(view);
    image::Image picture = pictureOf(impl_->draw(scene), impl_->options.width, impl_->options.height);
    impl_->parts->labels.draw(view, scene.projection, picture);
    impl_->addLayers(scene, picture);
    impl_->passDone("picture");
    return picture;
}

}  // namespace taut::render
