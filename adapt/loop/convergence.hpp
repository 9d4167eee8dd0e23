#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "adapt/loop/record.hpp"
#include "adapt/remesh/demands/adapt_options.hpp"

namespace quadloop::adapt {

/// Values that decide whether the loop has converged.
struct CycleValues {
  std::int64_t nodes = 0;
  std::optional<double> cl, cd, estimate;
  std::optional<bool> converged = {};  ///< whether the solver converged, if it reports this
};

CycleValues values_of(const CycleRecord& record);
/// Returns the same values, bitwise, from a record's text.
CycleValues recorded_values(const std::string& json);

/// Returns the observed order of convergence of the estimate in the cell size, nodes^(-1/2); empty if one of
/// the cycles has no estimate, or the numbers of nodes differ by less than a tenth.
std::optional<double> observed_order(const CycleValues& before, const CycleValues& now);

/// Whether all values that `until` names have changed by less than its limits; false if it names none, or if
/// the solver did not converge in one of the cycles.
bool have_settled(const AdaptOptions::Until& until, const CycleValues& before, const CycleValues& now);

/// Throws InputError if `until` names a force that the solver does not provide.
void require_reported(const AdaptOptions::Until& until, const CycleValues& now);

}  // namespace quadloop::adapt
