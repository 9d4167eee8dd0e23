#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/text/text_scanner.hpp"

namespace quadloop {

/// One DataArray of a VTK XML file, by places in the text.
struct VtuArray {
  std::string section;  ///< the element it stands in: "PointData", "CellData", "Points", "Cells", "FieldData"
  std::string name, type, format;
  std::int64_t components = 1;
  std::optional<std::int64_t> offset;  ///< from the begin of the appended data
  std::size_t place = 0;               ///< of its tag
  std::size_t begin = 0, end = 0;      ///< of what stands in it
};

/// What a VTK XML file says of itself and where its data stand.
struct VtuDocument {
  bool big_endian = false, wide_header = false, compressed = false;
  std::int64_t points = 0, cells = 0;
  std::size_t piece_place = 0;
  std::vector<VtuArray> arrays;
  bool appended_raw = false;
  std::size_t appended_begin = 0, appended_end = 0;  ///< after its underscore

  /// Null where there is none.
  const VtuArray* find(const std::string& section, const std::string& name) const;
};

/// The files of a parallel grid's pieces, as it names them; at least one. Refuses what is no XML or no such
/// grid.
std::vector<std::string> parse_pvtu(const TextScanner& scan);

/// The one door to expat, with parse_pvtu(). Refuses what is no XML, no unstructured grid, or has not exactly
/// one piece.
VtuDocument parse_vtu(const TextScanner& scan);

}  // namespace quadloop
