#include "taut/bodies/island_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include "taut/bodies/joints/constraint.h"
#include "taut/bodies/joints/joints.h"
#include "taut/bodies/joints/mounting.h"
#include "taut/bodies/private/joints/pins.h"
#include "taut/bodies/private/rigid_constraint.h"
#include "taut/bodies/private/seam_pairing.h"
#include "taut/bodies/private/solid_places.h"
#include "taut/bodies/private/strain_limit.h"
#include "taut/bodies/private/ties.h"
#include "taut/core/error.h"
#include "taut/core/rigid_motion.h"
#include "taut/mechanics/bending.h"
#include "taut/spec/spec.h"
#include "taut/spec/targets.h"

namespace taut::world {

TAUT_VALUE_MEMBERS(Grip);
TAUT_VALUE_MEMBERS(IslandPlan);
TAUT_VALUE_MEMBERS(JointReport);
namespace {

using core::Error;
using core::ErrorKind;

// Disjoint sets with path halving. The smallest member represents its set.
class Sets {
  public:
    explicit Sets(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0); }
    int find(int i) {
        while (parent_[static_cast<std::size_t>(i)] != i) {
            int& up = parent_[static_cast<std::size_t>(i)];
            up = parent_[static_cast<std::size_t>(up)];
            i = up;
        }
        return i;
    }
    void unite(int a, int b) {
        a = find(a);
        b = find(b);
        parent_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }

  private:
    std::vector<int> parent_;
};

struct PointRef {
    int body;
    int point;
};

struct JointPair {
    Spot a, b;  // in global numbers of points
    const JointSpec* spec;
    int number;       // of the scene's joints
    double distance;  // [m]
};

class Planner {
  public:
    Planner(std::span<Body* const> bodies, const SceneSpec& spec)
        : bodies_(bodies),
          spec_(spec),
          islands_(bodies.size()),
          solids_(bodies.size()),
          firstGlobal_(firsts(bodies)),
          welds_(firstGlobalEnd()) {
        int number = 0;
        const std::vector<std::array<Row, 2>> rows = rowsOfSeams();
        auto next = rows.begin();
        for (const JointSpec& joint : spec.joints) {
            if (joint.isSeam())
                addSeam(joint, number, *next++);
            else if (!isTie(joint))
                addJoint(joint, number);
            ++number;
        }
        for (Body* body : bodies) body->seamCorners.clear();
        markSeamCorners();
    }

    std::vector<IslandPlan> plans() {
        std::vector<std::vector<int>> members(bodies_.size());  // by the body that represents the set
        for (int body = 0; body < static_cast<int>(bodies_.size()); ++body)
            members[static_cast<std::size_t>(islands_.find(body))].push_back(body);
        std::vector<std::vector<JointPair>> joints(bodies_.size());
        for (const JointPair& joint : joints_)
            joints[static_cast<std::size_t>(islands_.find(refOf(joint.a.nearest()).body))].push_back(joint);
        std::vector<int> numberOf(firstGlobalEnd(), -1);  // by the global point that represents a weld
        std::vector<IslandPlan> plans;
        for (std::size_t root = 0; root < members.size(); ++root)
            if (!members[root].empty()) plans.push_back(plan(members[root], joints[root], numberOf));
        return plans;
    }

    const std::vector<JointReport>& reports() const { return reports_; }

  private:
    static std::vector<int> firsts(std::span<Body* const> bodies) {
        std::vector<int> first;
        int count = 0;
        for (const Body* body : bodies) {
            first.push_back(count);
            count += body->model.pointCount();
        }
        return first;
    }

    int global(PointRef p) const { return firstGlobal_[static_cast<std::size_t>(p.body)] + p.point; }
    PointRef refOf(int global) const {
        const auto after = std::upper_bound(firstGlobal_.begin(), firstGlobal_.end(), global);
        return {static_cast<int>(after - firstGlobal_.begin()) - 1, global - after[-1]};
    }
    Body& body(int i) const { return *bodies_[static_cast<std::size_t>(i)]; }
    dvec3 position(PointRef p) const { return body(p.body).model.positions[static_cast<std::size_t>(p.point)]; }

    // Each point once; those of one target in the order of its bodies.
    std::vector<PointRef> points(const JointSide& side, const Source& source) const {
        std::vector<PointRef> found;
        for (const std::string& text : side.targets) {
            const std::size_t before = found.size();
            for (int number = 0; number < static_cast<int>(bodies_.size()); ++number)
                if (names(text, body(number)))
                    for (int i : selectPoints(body(number).model, parseTarget(text).selector))
                        found.push_back({number, i});
            if (found.size() == before)
                throw Error(ErrorKind::badContent, at(source) + "\"" + text + "\" names no point");
        }
        if (side.targets.size() < 2) return found;
        std::vector<PointRef> once;
        std::vector<bool> isMet(firstGlobalEnd(), false);
        for (const PointRef& p : found)
            if (!isMet[static_cast<std::size_t>(global(p))]) {
                isMet[static_cast<std::size_t>(global(p))] = true;
                once.push_back(p);
            }
        return once;
    }

    // A side of a seam: its edges one after the other.
    struct Row {
        std::vector<PointRef> points;
        SewnEdge edge;
        double longest = 0;  // [m] from a point to the next
        double gap = 0;      // [m] between two edges one after the other, the largest that no seam closes
        double length() const { return std::accumulate(edge.steps.begin(), edge.steps.end(), 0.0); }
        void addStep(double length) {
            edge.steps.push_back(length);
            longest = std::max(longest, length);
        }
    };

    bool isHeld(const Spot& spot) const {
        return std::all_of(
            spot.shares().begin(), spot.shares().end(),
            [&](const Spot::Share& own) {
                const PointRef p = refOf(own.point);
                const std::vector<int>& carried = body(p.body).carried;
                return body(p.body).model.held[static_cast<std::size_t>(p.point)] ||
                       std::binary_search(carried.begin(), carried.end(), p.point);
            });
    }

    double distance(PointRef a, PointRef b) const {
        const dvec3 d = position(b) - position(a);
        return std::sqrt(glm::dot(d, d));
    }

