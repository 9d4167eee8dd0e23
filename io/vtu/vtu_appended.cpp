#include "io/vtu/vtu_appended.hpp"

#include <algorithm>

#include "io/vtu/vtu_text.hpp"

namespace quadloop::io {

namespace {

constexpr std::array<const char*, 4> data_elements = {"Points", "Cells", "PointData", "CellData"};

}  // namespace

std::string VtuAppended::tags_of(const std::string& element, std::int64_t& offset) const {
  std::string tags;
  for (const Array& array : arrays_) {
    if (array.element != element) continue;
    tags += "<DataArray type=\"" + array.type + "\" Name=\"" + xml_escaped(array.name) + "\"";
    if (array.components > 1) tags += " NumberOfComponents=\"" + std::to_string(array.components) + "\"";
    tags += " format=\"appended\" offset=\"" + std::to_string(offset) + "\"/>\n";
    offset += array.bytes + std::int64_t{sizeof(std::uint64_t)};
  }
  return tags.empty() ? tags : "<" + element + ">\n" + tags + "</" + element + ">\n";
}

void VtuAppended::write(const std::string& head) {
  std::string text = head;
  std::int64_t offset = 0;
  for (const char* element : data_elements) text += tags_of(element, offset);
  text += "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
  file_.write(text);
  for (const char* element : data_elements) {
    for (const Array& array : arrays_) {
      if (array.element != element) continue;
      const std::array size{in_order<std::endian::little>(static_cast<std::uint64_t>(array.bytes))};
      file_.write(bytes_of(std::span(size)));
      array.write();
    }
  }
  file_.write("\n</AppendedData>\n</VTKFile>\n");
  file_.close();
}

}  // namespace quadloop::io
