#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/text/text_scanner.hpp"

namespace quadloop::io {

/// A DataArray of a VTK XML file, by positions in the text.
struct VtuArray {
  std::string section;  ///< parent element: "PointData", "CellData", "Points", "Cells", "FieldData"
  std::string name, type, format;
  std::int64_t components = 1;
  std::optional<std::int64_t> offset;  ///< relative to the start of the appended data
  std::size_t place = 0;               ///< of its tag
  std::size_t begin = 0, end = 0;      ///< of its contents
};

/// Structure of a VTK XML file, with the positions of its data.
struct VtuDocument {
  bool big_endian = false, wide_header = false, compressed = false;
  std::int64_t points = 0, cells = 0;
  std::size_t piece_place = 0;
  std::vector<VtuArray> arrays;
  bool appended_raw = false;
  std::size_t appended_begin = 0, appended_end = 0;  ///< after its underscore

  /// Null if there is none.
  const VtuArray* find(const std::string& section, const std::string& name) const;
};

/// Returns the file names of a parallel grid's pieces; at least one. Throws InputError if it is not XML or no
/// such grid.
std::vector<std::string> parse_pvtu(const TextScanner& scan);

/// The only use of expat, besides parse_pvtu(). Throws InputError for anything but an XML unstructured grid
/// with exactly one piece.
VtuDocument parse_vtu(const TextScanner& scan);

}  // namespace quadloop::io
