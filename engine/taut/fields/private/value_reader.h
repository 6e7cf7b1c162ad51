// From a node of a document to the value of one field, with everything that can be wrong with it reported.
#pragma once

#include <optional>

#include "taut/fields/field.h"
#include "taut/fields/private/problems.h"

namespace taut::fields {

// The value in the file's units, or nothing if it was wrong. Not for tables.
std::optional<Value> fieldValue(const Field& field, const Node& node, Problems& problems);

}  // namespace taut::fields
