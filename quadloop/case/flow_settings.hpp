#pragma once

#include <optional>
#include <string>

#include "flow/postprocess/free_stream.hpp"
#include "quadloop/case/key_table.hpp"

namespace quadloop {

/// The table [flow]: free stream of an external solver, in that solver's units except for lengths.
struct FlowSettings {
  /// Least Reynolds number for the turbulent friction formula.
  static constexpr double least_reynolds = 1000;

  std::string where;               ///< location of the table in the case file
  std::optional<double> reynolds;  ///< based on speed, reference length and viscosity
  double reference_length = 1;     ///< in the geometry's unit of length
  double density = 1, speed = 1, alpha = 0, gamma = 1.4;
  std::optional<double> pressure;
  std::optional<double> mach;  ///< determines the speed, or must agree with it

  /// Dynamic viscosity; 0 if no Reynolds number is given.
  double viscosity() const { return reynolds ? density * speed * reference_length / *reynolds : 0; }
  /// Returns the free stream; empty without a pressure, as coefficients need one.
  std::optional<flow::FreeStream> stream() const;
};

const KeyTable<FlowSettings>& flow_keys();

/// Reads the table; empty if the case has none. Throws InputError that names key and line.
std::optional<FlowSettings> read_flow_table(const io::CaseTable& root);

}  // namespace quadloop
