// The VTU reader: what it accepts, in every encoding, and what it refuses by line; and that the writer's
// files come back. On one rank alone.
#include "io/vtu/vtu_file.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <sstream>

#include "mesher/mesh/check/validate.hpp"
#include "tests/io/read_plane.hpp"
#include "tests/io/reader_check.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/io/write_alone.hpp"
#include "tests/mesh/node.hpp"
#include "tests/support/world.hpp"

namespace quadloop::io {
namespace {

using test::node;
using test::replaced;
using test::TemporaryFolder;

const test::ReaderCheck check{test::read_plane<read_vtu>, "m.vtu"};

/// A unit square as a quad with a triangle on top, as a program that knows nothing of boundaries writes it;
/// line numbers below count in it.
const std::string head =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
    "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n";
const std::string house =
    head +
    "<Piece NumberOfPoints=\"5\" NumberOfCells=\"2\">\n"  // 4
    "<PointData Scalars=\"rho\">\n<DataArray type=\"Float32\" Name=\"rho\" format=\"ascii\">1 2 3 4 "
    "5.5</DataArray>\n"  // 6
    "<DataArray type=\"Float64\" Name=\"Velocity\" NumberOfComponents=\"3\">\n1 2 0 3 4 0 5 6 0 7 8 0 9 1e1 "
    "0\n"                           // 8
    "</DataArray>\n</PointData>\n"  // 10
    "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\">0 0 2 1 0 2 1 1 2 0 1 2 .5 1.5 "
    "2</DataArray></Points>\n"                                                               // 11
    "<Cells>\n<DataArray type=\"Int32\" Name=\"connectivity\">0 1 2 3\n3 2 4</DataArray>\n"  // 14
    "<DataArray type=\"Int32\" Name=\"offsets\">4 7</DataArray>\n"                           // 15
    "<DataArray type=\"UInt8\" Name=\"types\">9 5</DataArray>\n</Cells>\n"                   // 17
    "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";

void expect_house(const LoadedMesh& loaded) {
  EXPECT_TRUE(validate(loaded.mesh).empty());
  EXPECT_EQ(loaded.mesh.points, (std::vector<Point>{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 1.5}}));
  ASSERT_EQ(loaded.mesh.quads.size(), 1U);
  EXPECT_EQ(loaded.mesh.quads[0], (std::array{node(0), node(1), node(2), node(3)}));
  ASSERT_EQ(loaded.mesh.triangles.size(), 1U);
  EXPECT_EQ(loaded.mesh.triangles[0], (std::array{node(3), node(2), node(4)}));
}

TEST(VtuReader, ReadsCellsAndPointData) {
  const LoadedMesh loaded = check.of(house);
  expect_house(loaded);
  ASSERT_EQ(loaded.mesh.boundaries.size(), 1U);
  EXPECT_EQ(loaded.mesh.boundaries[0].name, "boundary");
  ASSERT_TRUE(loaded.solution);
  EXPECT_EQ(loaded.solution->names, (std::vector<std::string>{"rho", "Velocity_x", "Velocity_y"}));
  EXPECT_EQ(loaded.solution->values, (std::vector<double>{1, 1, 2, 2, 3, 4, 3, 5, 6, 4, 7, 8, 5.5, 9, 10}));
  expect_house(check.of(test::with_crlf(house)));
}

TEST(VtuReader, TakesNotesInArraysAndOtherCells) {
  const std::string note = "<InformationKey name=\"L2\" location=\"v\">7</InformationKey>";
  expect_house(check.of(replaced(house, ">1 2 3 4 5.5<", ">\n1 2 3 4 5.5\n" + note + "<")));
  const LoadedMesh before = check.of(replaced(house, ">1 2 3 4 5.5<", ">" + note + "1 2 3 4 5.5<"));
  EXPECT_EQ(before.solution->values.at(3), 2);
  expect_house(check.of(replaced(replaced(house, ">0 1 2 3\n", ">0 1 3 2\n"), ">9 5<", ">8 5<")));
  expect_house(check.of(replaced(house, ">9 5<", ">7 7<")));
  const LoadedMesh turned = check.of(replaced(house, "\n3 2 4<", "\n3 4 2<"));
  EXPECT_TRUE(validate(turned.mesh).empty());
  EXPECT_EQ(turned.warnings.size(), 1U);
}

TEST(VtuReader, KeepsAThirdComponentThatSaysSomething) {
  EXPECT_EQ(check.of(replaced(house, "9 1e1 0", "9 1e1 3")).solution->names.back(), "Velocity_z");
}

/// Exchanges the text of every array for what `encode` makes of its numbers.
template <class Encode>
std::string encoded(std::string text, const Encode& encode) {
  for (std::size_t at = text.find("<DataArray"); at != std::string::npos;
       at = text.find("<DataArray", at + 1)) {
    const std::size_t begin = text.find('>', at) + 1, end = text.find("</DataArray>", begin);
    const std::size_t type_at = text.find("type=\"", at) + 6;
    const std::string type = text.substr(type_at, text.find('"', type_at) - type_at);
    std::string bytes;
    const auto append = [&](auto value) {
      bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
    };
    std::istringstream numbers(text.substr(begin, end - begin));
    for (double number = 0; numbers >> number;) {
      if (type == "Float64") append(number);
      if (type == "Float32") append(static_cast<float>(number));
      if (type == "Int32") append(static_cast<std::int32_t>(number));
      if (type == "UInt8") append(static_cast<std::uint8_t>(number));
    }
    const auto [attributes, content] = encode(bytes);
    text.replace(begin, end - begin, content);
    std::string tag = text.substr(at, begin - 1 - at);
    const std::size_t format = tag.find(" format=");
    if (format != std::string::npos) tag.erase(format, std::string(" format=\"ascii\"").size());
    text.replace(at, begin - 1 - at, tag + " " + attributes);
  }
  return text;
}

std::string base64(const std::string& bytes) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? digits[bits >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

template <class Size>
std::string size_bytes(std::size_t size) {
  const auto value = static_cast<Size>(size);
  return {reinterpret_cast<const char*>(&value), sizeof(value)};
}

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string packed(size, '\0');
  compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
           bytes.size());
  packed.resize(size);
  return packed;
}

