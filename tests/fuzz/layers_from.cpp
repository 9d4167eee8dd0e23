#include "tests/fuzz/layers_from.hpp"

#include <algorithm>
#include <cmath>

#include "mesher/base/error.hpp"

namespace quadloop::fuzz {

LayerSpec layers_from(Bytes& bytes) {
  LayerSpec spec;
  const double mantissa = 1 + bytes.below(4) / 4.0;
  spec.first = std::ldexp(mantissa, -3 - bytes.below(10));
  spec.growth = 1 + (1 + bytes.below(8)) / 8.0;
  spec.growth_to = std::min(2.0, spec.growth + bytes.below(3) / 4.0);
  spec.count = 1 + bytes.below(20);
  spec.equal = 1 + bytes.below(spec.count);
  return spec;
}

AssembleOptions walls_with_layers(Bytes& bytes) {
  AssembleOptions options;
  options.domain_is_known = true;
  BoundaryRule walls{"loop", std::ldexp(1.0, -1 - bytes.below(5)), {}, {}, {}, false};
  walls.layers = layers_from(bytes);
  options.rules.push_back(walls);
  if (bytes.below(4) != 0) return options;
  BoundaryRule box{"box", 1.0, {}, {}, {}, false};
  box.layers = layers_from(bytes);
  options.rules.push_back(box);
  return options;
}

std::vector<LayerLine> lines_from(Bytes& bytes) {
  if (bytes.below(4) != 0) return {};
  LayerLine line;
  for (int points = 2 + bytes.below(2); points > 0; --points) {
    const int x = bytes.below(33), y = bytes.below(33);
    const Point p{(x - 8) / 16.0, (y - 8) / 16.0};
    if (!line.path.empty() && line.path.back() == p) throw InputError("a line has one point twice");
    line.path.push_back(p);
  }
  line.spacing = std::ldexp(1.0, -2 - bytes.below(4));
  line.layers = layers_from(bytes);
  line.where = "case.toml:9";
  return {line};
}

}  // namespace quadloop::fuzz
