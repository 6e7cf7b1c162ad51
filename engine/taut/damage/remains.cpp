#include "taut/damage/private/remains.h"

#include <cmath>
#include <map>

namespace taut::world {

dvec3 normalThrough(std::span<const dvec3> places, const dvec3& mean, const dvec3& out) {
    dvec3 normal(0.0);
    for (std::size_t i = 0; i < places.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const dvec3 across = glm::cross(places[i] - mean, places[j] - mean);
            normal += glm::dot(across, out) < 0 ? -across : across;
        }
    return normal;
}

Remains::Remains(const mechanics::Model& model, const Damage& damage)
    : model_(model), damage_(damage), fans_(model_.positions.size()), beside_(fans_.size()) {
    for (const mechanics::Spring& s : model_.springs)
        if (s.kind != mechanics::SpringKind::bend && !damage_.isSevered(s.a, s.b))
            held_.insert({std::min(s.a, s.b), std::max(s.a, s.b)});
    eachTetrahedron(false, [this](const std::array<int, 4>& corners) { addFan(corners); });
    if (model_.cells.empty()) {
        for (std::size_t t = 0; t < model_.triangles.size(); ++t)
            if (!damage_.isTriangleGone(t)) addFan(model_.triangles[t]);
        return;
    }
    for (const auto& [a, b] : held_) {
        beside_[a].push_back(b);
        beside_[b].push_back(a);
    }
    const auto findCarriers = [&](const auto& canCarry) {
        for (int i = 0; i < model_.pointCount(); ++i) {
            if (carrierOf(i) >= 0) continue;
            const auto other = std::find_if(besideOf(i).begin(), besideOf(i).end(), canCarry);
            if (other != besideOf(i).end()) carriers_[i] = *other;
        }
    };
    findCarriers([this](int i) { return isAnyWholeAt(i); });
    for (int i = 0; i < model_.pointCount(); ++i)
        if (carrierOf(i) < 0) addBase(i);
    findCarriers([this](int i) { return bases_.count(i) > 0; });
}

int Remains::carrierOf(int point) const {
    if (isAnyWholeAt(point)) return point;
    const auto found = carriers_.find(point);
    return found == carriers_.end() ? -1 : found->second;
}

template <std::size_t N>
void Remains::addFan(const std::array<int, N>& corners) {
    for (int corner : corners) {
        Corners others;
        for (int other : corners)
            if (other != corner) others.push_back(other);
        fans_[corner].push_back(others);
    }
}

// Not of a row of points.
void Remains::addBase(int point) {
    constexpr double leastSine = 1e-3;
    double most = 0.0;
    for (const int b : besideOf(point))
        for (const int c : besideOf(point)) {
            const dvec3 e = rest(b) - rest(point), f = rest(c) - rest(point);
            const double area = glm::length(glm::cross(e, f));
            if (area <= most || area < leastSine * glm::length(e) * glm::length(f)) continue;
            most = area;
            bases_[point] = {b, c};
            carriers_[point] = point;
        }
}

void Remains::carry(SkinVertex& vertex, int point) const {
    const int carrier = carrierOf(point), a = carrier < 0 ? point : carrier;
    const dvec3 way = vertex.rest - rest(a);
    std::map<int, double> weights;
    double sum = 0, most = 0;
    const auto add = [&](const Corners& others, const std::vector<double>& part, double weight) {
        sum += weight;
        for (std::size_t i = 0; i < others.size(); ++i) {
            weights[others[i]] += weight * part[i];
            weights[a] -= weight * part[i];
        }
    };
    for (const Corners& others : fans_[a]) {
        const std::vector<double> part = inCorners(a, others, way);
        if (part.empty()) continue;
        double size = 0;
        for (double p : part) size += std::abs(p);
        const double weight = 1 / (1e-3 + size);
        if (others.size() == 3) {
            if (weight <= most) continue;
            most = weight;
            weights.clear();
            sum = 0;
        }
        add(others, part, weight);
    }
    if (const auto base = bases_.find(a); base != bases_.end()) {
        const Corners& others = base->second;
        add(others, inCorners(a, others, way), 1.0);
        vertex.base = {a, others[0], others[1]};
        const dvec3 normal = glm::cross(rest(others[0]) - rest(a), rest(others[1]) - rest(a));
        vertex.above = static_cast<float>(glm::dot(way, glm::normalize(normal)));
    }
    vertex.terms.clear();
    double ofA = 1;
    for (const auto& [other, weight] : weights)
        if (other == a)
            ofA += weight / sum;
        else
            vertex.terms.push_back({other, static_cast<float>(weight / sum)});
    vertex.terms.push_back({a, static_cast<float>(ofA)});
}

// `way` as a combination of the edges from a to the others; least squares if they span only a plane.
std::vector<double> Remains::inCorners(int a, const Corners& others, const dvec3& way) const {
    const dvec3 e = rest(others[0]) - rest(a), f = rest(others[1]) - rest(a);
    if (others.size() == 3) {
        const glm::dmat3 edges(e, f, rest(others[2]) - rest(a));
        if (!(std::abs(glm::determinant(edges)) > 0)) return {};
        const dvec3 parts = glm::inverse(edges) * way;
        return {parts.x, parts.y, parts.z};
    }
    const double ee = glm::dot(e, e), ef = glm::dot(e, f), ff = glm::dot(f, f), det = ee * ff - ef * ef;
    if (!(det > 0)) return {};
    const double we = glm::dot(way, e), wf = glm::dot(way, f);
    return {(ff * we - ef * wf) / det, (ee * wf - ef * we) / det};
}

}  // namespace taut::world