using Encoded = std::pair<std::string, std::string>;

std::string inline_base64(const std::string& text) {
  return encoded(text, [](const std::string& bytes) {
    return Encoded{"format=\"binary\"",
                   "\n  " + base64(size_bytes<std::uint32_t>(bytes.size()) + bytes) + "\n  "};
  });
}

std::string appended(const std::string& text, bool raw) {
  std::string data;
  const std::string changed = encoded(
      replaced(text, "version=\"0.1\"", "version=\"1.0\" header_type=\"UInt64\""),
      [&](const std::string& bytes) {
        const std::string attributes = "format=\"appended\" offset=\"" + std::to_string(data.size()) + "\"";
        const std::string with_size = size_bytes<std::uint64_t>(bytes.size()) + bytes;
        data += raw ? with_size : base64(with_size);
        return Encoded{attributes, ""};
      });
  const std::string tag = std::string("<AppendedData encoding=\"") + (raw ? "raw" : "base64") + "\">\n _";
  return replaced(changed, "</VTKFile>", tag + data + "\n</AppendedData>\n</VTKFile>");
}

/// The square with lines below it and on its right, as meshio writes them with physical groups of Gmsh.
std::string with_lines(const std::string& cell_data, const std::string& field_data = "") {
  std::string text = house;
  for (const auto& [from, to] :
       {std::pair{std::string("NumberOfCells=\"2\""), std::string("NumberOfCells=\"7\"")},
        {"3 2 4</DataArray>", "3 2 4 0 1 1 2 2 4 4 3 3 0</DataArray>"},
        {">4 7</", ">4 7 9 11 13 15 17</"},
        {">9 5</", ">9 5 3 3 3 3 3</"},
        {"</Piece>", "<CellData>" + cell_data + "</CellData></Piece>"},
        {"<Piece", "<FieldData>" + field_data + "</FieldData><Piece"}})
    text = replaced(text, from, to);
  return text;
}

