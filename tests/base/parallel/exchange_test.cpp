// Values reach the ranks they are for, in order, and the answers come back: with empty partners, to oneself,
// with rows of any width.
#include "mesher/base/parallel/exchange.hpp"

#include <gtest/gtest.h>

#include <array>
#include <span>
#include <vector>

#include "mesher/base/error.hpp"
#include "mesher/base/ids.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

struct Named {
  int from, to, number;
  friend bool operator==(const Named&, const Named&) = default;
};

/// How many items one rank has for another: none for some pairs, at times none at all.
int count(int from, int to) { return from % 3 == 1 ? 0 : (5 * from + 3 * to) % 4; }

/// This rank's items, out of order.
std::vector<Named> items() {
  std::vector<Named> all;
  for (int number = 0; number < 4; ++number) {
    for (int to = world().size() - 1; to >= 0; --to) {
      if (number < count(world().rank(), to)) all.push_back({world().rank(), to, number});
    }
  }
  return all;
}

/// What must arrive here: by source, then in its order.
std::vector<Named> wanted() {
  std::vector<Named> all;
  for (int from = 0; from < world().size(); ++from) {
    for (int number = 0; number < count(from, world().rank()); ++number)
      all.push_back({from, world().rank(), number});
  }
  return all;
}

std::vector<int> ranks_of(const std::vector<Named>& items) {
  std::vector<int> ranks;
  for (const Named& item : items) ranks.push_back(item.to);
  return ranks;
}

TEST(Exchange, DeliversBySourceThenOrder) {
  const std::vector<Named> out = items();
  const Exchange exchange(world(), ranks_of(out));
  EXPECT_EQ(exchange.items(), out.size());
  EXPECT_EQ(exchange.deliver(out), wanted());
  EXPECT_EQ(exchange.deliver(std::span(out)), wanted());  // as often as wanted
}

TEST(Exchange, OutboxDeliversTheSame) {
  Outbox<Named> out;
  for (const Named& item : items()) out.add(item.to, item);
  EXPECT_EQ(out.deliver(world()), wanted());
  EXPECT_TRUE(Outbox<Named>().deliver(world()).empty());
}

TEST(Exchange, SourcesAreThoseThatSend) {
  const Exchange exchange(world(), ranks_of(items()));
  std::size_t next = 0;
  auto source = exchange.sources().begin();
  for (int from = 0; from < world().size(); ++from) {
    EXPECT_EQ(exchange.arrivals_before(from), next);
    const std::size_t size = count(from, world().rank());
    if (size == 0) continue;
    ASSERT_NE(source, exchange.sources().end());
    EXPECT_EQ(source->rank, from);
    EXPECT_EQ(source->begin, next);
    EXPECT_EQ((source++)->size(), size);
    next += size;
  }
  EXPECT_EQ(source, exchange.sources().end());
  EXPECT_EQ(exchange.arrivals(), next);
  EXPECT_EQ(exchange.arrivals_before(world().size()), next);
}

TEST(Exchange, AnswersReturnToTheirItems) {
  const std::vector<Named> out = items();
  const Exchange exchange(world(), ranks_of(out));
  EXPECT_EQ(exchange.answer(exchange.deliver(out)), out);
}

TEST(Exchange, RowsOfAnyWidth) {
  const std::vector<Named> out = items();
  const Exchange exchange(world(), ranks_of(out));
  for (const std::size_t width : {0U, 1U, 3U}) {
    std::vector<double> rows, arriving;
    for (const auto& [list, to] : {std::pair(out, &rows), std::pair(wanted(), &arriving)}) {
      for (const Named& item : list) {
        for (std::size_t k = 0; k < width; ++k)
          to->push_back(100 * item.from + 10 * item.number + static_cast<double>(k));
      }
    }
    EXPECT_EQ(exchange.deliver(rows, width), arriving);
    EXPECT_EQ(exchange.answer(arriving, width), rows);
  }
}

TEST(Exchange, RefusesRowsThatAreNotOneForEachItem) {
  const Exchange exchange(world(), ranks_of(items()));
  EXPECT_THROW(exchange.deliver(std::vector<int>(exchange.items() + 1)), Fault);
  EXPECT_THROW(exchange.answer(std::vector<int>(exchange.arrivals() + 1)), Fault);
}

