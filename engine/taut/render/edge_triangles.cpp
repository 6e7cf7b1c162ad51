#include "taut/render/private/edge_triangles.h"

#include <algorithm>
#include <cmath>

#include "taut/render/private/edge_pass.h"

namespace taut::render {

namespace {

// What of a polygon lies in front of a plane: distances are linear along its sides.
struct Corner {
    glm::dvec4 clip;
    double before;  // [m] in front of the seen side
};

template <class Distance>
std::vector<Corner> cut(const std::vector<Corner>& polygon, Distance&& distance) {
    std::vector<Corner> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Corner& a = polygon[i];
        const Corner& b = polygon[(i + 1) % polygon.size()];
        const double da = distance(a), db = distance(b);
        if (da >= 0.0) kept.push_back(a);
        if ((da >= 0.0) == (db >= 0.0)) continue;
        const double t = da / (da - db);
        kept.push_back({a.clip + t * (b.clip - a.clip), a.before + t * (b.before - a.before)});
    }
    return kept;
}

glm::dvec3 onPicture(const glm::dvec4& clip, glm::ivec2 size) {
    const glm::dvec3 place = 0.5 + 0.5 * glm::dvec3(clip) / clip.w;
    return {place.x * size.x, place.y * size.y, place.z};
}

// The C library's is a call.
double floorOf(double x) {
    if (!(std::fabs(x) < 4e15)) return x;
    const auto whole = static_cast<double>(static_cast<std::int64_t>(x));
    return whole > x ? whole - 1.0 : whole;
}

double snapped(double x) {
    return floorOf(256.0 * x + 0.5) / 256.0;
}

}  // namespace

void EdgeTriangles::begin(const PixelBox& part, std::span<const PixelBox> tiles) {
    part_ = part;
    columns_ = (part.width + edgeTileSize - 1) / edgeTileSize;
    tiles_.clear();
    triangles_.clear();
    addTiles(tiles);
}

void EdgeTriangles::find(std::span<const DrawItem> items, const EdgeView& view, const PixelBox& part,
                         std::span<const PixelBox> tiles) {
    begin(part, tiles);
    for (std::size_t i = 0; i < items.size(); ++i)
        addItem(items[i], static_cast<std::uint32_t>(std::lround(255.0F * itemMark(i))), view);
    sortByTile();
}

void EdgeTriangles::find(std::span<const DrawItem> hidden, std::span<const DrawItem> others, const EdgeView& view,
                         const PixelBox& part, std::span<const PixelBox> tiles) {
    begin(part, tiles);
    for (std::size_t i = 0; i < hidden.size(); ++i) addItem(hidden[i], static_cast<std::uint32_t>(i + 1), view);
    for (const DrawItem& item : others) addItem(item, 0, view);
    sortByTile();
}

void EdgeTriangles::addTiles(std::span<const PixelBox> boxes) {
    const int rows = (part_.height + edgeTileSize - 1) / edgeTileSize;
    tileAt_.assign(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns_), -1);
    for (const PixelBox& box : boxes) {
        for (int y = 0; y < box.height; y += edgeTileSize) {
            for (int x = 0; x < box.width; x += edgeTileSize) {
                const int column = (box.x + x - part_.x) / edgeTileSize, row = (box.y + y - part_.y) / edgeTileSize;
                tileAt_[static_cast<std::size_t>(row * columns_ + column)] = static_cast<std::int32_t>(tiles_.size());
                tiles_.push_back({box.x + x, box.y + y, std::min(edgeTileSize, box.width - x),
                                  std::min(edgeTileSize, box.height - y)});
            }
        }
    }
}

