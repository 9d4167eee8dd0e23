#pragma once

#include <vector>

#include "mesher/geometry/assemble/assemble.hpp"
#include "mesher/layers/front/layer_lines.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace quadloop::fuzz {

/// One to twenty layers whose first height is from a quarter down to a five thousandth.
LayerSpec layers_from(Bytes& bytes);

/// The outline of loops_from() with layers at the walls "loop", and now and then at "box".
AssembleOptions walls_with_layers(Bytes& bytes);

/// None, or one free line of two or three points. Throws InputError where two that follow each other are the
/// same, as the reader of case files does.
std::vector<LayerLine> lines_from(Bytes& bytes);

}  // namespace quadloop::fuzz
