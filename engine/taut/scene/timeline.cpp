#include "taut/scene/private/timeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "taut/fields/private/value_reader.h"
#include "taut/joints/joints.h"
#include "taut/plan/private/ties.h"
#include "taut/scene/private/body_index.h"
#include "taut/scene/private/ramp_key.h"
#include "taut/spec/actions.h"
#include "taut/spec/targets.h"
#include "taut/spec/ticks.h"

namespace taut::scene {

namespace {

using namespace world;

struct Event {
    ActionSpec* action = nullptr;
    const Node* item = nullptr;
    std::int64_t tick = 0;
    std::size_t order = 0;  // in which it happens

    template <class Own>
    Own* as() const {
        return dynamic_cast<Own*>(action);
    }
};

// The time span in which a hand, a collider or a value is on its way.
struct Span {
    double begin = 0, end = 0;  // [s]
};

class Timeline {
  public:
    Timeline(const Node& root, const std::vector<SceneSection>& sections, const BodyIndex& bodies, ReadScene& scene,
             Problems& problems)
        : root_(root),
          sections_(sections),
          scene_(scene),
          problems_(problems),
          bodies_(bodies),
          ticks_(scene.spec.run) {}

    void check() {
        collect();
        for (const Event& event : events_)
            if (const auto* spawn = event.as<SpawnAction>()) enterSpawn(event, spawn->target);
        for (const Event& event : events_) checkEvent(event);
        checkSeams();
    }

  private:
    // Collects the actions without faults, in the order in which they happen.
    void collect() {
        const Node* list = root_.at("at");
        for (std::size_t i = 0; i < scene_.spec.actions.size(); ++i) {
            if (scene_.faulty.contains(fmt::format("at[{}]", i))) continue;
            ActionSpec& action = scene_.spec.actions[i];
            events_.push_back({&action, &list->items[i], ticks_.at(action.t), 0});
        }
        std::stable_sort(events_.begin(), events_.end(),
                         [](const Event& a, const Event& b) { return a.action->t < b.action->t; });
        for (std::size_t i = 0; i < events_.size(); ++i) events_[i].order = i;
    }

    static Place placeOf(const Event& event, const char* key) {
        const Node* value = event.item->at(key);
        return value == nullptr ? event.item->place : value->place;
    }
    void error(const Event& event, const char* key, std::string message, std::string remedy = {}) {
        problems_.addError(placeOf(event, key), std::move(message), std::move(remedy));
    }
    // Returns whether there was a fault.
    bool report(const Event& event, const char* key, const std::optional<TargetFault>& fault) {
        if (fault) error(event, key, fault->message, fault->remedy);
        return fault.has_value();
    }

    void enterSpawn(const Event& event, const std::string& target) {
        if (report(event, "target", bodies_.bodyFault(target))) return;
        for (const std::string& name : bodies_.names(target)) {
            const auto [before, isNew] = spawns_.emplace(name, event.order);
            if (!isNew)
                error(event, "target",
                      fmt::format("{} is spawned already at {} s", name, events_[before->second].action->t));
        }
        for (const JointSpec& joint : scene_.spec.joints) {
            if (isTie(joint)) continue;
            std::vector<std::string> ends = joint.a.targets;
            ends.insert(ends.end(), joint.b.targets.begin(), joint.b.targets.end());
            for (const std::string& end : ends) {
                for (const BodyEntry* body : bodies_.matches(end)) {
                    const auto tied = bodies_.matches(target);
                    if (std::find(tied.begin(), tied.end(), body) == tied.end()) continue;
                    return error(event, "target", fmt::format("a joint ties {}: it cannot be spawned", body->title()));
                }
            }
        }
    }

    void checkEvent(const Event& event) {
        if (event.tick >= ticks_.last() && !isLengthOverridden(root_))
            error(event, "t",
                  fmt::format("{} s is past the end: the last frame shows {:.6g} s", event.action->t,
                              ticks_.secondsOf(ticks_.last())),
                  "set seconds in [run]");
        if (const auto* onPoints = event.as<PointsAction>()) checkTarget(event, onPoints->target);
        if (const auto* hold = event.as<HoldAction>()) checkHold<FreeAction>(event, *hold);
        if (const auto* free = event.as<FreeAction>()) checkHold<HoldAction>(event, *free);
        if (const auto* grab = event.as<GrabAction>()) checkGrab(event, grab->id);
        if (const auto* move = event.as<MoveAction>())
            move->id.empty() ? checkColliderMove(event, *move) : checkHandMove(event, *move);
        if (const auto* release = event.as<ReleaseAction>()) checkRelease(event, release->id);
        if (auto* ramp = event.as<RampAction>()) checkRamp(event, *ramp);
        if (const auto* cut = event.as<CutAction>()) checkCut(event, *cut);
    }

