#include "flow/euler/step_fractions.hpp"

#include <algorithm>

#include "flow/euler/steady_parameters.hpp"

namespace quadloop::flow::euler {

namespace {

constexpr SteadyParameters::Shares share_parameters = steady_parameters.shares;

float product(const Change& a, const Change& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

}  // namespace

StepFractions::StepFractions(std::size_t owned_nodes)
    : shares_(owned_nodes, 1.0), last_(owned_nodes), turns_(owned_nodes, 0) {}

void StepFractions::follow(const IdVector<NodeId, Change>& change) {
  for (const NodeId node : shares_.ids()) {
    const float before = product(last_[node], last_[node]);
    const bool turned =
        before > 0 && product(change[node], last_[node]) < -share_parameters.turned_back * before;
    last_[node] = change[node];
    turns_[node] = turned ? static_cast<std::int8_t>(turns_[node] + 1) : std::int8_t{0};
    if (turns_[node] >=
        (shares_[node] > share_parameters.small ? share_parameters.turns : share_parameters.more_turns)) {
      shares_[node] = std::max(share_parameters.least, share_parameters.fall * shares_[node]);
      turns_[node] = 0;
    } else if (!turned) {
      shares_[node] = std::min(1.0, share_parameters.rise * shares_[node]);
    }
  }
}

void StepFractions::restart() {
  std::fill(shares_.begin(), shares_.end(), 1.0);
  forget();
}

void StepFractions::forget() {
  std::fill(last_.begin(), last_.end(), Change{});
  std::fill(turns_.begin(), turns_.end(), std::int8_t{0});
}

}  // namespace quadloop::flow::euler
