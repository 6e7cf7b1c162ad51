// Many points at once get the results of each alone: kernels against the code that takes points one by one, and feet
// that last against feet found anew.
#include <gtest/gtest.h>

#include <memory>

#include "collision_support.h"
#include "taut/core/private/instruction_set.h"

namespace taut::collision::collision_batch {
namespace {

// The same shape without the data of kernels.
class Plain final : public Form {
  public:
    explicit Plain(std::shared_ptr<const Form> form) : form_(std::move(form)) {}
    Nearest nearest(const glm::dvec3& p) const override { return form_->nearest(p); }
    bool sweep(const Path& path, HalfSpace& touch, bool& crossed) const override {
        return form_->sweep(path, touch, crossed);
    }
    std::optional<core::Aabb> bounds() const override { return form_->bounds(); }
    bool isConvex() const override { return form_->isConvex(); }

  private:
    std::shared_ptr<const Form> form_;
};

std::vector<SizedShape> shapes() {
    return {planeShape({0.2, 1.0, -0.1}),    roundShape("sphere", 0.4),        boxShape({0.5, 0.2, 0.3}),
            roundShape("capsule", 0.2, 0.7), roundShape("cylinder", 0.4, 0.5), roundShape("cone", 0.4, 0.9)};
}

// A ball of 0.4 m whose surface is pushed in and out by up to `rough` [-] of that.
SizedShape ballMesh(std::uint32_t rings, double rough) {
    SizedShape ball;
    ball.kind = "mesh";
    const std::uint32_t around = 2 * rings;
    const auto add = [&](double down, double along) {
        const double wide = core::sine(down);
        const glm::dvec3 d(wide * core::cosine(along), core::cosine(down), wide * core::sine(along));
        const double out = core::sine(9.0 * d.x) * core::sine(8.0 * d.y + 1.0) * core::sine(7.0 * d.z + 2.0);
        ball.vertices.push_back(0.4 * (1.0 + rough * out) * d);
    };
    const auto at = [&](std::uint32_t ring, std::uint32_t k) { return (ring - 1) * around + k % around; };
    for (std::uint32_t ring = 1; ring < rings; ++ring)
        for (std::uint32_t k = 0; k < around; ++k) add(core::pi * ring / rings, 2.0 * core::pi * k / around);
    const auto top = static_cast<std::uint32_t>(ball.vertices.size()), bottom = top + 1;
    add(0.0, 0.0);
    add(core::pi, 0.0);
    for (std::uint32_t k = 0; k < around; ++k) {
        ball.triangles.insert(ball.triangles.end(), {top, at(1, k + 1), at(1, k)});
        ball.triangles.insert(ball.triangles.end(), {bottom, at(rings - 1, k), at(rings - 1, k + 1)});
        for (std::uint32_t ring = 1; ring + 1 < rings; ++ring)
            ball.triangles.insert(ball.triangles.end(), {at(ring, k), at(ring, k + 1), at(ring + 1, k), at(ring, k + 1),
                                                         at(ring + 1, k + 1), at(ring + 1, k)});
    }
    return ball;
}

std::vector<SizedShape> meshes() {
    return {boxMesh({0.5, 0.2, 0.3}), sheetMesh(0.5, 20), ballMesh(10, 0.0), ballMesh(16, 0.2)};
}

template <class Real>
struct Points {
    int count;
    std::vector<Real> before, x, v, inverseMass;
    double thickness = 0.0;
    std::vector<int> touched;
    std::vector<Contact> contacts;