TEST(Exchange, GathersAtTheRootAndScatters) {
  const std::vector<int> own(world().rank() % 3, world().rank());
  const auto counts = world().all_gather(std::ssize(own));
  std::vector<int> all;
  for (int rank = 0; rank < world().size(); ++rank)
    all.insert(all.end(), static_cast<std::size_t>(rank % 3), rank);
  const std::vector<int> gathered = gather_at_root(world(), own);
  EXPECT_EQ(gathered, world().is_root() ? all : std::vector<int>());
  EXPECT_EQ(scatter_from_root(world(), gathered, counts), own);
}

TEST(ExchangeMessages, GoInPieces) {
  const auto pattern = [](int from, int to) {
    std::vector<std::byte> bytes(7 * (from + 2 * to) % 31);
    for (std::size_t i = 0; i < bytes.size(); ++i)
      bytes[i] = static_cast<std::byte>(100 * from + 10 * to + static_cast<int>(i));
    return bytes;
  };
  std::vector<std::vector<std::byte>> sent, received;
  for (int rank = 0; rank < world().size(); ++rank) {
    sent.push_back(pattern(world().rank(), rank));
    received.emplace_back(pattern(rank, world().rank()).size());
  }
  std::vector<Communicator::Outgoing> out;
  std::vector<Communicator::Incoming> in;
  for (int rank = 0; rank < world().size(); ++rank) {
    out.push_back({rank, sent[rank]});
    in.push_back({rank, received[rank]});
  }
  world().exchange_messages(out, in, 5);
  for (int rank = 0; rank < world().size(); ++rank) EXPECT_EQ(received[rank], pattern(rank, world().rank()));
}

/// Each rank owns three entries, 10 * rank + 0, 1, 2, behind `rank` others, and has copies of all ranks' last
/// two, itself included.
struct Ghosts {
  std::int32_t first = world().rank();
  std::vector<GhostExchange::Copy> list;
  std::vector<int> values;  ///< of copies yet unknown

  Ghosts() : values(static_cast<std::size_t>(first), -7) {
    for (int k = 0; k < 3; ++k) values.push_back(10 * first + k);
    for (int k = 1; k < 3; ++k) {
      for (int owner = world().size() - 1; owner >= 0; --owner) {
        list.push_back({size32(values), owner, k});
        values.push_back(-1);
      }
    }
  }
};

TEST(GhostExchange, BringsOwnersValues) {
  Ghosts ghosts;
  const GhostExchange exchange(world(), ghosts.list, ghosts.first);
  std::vector<int> expected = ghosts.values;
  for (const auto& copy : ghosts.list) expected[copy.entry] = 10 * copy.owner + copy.owners_entry;
  exchange.update(ghosts.values);
  EXPECT_EQ(ghosts.values, expected);
}

TEST(GhostExchange, BringsThoseThatChangedAlone) {
  Ghosts ghosts;
  const GhostExchange exchange(world(), ghosts.list, ghosts.first);
  std::vector<int> expected = ghosts.values;
  for (const auto& copy : ghosts.list) {
    if (copy.owner % 2 == 1 && copy.owners_entry == 2) expected[copy.entry] = 10 * copy.owner + 2;
  }
  exchange.update(ghosts.values,
                  [&](std::int32_t entry) { return ghosts.first % 2 == 1 && entry == ghosts.first + 2; });
  EXPECT_EQ(ghosts.values, expected);
}

TEST(GhostExchange, BringsRows) {
  const Ghosts ghosts;
  const GhostExchange exchange(world(), ghosts.list, ghosts.first);
  std::vector<double> rows, none, expected;
  for (const int value : ghosts.values) rows.insert(rows.end(), {value + 0.25, value + 0.5});
  expected = rows;
  for (const auto& copy : ghosts.list) {
    const auto at = 2 * static_cast<std::size_t>(copy.entry);
    expected[at] = 10 * copy.owner + copy.owners_entry + 0.25;
    expected[at + 1] = expected[at] + 0.25;
  }
  exchange.update_rows(rows, 2);
  EXPECT_EQ(rows, expected);
  exchange.update_rows(none, 0);
  EXPECT_TRUE(none.empty());
}

}  // namespace
}  // namespace quadloop
