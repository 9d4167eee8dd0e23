#pragma once

#include "mesher/base/word_table.hpp"

namespace quadloop {

/// How a node's best place is looked for. perturb: Newton's steps, and the thesis's along normals, edges and
/// axes. nlopt: a library's minimiser.
enum class Method { perturb, nlopt };

inline constexpr WordTable<Method, 2> method_words{{{"perturb", Method::perturb}, {"nlopt", Method::nlopt}}};

}  // namespace quadloop
