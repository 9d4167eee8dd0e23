#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesher/base/word_table.hpp"

namespace quadloop {

/// What happens at a boundary, as case files and meshes tell a solver. What a solver can use of it is its own
/// matter (`flow/euler/model/flow_model`).
class BoundaryCondition {
 public:
  enum Kind : std::uint8_t {
    none,  ///< not said
    wall,
    viscous_wall,  ///< these two: a wall of which more is said
    inviscid_wall,
    farfield,
    inflow,
    outflow,
    symmetry,
    interface  ///< between two domains
  };

  constexpr BoundaryCondition() = default;
  constexpr BoundaryCondition(Kind kind) : kind_{kind} {}
  /// From one of `words` that stands in the source; another one does not compile.
  consteval BoundaryCondition(const char* word) : kind_{*value_of(words, word)} {}
  /// From a word that is read; none for one that is not among `words`.
  static std::optional<BoundaryCondition> named(std::string_view word) { return value_of(words, word); }

  constexpr Kind kind() const { return kind_; }
  /// How case files and our own files name it.
  constexpr const char* word() const { return word_of(words, kind_); }
  bool is_wall() const { return kind_ == wall || kind_ == viscous_wall || kind_ == inviscid_wall; }

  friend constexpr bool operator==(const BoundaryCondition&, const BoundaryCondition&) = default;

  /// All of them, in the order in which messages list them.
  static constexpr WordTable<Kind, 9> words{{{"wall", wall},
                                             {"viscous_wall", viscous_wall},
                                             {"inviscid_wall", inviscid_wall},
                                             {"farfield", farfield},
                                             {"inflow", inflow},
                                             {"outflow", outflow},
                                             {"symmetry", symmetry},
                                             {"interface", interface},
                                             {"none", none}}};
  /// Those of a case's key `wall`, which says more of a wall; its key `bc` takes all others.
  static constexpr WordTable<Kind, 2> wall_words{{{"viscous", viscous_wall}, {"inviscid", inviscid_wall}}};

 private:
  Kind kind_ = none;
};

}  // namespace quadloop
