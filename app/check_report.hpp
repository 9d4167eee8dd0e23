#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesher/mesh/quality.hpp"
#include "mesher/mesh/validate.hpp"

namespace quadloop {

/// What `check` has found out about one mesh.
struct CheckReport {
  std::string file;
  std::int32_t blocks = 1;
  std::vector<std::pair<std::string, std::int64_t>> boundaries;  ///< name and number of edges
  QualitySummary quality;
  double area = 0;
  std::int64_t pinched_nodes = 0;
  std::optional<GeometryFit> fit;  ///< its faults are in `faults` too
  std::vector<MeshFault> faults;
};

/// A table for people. At most `most_faults` faults of each rule are listed; how many more there are is said.
std::string report_text(const CheckReport& report, std::size_t most_faults);

/// One JSON object on one line, with all faults. Numbers read back to the same double; one that is not finite is null.
std::string report_json(const CheckReport& report);

/// The text between quotes as JSON wants it. Bytes that are no UTF-8 are taken as Latin-1.
std::string json_string(std::string_view text);

}  // namespace quadloop
