#include "quadloop/case/pair_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesher/base/error.hpp"

namespace quadloop {

const KeyTable<PairKeys>& pair_keys() {
  static const KeyTable<PairKeys> keys{
      "pair",
      {key<&PairKeys::pair, &PeriodicPair::from>(
           "from", boundary_name(), "The one boundary.",
           {.example = "\"inlet\"", .required = {{"the boundary that is mapped"}}}),
       key<&PairKeys::pair, &PeriodicPair::to>(
           "to", boundary_name(), "The other boundary, which is the image of `from`.",
           {.example = "\"outlet\"", .required = {{"the boundary that `from` is mapped to"}}}),
       key<&PairKeys::pair, &PeriodicPair::translation>(
           "translation", point(), "The translation that maps `from` to `to`.",
           {.needs = {{"no rotation", "give one of them"}},
            .required = {{"the translation from `from` to `to`, or with rotation the angle in degrees",
                          "no rotation"}}}),
       key<&PairKeys::degrees>("rotation", number({-360, 360}),
                               "The angle of the rotation that maps `from` to `to`, counter-clockwise.",
                               {.unit = "degrees", .fallback = "none"}),
       key<&PairKeys::pair, &PeriodicPair::centre>(
           "centre", point(), "The centre of the rotation.",
           {.fallback = "the origin", .needs = {{"rotation", "the angle in degrees"}}})}};
  return keys;
}

WantedPair read_pair(const io::CaseTable& table) {
  PairKeys keys;
  pair_keys().read(table, keys);
  PeriodicPair& pair = keys.pair;
  if (pair.from == pair.to) table.refuse("to", "is the boundary of `from`; name the other one");
  if (keys.degrees) {
    if (std::remainder(*keys.degrees, 360.0) == 0)
      table.refuse("rotation", "is a whole turn; give the angle from `from` to `to`");
    pair.degrees = *keys.degrees;
  } else if (pair.translation == Point{}) {
    table.refuse("translation", "is zero; give the distance from `from` to `to`");
  }
  return {pair, table.place()};
}

void require_plain_pairs(const Settings& settings) {
  const std::vector<WantedPair>& pairs = settings.outline.pairs;
  if (pairs.empty()) return;
  const auto refuse_with = [&](bool has, const char* what) {
    if (has)
      throw InputError(fmt::format("{}: a case with a [[pair]] cannot have {}; remove one of the two",
                                   pairs.front().where, what));
  };
  refuse_with(settings.mesh.mirror.has_value(), "mesh.mirror");
  refuse_with(settings.mesh.type == MeshType::metric, "mesh.type = \"metric\"");
  refuse_with(settings.stretch.has_value(), "smooth.targets = \"solution\"");
  refuse_with(settings.morph_to.has_value(), "design.morph_to");
  refuse_with(settings.outline.unite_islands, "geometry.overlap = \"union\"");
  refuse_with(!settings.outline.blocks.empty(), "[[block]]");
  refuse_with(!settings.outline.lines.empty(), "[[line]]");
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      for (const std::string& name : {pairs[i].pair.from, pairs[i].pair.to}) {
        if (name == pairs[k].pair.from || name == pairs[k].pair.to)
          throw InputError(fmt::format("{}: boundary '{}' is in two tables [[pair]]; remove one of them",
                                       pairs[i].where, name));
      }
    }
  }
}

void require_no_conditions(const Settings& settings, const Geometry& geometry) {
  for (const auto& [pair, where] : settings.outline.pairs) {
    for (const Boundary& boundary : geometry.boundaries()) {
      if (boundary.name != pair.from && boundary.name != pair.to) continue;
      const bool has_condition = boundary.condition != BoundaryCondition::none;
      if (!has_condition && !boundary.layers) continue;
      throw InputError(
          fmt::format("{}: boundary '{}' of a [[pair]] has {}, but what is beyond it is the domain itself; "
                      "remove it from [boundary.{}]",
                      where, boundary.name, has_condition ? "a condition bc" : "layers", boundary.name));
    }
  }
}

}  // namespace quadloop
