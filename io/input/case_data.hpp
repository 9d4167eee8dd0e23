#pragma once

#include <toml++/toml.h>

#include <map>
#include <string>
#include <vector>

#include "io/input/case_file.hpp"

namespace quadloop {

/// The parsed file and what was laid over it. Private to io/input: the one header of ours that shows toml++.
struct CaseTable::Data {
  std::string file;
  toml::table root;
  std::vector<std::string> warnings;
  std::map<std::string, std::string> assigned;  ///< dotted key -> the assignment that set it

  /// The place of a dotted key whose node (if there is one) is given.
  std::string place(const std::string& path, const toml::node* node) const;
};

/// Reads and parses; no assignments yet.
void parse_case(CaseTable::Data& data, const std::string& path);
/// Lays one "key=value" over the tables.
void assign(CaseTable::Data& data, const std::string& assignment);

}  // namespace quadloop
