#include "taut/geometry/usda_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "taut/core/file_part.h"
#include "taut/core/whole_file.h"
#include "taut/geometry/private/far_lights.h"
#include "taut/geometry/private/format_table.h"
#include "taut/geometry/private/number_text.h"
#include "taut/geometry/private/parts.h"
#include "taut/geometry/private/poses.h"
#include "taut/geometry/private/usda_samples.h"
#include "taut/view/camera_axes.h"

namespace taut::geometry {
namespace {

constexpr int matrixDigits = 9;
constexpr double aperture = 24.0;  // height of the film, in the unit of the focal length

// Rows are the columns of glm: USD multiplies from the left.
std::string matrixText(const glm::mat4& matrix) {
    std::string text = "(";
    for (int i = 0; i < 4; ++i) {
        text += i > 0 ? ", (" : "(";
        for (int k = 0; k < 4; ++k) {
            if (k > 0) text += ", ";
            appendNumber(text, static_cast<double>(matrix[i][k]), matrixDigits);
        }
        text += ")";
    }
    return text + ")";
}

std::string colourText(glm::vec3 colour) {
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", colour.x, colour.y, colour.z);
}

// Frames of one size, so that moving parts need no search.
std::string extentText(const std::vector<glm::vec3>& positions, int digits) {
    glm::vec3 bounds[2] = {positions.front(), positions.front()};
    for (const glm::vec3& x : positions) {
        bounds[0] = glm::min(bounds[0], x);
        bounds[1] = glm::max(bounds[1], x);
    }
    std::string text;
    appendVectors(text, bounds, digits);
    return text;
}

template <class Range, class Add>
std::string listed(const Range& values, Add&& add) {
    std::string text = "[";
    for (const auto& value : values) {
        if (text.size() > 1) text += ',';
        add(text, value);
    }
    return text + "]";
}

}  // namespace

struct UsdaWriter::Impl {
    struct Prim {
        Part part;  // as it is now
        UsdaSamples points, normals, extent;
        UsdaSamples counts{true}, indices{true}, st{true}, visibility{true};
        UsdaSamples transform;
        std::string material;
        bool isThere = false;
    };

    Impl(std::filesystem::path file, GeometryOptions given)
        : path(std::move(file)), options(std::move(given)), finder(options.isWanted), scratch(path) {}

    std::filesystem::path path;
    GeometryOptions options;
    PartFinder finder;
    ScratchFile scratch;
    std::vector<Prim> prims;
    std::map<std::string, std::size_t> primOf;                                           // by identifier
    std::vector<std::pair<std::shared_ptr<const view::Finish>, std::string>> materials;  // with their names
    UsdaSamples camera, focalLength;
    std::vector<FarLight> lights;
    view::Camera firstCamera;
    std::int64_t first = 0, last = 0;
    std::string text;

