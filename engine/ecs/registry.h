// Entities and their components: who exists, and what each has. It knows no component type.
//
// An entity is a cloth, a rope, a collider, a camera; never a point. There are dozens, not millions: pools are plain
// arrays that stay in the order of adding, so that iteration is the same in every run.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <typeindex>
#include <vector>

#include "taut/core/error.h"

namespace taut::ecs {

struct Entity {
    std::uint32_t index = 0;
    std::uint32_t generation = 0;  // tells an entity from a later one in the same place
    friend bool operator==(const Entity&, const Entity&) = default;
};

class Registry {
  public:
    Entity create();
    // Removes the entity and all its components; expects that it is alive.
    void destroy(Entity entity);
    bool isAlive(Entity entity) const;
    std::size_t size() const { return alive_; }

    // Gives the entity a component, replacing one of the same type. The reference holds until the next add or remove
    // of that type.
    template <class C>
    C& add(Entity entity, C component) {
        TAUT_EXPECTS(isAlive(entity));
        Pool<C>& pool = poolOf<C>();
        if (C* old = pool.find(entity)) return *old = std::move(component);
        pool.owners.push_back(entity);
        pool.components.push_back(std::make_unique<C>(std::move(component)));
        return *pool.components.back();
    }

    template <class C>
    void remove(Entity entity) {
        poolOf<C>().erase(entity);
    }

    // nullptr when the entity has none.
    template <class C>
    C* find(Entity entity) {
        return poolOf<C>().find(entity);
    }
    template <class C>
    const C* find(Entity entity) const {
        return const_cast<Registry*>(this)->poolOf<C>().find(entity);
    }

    // Calls f(entity, c, more…) for every entity that has all these components, in the order in which the first was
    // added. f may create and destroy entities: it sees those that existed and still exist.
    template <class C, class... More, class F>
    void each(F&& f) {
        const std::vector<Entity> owners = poolOf<C>().owners;
        for (Entity entity : owners)
            if (C* first = find<C>(entity); first != nullptr && (... && (find<More>(entity) != nullptr)))
                f(entity, *first, *find<More>(entity)...);
    }
    template <class C, class... More, class F>
    void each(F&& f) const {
        const_cast<Registry*>(this)->each<C, More...>(
            [&](Entity entity, const C& first, const More&... more) { f(entity, first, more...); });
    }

  private:
    struct AnyPool {
        virtual ~AnyPool() = default;
        virtual void erase(Entity entity) = 0;
    };
    template <class C>
    struct Pool final : AnyPool {
        std::vector<Entity> owners;
        std::vector<std::unique_ptr<C>> components;
        C* find(Entity entity) {
            const auto at = std::find(owners.begin(), owners.end(), entity);
            return at == owners.end() ? nullptr : components[static_cast<std::size_t>(at - owners.begin())].get();
        }
        void erase(Entity entity) override {
            const auto at = std::find(owners.begin(), owners.end(), entity);
            if (at == owners.end()) return;
            components.erase(components.begin() + (at - owners.begin()));
            owners.erase(at);
        }
    };
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
