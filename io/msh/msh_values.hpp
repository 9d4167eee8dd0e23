#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/msh/msh_nodes.hpp"
#include "io/text/text_scanner.hpp"
#include "mesher/mesh/field.hpp"

namespace quadloop::io {

/// A section $NodeData or $ElementData: rows of `width` values by the tags of nodes or elements.
struct MshValues {
  std::string name;
  std::size_t width = 1;
  NodeTags rows;
  std::vector<double> values;
};

/// The solution in an MSH file.
struct MshSolution {
  std::vector<MshValues> at_nodes, in_elements;
  std::int64_t others = 0;  ///< sections of values that are not read: at the nodes of each element

  bool empty() const { return at_nodes.empty() && in_elements.empty() && others == 0; }
};

/// Reads all sections of values in the text, in their order; of several with one name, e.g. time steps, the
/// last counts. Throws InputError.
MshSolution read_msh_values(TextScanner& scan);

/// Returns the columns of values for entries with these tags, row after row: vectors become NAME_x and NAME_y
/// (and NAME_z unless all are 0), tensors NAME_1 to NAME_9. A variable that is missing for some entries is
/// omitted and reported in `losses`.
CellValues msh_columns(const std::vector<MshValues>& sections, std::span<const std::int64_t> tags,
                       const char* of, std::vector<std::string>& losses);

}  // namespace quadloop::io