TEST(VtuReader, TakesBoundariesFromPhysicalGroups) {
  const std::string groups =
      "<DataArray type=\"Int64\" Name=\"gmsh:physical\" format=\"ascii\">1 1 12 12 7 7 7</DataArray>";
  const std::string inlet =
      "<DataArray type=\"Int64\" Name=\"inlet\" NumberOfTuples=\"2\" format=\"ascii\">12 1</DataArray>";
  for (const auto& [field_data, name] : {std::pair{std::string(), "boundary_12"}, {inlet, "inlet"}}) {
    const LoadedMesh loaded = check.of(with_lines(groups, field_data));
    expect_house(loaded);
    ASSERT_EQ(loaded.mesh.boundaries.size(), 2U);
    EXPECT_EQ(loaded.mesh.boundaries[0].name, name);
    EXPECT_EQ(loaded.mesh.boundaries[0].edges.size(), 2U);
    EXPECT_EQ(loaded.mesh.boundaries[1].name, "boundary_7");
    ASSERT_EQ(loaded.warnings.size(), 1U);
    EXPECT_NE(loaded.warnings[0].find("the cell data 'gmsh:physical' distinguish its boundaries"),
              std::string::npos);
  }
}

TEST(VtuReader, WarnsWhereNothingTellsBoundariesApart) {
  const std::string same =
      "<DataArray type=\"Int64\" Name=\"medit:ref\" format=\"ascii\">1 2 3 3 3 3 3</DataArray>";
  const LoadedMesh loaded = check.of(with_lines(same));
  EXPECT_EQ(loaded.mesh.boundaries.size(), 1U);
  ASSERT_EQ(loaded.warnings.size(), 1U);
  EXPECT_NE(loaded.warnings[0].find(
                "no cell data distinguish its boundaries; they form one boundary; where 'medit:ref' "
                "numbers them, call these cell data 'boundary'"),
            std::string::npos)
      << loaded.warnings[0];
}

TEST(VtuReader, NamesCellsOfHigherOrder) {
  check.expect_refusal(replaced(house, ">9 5</", ">9 22</"),
                       "m.vtu:", "VTK type 22 (triangle of second order)");
}

TEST(VtuReader, ReadsBase64) {
  EXPECT_EQ(check.of(inline_base64(house)).solution->values, check.of(house).solution->values);
  expect_house(check.of(inline_base64(house)));
  const std::string apart = encoded(house, [](const std::string& bytes) {  // the size in a stream of its own
    return Encoded{"format=\"binary\"", base64(size_bytes<std::uint32_t>(bytes.size())) + base64(bytes)};
  });
  expect_house(check.of(apart));
}

TEST(VtuReader, ReadsAppendedData) {
  for (const bool raw : {true, false}) {
    const LoadedMesh loaded = check.of(appended(house, raw));
    expect_house(loaded);
    EXPECT_EQ(loaded.solution->values, check.of(house).solution->values);
  }
}

TEST(VtuReader, ReadsZlib) {
  const std::string text =
      replaced(house, "version=\"0.1\"", "version=\"0.1\" compressor=\"vtkZLibDataCompressor\"");
  const auto packed = [&](std::size_t block) {
    return encoded(text, [block](const std::string& bytes) {
      std::string header, data;
      std::size_t blocks = 0;
      for (std::size_t at = 0; at < bytes.size(); at += block, ++blocks) {
        const std::string piece = deflated(bytes.substr(at, block));
        header += size_bytes<std::uint32_t>(piece.size());
        data += piece;
      }
      header = size_bytes<std::uint32_t>(blocks) + size_bytes<std::uint32_t>(block) +
               size_bytes<std::uint32_t>(bytes.size() % block) + header;
      return Encoded{"format=\"binary\"", base64(header) + base64(data)};
    });
  };
  for (const std::size_t block : {8U, 20U, 1000U}) expect_house(check.of(packed(block)));
  check.expect_refusal(replaced(packed(1000), "vtkZLib", "vtkLZ4"),
                       "m.vtu:2: ", "vtkLZ4DataCompressor; save it with zlib");
  check.expect_refusal(
      replaced(inline_base64(house), "version=\"0.1\"", "compressor=\"vtkZLibDataCompressor\""),
      "m.vtu:", "cut short, or not what its header says");
}