    // The points of one edge, from one end to the other or around.
    std::vector<PointRef> edge(const std::string& target, const Source& source, bool& isClosed) const {
        const std::vector<PointRef> named = points(target, source);
        std::vector<int> own;
        for (const PointRef& p : named) {
            if (p.body != named.front().body)
                throw Error(ErrorKind::badContent,
                            at(source) + "\"" + target +
                                "\" names edges of several bodies; name them in a list, as they follow each other");
            own.push_back(p.point);
        }
        const Line line = lineOf(body(named.front().body).model, own);
        isClosed = line.isClosed;
        std::vector<PointRef> found;
        for (const int i : line.points) found.push_back({named.front().body, i});
        if (found.empty())
            throw Error(ErrorKind::badContent,
                        at(source) + "\"" + target +
                            "\" is no edge to sew: its points are not one line; name a part of it, as @left of a "
                            "cloth");
        return found;
    }

    // Each edge goes on from the end that lies nearest to the one before. What is between them has no length. Whether
    // other seams close it is not known here.
    Row row(const JointSide& side, const Source& source) const {
        std::vector<std::vector<PointRef>> edges;
        bool isClosed = false;
        for (const std::string& target : side.targets) {
            edges.push_back(edge(target, source, isClosed));
            if (isClosed && side.targets.size() > 1)
                throw Error(ErrorKind::badContent,
                            at(source) + "\"" + target + "\" is closed, so no edge follows it; name it alone");
        }
        const auto reach = [&](PointRef end, const std::vector<PointRef>& next) {
            return std::min(distance(end, next.front()), distance(end, next.back()));
        };
        std::vector<PointRef>& first = edges.front();
        if (edges.size() > 1 && reach(first.front(), edges[1]) < reach(first.back(), edges[1]))
            std::reverse(first.begin(), first.end());
        Row row;
        for (std::vector<PointRef>& next : edges) {
            if (!row.points.empty()) {
                const PointRef last = row.points.back();
                if (distance(last, next.back()) < distance(last, next.front())) std::reverse(next.begin(), next.end());
                if (global(last) == global(next.front()))
                    row.points.pop_back();
                else
                    row.addStep(0.0);
            }
            for (std::size_t i = 0; i < next.size(); ++i) {
                if (i > 0) row.addStep(distance(next[i - 1], next[i]));
                row.points.push_back(next[i]);
            }
        }
        if (global(row.points.front()) == global(row.points.back()))
            row.points.pop_back();
        else if (isClosed)
            row.addStep(distance(row.points.back(), row.points.front()));
        for (const PointRef& p : row.points) row.edge.places.push_back(position(p));
        return row;
    }

    // The rows of all seams. One is closed, too, if other seams bring its ends together.
    std::vector<std::array<Row, 2>> rowsOfSeams() const {
        std::vector<std::array<Row, 2>> rows;
        Sets meets(firstGlobalEnd());
        for (const JointSpec& seam : spec_.joints) {
            if (!seam.isSeam()) continue;
            rows.push_back({row(seam.a, seam.source), row(seam.b, seam.source)});
            const auto& [a, b] = rows.back();
            if (a.edge.isClosed() || b.edge.isClosed()) continue;
            const auto isEnd = [](const Spot& spot, const Row& row) {
                return spot.isPoint() &&
                       (spot.nearest() == 0 || spot.nearest() + 1 == static_cast<int>(row.points.size()));
            };
            for (const auto& [i, j] : pairedByLength(a.edge, b.edge))
                if (isEnd(i, a) && isEnd(j, b))
                    meets.unite(global(a.points[static_cast<std::size_t>(i.nearest())]),
                                global(b.points[static_cast<std::size_t>(j.nearest())]));
        }
        for (std::array<Row, 2>& sides : rows)
            for (Row& row : sides) {
                for (std::size_t k = 0; k + 1 < row.points.size(); ++k)
                    if (const PointRef here = row.points[k], next = row.points[k + 1];
                        row.edge.steps[k] == 0.0 && meets.find(global(here)) != meets.find(global(next)))
                        row.gap = std::max(row.gap, distance(here, next));
                if (!row.edge.isClosed() && row.points.size() > 2 &&
                    meets.find(global(row.points.front())) == meets.find(global(row.points.back())))
                    row.addStep(0.0);
            }
        return rows;
    }

    void addSeam(const JointSpec& seam, int ofScene, const std::array<Row, 2>& rows) {
        const auto& [as, bs] = rows;
        // Points that are paired with points are half of a step aside at most.
        const double reach = seam.reach() + 0.5 * std::max(as.longest, bs.longest);
        JointReport& report = reports_.emplace_back();
        report.spec = &seam;
        report.sewn = {{as.length(), bs.length()}, std::max(as.gap, bs.gap)};
        std::map<std::pair<int, int>, int> sewn;  // by bodies: number of points
        for (const auto& [i, j] : pairedByLength(as.edge, bs.edge)) {
            const auto globalOf = [&](const Row& row) {
                return [&](int k) { return global(row.points[static_cast<std::size_t>(k)]); };
            };
            const Spot a = i.renumbered(globalOf(as)), b = j.renumbered(globalOf(bs));
            const PointRef first = refOf(a.nearest()), second = refOf(b.nearest());
            if (a.has(b.nearest()) || b.has(a.nearest())) continue;  // where two edges of one body meet
            const dvec3 way = j.of(bs.edge.places) - i.of(as.edge.places);
            const double apart = std::sqrt(glm::dot(way, way));
            if (apart > reach)
                throw Error(ErrorKind::badContent, at(seam.source) + "the seam \"" + seam.a.text() + "\" – \"" +
                                                       seam.b.text() + "\" starts " + std::to_string(apart) +
                                                       " m apart; give the time to close, e.g. over_s = 1.0");
            if (seam.isWeld()) report.jump = std::max(report.jump, apart);
            report.sewn.apart = std::max(report.sewn.apart, apart);
            if (apart > WeldJoint().furthest && isHeld(a) && isHeld(b)) ++report.sewn.heldApart;
            ++sewn[{first.body, second.body}];
            islands_.unite(first.body, second.body);
            sewn_.push_back({a, b});
            const bool merges = seam.isWeld() && first.body != second.body && !seam.hasOwnTies();
            if (merges && a.isPoint() && b.isPoint())
                welds_.unite(a.nearest(), b.nearest());
            else
                joints_.push_back({a, b, &seam, ofScene, apart});
        }
        if (sewn.empty())
            throw Error(ErrorKind::badContent,
                        at(seam.source) + "the seam sews \"" + seam.a.text() + "\" to itself; name two edges");
        for (const auto& [numbers, count] : sewn)
            report.pairs.push_back({&body(numbers.first), &body(numbers.second), count});
    }

