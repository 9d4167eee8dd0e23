#include "io/model/file_mesh.hpp"

#include <fmt/format.h>

#include <iterator>
#include <set>

namespace quadloop::io {

void set_blocks(FileMesh& mesh, const std::vector<std::int64_t>& identifiers) {
  const std::set<std::int64_t> distinct(identifiers.begin(), identifiers.end());
  for (const std::int64_t identifier : distinct)
    mesh.block_named(distinct.size() == 1 ? "domain" : fmt::format("block_{}", identifier));
  auto next = identifiers.begin();
  for_each_kind([&]<CellKind kind>() {
    std::vector<std::int32_t>& blocks = mesh.cell_to_block[static_cast<std::size_t>(kind)];
    for (std::size_t i = 0; i < cells_of<kind>(mesh).size(); ++i)
      blocks.push_back(static_cast<std::int32_t>(std::distance(distinct.begin(), distinct.find(*next++))));
  });
}

}  // namespace quadloop::io
