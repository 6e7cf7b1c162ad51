#include "taut/render/renderer.h"

#include <algorithm>
#include <array>
#include <glm/ext/matrix_transform.hpp>
#include <optional>
#include <span>
#include <string>

#include "taut/core/error.h"
#include "taut/render/private/context.h"
#include "taut/render/private/edge_kernels.h"
#include "taut/render/private/edge_pass.h"
#include "taut/render/private/environment_map.h"
#include "taut/render/private/frame_block.h"
#include "taut/render/private/ground_fill.h"
#include "taut/render/private/ground_pass.h"
#include "taut/render/private/hem.h"
#include "taut/render/private/label_pass.h"
#include "taut/render/private/layer_pass.h"
#include "taut/render/private/light_maps.h"
#include "taut/render/private/marks_pass.h"
#include "taut/render/private/mesh_cache.h"
#include "taut/render/private/occlusion_pass.h"
#include "taut/render/private/picture_mean.h"
#include "taut/render/private/program.h"
#include "taut/render/private/surface_pass.h"
#include "taut/render/private/targets.h"
#include "taut/render/private/thin_tubes.h"
#include "taut/render/private/transparency.h"
#include "taut/view/camera_axes.h"

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

template <class Value>
void takePart(const std::vector<Value>& all, int width, const PixelBox& part, std::vector<Value>& result) {
    result.clear();
    if (all.empty()) return;
    result.resize(static_cast<std::size_t>(part.width) * static_cast<std::size_t>(part.height));
    auto to = result.begin();
    for (int y = part.y; y < part.y + part.height; ++y) {
        const auto row = all.begin() + static_cast<std::ptrdiff_t>(y) * width + part.x;
        to = std::copy(row, row + part.width, to);
    }
}

// Without marks, and the rows from the top.
image::Image pictureOf(const Drawn& drawn, int width, int height) {
    image::Image picture{width, height, {}};
    picture.rgb.resize(3 * drawn.colours.size());
    const EdgeKernels kernels = edgeKernels();
    for (int y = 0; y < height; ++y) {
        const std::ptrdiff_t above = static_cast<std::ptrdiff_t>(height - 1 - y) * width;
        kernels.takeColours(static_cast<std::size_t>(width),
                            drawn.colours.data() + static_cast<std::ptrdiff_t>(y) * width,
                            picture.rgb.data() + 3 * above);
        if (drawn.alpha.empty()) continue;
        const auto row = drawn.alpha.begin() + above;
        picture.alpha.insert(picture.alpha.end(), row, row + width);
    }
    return picture;
}

void expectSamples(int samples) {
    if (samples != 1 && samples != 4 && samples != 8 && samples != 16) {
        throw core::Error(core::ErrorKind::badContent,
                          "anti-aliasing takes 1, 4, 8 or 16 samples a pixel, not " + std::to_string(samples));
    }
}

// [pixels] By how much a picture is shifted each time that it is drawn. With the four samples of its edges
// (edge_coverage.cpp), which lie on a raster of a quarter, each has a row and a column of its own, and so have the
// places that are shaded.
std::span<const glm::vec2> shiftsOf(int samples) {
    static constexpr std::array<glm::vec2, 1> once{glm::vec2(0.0F, 0.0F)};
    static constexpr std::array<glm::vec2, 2> twice{glm::vec2(0.1875F, 0.0625F), {-0.1875F, -0.0625F}};
    static constexpr std::array<glm::vec2, 4> fourTimes{
        glm::vec2(-0.28125F, 0.03125F), {-0.09375F, 0.34375F}, {0.03125F, -0.28125F}, {0.34375F, -0.09375F}};
    if (samples <= 4) return once;
    return samples == 8 ? std::span<const glm::vec2>(twice) : std::span<const glm::vec2>(fourTimes);
}

}  // namespace

// Everything that lives in the context.
struct RendererParts {
    RendererParts(const Gl& gl, const RendererOptions& options)
        : shaders(gl, options.shaders),
          targets(gl, options.width, options.height),
          meshes(gl),
          thinMeshes(gl),
          hemMeshes(gl),
          lightMaps(gl, options.shadowSize),
          occlusion(gl),
          surfaces(gl, shaders, textures),
          environment(gl, textures),
          marks(gl, shaders),
          labels(options.font),
          frameBlock(gl, GlKind::buffer) {
        addGrounds(gl, options);
        addLayers(gl, options);
    }

