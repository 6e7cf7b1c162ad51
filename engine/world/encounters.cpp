#include "taut/world/encounters.h"

#include <algorithm>

#include "taut/core/error.h"
#include "taut/world/impl.h"
#include "taut/world/ticks.h"
#include "taut/world/touch_doubts.h"

namespace taut::world {
namespace {

// [ns] about, of what a tick does; counted, for a clock would not say the same twice.
constexpr double perPointStep = 6, perPointInstant = 60, perPair = 150;

class Outlook {
  public:
    explicit Outlook(const SceneSpec& scene) : trial_(scene) {
        for (BodySpec& body : trial_.bodies) {
            if (body.touch != Touch::nothing) continue;
            silent_.insert(body.fullName());
            body.touch = Touch::others;
        }
    }

    Encounters look(double most) {
        if (silent_.empty()) return {};
        letPassWhatStartsInEachOther();
        World world(trial_);
        WorldImpl& w = WorldAccess::of(world);
        if (w.islands.size() + w.waiting.size() < 2 || !w.touchesAny()) return found_;
        const std::int64_t last = Ticks(trial_.run).last();
        double work = 0;
        try {
            while (world.tick() < last && work < most && !world.advance()) {
                for (const BodyContact& c : w.touchWatch.contacts()) add(*c.first, *c.second);
                for (const contact::Crossing& c : w.touching->crossingsBefore()) add(*w.touching, c);
                work += workOf(world);
            }
        } catch (const core::Error& error) {
            if (error.kind() != core::ErrorKind::badContent) throw;
        }
        found_.seen = world.time();
        return found_;
    }

  private:
    void letPassWhatStartsInEachOther() {
        World world(trial_);
        WorldImpl& w = WorldAccess::of(world);
        if (!w.touchesAny()) return;
        for (const BodyCrossing& c : w.crossings()) add(*c.ofEdge, *c.ofTriangle);
        for (const auto& [surfaces, points] : pointsInOnePlace(*w.touching))
            add(w.touching->bodyOf(surfaces.first), w.touching->bodyOf(surfaces.second));
        for (BodySpec& body : trial_.bodies)
            if (entangled_.contains(body.fullName())) body.touch = Touch::nothing;
    }

    void add(const Touching& touching, const contact::Crossing& crossing) {
        const contact::Elements& elements = touching.elements();
        const int a = elements.edges()[static_cast<std::size_t>(crossing.edge)].surface;
        const int b = elements.triangles()[static_cast<std::size_t>(crossing.triangle)].surface;
        if (touching.isOfBody(a) && touching.isOfBody(b)) add(touching.bodyOf(a), touching.bodyOf(b));
    }

    void add(const Body& a, const Body& b) {
        const bool areSilent[] = {silent_.contains(a.spec->fullName()), silent_.contains(b.spec->fullName())};
        if (a.island == b.island || (!areSilent[0] && !areSilent[1])) return;
        if (areSilent[0]) entangled_.insert(a.spec->fullName());
        if (areSilent[1]) entangled_.insert(b.spec->fullName());
        const bool isBefore = sortsBefore(a, b);
        found_.pairs.emplace((isBefore ? a : b).fullName(), (isBefore ? b : a).fullName());
    }

    double workOf(const World& world) {
        const ContactInfo contact = world.contact();
        const double pairs = static_cast<double>(contact.locatedInAll - pairsBefore_);
        pairsBefore_ = contact.locatedInAll;
        double work = perPointInstant * contact.points * contact.lastInstants + perPair * pairs;
        for (const auto& island : WorldAccess::of(const_cast<World&>(world)).islands)
            work += perPointStep * static_cast<double>(island->plan().points.size()) * island->substeps();
        return work;
    }

    SceneSpec trial_;
    std::set<std::string> silent_, entangled_;  // specs of bodies
    std::int64_t pairsBefore_ = 0;
    Encounters found_;
};

}  // namespace

Encounters encounters(const SceneSpec& scene, double most) {
    return Outlook(scene).look(most);
}

}  // namespace taut::world
