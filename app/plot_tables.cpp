#include "app/plot_tables.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <vector>

#include "adapt/loop/record.hpp"
#include "adapt/solvers/cycle_paths.hpp"
#include "io/files/reading/input_file.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/suffix.hpp"

namespace quadloop::app {

namespace {

namespace fs = std::filesystem;

struct WholeCycle {
  int number;
  adapt::CyclePaths paths;
};

/// Returns the cycles of an adaptive run, in order.
std::vector<WholeCycle> cycles_in(const std::string& run) {
  std::vector<WholeCycle> cycles;
  constexpr std::string_view head = "cycle_";
  for (const fs::directory_entry& entry : fs::directory_iterator(run)) {
    const std::string name = entry.path().filename();
    if (!name.starts_with(head) || !entry.is_directory()) continue;
    int number = 0;
    const char* const end = name.data() + name.size();
    const auto [after, fault] = std::from_chars(name.data() + head.size(), end, number);
    if (fault == std::errc() && after == end) cycles.push_back({number, {entry.path()}});
  }
  if (cycles.empty())
    throw InputError(run + ": contains no cycle; give the folder of a 'quadloop adapt' run");
  std::ranges::sort(cycles, {}, &WholeCycle::number);
  return cycles;
}

constexpr const char* cure =
    "; forces and wall values are written if [flow] has a pressure and a boundary has bc = \"wall\"";

/// Returns the table itself, or that written with a mesh.
std::string table_of(const std::string& input, const char* suffix) {
  if (suffix_of(input) == ".csv") return input;
  const std::string table = fs::path(input).replace_extension().string() + suffix;
  if (!fs::exists(table))
    throw InputError(table + ": does not exist; 'quadloop solve' writes it beside the flow");
  return table;
}

io::Chart chart_of_records(const std::string& run, const std::vector<WholeCycle>& cycles) {
  std::vector<io::CycleStatistics> statistics;
  for (const auto& [number, paths] : cycles) {
    if (!fs::exists(paths.record())) continue;
    const std::string json = io::read_input(paths.record());
    statistics.push_back({static_cast<double>(number), adapt::recorded_number(json, "residual"),
                          adapt::recorded_number(json, "cl"), adapt::recorded_number(json, "cd")});
  }
  try {
    return io::cycles_chart(statistics);
  } catch (const InputError& error) {
    throw InputError(run + ": " + error.what() + cure);
  }
}

}  // namespace

io::PlotTable wall_table_for(const std::string& input) {
  if (!fs::is_directory(input)) return io::read_plot_table(table_of(input, flow::wall_table_suffix));
  const std::string table = cycles_in(input).back().paths.walls();
  if (!fs::exists(table)) throw InputError(table + ": does not exist" + cure);
  return io::read_plot_table(table);
}

io::Chart chart_of_history(const std::string& input) {
  if (!fs::is_directory(input))
    return io::history_chart({io::read_plot_table(table_of(input, flow::history_suffix))});
  const std::vector<WholeCycle> cycles = cycles_in(input);
  std::vector<io::PlotTable> histories;
  for (const WholeCycle& cycle : cycles) {
    if (fs::exists(cycle.paths.history())) histories.push_back(io::read_plot_table(cycle.paths.history()));
  }
  return histories.empty() ? chart_of_records(input, cycles) : io::history_chart(histories);
}

}  // namespace quadloop::app
