#include "mesher/base/parallel/exchange.hpp"

#include <cstring>
#include <limits>
#include <numeric>

#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

using Counts = std::vector<Communicator::Count>;

/// The number of items for each rank that gets some, ascending; `order` sorts the items unless it is empty.
Counts counts_of(std::span<const int> ranks, std::span<const std::uint32_t> order) {
  Counts counts;
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    const int rank = ranks[order.empty() ? i : order[i]];
    if (counts.empty() || counts.back().rank != rank) counts.push_back({rank, 0});
    ++counts.back().count;
  }
  return counts;
}

/// Returns the range of each rank.
std::vector<Exchange::Source> stretches(const Counts& counts) {
  std::vector<Exchange::Source> found;
  std::size_t begin = 0;
  for (const auto& [rank, count] : counts) {
    const std::size_t end = begin + static_cast<std::size_t>(count);
    found.push_back({rank, begin, end});
    begin = end;
  }
  return found;
}

}  // namespace

Exchange::Exchange(const Communicator& comm, std::span<const int> ranks) : comm_{&comm} {
  for (const int rank : ranks)
    QUADLOOP_REQUIRE(0 <= rank && rank < comm.size(), "items are for one of the ranks", rank, comm.size());
  QUADLOOP_REQUIRE(ranks.size() <= std::numeric_limits<std::uint32_t>::max(), "items have 32-bit numbers",
                   ranks.size());
  if (!std::is_sorted(ranks.begin(), ranks.end())) {
    order_.resize(ranks.size());
    std::vector<std::uint32_t> next(comm.size());
    for (const int rank : ranks) ++next[rank];
    std::exclusive_scan(next.begin(), next.end(), next.begin(), std::uint32_t{0});
    for (std::uint32_t item = 0; const int rank : ranks) order_[next[rank]++] = item++;
  }
  const Counts counts = counts_of(ranks, order_);
  targets_ = stretches(counts);
  sources_ = stretches(comm.exchange_counts(counts));
}

std::size_t Exchange::arrivals_before(int rank) const {
  const auto found = std::partition_point(sources_.begin(), sources_.end(),
                                          [&](const Source& source) { return source.rank < rank; });
  return found == sources_.end() ? arrivals() : found->begin;
}

/// The number of rows is known on both sides.
void Exchange::move(std::span<const Source> to, Bytes rows, std::span<const Source> from, Room room,
                    std::size_t row) const {
  std::vector<Communicator::Outgoing> out;
  for (const Source& t : to) out.push_back({t.rank, rows.subspan(t.begin * row, t.size() * row)});
  std::vector<Communicator::Incoming> in;
  for (const Source& s : from) in.push_back({s.rank, room.subspan(s.begin * row, s.size() * row)});
  comm_->exchange_messages(out, in);
}

void Exchange::deliver_bytes(Bytes rows, Room room, std::size_t row) const {
  QUADLOOP_REQUIRE(rows.size() == items() * row, "a row for each item", rows.size(), items(), row);
  if (order_.empty() || row == 0) return move(targets_, rows, sources_, room, row);
  std::vector<std::byte> sorted(rows.size());
  for (std::size_t i = 0; i < order_.size(); ++i)
    std::memcpy(sorted.data() + i * row, rows.data() + order_[i] * row, row);
  move(targets_, sorted, sources_, room, row);
}

void Exchange::answer_bytes(Bytes rows, Room room, std::size_t row) const {
  QUADLOOP_REQUIRE(rows.size() == arrivals() * row, "a row for each arrival", rows.size(), arrivals(), row);
  if (order_.empty() || row == 0) return move(sources_, rows, targets_, room, row);
  std::vector<std::byte> sorted(room.size());
  move(sources_, rows, targets_, sorted, row);
  for (std::size_t i = 0; i < order_.size(); ++i)
    std::memcpy(room.data() + order_[i] * row, sorted.data() + i * row, row);
}

std::vector<int> GhostExchange::owners_of(std::vector<Copy>& ghosts) {
  std::stable_sort(ghosts.begin(), ghosts.end(),
                   [](const Copy& a, const Copy& b) { return a.owner < b.owner; });
  std::vector<int> owners;
  for (const Copy& copy : ghosts) owners.push_back(copy.owner);
  return owners;
}

GhostExchange::GhostExchange(const Communicator& comm, std::vector<Copy> ghosts, std::int32_t first_owned)
    : exchange_(comm, owners_of(ghosts)) {
  for (const Copy& copy : ghosts) {
    ghosts_.push_back(copy.entry);
    owned_.push_back(copy.owners_entry);
  }
  owned_ = exchange_.deliver(owned_);
  for (std::int32_t& entry : owned_) entry += first_owned;
}

}  // namespace quadloop
