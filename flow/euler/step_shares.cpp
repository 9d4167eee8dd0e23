#include "flow/euler/step_shares.hpp"

#include <algorithm>

namespace quadloop::euler {

namespace {

constexpr int patience = 4, longer_patience = 40;  ///< turns in a row before the share falls; where it is
                                                   ///< small already: then the node is slow
/// A change counts as a turn where it takes back that much of the one before.
constexpr float turned_back = -0.8F;
constexpr double share_fall = 0.5, share_rise = 1.02, small_share = 0.03, least_step_share = 1e-3;

float product(const Change& a, const Change& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

}  // namespace

StepShares::StepShares(std::size_t owned_nodes)
    : shares_(owned_nodes, 1.0), last_(owned_nodes), turns_(owned_nodes, 0) {}

void StepShares::follow(const std::vector<Change>& change) {
  for (std::size_t node = 0; node < shares_.size(); ++node) {
    const float before = product(last_[node], last_[node]);
    const bool turned = before > 0 && product(change[node], last_[node]) < turned_back * before;
    last_[node] = change[node];
    turns_[node] = turned ? static_cast<std::int8_t>(turns_[node] + 1) : std::int8_t{0};
    if (turns_[node] >= (shares_[node] > small_share ? patience : longer_patience)) {
      shares_[node] = std::max(least_step_share, share_fall * shares_[node]);
      turns_[node] = 0;
    } else if (!turned) {
      shares_[node] = std::min(1.0, share_rise * shares_[node]);
    }
  }
}

void StepShares::restart() {
  std::fill(shares_.begin(), shares_.end(), 1.0);
  forget();
}

void StepShares::forget() {
  std::fill(last_.begin(), last_.end(), Change{});
  std::fill(turns_.begin(), turns_.end(), std::int8_t{0});
}

}  // namespace quadloop::euler
