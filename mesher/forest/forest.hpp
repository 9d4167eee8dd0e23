#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/forest/curve_owners.hpp"

namespace quadloop {

/// The quadtrees over the root, their leaves distributed over the ranks in the order of the space-filling
/// curve. The only owner of the p4est structures. Every member function but the plain reads is *collective*.
class Forest {
 public:
  /// A uniform forest of level 1.
  Forest(const Communicator& comm, const Lattice& lattice);
  ~Forest();
  Forest(Forest&&) noexcept;
  Forest& operator=(Forest&&) = delete;

  /// Splits the leaves for which `split` says so, and then theirs, down to `deepest_level` at most. `split`
  /// is asked in the order of the curve.
  void refine(const std::function<bool(const Quadrant&)>& split, int deepest_level);
  /// Splits once the local leaves whose flag is set (one flag a leaf, in order).
  void split_marked(const std::vector<char>& marked);

  /// Moves leaves between ranks so that their numbers are shared out evenly, or their weights. `weight` is
  /// asked in the order of the curve.
  void partition();
  void partition(const std::function<int(const Quadrant&)>& weight);

  std::int32_t local_leaves() const;
  /// This rank's leaves in the order of the curve, with room for so many more.
  std::vector<Quadrant> leaves(std::size_t room = 0) const;

  /// Who has which leaves now. Not collective.
  CurveOwners owners() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace quadloop
