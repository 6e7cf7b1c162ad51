// Entities and their components. Independent of component types.
//
// An entity is a cloth, a rope, a collider, a camera; never a point. Pools are plain arrays in the order of insertion,
// so that iteration is the same in every run, with an index by entity beside them (a sparse set).
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <typeindex>
#include <utility>
#include <vector>

#include "taut/core/error.h"
#include "taut/ecs/entity.h"

namespace taut::ecs {

class Registry {
  public:
    Entity create();  // without components
    // Removes the entity and all its components; expects that it is alive.
    void destroy(Entity entity);
    bool isAlive(Entity entity) const;
    std::size_t size() const { return alive_; }  // entities alive

    // Gives the entity a component, replacing one of the same type. The reference holds until the next add or remove
    // of that type.
    template <class C>
    C& add(Entity entity, C component) {
        TAUT_EXPECTS(isAlive(entity));
        Pool<C>& pool = poolOf<C>();
        if (C* old = find<C>(entity)) return *old = std::move(component);
        return pool.add(entity, std::move(component));
    }

    template <class C>
    void remove(Entity entity) {
        if (Pool<C>* pool = findPool<C>()) pool->erase(entity);
    }

    // nullptr when the entity has none.
    template <class C>
    C* find(Entity entity) {
        return const_cast<C*>(std::as_const(*this).find<C>(entity));
    }
    template <class C>
    const C* find(Entity entity) const {
        const Pool<C>* pool = findPool<C>();
        return pool == nullptr ? nullptr : pool->find(entity);
    }

    // Calls f(entity, c, more…) for every entity that has all these components, in the order in which the first was
    // added. f may create and destroy entities: the loop visits the entities that existed at its start and still exist.
    template <class C, class... More, class F>
    void each(F&& f) {
        const Pool<C>* pool = findPool<C>();
        if (pool == nullptr) return;
        const std::vector<Entity> owners = pool->owners;
        for (Entity entity : owners)
            if (C* first = find<C>(entity); first != nullptr && (... && (find<More>(entity) != nullptr)))
                f(entity, *first, *find<More>(entity)...);
    }
    template <class C, class... More, class F>
    void each(F&& f) const {
        const Pool<C>* pool = findPool<C>();
        if (pool == nullptr) return;
        for (Entity entity : pool->owners)
            if ((... && (find<More>(entity) != nullptr))) f(entity, *find<C>(entity), *find<More>(entity)...);
    }

  private:
    struct AnyPool {
        virtual ~AnyPool() = default;
        virtual void erase(Entity entity) = 0;
    };
    template <class C>
    struct Pool final : AnyPool {
        static constexpr std::size_t none = static_cast<std::size_t>(-1);
        std::vector<Entity> owners;                  // in the order of adding
        std::vector<std::unique_ptr<C>> components;  // (owners)
        std::vector<std::size_t> placeOf;            // (places of entities) in owners, or none

        std::size_t place(Entity entity) const {
            if (entity.index >= placeOf.size() || placeOf[entity.index] == none) return none;
            const std::size_t at = placeOf[entity.index];
            return owners[at] == entity ? at : none;
        }
        const C* find(Entity entity) const {
            const std::size_t at = place(entity);
            return at == none ? nullptr : components[at].get();
        }
        C& add(Entity entity, C component) {
            if (entity.index >= placeOf.size()) placeOf.resize(entity.index + std::size_t{1}, none);
            placeOf[entity.index] = owners.size();
            owners.push_back(entity);
            components.push_back(std::make_unique<C>(std::move(component)));
            return *components.back();
        }
        void erase(Entity entity) override {
            const std::size_t at = place(entity);
            if (at == none) return;
            components.erase(components.begin() + static_cast<std::ptrdiff_t>(at));
            owners.erase(owners.begin() + static_cast<std::ptrdiff_t>(at));
            placeOf[entity.index] = none;
            for (std::size_t i = at; i < owners.size(); ++i) placeOf[owners[i].index] = i;
        }
    };
    template <class C>
    Pool<C>* findPool() {
        return const_cast<Pool<C>*>(std::as_const(*this).findPool<C>());
    }
    template <class C>
    const Pool<C>* findPool() const {
        const auto found = pools_.find(std::type_index(typeid(C)));
        return found == pools_.end() ? nullptr : static_cast<const Pool<C>*>(found->second.get());
    }
    template <class C>
    Pool<C>& poolOf() {
        std::unique_ptr<AnyPool>& pool = pools_[std::type_index(typeid(C))];
        if (!pool) pool = std::make_unique<Pool<C>>();
        return static_cast<Pool<C>&>(*pool);
    }

    std::vector<std::uint32_t> generations_;  // (places) odd while alive
    std::vector<std::uint32_t> free_;
    std::size_t alive_ = 0;
    std::map<std::type_index, std::unique_ptr<AnyPool>> pools_;
};

}  // namespace taut::ecs
