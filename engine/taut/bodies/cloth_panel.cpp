#include "taut/bodies/private/cloth_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <set>

#include "taut/bodies/cloth.h"
#include "taut/core/trig.h"
#include "taut/fields/private/problems.h"
#include "taut/mechanics/panel_mesher.h"
#include "taut/spec/common_rows.h"

namespace taut::world {

using fields::FieldList;
using fields::Section;

namespace {

// The points of a ring from one of its corners on to another; from one to itself all, each once.
std::vector<int> wayAlong(const mechanics::PanelMesh& mesh, std::size_t ring, int from, int to) {
    const std::vector<int>& corners = mesh.corners[ring];
    const int end = corners[to];
    std::vector<int> points;
    int point = corners[from];
    do {
        points.push_back(point);
        if (++point == mesh.ringEnd(ring)) point = corners.front();
    } while (point != end);
    if (from != to) points.push_back(end);
    return points;
}

// Reports faults of the outline at the corner concerned.
void checkOutline(const fields::CheckInput& input, ClothSpec& cloth) {
    try {
        cloth.meshPanel();
    } catch (const mechanics::PanelFault& fault) {
        const auto ring = static_cast<std::size_t>(fault.ring), corner = static_cast<std::size_t>(fault.corner);
        const fields::Node* at = input.table.at("outline");
        if (ring > 0) at = input.table.at("holes")->items[ring - 1].at("outline");
        input.problems.addError(fault.corner < 0 ? at->place : at->items[corner].place, fault.what());
    }
}

void checkEdges(const fields::CheckInput& input, const ClothSpec& cloth) {
    std::set<std::string> names;
    for (std::size_t i = 0; i < cloth.edges.size(); ++i) {
        const ClothEdgeSpec& edge = cloth.edges[i];
        const fields::Node& item = input.table.at("edges")->items[i];
        const auto report = [&](const char* key, const std::string& message, const std::string& remedy) {
            if (const fields::Node* value = item.at(key)) input.problems.addError(value->place, message, remedy);
        };
        const std::string_view number = std::string_view(edge.name).substr(std::min<std::size_t>(edge.name.size(), 4));
        const bool isNumbered = !number.empty() && number.find_first_not_of("0123456789") == std::string_view::npos &&
                                (edge.name.starts_with("side") || edge.name.starts_with("hole"));
        const bool isOwn = edge.name == "all" || isNumbered;
        if (!fields::isName(edge.name) || isOwn)
            report("name", fmt::format("\"{}\" cannot be the name of an edge", edge.name),
                   isOwn ? "all, side0, side1, hole0 and so on are reserved" : "a name has letters, digits, - and _");
        else if (!names.insert(edge.name).second)
            report("name", fmt::format("there is an edge \"{}\" already", edge.name), "");
        const int last = static_cast<int>(cloth.corners.size()) - 1;
        if (std::max(edge.corners.x, edge.corners.y) > last)
            report("corners", fmt::format("the outline has the corners 0 … {}", last), "");
        else if (edge.corners.x == edge.corners.y)
            report("corners", "an edge leads from one corner to another",
                   "from the last corner to the first the edge continues around: [3, 0]");
    }
}

}  // namespace

Section panelHoleSection() {
    Section section;
    section.fields = FieldList<ClothHoleSpec>()
                         .places("outline", &ClothHoleSpec::corners, "m", placeRange, "Corners.")
                         .required()
                         .take();
    return section;
}

Section panelEdgeSection() {
    Section section;
    section.fields = FieldList<ClothEdgeSpec>()
                         .text("name", &ClothEdgeSpec::name, fields::Role::none, "Name for selectors.")
                         .required()
                         .vector("corners", &ClothEdgeSpec::corners, "", fields::Range{0.0, 1e6},
                                 "First and last corner, in the direction of the outline.")
                         .required()
                         .take();
    return section;
}

void checkPanel(const fields::CheckInput& input, ClothSpec& cloth) {
    checkOutline(input, cloth);
    checkEdges(input, cloth);
}

std::vector<ClothSpec::PanelEdge> ClothSpec::panelEdges() const {
    std::vector<PanelEdge> all;
    const int count = static_cast<int>(corners.size());
    for (int i = 0; i < count; ++i) all.push_back({fmt::format("side{}", i), 0, i, (i + 1) % count});
    for (std::size_t i = 0; i < holes.size(); ++i) all.push_back({fmt::format("hole{}", i), i + 1, 0, 0});
    for (const ClothEdgeSpec& edge : edges)
        if (std::max(edge.corners.x, edge.corners.y) < count)
            all.push_back({edge.name, 0, edge.corners.x, edge.corners.y});
    return all;
}

void ClothSpec::meshPanel() {
    mechanics::PanelShape shape;
    shape.rings.push_back(corners);
    for (const ClothHoleSpec& hole : holes) shape.rings.push_back(hole.corners);
    shape.cell = cell;
    shape.edges = sideEdges;
    // The outline has y up: a warp that turns towards down turns with the clock.
    const double c = core::cosine(grain), s = core::sine(grain);
    shape.along = {c, -s};
    const mechanics::PanelMesh made = mechanics::meshPanel(shape);

    auto data = std::make_shared<MeshData>();
    for (const dvec2& p : made.points) {
        data->positions.emplace_back(p, 0.0);
        data->uv.emplace_back(c * p.x - s * p.y, s * p.x + c * p.y);
    }
    data->triangles = made.triangles;
    const auto uvOf = [&](int i) { return data->uv[i]; };
    for (const auto& [i, j, k] : made.triangles) data->cornerUv.push_back({uvOf(i), uvOf(j), uvOf(k)});
    for (const PanelEdge& edge : panelEdges()) data->groups[edge.name] = wayAlong(made, edge.ring, edge.from, edge.to);
    meshData = std::move(data);
}

}  // namespace taut::world