    void addLayers(const Gl& gl, const RendererOptions& options) {
        layers.clear();
        for (const auto& layer : options.layers) layers.push_back(layer->pass(gl, shaders, targets.size()));
    }

    void addGrounds(const Gl& gl, const RendererOptions& options) {
        while (grounds.size() < shiftsOf(options.samples).size())
            grounds.push_back(std::make_unique<GroundPass>(gl, shaders, textures, options));
    }

    ShaderFolder shaders;
    Targets targets;
    MeshCache meshes, thinMeshes, hemMeshes;
    Hems hems;
    LightMaps lightMaps;
    OcclusionPass occlusion;
    TextureBudget textures;
    SurfacePass surfaces;
    EnvironmentMap environment;
    std::vector<std::unique_ptr<GroundPass>> grounds;  // one for each shift, for each keeps its own picture
    MarksPass marks;
    LabelPass labels;
    std::vector<std::unique_ptr<LayerPass>> layers;  // of the options, in their order
    GlObject frameBlock;

    // Room that is used again from picture to picture.
    std::vector<std::uint32_t> thinColours;  // (pixels) rows from below
    ShadedPixels shaded;
    EdgeTriangles edges;
};

// What is drawn of a view.
struct Scene {
    const view::FrameView& view;
    std::vector<DrawItem> items;  // the nearest first
    std::vector<DrawItem> solid;  // of them without thin tubes, with what hems they show
    std::vector<view::Surface> hemmed;
    std::vector<view::Surface> thinSurfaces;
    std::vector<DrawItem> thin, shadedThin;  // tubes as they cover pixels, and as they are shaded; the nearest first
    std::vector<Bounds> casters;
    float aspect;
    PixelScale scale;
};

// How it is drawn this time.
struct Pass {
    std::size_t number = 0;
    glm::vec2 shift{0.0F};  // [pixels]
    glm::mat4 projection{1.0F};
    PixelBox part;  // in which there is what is solid
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
    Pass passOf(const Scene& scene, std::size_t number, glm::vec2 aside = glm::vec2(0.0F));
    Drawn draw(const Scene& scene, const Pass& pass);
    void smooth(const Scene& scene, const Pass& pass, Drawn& drawn);
    void drawThin(const Scene& scene, const Pass& pass, const LightKind& lights, Drawn& drawn);
    Drawn drawAll(const Scene& scene);
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
    if (options.shadowSize != now.shadowSize) parts.lightMaps = LightMaps(gl, options.shadowSize);
    for (const auto& ground : parts.grounds) ground->forget();
    parts.addGrounds(gl, options);
    parts.addLayers(gl, now);
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
    const PixelScale scale(view.camera, {options.width, options.height});
    Scene scene{view, parts->meshes.items(view.surfaces), {}, {}, {}, {}, {}, {}, aspect, scale};
    sortByDistance(scene.items, view.camera.eye);
    for (const DrawItem& item : scene.items) {
        scene.casters.push_back(item.bounds);
        if (!isThin(item, scene.scale)) scene.solid.push_back(item);
    }
    scene.hemmed = parts->hems.addTo(scene.solid, scene.scale, parts->hemMeshes);  // after what throws shadows
    for (const float radius : {coveringRadius, shadedRadius})
        for (const DrawItem& item : scene.items)
            if (isThin(item, scene.scale)) scene.thinSurfaces.push_back(widened(*item.surface, scene.scale, radius));
    scene.thin = parts->thinMeshes.items(scene.thinSurfaces);
    const auto half = scene.thin.begin() + static_cast<std::ptrdiff_t>(scene.thin.size() / 2);
    scene.shadedThin.assign(half, scene.thin.end());
    scene.thin.erase(half, scene.thin.end());
    return scene;
}

// Shifted by as many pixels `aside` besides.
Pass Renderer::Impl::passOf(const Scene& scene, std::size_t number, glm::vec2 aside) {
    Pass pass{number, shiftsOf(options.samples)[number] + aside, projectionOf(scene.view.camera, scene.aspect), {}};
    const glm::vec2 clip = 2.0F * pass.shift / glm::vec2(parts->targets.size());
    if (pass.shift != glm::vec2(0.0F))
        pass.projection = glm::translate(glm::mat4(1.0F), glm::vec3(clip, 0.0F)) * pass.projection;
    pass.part = pixelBox(scene.solid, pass.projection, options.width, options.height);
    return pass;
}

