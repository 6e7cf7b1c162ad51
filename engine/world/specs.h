// A list of structs of several kinds under one base, such as the bodies of a scene. It is a value: a copy of the list
// copies what is in it. And what makes a struct a kind that such lists and scene files know.
//
// To add a kind: derive from SpecOf<Own, Base>, give it a `kindName` and a `section()`, and add kindOf<Own>() to the
// table of kinds.
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

namespace taut::world {

// Pointers, shown as what they point to.
template <class Pointer>
class Pointees {
  public:
    struct Iterator {
        using iterator_category = std::input_iterator_tag;
        using value_type = std::remove_cvref_t<decltype(*Pointer())>;
        using difference_type = std::ptrdiff_t;
        using pointer = Pointer;
        using reference = decltype(*Pointer());
        typename std::vector<Pointer>::const_iterator at;
        auto& operator*() const { return **at; }
        Iterator& operator++() {
            ++at;
            return *this;
        }
        bool operator==(const Iterator&) const = default;
    };
    explicit Pointees(std::vector<Pointer> pointers) : pointers_(std::move(pointers)) {}

    Iterator begin() const { return {pointers_.begin()}; }
    Iterator end() const { return {pointers_.end()}; }
    std::size_t size() const { return pointers_.size(); }
    bool empty() const { return pointers_.empty(); }
    auto& operator[](std::size_t i) const { return *pointers_[i]; }
    auto& at(std::size_t i) const { return *pointers_.at(i); }
    auto& front() const { return *pointers_.front(); }
    auto& back() const { return *pointers_.back(); }

  private:
    std::vector<Pointer> pointers_;
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

    // A copy of it, of the kind that it is.
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

    template <class Item>
    struct Iterator {
        const std::unique_ptr<Base>* at;
        Item& operator*() const { return **at; }
        Iterator& operator++() {
            ++at;
            return *this;
        }
        bool operator==(const Iterator&) const = default;
    };
    Iterator<Base> begin() { return {all_.data()}; }
    Iterator<Base> end() { return {all_.data() + all_.size()}; }
    Iterator<const Base> begin() const { return {all_.data()}; }
    Iterator<const Base> end() const { return {all_.data() + all_.size()}; }
    Base& operator[](std::size_t i) { return *all_[i]; }
    const Base& operator[](std::size_t i) const { return *all_[i]; }

    Pointees<Base*> all() { return Pointees(pointers<Base*>(all_)); }
    Pointees<const Base*> all() const { return Pointees(pointers<const Base*>(all_)); }
    // Those of one kind, in their order.
    template <class Spec>
    Pointees<Spec*> of() {
        return Pointees(pointers<Spec*>(all_));
    }
    template <class Spec>
    Pointees<const Spec*> of() const {
        return Pointees(pointers<const Spec*>(all_));
    }

    // The one of that name, or null.
    const Base* find(std::string_view kind, std::string_view name) const {
        const auto found = std::find_if(all_.begin(), all_.end(), [&](const auto& spec) {
            return spec->name == name && spec->kind() == kind;
        });
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
        std::stable_sort(all_.begin(), all_.end(), [&](const auto& a, const auto& b) { return before(*a, *b); });
    }

  private:
    template <class Pointer, class All>
    static std::vector<Pointer> pointers(All& all) {
        std::vector<Pointer> found;
        for (auto& spec : all)
            if (auto* one = dynamic_cast<Pointer>(spec.get())) found.push_back(one);
        return found;
    }

    std::vector<std::unique_ptr<Base>> all_;
};

// Writes what every kind does alike.
template <class Own, class Base>
struct SpecOf : Base {
    std::string_view kind() const final { return Own::kindName; }
    decltype(std::declval<const Base&>().copy()) copy() const final {
        return std::make_unique<Own>(static_cast<const Own&>(*this));
    }
};

// What a scene file has to know of a kind: its section and a fresh struct for its fields.
template <class Base>
struct Kind {
    std::string name;
    fields::Section section;  // of a struct of this kind
    std::function<std::unique_ptr<Base>()> make;
};

template <class Own, class Base>
Kind<Base> kindOf() {
    return {std::string(Own::kindName), Own::section(), [] { return std::make_unique<Own>(); }};
}

}  // namespace taut::world
