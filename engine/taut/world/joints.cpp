#include "taut/world/private/joints.h"

#include <algorithm>
#include <cstdio>
#include <optional>

#include "taut/core/aabb.h"
#include "taut/plan/private/ties.h"
#include "taut/spec/targets.h"
#include "taut/world/private/bodies.h"
#include "taut/world/private/impl.h"

namespace taut::world {
namespace {

constexpr std::size_t mostNamed = 12;

std::string metres(double length) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g m", length);
    return text;
}

JointInfo infoOf(const JointSpec& joint, int number) {
    JointInfo info;
    info.a = joint.a.text();
    info.b = joint.b.text();
    info.name = joint.name;
    info.kind = joint.kind();
    info.number = number;
    return info;
}

JointInfo infoOf(const JointReport& report, int number) {
    JointInfo info = infoOf(*report.spec, number);
    info.jump = report.jump;
    for (const auto& [a, b, points] : report.pairs) info.pairs.push_back({a->fullName(), b->fullName(), points});
    for (const auto& [body, distance] : report.loose) info.loose.push_back(body->fullName());
    return info;
}

core::Finding warningOf(const JointReport& report) {
    const JointSpec& joint = *report.spec;
    std::string names;
    for (std::size_t i = 0; i < std::min(mostNamed, report.loose.size()); ++i) {
        const auto& [body, distance] = report.loose[i];
        names += (i > 0 ? ", " : "") + body->fullName() + (joint.isWeld() ? " (" + metres(distance) + " off)" : "");
    }
    if (report.loose.size() > mostNamed) names += " and " + std::to_string(report.loose.size() - mostNamed) + " more";
    return warningAt(joint.source) + "the joint \"" + joint.a.text() + "\" – \"" + joint.b.text() + "\" does not tie " +
           names +
           (joint.isWeld() ? "; it reaches " + metres(joint.reach()) +
                                 ": move them together, raise reach_m, or use kind = \"spring\""
                           : ": other bodies are nearer");
}

// Warns of a joint that moves points further than a cell, or ends of bodies without cells by a centimetre; else none.
std::optional<core::Finding> jumpWarning(const JointReport& report) {
    constexpr double mostWithoutCells = 0.01;  // [m]
    double cell = HUGE_VAL;
    for (const auto& [a, b, points] : report.pairs)
        for (const Body* body : {a, b})
            if (!body->spec->isRigid()) cell = std::min(cell, shortestEdge(*body));
    const bool hasCells = std::isfinite(cell);
    if (!(report.jump > (hasCells ? cell : mostWithoutCells))) return std::nullopt;
    const JointSpec& joint = *report.spec;
    return warningAt(joint.source) + "the " + std::string(joint.title().substr(2)) + " \"" + joint.a.text() +
           "\" – \"" + joint.b.text() + "\" jerks points together by " + metres(report.jump) +
           (hasCells ? ", more than a cell (" + metres(cell) + ")" : "") + ": move the bodies together" +
           (joint.isWeld() ? ", lower reach_m," : ",") + " or use kind = \"spring\"";
}

// Warns of ties that nothing could move; else none.
std::optional<core::Finding> idleWarning(const JointReport& report) {
    if (report.idle == 0) return std::nullopt;
    const JointSpec& joint = *report.spec;
    return warningAt(joint.source) + "the joint \"" + joint.a.text() + "\" – \"" + joint.b.text() + "\" has " +
           std::to_string(report.idle) +
           " ties between points of one solid, which are left out: the solid and all that is welded to it are rigid "
           "already; name points of another body";
}

// [m] The diagonal of the box of its points.
double sizeAtRest(const Body& body) {
    core::Aabb box;
    for (const dvec3& x : body.model.positions) box.add(x);
    return glm::length(box.high - box.low);
}

// Warnings of seams that cannot close, or only by force.
std::vector<core::Finding> seamWarnings(const JointReport& report) {
    constexpr double mostGathered = 2.5;  // times as long: ruffles are twice
    std::vector<core::Finding> warnings;
    const JointSpec& seam = *report.spec;
    const auto warn = [&](const std::string& what) {
        warnings.push_back(warningAt(seam.source) + "the seam \"" + seam.a.text() + "\" – \"" + seam.b.text() + "\" " +
                           what);
    };
    if (const auto [a, b] = report.sewn.lengths; std::max(a, b) > mostGathered * std::min(a, b))
        warn("sews " + metres(a) + " to " + metres(b) +
             ": the longer edge is crushed to the length of the shorter one, or stretches it; cut them alike, or name "
             "other edges");
    double size = 0;
    for (const auto& [a, b, points] : report.pairs) size = std::max({size, sizeAtRest(*a), sizeAtRest(*b)});
    if (const double apart = report.sewn.apart; apart > size)
        warn("draws points together over " + metres(apart) + ", further than its bodies are large (" + metres(size) +
             "): move the bodies together, or name other edges");
    if (const double gap = report.sewn.gap; gap > 0)
        warn("leaves a gap of " + metres(gap) +
             " between edges of its list: they do not follow each other, and no seam brings their ends together; name "
             "them in order, or sew the edges between them");
    if (const int held = report.sewn.heldApart; held > 0)
        warn("does not close: " + std::to_string(held) +
             " of its points are held on both edges; hold one of them, or none");
    return warnings;
}

}  // namespace

