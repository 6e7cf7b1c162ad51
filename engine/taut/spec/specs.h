// A list of structs of several kinds with one base, such as the bodies of a scene. It is a value: a copy of the list
// copies its items. Also here: the requirements on a struct to be a kind for such lists and scene files.
//
// To add a kind: derive from SpecOf<Own, Base>, and add bodyKind<Own>(), forceKind<Own>() or actionKind<Own>(rows)
// (common_rows.h) to a table of kinds.
#pragma once

#include <algorithm>
#include <concepts>
#include <functional>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "taut/fields/field.h"

namespace taut::collision {
class ShapeKinds;
}

namespace taut::world {

// Iterates over pointers of any sort and gives the Items to which they point.
template <class Item, class Pointer>
struct Pointee {
    using iterator_category = std::input_iterator_tag;
    using value_type = std::remove_const_t<Item>;
    using difference_type = std::ptrdiff_t;
    using pointer = Item*;
    using reference = Item&;
    const Pointer* at;
    Item& operator*() const { return **at; }
    Pointee& operator++() {
        ++at;
        return *this;
    }
    bool operator==(const Pointee&) const = default;
};

// Some items of a list, in its order. It is valid until the list changes.
template <class Item>
class Pointees {
  public:
    explicit Pointees(std::vector<Item*> items) : items_(std::move(items)) {}
    Pointee<Item, Item*> begin() const { return {items_.data()}; }
    Pointee<Item, Item*> end() const { return {items_.data() + items_.size()}; }
    std::size_t size() const { return items_.size(); }
    bool empty() const { return items_.empty(); }
    Item& operator[](std::size_t i) const { return *items_[i]; }
    Item& at(std::size_t i) const { return *items_.at(i); }
    Item& front() const { return *items_.front(); }
    Item& back() const { return *items_.back(); }

  private:
    std::vector<Item*> items_;
};

template <class Base>
class Specs {
  public:
    Specs() = default;
    Specs(const Specs& other) {
        for (const auto& spec : other.all_) all_.push_back(spec->copy());
    }
    template <std::derived_from<Base>... Own>
    requires(sizeof...(Own) > 0) Specs(const Own&... specs) { (add(specs), ...); }
    Specs(Specs&&) noexcept = default;
    Specs& operator=(Specs other) noexcept {
        all_.swap(other.all_);
        return *this;
    }

    // A copy of the same kind.
    template <class Spec>
    Spec& add(Spec spec) {
        return static_cast<Spec&>(add(std::unique_ptr<Base>(std::make_unique<Spec>(std::move(spec)))));
    }
    template <class First, class Second, class... More>
    void add(First first, Second second, More... more) {
        add(std::move(first));
        add(std::move(second), std::move(more)...);
    }
    Base& add(std::unique_ptr<Base> spec) { return *all_.emplace_back(std::move(spec)); }

    Pointee<Base, std::unique_ptr<Base>> begin() { return {all_.data()}; }
    Pointee<Base, std::unique_ptr<Base>> end() { return {all_.data() + all_.size()}; }
    Pointee<const Base, std::unique_ptr<Base>> begin() const { return {all_.data()}; }
    Pointee<const Base, std::unique_ptr<Base>> end() const { return {all_.data() + all_.size()}; }
    Base& operator[](std::size_t i) { return *all_[i]; }
    const Base& operator[](std::size_t i) const { return *all_[i]; }

    // The items of one kind.
    template <class Spec>
    Pointees<Spec> of() {
        return some<Spec>(all_);
    }
    template <class Spec>
    Pointees<const Spec> of() const {
        return some<const Spec>(all_);
    }

    // The item of that name, or null.
    const Base* find(std::string_view kind, std::string_view name) const {
        const auto found = std::find_if(all_.begin(), all_.end(),
                                        [&](const auto& spec) { return spec->name == name && spec->kind() == kind; });
        return found == all_.end() ? nullptr : found->get();
    }
    Base* find(std::string_view kind, std::string_view name) {
        return const_cast<Base*>(std::as_const(*this).find(kind, name));
    }

    std::size_t size() const { return all_.size(); }
    bool empty() const { return all_.empty(); }
    void clear() { all_.clear(); }

    template <class Before>
    void stableSort(Before before) {
        std::stable_sort(
            all_.begin(), all_.end(), [&](const auto& a, const auto& b) { return before(*a, *b); });
    }

  private:
    template <class Spec, class All>
    static Pointees<Spec> some(All& all) {
        std::vector<Spec*> found;
        for (auto& spec : all)
            if (auto* one = dynamic_cast<Spec*>(spec.get())) found.push_back(one);
        return Pointees<Spec>(std::move(found));
    }

    std::vector<std::unique_ptr<Base>> all_;
};

// The common part of all kinds.
template <class Own, class Base>
struct SpecOf : Base {
    std::string_view kind() const final { return Own::kindName; }
    decltype(std::declval<const Base&>().copy()) copy() const final {
        return std::make_unique<Own>(static_cast<const Own&>(*this));
    }
};

// Data of a kind for scene files: its section, and a new struct for its fields.
template <class Base>
struct Kind {
    std::string name;
    fields::Section section;  // of a struct of this kind
    std::function<std::unique_ptr<Base>()> make;
    // Its section for such a table of shapes; none: it has no shapes.
    std::function<fields::Section(const collision::ShapeKinds&)> sectionWith{};
};

template <class Own, class Base>
Kind<Base> kindOf() {
    return {std::string(Own::kindName), Own::section(), [] { return std::make_unique<Own>(); }};
}

}  // namespace taut::world
