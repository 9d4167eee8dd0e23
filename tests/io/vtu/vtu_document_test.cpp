// What a VTK XML file says of itself, and the numbers of its arrays however they are written. On one rank
// alone.
#include "io/vtu/vtu_document.hpp"

#include <gtest/gtest.h>

#include "io/vtu/vtu_arrays.hpp"
#include "tests/io/input/temporary_file.hpp"

namespace quadloop::io {
namespace {

struct Parsed {
  explicit Parsed(const std::string& text) : scan{folder.write("a.vtu", text), TextScanner::no_comments} {}
  VtuDocument document() const { return parse_vtu(scan); }
  std::string refusal() const {
    return test::refusal(folder, [&] { document(); });
  }
  test::InputFolder folder;
  TextScanner scan;
};

std::string file_with(const std::string& inner, const std::string& attributes = "") {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" " + attributes +
         ">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"3\" NumberOfCells=\"1\">\n" + inner +
         "</Piece></UnstructuredGrid></VTKFile>\n";
}

std::string array(const std::string& attributes, const std::string& data) {
  return "<PointData><DataArray Name=\"q\" " + attributes + ">" + data + "</DataArray></PointData>\n";
}

TEST(VtuDocument, KnowsItsArraysBySectionAndName) {
  const Parsed parsed(file_with(array("type=\"Float64\"", "1 2 3") +
                                "<CellData><DataArray Name=\"q\" type=\"Int8\" NumberOfComponents=\"3\" "
                                "format=\"appended\" offset=\"12\"/></CellData>"));
  const VtuDocument document = parsed.document();
  EXPECT_EQ(document.points, 3);
  EXPECT_EQ(document.cells, 1);
  ASSERT_EQ(document.arrays.size(), 2U);
  const VtuArray* at_points = document.find("PointData", "q");
  ASSERT_NE(at_points, nullptr);
  EXPECT_EQ(at_points->format, "ascii");
  EXPECT_EQ(at_points->components, 1);
  EXPECT_FALSE(at_points->offset.has_value());
  EXPECT_EQ(parsed.scan.text().substr(at_points->begin, at_points->end - at_points->begin), "1 2 3");
  const VtuArray* at_cells = document.find("CellData", "q");
  ASSERT_NE(at_cells, nullptr);
  EXPECT_EQ(at_cells->offset, 12);
  EXPECT_EQ(at_cells->components, 3);
  EXPECT_EQ(document.find("Points", "q"), nullptr);
}

TEST(VtuDocument, HeadersAreRead) {
  const VtuDocument document =
      Parsed(file_with(
                 "", "byte_order=\"BigEndian\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\""))
          .document();
  EXPECT_TRUE(document.big_endian && document.wide_header && document.compressed);
}

TEST(VtuDocument, RefusesWhatItIsNot) {
  const auto refused = [](const std::string& text, const std::string& says) {
    const std::string refusal = Parsed(text).refusal();
    EXPECT_NE(refusal.find(says), std::string::npos) << refusal;
  };
  refused("", "is no whole VTK XML file");
  refused("<a/>", "it has no element VTKFile");
  refused("<VTKFile type=\"PolyData\"/>", "a.vtu:1: holds VTK data of type 'PolyData'");
  refused("<VTKFile type=\"UnstructuredGrid\" compressor=\"vtkLZ4DataCompressor\"/>",
          "is compressed by vtkLZ4DataCompressor");
  refused("<VTKFile type=\"UnstructuredGrid\"></VTKFile>", "the grid has no piece");
  refused(file_with("</Piece><Piece>"), "a.vtu:5: the grid has several pieces");
  refused(file_with("<PointData>"), "is no whole VTK XML file");
  refused("<VTKFile type=\"UnstructuredGrid\"><Piece NumberOfPoints=\"-1\"/></VTKFile>",
          "NumberOfPoints is '-1', not a count");
}

TEST(VtuDocument, RawDataAreNoXml) {
  const Parsed parsed(
      "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"0\" "
      "NumberOfCells=\"0\"/></UnstructuredGrid>"
      "<AppendedData encoding=\"raw\">\n _<&\n</AppendedData></VTKFile>");
  const VtuDocument document = parsed.document();
  EXPECT_TRUE(document.appended_raw);
  EXPECT_EQ(
      parsed.scan.text().substr(document.appended_begin, document.appended_end - document.appended_begin),
      "<&\n");
}

struct Numbers {
  Numbers(const std::string& attributes, const std::string& data, const std::string& of_file = "")
      : parsed{file_with(array(attributes, data), of_file)}, document{parsed.document()} {}
  std::vector<double> reals(std::optional<std::int64_t> count = {}) const {
    return VtuNumbers(parsed.scan, document).reals(document.arrays.at(0), count);
  }
  std::vector<std::int64_t> integers() const {
    return VtuNumbers(parsed.scan, document).integers(document.arrays.at(0), {});
  }
  std::string refusal(std::optional<std::int64_t> count = {}) const {
    return test::refusal(parsed.folder, [&] { reals(count); });
  }
  Parsed parsed;
  VtuDocument document;
};

TEST(VtuNumbers, OfTexts) {
  EXPECT_EQ(Numbers("type=\"Float64\"", " 1 2.5\n-3e2 ").reals(3), (std::vector<double>{1, 2.5, -300}));
  EXPECT_EQ(Numbers("type=\"Int64\"", "9007199254740993").integers(),
            (std::vector<std::int64_t>{9007199254740993}))
      << "beyond what a double tells apart";
  EXPECT_TRUE(Numbers("type=\"Float64\"", "").reals(0).empty());
}

/// The bytes 4 0 0 0 (how many follow), then 1 0 255 127.
TEST(VtuNumbers, OfBase64InEachTypeAndByteOrder) {
  const std::string data = "BAAAAAEA/38=";
  EXPECT_EQ(Numbers("type=\"UInt8\" format=\"binary\"", data).integers(),
            (std::vector<std::int64_t>{1, 0, 255, 127}));
  EXPECT_EQ(Numbers("type=\"Int8\" format=\"binary\"", data).integers(),
            (std::vector<std::int64_t>{1, 0, -1, 127}));
  EXPECT_EQ(Numbers("type=\"Int16\" format=\"binary\"", data).integers(),
            (std::vector<std::int64_t>{1, 32767}));
  EXPECT_EQ(Numbers("type=\"UInt32\" format=\"binary\"", data).integers(),
            (std::vector<std::int64_t>{0x7fff0001}));
  EXPECT_EQ(
      Numbers("type=\"Int16\" format=\"binary\"", "AAAABAABf/8=", "byte_order=\"BigEndian\"").integers(),
      (std::vector<std::int64_t>{1, 32767}));
  EXPECT_EQ(
      Numbers("type=\"UInt8\" format=\"binary\"", "AgAAAAAAAAABAg==", "header_type=\"UInt64\"").integers(),
      (std::vector<std::int64_t>{1, 2}));
  EXPECT_EQ(Numbers("type=\"UInt8\" format=\"binary\"", "AgAAAA==AQI=").integers(),
            (std::vector<std::int64_t>{1, 2}))
      << "padding after the header, then another stream";
}

TEST(VtuNumbers, EndAsTextsByZeros) {
  const Numbers numbers("type=\"String\" format=\"ascii\"", "97 98 0 0 99 0");
  EXPECT_EQ(VtuNumbers(numbers.parsed.scan, numbers.document).texts(numbers.document.arrays[0]),
            (std::vector<std::string>{"ab", "", "c"}));
}

TEST(VtuNumbers, RefuseWhatIsNotThere) {
  const auto refused = [](const Numbers& numbers, const std::string& says,
                          std::optional<std::int64_t> count = {}) {
    const std::string refusal = numbers.refusal(count);
    EXPECT_NE(refusal.find(says), std::string::npos) << refusal;
  };
  refused({"type=\"Float64\"", "1 2"}, "a.vtu:5: the array 'q' of PointData holds 2 numbers, not 3", 3);
  refused({"type=\"Float64\"", "1\n2 x"}, "a.vtu:6: expected a number of the array 'q', found \"x\"");
  refused({"type=\"Bit\"", "1"}, "has the type 'Bit', which is no number's");
  refused({"type=\"Float64\" format=\"zip\"", "1"}, "has the format 'zip'");
  refused({"type=\"UInt8\" format=\"binary\"", "BAAAAAEA"}, "is cut short");
  refused({"type=\"UInt8\" format=\"binary\"", "BAAA*AEA/38="}, "is cut short");
  refused({"type=\"UInt8\" format=\"binary\"", "BAAAAAEA/38="}, "holds 4 bytes, not 5", 5);
  refused({"type=\"UInt8\" format=\"appended\" offset=\"9\"", ""}, "stands beyond the end of the file");
}

}  // namespace
}  // namespace quadloop::io
