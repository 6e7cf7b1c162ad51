#include "taut/ecs/registry.h"

#include <gtest/gtest.h>

#include <string>

namespace taut::ecs {
namespace {

struct Name {
    std::string text;
};
struct Weight {
    double kg;
};

TEST(Registry, AnEntityHasWhatItWasGiven) {
    Registry registry;
    const Entity a = registry.create(), b = registry.create();
    registry.add(a, Name{"a"});
    registry.add(b, Weight{2.0});
    ASSERT_NE(registry.find<Name>(a), nullptr);
    EXPECT_EQ(registry.find<Name>(a)->text, "a");
    EXPECT_EQ(registry.find<Name>(b), nullptr);
    registry.add(a, Name{"again"});
    EXPECT_EQ(registry.find<Name>(a)->text, "again");
    registry.remove<Name>(a);
    EXPECT_EQ(registry.find<Name>(a), nullptr);
    EXPECT_EQ(registry.size(), 2U);
}

TEST(Registry, AnEntityInTheSamePlaceIsAnother) {
    Registry registry;
    const Entity a = registry.create();
    registry.add(a, Name{"a"});
    registry.destroy(a);
    const Entity b = registry.create();
    EXPECT_EQ(a.index, b.index);
    EXPECT_FALSE(registry.isAlive(a));
    EXPECT_TRUE(registry.isAlive(b));
    EXPECT_EQ(registry.find<Name>(b), nullptr);
    EXPECT_EQ(registry.find<Name>(a), nullptr);
}

TEST(Registry, IteratesInTheOrderOfAddingOverThoseThatHaveAll) {
    Registry registry;
    std::string order;
    for (char c : std::string("dacb")) {
        const Entity entity = registry.create();
        registry.add(entity, Name{std::string(1, c)});
        if (c != 'a') registry.add(entity, Weight{1.0});
    }
    registry.each<Name, Weight>([&](Entity, const Name& name, const Weight&) { order += name.text; });
    EXPECT_EQ(order, "dcb");
}

TEST(Registry, MayBeChangedWhileIterating) {
    Registry registry;
    const Entity a = registry.create(), b = registry.create();
    registry.add(a, Name{"a"});
    registry.add(b, Name{"b"});
    int visits = 0;
    registry.each<Name>([&](Entity entity, Name&) {
        ++visits;
        if (entity == a) {
            registry.destroy(b);
            registry.add(registry.create(), Name{"new"});
        }
    });
    EXPECT_EQ(visits, 1);
    EXPECT_EQ(registry.size(), 2U);
}

}  // namespace
}  // namespace taut::ecs
