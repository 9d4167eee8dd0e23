#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/parallel/exchange.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Owner ranks of cells by their global numbers: triangles before quads, from 0.
class CellOwners {
 public:
  /// *Collective.*
  CellOwners(const Communicator& comm, const Mesh& mesh);

  /// Global number of one of this rank's cells, triangles, then quads; and the inverse, on the owner rank.
  std::int64_t number(std::int64_t local) const {
    return local < own_triangles_ ? first_triangle_ + local : first_quad_ + local - own_triangles_;
  }
  std::int64_t local(std::int64_t number) const {
    return number < all_triangles_ ? number - first_triangle_ : number - first_quad_ + own_triangles_;
  }
  int rank_of(std::int64_t number) const {
    return number < all_triangles_ ? triangles_.rank_of(number) : quads_.rank_of(number);
  }

 private:
  std::int64_t own_triangles_, all_triangles_, first_triangle_, first_quad_;
  RankRanges triangles_, quads_;
};

/// Fetches rows of `width` values of arbitrary cells, given by global number, from their owners. `rows` are
/// those of this rank's cells. *Collective.*
template <class T>
std::vector<T> rows_of_cells(const Communicator& comm, const CellOwners& owners,
                             std::span<const std::int64_t> cells, const std::vector<T>& rows,
                             std::size_t width = 1) {
  std::vector<int> ranks;
  ranks.reserve(cells.size());
  for (const std::int64_t cell : cells) ranks.push_back(owners.rank_of(cell));
  const Exchange questions(comm, ranks);
  std::vector<T> answers;
  for (const std::int64_t cell : questions.deliver(cells)) {
    const auto row = rows.begin() + owners.local(cell) * width;
    answers.insert(answers.end(), row, row + width);
  }
  return questions.answer(answers, width);
}

}  // namespace quadloop
