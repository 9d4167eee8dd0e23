#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "mesher/base/communicator.hpp"
#include "mesher/forest/lattice.hpp"

namespace quadloop {

/// A unit square by its place on the space-filling curve: first along the trees, then (Morton order) within
/// the tree.
struct CurvePlace {
  std::int32_t tree = 0;
  std::uint64_t square = 0;
  friend auto operator<=>(const CurvePlace&, const CurvePlace&) = default;
};

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
  std::int64_t global_leaves() const;
  /// This rank's leaves in the order of the curve.
  std::vector<Quadrant> leaves() const;

  /// Where on the curve each rank's leaves begin, and last the curve's end. Not collective.
  std::vector<CurvePlace> begins() const;
  /// The number along the curve of the tree that holds the quadrant. Not collective.
  std::int32_t tree_at(const Quadrant& q) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace quadloop
