// A user's case for OpenFOAM: what is copied of it, what is refused.
#include "adapt/solvers/openfoam_template.hpp"

#include <gtest/gtest.h>

#include "mesher/base/error.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder, test::world;

const std::string control =
    "functions { writeFormat binary; }\napplication  simpleFoam;\nwriteFormat ascii;\n";
const std::string field = "FoamFile { class volScalarField; format ascii; }\ninternalField uniform 1;\n";

/// On the calling rank alone.
void put(const TemporaryFolder& folder, const std::string& name, const std::string& text) {
  fs::create_directories(fs::path(folder.file(name)).parent_path());
  test::write_bytes(folder.file(name), text);
}

void make_case(const TemporaryFolder& folder) {
  put(folder, "system/controlDict", control);
  put(folder, "0/p", field);
}

std::string refusal(const TemporaryFolder& folder) {
  try {
    read_openfoam_template(folder.path());
  } catch (const InputError& fault) {
    return fault.what();
  }
  return "none";
}

/// On the root alone, in the folder of all.
template <class Body>
void on_root(const Body& body) {
  const TemporaryFolder folder;
  if (world().is_root()) {
    make_case(folder);
    body(folder);
  }
  world().barrier();
}

TEST(OpenfoamTemplate, IsCopiedWithoutWhatRunsHaveLeft) {
  on_root([](const TemporaryFolder& folder) {
    for (const char* name : {"run/cycle_00.part/x", "deep/run/cycle_07/x", "12/p", "log.a", "processor1/x",
                             "constant/polyMesh/points"})
      put(folder, name, "");
    put(folder, "deep/cycle_of_values", "");
    fs::create_symlink("0", folder.file("linked"));
    const OpenfoamTemplate given = read_openfoam_template(folder.path());
    EXPECT_EQ(given.application, "simpleFoam");
    EXPECT_EQ(given.files,
              (std::vector<std::string>{"0/p", "deep/cycle_of_values", "linked/p", "system/controlDict"}));
    fs::permissions(folder.file("0/p"), fs::perms::owner_read);
    const fs::path inside = fs::path(folder.path()) / "run/cycle_00.part/openfoam";
    copy_openfoam_template(folder.path(), given, inside);
    EXPECT_EQ(test::bytes_of((inside / "linked/p").string()), field);
    EXPECT_NE(fs::status(inside / "0/p").permissions() & fs::perms::owner_write, fs::perms::none);
    EXPECT_EQ(openfoam_template_files(folder.path()), given.files);
  });
}

TEST(OpenfoamTemplate, LinksThatLeadNowhereAreRefused) {
  on_root([](const TemporaryFolder& folder) {
    fs::create_symlink("nothing", folder.file("system/a"));
    EXPECT_NE(refusal(folder).find("system/a: is a broken link"), std::string::npos) << refusal(folder);
    fs::remove(folder.file("system/a"));
    fs::create_symlink("..", folder.file("system/a"));
    EXPECT_NE(refusal(folder).find("system/a: is a link to a folder that contains it"), std::string::npos)
        << refusal(folder);
  });
}

TEST(OpenfoamTemplate, ControlDictMustNameWhatIsRunAndWriteText) {
  on_root([](const TemporaryFolder& folder) {
    const std::string path = folder.file("system/controlDict");
    EXPECT_EQ(refusal(folder), "none");
    for (const auto& [text, said] : {std::pair{"writeFormat ascii;", "names no application"},
                                     {"application a;\nwriteFormat binary;", "writeFormat is binary"},
                                     {"application a;\nwriteCompression on;", "writeCompression is on"},
                                     {"application \"a;b\";", "application is 'a;b'"}}) {
      put(folder, "system/controlDict", text);
      EXPECT_TRUE(refusal(folder).starts_with(path + ": " + said)) << refusal(folder);
    }
    put(folder, "system/controlDict", "");
    put(folder, "Allrun", "#!/bin/sh\n");
    EXPECT_NE(refusal(folder).find("chmod +x"), std::string::npos) << refusal(folder);
    fs::permissions(folder.file("Allrun"), fs::perms::owner_all);
    EXPECT_EQ(read_openfoam_template(folder.path()).application, "Allrun");
  });
}

TEST(OpenfoamTemplate, FieldsMustBeThereAsText) {
  on_root([](const TemporaryFolder& folder) {
    put(folder, "0/p", "FoamFile { class volScalarField; }\n#include \"all\"\n");
    EXPECT_NE(refusal(folder).find("0/p: has no internalField"), std::string::npos) << refusal(folder);
    fs::rename(folder.file("0"), folder.file("0.orig"));
    EXPECT_NE(refusal(folder).find("0.orig/p: has no internalField"), std::string::npos) << refusal(folder);
    fs::remove_all(folder.file("0.orig"));
    EXPECT_NE(refusal(folder).find("has no folder 0"), std::string::npos) << refusal(folder);
    fs::remove_all(folder.file("system"));
    EXPECT_NE(refusal(folder).find("has no system/controlDict"), std::string::npos) << refusal(folder);
  });
}

}  // namespace
}  // namespace quadloop::adapt
