#include "flow/postprocess/history.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace quadloop::flow {

std::string history_table(const std::vector<HistoryRow>& history) {
  const bool timed = std::ranges::any_of(history, [](const HistoryRow& row) { return row.time != 0; });
  std::string text = timed ? "step,residual,cl,cd,time\n" : "step,residual,cl,cd\n";
  for (const HistoryRow& row : history) {
    text += fmt::format("{},{},{},{}", row.step, row.residual, row.cl, row.cd);
    text += timed ? fmt::format(",{}\n", row.time) : "\n";
  }
  return text;
}

}  // namespace quadloop::flow
