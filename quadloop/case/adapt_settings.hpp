#pragma once

#include <optional>

#include "adapt/remesh/demands/adapt_options.hpp"
#include "io/input/case_file.hpp"

namespace quadloop {

/// The table [adapt] of a case, if it has one. Throws InputError that names key and line.
std::optional<AdaptOptions> read_adapt_table(const CaseTable& root);

}  // namespace quadloop
