// The field table, part two: what bodies are made of.
#include "taut/fields/field_list.h"
#include "taut/scene/private/sections.h"

namespace taut::scene {

using namespace world;

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
        .number("stretch_N_per_m", &MaterialSpec::stretch, "N/m", positive, "Spring constant along the threads.")
        .ramps(Affects::springs)
        .number("shear_N_per_m", &MaterialSpec::shear, "N/m", notNegative,
                "Spring constant along the diagonals; half of stretch_N_per_m, which is isotropic, if not given.")
        .ramps(Affects::springs)
        .number("bend_N_per_m", &MaterialSpec::bend, "N/m", notNegative, "Spring constant across two cells.")
        .ramps(Affects::springs);
    section.fields = withPlasticity(withLosses(list))
                         .choice("lumping", &MaterialSpec::lumping, lumpingNames(),
                                 "How mass is shared out: by area, or the same for every point.")
                         .take();
    return section;
}

}  // namespace taut::scene
