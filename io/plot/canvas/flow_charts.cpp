#include "io/plot/canvas/flow_charts.hpp"

#include <algorithm>
#include <string_view>

#include "io/files/reading/input_file.hpp"
#include "io/text/text_scanner.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/nearest_word.hpp"

namespace quadloop::io {

namespace {

/// Splits a line into fields; within quotes, two quotes are one.
std::vector<std::string> words_of(std::string_view line) {
  std::vector<std::string> words(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool is_double = quoted && line[i] == '"' && i + 1 < line.size() && line[i + 1] == '"';
    if (is_double) {
      words.back() += line[++i];
    } else if (line[i] == '"') {
      quoted = !quoted;
    } else if (line[i] == ',' && !quoted) {
      words.emplace_back();
    } else {
      words.back() += line[i];
    }
  }
  return words;
}

std::size_t column_of(const PlotTable& table, const std::string& column) {
  const auto found = std::ranges::find(table.columns, column);
  if (found != table.columns.end()) return found - table.columns.begin();
  std::string there;
  for (const std::string& name : table.columns) there += (there.empty() ? "" : ", ") + name;
  throw InputError(table.path + ": has no column '" + column + "'; there are: " + there +
                   guess_for(column, table.columns));
}

}  // namespace

bool PlotTable::has(const std::string& column) const {
  return std::ranges::find(columns, column) != columns.end();
}

std::vector<std::string> PlotTable::words(const std::string& column) const {
  const std::size_t k = column_of(*this, column);
  std::vector<std::string> all;
  for (const auto& row : rows) all.push_back(row[k]);
  return all;
}

std::vector<double> PlotTable::numbers(const std::string& column) const {
  std::vector<double> numbers;
  for (const std::string& word : words(column)) {
    if (!parse_real(word, numbers.emplace_back()))
      throw InputError(path + ":" + std::to_string(numbers.size() + 1) + ": '" + word + "' in column '" +
                       column + "' is no number");
  }
  return numbers;
}

PlotTable read_plot_table(const std::string& path) {
  PlotTable table{path, {}, {}};
  const std::string text = read_input(path);
  std::size_t number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view line(text.data() + begin, end - begin);
    if (line.ends_with('\r')) line.remove_suffix(1);
    begin = end + 1;
    ++number;
    if (line.empty()) continue;
    std::vector<std::string> words = words_of(line);
    if (table.columns.empty()) {
      table.columns = std::move(words);
      continue;
    }
    if (words.size() != table.columns.size())
      throw InputError(path + ":" + std::to_string(number) + ": has " + std::to_string(words.size()) +
                       " words, but the first line names " + std::to_string(table.columns.size()) +
                       " columns");
    table.rows.push_back(std::move(words));
  }
  return table;
}

Chart wall_chart(const PlotTable& walls, const std::string& column, const std::optional<Box>& window) {
  const std::vector<std::string> names = walls.words("boundary");
  const std::vector<double> along = walls.numbers("s"), x = walls.numbers("x"),
                            values = walls.numbers(column);
  if (names.empty()) throw InputError(walls.path + ": contains no wall");
  Chart chart{{"x"}, {{{column, false, column == "Cp"}, {}}}};
  ChartPanel& panel = chart.panels[0];
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bool goes_on = i > 0 && names[i] == names[i - 1] && along[i] > along[i - 1];
    if (!goes_on) panel.lines.push_back({names[i], {}});
    panel.lines.back().points.push_back({x[i], values[i]});
  }
  if (window) {
    chart.x.range = {window->low.x, window->high.x};
    panel.y.range = {window->low.y, window->high.y};
  }
  return chart;
}

Chart cycles_chart(const std::vector<CycleStatistics>& cycles) {
  Chart chart{{"cycle"}, {}};
  const auto add = [&](const char* name, bool logarithmic, std::optional<double> CycleStatistics::*figure) {
    ChartLine line{name, {}};
    for (const CycleStatistics& cycle : cycles) {
      if (cycle.*figure) line.points.push_back({cycle.cycle, *(cycle.*figure)});
    }
    if (!line.points.empty()) chart.panels.push_back({{name, logarithmic}, {line}});
  };
  add("residual", true, &CycleStatistics::residual);
  add("CL", false, &CycleStatistics::cl);
  add("CD", false, &CycleStatistics::cd);
  if (chart.panels.empty()) throw InputError("no cycle tells a residual or forces");
  return chart;
}

Chart history_chart(const std::vector<PlotTable>& histories) {
  Chart chart{{"step"},
              {{{"residual", true}, {{"residual", {}}}}, {{"CL"}, {{"CL", {}}}}, {{"CD"}, {{"CD", {}}}}}};
  double before = 0;
  for (const PlotTable& history : histories) {
    const std::vector<double> steps = history.numbers("step");
    for (const auto& [panel, column] : {std::pair{0, "residual"}, {1, "cl"}, {2, "cd"}}) {
      const std::vector<double> values = history.numbers(column);
      for (std::size_t i = 0; i < steps.size(); ++i)
        chart.panels[panel].lines[0].points.push_back({before + steps[i], values[i]});
    }
    if (steps.empty()) continue;
    before += steps.back();
    chart.flags.push_back(before);
  }
  if (!chart.flags.empty()) chart.flags.pop_back();
  return chart;
}

}  // namespace quadloop::io
