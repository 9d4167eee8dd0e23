#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace quadloop::io {

/// For each row, returns which one of those with the same nodes, in any order, is kept: the smallest by
/// `size_of(i)`, else the first.
template <class Row, class NodesOf, class SizeOf>
std::vector<std::size_t> kept_rows(const std::vector<Row>& rows, const NodesOf& nodes_of,
                                   const SizeOf& size_of) {
  std::vector<std::tuple<std::decay_t<decltype(nodes_of(rows[0]))>, std::int64_t, std::size_t>> keys;
  keys.reserve(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    auto nodes = nodes_of(rows[i]);
    std::sort(nodes.begin(), nodes.end());
    keys.emplace_back(nodes, size_of(i), i);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::size_t> kept(rows.size());
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const auto& [nodes, size, i] = keys[k];
    const bool again = k > 0 && nodes == std::get<0>(keys[k - 1]);
    kept[i] = again ? kept[std::get<2>(keys[k - 1])] : i;
  }
  return kept;
}

/// Removes the duplicate rows; `kept` is the result of kept_rows().
template <class Rows>
void keep_rows(Rows& rows, const std::vector<std::size_t>& kept) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (kept[i] == i) rows[count++] = rows[i];
  }
  rows.resize(count);
}

/// Number of elements that are also in a second group, by the names of the group that was kept and the other.
using RepeatedElements = std::map<std::pair<std::string, std::string>, std::int64_t>;

/// Adds a line for each pair of groups, at most five, and one for elements that are in one group twice.
void warn_of_repeated(const RepeatedElements& repeated, const std::string& path,
                      std::vector<std::string>& warnings);

/// Returns "'inlet', 'wall' and 3 more" for a warning, with at most five names.
std::string some_names(const std::vector<std::string>& names);

}  // namespace quadloop::io
