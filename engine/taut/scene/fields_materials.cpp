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
                                 "Down: along v of a mesh; default as the warp.")
                         .ramps(Affects::springs)
                         .take();
    return section;
}

Section rigiditySection() {
    Section section;
    section.alone = "warp";
    section.fields =
        FieldList<BendingSpec>()
            .number("warp", &BendingSpec::warp, "N m", positive, "Rigidity of a strip along the warp: across.")
            .required()
            .ramps(Affects::springs)
            .number("weft", &BendingSpec::weft, "N m", positive,
                    "Rigidity of a strip along the weft: down; default as the warp.")
            .ramps(Affects::springs)
            .number("bias", &BendingSpec::bias, "N m", positive,
                    "Rigidity of the sheet bent to a cylinder at 45°; default that of an isotropic sheet between warp "
                    "and weft.")
            .ramps(Affects::springs)
            .take();
    section.check = [](const fields::CheckInput& input, void* target) {
        const auto& given = *static_cast<BendingSpec*>(target);
        if (!input.isClean || !given.warp || !given.bias) return;
        const double least = mechanics::leastBias(*given.warp, given.weft.value_or(*given.warp));
        if (*given.bias > least) return;
        input.problems.addError(input.at("bias"), "the bias is too soft for this warp and weft",
                                fmt::format("it must be above (√warp - √weft)²/4 = {:.3g} N m", least));
    };
    return section;
}

void checkFriction(const fields::CheckInput& input, const MaterialSpec& material) {
    const auto& [hysteresis, yield] = material.friction;
    if (!input.isClean || (!hysteresis && !yield)) return;
    const char* given = hysteresis ? "bending_hysteresis_N" : "bending_yield_per_m";
    if (!hysteresis)
        input.problems.addError(input.at(given), "a yield curvature needs a hysteresis",
                                "give bending_hysteresis_N too");
    else if (!yield)
        input.problems.addError(input.at(given), "a hysteresis needs the curvature at which threads slip",
                                "give bending_yield_per_m too, such as a tenth of 2HB/(2B)");
    else if (!material.rigidity.warp)
        input.problems.addError(input.at(given), "a hysteresis needs a bending rigidity",
                                "give bending_rigidity_N_m too");
}

}  // namespace

SceneSection materialSection() {
    SceneSection section;
    section.name = "material";
    section.layout = Layout::named;
    section.help = "Material of cloth, per metre: the stiffness does not depend on the number of cells.";
    section.enter = [](SceneSpec& scene, const std::string& name, const Source&) -> void* {
        return &scene.materials[name];
    };
    section.existing = [](SceneSpec& scene, const std::string& name) -> void* {
        const auto found = scene.materials.find(name);
        return found == scene.materials.end() ? nullptr : &found->second;
    };
    FieldList<MaterialSpec> list;
    list.number("density_kg_per_m2", &MaterialSpec::density, "kg/m²", positive, "Areal density.")
        .tableOfSelf("stretch_N_per_m", stretchSection(),
                     "Stiffness along the threads. One number is for warp and weft.")
        .number("shear_N_per_m", &MaterialSpec::shear, "N/m", notNegative,
                "Stiffness along the diagonals. Default: half of a single stretch_N_per_m, an isotropic sheet; a "
                "twentieth of the softer of two, as in woven cloth.")
        .ramps(Affects::springs)
        .number("bend_N_per_m", &MaterialSpec::bend, "N/m", notNegative,
                "Spring constant across two cells, as in textbooks: no bending rigidity, and dependent on the cells. "
                "Default 0 with a bending_rigidity_N_m.")
        .ramps(Affects::springs)
        .table("bending_rigidity_N_m", &MaterialSpec::rigidity, rigiditySection(),
               "Bending rigidity per metre of width, for any cells. One number is for warp and weft. The warp of a "
               "mesh runs along u of its texture coordinates.")
        .number("bending_hysteresis_N", &MaterialSpec::friction, &BendingFrictionSpec::hysteresis, "N", notNegative,
                "Bending hysteresis 2HB of Kawabata's tester, per metre of width: a grid keeps the curvature 2HB/(2B). "
                "Meshes have none.")
        .ramps(Affects::springs)
        .number("bending_yield_per_m", &MaterialSpec::friction, &BendingFrictionSpec::yield, "1/m", positive,
                "Change of curvature at which threads slip.");
    list.number("air_kg_per_m2", &MaterialSpec::air, "kg/m²", notNegative,
                "Added mass of the air in a [wind], per area: it has inertia and no weight. Folds of length λ move ρ "
                "λ/π, about 0.05.");
    list.number("flutter", &MaterialSpec::flutter, "", fields::Range{0.0, 10.0},
                "Share of air_kg_per_m2 that acts as on a stiff turning plate, so that it swings as it falls. Use it "
                "for stiff sheets only: limp ones may crumple.");
    section.fields = withPlasticity(withLosses(list))
                         .choice("lumping", &MaterialSpec::lumping, lumpingNames(),
                                 "Distribution of mass: by area, or the same for every point.")
                         .take();
    section.check = [](const fields::CheckInput& input, void* target) {
        auto& material = *static_cast<MaterialSpec*>(target);
        if (material.rigidity.warp && input.table.find("bend_N_per_m") == nullptr) material.bend = 0;
        checkFriction(input, material);
    };
    return section;
}

}  // namespace taut::scene
