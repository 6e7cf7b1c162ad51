// The field table. A row has the name of a key of a scene file, its description, its values and its destination. The
// validator, the JSON schema and the manual are made from this table. Independent of TOML.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "taut/core/source.h"
#include "taut/core/value.h"
#include "taut/fields/node.h"

namespace taut::fields {

class Problems;

enum class FieldKind {
    number,
    whole,         // a whole number
    flag,          // true or false
    flagOrChoice,  // true, false or one of `choices`
    text,
    choice,          // one of `choices`
    stepLength,      // "auto" or a number
    vector,          // `components` numbers
    wholeVector,     // `components` whole numbers
    direction,       // three numbers that are not all zero
    colour,          // three numbers 0 … 1 or "#rrggbb"
    segment,         // two points of `components` numbers
    places,          // a list of points of `components` numbers
    texts,           // a list of texts
    oneOrMoreTexts,  // a text, or a list of texts
    wholes,          // a list of whole numbers
    numbers,         // a number, a list of numbers or a colour: a value of another field
    table,           // fields of its own
    tables,          // a list of tables
};

// Closed limits of a number. No limit is infinite: 1e12 of any unit is a typing error.
struct Range {
    double low = -1e12;
    double high = 1e12;
};
inline constexpr Range anyNumber{};
inline constexpr double smallest = 1e-9;  // "above 0" means at least this: less is a typing error too
inline constexpr Range positive{smallest, 1e12};
inline constexpr Range notNegative{0.0, 1e12};
inline constexpr Range share{0.0, 1.0};

// The target of a reference in a text, checked after the entire scene is read; or the meaning of a number.
enum class Role {
    none,
    material,     // [material.NAME]
    camera,       // [camera.NAME]
    method,       // a method of integration
    mesh,         // a path of a mesh file
    texture,      // a path of a picture
    environment,  // a path of a picture of all that is around
    state,        // a path of a kept state
    points,       // KIND.NAME@SELECTOR
    bodies,       // KIND.NAME of bodies that have a surface
    anyBodies,    // KIND.NAME
    selector,     // points of the body it stands in
    tieable,      // KIND.NAME@SELECTOR, or collider.NAME
    collider,     // collider.NAME
    time,         // a moment, taken to the nearest tick
};

// A value in the file's units. Vectors, directions, colours and segments are numbers; none is "not given".
using Value = std::variant<std::monostate, bool, std::int64_t, double, std::string, std::vector<double>,
                           std::vector<std::string>>;  // lists of whole numbers are numbers too

// The effect of a number that may change while a scene runs.
enum class Affects { picture, forces, colliders, springs };  // springs: of bodies and their materials

struct Section;

struct Field {
    TAUT_VALUE(Field);
    std::string key;
    FieldKind kind = FieldKind::number;
    int components = 1;  // of vectors
    std::string unit;    // "m", "N/m"; empty: a plain number
    Range range;
    std::vector<std::string> choices;
    std::vector<int> values;  // the only values of a whole number; empty: all in range
    int multipleOf = 1;       // of a whole number
    bool required = false;
    std::vector<std::string> only;  // the variants of the section that have this field; empty: all
    std::string inPlaceOf;          // another key of the section, beside which it does not stand; empty: none
    std::string goesWith;           // another key, which in a layer above takes this one out; empty: none
    Role role = Role::none;
    std::optional<Affects> ramp;  // its effect, if a ramp may change it
    std::string help;

    std::function<void(void*, const Value&)> write;  // into the section's struct
    std::function<Value(const void*)> read;          // from it: of a fresh struct, this is the default

    // For the kinds table and tables: the fields inside, and the struct that they are written to.
    std::vector<Section> inside;  // exactly one
    std::function<void*(void*, const core::Source&)> enter;
    std::function<std::vector<void*>(void*)> entries;  // of tables: the structs that are there
};

// The input of a section's own check.
struct CheckInput {
    Problems& problems;
    const Node& table;
    Place place;               // of the table's name
    const std::string& where;  // "[cloth.flag]"
    const std::string& variant;
    bool isClean;  // no field inside was wrong or missing

    // The place of a key's value, or of the table if the key is not given.
    Place at(const std::string& key) const;
};

enum class Layout {
    table,  // [solver]
    named,  // [cloth.NAME]
    list,   // [[joint]]
};

struct Section {
    TAUT_VALUE(Section);
    std::string name;
    Layout layout = Layout::table;
    std::string help;
    std::vector<Field> fields;

    // Returns the form of a table that can have several, e.g. a collider's shape; no function: there is only one form.
    std::function<std::string(const Node&)> variant;
    std::string variantKey;  // the field that gives it, e.g. "shape"; empty: none
    std::string alone;       // the field that a number in place of the table stands for; empty: it must be a table

    // If each form has a struct of its own: the sections that read them, named by the variant. The fields above are
    // then the fields of all forms. The manual uses them, and the message about a key that stands in the wrong place.
    std::vector<Section> forms;

    // Checks combinations of fields. It is called after the fields are read, even if some were wrong, and may change
    // the struct.
    std::function<void(const CheckInput&, void*)> check;

    const Field* find(const std::string& key) const;
    std::vector<std::string> keys() const;
};

// Whether a text is a valid name: letters, digits, - and _, at most 100.
bool isName(const std::string& name);

// "above 0 m", "between 0 and 1".
std::string description(const Range& range, const std::string& unit);

// "a list of 3 numbers [m]", "1 or 4", "a multiple of 128 [px]".
std::string description(const Field& field);

// The default as a file would write it; empty if there is none.
std::string defaultText(const Value& value);

}  // namespace taut::fields
