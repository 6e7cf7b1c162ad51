#include "taut/bodies/rope.h"

#include <algorithm>
#include <numeric>

#include "taut/body/body.h"
#include "taut/drawing/drawing.h"
#include "taut/fields/private/problems.h"
#include "taut/mechanics/builders.h"
#include "taut/spec/common_rows.h"
#include "taut/view/private/tube.h"

namespace taut::world {

RopeSpec::RopeSpec() {
    thickness = radius;
}
TAUT_VALUE_COPIES(RopeSpec);

using fields::Affects;
using fields::FieldList;
using fields::notNegative;
using fields::positive;
using fields::Range;
using fields::Section;

namespace {

constexpr int tubeSides = 10;
constexpr int tubeSubdivisions = 2;  // of ropes that are not smoothed further

// Draws a rope or its pieces. Each piece of a cut rope goes straight on beyond its last point up to the cut.
class RopeDrawing final : public BodyDrawing {
  public:
    RopeDrawing(const RopeSpec& spec, const Body& body)
        : name_(body.fullName()),
          radius_(static_cast<float>(spec.radius)),
          subdivisions_(tubeSubdivisions << spec.finish.smooth),
          finish_(finishOf(spec.finish)) {
        const mechanics::Model& model = body.model;
        double length = 0;
        for (const mechanics::Spring& s : model.springs)
            if (s.kind == mechanics::SpringKind::structural) length += s.restLength;
        order_ = orderOf(spec, body);
        const int last = static_cast<int>(order_.size()) - 1;
        const auto perSegment = static_cast<float>(length / last);
        Piece piece;
        for (int i = 0; i <= last; ++i) {
            const bool isSevered = i < last && body.damage.isSevered(point(i), point(i + 1));
            if (i < last && !isSevered) continue;
            piece.last = i;
            piece.after = isSevered ? static_cast<float>(body.damage.share(point(i), point(i + 1))) : 0.0F;
            addPiece(piece, perSegment);
            piece = {};
            piece.first = i + 1;
            piece.before = isSevered ? static_cast<float>(body.damage.share(point(i + 1), point(i))) : 0.0F;
        }
    }
    void addSurfaces(std::span<const glm::vec3> positions, std::vector<view::Surface>& surfaces) const override {
        for (const Piece& piece : pieces_) {
            std::vector<glm::vec3> line;
            const auto at = [&](int i) { return positions[point(i)]; };
            if (piece.before > 0)
                line.push_back(at(piece.first) + piece.before * (at(piece.first) - at(piece.first + 1)));
            for (int i = piece.first; i <= piece.last; ++i) line.push_back(at(i));
            if (piece.after > 0) line.push_back(at(piece.last) + piece.after * (at(piece.last) - at(piece.last - 1)));
            view::Surface surface;
            surface.name = name_;
            surface.topology = piece.topology;
            surface.geometry =
                std::make_shared<view::Geometry>(view::tubeGeometry(line, subdivisions_, tubeSides, radius_));
            surface.finish = finish_;
            surface.tubeRadius = radius_;
            surfaces.push_back(std::move(surface));
        }
    }

  private:
    struct Piece {
        int first = 0, last = 0;      // in order_
        float before = 0, after = 0;  // extra segments at its ends
        std::shared_ptr<const view::Topology> topology;
    };
    // The points from one end to the other. A ring starts at its first cut, whose point comes last again.
    static std::vector<int> orderOf(const RopeSpec& spec, const Body& body) {
        const int count = body.model.pointCount();
        std::vector<int> order(count);
        std::iota(order.begin(), order.end(), 0);
        if (!spec.isClosed) return order;
        for (int i = 0; i < count; ++i)
            if (body.damage.isSevered(i, (i + 1) % count)) {
                std::rotate(order.begin(), order.begin() + i, order.end());
                break;
            }
        order.push_back(order.front());
        return order;
    }
    int point(int i) const { return order_[i]; }
    void addPiece(Piece piece, float perSegment) {
        if (piece.last == piece.first) return;  // one point without a segment has no direction
        const int points = piece.last - piece.first + 1 + (piece.before > 0 ? 1 : 0) + (piece.after > 0 ? 1 : 0);
        const float segments = static_cast<float>(piece.last - piece.first) + piece.before + piece.after;
        piece.topology = std::make_shared<view::Topology>(
            view::tubeTopology(points, subdivisions_, tubeSides, perSegment * segments, radius_));
        pieces_.push_back(std::move(piece));
    }

