#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adapt/remesh/demands/adapt_options.hpp"
#include "quadloop/case/key_table.hpp"

namespace quadloop {

/// The key `variable` of [adapt].
struct SensorFields {
  adapt::AdaptOptions::Source source = adapt::AdaptOptions::Source::variables;
  std::vector<std::string> names = adapt::AdaptOptions{}.variables;

  friend bool operator==(const SensorFields&, const SensorFields&) = default;
};

/// The table `until` of [adapt].
struct UntilKeys {
  std::optional<double> cl, cd, estimate;

  friend bool operator==(const UntilKeys&, const UntilKeys&) = default;
};

/// The table [adapt].
struct AdaptKeys {
  adapt::AdaptOptions options;
  SensorFields fields;
  UntilKeys until;
};

const KeyTable<AdaptKeys>& adapt_keys();
const KeyTable<UntilKeys>& until_keys();

/// Reads the table [adapt] of a case; empty if it has none. Throws InputError that names key and line.
std::optional<adapt::AdaptOptions> read_adapt_table(const io::CaseTable& root);

}  // namespace quadloop