TEST(VtuReader, RefusesWrongCountsAndNumbersByLine) {
  check.expect_refusal(replaced(house, ">1 2 3 4 5.5<", ">1 2 3 4<"),
                       "m.vtu:6: ", "'rho' of PointData holds 4 numbers, not 5");
  check.expect_refusal(replaced(house, ">1 2 3 4 5.5<", ">1 2 nan 4 5<"),
                       "m.vtu:6: ", "'rho' is not finite at node 3");
  check.expect_refusal(replaced(house, "9 1e1 0\n", "9 ten 0\n"), "m.vtu:8: ", "ten");
  check.expect_refusal(replaced(house, ".5 1.5 2<", ".5 inf 2<"), "m.vtu:11: ", "not finite at node 5");
  check.expect_refusal(replaced(house, ".5 1.5 2<", ".5 1.5 3<"), "m.vtu:11: ", "node 5 lies at z = 3");
  check.expect_refusal(replaced(house, ">4 7<", ">4 8<"), "m.vtu:13: ", "holds 7 numbers, not 8");
  check.expect_refusal(replaced(house, ">4 7<", ">5 7<"), "m.vtu:13: ", "cell 1 has 5 nodes, not 4");
  check.expect_refusal(replaced(house, ">4 7<", ">9 7<"), "m.vtu:15: ", "offset of cell 1");
  check.expect_refusal(replaced(house, "\n3 2 4<", "\n3 2 5<"), "m.vtu:13: ", "cell 2 names point 5");
  check.expect_refusal(replaced(house, ">9 5<", ">9 22<"), "m.vtu:13: ", "cell 2 is of VTK type 22");
  check.expect_refusal(replaced(house, "NumberOfCells=\"2\"", "NumberOfCells=\"-2\""),
                       "m.vtu:4: ", "NumberOfCells");
  check.expect_refusal(replaced(house, "NumberOfPoints=\"5\"", "NumberOfPoints=\"99999999999\""),
                       "m.vtu:4: ", "2^31");
}

TEST(VtuReader, RefusesOtherFiles) {
  check.expect_refusal("no XML at all\n", "m.vtu:1: ", "no whole VTK XML file");
  check.expect_refusal("", "m.vtu:1: ", "no whole VTK XML file");
  check.expect_refusal("<a/>\n", "m.vtu:1: ", "no element VTKFile");
  check.expect_refusal(replaced(house, "type=\"UnstructuredGrid\"", "type=\"PolyData\""),
                       "m.vtu:2: ", "PolyData");
  check.expect_refusal(replaced(house, "</Piece>\n", "</Piece><Piece/>\n"), "m.vtu:18: ", "several pieces");
  check.expect_refusal(replaced(house, "\"types\"", "\"kinds\""), "m.vtu:4: ", "no array 'types'");
  check.expect_refusal(head + "</UnstructuredGrid></VTKFile>", "m.vtu:1: ", "no piece");
}

TEST(VtuReader, RefusesEarlyEnd) {
  check.expect_early_ends_refused(house);
  const std::string raw = appended(house, true), text = appended(house, false),
                    inlined = inline_base64(house);
  const std::size_t raw_data = raw.find("\n _") + 3, text_data = text.find("\n _") + 3;
  for (std::size_t cut = 1; cut < 40; ++cut) {
    check.expect_refusal(raw.substr(0, raw_data + 2 * cut), "m.vtu:", "");
    check.expect_refusal(text.substr(0, text_data + 3 * cut), "m.vtu:", "");
  }
  check.expect_refusal(replaced(inlined, "</DataArray>", "").substr(0, 500), "m.vtu:", "");
}