    // Returns whether the target is valid and exists at that moment.
    bool checkTarget(const Event& event, const std::string& target) {
        if (report(event, "target", bodies_.targetFault(target))) return false;
        const Event* earliest = nullptr;
        for (const std::string& name : bodies_.names(target)) {
            const auto spawn = spawns_.find(name);
            if (spawn == spawns_.end() || spawn->second < event.order) return true;
            const Event& birth = events_[spawn->second];
            if (earliest == nullptr || birth.order < earliest->order) earliest = &birth;
        }
        if (earliest == nullptr) return true;  // a faulty body
        error(event, "target",
              fmt::format("{} is not there before it is spawned at {} s", target, earliest->action->t));
        return false;
    }

    void checkGrab(const Event& event, const std::string& id) {
        if (id.empty()) return error(event, "id", "a hand needs a name");
        if (isJoint(id))
            return error(event, "id", fmt::format("\"{}\" is the name of a joint", id),
                         "give the hand another id, because release takes the name of either");
        if (const auto held = grabbed_.find(id); held != grabbed_.end())
            return error(event, "id", fmt::format("\"{}\" holds something since {} s", id, held->second->action->t),
                         "release it first, or give this hand another id");
        known_.push_back(id);
        grabbed_.emplace(id, &event);
        spans_.erase("hand " + id);
    }

    bool isJoint(const std::string& id) const {
        return std::any_of(
            scene_.spec.joints.begin(), scene_.spec.joints.end(),
            [&](const JointSpec& joint) { return joint.name == id; });
    }

    void checkRelease(const Event& event, const std::string& id) {
        if (!id.empty() && isJoint(id)) {
            const auto [before, isFirst] = letGo_.emplace(id, &event);
            if (!isFirst)
                error(event, "id",
                      fmt::format("the joints \"{}\" are released already at {} s", id, before->second->action->t));
            return;
        }
        std::vector<std::string> joints;
        for (const JointSpec& joint : scene_.spec.joints)
            if (!joint.name.empty()) joints.push_back(joint.name);
        const bool areUnnamed = joints.empty() && !scene_.spec.joints.empty();
        if (checkHeld(event, id, joints, areUnnamed ? "a joint or a seam is released by its name; give it one" : ""))
            grabbed_.erase(id);
    }

    // Returns whether the hand holds something. If not, reports it with suggestions.
    bool checkHeld(const Event& event, const std::string& id, std::vector<std::string> joints = {},
                   const std::string& otherwise = {}) {
        if (grabbed_.contains(id)) return true;
        const double t = event.action->t;
        if (std::find(known_.begin(), known_.end(), id) != known_.end()) {
            error(event, "id", fmt::format("\"{}\" was released before {} s", id, t));
            return false;
        }
        std::string message = fmt::format("\"{}\" has grabbed nothing before {} s", id, t);
        if (!joints.empty()) message += ", and no joint has that name";
        joints.insert(joints.begin(), known_.begin(), known_.end());
        const std::string remedy = suggestion(id, joints);
        error(event, "id", message, remedy.empty() ? otherwise : remedy);
        return false;
    }

    void checkHandMove(const Event& event, const MoveAction& move) {
        if (checkHeld(event, move.id)) checkSpan(event, move.over, "hand " + move.id, "\"" + move.id + "\"", "moved");
    }

    void checkColliderMove(const Event& event, const MoveAction& move) {
        const std::string& target = move.target;
        std::vector<std::string> names;
        for (const ColliderSpec& collider : scene_.spec.colliders) {
            names.push_back("collider." + collider.name);
            if (names.back() != target) continue;
            if (!collider.keys.empty())
                return error(event, "target", fmt::format("{} follows its keys", target),
                             "move it by keys or by actions");
            return checkSpan(event, move.over, target, target, "moved");
        }
        std::string remedy = suggestion(target, names);
        if (target.starts_with("collider."))
            return error(event, "target", fmt::format("there is no {}", target), remedy);
        error(event, "target", fmt::format("\"{}\" is no collider", target),
              remedy.empty() ? "a move takes a collider, or the id of a hand" : remedy);
    }

    void checkRamp(const Event& event, RampAction& ramp) {
        TargetFault fault;
        std::optional<RampKey> key = rampKey(ramp.key, root_, sections_, scene_.spec, fault);
        if (!key) return void(report(event, "key", fault));
        ramp.field = key->access;
        const Node& to = *event.item->at("to");
        const std::optional<Value> value = fieldValue(*key->field, to, problems_);
        if (!value) return;
        if (const double* number = std::get_if<double>(&*value)) ramp.value = {*number};
        if (const auto* numbers = std::get_if<std::vector<double>>(&*value)) ramp.value = *numbers;
        checkSpan(event, ramp.over, "ramp " + ramp.key, ramp.key, "changed");
    }

