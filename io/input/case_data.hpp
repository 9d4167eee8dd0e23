#pragma once

#include <toml++/toml.h>

#include <map>
#include <string>
#include <vector>

#include "io/input/case_file.hpp"

namespace quadloop::io {

/// The parsed file with its assignments. Private to io/input: the only header that exposes toml++.
struct CaseTable::Data {
  std::string file;
  bool has_lines = true;  ///< whether locations contain line numbers
  toml::table root;
  std::vector<std::string> warnings;
  std::map<std::string, std::string> assigned;  ///< dotted key -> the assignment that set it

  /// Returns the location of a dotted key, given its node, if there is one.
  std::string place(const std::string& path, const toml::node* node) const;
};

/// Reads and parses the case, without assignments.
void parse_case(CaseTable::Data& data, const CaseSource& source);
/// Applies one "key=value" to the tables.
void assign(CaseTable::Data& data, const std::string& assignment);

}  // namespace quadloop::io