    // Borders that are sewn are one curve, also where each is drawn as a smooth one, if both go the same way from point
    // to point. Where one turns off, as at a seam's end, where three are sewn, or at a corner of one, both have a
    // corner, and where points of one edge are tied between those of the other.
    void markSeamCorners() {
        Sets one(firstGlobalEnd());
        std::vector<PointRef> between;  // on the straight part of an edge that is sewn to a point there
        for (const auto& [a, b] : sewn_)
            if (a.isPoint() && b.isPoint())
                one.unite(a.nearest(), b.nearest());
            else
                for (const Spot* end : {&a, &b})
                    for (const Spot::Share& own : end->shares()) between.push_back(refOf(own.point));
        std::map<int, std::vector<std::vector<int>>> borders;  // by body
        const auto beside = [&](PointRef p) -> const std::vector<int>& {
            const auto [found, isNew] = borders.try_emplace(p.body);
            if (isNew) found->second = borderNeighbours(body(p.body).model);
            return found->second[static_cast<std::size_t>(p.point)];
        };
        const auto turns = [&](PointRef p) {
            constexpr double most = 0.5;  // the cosine of what a curve may turn by
            const std::vector<int>& ends = beside(p);
            if (ends.size() != 2) return true;
            const dvec3 in = position(p) - position({p.body, ends[0]}), out = position({p.body, ends[1]}) - position(p);
            return glm::dot(in, out) < most * std::sqrt(glm::dot(in, in) * glm::dot(out, out));
        };
        const auto ways = [&](PointRef p) {
            std::set<int> found;
            for (const int i : beside(p)) found.insert(one.find(global({p.body, i})));
            return found;
        };
        std::map<int, std::vector<PointRef>> members;
        for (const auto& [a, b] : sewn_)
            for (const int number : {a.nearest(), b.nearest()}) {
                if (!a.isPoint() || !b.isPoint()) continue;
                const PointRef p = refOf(number);
                std::vector<PointRef>& own = members[one.find(number)];
                if (std::none_of(own.begin(), own.end(), [&](const PointRef& o) { return global(o) == global(p); }))
                    own.push_back(p);
            }
        for (const auto& entry : members) {
            const std::vector<PointRef>& own = entry.second;
            const bool isCorner = own.size() > 2 || std::any_of(own.begin(), own.end(), [&](const PointRef& p) {
                                      return turns(p) || ways(p) != ways(own.front());
                                  });
            for (const PointRef& p : own)
                if (isCorner) body(p.body).seamCorners.push_back(p.point);
        }
        for (const PointRef& p : between) body(p.body).seamCorners.push_back(p.point);
        for (Body* body : bodies_) std::sort(body->seamCorners.begin(), body->seamCorners.end());
    }

    // The bodies that a side names as a whole, if all are rigid; else none.
    std::vector<int> wholeSolids(const JointSide& side) const {
        std::vector<int> found;
        for (int number = 0; number < static_cast<int>(bodies_.size()); ++number)
            for (const std::string& text : side.targets) {
                if (!names(text, body(number))) continue;
                const std::string selector = parseTarget(text).selector;
                if ((!selector.empty() && selector != "all") || !body(number).spec->isRigid()) return {};
                found.push_back(number);
                break;
            }
        return found;
    }

    // Each solid of one side and the nearest of the other become one rigid body.
    void uniteSolids(const JointSpec& weld, const std::vector<int>& as, const std::vector<int>& bs) {
        if (weld.hasOwnTies())
            throw Error(ErrorKind::badContent,
                        at(weld.source) +
                            "a weld of whole solids makes one rigid body of them, which nothing parts or "
                            "draws: leave out name, break_N and finish, or name points");
        JointReport& report = reports_.emplace_back();
        report.spec = &weld;
        const auto centre = [&](int number) {
            const mechanics::Model& model = body(number).model;
            return core::rigidMotionOf(model.masses, model.positions, model.velocities).centre;
        };
        for (const int a : as) {
            int nearest = -1;
            double least = HUGE_VAL;
            for (const int b : bs)
                if (const double away = glm::distance(centre(a), centre(b)); b != a && away < least)
                    nearest = b, least = away;
            if (nearest < 0)
                throw Error(ErrorKind::badContent,
                            at(weld.source) + "the weld joins \"" + weld.a.text() + "\" to itself; name two solids");
            islands_.unite(a, nearest);
            solids_.unite(a, nearest);
            report.pairs.push_back({&body(a), &body(nearest), body(a).model.pointCount()});
        }
    }

    // Solids carry the points of a side where they are, each that which has the nearest point.
    void carryBySolids(const JointSpec& weld, const JointSide& side, const std::vector<int>& solids) {
        JointReport& report = reports_.emplace_back();
        report.spec = &weld;
        std::map<std::pair<int, int>, int> pairs;  // by bodies: number of carried points
        for (const PointRef& point : points(side, weld.source)) {
            int nearest = -1;
            double least = HUGE_VAL;
            for (const int solid : solids)
                for (const dvec3& corner : body(solid).model.positions)
                    if (const double away = glm::distance(position(point), corner); away < least)
                        nearest = solid, least = away;
            islands_.unite(point.body, nearest);
            carried_.push_back({point, nearest});
            ++pairs[{point.body, nearest}];
        }
        for (const auto& [numbers, count] : pairs)
            report.pairs.push_back({&body(numbers.first), &body(numbers.second), count});
    }

