// Drawings in DXF as text, and a test that reads them.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/dxf/dxf_reader.hpp"
#include "tests/io/input/temporary_file.hpp"

namespace quadloop::test {

using namespace quadloop::io;

/// Pairs of a group code and a value, one after another.
inline std::string groups() { return {}; }
template <class Value, class... More>
std::string groups(int code, const Value& value, const More&... more) {
  return fmt::format("{:3}\n{}\n", code, value) + groups(more...);
}

inline std::string section(const std::string& name, const std::string& content) {
  return groups(0, "SECTION", 2, name) + content + groups(0, "ENDSEC");
}

/// A file that has nothing but entities.
inline std::string dxf_of(const std::string& entities) {
  return section("ENTITIES", entities) + groups(0, "EOF");
}

inline std::string dxf_line(const std::string& layer, double x0, double y0, double x1, double y1) {
  return groups(0, "LINE", 8, layer, 10, x0, 20, y0, 30, 0, 11, x1, 21, y1, 31, 0);
}

inline std::string dxf_arc(const std::string& layer, double x, double y, double radius, double from,
                           double to) {
  return groups(0, "ARC", 8, layer, 10, x, 20, y, 40, radius, 50, from, 51, to);
}

inline std::string entity(const std::string& type, const std::string& handle, const std::string& more) {
  return groups(0, type, 5, handle) + more;
}

inline std::string dxf_circle(const std::string& handle, const std::string& layer, double radius,
                              const std::string& more = "") {
  return entity("CIRCLE", handle, groups(8, layer) + more + groups(10, 0, 20, 0, 40, radius));
}

/// A square of lines without handles, as R12 has them.
inline std::string dxf_square(const std::string& layer, double x, double side) {
  return dxf_line(layer, x, x, x + side, x) + dxf_line(layer, x + side, x, x + side, x + side) +
         dxf_line(layer, x + side, x + side, x, x + side) + dxf_line(layer, x, x + side, x, x);
}

inline std::string layer_entry(const std::string& name, int flags, int colour) {
  return groups(0, "LAYER", 2, name, 70, flags, 62, colour, 6, "CONTINUOUS");
}

inline std::string table_of_layers(const std::string& entries) {
  return section("TABLES", groups(0, "TABLE", 2, "LAYER", 70, 3) + entries + groups(0, "ENDTAB"));
}

inline std::string block_of(const std::string& name, const std::string& content, double x = 0, double y = 0) {
  return groups(0, "BLOCK", 8, 0, 2, name, 70, 0, 10, x, 20, y, 3, name) + content +
         groups(0, "ENDBLK", 8, 0);
}

inline std::string insert_of(const std::string& block, const std::string& layer, const std::string& more) {
  return groups(0, "INSERT", 8, layer, 2, block) + more;
}

class DxfTest : public ::testing::Test {
 protected:
  std::vector<Chain> read(const std::string& name, const std::string& text) {
    return io::read_dxf(folder_.write(name, text), choice_, warnings_, unit_);
  }
  std::vector<Chain> read(const std::string& text) { return read("a.dxf", text); }
  std::string refused(const std::string& text) {
    return refusal(folder_, [&] { read(text); });
  }

  InputFolder folder_;
  DrawingChoice choice_;
  std::vector<std::string> warnings_;
  FileUnit unit_;
};

}  // namespace quadloop::test
