#pragma once

#include <optional>
#include <string>

#include "flow/quantities/free_stream.hpp"
#include "quadloop/case/key_table.hpp"

namespace quadloop {

/// The table [flow]: the free stream of a solver of the user's, in that solver's units but for lengths.
struct FlowSettings {
  /// For which a turbulent boundary layer's friction is known.
  static constexpr double least_reynolds = 1000;

  std::string where;               ///< it stands
  std::optional<double> reynolds;  ///< by speed, reference length and viscosity
  double reference_length = 1;     ///< in the geometry's unit of length
  double density = 1, speed = 1, alpha = 0, gamma = 1.4;
  std::optional<double> pressure;
  std::optional<double> mach;  ///< decides the speed, or agrees with it

  /// Dynamic; 0 where no Reynolds number is given.
  double viscosity() const { return reynolds ? density * speed * reference_length / *reynolds : 0; }
  /// Where it has a pressure, without which there are no coefficients.
  std::optional<FreeStream> stream() const;
};

const KeyTable<FlowSettings>& flow_keys();

/// Nothing where the case has no such table. Throws InputError that names key and line.
std::optional<FlowSettings> read_flow_table(const CaseTable& root);

}  // namespace quadloop
