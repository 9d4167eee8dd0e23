#include "adapt/sensor/cell_share.hpp"

#include <algorithm>

#include "mesher/base/error.hpp"

namespace quadloop {

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
  QUADLOOP_REQUIRE(all_held() == all_wanted(), "the cells held are not the cells wanted");
  const auto self = static_cast<std::size_t>(comm.rank());
  const std::int64_t begin = first_held_[self], end = first_held_[self + 1];
  QUADLOOP_REQUIRE(static_cast<std::int64_t>(held.size()) == end - begin,
                   "there must be one value for each cell");
  std::vector<std::vector<double>> out(static_cast<std::size_t>(comm.size()));
  for (std::size_t rank = 0; rank < out.size(); ++rank) {
    const std::int64_t from = std::clamp(first_wanted_[rank], begin, end),
                       to = std::clamp(first_wanted_[rank + 1], begin, end);
    const auto piece =
        held.subspan(static_cast<std::size_t>(from - begin), static_cast<std::size_t>(to - from));
    out[rank].assign(piece.begin(), piece.end());
  }
  std::vector<double> wanted;
  for (const auto& piece : comm.exchange(out)) wanted.insert(wanted.end(), piece.begin(), piece.end());
  return wanted;
}

}  // namespace quadloop