    // Most ways are short, as in a step; some lead through the shapes, some points are held.
    Points(int n, Numbers& numbers) : count(n), before(places()), x(places()), v(places()) {
        for (int i = 0; i < n; ++i) {
            const glm::dvec3 from = numbers.point(0.6), way = numbers.point(i % 8 == 0 ? 1.0 : 0.02);
            for (int k = 0; k < 3; ++k) {
                const auto at = static_cast<std::size_t>(k * n + i);
                before[at] = static_cast<Real>(from[k]);
                x[at] = static_cast<Real>(from[k] + way[k]);
                v[at] = static_cast<Real>(way[k] * 100.0);
            }
            inverseMass.push_back(i % 50 == 0 ? Real(0) : Real(1));
        }
    }
    std::vector<Real> places() const { return std::vector<Real>(static_cast<std::size_t>(3 * count)); }
    MovingPoints<Real> moving() {
        MovingPoints<Real> points;
        points.last = points.stride = count;
        points.xBefore = before.data();
        points.x = x.data();
        points.v = v.data();
        points.inverseMass = inverseMass.data();
        points.thickness = thickness;
        return points;
    }
    void resolve(const Colliders& colliders, Feet& feet) {
        const MovingPoints<Real> points = moving();
        touched.clear();
        contacts.clear();
        colliders.resolve(std::span(&points, 1), 0.01, feet, touched, &contacts);
    }
};

template <class Real>
void expectSame(const Points<Real>& a, const Points<Real>& b) {
    EXPECT_EQ(a.x, b.x);
    EXPECT_EQ(a.v, b.v);
    EXPECT_EQ(a.touched, b.touched);
    ASSERT_EQ(a.contacts.size(), b.contacts.size());
    for (std::size_t c = 0; c < a.contacts.size(); ++c) {
        EXPECT_EQ(a.contacts[c].point, b.contacts[c].point);
        EXPECT_EQ(a.contacts[c].collider, b.contacts[c].collider);
        EXPECT_EQ(a.contacts[c].position, b.contacts[c].position);
        EXPECT_EQ(a.contacts[c].normal, b.contacts[c].normal);
        EXPECT_EQ(a.contacts[c].impulse, b.contacts[c].impulse);
        EXPECT_EQ(a.contacts[c].carried, b.contacts[c].carried);
        EXPECT_EQ(a.contacts[c].friction, b.contacts[c].friction);
    }
}

template <class Real>
class CollisionBatch : public testing::Test {};
using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(CollisionBatch, Precisions);

TYPED_TEST(CollisionBatch, KernelsGiveTheBitsOfPointsTakenOneByOne) {
    const Pose start{{0.1, -0.2, 0.05}, turned({1.0, 0.3, -0.6}, 0.9)};
    const Pose end{{0.105, -0.19, 0.05}, turned({1.0, 0.35, -0.6}, 0.91)};
    const Pose level{{0.1, -0.2, 0.05}, {1.0, 0.0, 0.0, 0.0}};
    const core::InstructionSet set = core::instructionSet();
    std::vector<SizedShape> all = shapes();
    for (const SizedShape& mesh : meshes()) all.push_back(mesh);
    for (const SizedShape& shape : all)
        for (const auto& [from, to] : {std::pair{level, level}, {start, start}, {start, end}})
            for (const Material& material : {Material{0.0, 0.0}, Material{0.4, 0.0}, Material{0.4, 0.5}}) {
                SCOPED_TRACE(shape.kind);
                Colliders fast, plain;
                fast.add(shape, material, from);
                plain.add({std::make_shared<Plain>(Shape(shape).form), {}}, material, from);
                fast.move(0, from, to);
                plain.move(0, from, to);
                Numbers numbers;
                Points<TypeParam> first(10000, numbers);
                first.thickness = material.restitution > 0.0 ? 0.0 : 0.01;
                Points<TypeParam> alone = first;
                Feet any;
                alone.resolve(plain, any);
                EXPECT_GT(alone.touched.size(), 200U);
                for (const auto isa :
                     {core::InstructionSet::sse2, core::InstructionSet::avx2, core::InstructionSet::avx512}) {
                    if (!core::isSupported(isa)) continue;
                    SCOPED_TRACE(core::nameOf(isa));
                    core::useInstructionSet(isa);
                    Points<TypeParam> together = first;
                    Feet none;
                    together.resolve(fast, none);
                    expectSame(together, alone);
                }
                core::useInstructionSet(set);
            }
}

TYPED_TEST(CollisionBatch, FeetThatLastGiveTheBitsOfFeetFoundAnew) {
    // A swarm that oscillates through shapes of which one spins, one comes and goes, and one jumps.
    Colliders colliders;
    for (const SizedShape& shape : shapes()) colliders.add(shape, {0.4, 0.3}, {{0.0, -0.9, 0.0}, {1.0, 0.0, 0.0, 0.0}});
    Numbers numbers;
    Points<TypeParam> kept(500, numbers);
    kept.thickness = 0.002;
    Feet feet;
    Pose pose[3];
    std::size_t touched = 0;
    for (int step = 0; step < 400; ++step) {
        const Pose next[3] = {{{0.3, 0.0, 0.0}, turned({0.0, 1.0, 0.2}, 0.19 * step)},
                              {{0.0, 0.5 * core::sine(0.05 * step), 0.4}, {1.0, 0.0, 0.0, 0.0}},
                              {{step % 50 < 25 ? 0.5 : -0.5, 0.1, 0.1}, {1.0, 0.0, 0.0, 0.0}}};
        for (int c = 0; c < 3; ++c) {
            colliders.move(c + 2, pose[c], next[c]);
            pose[c] = next[c];
        }
        for (std::size_t i = 0; i < kept.x.size(); ++i) {
            kept.before[i] = kept.x[i];
            kept.v[i] -= kept.x[i] * TypeParam(step % 100 < 5 ? 20 : 1);
            kept.x[i] += TypeParam(0.01) * kept.v[i];
        }
        Points<TypeParam> anew = kept;
        Feet none;
        anew.resolve(colliders, none);
        kept.resolve(colliders, feet);
        ASSERT_NO_FATAL_FAILURE(expectSame(kept, anew)) << step;
        touched += kept.touched.size();
    }
    EXPECT_GT(touched, 2000U);
}

TYPED_TEST(CollisionBatch, KnownFeetGiveTheBitsOfPointsTakenOneByOne) {
    // A swarm falls on a mesh that rocks to and fro, rests on it and slides over it.
    for (const SizedShape& shape : meshes()) {
        Colliders colliders, plain;
        colliders.add(shape, {0.2, 0.0}, {});
        plain.add({std::make_shared<Plain>(Shape(shape).form), {}}, {0.2, 0.0}, {});
        Numbers numbers;
        Points<TypeParam> kept(500, numbers);
        kept.thickness = 0.02;
        for (TypeParam& v : kept.v) v = 0;
        Feet feet, any;
        Pose pose;
        std::size_t touched = 0;
        for (int step = 0; step < 400; ++step) {
            const double angle = step % 150 < 100 ? 0.3 * core::sine(0.05 * step) : 0.0;
            const Pose next{{0.0, 0.1 * angle, 0.0}, turned({1.0, 0.0, 0.5}, angle)};
            colliders.move(0, pose, next);
            plain.move(0, pose, next);
            pose = next;
            for (std::size_t i = 0; i < kept.x.size(); ++i) {
                kept.before[i] = kept.x[i];
                kept.v[i] -= kept.x[i] * TypeParam(0.2);
                kept.x[i] += TypeParam(0.01) * kept.v[i];
            }
            Points<TypeParam> alone = kept;
            alone.resolve(plain, any);
            kept.resolve(colliders, feet);
            ASSERT_NO_FATAL_FAILURE(expectSame(kept, alone)) << step;
            touched += kept.touched.size();
        }
        EXPECT_GT(touched, 20000U);
    }
}

}  // namespace
}  // namespace taut::collision::collision_batch
