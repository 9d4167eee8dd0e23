#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace quadloop {

/// What record.json keeps of a cycle.
struct CycleRecord {
  int cycle = 0;
  std::uint64_t case_digest = 0;  ///< of all that the run depends on
  std::int64_t nodes = 0, triangles = 0, quads = 0, leaves = 0;
  double worst_angle = 0;          ///< the smallest corner, degrees
  double mean = 0, deviation = 0;  ///< of log10 of the indicator
  std::int64_t refined = 0, coarsened = 0;
  std::int64_t outside = 0;                           ///< nodes that the transfer found outside the old mesh
  std::vector<std::pair<std::string, double>> drift;  ///< of each variable's integral in the transfer into this cycle
  std::optional<double> cl, cd, residual;
  std::vector<std::pair<std::string, double>> seconds;
};

/// One JSON object, a member a line; numbers are the shortest that read back as they are.
std::string json_text(const CycleRecord& record);

/// The digest in a record's text, if it has one.
std::optional<std::uint64_t> case_digest_in(const std::string& json);

}  // namespace quadloop
