#pragma once

#include <string>
#include <vector>

#include "quadloop/case/key_table.hpp"
#include "quadloop/case/settings.hpp"

namespace quadloop {

/// The table [[source]]: the numbers of its shape, and the size.
struct SourceKeys {
  std::vector<double> box, disc, line;
  double spacing = 0;
};

/// The tables [geometry], geometry.far_field, [spacing], [[source]], [[block]], [[line]] and [mesh].
const KeyTable<Settings>& geometry_keys();
const KeyTable<FarField>& far_field_keys();
const KeyTable<Settings>& spacing_keys();
const KeyTable<SourceKeys>& source_keys();
const KeyTable<BlockRule>& block_keys();
const KeyTable<LineRule>& line_keys();
const KeyTable<Settings>& mesh_keys();

/// Read them. All throw InputError that names key and line.
void read_geometry_table(const io::CaseTable& table, const std::string& case_path, Settings& settings);
void read_spacing_table(const io::CaseTable& table, Settings& settings);
SizeSource read_source(const io::CaseTable& table);
BlockRule read_block(const io::CaseTable& table);
/// Adds a line, or the point that must be a node, if the path has one point.
void read_line(const io::CaseTable& table, Settings& settings);
void read_mesh_table(const io::CaseTable& table, Settings& settings);

}  // namespace quadloop