void EdgeTriangles::addItem(const DrawItem& item, std::uint32_t mark, const EdgeView& view) {
    const view::Surface& surface = *item.surface;
    const std::vector<glm::vec3>& positions = surface.geometry->positions;
    const std::vector<std::uint32_t>& corners = surface.topology->triangles;
    const glm::mat4 toClip = view.viewProjection * surface.transform;
    const glm::vec4 side = view.seenSide * surface.transform;
    const auto cornerAt = [&](std::size_t i) {
        const glm::vec4 place(positions[i], 1.0F);
        return Corner{toClip * place, glm::dot(side, place)};
    };
    places_.resize(positions.size());
    needsCut_.resize(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const Corner corner = cornerAt(i);
        const glm::dvec4& clip = corner.clip;
        needsCut_[i] = clip.z < -clip.w || clip.w <= 0.0 || corner.before < 0.0 ? 1 : 0;
        if (needsCut_[i] == 0) places_[i] = onPicture(clip, view.size);
    }
    for (std::size_t t = 0; t + 2 < corners.size(); t += 3) {
        const std::uint32_t a = corners[t], b = corners[t + 1], c = corners[t + 2];
        const int outside = needsCut_[a] + needsCut_[b] + needsCut_[c];
        if (outside == 0) {
            addTriangle({places_[a], places_[b], places_[c]}, surface.twoSided, mark);
            continue;
        }
        std::vector<Corner> polygon = cut(
            {cornerAt(a), cornerAt(b), cornerAt(c)}, [](const Corner& p) { return p.clip.z + p.clip.w; });
        polygon = cut(polygon, [](const Corner& p) { return p.before; });
        for (std::size_t i = 2; i < polygon.size(); ++i) {
            addTriangle({onPicture(polygon[0].clip, view.size), onPicture(polygon[i - 1].clip, view.size),
                         onPicture(polygon[i].clip, view.size)},
                        surface.twoSided, mark);
        }
    }
}

void EdgeTriangles::addTriangle(const std::array<glm::dvec3, 3>& places, bool twoSided, std::uint32_t mark) {
    // Which tiles of the part may be covered, by its own box of pixels.
    glm::dvec2 low(places[0]), high(places[0]);
    for (const glm::dvec3& place : places) {
        low = glm::min(low, glm::dvec2(place));
        high = glm::max(high, glm::dvec2(place));
    }
    const double right = part_.x + part_.width - 1, upper = part_.y + part_.height - 1;
    if (!(high.x >= part_.x && high.y >= part_.y && low.x <= right + 1.0 && low.y <= upper + 1.0)) return;
    EdgeTriangle triangle;
    triangle.left = static_cast<int>(std::max(floorOf(low.x), static_cast<double>(part_.x)));
    triangle.low = static_cast<int>(std::max(floorOf(low.y), static_cast<double>(part_.y)));
    triangle.right = static_cast<int>(std::min(floorOf(high.x + 1.0 / 256.0), right));
    triangle.high = static_cast<int>(std::min(floorOf(high.y + 1.0 / 256.0), upper));
    const auto number = static_cast<std::uint32_t>(triangles_.size());
    const std::size_t before = pairs_.size();
    for (int row = (triangle.low - part_.y) / edgeTileSize; row <= (triangle.high - part_.y) / edgeTileSize; ++row) {
        for (int column = (triangle.left - part_.x) / edgeTileSize; column <= (triangle.right - part_.x) / edgeTileSize;
             ++column) {
            const std::int32_t tile = tileAt_[static_cast<std::size_t>(row * columns_ + column)];
            if (tile >= 0) pairs_.push_back({static_cast<std::uint32_t>(tile), number});
        }
    }
    if (pairs_.size() == before) return;

    for (std::size_t i = 0; i < 3; ++i) triangle.corners[i] = {snapped(places[i].x), snapped(places[i].y)};
    glm::dvec2 ab = triangle.corners[1] - triangle.corners[0];
    glm::dvec2 ac = triangle.corners[2] - triangle.corners[0];
    const double area = ab.x * ac.y - ab.y * ac.x;
    if (area == 0.0 || (area < 0.0 && !twoSided)) {
        pairs_.resize(before);
        return;
    }
    const double rise = places[1].z - places[0].z, riseOther = places[2].z - places[0].z;
    triangle.depthAlong = (rise * ac.y - riseOther * ab.y) / area;
    triangle.depthUp = (riseOther * ab.x - rise * ac.x) / area;
    triangle.depth =
        places[0].z - triangle.depthAlong * triangle.corners[0].x - triangle.depthUp * triangle.corners[0].y;
    if (area < 0.0) std::swap(triangle.corners[1], triangle.corners[2]);
    triangle.mark = mark;
    triangles_.push_back(triangle);
}

// Counting: what was drawn first stays first.
void EdgeTriangles::sortByTile() {
    first_.assign(tiles_.size() + 1, 0);
    for (const auto& [tile, triangle] : pairs_) ++first_[tile + 1];
    for (std::size_t i = 0; i < tiles_.size(); ++i) first_[i + 1] += first_[i];
    covering_.resize(pairs_.size());
    next_.assign(first_.begin(), first_.end() - 1);
    for (const auto& [tile, triangle] : pairs_) covering_[next_[tile]++] = triangle;
    pairs_.clear();
}

}  // namespace taut::render
