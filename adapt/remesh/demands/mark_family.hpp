#pragma once

#include <optional>
#include <vector>

#include "adapt/remesh/demands/adapt_options.hpp"
#include "adapt/remesh/demands/solved_mesh.hpp"
#include "adapt/sensor/ordered_values.hpp"
#include "adapt/sensor/thresholds.hpp"
#include "mesher/geometry/mirror_axis.hpp"

namespace quadloop::adapt {

/// A family of markings of one quadtree, ordered by a parameter in [-1, 1]. At 1 these are the flags of the
/// rule itself. Towards 0 fewer cells are refined, dropping the smallest indicators first (for size fields,
/// all target sizes grow by up to a factor of 16). Towards -1 more cells are coarsened, at -1 all of them.
class MarkFamily {
 public:
  /// Communicator and solved mesh must outlive the object. With a mirror axis mirror images are flagged
  /// alike. Throws InputError as plan_adaptation does. *Collective.*
  MarkFamily(const Communicator& comm, const AdaptOptions& options, const SolvedMesh& solved,
             std::optional<MirrorAxis> mirror = {});

  /// Returns the flags for a parameter from -1 to 1. *Collective.*
  std::vector<RefinementFlag> flags(double at) const;

  double mean() const { return statistics_.mean; }
  double deviation() const { return statistics_.deviation; }
  /// Whether the indicator is the same in all quadtree cells, so that none is flagged.
  bool flat() const { return statistics_.flat; }

 private:
  std::vector<RefinementFlag> size_flags(double at) const;

  const SolvedMesh& solved_;
  bool by_size_;
  std::vector<double> values_;          ///< of each quadtree cell: its indicator, or its target size
  std::optional<OrderedValues> order_;  ///< of the indicators
  IndicatorStatistics statistics_;
  Thresholds rule_;
  /// Fractions of the non-empty quadtree cells, by the rule.
  double refined_share_ = 1, coarsened_share_ = 0;
};

}  // namespace quadloop::adapt