Drawn Renderer::Impl::draw(const Scene& scene, const Pass& pass) {
    const view::FrameView& view = scene.view;
    const std::vector<DrawItem>& items = scene.items;
    GroundPass& ground = *parts->grounds[pass.number];
    const LightSet lights = lightsOf(view, scene.casters, scene.aspect, options.shadowSize);
    std::optional<OcclusionArea> occlusion;
    if (view.ground && options.occlusion) occlusion = occlusionArea(scene.casters, view.ground->height);

    // The maps that shading reads.
    const std::span<const DrawItem> shadowed =
        options.shadows ? std::span<const DrawItem>(items) : std::span<const DrawItem>();
    passDone("meshes");
    parts->lightMaps.draw(shadowed, lights, !options.keepsStill);
    passDone("shadow");
    if (occlusion) parts->occlusion.draw(items, *occlusion, view.ground->height, !options.keepsStill);
    passDone("occlusion");

    // The picture; ground and sky last, for what is hidden need not be shaded.
    FrameBlock block = blockOf(view, pass.projection, lights, options.shadowSize, occlusion);
    parts->environment.show(view, block);
    gl().BindBufferBase(GL_UNIFORM_BUFFER, frameBlockBinding, parts->frameBlock.id());
    gl().BufferData(GL_UNIFORM_BUFFER, sizeof(block), &block, GL_STREAM_DRAW);
    parts->lightMaps.bind();
    parts->occlusion.bindMap();
    ground.begin(view, block, lights, items, occlusion, parts->lightMaps, parts->targets);
    parts->targets.bindSurfaces();
    gl().DepthMask(GL_TRUE);
    gl().Clear(GL_DEPTH_BUFFER_BIT);
    parts->surfaces.draw(scene.solid, parts->meshes);
    passDone("surfaces");
    parts->targets.bindShading();
    if (ground.fills()) {
        gl().ClearColor(0.0F, 0.0F, 0.0F, 1.0F);
        gl().Clear(GL_COLOR_BUFFER_BIT);
    }
    parts->surfaces.light(lights.kind, view.camera, pass.part, parts->targets, pass.shift, options.occlusion);
    passDone("light");
    ground.draw(pass.projection);
    passDone("ground");

    Drawn drawn;
    parts->targets.colours(drawn.colours);
    parts->shaded.box = pass.part;
    parts->targets.depths(pass.part, parts->shaded.depth);
    passDone("read");
    if (ground.isPlain())
        fillGround(groundArgs(view, block, lights, pass.projection, parts->targets.size(), pass.shift,
                              occlusion ? parts->occlusion.hidden() : std::span<const float>()),
                   pass.part, parts->shaded.depth, drawn.colours, options.width);
    else
        ground.fill(pass.part, parts->shaded.depth, drawn.colours, options.width);
    passDone("fill");
    smooth(scene, pass, drawn);
    if (!scene.thin.empty()) drawThin(scene, pass, lights.kind, drawn);
    passDone("edges");
    if (view.showMarks) {
        parts->targets.put(drawn.colours);
        parts->targets.bindShading();
        parts->marks.draw(view, pass.projection, options.width, options.height);
        parts->targets.colours(drawn.colours);
    }
    return drawn;
}

void Renderer::Impl::smooth(const Scene& scene, const Pass& pass, Drawn& drawn) {
    if (options.alpha) drawn.alpha = takeShadows(scene.view, drawn.colours);
    if (options.samples == 1) return;
    const EdgeView edges{pass.projection, seenSideOf(scene.view), parts->targets.size()};
    takePart(drawn.colours, options.width, pass.part, parts->shaded.colour);
    takePart(drawn.alpha, options.width, pass.part, parts->shaded.alpha);
    smoothEdges(scene.solid, edges, parts->shaded, parts->edges, drawn.colours, drawn.alpha);
}

