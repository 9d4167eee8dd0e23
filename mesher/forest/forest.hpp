#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/forest/curve_owners.hpp"

namespace quadloop {

/// The quadtrees of the root, with their leaves distributed over the ranks along the space-filling curve. The
/// only owner of p4est structures. Every member function except const queries is *collective*.
class Forest {
 public:
  /// A uniform forest of level 1.
  Forest(const Communicator& comm, const TreeGrid& grid);
  ~Forest();
  Forest(Forest&&) noexcept;
  Forest& operator=(Forest&&) = delete;

  /// Recursively splits leaves for which `split` returns true, down to `deepest_level`. `split` is called in
  /// the order of the curve.
  void refine(const std::function<bool(const Quadrant&)>& split, int deepest_level);
  /// Splits once the local leaves whose flag is set (one flag per leaf, in order).
  void split_marked(const std::vector<char>& marked);

  /// Moves leaves between ranks so that their number, or their total weight, is equal on all ranks. `weight`
  /// is called in the order of the curve.
  void partition();
  void partition(const std::function<int(const Quadrant&)>& weight);

  std::int32_t local_leaves() const;
  /// This rank's leaves in the order of the curve, in a vector with capacity for `room` more.
  std::vector<Quadrant> leaves(std::size_t room = 0) const;

  /// The present partition. Not collective.
  CurveOwners owners() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace quadloop
