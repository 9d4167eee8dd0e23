#include "adapt/remesh/demands/trial_count.hpp"

#include <algorithm>

#include "mesher/base/error.hpp"
#include "mesher/build/mesh_estimate.hpp"

namespace quadloop::adapt {

NodeBounds TrialCount::nodes_after(const ChangedSplits& changes) const {
  return nodes_of({comm_, changes.demands});
}

NodeBounds TrialCount::nodes_of(const DemandedSplits& demanded) const {
  try {
    return trial_.nodes(demanded);
  } catch (const TooManyCells&) {  // thrown from an estimate that is the same on all ranks
    return {beyond, beyond};
  }
}

TrialCount::Share TrialCount::filled(const std::optional<std::int64_t>& most,
                                     const ChangedSplits& changes) const {
  const DemandedSplits demanded(comm_, changes.demands);
  const double of_limit = share_of(limit_, trial_.estimate(demanded));
  if (!most || of_limit > 1) return {of_limit, of_limit};
  const NodeBounds nodes = nodes_of(demanded);
  const auto cap = static_cast<double>(*most);
  return {std::max(of_limit, static_cast<double>(nodes.least) / cap),
          std::max(of_limit, static_cast<double>(nodes.most) / cap)};
}

double TrialCount::share_of_limit(const ChangedSplits& changes) const {
  return share_of(limit_, trial_.estimate(DemandedSplits(comm_, changes.demands)));
}

}  // namespace quadloop::adapt