// Alone into the targets of the picture, and from there over it. The frame block and the maps are in place.
void Renderer::Impl::drawThin(const Scene& scene, const Pass& pass, const LightKind& lights, Drawn& drawn) {
    const PixelBox part = pixelBox(scene.shadedThin, pass.projection, options.width, options.height);
    parts->targets.bindSurfaces();
    gl().DepthMask(GL_TRUE);
    gl().Clear(GL_DEPTH_BUFFER_BIT);
    parts->surfaces.draw(scene.shadedThin, parts->thinMeshes);
    parts->targets.bindShading();
    gl().ClearColor(0.0F, 0.0F, 0.0F, 0.0F);
    gl().Clear(GL_COLOR_BUFFER_BIT);
    parts->surfaces.light(lights, scene.view.camera, part, parts->targets, pass.shift, false);
    parts->shaded.box = part;
    parts->targets.colours(parts->thinColours);
    takePart(parts->thinColours, options.width, part, parts->shaded.colour);
    parts->shaded.alpha.clear();
    parts->targets.depths(part, parts->shaded.depth);
    const EdgeView edges{pass.projection, seenSideOf(scene.view), parts->targets.size()};
    layThinTubes({scene.thin, scene.solid, parts->shaded, scene.scale}, edges, parts->edges, drawn);
    passDone("thin");
}

// As often as it is shifted, as there are moments, and as there are places on the lens.
Drawn Renderer::Impl::drawAll(const Scene& scene) {
    const view::FrameView& view = scene.view;
    const std::size_t shifts = shiftsOf(options.samples).size(), moments = view.moments.size();
    const bool hasLens = view.camera.lensRadius > 0.0F;
    if (moments == 0 && shifts == 1 && !hasLens) return draw(scene, passOf(scene, 0));
    PictureMean mean;
    // Every shift as often as the others: a multiple of both.
    const std::size_t least = std::max({moments, shifts, hasLens ? view::placesOnLens : 1});
    const std::size_t times = (least + shifts - 1) / shifts * shifts;
    for (std::size_t i = 0; i < times; ++i) {
        if (moments == 0 && !hasLens) {
            mean.add(draw(scene, passOf(scene, i)));
            continue;
        }
        view::FrameView seen = moments == 0 ? view : view.moments[i * moments / times];
        glm::vec2 aside(0.0F);  // [pixels] that keeps in place what is sharp
        if (hasLens) {
            const glm::vec2 place = view.camera.lensRadius * view::placeOnLens(i);
            moveAside(seen.camera, place);
            aside = place * scene.scale.pixels(1.0F, view.camera.focus);
        }
        const Scene moment = sceneOf(seen);
        mean.add(draw(moment, passOf(moment, i % shifts, aside)));
    }
    return mean.mean();
}

// Without the maps that shading reads.
void Renderer::Impl::addLayers(const Scene& scene, image::Image& picture) {
    if (options.layers.empty()) return;
    const glm::mat4 projection = projectionOf(scene.view.camera, scene.aspect);
    const FrameBlock block = blockOf(scene.view, projection, {}, options.shadowSize, {});
    gl().BindBufferBase(GL_UNIFORM_BUFFER, frameBlockBinding, parts->frameBlock.id());
    gl().BufferData(GL_UNIFORM_BUFFER, sizeof(block), &block, GL_STREAM_DRAW);
    std::vector<DrawItem> items = scene.solid;
    items.insert(items.end(), scene.thin.begin(), scene.thin.end());
    const glm::ivec2 size(options.width, options.height);
    const LayerScene seen{scene.view,     items,         pixelBox(items, projection, size.x, size.y),
                          size,           parts->meshes, parts->targets,
                          parts->surfaces};
    for (std::size_t i = 0; i < options.layers.size(); ++i) {
        picture.layers.push_back({.name = options.layers[i]->name()});
        parts->layers[i]->draw(seen, picture.layers.back());
    }
}

image::Image Renderer::draw(const view::FrameView& view) {
    const CurrentContext current(*impl_->context);
    const Scene scene = impl_->sceneOf(view);
    image::Image picture = pictureOf(impl_->drawAll(scene), impl_->options.width, impl_->options.height);
    impl_->parts->labels.draw(view, projectionOf(view.camera, scene.aspect), picture);
    impl_->addLayers(scene, picture);
    impl_->passDone("picture");
    return picture;
}

}  // namespace taut::render
