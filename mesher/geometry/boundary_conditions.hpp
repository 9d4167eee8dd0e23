#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mesher/base/word_table.hpp"

namespace quadloop {

/// Boundary condition in case files and meshes. Each solver supports some of them
/// (`flow/euler/model/flow_model`).
class BoundaryCondition {
 public:
  enum Kind : std::uint8_t {
    none,  ///< not specified
    wall,
    viscous_wall,  ///< this and the next: more specific walls
    inviscid_wall,
    farfield,
    inflow,
    outflow,
    symmetry,
    interface  ///< between two domains
  };

  constexpr BoundaryCondition() = default;
  constexpr BoundaryCondition(Kind kind) : kind_{kind} {}
  /// Converts a literal of `words`; any other literal does not compile.
  consteval BoundaryCondition(const char* word) : kind_{*value_of(words, word)} {}
  /// Converts a word; empty if it is not in `words`.
  static std::optional<BoundaryCondition> named(std::string_view word) { return value_of(words, word); }

  constexpr Kind kind() const { return kind_; }
  /// Returns its word in case files and in our own files.
  constexpr const char* word() const { return word_of(words, kind_); }
  bool is_wall() const { return kind_ == wall || kind_ == viscous_wall || kind_ == inviscid_wall; }

  friend constexpr bool operator==(const BoundaryCondition&, const BoundaryCondition&) = default;

  /// All conditions, in the order in which messages list them.
  static constexpr WordTable<Kind, 9> words{{{"wall", wall},
                                             {"viscous_wall", viscous_wall},
                                             {"inviscid_wall", inviscid_wall},
                                             {"farfield", farfield},
                                             {"inflow", inflow},
                                             {"outflow", outflow},
                                             {"symmetry", symmetry},
                                             {"interface", interface},
                                             {"none", none}}};
  /// Words of a case's key `wall`, which specifies the kind of wall; its key `bc` accepts all others.
  static constexpr WordTable<Kind, 2> wall_words{{{"viscous", viscous_wall}, {"inviscid", inviscid_wall}}};

 private:
  Kind kind_ = none;
};

/// The values of a case's key `bc`: all conditions except those of its key `wall`.
inline std::vector<std::pair<const char*, BoundaryCondition>> values_of_bc() {
  std::vector<std::pair<const char*, BoundaryCondition>> values(BoundaryCondition::words.begin(),
                                                                BoundaryCondition::words.end());
  std::erase_if(values, [](const auto& value) {
    return value.second.is_wall() && value.second != BoundaryCondition::wall;
  });
  return values;
}

}  // namespace quadloop
