#include "taut/advice/private/encounters.h"

#include <memory>

#include "taut/advice/contact_doubts.h"
#include "taut/core/error.h"
#include "taut/core/private/parallel.h"
#include "taut/spec/ticks.h"
#include "taut/world/private/bodies.h"
#include "taut/world/private/impl.h"
#include "taut/world/private/tick.h"
#include "taut/world/world.h"

namespace taut::world {
namespace {

// [ns] Rough cost of the work in a tick. A limit of counted work gives the same verdict each time; the clock is a guard
// for scenes that cost more than this says.
constexpr double perEvaluation = 15, perIteration = 60, perPointDetection = 80;  // for each point
constexpr double perPair = 250;

class LookAhead {
  public:
    explicit LookAhead(const SceneSpec& scene) : trial_(scene) {
        for (BodySpec& body : trial_.bodies) {
            if (body.touch != Touch::nothing) continue;
            silent_.insert(body.fullName());
            if (body.collide && !body.facesMeetColliders()) pointwise_.insert(body.fullName());
            body.touch = Touch::others;
        }
    }

    Encounters look(double most, double end) {
        if (silent_.empty() || trial_.run.startState != nullptr) return {};  // a state knows which bodies touch
        if (!hasSeveral() && (pointwise_.empty() || trial_.colliders.empty())) return {};
        auto built = std::make_unique<World>(trial_);
        letPassWhatStartsInEachOther(WorldAccess::of(*built));
        if (!entangled_.empty()) built = std::make_unique<World>(trial_);
        World& world = *built;
        WorldImpl& w = WorldAccess::of(world);
        if (!touchesAny(w)) return found_;
        findPosts(w);
        if (w.islands.size() + w.waiting.size() < 2 && posts_.empty()) return found_;
        const std::int64_t last = Ticks(trial_.run).last();
        double work = 0;
        try {
            while (world.tick() < last && work < most && core::processorSeconds() < end && !world.advance()) {
                for (const BodyContact& c : w.contactReport.contacts())
                    if (c.first != nullptr && c.second != nullptr) add(*c.first, *c.second);
                addPosts(*w.contactStage);
                for (const contact::Crossing& c : w.contactStage->crossingsBefore()) add(*w.contactStage, c);
                work = workOf(w);
            }
        } catch (const core::Error& error) {
            if (error.kind() != core::ErrorKind::badContent) throw;
        }
        found_.seen = world.tick() < last ? world.time() : trial_.run.seconds;
        return found_;
    }

  private:
    bool hasSeveral() const {
        int count = 0;
        for (const BodySpec& body : trial_.bodies)
            count += body.array.count.x * body.array.count.y * body.array.count.z;
        return count > 1;
    }

    void findPosts(const WorldImpl& world) {
        const std::map<std::string, double> widths = colliderWidths(world);
        const auto look = [&](const Body& body) {
            for (const auto& [collider, width] : widths)
                if (pointwise_.contains(body.spec->fullName()) && width < longestEdge(body))
                    posts_[{body.fullName(), collider}] = width;
        };
        for (const Body* body : bodiesOf(world)) look(*body);
        for (const auto& body : world.waiting) look(*body);
    }

    void addPosts(const ContactStage& stage) {
        if (posts_.empty()) return;
        for (const ElementTouch& touch : stage.elementTouches()) {
            if (touch.collider < 0 || touch.gap > touch.closing) continue;
            const auto post = posts_.find({stage.nameOf(touch.surface), stage.colliderName(touch.collider)});
            if (post != posts_.end()) found_.posts.insert(*post);
        }
    }

    void letPassWhatStartsInEachOther(WorldImpl& w) {
        if (!touchesAny(w)) return;
        for (const BodyCrossing& c : crossingsOf(w)) add(*c.ofEdge, *c.ofTriangle);
        for (const auto& [surfaces, points] : pointsInOnePlace(*w.contactStage))
            add(w.contactStage->bodyOf(surfaces.first), w.contactStage->bodyOf(surfaces.second));
        for (BodySpec& body : trial_.bodies)
            if (entangled_.contains(body.fullName())) body.touch = Touch::nothing;
    }

    void add(const ContactStage& stage, const contact::Crossing& crossing) {
        const contact::Elements& elements = stage.elements();
        const int a = elements.edges()[crossing.edge].surface;
        const int b = elements.triangles()[crossing.triangle].surface;
        if (stage.isOfBody(a) && stage.isOfBody(b)) add(stage.bodyOf(a), stage.bodyOf(b));
    }

    void add(const Body& a, const Body& b) {
        const bool areSilent[] = {silent_.contains(a.spec->fullName()), silent_.contains(b.spec->fullName())};
        if (a.island == b.island || (!areSilent[0] && !areSilent[1])) return;
        if (areSilent[0]) entangled_.insert(a.spec->fullName());
        if (areSilent[1]) entangled_.insert(b.spec->fullName());
        const bool isBefore = sortsBefore(a, b);
        found_.pairs.emplace((isBefore ? a : b).fullName(), (isBefore ? b : a).fullName());
    }

    // [ns] Cost of all ticks so far.
    double workOf(const WorldImpl& world) {
        const ContactInfo contact = world.contactStage->info();
        contactWork_ +=
            contact.lastDetections * (perPointDetection * contact.points + perPair * contact.lastTestedPairs);
        double work = contactWork_;
        for (const auto& island : world.islands) {
            const ode::Work own = island->work();
            work += static_cast<double>(island->plan().points.size()) *
                    (perEvaluation * static_cast<double>(own.evaluations) +
                     perIteration * static_cast<double>(own.iterations));
        }
        return work;
    }

    SceneSpec trial_;
    std::set<std::string> silent_, entangled_, pointwise_;  // specs of bodies
    std::map<std::pair<std::string, std::string>, double> posts_;
    double contactWork_ = 0;  // [ns]
    Encounters found_;
};

}  // namespace

Encounters encounters(const SceneSpec& scene, double most, double end) {
    return LookAhead(scene).look(most, end);
}

}  // namespace taut::world
