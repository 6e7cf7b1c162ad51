// Parses a claim. Uses the names and arguments of functions, not their evaluation.
#pragma once

#include <string_view>
#include <vector>

#include "taut/check/check.h"
#include "taut/check/private/evaluation.h"

namespace taut::check {

// Throws ClaimError. Adds the mentioned targets to `mentions`, in the order of the text.
Claim claimOf(std::string_view text, std::vector<Mention>& mentions);

// The same for expressions with commas between them and no comparison; at least one.
std::vector<Expression> expressionsOf(std::string_view text, std::vector<Mention>& mentions);

}  // namespace taut::check