    // An end that a side of a joint gives, in global numbers of points.
    struct JointEnd {
        Spot spot;
        int body;
        dvec3 place;  // [m]
    };
    // The bodies of the first side that is whole bodies, in the axes of which the place of a joint is.
    struct PlacedSide {
        bool isA;
        std::vector<int> bodies;
    };
    PlacedSide placedSide(const JointSpec& joint) const {
        for (const bool isA : {true, false}) {
            const JointSide& side = isA ? joint.a : joint.b;
            PlacedSide placed{isA, {}};
            for (int number = 0; number < static_cast<int>(bodies_.size()); ++number)
                if (isWhole(side) && names(side, body(number))) placed.bodies.push_back(number);
            if (!placed.bodies.empty()) return placed;
        }
        throw Error(ErrorKind::badContent,
                    at(joint.source) +
                        "place is on a side that is a whole body, and both sides of this joint name points of theirs; "
                        "leave the selector of one out, or leave place out");
    }

    // The place of a joint on a body of its placed side, and the axes of that.
    collision::Frame frameOf(const JointSpec& joint, int number) const {
        collision::Frame frame = body(number).axes;
        frame.position = frame.toWorld(*joint.place);
        return frame;
    }

    // What ends at `place` [m] if it is a whole body, else its points and places by name.
    std::vector<JointEnd> ends(const JointSide& side, const JointSpec& joint, const std::optional<dvec3>& place) const {
        const bool isAtPlace = place && isWhole(side);
        std::vector<JointEnd> found;
        for (int number = 0; number < static_cast<int>(bodies_.size()) && isAtPlace; ++number)
            if (names(side, body(number))) found.push_back({spotOf(number, *place), number, *place});
        if (isAtPlace && !found.empty()) return found;
        for (const std::string& target : side.targets) {
            const std::string selector = parseTarget(target).selector;
            for (int number = 0; number < static_cast<int>(bodies_.size()); ++number)
                if (const auto named = names(target, body(number)) && selectPoints(body(number).model, selector).empty()
                                           ? placeNamed(body(number), selector)
                                           : std::nullopt)
                    found.push_back({spotOf(number, *named), number, *named});
        }
        if (!found.empty() && !joint.tiesPlaces() && !joint.isMounted())
            throw Error(ErrorKind::badContent, at(joint.source) + std::string(joint.title()) +
                                                   " ties points of bodies, and \"" + side.text() +
                                                   "\" is a place between them; name points, such as a corner");
        if (found.empty())
            for (const PointRef& p : points(side, joint.source)) found.push_back({global(p), p.body, position(p)});
        return found;
    }

    // In global numbers; of a body that is not rigid the nearest point.
    Spot spotOf(int number, const dvec3& place) const {
        const mechanics::Model& model = body(number).model;
        const auto globalOf = [&](int i) { return global({number, i}); };
        if (body(number).spec->isRigid()) return spotAt(body(number), place).renumbered(globalOf);
        const auto distanceTo = [&](const dvec3& x) { return glm::dot(x - place, x - place); };
        const auto nearest =
            std::min_element(model.positions.begin(), model.positions.end(),
                             [&](const dvec3& x, const dvec3& other) { return distanceTo(x) < distanceTo(other); });
        return globalOf(static_cast<int>(nearest - model.positions.begin()));
    }

    // A tie at the place on each body of the placed side, to the one other end.
    void addMounted(const JointSpec& joint, int ofScene) {
        if (!joint.place)
            throw Error(ErrorKind::badContent, at(joint.source) + std::string(joint.title()) + " needs a place");
        JointReport& report = reports_.emplace_back();
        report.spec = &joint;
        const auto [isA, own] = placedSide(joint);
        const JointSide& side = isA ? joint.b : joint.a;
        for (const int number : own) {
            const dvec3 place = frameOf(joint, number).position;
            const std::vector<JointEnd> others = ends(side, joint, place);
            if (others.size() != 1)
                throw Error(ErrorKind::badContent, at(joint.source) + std::string(joint.title()) +
                                                       " ties bodies to one other at a place, and \"" + side.text() +
                                                       "\" are " + std::to_string(others.size()) +
                                                       " places; name one whole body, or one point");
            const JointEnd end{spotOf(number, place), number, place}, &other = others.front();
            const JointEnd &a = isA ? end : other, &b = isA ? other : end;
            islands_.unite(a.body, b.body);
            report.pairs.push_back({&body(a.body), &body(b.body), 1});
            joints_.push_back({a.spot, b.spot, &joint, ofScene, 0.0});
            const dvec3 there = body(other.body).spec->isRigid() ? other.place : position(refOf(other.spot.nearest()));
            report.jump = std::max(report.jump, std::sqrt(glm::dot(there - place, there - place)));
        }
    }

    Mounting mountingOf(const JointPair& pair) const {
        Mounting mounting;
        const auto end = [this](const Spot& spot) {
            return [this, spot](const dvec3& place) {
                const int number = refOf(spot.nearest()).body;
                const Spot there = body(number).spec->isRigid() ? spotOf(number, place) : spot;
                return there.renumbered([&](int global) { return pointOf(refOf(global)); });
            };
        };
        mounting.a = end(pair.a);
        mounting.b = end(pair.b);
        const Spot& placed = placedSide(*pair.spec).isA ? pair.a : pair.b;
        mounting.at = frameOf(*pair.spec, refOf(placed.nearest()).body);
        mounting.size = 0.5 * sizeOf(body(refOf(pair.a.nearest()).body));
        return mounting;
    }

