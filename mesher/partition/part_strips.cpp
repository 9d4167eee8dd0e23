#include "mesher/partition/part_strips.hpp"

#include <algorithm>
#include <utility>

namespace quadloop {

namespace {

/// Collects the columns of one strip along its line.
class StripCutter {
 public:
  StripCutter(const StripLayers& strip, std::vector<StripLayers>& found) : strip_{strip}, found_{found} {}

  void add(std::int32_t column, const std::vector<GlobalNodeId>& nodes) {
    if (run_.nodes.empty()) {
      run_ = {strip_.name, strip_.layers, strip_.from_wall && column == 0, strip_.across, {}};
    }
    run_.nodes.insert(run_.nodes.end(), nodes.begin(), nodes.end());
  }

  /// Ends a run of columns; a single column has no cells.
  void end_run() {
    if (run_.columns() > 1) found_.push_back(std::move(run_));
    run_ = {};
  }

 private:
  const StripLayers& strip_;
  std::vector<StripLayers>& found_;
  StripLayers run_;
};

/// Returns a column's nodes in the part; empty if the column is not complete there.
std::vector<GlobalNodeId> column_in_part(const StripLayers& strip, std::int32_t column,
                                         std::span<const std::int64_t> nodes) {
  std::vector<GlobalNodeId> here;
  for (std::int32_t row = 0; row < strip.across; ++row) {
    const std::int64_t node = strip.node(column, row).value();
    const auto at = std::ranges::lower_bound(nodes, node);
    if (at == nodes.end() || *at != node) return {};
    here.emplace_back(at - nodes.begin());
  }
  return here;
}

}  // namespace

std::vector<StripLayers> strips_in_part(const std::vector<StripLayers>& strips,
                                        std::span<const std::int64_t> nodes) {
  std::vector<StripLayers> found;
  for (const StripLayers& strip : strips) {
    StripCutter cutter(strip, found);
    for (std::int32_t column = 0; column < strip.columns(); ++column) {
      const std::vector<GlobalNodeId> here = column_in_part(strip, column, nodes);
      if (here.empty())
        cutter.end_run();
      else
        cutter.add(column, here);
    }
    cutter.end_run();
  }
  return found;
}

}  // namespace quadloop
