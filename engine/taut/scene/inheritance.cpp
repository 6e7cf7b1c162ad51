#include "taut/scene/private/inheritance.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "taut/scene/private/merge.h"

namespace taut::scene {

namespace {

constexpr std::size_t longestChain = 16;       // of elements that are like one another
constexpr std::size_t mostValues = 1'000'000;  // that are inherited in all; only a slip or an attack needs more

std::size_t valuesIn(const Node& node) {
    std::size_t count = 1;
    for (const Node& item : node.items) count += valuesIn(item);
    for (const Member& member : node.members) count += valuesIn(member.value);
    return count;
}

// Removes keys that only `below` gives and that do not fit the form of the table, stand in place of one of its own, or
// go with one of which it has its own.
void eraseUnfit(const Section& section, const Node& own, Node& table) {
    const std::string variant = section.variant ? section.variant(table) : "";
    std::erase_if(table.members, [&](Member& member) {
        const Field* field = section.find(member.key);
        if (field == nullptr) return false;
        const Member* said = own.find(member.key);
        if (field->kind == FieldKind::table && member.value.kind == NodeKind::table)
            eraseUnfit(field->inside.front(), said != nullptr ? said->value : Node{}, member.value);
        if (said != nullptr) return false;
        if (!field->goesWith.empty() && own.find(field->goesWith) != nullptr) return true;
        const auto isOther = [&](const Field& other) {
            return own.find(other.key) != nullptr && (other.inPlaceOf == field->key || field->inPlaceOf == other.key);
        };
        return std::any_of(section.fields.begin(), section.fields.end(), isOther) ||
               (!variant.empty() && !field->only.empty() &&
                std::find(field->only.begin(), field->only.end(), variant) == field->only.end());
    });
}

// The named elements of one section.
class Elements {
  public:
    Elements(const SceneSection& section, const Node* defaults, const Node* materials, Node& table, std::size_t& taken,
             Problems& problems)
        : section_(section),
          defaults_(defaults),
          materials_(materials),
          table_(table),
          taken_(taken),
          problems_(problems) {
        for (const Member& element : table.members) byName_.emplace(element.key, &element);
    }

    void inherit() {
        std::vector<Node> whole;
        for (const Member& element : table_.members)
            whole.push_back(element.value.kind == NodeKind::table ? wholeOf(element) : element.value);
        for (std::size_t i = 0; i < whole.size(); ++i) table_.members[i].value = std::move(whole[i]);
    }

  private:
    std::string titleOf(const Member& element) const { return section_.name + "." + element.key; }

    Node wholeOf(const Member& element) {
        Node whole = element.value;
        for (const Node* below : belowOf(element)) {
            if (taken_ > mostValues) return whole;
            taken_ += valuesIn(*below);
            if (taken_ > mostValues)
                problems_.addError(element.place, "this scene takes too many values over by defaults and like");
            Node sum = merged(*below, whole);
            eraseUnfit(section_, whole, sum);
            sum.place = element.value.place;
            sum.end = element.value.end;
            whole = std::move(sum);
        }
        const Member* like = whole.find("like");
        if (like != nullptr && like->value.kind == NodeKind::text)
            std::erase_if(whole.members, [](const Member& member) { return member.key == "like"; });
        return whole;
    }

    // The layers below an element, the nearest first and the defaults last.
    std::vector<const Node*> belowOf(const Member& element) {
        std::vector<const Member*> chain{&element};
        while (const Member* next = likeOf(*chain.back())) {
            const bool isNew = std::find(chain.begin(), chain.end(), next) == chain.end();
            chain.push_back(next);
            if (isNew && chain.size() <= longestChain) continue;
            // Each element of a circle reports it; one that leads into it reports nothing.
            if (next == chain.front())
                reportCircle(chain);
            else if (isNew && !std::exchange(hasLongChain_, true))
                problems_.addError(element.value.at("like")->place,
                                   fmt::format("{} is the first of more than {} that are like one another",
                                               titleOf(element), longestChain),
                                   "name one nearer to the end of the chain");
            chain.resize(1);
            break;
        }
        std::vector<const Node*> below;
        for (std::size_t i = 1; i < chain.size(); ++i) below.push_back(&chain[i]->value);
        if (defaults_ != nullptr) below.push_back(defaults_);
        addMaterial(element, below);
        return below;
    }

