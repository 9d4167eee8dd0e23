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

  /// Whether a quadrant that sizes ask to split is split for it: not where it lies outside. To be asked once
  /// of each; constant time on average in the order of the curve.
  bool is_split_by_size(const Quadrant& q);
  /// Once sizes split nothing more: splits what that asks for outside. *Collective.*
  void split(const Communicator& comm, Forest& forest);

 private:
  void add_parents_round(const Quadrant& q, bool is_cut, std::vector<Quadrant>& above);

  const SizeTree& sizes_;
  const Interior& inside_;
  SizeCursor cursor_;
  std::optional<Quadrant> whole_;  ///< last found through which no outline goes
  bool is_whole_outside_ = false;
  std::array<std::vector<Quadrant>, Quadrant::unit_level + 1>
      cut_;  ///< by level: split ones through which the outline goes
};

}  // namespace quadloop