TEST(VtuFile, ComesBackWithBlocksBoundariesAndSolution) {
  const TemporaryFolder folder;
  LoadedMesh whole;
  whole.mesh = test::sample_mesh(3);
  whole.mesh.boundaries[0].name = "a <wall> & \"more\"";
  whole.blocks = 2;
  whole.block_names = {"gas", "solid"};
  whole.quad_to_block.assign(whole.mesh.quads.size(), 0);
  whole.triangle_to_block.assign(whole.mesh.triangles.size(), 1);
  whole.solution = test::sample_solution(whole.mesh);
  whole.solution->names = {"p<q", "pressure"};
  OutputSet outputs(test::world());
  write_mesh(outputs, whole, folder.file("m.vtu"));
  outputs.commit();
  const LoadedMesh loaded = test::read_plane<read_vtu>(folder.file("m.vtu"));
  EXPECT_EQ(loaded.mesh.points, whole.mesh.points);
  EXPECT_EQ(loaded.mesh.triangles, whole.mesh.triangles);
  EXPECT_EQ(loaded.mesh.quads, whole.mesh.quads);
  ASSERT_EQ(loaded.mesh.boundaries.size(), 2U);
  for (std::size_t b = 0; b < 2; ++b) {
    EXPECT_EQ(loaded.mesh.boundaries[b].name, whole.mesh.boundaries[b].name);
    EXPECT_EQ(loaded.mesh.boundaries[b].edges, whole.mesh.boundaries[b].edges);
  }
  EXPECT_EQ(loaded.block_names, whole.block_names);
  EXPECT_EQ(loaded.triangle_to_block, whole.triangle_to_block);
  EXPECT_EQ(loaded.solution->names, whole.solution->names);
  EXPECT_EQ(loaded.solution->values, whole.solution->values);
  EXPECT_TRUE(loaded.warnings.empty());
}

TEST(VtuWriter, ControlCharactersInNamesAreNoXml) {
  const TemporaryFolder folder;
  LoadedMesh whole;
  whole.mesh = test::sample_mesh(3);
  whole.mesh.boundaries[1].name = "inner\x01wall";
  whole.solution = test::sample_solution(whole.mesh);
  whole.solution->names = {"p\x02q", "pressure"};
  OutputSet outputs(test::world());
  write_mesh(outputs, whole, folder.file("m.vtu"));
  outputs.commit();
  const LoadedMesh loaded = test::read_plane<read_vtu>(folder.file("m.vtu"));
  EXPECT_EQ(loaded.mesh.boundaries[1].name, "inner\x01wall");  // a list of codes holds it
  EXPECT_EQ(loaded.solution->names, (std::vector<std::string>{"p_q", "pressure"}));
}

TEST(VtuWriter, NamesBoundariesForPeople) {
  const TemporaryFolder folder;
  Mesh mesh = test::sample_mesh(3);
  mesh.boundaries[0].name = "boundary_names";  // one of our own arrays
  mesh.boundaries[1].name = "a \"wet\" wall";
  test::write_alone(test::world(), mesh, folder.file("m.vtu"));
  const std::string bytes = test::bytes_of(folder.file("m.vtu"));
  EXPECT_NE(bytes.find("Name=\"a &quot;wet&quot; wall\" NumberOfTuples=\"2\" format=\"ascii\">\n2 1\n"),
            std::string::npos);
  const LoadedMesh loaded = test::read_plane<read_vtu>(folder.file("m.vtu"));
  EXPECT_EQ(loaded.mesh.boundaries[0].name, "boundary_names");
  EXPECT_EQ(loaded.mesh.boundaries[1].name, "a \"wet\" wall");
}

}  // namespace
}  // namespace quadloop::io