    // Over 60 lines: it ties each point of one side to the nearest of the other, and reports what it did not tie.
    void addJoint(const JointSpec& joint, int ofScene) {
        if (joint.isMounted()) return addMounted(joint, ofScene);
        if (joint.isWeld() && !joint.place) {
            const std::vector<int> solidsOfA = wholeSolids(joint.a), solidsOfB = wholeSolids(joint.b);
            if (!solidsOfA.empty() && !solidsOfB.empty()) return uniteSolids(joint, solidsOfA, solidsOfB);
            if (!joint.hasOwnTies() && solidsOfA.empty() != solidsOfB.empty())
                return carryBySolids(joint, solidsOfA.empty() ? joint.a : joint.b,
                                     solidsOfA.empty() ? solidsOfB : solidsOfA);
        }
        std::optional<dvec3> place;
        if (joint.place) {
            const PlacedSide placed = placedSide(joint);
            if (placed.bodies.size() > 1)
                throw Error(ErrorKind::badContent, at(joint.source) + "\"" + (placed.isA ? joint.a : joint.b).text() +
                                                       "\" names several bodies, and place is in the axes of one; "
                                                       "write a [[joint]] for each");
            place = frameOf(joint, placed.bodies.front()).position;
        }
        std::vector<JointEnd> as = ends(joint.a, joint, place), bs = ends(joint.b, joint, place);
        if (place && !joint.isWeld() && as.size() < bs.size()) std::swap(as, bs);  // all go to the place
        const auto isOther = [&](const JointEnd& end) { return end.body != as.front().body; };
        const bool isOneBody =
            std::none_of(as.begin(), as.end(), isOther) && std::none_of(bs.begin(), bs.end(), isOther);
        const bool mayTieWithin = isOneBody || joint.tiesWithin();
        const bool merges = joint.isWeld() && !isOneBody && !joint.hasOwnTies();
        JointReport& report = reports_.emplace_back();
        report.spec = &joint;
        std::map<std::pair<int, int>, int> pairs;  // by bodies: number of joined points
        std::map<int, double> reached;             // by body: distance to the nearest point of the other side [m]
        for (const JointEnd& b : bs) reached.emplace(b.body, HUGE_VAL);
        int made = 0;
        double nearest = HUGE_VAL;
        for (const JointEnd& a : as) {
            std::size_t best = bs.size();
            double bestDistance = HUGE_VAL;
            double& ownReach = reached.emplace(a.body, HUGE_VAL).first->second;
            for (std::size_t i = 0; i < bs.size(); ++i) {
                const dvec3 d = bs[i].place - a.place;
                const double distance = std::sqrt(glm::dot(d, d));
                if (bs[i].body == a.body && (!mayTieWithin || bs[i].spot == a.spot)) continue;
                double& otherReach = reached.at(bs[i].body);
                otherReach = std::min(otherReach, distance);
                if (distance < bestDistance) {
                    best = i;
                    bestDistance = distance;
                }
            }
            nearest = std::min(nearest, bestDistance);
            ownReach = std::min(ownReach, bestDistance);
            if (best == bs.size() || bestDistance > joint.reach()) continue;
            islands_.unite(a.body, bs[best].body);
            ++pairs[{a.body, bs[best].body}];
            ++made;
            // Points of two rigid bodies stay two: all that is held of these is found at once.
            const Spot& b = bs[best].spot;
            if (merges && a.spot.isPoint() && b.isPoint() &&
                !(body(a.body).spec->isRigid() && body(bs[best].body).spec->isRigid()))
                welds_.unite(a.spot.nearest(), b.nearest());
            else
                joints_.push_back({a.spot, b, &joint, ofScene, bestDistance});
            if (!joint.isWeld()) continue;
            report.jump = std::max(report.jump, bestDistance);
            bs.erase(bs.begin() + static_cast<std::ptrdiff_t>(best));
        }
        if (made == 0) {
            const std::string why = std::isfinite(nearest)
                                        ? "the nearest two points are " + std::to_string(nearest) +
                                              " m apart, more than reach_m = " + std::to_string(joint.reach()) +
                                              "; move the bodies together, or use kind = \"spring\""
                                        : "both sides are the same point";
            throw Error(ErrorKind::badContent, at(joint.source) + "the joint \"" + joint.a.text() + "\" – \"" +
                                                   joint.b.text() + "\" joins nothing: " + why);
        }
        for (const auto& [numbers, points] : pairs)
            report.pairs.push_back({&body(numbers.first), &body(numbers.second), points});
        for (const auto& [number, distance] : reached) {
            const Body* named = &body(number);
            if (std::none_of(report.pairs.begin(), report.pairs.end(),
                             [&](const auto& pair) { return pair.a == named || pair.b == named; }))
                report.loose.emplace_back(named, distance);
        }
    }

    IslandPlan plan(const std::vector<int>& members, const std::vector<JointPair>& joints, std::vector<int>& numberOf) {
        IslandPlan plan;
        for (int body : members) addBody(plan, body, numberOf);
        const std::vector<int> solidOf = solidsOf(plan, members);
        for (const bool isWeld : {true, false})  // welds first, as they move points
            for (const JointPair& joint : joints)
                if (joint.spec->isWeld() == isWeld) tie(plan, joint, solidOf);
        Pins::settle(plan);
        addSolids(plan, members);
        plan.origins.resize(plan.springs.size());
        plan.broken.resize(plan.springs.size(), false);
        if (StrainLimit::isIn(plan)) plan.constraints.push_back(std::make_shared<StrainLimit>(plan));
        plan.solver = solverOf(plan);
        return plan;
    }

    void addSolids(IslandPlan& plan, const std::vector<int>& members) {
        std::map<int, std::vector<const Body*>> solids;  // by the body that represents them
        for (const int number : members)
            if (body(number).spec->isRigid()) solids[solids_.find(number)].push_back(&body(number));
        for (auto& [number, parts] : solids) {
            std::vector<int> points;
            std::vector<dvec3> rest;
            for (const Body* part : parts) {
                points.insert(points.end(), part->pointOf.begin(), part->pointOf.end());
                for (int i = 0; i < part->model.pointCount(); ++i)
                    rest.push_back(part->model.positions[static_cast<std::size_t>(i)] - jitterOf(*part, i));
            }
            for (const auto& [point, solid] : carried_) {
                const int carried = solids_.find(solid) == number ? pointOf(point) : -1;
                if (carried < 0 || std::find(points.begin(), points.end(), carried) != points.end()) continue;
                points.push_back(carried);
                rest.push_back(position(point) - jitterOf(body(point.body), point.point));
            }
            plan.constraints.push_back(std::make_shared<RigidConstraint>(std::move(points), std::move(rest)));
            plan.solids.push_back(std::move(parts));
        }
    }