    void checkSeams() {
        const Node* list = root_.at("seam");
        std::map<std::array<std::string, 2>, std::string> known;  // where each is
        std::size_t number = 0;
        for (const JointSpec& joint : scene_.spec.joints) {
            if (!joint.isSeam()) continue;
            const Node& item = list->items[number++];
            const auto* seam = dynamic_cast<const world::SeamJoint*>(&joint);
            if (seam == nullptr) continue;
            const std::array sides{std::min(seam->a.text(), seam->b.text()), std::max(seam->a.text(), seam->b.text())};
            const auto [before, isNew] = known.emplace(sides, fmt::format("line {}", item.place.line));
            if (!isNew)
                problems_.addError(item.place, fmt::format("this seam is there already, in {}", before->second));
            const double end = ticks_.secondsOf(ticks_.last());
            if (seam->start + seam->over <= scene_.spec.run.seconds || isLengthOverridden(root_)) continue;
            const Node* start = item.at("start_s");
            if (start != nullptr && seam->start >= end)
                problems_.addError(
                    start->place,
                    fmt::format("{:g} s is past the end: the last frame shows {:.6g} s", seam->start, end),
                    "set seconds in [run]");
            else
                problems_.addWarning(item.at("over_s") != nullptr ? item.at("over_s")->place : item.place,
                                     fmt::format("the seam is closed after {:g} s, and the last frame shows {:.6g} s",
                                                 seam->start + seam->over, end));
        }
    }

    // Two ways at once contradict each other, but one may begin where the other ends.
    void checkSpan(const Event& event, double over, const std::string& key, const std::string& name, const char* done) {
        const Span span{event.action->t, event.action->t + over};
        const auto [before, isFirst] = spans_.emplace(key, span);
        if (isFirst) return;
        const double slack = 0.5 / ticks_.perSecond;
        const bool isSameMoment = ticks_.at(before->second.begin) == event.tick;
        if (span.begin < before->second.end - slack || isSameMoment)
            error(event, "t",
                  fmt::format("{} is {} from {:.9g} s to {:.9g} s already", name, done, before->second.begin,
                              before->second.end));
        before->second = {span.begin, std::max(span.end, before->second.end)};
    }

    // Reports points that are held and freed in one tick. It does not compare different selectors.
    template <class Opposite>
    void checkHold(const Event& event, const PointsAction& own) {
        const auto selectorOf = [](const std::string& target) {
            const std::string selector = world::parseTarget(target).selector;
            return selector.empty() ? "all" : selector;
        };
        const std::string selector = selectorOf(own.target);
        const std::vector<std::string> names = bodies_.names(own.target);
        for (std::size_t i = 0; i < event.order; ++i) {
            const Event& other = events_[i];
            const auto* opposite = other.as<Opposite>();
            if (other.tick != event.tick || opposite == nullptr || opposite->near || own.near) continue;
            const std::string otherSelector = selectorOf(opposite->target);
            if (selector != otherSelector && selector != "all" && otherSelector != "all") continue;
            for (const std::string& name : bodies_.names(opposite->target)) {
                if (std::find(names.begin(), names.end(), name) == names.end()) continue;
                return error(event, "target", fmt::format("points of {} are held and freed at the same moment", name));
            }
        }
    }

    void checkCut(const Event& event, const CutAction& cut) {
        const std::string& target = cut.target;
        if (!checkTarget(event, target)) return;
        if (target.find('@') != std::string::npos) {
            report(event, "target", bodies_.bodyFault(target));
        } else if (cut.from) {
            for (const BodyEntry* body : bodies_.matches(target)) {
                if (body->outline.isGrid) continue;
                return error(event, "target", fmt::format("{} is no cloth grid: it has no segment", body->title()),
                             "cut it with a plane");
            }
        }
    }

    const Node& root_;
    const std::vector<SceneSection>& sections_;
    ReadScene& scene_;
    Problems& problems_;
    const BodyIndex& bodies_;
    Ticks ticks_;
    std::vector<Event> events_;
    std::map<std::string, std::size_t> spawns_;    // by body: order of its spawn
    std::map<std::string, const Event*> grabbed_;  // by hand: its grab
    std::map<std::string, const Event*> letGo_;    // by name of joints: their release
    std::vector<std::string> known_;               // hands that have grabbed something so far
    std::map<std::string, Span> spans_;
};

}  // namespace

void checkTimeline(const Node& root, const std::vector<SceneSection>& sections, const BodyIndex& bodies,
                   ReadScene& scene, Problems& problems) {
    Timeline(root, sections, bodies, scene, problems).check();
}

bool isLengthOverridden(const Node& root) {
    const Node* seconds = root.along({"run", "seconds"});
    return seconds != nullptr && seconds->place.origin > 0;
}

}  // namespace taut::scene
