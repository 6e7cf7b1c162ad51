// Strips of cloth that are clamped level, as row R1 of `taut reality` has them, with Bullet's soft body. Prints lines
// of peers.csv:   taut_peers_bullet told 10,20 1,10,100   (a way of telling, numbers of cells along the strip, Γ after
// Γ)
//
// How the fabric is set in Bullet. told: a link has one number, m_kLST from 0 to 1: the part of its error that goes in
// a round. That is a spring of m_kLST m/h², with the reduced mass m of its ends and the step h. Bending is by links
// between points two cells apart, as generateBendingConstraints(2) makes them. They have no stiffness in a flat sheet,
// so no number is right. They get the bending energy of the fabric at its own curvature, one over its bending length ℓ
// = (B/w)^⅓: over the width k_b = 9Bℓ²/a⁴, from e = k_b a⁴κ⁴/18. The step is so short that this is m_kLST = 0.025, a
// fortieth of that of the threads: softer threads would rather stretch.
// as-set: the strip as Bullet is set, steps of 1/60 s, one round, m_kLST = 1. That knows no rigidity at all.
#include <BulletSoftBody/btSoftBody.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

namespace {

constexpr double along = 0.1, density = 0.2, g = 9.81;  // [m], [kg/m²], [m/s²]

struct Telling {
    const char* suffix;    // of the peer's name
    double bend, stretch;  // m_kLST
    double clampShare;     // of bend between a point that is held and one that is not
    double step;           // [s]
};

// Points at the middles of the cells, so that all have the same mass, and a row before the clamp, which is in the
// middle of a cell that is held.
void measure(const Telling& telling, int cells, double gamma) {
    btSoftBodyWorldInfo world;
    world.m_gravity = btVector3(0, -g, 0);
    btSoftBody body(&world);
    const double a = along / cells;
    const auto material = [&](double stiffness) {
        btSoftBody::Material* made = body.appendMaterial();
        made->m_kLST = stiffness;
        return made;
    };
    btSoftBody::Material *threads = material(telling.stretch), *bending = material(telling.bend),
                         *atClamp = material(telling.bend * telling.clampShare);
    for (int i = 0; i <= cells; ++i)
        for (const int side : {0, 1})
            body.appendNode(btVector3((i - 0.5) * a, 0, side * a), i < 2 ? 0.0 : density * a * a / 2);
    for (int p = 0; p < 2 * cells; ++p) body.appendLink(p, p + 2, threads);
    for (int p = 0; p <= 2 * cells; p += 2) body.appendLink(p, p + 1, threads);
    for (int p = 0; p + 4 < 2 * cells + 2; ++p) body.appendLink(p, p + 4, p < 4 ? atClamp : bending);
    // As the strips of R1 [1/s]; Bullet takes it as the part of the velocity that is lost in a step.
    const double drag = 2 * std::sqrt(g / along) * std::max(3.516 / std::sqrt(gamma), 1.2);
    body.m_cfg.kDP = std::min(drag * telling.step, 1.0);
    const std::clock_t begin = std::clock();
    double fastest = INFINITY, time = 0;
    while (time < 60 && fastest > 1e-5 * along) {
        const int steps = static_cast<int>(std::ceil(0.25 / telling.step));
        std::vector<btVector3> before;
        for (int i = 0; i < body.m_nodes.size(); ++i) before.push_back(body.m_nodes[i].m_x);
        for (int i = 0; i < steps; ++i) {
            body.predictMotion(telling.step);
            body.solveConstraints();
            body.integrateMotion();
        }
        time += steps * telling.step;
        fastest = 0;
        for (int i = 0; i < body.m_nodes.size(); ++i)
            fastest = std::max(fastest, (body.m_nodes[i].m_x - before[i]).length() / (steps * telling.step));
    }
    const double spent = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    const int last = body.m_nodes.size() - 1;
    const btVector3 end = body.m_nodes[last].m_x + (body.m_nodes[last].m_x - body.m_nodes[last - 2].m_x) / 2;
    std::printf("Bullet %d.%02d%s,%g,%d,%.6g,%d,%.2f,%.3f,m_kLST %g at steps of %.3g s\n", btGetVersion() / 100,
                btGetVersion() % 100, telling.suffix, gamma, cells, -end.y() / end.x(), fastest <= 1e-5 * along ? 1 : 0,
                time, spent, telling.bend, telling.step);
    std::fflush(stdout);
}

std::vector<double> numbers(const char* text) {
    std::vector<double> found;
    for (char* end = nullptr; *text != 0; text = *end == ',' ? end + 1 : end) {
        found.push_back(std::strtod(text, &end));
        if (end == text) std::exit((std::fprintf(stderr, "taut_peers_bullet: no number: %s\n", text), 2));
    }
    return found;
}

}  // namespace

int main(int count, char** arguments) {
    const std::string way = count == 4 ? arguments[1] : "";
    if (way != "told" && way != "as-set") {
        std::fprintf(stderr, "usage: taut_peers_bullet told|as-set CELLS,… GAMMA,…\n");
        return 2;
    }
    const double weight = density * g;
    for (const double gamma : numbers(arguments[3]))
        for (const double wanted : numbers(arguments[2])) {
            const int cells = static_cast<int>(wanted);
            const double a = along / cells, rigidity = weight * along * along * along / gamma,
                         own = std::cbrt(rigidity / weight);
            const double twoApart = 9 * rigidity * own * own / (a * a * a * a) / 2;  // of one of two rows [N/m]
            // Between a held point and another the reduced mass is twice that of two others.
            if (way == "told")
                measure({"", 0.025, 1, 0.5, std::sqrt(0.025 * density * a * a / 4 / twoApart)}, cells, gamma);
            else
                measure({" as set", 1, 1, 1, 1.0 / 60}, cells, gamma);
        }
}
