// What a case file says as a whole: every key, misspelt keys, outputs, the digest.
#include "quadloop/case/settings.hpp"

#include <gtest/gtest.h>

#include "generate/digests.hpp"
#include "tests/quadloop/case/settings_fixture.hpp"

namespace quadloop {
namespace {

class SettingsTest : public test::SettingsFixture {};

TEST_F(SettingsTest, AWallMayBeViscousOrInviscid) {
  for (const std::string wall : {"viscous", "inviscid"}) {
    const Geometry geometry =
        load(read("[spacing]\nmin = 0.5\nmax = 1\n[boundary.box]\nbc = \"wall\"\nwall = \"" + wall + "\"\n"));
    EXPECT_EQ(geometry.boundaries()[0].condition.word(), wall + "_wall");
  }
}

TEST_F(SettingsTest, ReadsEveryKey) {
  const Settings s = read(R"(far_field = 10
scale = 2
rotate = 90
translate = [1, 2]
[spacing]
min = 0.5
max = 1
gradation = 1.25
curvature = 10
gap = 2
corner = 20
[boundary.box]
spacing = 0.25
corner = 180
bc = "wall"
[[source]]
box = [0, 1, 2, 3]
spacing = 0.1
[[source]]
disc = [0, 1, 2]
spacing = 0.2
[[source]]
line = [0, 1, 2, 3]
spacing = 0.3
[mesh]
type = "hybrid"
root = [-10, -10, 20, 1, 1]
snap = 0.001
[output]
prefix = "out"
formats = ["cgns"]
)");
  EXPECT_EQ(s.files[0].transform.scale, 2);
  EXPECT_EQ(s.files[0].transform.rotate_degrees, 90);
  EXPECT_EQ(s.files[0].transform.translate, (Point{1, 2}));
  EXPECT_EQ(s.far_field->radius, 10);
  EXPECT_EQ(s.mesh.size.gradation, 1.25);
  EXPECT_EQ(s.mesh.size.curvature, 10);
  EXPECT_EQ(s.mesh.size.gap, 2);
  ASSERT_EQ(s.mesh.size.sources.size(), 3u);
  EXPECT_EQ(std::get<Box>(s.mesh.size.sources[0].shape).high, (Point{1, 3}));
  EXPECT_EQ(std::get<SizeSource::Disc>(s.mesh.size.sources[1].shape).radius, 2);
  EXPECT_EQ(std::get<SizeSource::Line>(s.mesh.size.sources[2].shape).to, (Point{2, 3}));
  EXPECT_EQ(s.mesh.size.root->tree_edge, 20);
  EXPECT_EQ(s.mesh.snap, 0.001);
  EXPECT_EQ(s.output_prefix, "out");
  EXPECT_EQ(s.formats, std::vector<std::string>{"cgns"});
  const Geometry g = load(s);
  EXPECT_EQ(g.boundary(BoundaryId{0}).spacing, 0.25);
  EXPECT_EQ(g.boundary(BoundaryId{0}).condition, BoundaryCondition::wall);
  EXPECT_EQ(g.boundary(BoundaryId{1}).name, "farfield");
  EXPECT_EQ(g.boundary(BoundaryId{1}).condition, BoundaryCondition::farfield);
  EXPECT_EQ(g.boundary(BoundaryId{1}).corner_degrees, 20);
}

TEST_F(SettingsTest, AMisspeltKeyThatIsNeededIsUnknownAndNotMissing) {
  EXPECT_EQ(refused("[boundary.box]\nlayers = { frist = 1, count = 3 }\n"),
            "case.toml:4: unknown key 'boundary.box.layers.frist'; known here: first, growth, count, "
            "thickness, equal; do you mean 'first'?");
  EXPECT_EQ(refused("[boundary.box]\nlayers = { first = 1, cuont = 3 }\n"),
            "case.toml:4: unknown key 'boundary.box.layers.cuont'; known here: first, growth, count, "
            "thickness, equal; do you mean 'count'?");
  EXPECT_EQ(refused("[[wake]]\nfrom = \"box\"\nlenght = 3\nspacing = 1\n"),
            "case.toml:5: unknown key 'wake.0.lenght'; known here: from, at, length, path, spacing, layers; "
            "do you mean 'length'?");
  EXPECT_EQ(refused("[[wake]]\nfrm = \"box\"\n"),
            "case.toml:4: unknown key 'wake.0.frm'; known here: from, at, length, path, spacing, layers; do "
            "you mean 'from'?");
}

TEST_F(SettingsTest, RefusesEveryBadKey) {
  EXPECT_EQ(refused("[spacing]\nfoo = 1\n").find("case.toml:4: unknown key 'spacing.foo'"), 0u);
  EXPECT_EQ(refused("[spacings]\n").find("case.toml:3: unknown key 'spacings'"), 0u);
  EXPECT_EQ(refused("[solver]\nmachs = 1\n").find("case.toml:4: unknown key 'solver.machs'"), 0u);
  EXPECT_EQ(
      refused("[solver]\niterations = 1.5\n").find("case.toml:4: 'solver.iterations' must be a whole number"),
      0u);
  EXPECT_EQ(refused("[solver]\nfar_field = \"swirl\"\n").find("case.toml:4: 'solver.far_field'"), 0u);
  EXPECT_EQ(refused("[solver]\ntime = \"accurate\"\n").find("case.toml:3: 'solver.end_time' is missing"), 0u);
  EXPECT_EQ(refused("[solver]\nkind = \"command\"\n").find("case.toml:3: 'solver.command' is missing"), 0u);
  EXPECT_EQ(refused("[boundary.box]\nbc = \"wall\"\npressure = 1\n")
                .find("case.toml:5: 'boundary.box.pressure' needs bc"),
            0u);
  EXPECT_EQ(refused("[boundary.box]\nbc = \"symmetry\"\nwall_temperature = 1\n")
                .find("case.toml:5: 'boundary.box.wall_temperature' needs bc"),
            0u);
  EXPECT_EQ(refused("[solver]\nviscosity = 1\nreynolds = 5\n").find("case.toml:5: 'solver.reynolds' stands"),
            0u);
  EXPECT_EQ(
      refused("[solver]\nmach = 0\nreynolds = 5\n").find("case.toml:5: 'solver.reynolds' needs mach > 0"),
      0u);
  EXPECT_EQ(refused("[output]\npartitions = -1\n").find("case.toml:4: 'output.partitions' is -1"), 0u);
  EXPECT_EQ(refused("[output]\npartitions = 1.5\n").find("case.toml:4: 'output.partitions' must be a whole"),
            0u);
  EXPECT_EQ(refused("[output]\nformats = [\"su2\"]\npartitions = 2\n")
                .find("case.toml:5: 'output.partitions' needs a format"),
            0u);
  EXPECT_EQ(refused("[spacing]\nmin = 0\n").find("case.toml:4: 'spacing.min' is 0"), 0u);
  EXPECT_EQ(refused("[spacing]\nmin = 2\nmax = 1\n")
                .find("case.toml:4: 'spacing.min' is 2, but must not be above spacing.max"),
            0u);
  EXPECT_EQ(refused("[spacing]\ngradation = 1\n").find("case.toml:4: 'spacing.gradation' is 1"), 0u);
  EXPECT_EQ(refused("[spacing]\ncorner = 190\n").find("case.toml:4: 'spacing.corner' is 190"), 0u);
  EXPECT_EQ(refused("[mesh]\nsnap = 0.5\n").find("case.toml:4: 'mesh.snap' is 0.5"), 0u);
  EXPECT_EQ(refused("[mesh]\ntype = \"voronoi\"\n").find("case.toml:4: 'mesh.type' "), 0u);
  EXPECT_EQ(refused("[mesh]\nroot = [0, 0, 1, 1.5, 1]\n")
                .find("case.toml:4: 'mesh.root' is [0, 0, 1, 1.5, 1], but must be [x0"),
            0u);
  EXPECT_EQ(refused("[boundary.box]\nwall = \"viscous\"\n").find("case.toml:4: 'boundary.box.wall' needs bc"),
            0u);
  EXPECT_EQ(refused("[boundary.box]\nbc = \"wall\"\nwall = \"wet\"\n")
                .find("case.toml:5: 'boundary.box.wall' is 'wet'"),
            0u);
  EXPECT_EQ(refused("[boundary.box]\nbc = \"viscous_wall\"\n").find("case.toml:4: 'boundary.box.bc' is"), 0u);
  EXPECT_EQ(refused("[boundary.hull]\nbc = \"wall\"\n")
                .find("case.toml:3: [boundary.hull]: no boundary of the geometry matches 'hull'"),
            0u);
  EXPECT_EQ(refused("[boundary.box]\nbc = \"wal\"\n").find("case.toml:4: 'boundary.box.bc' is 'wal'"), 0u);
  EXPECT_EQ(refused("[output]\nformats = [\"b8.ugrid\"]\n")
                .find("case.toml:4: 'output.formats' is 'b8.ugrid', but must be one of"),
            0u);
  EXPECT_EQ(refused("[[source]]\nspacing = 1\n").find("case.toml:3: a [[source]] needs exactly one"), 0u);
  EXPECT_EQ(refused("[[source]]\ndisc = [0, 0, 1]\n").find("case.toml:3: 'source.0.spacing' is missing"), 0u);
  EXPECT_EQ(refused("far_field = 1\n").find("case.toml:3: 'geometry.far_field': a far field of half width 1"),
            0u);
}

TEST_F(SettingsTest, RefusesAPrefixWithASuffix) {
  EXPECT_EQ(refused("[output]\nprefix = \"a.mesh\"\n")
                .find("case.toml:4: 'output.prefix' is 'a.mesh'; give it without .mesh"),
            0u);
  EXPECT_EQ(read("[output]\nprefix = \"out/v1.2\"\n").output_prefix, "out/v1.2");
  EXPECT_EQ(format_suffix_of("a.tree.h5"), ".h5");
  EXPECT_EQ(format_suffix_of("a.mesh/b"), "");
}

TEST_F(SettingsTest, TheDigestFollowsTheSettingsOfTheMesh) {
  const auto digest = [&](const std::vector<std::string>& assignments) {
    const Settings settings = read("[spacing]\nmin = 0.5\nmax = 1\n", assignments);
    return case_digest(mesh_options(settings, load(settings)));
  };
  const auto base = digest({});
  EXPECT_EQ(base, digest({"title=other", "output.prefix=other"}));
  EXPECT_NE(base, digest({"spacing.min=0.25"}));
  EXPECT_NE(base, digest({"spacing.gradation=1.25"}));
  EXPECT_NE(base, digest({"spacing.gap=2"}));
  EXPECT_NE(base, digest({"mesh.snap=0.001"}));
  EXPECT_NE(base, digest({"source=[{disc=[0,0,1],spacing=1}]"}));
}

}  // namespace
}  // namespace quadloop
