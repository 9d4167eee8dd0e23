// The same plate, a slot with a round hole, drawn in the ways of CAD programs.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "mesher/geometry/assemble/assemble.hpp"
#include "tests/io/dxf/chain_points.hpp"
#include "tests/io/dxf/dxf_entities.hpp"

namespace quadloop::io {
namespace {

using namespace test;

/// A drawing from rows "code value".
std::string rows(const std::string& text) {
  std::istringstream in(text);
  std::string pairs;
  for (std::string row; std::getline(in, row);) {
    if (row.empty()) continue;
    const std::size_t blank = std::min(row.find(' '), row.size());
    pairs += row.substr(0, blank) + "\n" + (blank < row.size() ? row.substr(blank + 1) : "") + "\n";
  }
  return pairs;
}

struct Drawing {
  const char* program;
  std::string text;
  const char* boundaries;     ///< their names
  const char* left_out = "";  ///< of the warning
  double precision = 1e-12;
};

void PrintTo(const Drawing& drawing, std::ostream* out) { *out << drawing.program; }

/// R12 has neither handles nor classes; polylines are entities of their own for each vertex.
Drawing autocad_r12() {
  return {"AutoCAD_R12", rows(R"(0 SECTION
2 HEADER
9 $ACADVER
1 AC1009
9 $EXTMIN
10 -3.0
20 -1.0
0 ENDSEC
0 SECTION
2 TABLES
0 TABLE
2 LTYPE
70 1
0 LTYPE
2 CONTINUOUS
70 64
3 Solid line
72 65
73 0
40 0.0
0 ENDTAB
0 TABLE
2 LAYER
70 2
0 LAYER
2 0
70 64
62 7
6 CONTINUOUS
0 LAYER
2 PLATE
70 64
62 1
6 CONTINUOUS
0 ENDTAB
0 ENDSEC
0 SECTION
2 ENTITIES
0 POLYLINE
8 PLATE
66 1
10 0.0
20 0.0
30 0.0
70 1
0 VERTEX
8 PLATE
10 -2.0
20 -1.0
30 0.0
0 VERTEX
8 PLATE
10 2.0
20 -1.0
30 0.0
42 1.0
0 VERTEX
8 PLATE
10 2.0
20 1.0
30 0.0
0 VERTEX
8 PLATE
10 -2.0
20 1.0
30 0.0
42 1.0
0 SEQEND
8 PLATE
0 CIRCLE
8 HOLE
10 0.0
20 0.0
30 0.0
40 0.5
0 ENDSEC
0 EOF
)"),
          "PLATE HOLE"};
}

/// R2000: handles, classes of entities, blocks for model and paper space, a dimension with its block, a
/// hatch, the sheet.
Drawing autocad_2000() {
  return {"AutoCAD_2000", rows(R"(0 SECTION
2 HEADER
9 $ACADVER
1 AC1015
9 $DWGCODEPAGE
3 ANSI_1252
9 $INSUNITS
70 4
0 ENDSEC
0 SECTION
2 CLASSES
0 CLASS
1 ACDBDICTIONARYWDFLT
2 AcDbDictionaryWithDefault
3 ObjectDBX Classes
90 0
280 0
281 0
0 ENDSEC
0 SECTION
2 TABLES
0 TABLE
2 LAYER
5 2
330 0
100 AcDbSymbolTable
70 2
0 LAYER
5 10
330 2
100 AcDbSymbolTableRecord
100 AcDbLayerTableRecord
2 Outline
70 0
62 7
6 Continuous
390 F
0 ENDTAB
0 TABLE
2 BLOCK_RECORD
5 1
70 2
0 BLOCK_RECORD
5 1F
330 1
100 AcDbSymbolTableRecord
100 AcDbBlockTableRecord
2 *Model_Space
340 22
0 ENDTAB
0 ENDSEC
0 SECTION
2 BLOCKS
0 BLOCK
5 20
330 1F
100 AcDbEntity
8 0
100 AcDbBlockBegin
2 *Model_Space
70 0
10 0.0
20 0.0
30 0.0
3 *Model_Space
1
0 ENDBLK
5 21
330 1F
100 AcDbEntity
8 0
100 AcDbBlockEnd
0 BLOCK
5 5A
330 59
100 AcDbEntity
67 1
8 0
100 AcDbBlockBegin
2 *Paper_Space
70 0
10 0.0
20 0.0
30 0.0
3 *Paper_Space
1
0 ENDBLK
5 5D
330 59
100 AcDbEntity
67 1
8 0
100 AcDbBlockEnd
0 BLOCK
5 70
330 6F
100 AcDbEntity
8 0
100 AcDbBlockBegin
2 *D3
70 1
10 0.0
20 0.0
30 0.0
3 *D3
1
0 LINE
5 71
330 6F
100 AcDbEntity
8 0
62 0
100 AcDbLine
10 -2.0
20 -1.1
30 0.0
11 -2.0
21 -2.2
31 0.0
0 ENDBLK
5 72
330 6F
100 AcDbEntity
8 0
100 AcDbBlockEnd
0 ENDSEC
0 SECTION
2 ENTITIES
0 LWPOLYLINE
5 2E
330 1F
100 AcDbEntity
8 Outline
100 AcDbPolyline
90 4
70 1
43 0.0
10 -2.0
20 -1.0
10 2.0
20 -1.0
42 1.0
10 2.0
20 1.0
10 -2.0
20 1.0
42 1.0
0 CIRCLE
5 2F
330 1F
100 AcDbEntity
8 Outline
100 AcDbCircle
10 0.0
20 0.0
30 0.0
40 0.5
0 DIMENSION
5 73
330 1F
100 AcDbEntity
8 Outline
100 AcDbDimension
2 *D3
10 2.0
20 -2.0
30 0.0
70 32
100 AcDbAlignedDimension
13 -2.0
23 -1.0
14 2.0
24 -1.0
100 AcDbRotatedDimension
0 HATCH
5 74
330 1F
100 AcDbEntity
8 Outline
100 AcDbHatch
10 0.0
20 0.0
30 0.0
210 0.0
220 0.0
230 1.0
2 ANSI31
70 0
71 1
91 1
92 7
72 0
73 1
93 3
10 0.0
20 0.0
10 1.0
20 0.0
10 1.0
20 1.0
97 0
75 0
76 1
98 0
0 LINE
5 75
330 59
100 AcDbEntity
67 1
8 Outline
100 AcDbLine
10 0.0
20 0.0
11 297.0
21 0.0
0 VIEWPORT
5 76
330 59
100 AcDbEntity
67 1
8 0
100 AcDbViewport
10 148.0
20 105.0
40 297.0
41 210.0
68 1
69 1
0 ENDSEC
0 SECTION
2 OBJECTS
0 DICTIONARY
5 C
330 0
100 AcDbDictionary
281 1
3 ACAD_GROUP
350 D
0 ENDSEC
0 EOF
)"),
          "Outline",
          "1 DIMENSION on layer 'Outline', 1 HATCH on layer 'Outline', 1 LINE in paper space, 1 VIEWPORT in "
          "paper space"};
}

/// R2018: true colours, groups of reactors and dictionaries, a text with an embedded object, a leader,
/// thumbnail and data sections.
Drawing autocad_2018() {
  return {"AutoCAD_2018", rows(R"(0 SECTION
2 HEADER
9 $ACADVER
1 AC1032
9 $ACADMAINTVER
90 4
9 $INSUNITS
70 6
0 ENDSEC
0 SECTION
2 TABLES
0 TABLE
2 LAYER
5 2
102 {ACAD_XDICTIONARY
360 9F
102 }
330 0
100 AcDbSymbolTable
70 1
0 LAYER
5 10
330 2
100 AcDbSymbolTableRecord
100 AcDbLayerTableRecord
2 Körper
70 0
62 30
420 16744448
6 Continuous
370 -3
390 F
347 8A
348 0
0 ENDTAB
0 ENDSEC
0 SECTION
2 BLOCKS
0 ENDSEC
0 SECTION
2 ENTITIES
0 LINE
5 1C3F2A
102 {ACAD_REACTORS
330 1C3F00
102 }
330 1F
100 AcDbEntity
8 Körper
62 256
370 25
440 33554661
100 AcDbLine
10 -2.0
20 -1.0
30 0.0
11 2.0
21 -1.0
31 0.0
0 ARC
5 1C3F2B
330 1F
100 AcDbEntity
8 Körper
100 AcDbCircle
10 2.0
20 0.0
30 0.0
40 1.0
100 AcDbArc
50 270.0
51 90.0
0 LINE
5 1C3F2C
330 1F
100 AcDbEntity
8 Körper
100 AcDbLine
10 -2.0
20 1.0
30 0.0
11 2.0
21 1.0
31 0.0
0 ARC
5 1C3F2D
330 1F
100 AcDbEntity
8 Körper
100 AcDbCircle
10 -2.0
20 0.0
30 0.0
40 1.0
100 AcDbArc
50 90.0
51 270.0
0 SPLINE
5 1C3F2E
330 1F
100 AcDbEntity
8 Körper
100 AcDbSpline
70 12
71 2
72 12
73 9
74 0
42 0.000000001
43 0.0000000001
40 0.0
40 0.0
40 0.0
40 1.570796326794897
40 1.570796326794897
40 3.141592653589793
40 3.141592653589793
40 4.71238898038469
40 4.71238898038469
40 6.283185307179586
40 6.283185307179586
40 6.283185307179586
41 1.0
41 0.7071067811865476
41 1.0
41 0.7071067811865476
41 1.0
41 0.7071067811865476
41 1.0
41 0.7071067811865476
41 1.0
10 0.5
20 0.0
30 0.0
10 0.5
20 0.5
30 0.0
10 0.0
20 0.5
30 0.0
10 -0.5
20 0.5
30 0.0
10 -0.5
20 0.0
30 0.0
10 -0.5
20 -0.5
30 0.0
10 0.0
20 -0.5
30 0.0
10 0.5
20 -0.5
30 0.0
10 0.5
20 0.0
30 0.0
0 MTEXT
5 1C3F2F
330 1F
100 AcDbEntity
8 Körper
100 AcDbMText
10 5.0
20 5.0
40 0.2
1 {\fArial;plate}
101 Embedded Object
70 1
10 1.0
20 0.0
11 5.0
21 5.0
0 MULTILEADER
5 1C3F30
330 1F
100 AcDbEntity
8 Körper
100 AcDbMLeader
270 2
300 CONTEXT_DATA{
40 1.0
10 1.0
20 1.0
301 }
0 ENDSEC
0 SECTION
2 OBJECTS
0 DICTIONARY
5 C
330 0
100 AcDbDictionary
0 ENDSEC
0 SECTION
2 ACDSDATA
70 2
71 2
0 ENDSEC
0 EOF
)"),
          "Körper", "1 MTEXT on layer 'Körper', 1 MULTILEADER on layer 'Körper'"};
}

/// QCAD's library leaves a comment; what is drawn on a construction layer is off.
Drawing qcad() {
  return {"QCAD", rows(R"(999 dxflib 3.17.0.0
0 SECTION
2 HEADER
9 $ACADVER
1 AC1015
9 $HANDSEED
5 FFFF
9 $INSUNITS
70 4
0 ENDSEC
0 SECTION
2 TABLES
0 TABLE
2 LAYER
5 2
100 AcDbSymbolTable
70 3
0 LAYER
5 10
100 AcDbSymbolTableRecord
100 AcDbLayerTableRecord
2 0
70 0
62 7
420 0
6 CONTINUOUS
370 25
390 F
0 LAYER
5 30
100 AcDbSymbolTableRecord
100 AcDbLayerTableRecord
2 construction
70 0
62 -3
420 65280
6 DASHED
370 0
390 F
0 ENDTAB
0 ENDSEC
0 SECTION
2 ENTITIES
0 LINE
5 31
100 AcDbEntity
100 AcDbLine
8 0
62 256
370 -1
6 ByLayer
10 -2.0
20 -1.0
30 0.0
11 2.0
21 -1.0
31 0.0
0 ARC
5 32
100 AcDbEntity
100 AcDbCircle
8 0
62 256
370 -1
6 ByLayer
10 2.0
20 0.0
30 0.0
40 1.0
100 AcDbArc
50 270.0
51 450.0
0 POLYLINE
5 33
100 AcDbEntity
100 AcDb2dPolyline
8 0
62 256
66 1
70 0
0 VERTEX
5 34
100 AcDbEntity
100 AcDbVertex
100 AcDb2dVertex
8 0
10 2.0
20 1.0
30 0.0
42 0.0
0 VERTEX
5 35
8 0
10 -2.0
20 1.0
30 0.0
42 1.0
0 VERTEX
5 36
8 0
10 -2.0
20 -1.0
30 0.0
42 0.0
0 SEQEND
5 37
8 0
0 CIRCLE
5 38
100 AcDbEntity
100 AcDbCircle
8 0
62 256
10 0.0
20 0.0
30 0.0
40 0.5
0 LINE
5 39
100 AcDbEntity
100 AcDbLine
8 construction
10 -4.0
20 0.0
11 4.0
21 0.0
0 ENDSEC
0 EOF
)"),
          "0", "1 LINE not visible on layer 'construction'"};
}

/// LibreCAD writes a whole circle as an ellipse where it was scaled, and names the program in a comment.
Drawing librecad() {
  return {"LibreCAD", rows(R"(999 dxfrw 0.6.3
0 SECTION
2 HEADER
9 $ACADVER
1 AC1021
9 $PINSBASE
10 0
20 0
30 0
0 ENDSEC
0 SECTION
2 TABLES
0 TABLE
2 LAYER
5 2
330 0
100 AcDbSymbolTable
70 1
0 LAYER
5 10
330 2
100 AcDbSymbolTableRecord
100 AcDbLayerTableRecord
2 body
70 0
62 7
6 CONTINUOUS
370 0
390 F
0 ENDTAB
0 ENDSEC
0 SECTION
2 BLOCKS
0 ENDSEC
0 SECTION
2 ENTITIES
0 LWPOLYLINE
5 31
100 AcDbEntity
8 body
6 ByLayer
62 256
370 -1
100 AcDbPolyline
90 5
70 0
43 0
10 -2
20 -1
10 2
20 -1
42 1
10 2
20 1
10 -2
20 1
42 1
10 -2
20 -1
0 ELLIPSE
5 32
100 AcDbEntity
8 body
6 ByLayer
62 256
370 -1
100 AcDbEllipse
10 0
20 0
11 0.5
21 0
40 1
41 0
42 6.28318530717959
0 ENDSEC
0 SECTION
2 OBJECTS
0 ENDSEC
0 EOF
)"),
          "body"};
}

/// FreeCAD turns bodies into single edges; those of arcs run either way, by the extrusion.
Drawing freecad() {
  return {"FreeCAD", rows(R"(999 FreeCAD v0.20.2
0 SECTION
2 HEADER
9 $ACADVER
1 AC1014
0 ENDSEC
0 SECTION
2 ENTITIES
0 LINE
5 100
100 AcDbEntity
8 Slot001
100 AcDbLine
10 -2.0000000000000000
20 -1.0000000000000000
30 0.0
11 2.0000000000000000
21 -1.0000000000000000
31 0.0
0 ARC
5 101
100 AcDbEntity
8 Slot001
100 AcDbCircle
10 -2
20 0
30 -0.0
40 1
210 0
220 0
230 -1
100 AcDbArc
50 90
51 270
0 LINE
5 102
100 AcDbEntity
8 Slot001
100 AcDbLine
10 2
20 1
30 0
11 -2
21 1
31 0
0 ARC
5 103
100 AcDbEntity
8 Slot001
100 AcDbCircle
10 -2
20 0
30 0
40 1
100 AcDbArc
50 90
51 270
0 CIRCLE
5 104
100 AcDbEntity
8 Slot001_Hole
100 AcDbCircle
10 0
20 0
30 0
40 0.5
0 ENDSEC
0 EOF
)"),
          "Slot001 Slot001_Hole"};
}

/// OpenSCAD has nothing but short lines, in sections without header and tables.
Drawing openscad() {
  std::string entities;
  const auto add = [&](Point a, Point b) {
    entities += fmt::format("0 LINE\n8 0\n10 {:g}\n20 {:g}\n11 {:g}\n21 {:g}\n", a.x, a.y, b.x, b.y);
  };
  const auto slot = [](int i) {
    const double angle = (i % 60 - 30 + (i >= 60 ? 60 : 0)) * std::numbers::pi / 60;
    return Point{(i % 120 < 60 ? 2 : -2) + std::cos(angle), std::sin(angle)};
  };
  const auto hole = [](int i) {
    const double angle = (i % 60) * std::numbers::pi / 30;
    return Point{0.5 * std::cos(angle), 0.5 * std::sin(angle)};
  };
  std::vector<Point> outline;
  for (int i = 0; i < 60; ++i) outline.push_back(slot(i));
  outline.push_back({2, 1});
  for (int i = 60; i < 120; ++i) outline.push_back(slot(i));
  outline.push_back({-2, -1});
  for (std::size_t i = 0; i < outline.size(); ++i) add(outline[i], outline[(i + 1) % outline.size()]);
  for (int i = 0; i < 60; ++i) add(hole(i), hole(i + 1));
  return {"OpenSCAD",
          rows("0 SECTION\n2 BLOCKS\n0 ENDSEC\n0 SECTION\n2 ENTITIES\n" + entities +
               "0 ENDSEC\n0 SECTION\n2 OBJECTS\n0 DICTIONARY\n0 ENDSEC\n0 EOF\n"),
          "0", "", 2e-3};
}

/// CadQuery writes edges through ezdxf: floats with a point, no layers of its own.
Drawing cadquery() {
  return {"CadQuery", rows(R"(0 SECTION
2 HEADER
9 $ACADVER
1 AC1027
9 $INSUNITS
70 4
0 ENDSEC
0 SECTION
2 CLASSES
0 ENDSEC
0 SECTION
2 TABLES
0 TABLE
2 LAYER
5 1
330 0
100 AcDbSymbolTable
70 1
0 LAYER
5 2F
330 1
100 AcDbSymbolTableRecord
100 AcDbLayerTableRecord
2 0
70 0
62 7
6 Continuous
0 ENDTAB
0 ENDSEC
0 SECTION
2 BLOCKS
0 ENDSEC
0 SECTION
2 ENTITIES
0 LINE
5 30
330 17
100 AcDbEntity
8 0
100 AcDbLine
10 2.0
20 1.0
30 0.0
11 -2.0
21 1.0
31 0.0
0 ARC
5 31
330 17
100 AcDbEntity
8 0
100 AcDbCircle
10 2.0
20 0.0
30 0.0
40 1.0
100 AcDbArc
50 -90.0
51 90.00000000000001
0 LINE
5 32
330 17
100 AcDbEntity
8 0
100 AcDbLine
10 -2.0
20 -1.0
30 0.0
11 2.0
21 -1.0
31 0.0
0 ELLIPSE
5 33
330 17
100 AcDbEntity
8 0
100 AcDbEllipse
10 -2.0
20 0.0
30 0.0
11 -1.0
21 0.0
31 0.0
40 1.0
41 -1.5707963267948966
42 1.5707963267948966
0 CIRCLE
5 34
330 17
100 AcDbEntity
8 0
100 AcDbCircle
10 0.0
20 0.0
30 0.0
40 0.5
0 ENDSEC
0 SECTION
2 OBJECTS
0 DICTIONARY
5 A
330 0
100 AcDbDictionary
0 ENDSEC
0 EOF
)"),
          "0"};
}

/// Inkscape writes a cubic spline for each part of a path, with six decimals.
Drawing inkscape() {
  std::string entities;
  int handle = 0x100;
  const auto curve = [&](const std::string& layer, std::array<Point, 4> poles) {
    entities += fmt::format(
        "0 SPLINE\n5 {:x}\n100 AcDbEntity\n8 {}\n62 7\n100 AcDbSpline\n70 8\n71 3\n72 8\n73 4\n74 0\n",
        handle++, layer);
    for (const int knot : {0, 0, 0, 0, 1, 1, 1, 1}) entities += fmt::format("40 {}\n", knot);
    for (const Point p : poles) entities += fmt::format("10 {:f}\n20 {:f}\n30 0.0\n", p.x, p.y);
  };
  const auto quarter = [&](const std::string& layer, Point centre, Point x, Point y) {
    constexpr double arm = 0.5522847498;
    curve(layer, {centre + x, centre + x + arm * y, centre + y + arm * x, centre + y});
  };
  for (const double side : {-1., 1.}) {
    entities += fmt::format(
        "0 LINE\n5 {:x}\n100 AcDbEntity\n8 Layer 1\n62 7\n100 AcDbLine\n10 {:f}\n20 {:f}\n30 0.0\n11 "
        "{:f}\n21 {:f}\n31 0.0\n",
        handle++, -2 * side, side, 2 * side, side);
    for (const double up : {-1., 1.}) quarter("Layer 1", {2 * side, 0}, {side, 0}, {0, up});
  }
  for (const double x : {-.5, .5}) {
    for (const double y : {-.5, .5}) quarter("Layer 2", {0, 0}, {x, 0}, {0, y});
  }
  return {
      "Inkscape",
      rows("0 SECTION\n2 HEADER\n9 $ACADVER\n1 AC1014\n9 $HANDSEED\n5 FFFF\n0 ENDSEC\n0 SECTION\n2 TABLES\n0 "
           "TABLE\n2 VPORT\n5 8\n330 0\n100 AcDbSymbolTable\n70 4\n0 ENDTAB\n0 ENDSEC\n0 SECTION\n2 "
           "ENTITIES\n" +
           entities +
           "0 ENDSEC\n0 SECTION\n2 OBJECTS\n0 DICTIONARY\n5 C\n330 0\n100 AcDbDictionary\n0 ENDSEC\n0 EOF\n"),
      "Layer_1 Layer_2", "", 3e-4};
}

/// Rhino keeps parts in blocks within blocks, one of them mirrored.
Drawing rhino() {
  return {"Rhino", rows(R"(0 SECTION
2 HEADER
9 $ACADVER
1 AC1024
9 $INSUNITS
70 5
0 ENDSEC
0 SECTION
2 TABLES
0 TABLE
2 LAYER
70 2
0 LAYER
2 Default
70 0
62 7
6 Continuous
0 LAYER
2 Layer 01
70 0
62 1
6 Continuous
0 ENDTAB
0 ENDSEC
0 SECTION
2 BLOCKS
0 BLOCK
8 0
2 end
70 0
10 2.0
20 0.0
30 0.0
3 end
0 SPLINE
5 40
8 Default
100 AcDbSpline
70 4
71 2
72 8
73 5
40 0
40 0
40 0
40 1
40 1
40 2
40 2
40 2
10 2.0
20 -1.0
30 0.0
41 1.0
10 3.0
20 -1.0
30 0.0
41 0.70710678118654757
10 3.0
20 0.0
30 0.0
41 1.0
10 3.0
20 1.0
30 0.0
41 0.70710678118654757
10 2.0
20 1.0
30 0.0
41 1.0
0 LINE
5 41
8 Default
100 AcDbLine
10 2.0
20 1.0
30 0.0
11 0.0
21 1.0
31 0.0
0 LINE
5 42
8 Default
100 AcDbLine
10 2.0
20 -1.0
30 0.0
11 0.0
21 -1.0
31 0.0
0 ENDBLK
8 0
0 BLOCK
8 0
2 plate
70 0
10 0.0
20 0.0
30 0.0
3 plate
0 INSERT
5 50
8 0
2 end
10 2.0
20 0.0
30 0.0
0 INSERT
5 51
8 0
2 end
10 -2.0
20 0.0
30 0.0
41 -1.0
0 CIRCLE
5 52
8 0
10 0.0
20 0.0
30 0.0
40 0.5
0 ENDBLK
8 0
0 ENDSEC
0 SECTION
2 ENTITIES
0 INSERT
5 60
8 Layer 01
2 plate
10 0.0
20 0.0
30 0.0
0 POINT
5 61
8 Default
10 9.0
20 9.0
30 0.0
0 ENDSEC
0 EOF
)"),
          "Default Layer_01", "1 POINT on layer 'Default'"};
}

/// ezdxf: an array of references, each turned half around by the rotation of the array.
Drawing ezdxf() {
  return {"ezdxf", rows(R"(0 SECTION
2 HEADER
9 $ACADVER
1 AC1024
9 $INSUNITS
70 6
0 ENDSEC
0 SECTION
2 BLOCKS
0 BLOCK
5 30
330 2F
100 AcDbEntity
8 0
100 AcDbBlockBegin
2 HALF
70 0
10 0.0
20 0.0
30 0.0
3 HALF
1
0 LWPOLYLINE
5 32
330 2F
100 AcDbEntity
8 PLATE
100 AcDbPolyline
90 4
70 0
10 0.0
20 -1.0
40 0.0
41 0.0
42 0.0
10 2.0
20 -1.0
40 0.0
41 0.0
42 1.0
10 2.0
20 1.0
40 0.0
41 0.0
42 0.0
10 0.0
20 1.0
40 0.0
41 0.0
42 0.0
0 ARC
5 33
330 2F
100 AcDbEntity
8 0
100 AcDbCircle
10 0.0
20 0.0
30 0.0
40 0.5
100 AcDbArc
50 -90.0
51 90.0
0 ENDBLK
5 31
330 2F
100 AcDbEntity
8 0
100 AcDbBlockEnd
0 ENDSEC
0 SECTION
2 ENTITIES
0 INSERT
5 34
330 17
100 AcDbEntity
8 HOLE
100 AcDbBlockReference
2 HALF
10 0.0
20 0.0
30 0.0
66 1
0 ATTRIB
5 35
330 34
100 AcDbEntity
8 0
100 AcDbText
10 0.0
20 0.0
40 1.0
1 name
0 SEQEND
5 36
330 34
8 0
0 INSERT
5 37
330 17
100 AcDbEntity
8 HOLE
100 AcDbBlockReference
2 half
10 0.0
20 0.0
30 0.0
50 180.0
0 ENDSEC
0 EOF
)"),
          "PLATE HOLE"};
}

/// SolidWorks draws what is seen: edges twice, centre lines across, arcs from below.
Drawing solidworks() {
  const std::string line = "0 LINE\n5 {}\n100 AcDbEntity\n8 {}\n100 AcDbLine\n10 {}\n20 {}\n11 {}\n21 {}\n";
  const auto drawn = [&](const char* handle, const char* layer, double x, double y, double to_x,
                         double to_y) {
    return fmt::format(fmt::runtime(line), handle, layer, x, y, to_x, to_y);
  };
  return {"SolidWorks",
          rows("0 SECTION\n2 HEADER\n9 $ACADVER\n1 AC1018\n9 $MEASUREMENT\n70 1\n0 ENDSEC\n0 SECTION\n2 "
               "ENTITIES\n" +
               drawn("A1", "SLD-0", -2, -1, 2, -1) + drawn("A2", "SLD-0", 2, 1, -2, 1) +
               drawn("A3", "SLD-0", -2, 1, 2, 1) + drawn("A4", "CENTER", -3.5, 0, 3.5, 0) +
               drawn("A5", "CENTER", 0, -1.5, 0, 1.5) + R"(0 ARC
5 A6
8 SLD-0
10 -2.0
20 0.0
40 1.0
50 90.0
51 270.0
210 0.0
220 0.0
230 -1.0
0 ARC
5 A7
8 SLD-0
10 -2.0
20 0.0
40 1.0
50 90.0
51 270.0
0 ARC
5 A8
8 SLD-0
10 -2.0
20 0.0
40 1.0
50 90.0
51 270.0
0 CIRCLE
5 A9
8 SLD-0
10 0.0
20 0.0
40 0.5
210 0.0
220 0.0
230 -1.0
0 ENDSEC
0 EOF
)"),
          "SLD-0"};
}

/// KiCad: an outline of a board by lines and arcs with rounded ends, indices of colours, a blank value.
Drawing kicad() {
  return {"KiCad", rows(R"(0 SECTION
2 HEADER
9 $ANGBASE
50 0.0
9 $ANGDIR
70 1
9 $MEASUREMENT
70 0
0 ENDSEC
0 SECTION
2 TABLES
0 TABLE
2 LAYER
70 1
0 LAYER
2 BLACK
70 0
62 7
6 CONTINUOUS
0 ENDTAB
0 ENDSEC
0 SECTION
2 ENTITIES
0 LINE
8 BLACK
10 -2
20 -1.0000000000001
11 2.0000000000001
21 -1
0 ARC
8 BLACK
10 2
20 0
40 1
50 270
51 90
0 LINE
8 BLACK
10 2
20 1
11 -2
21 1
0 ARC
8 BLACK
10 -2
20 0
40 1
50 90
51 270
0 CIRCLE
8 BLACK
10 0
20 0
40 0.5
0 TEXT
8 BLACK
7 KICAD
10 0
20 3
40 1
1
0 ENDSEC
0 EOF
)"),
          "BLACK", "1 TEXT on layer 'BLACK'"};
}

std::vector<Drawing> drawings() {
  return {autocad_r12(), autocad_2000(), autocad_2018(), qcad(),  librecad(),   freecad(), openscad(),
          cadquery(),    inkscape(),     rhino(),        ezdxf(), solidworks(), kicad()};
}

class ProgramDrawing : public DxfTest, public ::testing::WithParamInterface<Drawing> {};

/// Distance from the outline: points at 1 from the middle line of the slot, and at 0.5 from the centre.
double distance_from_plate(Point p) {
  const double to_middle = length(p - Point{std::clamp(p.x, -2., 2.), 0});
  return std::min(std::abs(to_middle - 1), std::abs(length(p) - 0.5));
}

TEST_P(ProgramDrawing, IsThePlate) {
  const Drawing& drawing = GetParam();
  std::vector<Chain> chains = read("plate.dxf", drawing.text);
  std::vector<std::string> warnings;
  const Geometry geometry = assemble(chains, {}, warnings);
  EXPECT_EQ(geometry.loop_count(), 2) << fmt::format("{}", fmt::join(warnings, "; "));
  std::vector<std::string> names;
  for (const Boundary& b : geometry.boundaries()) names.push_back(b.name);
  EXPECT_EQ(fmt::format("{}", fmt::join(names, " ")), drawing.boundaries);
  std::size_t points = 0;
  std::erase_if(chains, [](const Chain& chain) { return chain.name == "CENTER"; });
  for (const Chain& chain : chains) {
    for (const Point p : along(chain)) {
      EXPECT_LE(distance_from_plate(p), drawing.precision) << chain.source << ": " << p.x << " " << p.y;
      ++points;
    }
  }
  EXPECT_GT(points, 250u);
  double length_of_all = 0;
  for (std::int32_t v = 0; v < geometry.size(); ++v)
    length_of_all += length(geometry.point(geometry.next(v)) - geometry.point(v));
  EXPECT_NEAR(length_of_all, 8 + 3 * std::numbers::pi, 1e-2);
  const std::string said = fmt::format("{}", fmt::join(warnings_, "; "));
  EXPECT_EQ(said.substr(std::min(said.size(), said.find("left out: "))),
            *drawing.left_out == '\0' ? "" : std::string("left out: ") + drawing.left_out);
}

INSTANTIATE_TEST_SUITE_P(Dxf, ProgramDrawing, ::testing::ValuesIn(drawings()),
                         [](const auto& drawing) { return std::string(drawing.param.program); });

/// What a program may have damaged, and what the refusal names.
TEST_F(DxfTest, RefusesDamagedDrawingsByLayerAndHandle) {
  const std::string text = autocad_2018().text;
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    changed.replace(changed.find(from), from.size(), to);
    return refused(changed);
  };
  const std::string spline = "layer 'Körper', SPLINE of handle 1C3F2E: ",
                    arc = "layer 'Körper', ARC of handle 1C3F2B: ";
  EXPECT_NE(with("40\n6.283185307179586\n", "").find(spline + "it has 11 knots"), std::string::npos);
  EXPECT_NE(with("41\n0.7071067811865476\n", "").find(spline + "it has 8 weights"), std::string::npos);
  EXPECT_NE(with("41\n0.7071067811865476\n", "41\n-1\n").find(spline + "a weight is not"), std::string::npos);
  EXPECT_NE(with("40\n3.14", "40\n9").find(spline + "its knots are not in ascending"), std::string::npos);
  EXPECT_NE(with("50\n270.0", "50\n270,0").find(arc + "'270,0' of group 50 is not"), std::string::npos);
  EXPECT_NE(with("50\n270.0", "50\n270.0\n210\n0.0\n230\n0.0").find(arc + "its extrusion has no"),
            std::string::npos);
}

}  // namespace
}  // namespace quadloop::io
