#include "taut/joints/sewn_panels.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <string>
#include <vector>

#include "taut/bodies/cloth.h"
#include "taut/mechanics/panel_mesher.h"
#include "taut/plan/private/seam_pairing.h"
#include "taut/spec/spec.h"
#include "taut/spec/targets.h"

namespace taut::world {
namespace {

// Of a panel, from a corner to the next.
struct Side {
    ClothSpec* panel;
    std::size_t ring, corner;
    double length;  // [m]
};

// What one side of a seam names.
struct SewnSide {
    int edges = 0;            // between its points; 0: unknown
    std::vector<Side> chain;  // none: not all of it is of panels
};

class SeamEvener {
  public:
    explicit SeamEvener(SceneSpec& spec) : spec_(spec) {}

    // The side with fewer edges gets as many as the other; if one is no panel, the panel gets its number. Returns
    // whether it has changed a panel.
    bool even(const JointSpec& seam) {
        const SewnSide a = sideOf(seam.a), b = sideOf(seam.b);
        if (a.edges == b.edges || a.edges == 0 || b.edges == 0) return false;
        const bool changesA = b.chain.empty() || (!a.chain.empty() && a.edges < b.edges);
        return divide((changesA ? a : b).chain, (changesA ? b : a).edges);
    }

  private:
    const mechanics::Model& modelOf(const BodySpec& body) {
        const auto found = models_.find(&body);
        return found != models_.end() ? found->second : models_.emplace(&body, body.build(spec_)).first->second;
    }

    SewnSide sideOf(const JointSide& side) {
        SewnSide all;
        bool areSides = true;
        for (const std::string& text : side.targets) {
            const Target target = parseTarget(text);
            const auto body = std::find_if(spec_.bodies.begin(), spec_.bodies.end(), [&](const BodySpec& own) {
                return own.kind() == target.kind &&
                       (matches(target.name, own.name) || target.name.starts_with(own.name + "."));
            });
            if (body == spec_.bodies.end()) return {};
            const Line line = lineOf(modelOf(*body), selectPoints(modelOf(*body), target.selector));
            if (line.points.empty()) return {};
            all.edges += static_cast<int>(line.points.size()) - (line.isClosed ? 0 : 1);
            const std::vector<Side> chain = sidesOf(*body, target.selector);
            areSides = areSides && !chain.empty();
            all.chain.insert(all.chain.end(), chain.begin(), chain.end());
        }
        if (!areSides) all.chain.clear();
        return all;
    }

    static std::vector<Side> sidesOf(BodySpec& body, const std::string& selector) {
        auto* panel = dynamic_cast<ClothSpec*>(&body);
        if (panel == nullptr || !panel->isPanel()) return {};
        std::vector<Side> chain;
        for (const ClothSpec::PanelEdge& edge : panel->panelEdges()) {
            if (edge.name != selector) continue;
            const auto& corners = edge.ring == 0 ? panel->corners : panel->holes[edge.ring - 1].corners;
            auto corner = static_cast<std::size_t>(edge.from);
            do {
                const std::size_t next = (corner + 1) % corners.size();
                chain.push_back({panel, edge.ring, corner, glm::distance(corners[corner], corners[next])});
                corner = next;
            } while (corner != static_cast<std::size_t>(edge.to));
        }
        return chain;
    }

    // By length, unless cells would differ from what the panel asks for by half.
    bool divide(const std::vector<Side>& chain, int edges) {
        double length = 0;
        for (const Side& side : chain) length += side.length;
        for (const Side& side : chain)
            if (std::abs(length / edges - side.panel->cell) > 0.5 * side.panel->cell) return false;
        double passed = 0;
        int given = 0;
        for (const Side& side : chain) {
            passed += side.length;
            const int upTo = static_cast<int>(std::floor(edges * passed / length + 0.5));
            auto& own = side.panel->sideEdges;
            own.resize(1 + side.panel->holes.size());
            own[side.ring].resize(std::max(own[side.ring].size(), side.corner + 1), 0);
            own[side.ring][side.corner] = std::max(upTo - given, 1);
            given = upTo;
        }
        for (const Side& side : chain)
            if (models_.erase(side.panel) > 0) side.panel->meshPanel();
        return !chain.empty();
    }

    SceneSpec& spec_;
    std::map<const BodySpec*, mechanics::Model> models_;
};

}  // namespace

void evenSeams(SceneSpec& spec) {
    SeamEvener evener(spec);
    // A panel may pass on what it got, from seam to seam.
    bool isOther = true;
    for (std::size_t round = 0; isOther && round < spec.joints.size(); ++round) {
        isOther = false;
        for (const JointSpec& joint : spec.joints)
            if (joint.isSeam() && evener.even(joint)) isOther = true;
    }
}

}  // namespace taut::world
