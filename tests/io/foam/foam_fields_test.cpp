// Fields of OpenFOAM's: what is read, what is put in place of internalField, what is refused.
#include "io/foam/foam_fields.hpp"

#include <gtest/gtest.h>

#include "mesher/base/error.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/support/temporary_folder.hpp"

namespace quadloop::io {
namespace {

using test::TemporaryFolder;

std::string head(const std::string& of_class, const std::string& format = "ascii") {
  return "/* internalField uniform 7; */\nFoamFile\n{\n    version 2.0;\n    format " + format +
         ";\n    class " + of_class + ";\n    object x;\n}\n// internalField uniform 8;\n";
}

const char* const scalar_list = "internalField nonuniform List<scalar>\n3\n(\n1.5\n-2e-3\n1e+20\n)\n;\n";
const char* const tail = "boundaryField\n{\n    wall { type fixedValue; value uniform 9; }\n}\n";

std::string refusal(const TemporaryFolder& folder, std::size_t cells) {
  try {
    read_foam_fields(folder.path(), cells);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(FoamFields, ScalarsAndVectorsAreReadAndOthersPassedOver) {
  const TemporaryFolder folder;
  folder.write("p", head("volScalarField") + scalar_list + tail);
  folder.write("U", head("volVectorField") +
                        "internalField nonuniform List<vector> 3((1 2 0) (3 4 0)\n(5 6 0));\n" + tail);
  folder.write("T", head("volScalarField") + "internalField   uniform 0.25;\n" + tail);
  folder.write("phi", head("surfaceScalarField") + "internalField uniform 3;\n");
  folder.write("uniform/time", head("dictionary"));
  const CellValues read = read_foam_fields(folder.path(), 3);
  EXPECT_EQ(read.names, (std::vector<std::string>{"T", "U_x", "U_y", "p"}));
  EXPECT_EQ(read.values, (std::vector<double>{0.25, 1, 2, 1.5, 0.25, 3, 4, -2e-3, 0.25, 5, 6, 1e20}));
}

TEST(FoamFields, ValuesTakeThePlaceOfInternalFieldAlone) {
  const TemporaryFolder folder;
  folder.write("p", head("volScalarField") + "internalField uniform 1;\n" + tail);
  folder.write("U", head("volVectorField") + "internalField uniform (1 0 0);\n" + tail);
  folder.write("k", head("volScalarField") + "internalField uniform 4;\n" + tail);
  const CellValues cells{{"U_y", "p", "U_x", "rho"}, {0.1, 2, 1.0 / 3, 9, -1, 1e-9, 4, 9}};
  EXPECT_EQ(set_foam_fields(folder.path(), cells), (std::vector<std::string>{"U", "p"}));
  EXPECT_EQ(test::bytes_of(folder.file("p")),
            head("volScalarField") + "internalField nonuniform List<scalar>\n2\n(\n2\n1e-09\n)\n;\n" + tail);
  const CellValues read = read_foam_fields(folder.path(), 2);
  EXPECT_EQ(read.names, (std::vector<std::string>{"U_x", "U_y", "k", "p"}));
  EXPECT_EQ(read.values, (std::vector<double>{1.0 / 3, 0.1, 4, 2, 4, -1, 4, 1e-9}));
}

TEST(FoamFields, RefusesWhatItCannotRead) {
  const TemporaryFolder folder;
  folder.write("p", head("volScalarField") + scalar_list);
  EXPECT_NE(refusal(folder, 4).find("has values for 3 cells, the mesh has 4"), std::string::npos);
  folder.write("p", head("volScalarField") + "internalField nonuniform List<scalar> 3(1 2);");
  EXPECT_NE(refusal(folder, 3).find("is missing, or no finite number"), std::string::npos);
  folder.write("p", head("volScalarField") + "internalField nonuniform List<scalar> 3(1 2 nan);");
  EXPECT_NE(refusal(folder, 3).find("no finite number"), std::string::npos);
  folder.write("p", head("volScalarField") + "internalField nonuniform List<scalar> 3(1 2 3 4);");
  EXPECT_NE(refusal(folder, 3).find("more values than cells"), std::string::npos);
  folder.write("p", head("volScalarField", "binary") + scalar_list);
  EXPECT_NE(refusal(folder, 3).find("writeFormat ascii"), std::string::npos);
  folder.write("p", head("volScalarField") + "boundaryField {}");
  EXPECT_NE(refusal(folder, 3).find("has no internalField"), std::string::npos);
  folder.write("p", head("volScalarField") + scalar_list);
  folder.write("U.gz", "?");
  EXPECT_NE(refusal(folder, 3).find("writeCompression off"), std::string::npos);
}

std::string poly_mesh_head(const std::string& of_class) {
  return "FoamFile\n{\n    version 2.0;\n    format ascii;\n    class " + of_class + ";\n    object x;\n}\n";
}

TEST(FoamFields, CellsAtWallsGetWhatOpenfoamKnowsThere) {
  const TemporaryFolder folder;
  folder.write("mesh/owner", poly_mesh_head("labelList") + "6\n(\n0\n1\n0\n2\n2\n1\n)\n");
  folder.write("mesh/boundary", poly_mesh_head("polyBoundaryMesh") +
                                    "3\n(\nfloor\n{\n type wall;\n nFaces 2;\n startFace 2;\n}\n"
                                    "lid\n{\n type patch;\n nFaces 1;\n startFace 4;\n}\n"
                                    "empty\n{\n type wall;\n nFaces 1;\n startFace 5;\n}\n)\n");
  const std::string zero = "internalField uniform 0;\nboundaryField\n{\n",
                    lid = "lid { type calculated; value uniform ";
  folder.write("7/yPlus", head("volScalarField") + zero +
                              "floor { type calculated; value nonuniform List<scalar> 2(1.5 2.5); }\n" + lid +
                              "9; }\nempty { type zeroGradient; }\n}\n");
  folder.write("7/wallShearStress",
               head("volVectorField") +
                   "internalField uniform (0 0 0);\nboundaryField\n{\n\"floor\" { // value no;\n" +
                   " type calculated; value uniform (-3 4 0); }\n}\n");
  folder.write("7/p", head("volScalarField") + zero + "floor { value uniform 8; }\n}\n");
  CellValues cells = read_foam_fields(folder.file("7"), 3);
  put_wall_values(folder.file("7"), folder.file("mesh"), cells);
  EXPECT_EQ(cells.names, (std::vector<std::string>{"p", "wallShearStress_x", "wallShearStress_y", "yPlus"}));
  EXPECT_EQ(cells.values, (std::vector<double>{0, -3, 4, 1.5, 0, 0, 0, 0, 0, -3, 4, 2.5}));
  folder.write("7/yPlus",
               head("volScalarField") + zero + "floor { value nonuniform List<scalar> 1(1); }\n}\n");
  try {
    put_wall_values(folder.file("7"), folder.file("mesh"), cells);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("yPlus: has values for 1 faces, floor has 2"), std::string::npos)
        << error.what();
  }
}

TEST(FoamFields, TheLatestTimeIsTheLargestNumber) {
  const TemporaryFolder folder;
  EXPECT_EQ(latest_foam_time(folder.path()), "");
  for (const std::string time : {"0", "0.orig", "9", "10", "1e-3", "constant"}) folder.write(time + "/p", "");
  EXPECT_EQ(latest_foam_time(folder.path()), folder.file("10"));
}

}  // namespace
}  // namespace quadloop::io
