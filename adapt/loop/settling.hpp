#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "adapt/loop/record.hpp"
#include "adapt/remesh/demands/adapt_options.hpp"

namespace quadloop {

/// What tells whether cycles go on changing their answer.
struct CycleValues {
  std::int64_t nodes = 0;
  std::optional<double> cl, cd, estimate;
};

CycleValues values_of(const CycleRecord& record);
/// The same, to the last bit, from a record's text.
CycleValues recorded_values(const std::string& json);

/// The order at which the estimate falls with nodes^(-1/2), the edge of a cell; none where one of the cycles
/// has no estimate, or their nodes differ by less than a tenth.
std::optional<double> observed_order(const CycleValues& before, const CycleValues& now);

/// Whether all that `until` names has changed by less; never where it names nothing.
bool have_settled(const AdaptOptions::Until& until, const CycleValues& before, const CycleValues& now);

/// Throws InputError where `until` names a force that the solver does not tell.
void require_told(const AdaptOptions::Until& until, const CycleValues& now);

}  // namespace quadloop
