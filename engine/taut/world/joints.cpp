#include "taut/world/private/joints.h"

#include <algorithm>
#include <cstdio>

#include "taut/world/private/bodies.h"
#include "taut/world/private/impl.h"
#include "taut/spec/targets.h"
#include "taut/bodies/private/ties.h"

namespace taut::world {
namespace {

constexpr std::size_t mostNamed = 12;

std::string metres(double length) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g m", length);
    return text;
}

JointInfo infoOf(const JointReport& report) {
    JointInfo info{report.spec->a, report.spec->b, std::string(report.spec->kind()), {}, report.jump, {}};
    for (const auto& [a, b, points] : report.pairs) info.pairs.push_back({a->fullName(), b->fullName(), points});
    for (const auto& [body, distance] : report.loose) info.loose.push_back(body->fullName());
    return info;
}

std::string warningOf(const JointReport& report) {
    const JointSpec& joint = *report.spec;
    std::string names;
    for (std::size_t i = 0; i < std::min(mostNamed, report.loose.size()); ++i) {
        const auto& [body, distance] = report.loose[i];
        names += (i > 0 ? ", " : "") + body->fullName() + (joint.isWeld() ? " (" + metres(distance) + " off)" : "");
    }
    if (report.loose.size() > mostNamed) names += " and " + std::to_string(report.loose.size() - mostNamed) + " more";
    return asWarning(at(joint.source)) + "the joint \"" + joint.a + "\" – \"" + joint.b + "\" does not tie " + names +
           (joint.isWeld() ? "; it reaches " + metres(joint.reach()) +
                         ": move them together, raise reach_m, or use kind = \"spring\""
                   : ": other bodies are nearer");
}

// Of a weld that moves points further than a cell; else empty.
std::string jumpWarning(const JointReport& report) {
    double cell = HUGE_VAL;
    for (const auto& [a, b, points] : report.pairs) cell = std::min({cell, shortestEdge(*a), shortestEdge(*b)});
    if (!(report.jump > cell)) return "";
    const JointSpec& joint = *report.spec;
    return asWarning(at(joint.source)) + "the weld \"" + joint.a + "\" – \"" + joint.b +
           "\" jerks points together by " + metres(report.jump) + ", more than a cell (" + metres(cell) +
           "): move the bodies together, lower reach_m, or use kind = \"spring\"";
}

}  // namespace

void takeJoints(WorldImpl& w, const std::vector<JointReport>& reports) {
    for (const JointReport& report : reports) {
        w.joints.push_back(infoOf(report));
        if (!report.loose.empty()) w.jointWarnings.push_back(warningOf(report));
        if (std::string jerk = jumpWarning(report); !jerk.empty()) w.jointWarnings.push_back(std::move(jerk));
    }
    for (const JointSpec& joint : w.spec.joints) {
        if (!isTie(joint)) continue;
        JointInfo info{joint.a, joint.b, std::string(joint.kind()), {}, 0, {}};
        const std::string selector = parseTarget(pointsOf(joint)).selector;
        for (const Body* body : matchBodies(bodiesOf(w), pointsOf(joint)))
            info.pairs.push_back(
                {body->fullName(), colliderOf(joint), static_cast<int>(selectPoints(body->model, selector).size())});
        w.joints.push_back(std::move(info));
    }
}

}  // namespace taut::world
