#include <gtest/gtest.h>

#include <algorithm>

#include "taut/mechanics/builders.h"
#include "taut/mechanics/private/index_runs.h"

namespace taut::mechanics {
namespace {

using Triangle = std::array<int, 3>;

// (elements) the corners that the lanes give to each element; -1 where it has none.
template <int Corners>
std::vector<std::array<int, Corners>> cornersByElement(const IndexRuns<Corners>& runs, std::size_t count) {
    std::array<int, Corners> none;
    none.fill(-1);
    std::vector<std::array<int, Corners>> found(count, none);
    const auto lanes = runs.lanes();
    auto store = [&](int lane, const std::array<int, Corners>& corners) {
        const int source = runs.sources()[lane];
        if (source >= 0) {
            EXPECT_EQ(found[source], none);
            found[source] = corners;
        }
    };
    std::array<int, Corners> corners;
    for (int r = 0; r < lanes.runCount; ++r)
        for (int l = 0; l < lanes.runs[r].count; ++l) {
            for (std::size_t c = 0; c < Corners; ++c) corners[c] = lanes.runs[r].first[c] + l;
            store(lanes.runs[r].lane + l, corners);
        }
    for (int l = 0; l < lanes.looseCount; ++l) {
        for (std::size_t c = 0; c < Corners; ++c) corners[c] = lanes.loosePoints[lanes.loose[c][l]];
        store(lanes.looseLane + l, corners);
    }
    return found;
}

TEST(IndexRuns, GridOfTrianglesIsTwoRuns) {
    ClothShape shape;
    shape.cells = {20, 13};
    const Model model = buildCloth(shape);
    const IndexRuns<3> runs{std::span<const Triangle>(model.triangles)};
    EXPECT_EQ(runs.lanes().runCount, 2);
    EXPECT_EQ(runs.lanes().looseCount, 0);
    EXPECT_EQ(cornersByElement(runs, model.triangles.size()), model.triangles);
}

TEST(IndexRuns, HoldEveryElementOnceWhateverTheirOrder) {
    ClothShape shape;
    shape.cells = {9, 9};
    const Model model = buildCloth(shape);
    for (std::size_t step : {1U, 5U, 7U, 11U}) {
        std::vector<Triangle> mixed;
        for (std::size_t k = 0; k < model.triangles.size(); ++k)
            mixed.push_back(model.triangles[step * k % model.triangles.size()]);
        mixed.push_back(mixed[4]);  // the same triangle twice is two
        const IndexRuns<3> runs{std::span<const Triangle>(mixed)};
        EXPECT_EQ(cornersByElement(runs, mixed.size()), mixed);
    }
}

TEST(IndexRuns, BlockOfCellsIsOneRun) {
    BlockShape shape;
    shape.cells = glm::ivec3(6);
    const Model model = buildBlock(shape);
    std::vector<std::array<int, 8>> cells;
    for (const VolumeCell& cell : model.cells) cells.push_back(cell.points);
    const IndexRuns<8> runs{std::span<const std::array<int, 8>>(cells)};
    EXPECT_EQ(runs.lanes().looseCount, 0);
    EXPECT_EQ(runs.lanes().runCount, 1);
    EXPECT_EQ(cornersByElement(runs, cells.size()), cells);
}

TEST(IndexRuns, OfNothingAreEmpty) {
    const IndexRuns<3> runs{std::span<const Triangle>()};
    EXPECT_EQ(runs.lanes().runCount, 0);
    EXPECT_EQ(runs.lanes().looseCount, 0);
    EXPECT_TRUE(runs.sources().empty());
}

}  // namespace
}  // namespace taut::mechanics
