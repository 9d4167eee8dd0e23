#include "adapt/sensor/cell_share.hpp"

#include <algorithm>

#include "mesher/base/error.hpp"
#include "mesher/base/parallel/exchange.hpp"

namespace quadloop::adapt {

namespace {

std::vector<std::int64_t> firsts_of_ranks(const Communicator& comm, std::int64_t count) {
  std::vector<std::int64_t> firsts{0};
  for (const std::int64_t of_rank : comm.all_gather(count)) firsts.push_back(firsts.back() + of_rank);
  return firsts;
}

}  // namespace

CellShare::CellShare(const Communicator& comm, std::int64_t held, std::int64_t wanted)
    : first_held_{firsts_of_ranks(comm, held)}, first_wanted_{firsts_of_ranks(comm, wanted)} {}

std::vector<double> CellShare::bring(const Communicator& comm, std::span<const double> held) const {
  QUADLOOP_REQUIRE(all_held() == all_wanted(), "the cells held are not the cells wanted", all_held(),
                   all_wanted());
  const std::size_t self = comm.rank();
  const std::int64_t begin = first_held_[self], end = first_held_[self + 1];
  QUADLOOP_REQUIRE(std::ssize(held) == end - begin, "there must be one value for each cell", held.size(),
                   begin, end);
  if (first_held_ == first_wanted_) return {held.begin(), held.end()};  // on every rank
  std::vector<int> ranks;
  for (int rank = 0; rank < comm.size(); ++rank) {
    const std::size_t r = rank;
    const std::int64_t from = std::clamp(first_wanted_[r], begin, end),
                       to = std::clamp(first_wanted_[r + 1], begin, end);
    ranks.insert(ranks.end(), to - from, rank);
  }
  return Exchange(comm, ranks).deliver(held);
}

}  // namespace quadloop::adapt