    // The values in the element's material for its section, just ahead of the defaults.
    void addMaterial(const Member& element, std::vector<const Node*>& below) const {
        const Member* name = element.value.find("material");
        for (const Node* layer : below)
            if (name == nullptr) name = layer->find("material");
        if (name == nullptr || materials_ == nullptr) return;
        // One that is missing is reported with the references.
        if (const Node* things = materials_->along({name->value.text, section_.name}))
            below.insert(below.end() - (defaults_ != nullptr ? 1 : 0), things);
    }

    void reportCircle(const std::vector<const Member*>& chain) {
        std::vector<std::string> titles;
        for (const Member* element : chain) titles.push_back(titleOf(*element));
        problems_.addError(chain.front()->value.at("like")->place,
                           fmt::format("{} is like itself: {}", titles.front(), joined(titles, " -> ")));
    }

    // The element that another is like; null if it names none or a missing one.
    const Member* likeOf(const Member& element) {
        const Member* like = element.value.kind == NodeKind::table ? element.value.find("like") : nullptr;
        if (like == nullptr || like->value.kind != NodeKind::text) return nullptr;  // reported by the reader
        std::string name = like->value.text;
        if (name.starts_with(section_.name + ".")) name.erase(0, section_.name.size() + 1);
        if (const auto other = byName_.find(name); other != byName_.end()) return other->second;
        std::vector<std::string> names;
        for (const Member& candidate : table_.members)
            if (&candidate != &element) names.push_back(candidate.key);
        const bool isOfAnother = name.find('.') != std::string::npos;
        problems_.addError(
            like->value.place,
            isOfAnother ? fmt::format("a {} cannot be like {}", section_.name, name)
                        : fmt::format("there is no {} \"{}\"", section_.name, name),
            isOfAnother ? fmt::format("name a {} of this scene", section_.name) : suggestion(name, names));
        return nullptr;
    }

    const SceneSection& section_;
    const Node* defaults_;
    const Node* materials_;
    Node& table_;
    std::map<std::string, const Member*> byName_;
    std::size_t& taken_;
    bool hasLongChain_ = false;  // once a section
    Problems& problems_;
};

bool isSame(const Place& a, const Place& b) {
    return a.origin == b.origin && a.line == b.line && a.column == b.column;
}

// Warns of defaults that no element has taken, as the materials of some have their own. `path`: inside the defaults.
void warnOfHidden(const std::string& section, const Node& defaults, const KeyPath& path, const Node& elements,
                  const Node& materials, Problems& problems) {
    for (const Member& member : defaults.members) {
        KeyPath own = path;
        own.push_back(member.key);
        if (member.value.kind == NodeKind::table) {
            warnOfHidden(section, member.value, own, elements, materials, problems);
            continue;
        }
        KeyPath inMaterial{"", section};
        inMaterial.insert(inMaterial.end(), own.begin(), own.end());
        std::string hiddenBy;
        bool isTaken = false;
        for (const Member& element : elements.members) {
            const Node* value = element.value.along(own);
            isTaken = isTaken || (value != nullptr && isSame(value->place, member.value.place));
            inMaterial.front() = element.value.textAt("material");
            if (materials.along(inMaterial) != nullptr) hiddenBy = inMaterial.front();
        }
        if (isTaken || hiddenBy.empty()) continue;
        problems.addWarning(member.place,
                            fmt::format("no {} takes this {}: that of its material, {}, comes first", section,
                                        joined(own, "."), hiddenBy),
                            fmt::format("write it in the {} itself", section));
    }
}

}  // namespace

void inherit(const std::vector<SceneSection>& sections, Node& root, Problems& problems) {
    const auto stands = std::find_if(root.members.begin(), root.members.end(),
                                     [](const Member& member) { return member.key == "defaults"; });
    if (stands != root.members.end()) std::rotate(root.members.begin(), stands, stands + 1);
    std::size_t taken = 0;
    for (const SceneSection& section : sections) {
        Member* elements = root.find(section.name);
        if (section.layout != Layout::named || elements == nullptr || elements->value.kind != NodeKind::table) continue;
        const Node* own = root.along({"defaults", section.name});
        const bool isTable = own != nullptr && own->kind == NodeKind::table;
        const Node* materials = section.name != "material" ? root.at("material") : nullptr;
        Elements(section, isTable ? own : nullptr, materials, elements->value, taken, problems).inherit();
        if (isTable && materials != nullptr)
            warnOfHidden(section.name, *own, {}, elements->value, *materials, problems);
    }
}

}  // namespace taut::scene
