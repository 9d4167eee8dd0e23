#pragma once

#include "mesher/base/word_table.hpp"

namespace quadloop::smoother {

/// The search for a node's best position. perturb: Newton steps, and the steps along normals, edges and axes
/// of the thesis. nlopt: a minimiser of the NLopt library.
enum class Method { perturb, nlopt };

inline constexpr WordTable<Method, 2> method_words{{{"perturb", Method::perturb}, {"nlopt", Method::nlopt}}};

}  // namespace quadloop::smoother
