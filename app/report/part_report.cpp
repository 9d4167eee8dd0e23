#include "app/report/part_report.hpp"

#include <fmt/format.h>

#include "mesher/base/counted.hpp"

namespace quadloop::app {

void add_parts(Statistics& statistics, const PartStatistics& parts) {
  statistics.add("parts", parts.parts);
  statistics.add("edge cut", parts.edge_cut);
  statistics.add("part balance", parts.balance, "{:.4f}");
  statistics.add_raw("cells of a part", fmt::format("{} to {}", parts.fewest_cells, parts.most_cells),
                     json_list({json_of(parts.fewest_cells), json_of(parts.most_cells)}), "part_cells");
  statistics.add("shared nodes", parts.shared_nodes);
  statistics.add_raw("part neighbours", fmt::format("up to {}", parts.most_neighbours),
                     json_of(parts.most_neighbours));
}

void add_parts(MeshSummary& summary, const PartStatistics& parts, const std::vector<std::string>& files) {
  add_parts(summary.statistics, parts);
  summary.files.push_back(files.front() +
                          fmt::format(" and {}", counted(std::ssize(files) - 1, "partition file")));
}

}  // namespace quadloop::app
