#pragma once

#include <string>
#include <vector>

#include "quadloop/case/key_table.hpp"

namespace quadloop {

/// Returns every key of a case file, table by table.
const std::vector<TableText>& case_tables();

/// Returns the valid names at the top level: keys and tables.
std::vector<std::string> root_names();

/// Returns the output of `quadloop help` for a key ("spacing.max", "boundary.wing.bc", "max"), for a table
/// ("spacing"), or, for an empty topic, for all tables. Throws UsageError, with the nearest known name, for
/// any other topic.
std::string key_help(const std::string& topic);

/// Returns the tables of docs/reference/case-file.md, each after the line `<!-- keys of NAME -->`.
std::string key_reference();

}  // namespace quadloop