    // (points) the solid that moves each, -1: none.
    std::vector<int> solidsOf(const IslandPlan& plan, const std::vector<int>& members) {
        std::vector<int> solidOf(plan.points.size(), -1);
        for (const int number : members)
            if (body(number).spec->isRigid())
                for (const int point : body(number).pointOf)
                    solidOf[static_cast<std::size_t>(point)] = solids_.find(number);
        for (const auto& [point, solid] : carried_)
            if (std::find(members.begin(), members.end(), solid) != members.end())
                solidOf[static_cast<std::size_t>(pointOf(point))] = solids_.find(solid);
        return solidOf;
    }

    // Points of one solid do not move against each other: what ties them is left out, as no force could satisfy it.
    void tie(IslandPlan& plan, const JointPair& joint, const std::vector<int>& solidOf) {
        const auto ofPlan = [&](int number) { return pointOf(refOf(number)); };
        const Spot a = joint.a.renumbered(ofPlan), b = joint.b.renumbered(ofPlan);
        const int solid = solidOf[static_cast<std::size_t>(a.nearest())];
        if (solid >= 0 && solid == solidOf[static_cast<std::size_t>(b.nearest())]) {
            for (JointReport& report : reports_)
                if (report.spec == joint.spec) ++report.idle;
            return;
        }
        addTie(plan,
               {.joint = joint.number,
                .a = a.nearest(),
                .b = b.nearest(),
                .breakForce = joint.spec->breakForce.value_or(HUGE_VAL),
                .from = a,
                .to = b,
                .isSeam = joint.spec->isSeam(),
                .touch = joint.spec->touch},
               [&] {
                   if (joint.spec->isMounted())
                       joint.spec->mount(plan, mountingOf(joint));
                   else
                       joint.spec->tie(plan, a, b, joint.distance);
               });
    }

    std::size_t firstGlobalEnd() const {
        return static_cast<std::size_t>(firstGlobal_.back() + bodies_.back()->model.pointCount());
    }
    int pointOf(PointRef p) const { return body(p.body).pointOf[static_cast<std::size_t>(p.point)]; }

    void addBody(IslandPlan& plan, int number, std::vector<int>& numberOf) {
        Body& b = body(number);
        const mechanics::Model& model = b.model;
        b.firstPoint = static_cast<int>(plan.points.size());
        b.pointOf.assign(model.positions.size(), -1);
        bool whole = true;
        for (int i : localOrder(model)) {
            const auto k = static_cast<std::size_t>(i);
            int& island = numberOf[static_cast<std::size_t>(welds_.find(global({number, i})))];
            if (island < 0) {
                island = static_cast<int>(plan.points.size());
                plan.points.push_back({model.masses[k], model.dragRates[k], model.held[k], airMassOf(model, k)});
                plan.positions.push_back(model.positions[k]);
                plan.velocities.push_back(model.velocities[k]);
            } else {
                weldOnto(plan, island, model, k);
                // Points welded to a point of a solid move to it, so that the solid keeps its shape.
                if (b.spec->isRigid()) plan.positions[static_cast<std::size_t>(island)] = model.positions[k];
                whole = false;
            }
            b.pointOf[k] = island;
        }
        b.lastPoint = static_cast<int>(plan.points.size());
        const int row = model.grid[0] > 0 ? model.grid[0] + 1 : 0;
        if (b.lastPoint > b.firstPoint) plan.ranges.push_back({b.firstPoint, whole ? row : 0});
        for (std::size_t i = 0; i < model.springs.size(); ++i) {
            mechanics::Spring spring = model.springs[i];
            spring.a = b.pointOf[static_cast<std::size_t>(spring.a)];
            spring.b = b.pointOf[static_cast<std::size_t>(spring.b)];
            if (spring.a == spring.b) continue;
            plan.springs.push_back(spring);
            plan.origins.push_back({static_cast<int>(plan.bodies.size()), static_cast<int>(i)});
        }
        plan.bodies.push_back(&b);
    }

    static double airMassOf(const mechanics::Model& model, std::size_t k) {
        return model.airMasses.empty() ? 0.0 : model.airMasses[k];
    }

    // Merges two points: masses add, drag is weighted by mass, momentum is kept, held if either is.
    static void weldOnto(IslandPlan& plan, int island, const mechanics::Model& model, std::size_t k) {
        auto& point = plan.points[static_cast<std::size_t>(island)];
        dvec3& velocity = plan.velocities[static_cast<std::size_t>(island)];
        const double mass = point.mass + model.masses[k];
        velocity = (point.mass * velocity + model.masses[k] * model.velocities[k]) / mass;
        point.dragRate = (point.mass * point.dragRate + model.masses[k] * model.dragRates[k]) / mass;
        point.mass = mass;
        point.airMass += airMassOf(model, k);
        point.held = point.held || model.held[k];
        if (point.held) velocity = dvec3(0.0);
    }

    // Grids and ropes are numbered well already. The points of a mesh are taken breadth first from one end of its
    // longest side (Cuthill and McKee 1969), so that neighbours have close numbers.
    static std::vector<int> localOrder(const mechanics::Model& model) {
        std::vector<int> order(model.positions.size());
        std::iota(order.begin(), order.end(), 0);
        if (model.triangles.empty() || model.grid[0] > 0 || !model.cells.empty()) return order;
        std::vector<std::vector<int>> neighbours(model.positions.size());
        for (const mechanics::Spring& s : model.springs) {
            neighbours[static_cast<std::size_t>(s.a)].push_back(s.b);
            neighbours[static_cast<std::size_t>(s.b)].push_back(s.a);
        }
        dvec3 low = model.positions[0], high = low;
        for (const dvec3& x : model.positions) {
            low = glm::min(low, x);
            high = glm::max(high, x);
        }
        const dvec3 size = high - low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
        std::vector<int> starts = order;
        std::stable_sort(starts.begin(), starts.end(), [&](int a, int b) {
            return model.positions[static_cast<std::size_t>(a)][axis] <
                   model.positions[static_cast<std::size_t>(b)][axis];
        });
        std::vector<bool> seen(order.size(), false);
        order.clear();
        for (int start : starts) {
            if (seen[static_cast<std::size_t>(start)]) continue;
            seen[static_cast<std::size_t>(start)] = true;
            order.push_back(start);
            for (std::size_t next = order.size() - 1; next < order.size(); ++next) {
                std::vector<int>& around = neighbours[static_cast<std::size_t>(order[next])];
                std::sort(around.begin(), around.end());
                for (int i : around)
                    if (!seen[static_cast<std::size_t>(i)]) {
                        seen[static_cast<std::size_t>(i)] = true;
                        order.push_back(i);
                    }
            }
        }
        return order;
    }

