#include "taut/render/renderer.h"

#include <algorithm>
#include <numbers>
#include <optional>
#include <span>
#include <string>

#include "taut/core/error.h"
#include "taut/render/camera_axes.h"
#include "taut/render/context.h"
#include "taut/render/edge_kernels.h"
#include "taut/render/edge_pass.h"
#include "taut/render/frame_block.h"
#include "taut/render/ground_pass.h"
#include "taut/render/label_pass.h"
#include "taut/render/light_box.h"
#include "taut/render/marks_pass.h"
#include "taut/render/mesh_cache.h"
#include "taut/render/occlusion_pass.h"
#include "taut/render/program.h"
#include "taut/render/shadow_pass.h"
#include "taut/render/surface_pass.h"
#include "taut/render/targets.h"

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

void takePart(std::span<const std::uint32_t> colours, int width, const PixelBox& part,
              std::vector<std::uint32_t>& result) {
    result.resize(static_cast<std::size_t>(part.width) * static_cast<std::size_t>(part.height));
    auto to = result.begin();
    for (int y = part.y; y < part.y + part.height; ++y) {
        const auto row = colours.begin() + static_cast<std::ptrdiff_t>(y) * width + part.x;
        to = std::copy(row, row + part.width, to);
    }
}

// Without marks, and the rows from the top.
image::Image pictureOf(std::span<const std::uint32_t> colours, int width, int height) {
    image::Image picture{width, height, {}};
    picture.rgb.resize(3 * colours.size());
    const EdgeKernels kernels = edgeKernels();
    for (int y = 0; y < height; ++y) {
        const std::ptrdiff_t above = static_cast<std::ptrdiff_t>(height - 1 - y) * width;
        kernels.takeColours(static_cast<std::size_t>(width), colours.data() + static_cast<std::ptrdiff_t>(y) * width,
                            picture.rgb.data() + 3 * above);
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
          shadow(gl, options.shadowSize),
          occlusion(gl),
          surfaces(gl, shaders),
          ground(gl, shaders, options.keepsStill),
          marks(gl, shaders),
          labels(options.font),
          frameBlock(gl, GlKind::buffer) {}

    ShaderFolder shaders;
    Targets targets;
    MeshCache meshes;
    ShadowPass shadow;
    OcclusionPass occlusion;
    SurfacePass surfaces;
    GroundPass ground;
    MarksPass marks;
    LabelPass labels;
    GlObject frameBlock;

    // Room that is used again from picture to picture.
    std::vector<std::uint32_t> colours;  // (pixels) rows from below
    ShadedPixels shaded;
    EdgeTriangles edges;
};

struct Renderer::Impl {
    RendererOptions options;
    std::unique_ptr<Context> context;
    std::unique_ptr<RendererParts> parts;
};

Renderer::Renderer(const RendererOptions& options) : impl_(std::make_unique<Impl>()) {
    expectSamples(options.samples);
    impl_->options = options;
    impl_->context = makeContext(options.backend);
    const CurrentContext current(*impl_->context);
    impl_->parts = std::make_unique<RendererParts>(impl_->context->gl(), options);
}

Renderer::~Renderer() {
    const CurrentContext current(*impl_->context);
    impl_->parts.reset();
}

RendererInfo Renderer::info() const {
    return impl_->context->info();
}

image::Image Renderer::draw(const view::FrameView& view) {
    const CurrentContext current(*impl_->context);
    const Gl& gl = impl_->context->gl();
    RendererParts& parts = *impl_->parts;
    const RendererOptions& options = impl_->options;

    const auto passDone = [&](std::string_view pass) {
        if (!options.passDone) return;
        gl.Finish();
        options.passDone(pass);
    };

    std::vector<DrawItem> items = parts.meshes.items(view.surfaces);
    sortByDistance(items, view.camera.eye);
    std::vector<Bounds> casters;
    for (const DrawItem& item : items) casters.push_back(item.bounds);
    const float aspect = static_cast<float>(options.width) / static_cast<float>(options.height);
    const LightBox box = lightBox(view, casters, aspect, options.shadowSize);
    std::optional<OcclusionArea> occlusion;
    if (view.ground) occlusion = occlusionArea(casters, view.ground->height);

    // The maps that shading reads.
    const std::span<const DrawItem> shadowed =
        options.shadows ? std::span<const DrawItem>(items) : std::span<const DrawItem>();
    passDone("meshes");
    parts.shadow.draw(shadowed, box, !options.keepsStill);
    passDone("shadow");
    if (occlusion) parts.occlusion.draw(items, *occlusion, view.ground->height, !options.keepsStill);
    passDone("occlusion");

    // The picture; ground and sky last, for what is hidden need not be shaded.
    const glm::mat4 projection = projectionOf(view.camera, aspect);
    const FrameBlock block = blockOf(view, projection, box, options.shadowSize, occlusion);
    gl.BindBufferBase(GL_UNIFORM_BUFFER, frameBlockBinding, parts.frameBlock.id());
    gl.BufferData(GL_UNIFORM_BUFFER, sizeof(block), &block, GL_STREAM_DRAW);
    const PixelBox part = pixelBox(items, projection, options.width, options.height);
    parts.shadow.bindMaps();
    parts.occlusion.bindMap();
    parts.ground.begin(view, block, box, items, occlusion, parts.targets);
    parts.targets.bindSurfaces();
    gl.DepthMask(GL_TRUE);
    gl.Clear(GL_DEPTH_BUFFER_BIT);
    parts.surfaces.draw(items, parts.meshes);
    passDone("surfaces");
    parts.targets.bindShading();
    if (parts.ground.fills()) {
        gl.ClearColor(0.0F, 0.0F, 0.0F, 1.0F);
        gl.Clear(GL_COLOR_BUFFER_BIT);
    }
    parts.surfaces.light(view.camera, part, parts.targets.size());
    passDone("light");
    parts.ground.draw(projection);
    passDone("ground");

    std::vector<std::uint32_t>& colours = parts.colours;
    ShadedPixels& shaded = parts.shaded;
    shaded.box = part;
    parts.targets.colours(colours);
    parts.targets.depths(part, shaded.depth);
    passDone("read");
    parts.ground.fill(part, shaded.depth, colours, options.width);
    if (options.samples == 4) {
        takePart(colours, options.width, part, shaded.colour);
        smoothEdges(items, {projection, seenSideOf(view), parts.targets.size()}, shaded, parts.edges, colours);
    }
    passDone("edges");
    if (view.showMarks) {
        parts.targets.put(colours);
        parts.targets.bindShading();
        parts.marks.draw(view, projection, options.width, options.height);
        parts.targets.colours(colours);
    }
    image::Image picture = pictureOf(colours, options.width, options.height);
    parts.labels.draw(view, projection, picture);
    passDone("picture");
    return picture;
}

}  // namespace taut::render