    Prim& primFor(const Part& part);
    void add(const Part& part);
    void setTopology(Prim& prim, const Part& part);
    void setGeometry(Prim& prim, const Part& part);
    void put(const Prim& prim, UsdaText& to) const;
    std::string head() const;
    std::string tail() const;
    std::string materialText(const std::string& name, const view::Finish& finish) const;
};

UsdaWriter::Impl::Prim& UsdaWriter::Impl::primFor(const Part& part) {
    const auto [entry, isNew] = primOf.try_emplace(part.identifier, prims.size());
    if (!isNew) return prims[entry->second];
    Prim& prim = prims.emplace_back();
    prim.part.identifier = part.identifier;
    prim.part.isTwoSided = part.isTwoSided;
    auto known = std::find_if(materials.begin(), materials.end(),
                              [&](const auto& material) { return material.first == part.finish; });
    if (known == materials.end()) known = materials.insert(known, {part.finish, part.identifier});
    prim.material = known->second;
    if (last > first) prim.visibility.set(first, "\"invisible\"", scratch);
    return prim;
}

void UsdaWriter::Impl::setTopology(Prim& prim, const Part& part) {
    const view::Topology& topology = *part.topology;
    std::string threes = "[";
    for (std::size_t i = 0; i < topology.triangles.size(); i += 3) threes += i > 0 ? ",3" : "3";
    prim.counts.set(last, threes + "]", scratch);
    prim.indices.set(
        last, listed(topology.triangles, [](std::string& to, std::uint32_t i) { to += fmt::format_int(i).c_str(); }),
        scratch);
    const auto repeat = static_cast<double>(std::max(part.finish->repeat, 1e-6F));
    const auto addPair = [&](std::string& to, const glm::vec2& uv) {
        to += '(';
        appendNumber(to, static_cast<double>(uv.x) / repeat, 6);
        to += ',';
        appendNumber(to, static_cast<double>(uv.y) / repeat, 6);
        to += ')';
    };
    prim.st.set(last, listed(topology.uv, addPair), scratch);
}

void UsdaWriter::Impl::setGeometry(Prim& prim, const Part& part) {
    text.clear();
    appendVectors(text, part.geometry->positions, options.digits);
    prim.points.set(last, text, scratch);
    prim.extent.set(last, extentText(part.geometry->positions, options.digits), scratch);
    if (!options.normals) return;
    text.clear();
    appendVectors(text, part.geometry->normals, std::min(options.digits, 5));
    prim.normals.set(last, text, scratch);
}

void UsdaWriter::Impl::add(const Part& part) {
    Prim& prim = primFor(part);
    const bool isTorn = prim.part.topology != part.topology;
    if (isTorn) setTopology(prim, part);
    // After a tear all that has the size of the vertices has a sample.
    if (isTorn || prim.part.geometry != part.geometry)
        setGeometry(prim, part);
    else
        for (UsdaSamples* samples : {&prim.points, &prim.normals, &prim.extent}) samples->keep(last);
    prim.transform.update(last, matrixText(part.transform), scratch);
    if (!prim.isThere && !prim.visibility.isEmpty()) prim.visibility.set(last, "\"inherited\"", scratch);
    prim.isThere = true;
    prim.part = part;
}

UsdaWriter::UsdaWriter(const std::filesystem::path& path, GeometryOptions options)
    : impl_(std::make_unique<Impl>(path, std::move(options))) {
    TAUT_EXPECTS(impl_->options.digits >= 1 && impl_->options.digits <= 9);
}

UsdaWriter::~UsdaWriter() = default;

void UsdaWriter::write(const view::FrameView& view) {
    Impl& w = *impl_;
    if (w.camera.isEmpty()) {
        w.first = view.frame;
        w.lights = farLightsOf(view);
        w.firstCamera = view.camera;
    }
    w.last = view.frame;
    const glm::mat4 eye = looking(view.camera.eye, view.camera.target - view.camera.eye, view.camera.up);
    w.camera.update(w.last, matrixText(eye), w.scratch);
    const float field = verticalField(view.camera, static_cast<float>(w.options.aspect));
    const double length = 0.5 * aperture / std::tan(0.5 * static_cast<double>(field));
    w.focalLength.update(w.last, fmt::format("{:.6g}", length), w.scratch);
    std::vector<std::string> seen;
    for (const Part& part : w.finder.partsOf(view)) {
        if (part.geometry->positions.empty()) continue;
        w.add(part);
        seen.push_back(part.identifier);
    }
    std::sort(seen.begin(), seen.end());
    for (Impl::Prim& prim : w.prims) {
        if (!prim.isThere || std::binary_search(seen.begin(), seen.end(), prim.part.identifier)) continue;
        prim.isThere = false;
        if (prim.visibility.isEmpty()) prim.visibility.set(w.first, "\"inherited\"", w.scratch);
        prim.visibility.set(w.last, "\"invisible\"", w.scratch);
    }
}

std::string UsdaWriter::Impl::head() const {
    return fmt::format(
        "#usda 1.0\n(\n"
        "    defaultPrim = \"scene\"\n"
        "    doc = \"Written by {}\"\n"
        "    endTimeCode = {}\n"
        "    framesPerSecond = {}\n"
        "    metersPerUnit = 1\n"
        "    startTimeCode = {}\n"
        "    timeCodesPerSecond = {}\n"
        "    upAxis = \"Y\"\n"
        ")\n\n"
        "def Xform \"scene\"\n{{\n",
        options.generator, last, options.fps, first, options.fps);
}

void UsdaWriter::Impl::put(const Prim& prim, UsdaText& to) const {
    to.add(fmt::format("    def Mesh \"{}\" (\n        prepend apiSchemas = [\"MaterialBindingAPI\"]\n    )\n    {{\n",
                       prim.part.identifier));
    to.add("        uniform bool doubleSided = 1\n");
    to.add("        uniform token subdivisionScheme = \"none\"\n");
    to.add("        uniform token orientation = \"rightHanded\"\n");
    to.add(fmt::format("        rel material:binding = </scene/materials/{}>\n", prim.material));
    prim.extent.write(to, 2, "float3[] extent");
    prim.counts.write(to, 2, "int[] faceVertexCounts");
    prim.indices.write(to, 2, "int[] faceVertexIndices");
    prim.points.write(to, 2, "point3f[] points");
    if (!prim.normals.isEmpty()) prim.normals.write(to, 2, "normal3f[] normals", "interpolation = \"vertex\"");
    prim.st.write(to, 2, "texCoord2f[] primvars:st", "interpolation = \"vertex\"");
    if (!prim.visibility.isEmpty()) prim.visibility.write(to, 2, "token visibility");
    prim.transform.write(to, 2, "matrix4d xformOp:transform");
    to.add("        uniform token[] xformOpOrder = [\"xformOp:transform\"]\n    }\n\n");
}

std::string UsdaWriter::Impl::materialText(const std::string& name, const view::Finish& finish) const {
    const std::string place = "/scene/materials/" + name;
    const bool hasImage = finish.pattern == view::Pattern::image && !finish.texture.empty();
    std::string diffuse = fmt::format("color3f inputs:diffuseColor = {}", colourText(finish.front));
    if (hasImage) diffuse = fmt::format("color3f inputs:diffuseColor.connect = <{}/image.outputs:rgb>", place);
    std::string out = fmt::format(
        "        def Material \"{0}\"\n        {{\n"
        "            token outputs:surface.connect = <{1}/surface.outputs:surface>\n\n"
        "            def Shader \"surface\"\n            {{\n"
        "                uniform token info:id = \"UsdPreviewSurface\"\n"
        "                {2}\n"
        "                float inputs:metallic = 0\n"
        "                float inputs:roughness = {3:.6g}\n"
        "                token outputs:surface\n"
        "            }}\n",
        name, place, diffuse, finish.roughness);
    if (hasImage) {
        std::error_code failed;
        std::filesystem::path image = std::filesystem::absolute(finish.texture, failed).lexically_normal();
        if (core::isFilePart(finish.texture)) {  // USD has no such names
            image = std::filesystem::absolute(path, failed).replace_extension().string() + "-" + name +
                    image.extension().string();
            core::writeWholeFile(image, core::filePartContent(finish.texture));
        }
        const auto beside = std::filesystem::relative(image, std::filesystem::absolute(path).parent_path(), failed);
        if (!failed && !beside.empty()) image = beside;
        out += fmt::format(
            "            def Shader \"image\"\n            {{\n"
            "                uniform token info:id = \"UsdUVTexture\"\n"
            "                asset inputs:file = @{0}@\n"
            "                float2 inputs:st.connect = <{1}/st.outputs:result>\n"
            "                token inputs:wrapS = \"repeat\"\n"
            "                token inputs:wrapT = \"repeat\"\n"
            "                color3f outputs:rgb\n"
            "            }}\n"
            "            def Shader \"st\"\n            {{\n"
            "                uniform token info:id = \"UsdPrimvarReader_float2\"\n"
            "                string inputs:varname = \"st\"\n"
            "                float2 outputs:result\n"
            "            }}\n",
            image.string(), place);
    }
    return out + "        }\n\n";
}

std::string UsdaWriter::Impl::tail() const {
    std::string out;
    std::set<std::string> names;
    for (const FarLight& light : lights) {
        std::string name = identifierOf(light.name);
        while (!names.insert(name).second) name += "_2";
        out += fmt::format(
            "    def DistantLight \"{}\"{}\n    {{\n"
            "        float inputs:angle = {:.6g}\n"
            "        color3f inputs:color = {}\n"
            "        float inputs:intensity = {:.6g}\n"
            "        bool inputs:normalize = 1\n{}"
            "        matrix4d xformOp:transform = {}\n"
            "        uniform token[] xformOpOrder = [\"xformOp:transform\"]\n    }}\n\n",
            name, light.shadow ? "" : " (\n        prepend apiSchemas = [\"ShadowAPI\"]\n    )",
            glm::degrees(light.softness), colourText(light.colour), light.brightness,
            light.shadow ? "" : "        bool inputs:shadow:enable = 0\n", matrixText(light.pose));
    }
    out += "    def Scope \"materials\"\n    {\n";
    for (const auto& [finish, name] : materials) out += materialText(name, *finish);
    return out + "    }\n}\n";
}

void UsdaWriter::finish() {
    Impl& w = *impl_;
    TAUT_EXPECTS(!w.camera.isEmpty());
    core::WholeFile file(w.path);
    UsdaText to(file, w.scratch);
    to.add(w.head());
    for (const Impl::Prim& prim : w.prims) w.put(prim, to);
    to.add(
        fmt::format("    def Camera \"camera\"\n    {{\n"
                    "        float2 clippingRange = ({:.6g}, {:.6g})\n"
                    "        float horizontalAperture = {:.6g}\n"
                    "        float verticalAperture = {:.6g}\n",
                    w.firstCamera.nearPlane, w.firstCamera.farPlane, aperture * w.options.aspect, aperture));
    w.focalLength.write(to, 2, "float focalLength");
    w.camera.write(to, 2, "matrix4d xformOp:transform");
    to.add("        uniform token[] xformOpOrder = [\"xformOp:transform\"]\n    }\n\n");
    to.add(w.tail());
    to.flush();
    file.commit();
    impl_.reset();
}

Format usdaFormat() {
    Format format{.name = "USD", .endings = {".usda"}, .readers = "Houdini, Omniverse, Unreal, Blender"};
    format.makeSink = [](const std::filesystem::path& path, const GeometryOptions& options) {
        return std::make_unique<UsdaWriter>(path, options);
    };
    format.mayTear = true;
    format.hasDigits = true;
    return format;
}

}  // namespace taut::geometry
