// The rows of fields of elements with a shape: colliders, solids, and the parts of their compounds.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "taut/fields/field_list.h"
#include "taut/spec/common_rows.h"
#include "taut/spec/shape_spec.h"

namespace taut::world {

// The shapes that have this field; all if it is empty.
std::vector<std::string> namesOf(const collision::ShapeKinds& shapes, std::string_view field = {});

template <class Wanted>
collision::ShapeKinds shapesThat(const collision::ShapeKinds& shapes, const Wanted& isWanted) {
    collision::ShapeKinds wanted;
    for (const collision::ShapeKind& kind : shapes.all())
        if (isWanted(kind)) wanted.add(kind);
    return wanted;
}

// Sizes and place of one of these shapes.
template <class Spec>
fields::FieldList<Spec> shapeRows(const collision::ShapeKinds& shapes, const char* meshHelp) {
    fields::FieldList<Spec> list;
    list.choice("shape", &ShapeSpec::shape, namesOf(shapes), "Shape.")
        .required()
        .vector("position", &ShapeSpec::position, "m", placeRange, "Centre; of a mesh the origin of its file.")
        .rotation("rotation_deg", &ShapeSpec::rotation, "Rotation about x, then y, then z.")
        .vector("size", &ShapeSpec::size, "m", lengthRange, "Lengths of the three edges.")
        .only(namesOf(shapes, "size"))
        .number("radius", &ShapeSpec::radius, "m", lengthRange, "Radius.")
        .only(namesOf(shapes, "radius"))
        .number("height", &ShapeSpec::height, "m", lengthRange,
                "Height along y; of a capsule between the centres of its half spheres.")
        .only(namesOf(shapes, "height"))
        .text("mesh", &ShapeSpec::mesh, fields::Role::mesh, meshHelp)
        .required()
        .only(namesOf(shapes, "mesh"))
        .number("scale", &ShapeSpec::scale, "", lengthRange, "Size of a unit of the file in metres.")
        .only(namesOf(shapes, "scale"));
    for (const collision::ShapeKind& kind : shapes.all())
        for (const collision::OwnSize& own : kind.own)
            list.entry(own.key, &ShapeSpec::sizes, own.unit, fields::Range{own.least, own.most}, own.standard, own.help)
                .only({std::string(kind.name)});
    return list;
}

inline std::string shapeNameIn(const fields::Node& table) {
    return table.textAt("shape");
}

}  // namespace taut::world