    SolverSpec solverOf(const IslandPlan& plan) const {
        SolverSpec solver = spec_.solver;
        const auto same = [&](const Body& a, const Body& b) { return a.spec->solver == b.spec->solver; };
        const Body& first = *plan.bodies.front();
        for (const Body* other : plan.bodies)
            if (!same(first, *other))
                throw Error(ErrorKind::badContent,
                            at(other->spec->source) + other->fullName() + " and " + first.fullName() +
                                " are joined but differ in their solver; give both the same `solver`");
        solver.integrator = first.spec->solver.integrator.value_or(solver.integrator);
        solver.safety = first.spec->solver.safety.value_or(solver.safety);
        if (first.spec->solver.dt) solver.dt = first.spec->solver.dt;
        solver.newtonSteps = first.spec->solver.newtonSteps.value_or(solver.newtonSteps);
        solver.cgTolerance = first.spec->solver.cgTolerance.value_or(solver.cgTolerance);
        solver.cgIterations = first.spec->solver.cgIterations.value_or(solver.cgIterations);
        return solver;
    }

    std::span<Body* const> bodies_;
    const SceneSpec& spec_;
    Sets islands_;                  // (bodies)
    Sets solids_;                   // (bodies) that are one rigid body
    std::vector<int> firstGlobal_;  // (bodies)
    Sets welds_;                    // (points of all bodies)
    std::vector<JointPair> joints_;
    std::vector<std::pair<PointRef, int>> carried_;  // points, and the solids that carry them
    std::vector<JointReport> reports_;               // (joints of the scene)
    std::vector<SewnPair> sewn_;                     // of all seams, in global numbers of points
};

}  // namespace

std::vector<IslandPlan> planIslands(std::span<Body* const> bodies, const SceneSpec& spec,
                                    std::vector<JointReport>* joints) {
    if (bodies.empty()) return {};
    Planner planner(bodies, spec);
    std::vector<IslandPlan> plans = planner.plans();
    if (joints != nullptr) *joints = planner.reports();
    return plans;
}

void addTie(IslandPlan& plan, JointTie tie, const std::function<void()>& add) {
    const std::size_t springs = plan.springs.size(), grips = plan.grips.size();
    std::vector<int> sizes;  // of the constraints before `add`
    for (const auto& constraint : plan.constraints) sizes.push_back(constraint->size());
    add();
    for (std::size_t s = springs; s < plan.springs.size(); ++s) tie.springs.push_back(static_cast<int>(s));
    sizes.resize(plan.constraints.size(), 0);
    for (std::size_t c = 0; c < sizes.size(); ++c) {
        const Constraint& constraint = *plan.constraints[c];
        for (int own = sizes[c]; own < constraint.size(); ++own) tie.parts.push_back({static_cast<int>(c), own});
        if (constraint.size() > sizes[c] && tie.b < 0 && !constraint.places().empty())
            tie.offset = constraint.places().back().offset;
    }
    tie.isGrip = plan.grips.size() > grips;
    if (tie.isGrip) tie.offset = plan.grips.back().offsets.back();
    if (tie.isGrip || !tie.springs.empty() || !tie.parts.empty()) plan.ties.push_back(std::move(tie));
}

namespace {

// Whether the grip belongs to this tie alone or serves several, this one among them.
bool isOf(const Grip& grip, const IslandPlan& plan, const JointTie& tie) {
    if (grip.tie >= 0) return &plan.ties[static_cast<std::size_t>(grip.tie)] == &tie;
    return grip.ofCollider && grip.holder == tie.collider &&
           std::binary_search(grip.points.begin(), grip.points.end(), tie.a);
}

}  // namespace

bool holds(const IslandPlan& plan, const JointTie& tie) {
    return std::any_of(
               tie.springs.begin(), tie.springs.end(),
               [&](int s) { return !plan.broken[static_cast<std::size_t>(s)]; }) ||
           std::any_of(
               tie.parts.begin(), tie.parts.end(),
               [&](const JointTie::Part& part) {
                   return plan.constraints[static_cast<std::size_t>(part.constraint)]->holds(part.tie);
               }) ||
           (tie.isGrip &&
            std::any_of(
                plan.grips.begin(), plan.grips.end(), [&](const Grip& grip) { return isOf(grip, plan, tie); }));
}

bool letGo(IslandPlan& plan, std::size_t number) {
    const JointTie& tie = plan.ties[number];
    if (!holds(plan, tie)) return false;
    for (const int s : tie.springs) {
        plan.broken[static_cast<std::size_t>(s)] = true;
        plan.springs[static_cast<std::size_t>(s)].stiffness = 0;
    }
    for (const JointTie::Part& part : tie.parts) {
        auto& constraint = plan.constraints[static_cast<std::size_t>(part.constraint)];
        std::shared_ptr<Constraint> changed = constraint->copy();
        changed->letGo(part.tie);
        constraint = std::move(changed);
    }
    std::erase_if(plan.grips, [&](const Grip& grip) { return grip.tie == static_cast<int>(number); });
    return true;
}

void carryBy(IslandPlan& plan, const std::string& collider, const mechanics::PosePath& path) {
    const bool isThere = std::any_of(plan.carriers.begin(), plan.carriers.end(),
                                     [&](const Carrier& carrier) { return carrier.collider == collider; });
    if (!isThere) plan.carriers.push_back({collider, path});
}

