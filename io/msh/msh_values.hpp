#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/msh/msh_nodes.hpp"
#include "io/text/text_scanner.hpp"
#include "mesher/mesh/field.hpp"

namespace quadloop {

/// A section $NodeData or $ElementData: rows of `width` values by the tags of nodes or elements.
struct MshValues {
  std::string name;
  std::size_t width = 1;
  NodeTags rows;
  std::vector<double> values;
};

/// What an MSH file tells of a solution.
struct MshSolution {
  std::vector<MshValues> at_nodes, in_elements;
  std::int64_t others = 0;  ///< sections of values that are not read: at the nodes of each element

  bool empty() const { return at_nodes.empty() && in_elements.empty() && others == 0; }
};

/// All sections of values in the text, in their order; of several of one name, as of steps in time, the last
/// counts. Throws InputError.
MshSolution read_msh_values(TextScanner& scan);

/// The columns of values for entries of these tags, row after row: a vector's are NAME_x and NAME_y (and
/// NAME_z unless all are 0), a tensor's NAME_1 to NAME_9. One that not all entries have is left out; `losses`
/// says so.
CellValues msh_columns(const std::vector<MshValues>& sections, std::span<const std::int64_t> tags,
                       const char* of, std::vector<std::string>& losses);

}  // namespace quadloop
