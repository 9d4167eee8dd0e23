#pragma once

#include <string>
#include <vector>

#include "quadloop/case/key_table.hpp"

namespace quadloop {

/// Every key of a case file, table by table.
const std::vector<TableText>& case_tables();

/// What may stand above all tables: keys and the names of tables.
std::vector<std::string> root_names();

/// What `quadloop help` prints of a key ("spacing.max", "boundary.wing.bc", "max"), of a table ("spacing"),
/// or, for an empty topic, of all tables. Throws UsageError, with the nearest known name, for any other.
std::string key_help(const std::string& topic);

/// The tables of docs/reference/case-file.md, each below the line `<!-- keys of NAME -->`.
std::string key_reference();

}  // namespace quadloop
