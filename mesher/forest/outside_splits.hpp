#pragma once

#include <array>
#include <optional>
#include <vector>

#include "mesher/forest/forest.hpp"
#include "mesher/geometry/interior.hpp"
#include "mesher/sizes/size_cursor.hpp"

namespace quadloop {

/// Quadrants outside the domain, which no size is asked of: they are split only so far that leaves which
/// touch differ by one level at most. What is split in the domain is noted as it is split; what it asks of
/// the quadrants outside follows when all of it is known.
class OutsideSplits {
 public:
  /// Both must outlive it.
  OutsideSplits(const SizeTree& sizes, const Interior& inside)
      : sizes_{sizes}, inside_{inside}, cursor_{sizes} {}

  /// Whether the quadrant lies outside; constant time on average where they come in the order of the curve.
  bool is_outside(const Quadrant& q);
  /// To be called for each quadrant that is split and of which it was asked last whether it is outside.
  void note_split(const Quadrant& q);
  /// Splits what has to be split outside. *Collective.*
  void split(const Communicator& comm, Forest& forest);

 private:
  void add_parents_round(const Quadrant& q, bool is_cut, std::vector<Quadrant>& above);

  const SizeTree& sizes_;
  const Interior& inside_;
  SizeCursor cursor_;
  std::optional<Quadrant> whole_;  ///< last found through which no outline goes
  bool is_whole_outside_ = false;
  bool is_cut_ = false;  ///< whether the outline goes through the one last asked of
  std::array<std::vector<Quadrant>, Quadrant::unit_level + 1> cut_;  ///< split, by level
};

}  // namespace quadloop
