#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

namespace quadloop::test {

/// Writes STEP files: each function adds an entity and returns its reference "#n".
class StepText {
 public:
  std::string add(const std::string& record) {
    data_ += fmt::format("#{}={};\n", ++number_, record);
    return fmt::format("#{}", number_);
  }
  std::string point(double x, double y, double z = 0) {
    return add(fmt::format("CARTESIAN_POINT('',({},{},{}))", real(x), real(y), real(z)));
  }
  std::string vertex(double x, double y, double z = 0) {
    return add("VERTEX_POINT(''," + point(x, y, z) + ")");
  }
  std::string direction(double x, double y, double z = 0) {
    return add(fmt::format("DIRECTION('',({},{},{}))", real(x), real(y), real(z)));
  }
  std::string placement(const std::string& origin, const std::string& axis, const std::string& towards) {
    return add(fmt::format("AXIS2_PLACEMENT_3D('',{},{},{})", origin, axis, towards));
  }
  /// A placement with the axis z.
  std::string placement(double x, double y, double z = 0) {
    return placement(point(x, y, z), direction(0, 0, 1), direction(1, 0));
  }
  std::string line(const std::string& from, double dx, double dy, double dz = 0, double magnitude = 1) {
    const std::string vector = add(fmt::format("VECTOR('',{},{})", direction(dx, dy, dz), real(magnitude)));
    return add(fmt::format("LINE('',{},{})", from, vector));
  }
  std::string edge(const std::string& from, const std::string& to, const std::string& curve, bool same = true,
                   const std::string& name = "") {
    return add(fmt::format("EDGE_CURVE('{}',{},{},{},{})", name, from, to, curve, same ? ".T." : ".F."));
  }
  std::string loop(const std::vector<std::string>& edges, const std::string& orientations = "") {
    std::vector<std::string> oriented;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const bool same = i >= orientations.size() || orientations[i] == '+';
      oriented.push_back(add(fmt::format("ORIENTED_EDGE('',*,*,{},{})", edges[i], same ? ".T." : ".F.")));
    }
    return add("EDGE_LOOP(''," + list(oriented) + ")");
  }
  std::string set(const std::vector<std::string>& items) {
    return add("GEOMETRIC_CURVE_SET(''," + list(items) + ")");
  }
  static std::string list(const std::vector<std::string>& items) {
    std::string text = "(";
    for (const std::string& item : items) text += (text.size() > 1 ? "," : "") + item;
    return text + ")";
  }

  std::string length_unit = "SI_UNIT(.MILLI.,.METRE.)";
  std::string angle_unit = "SI_UNIT($,.RADIAN.)";

  /// A representation of these items, with its context.
  std::string shape(const std::vector<std::string>& items) {
    const std::string length = add("(LENGTH_UNIT() NAMED_UNIT(*) " + length_unit + ")");
    const std::string angle = add("(NAMED_UNIT(*) PLANE_ANGLE_UNIT() " + angle_unit + ")");
    const std::string uncertainty =
        add("UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.)," + length + ",'distance_accuracy_value','')");
    const std::string context =
        add(fmt::format("(GEOMETRIC_REPRESENTATION_CONTEXT(3) GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT(({})) "
                        "GLOBAL_UNIT_ASSIGNED_CONTEXT(({},{})) REPRESENTATION_CONTEXT('',''))",
                        uncertainty, length, angle));
    return add(fmt::format("SHAPE_REPRESENTATION('',{},{})", list(items), context));
  }
  /// The file with all that was added.
  std::string text() const {
    return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\n"
           "FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));\nENDSEC;\nDATA;\n" +
           data_ + "ENDSEC;\nEND-ISO-10303-21;\n";
  }
  /// The file with a representation of these items.
  std::string file(const std::vector<std::string>& items) {
    shape(items);
    return text();
  }

 private:
  static std::string real(double value) { return fmt::format("{:.17g}", value); }

  int number_ = 0;
  std::string data_;
};

}  // namespace quadloop::test
