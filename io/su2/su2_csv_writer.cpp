#include "io/su2/su2_csv_file.hpp"
#include "io/su2/su2_restart_table.hpp"
#include "io/text/text_output.hpp"

namespace quadloop::io {

void write_su2_csv(OutputSet& outputs, const Mesh& mesh, const std::string& path, const Field& solution,
                   double gamma) {
  const Su2RestartTable table(solution.names, gamma);
  const std::vector<std::string>& names = table.names();
  std::string header = R"("PointID","x","y")";
  for (const std::string& name : names) header.append(",\"").append(name).append("\"");
  TextOutput file(outputs, path);
  file.write(header + "\n");
  file.write_rows(mesh.owned_nodes, 3 + names.size(), [&](TextRows& text, std::int64_t i) {
    text.put(mesh.first_node + i, ',');
    text.put(mesh.points[i].x, ',');
    text.put(mesh.points[i].y, names.empty() ? '\n' : ',');
    std::size_t left = names.size();
    table.for_each_value(std::span(solution.values).subspan(i * solution.width(), solution.width()),
                         [&](double value) { text.put(value, --left == 0 ? '\n' : ','); });
  });
  file.close();
}

}  // namespace quadloop::io
