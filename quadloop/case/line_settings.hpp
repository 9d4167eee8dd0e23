#pragma once

#include <vector>

#include "io/input/case_file.hpp"
#include "mesher/layers/layer_lines.hpp"
#include "quadloop/case/layer_settings.hpp"

namespace quadloop {

/// The tables [[wake]] and [[layer_line]]. Throws InputError that names key and line.
std::vector<LayerLine> read_layer_lines(const CaseTable& root, LayerSettings& layer_settings);

}  // namespace quadloop
