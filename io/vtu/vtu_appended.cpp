#include "io/vtu/vtu_appended.hpp"

#include <array>
#include <span>
#include <variant>

#include "io/vtu/vtu_text.hpp"

namespace quadloop::io {

namespace {

constexpr std::array<const char*, vtk_sections.size()> elements = {"Points", "Cells", "PointData",
                                                                   "CellData"};

constexpr const char* xml_type(VtkNumber number) {
  switch (number) {
    case VtkNumber::float64: return "Float64";
    case VtkNumber::int64: return "Int64";
    case VtkNumber::int32: return "Int32";
    case VtkNumber::uint8: return "UInt8";
  }
  return "";
}

}  // namespace

std::string VtuAppended::head(std::int64_t points, std::int64_t cells) const {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n<FieldData>\n";
  text += vtu_field_array(vtk_boundary_names, boundaries());
  for (const FieldArray& field : fields())
    std::visit([&](const auto& values) { text += vtu_field_array(field.name, values); }, field.values);
  text += vtu_name_arrays(boundaries(), boundary_dimension());
  return text + "</FieldData>\n<Piece NumberOfPoints=\"" + std::to_string(points) + "\" NumberOfCells=\"" +
         std::to_string(cells) + "\">\n";
}

std::string VtuAppended::tags_of(VtkSection section, std::int64_t& offset) const {
  std::string tags;
  for_each_array([&](const Array& array) {
    if (array.section != section) return;
    tags += std::string("<DataArray type=\"") + xml_type(array.number) + "\" Name=\"" +
            xml_escaped(array.name) + "\"";
    if (array.components > 1) tags += " NumberOfComponents=\"" + std::to_string(array.components) + "\"";
    tags += " format=\"appended\" offset=\"" + std::to_string(offset) + "\"/>\n";
    offset += array.bytes() + std::int64_t{sizeof(std::uint64_t)};
  });
  const std::string element = elements[static_cast<std::size_t>(section)];
  return tags.empty() ? tags : "<" + element + ">\n" + tags + "</" + element + ">\n";
}

void VtuAppended::write(std::int64_t points, std::int64_t cells) {
  std::string text = head(points, cells);
  std::int64_t offset = 0;
  for (const VtkSection section : vtk_sections) text += tags_of(section, offset);
  text += "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
  file().write(text);
  for_each_array([&](const Array& array) {
    const std::array size{in_order<std::endian::little>(static_cast<std::uint64_t>(array.bytes()))};
    file().write(io::bytes_of(std::span(size)));
    array.write();
  });
  file().write("\n</AppendedData>\n</VTKFile>\n");
  file().close();
}

}  // namespace quadloop::io
