// The field table, part two: materials.
#include <fmt/format.h>

#include "taut/fields/field_list.h"
#include "taut/fields/private/problems.h"
#include "taut/mechanics/bending.h"
#include "taut/scene/private/sections.h"

namespace taut::scene {

using namespace world;

namespace {

Section stretchSection() {
    Section section;
    section.alone = "warp";
    section.fields = FieldList<MaterialSpec>()
                         .number("warp", &MaterialSpec::stretch, "N/m", positive, "Across: along u of a mesh.")
                         .ramps(Affects::springs)
                         .number("weft", &MaterialSpec::weftStretch, "N/m", positive,
                                 "Down: along v of a mesh; as the warp if not given.")
                         .ramps(Affects::springs)
                         .take();
    return section;
}

Section rigiditySection() {
    Section section;
    section.alone = "warp";
    section.fields = FieldList<BendingSpec>()
                         .number("warp", &BendingSpec::warp, "N m", positive, "Of a strip cut along the warp: across.")
                         .required()
                         .ramps(Affects::springs)
                         .number("weft", &BendingSpec::weft, "N m", positive,
                                 "Of a strip cut along the weft: down; as the warp if not given.")
                         .ramps(Affects::springs)
                         .number("bias", &BendingSpec::bias, "N m", positive,
                                 "Of the sheet bent to a cylinder at 45°; as of an isotropic sheet between both if "
                                 "not given.")
                         .ramps(Affects::springs)
                         .take();
    section.check = [](const fields::CheckInput& input, void* target) {
        const auto& given = *static_cast<BendingSpec*>(target);
        if (!input.isClean || !given.warp || !given.bias) return;
        const double least = mechanics::leastBias(*given.warp, given.weft.value_or(*given.warp));
        if (*given.bias > least) return;
        input.problems.addError(input.at("bias"), "no sheet is so soft at 45° with this warp and weft",
                                fmt::format("it must be above (√warp - √weft)²/4 = {:.3g} N m", least));
    };
    return section;
}

void checkFriction(const fields::CheckInput& input, const MaterialSpec& material) {
    const auto& [hysteresis, yield] = material.friction;
    if (!input.isClean || (!hysteresis && !yield)) return;
    const char* given = hysteresis ? "bending_hysteresis_N" : "bending_yield_per_m";
    if (!hysteresis)
        input.problems.addError(input.at(given), "nothing slips without a hysteresis", "give bending_hysteresis_N too");
    else if (!yield)
        input.problems.addError(input.at(given), "a hysteresis needs the curvature at which threads slip",
                                "give bending_yield_per_m too, such as a tenth of 2HB/(2B)");
    else if (!material.rigidity.warp)
        input.problems.addError(input.at(given), "a hysteresis is that of a sheet with a rigidity",
                                "give bending_rigidity_N_m too");
}

}  // namespace

SceneSection materialSection() {
    SceneSection section;
    section.name = "material";
    section.layout = Layout::named;
    section.help = "What cloth is made of. Per metre of material: the number of cells does not change the stiffness.";
    section.enter = [](SceneSpec& scene, const std::string& name, const Source&) -> void* {
        return &scene.materials[name];
    };
    section.existing = [](SceneSpec& scene, const std::string& name) -> void* {
        const auto found = scene.materials.find(name);
        return found == scene.materials.end() ? nullptr : &found->second;
    };
    FieldList<MaterialSpec> list;
    list.number("density_kg_per_m2", &MaterialSpec::density, "kg/m²", positive, "Mass of a square metre.")
        .tableOfSelf("stretch_N_per_m", stretchSection(),
                     "Spring constant along the threads. A number is that of warp and weft alike.")
        .number("shear_N_per_m", &MaterialSpec::shear, "N/m", notNegative,
                "Spring constant along the diagonals. If not given: half of stretch_N_per_m, an isotropic sheet, where "
                "that is one number; a twentieth of the softer one, as woven cloth has it, where there are two.")
        .ramps(Affects::springs)
        .number(
            "bend_N_per_m", &MaterialSpec::bend, "N/m", notNegative,
            "Spring constant across two cells, as textbooks have it: it has no bending rigidity, and depends on the "
            "cells. 0 if there is a bending_rigidity_N_m and it is not given.")
        .ramps(Affects::springs)
        .table("bending_rigidity_N_m", &MaterialSpec::rigidity, rigiditySection(),
               "What a strip of the cloth resists bending with, for each metre of its width; the same for any cells. "
               "A number is that of warp and weft alike. The warp of a mesh runs along u of its texture coordinates.")
        .number("bending_hysteresis_N", &MaterialSpec::friction, &BendingFrictionSpec::hysteresis, "N", notNegative,
                "2HB of Kawabata's tester, for each metre of width: threads rub at each other, so that a grid stays "
                "bent to 2HB/(2B). Meshes have none.")
        .ramps(Affects::springs)
        .number("bending_yield_per_m", &MaterialSpec::friction, &BendingFrictionSpec::yield, "1/m", positive,
                "How far a sheet bends, or bends back, until its threads slip.");
    list.number(
        "air_kg_per_m2", &MaterialSpec::air, "kg/m²", notNegative,
        "Mass of the air that a square metre takes along where there is a [wind]: it has inertia and no weight. "
        "Folds of length λ take along ρ λ/π, some 0.05.");
    list.number(
        "flutter", &MaterialSpec::flutter, "", fields::Range{0.0, 10.0},
        "The share of air_kg_per_m2 that acts as on a stiff plate that turns: it swings to and fro as it falls. "
        "For stiff sheets: what is limp may crumple.");
    section.fields = withPlasticity(withLosses(list))
                         .choice("lumping", &MaterialSpec::lumping, lumpingNames(),
                                 "How mass is shared out: by area, or the same for every point.")
                         .take();
    section.check = [](const fields::CheckInput& input, void* target) {
        auto& material = *static_cast<MaterialSpec*>(target);
        if (material.rigidity.warp && input.table.find("bend_N_per_m") == nullptr) material.bend = 0;
        checkFriction(input, material);
    };
    return section;
}

}  // namespace taut::scene