void takeJoints(WorldImpl& w, const std::vector<JointReport>& reports) {
    std::size_t next = 0;
    std::vector<JointInfo> tied;
    int number = 0;
    for (const JointSpec& joint : w.spec.joints) {
        if (!isTie(joint)) {
            const JointReport& report = reports[next++];
            w.joints.push_back(infoOf(report, number));
            if (!report.loose.empty()) w.jointWarnings.push_back(warningOf(report));
            for (const auto& warning : {jumpWarning(report), idleWarning(report)})
                if (warning) w.jointWarnings.push_back(*warning);
            if (report.spec->isSeam())
                for (core::Finding& warning : seamWarnings(report)) w.jointWarnings.push_back(std::move(warning));
        } else {
            JointInfo& info = tied.emplace_back(infoOf(joint, number));
            for (const Body* body : bodiesOf(w))
                if (names(pointsOf(joint), *body))
                    info.pairs.push_back(
                        {body->fullName(), colliderOf(joint), countTied(joint, pointsOf(joint), *body)});
        }
        w.drawings.push_back(joint.isDrawn() ? std::make_shared<const TieDrawing>(joint, number) : nullptr);
        ++number;
    }
    w.joints.insert(w.joints.end(), tied.begin(), tied.end());
}

bool isJoint(const WorldImpl& w, const std::string& name) {
    return !name.empty() &&
           std::any_of(
               w.spec.joints.begin(), w.spec.joints.end(), [&](const JointSpec& joint) { return joint.name == name; });
}

void releaseJoints(WorldImpl& w, const std::string& name) {
    for (const auto& island : w.islands)
        island->release(
            w.now(), [&](const JointTie& tie) { return w.spec.joints[tie.joint].name == name; });
}

void beginJoints(WorldImpl& w) {
    for (const auto& island : w.islands) island->beginConstraints(w.now());
}

void breakJoints(WorldImpl& w) {
    for (const auto& island : w.islands) {
        const std::vector<bool> isOver = island->overloaded();
        if (std::find(isOver.begin(), isOver.end(), true) == isOver.end()) continue;
        std::size_t next = 0;
        island->release(w.now(), [&](const JointTie&) { return isOver[next++]; });
    }
}

int jointsLeft(const WorldImpl& w, const JointInfo& info) {
    int ties = 0, left = 0;
    for (const auto& island : w.islands)
        for (const JointTie& tie : island->plan().ties) {
            if (tie.joint != info.number) continue;
            ++ties;
            left += holds(island->plan(), tie) ? 1 : 0;
        }
    if (ties > 0) return left;
    for (const auto& pair : info.pairs) left += pair.points;
    return left;
}

}  // namespace taut::world