    std::string name_;
    float radius_;
    int subdivisions_;  // of a segment
    std::shared_ptr<const view::Finish> finish_;
    std::vector<int> order_;  // points of the model in drawing order
    std::vector<Piece> pieces_;
};

Section ropePlaceSection() {
    Section section;
    section.fields = FieldList<RopePlaceSpec>()
                         .vector("position", &RopePlaceSpec::position, "m", placeRange, "Place.")
                         .required()
                         .take();
    return section;
}

}  // namespace

Section RopeSpec::section() {
    Section section;
    section.help = "A rope between two points, or a ring.";
    FieldList<RopeSpec> list;
    list.segment("ends", &RopeSpec::start, &RopeSpec::end, "The two ends.")
        .required()
        .whole("segments", &RopeSpec::segments, "", countRange, "Number of segments.")
        .number("length_m", &RopeSpec::length, "m", Range{0.0, 1e6},
                "Natural length; 0: the distance of the ends. A longer rope starts on its catenary.")
        .tables("through", &RopeSpec::through, ropePlaceSection(),
                "Places on the way between the ends: the rope follows a curve and has its length.")
        .flag("closed", &RopeSpec::isClosed,
              "Whether the ends are joined. `ends` are then the ends of a diameter of a level ring, or with `through` "
              "two places of a loop from the second back to the first.")
        .number("mass_kg", &RopeSpec::mass, "kg", positive, "Mass of the rope.")
        .number("stretch_N", &RopeSpec::stretch, "N", positive, "Stiffness EA: the force that doubles its length.")
        .ramps(Affects::springs)
        .number("bend_N", &RopeSpec::bend, "N", notNegative, "Stiffness of springs across two segments.")
        .ramps(Affects::springs);
    list.number("bending_rigidity_N_m2", &RopeSpec::rigidity, "N m²", positive,
                "Bending rigidity EI, for any number of segments.")
        .ramps(Affects::springs)
        .flag("rest_curved", &RopeSpec::isCurvedAtRest,
              "Whether the initial curve is the rest shape of bending; otherwise the rope is straight at rest.");
    section.fields =
        withPlasticity(withLosses(list))
            .number("radius", &RopeSpec::radius, "m", lengthRange, "Drawn radius, and the default of its thickness.")
            .choice("lumping", &RopeSpec::lumping, lumpingNames(),
                    "Distribution of mass: by length, or the same for every point.")
            .take();
    // Rules that concern several fields.
    section.check = [](const fields::CheckInput& input, void* target) {
        constexpr int leastOfRing = 3;
        auto& rope = *static_cast<RopeSpec*>(target);
        keepRadius(input, rope.radius, rope);
        if (!input.isClean) return;
        if (rope.start == rope.end && rope.through.empty())
            input.problems.addError(input.at("ends"), "the two ends are the same point");
        if (rope.isClosed && rope.segments < leastOfRing)
            input.problems.addError(input.at("segments"), "a closed rope has at least 3 segments");
        if (rope.isCurvedAtRest && !rope.rigidity)
            input.problems.addError(input.at("rest_curved"), "without a bending rigidity nothing keeps the curve",
                                    "give bending_rigidity_N_m2 too");
        if (rope.length > 0.0 && rope.isClosed)
            input.problems.addError(input.at("length_m"), "a closed rope is as long as its way round",
                                    "leave length_m out");
        else if (rope.length > 0.0 && !rope.through.empty())
            input.problems.addError(input.at("length_m"), "a rope with `through` is as long as its way",
                                    "leave length_m out");
    };
    return section;
}

mechanics::Model RopeSpec::build(const SceneSpec&) const {
    std::vector<dvec3> places;
    for (const RopePlaceSpec& place : through) places.push_back(place.position);
    return mechanics::buildRope({.start = start,
                                 .end = end,
                                 .segments = segments,
                                 .length = length,
                                 .through = std::move(places),
                                 .isClosed = isClosed,
                                 .mass = mass,
                                 .stretch = stretch,
                                 .bend = bend,
                                 .rigidity = rigidity.value_or(0.0),
                                 .isCurvedAtRest = isCurvedAtRest,
                                 .dampingTime = dampingTime,
                                 .dragRate = drag,
                                 .lumping = lumping});
}

std::unique_ptr<BodyDrawing> RopeSpec::drawing(const Body& body) const {
    return std::make_unique<RopeDrawing>(*this, body);
}

BodyOutline RopeSpec::outline(const SceneSpec&) const {
    BodyOutline outline;
    const double n = segments;
    outline.points = isClosed ? n : n + 1;
    outline.springs = bend > 0.0 ? 2.0 * n - (isClosed ? 0 : 1) : n;
    outline.isLine = true;
    outline.groups = mechanics::ropeGroups();
    return outline;
}

Kind<BodySpec> ropeKind() {
    return bodyKind<RopeSpec>();
}

}  // namespace taut::world