void takeSpringsFromModels(IslandPlan& plan) {
    for (std::size_t s = 0; s < plan.springs.size(); ++s) {
        const SpringOrigin& origin = plan.origins[s];
        if (origin.body < 0 || plan.broken[s]) continue;
        const mechanics::Model& model = plan.bodies[static_cast<std::size_t>(origin.body)]->model;
        plan.springs[s].stiffness = model.springs[static_cast<std::size_t>(origin.spring)].stiffness;
        plan.springs[s].dampingTime = model.springs[static_cast<std::size_t>(origin.spring)].dampingTime;
    }
    // The drag of welded points is weighted by mass, as in the planner.
    std::vector<double> mass(plan.points.size(), 0.0);
    for (const Body* body : plan.bodies)
        for (std::size_t i = 0; i < body->pointOf.size(); ++i) {
            const auto at = static_cast<std::size_t>(body->pointOf[i]);
            const double more = body->model.masses[i];
            double& drag = plan.points[at].dragRate;
            drag = mass[at] == 0 ? body->model.dragRates[i]
                                 : (mass[at] * drag + more * body->model.dragRates[i]) / (mass[at] + more);
            mass[at] += more;
        }
}

const ode::Methods& methodsOf(const SolverSpec& solver) {
    return solver.methods != nullptr ? *solver.methods : ode::builtInMethods();
}

std::vector<double> inverseMassesOf(const IslandPlan& plan) {
    std::vector<double> inverseMasses;
    for (const mechanics::PointMass& p : plan.points) inverseMasses.push_back(p.held ? 0.0 : 1.0 / p.mass);
    return inverseMasses;
}

std::vector<mechanics::VolumeCell> cellsOf(const Body& body) {
    std::vector<mechanics::VolumeCell> cells;
    for (std::size_t c = 0; c < body.model.cells.size(); ++c) {
        if (body.damage.isCellGone(c)) continue;
        cells.push_back(body.model.cells[c]);
        for (int& i : cells.back().points) i = body.pointOf[static_cast<std::size_t>(i)];
    }
    return cells;
}

std::vector<mechanics::VolumeCell> cellsOf(const IslandPlan& plan) {
    std::vector<mechanics::VolumeCell> all;
    for (const Body* body : plan.bodies) {
        const std::vector<mechanics::VolumeCell> cells = cellsOf(*body);
        all.insert(all.end(), cells.begin(), cells.end());
    }
    return all;
}

namespace {

// (points of the body) which are held, and of which of them the direction is held too.
struct HeldPoints {
    std::vector<bool> isHeld, isClamped;
};

HeldPoints heldPointsOf(const IslandPlan& plan, const Body& body) {
    const std::vector<bool> isHeld = heldPointsOf(plan);
    HeldPoints of;
    for (std::size_t i = 0; i < body.pointOf.size(); ++i) {
        of.isHeld.push_back(isHeld[static_cast<std::size_t>(body.pointOf[i])]);
        of.isClamped.push_back(of.isHeld[i] && !body.clamped.empty() && body.clamped[i]);
    }
    return of;
}

mechanics::Bending presentOf(const IslandPlan& plan, const Body& body, const mechanics::Bending& bending) {
    if (bending.isEmpty()) return {};
    const auto [isHeld, isClamped] = heldPointsOf(plan, body);
    return without(clamped(bending, isHeld, isClamped, body.model.positions),
                   [&](int a, int b) { return body.damage.isSevered(a, b); });
}

}  // namespace

mechanics::Bending gridBendingOf(const IslandPlan& plan, const Body& body) {
    return presentOf(plan, body, body.model.bending);
}

mechanics::BendingFriction gridFrictionOf(const IslandPlan& plan, const Body& body) {
    mechanics::BendingFriction friction = body.model.friction;
    friction.stuck = presentOf(plan, body, friction.stuck);
    return friction;
}

std::vector<mechanics::BendingElement> bendingElementsOf(const IslandPlan& plan, const Body& body) {
    if (body.model.freeform.isEmpty()) return {};
    const auto [isHeld, isClamped] = heldPointsOf(plan, body);
    return mechanics::bendingElements(body.model, isHeld, isClamped,
                                      [&](int a, int b) { return body.damage.isSevered(a, b); });
}

std::pair<const Body*, int> authored(const IslandPlan& plan, int point) {
    for (const Body* body : plan.bodies)
        for (std::size_t i = 0; i < body->pointOf.size(); ++i)
            if (body->pointOf[i] == point) return {body, static_cast<int>(i)};
    return {nullptr, point};
}

bool isPinned(const IslandPlan& plan, int point) {
    return std::any_of(
        plan.constraints.begin(), plan.constraints.end(),
        [&](const auto& constraint) { return constraint->carries(point); });
}

std::vector<bool> heldPointsOf(const IslandPlan& plan) {
    std::vector<bool> isHeld;
    for (const mechanics::PointMass& p : plan.points) isHeld.push_back(p.held);
    for (const auto& constraint : plan.constraints)
        for (const int i : constraint->points())
            if (constraint->carries(i)) isHeld[static_cast<std::size_t>(i)] = true;
    for (const Grip& grip : plan.grips)
        if (grip.ofCollider && grip.rigid)
            for (int i : grip.points) isHeld[static_cast<std::size_t>(i)] = true;
    return isHeld;
}

bool isFree(const IslandPlan& plan, int point) {
    return !plan.points[static_cast<std::size_t>(point)].held && !isPinned(plan, point) &&
           std::none_of(
               plan.grips.begin(), plan.grips.end(),
               [&](const Grip& grip) {
                   return grip.rigid && std::binary_search(grip.points.begin(), grip.points.end(), point);
               });
}

double lengthOf(const mechanics::Spring& spring, std::span<const dvec3> x) {
    const dvec3 d = x[static_cast<std::size_t>(spring.b)] - x[static_cast<std::size_t>(spring.a)];
    return std::sqrt(glm::dot(d, d));
}

std::string describeSpring(const IslandPlan& plan, int spring) {
    static constexpr const char* kinds[] = {"structural", "shear", "bend", "joint"};
    const mechanics::Spring& s = plan.springs[static_cast<std::size_t>(spring)];
    std::string text = std::string(kinds[static_cast<int>(s.kind)]) + " spring ";
    const auto [bodyA, a] = authored(plan, s.a);
    const auto [bodyB, b] = authored(plan, s.b);
    text += std::to_string(a) + "–" + std::to_string(b);
    if (bodyA != nullptr) text += " of " + bodyA->fullName();
    if (bodyB != bodyA && bodyB != nullptr) text += " and " + bodyB->fullName();
    return text;
}

}  // namespace taut::world
