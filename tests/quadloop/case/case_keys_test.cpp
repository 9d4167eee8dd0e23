// Every key of a case file: it is read, it changes what it says, and it is described.
#include "quadloop/case/case_keys.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "mesher/base/error.hpp"
#include "quadloop/case/adapt_settings.hpp"
#include "quadloop/case/layer_settings.hpp"
#include "quadloop/case/mesh_settings.hpp"
#include "quadloop/case/pair_settings.hpp"
#include "quadloop/case/shape_settings.hpp"
#include "quadloop/case/smooth_settings.hpp"
#include "tests/io/input/temporary_file.hpp"

namespace quadloop {
namespace {

/// The values of any members in a row, as text.
class Dump {
 public:
  template <class... Values>
  void add(const Values&... values) {
    (add_one(values), ...);
  }
  const std::string& text() const { return text_; }

 private:
  template <class Value>
  void add_one(const Value& value) {
    if constexpr (std::is_enum_v<Value>)
      text_ += std::to_string(static_cast<int>(value));
    else if constexpr (std::is_arithmetic_v<Value>)
      text_ += std::to_string(value);
    else
      text_ += value;
    text_ += " ";
  }
  template <class Value>
  void add_one(const std::optional<Value>& value) {
    value ? add_one(*value) : add_one("-");
  }
  template <class Value>
  void add_one(const std::vector<Value>& values) {
    for (const Value& value : values) add_one(value);
    add_one(";");
  }
  void add_one(Point p) { add(p.x, p.y); }
  void add_one(BoundaryCondition c) { add(c.word()); }
  void add_one(const Box& b) { add(b.low, b.high); }
  void add_one(const SizeSource::Disc& d) { add(d.centre, d.radius); }
  void add_one(const SizeSource::Line& l) { add(l.from, l.to); }
  void add_one(const SizeSource::Block& b) { add(b.name); }
  void add_one(const RootOptions& r) { add(r.corner, r.tree_edge, r.trees_x, r.trees_y); }
  void add_one(const FarField& f) { add(f.shape, f.radius, f.spacing); }
  void add_one(const HalfDomain& h) { add(h.axis, h.boundary); }
  void add_one(const flow::Goal& g) { add(g.quantity, g.boundaries, g.about, g.weight); }
  void add_one(const LayerSpec& s) { add(s.first, s.growth, s.growth_to, s.count, s.equal, s.y_plus); }
  void add_one(const LayerLine& l) {
    add(l.from, l.path, l.length, l.spacing, l.layers, l.at, l.without_layers, l.spacing_at_end);
  }
  void add_one(const GeometryInput& f) {
    const Transform& t = f.transform;
    add(f.path, t.scale, t.rotate_degrees, t.translate, t.rotate_about, f.choice.layers, f.choice.names.from,
        f.choice.names.attribute, f.unit, f.spline);
  }
  void add_one(const Curve& c) { add(c.inner, c.spacing); }
  void add_one(const Shape& s) {
    add(s.chain.name, s.chain.open, s.chain.points, s.chain.curves, s.is_body, s.spline);
  }
  void add_one(const BoundaryRule& r) {
    add(r.pattern, r.spacing, r.corner_degrees, r.condition, r.corner_spacing, r.layers, r.layers_in);
  }
  void add_one(const LineRule& l) { add(l.name, l.boundary, l.path, l.spline, l.baffle); }
  void add_one(const BlockRule& b) { add(b.name, b.boundaries, b.loop, b.inside, b.spacing); }
  void add_one(const SizeSource& s) {
    std::visit([&](const auto& shape) { add_one(shape); }, s.shape);
    add(s.spacing);
  }
  void add_one(const PeriodicPair& p) { add(p.from, p.to, p.translation, p.degrees, p.centre); }
  void add_one(const FlowSettings& f) {
    add(f.reynolds, f.reference_length, f.density, f.speed, f.alpha, f.gamma, f.pressure);
  }
  void add_one(const adapt::AdaptOptions& a) {
    add(a.cycles, a.passes, a.source, a.variables, a.indicator, a.threshold, a.refine, a.coarsen, a.max_nodes,
        a.norm, a.growth, a.until.cl, a.until.cd, a.until.estimate, a.min, a.facets, a.transfer);
  }

  std::string text_;
};

/// What a case was read into, so far as other parts of the program see it.
std::string text_of(const Settings& s) {
  const SizeOptions& size = s.mesh.size;
  const flow::EulerOptions& e = s.solver.euler;
  Dump dump;
  dump.add(s.title, s.files, s.shapes, s.inside, s.half, s.min, s.max, s.stretch, s.lines,
           s.wakes_without_layers, s.flow, s.adapt, s.morph_to);
  dump.add(s.far_field, s.output_prefix, s.formats, s.fields, s.partitions);
  dump.add(s.outline.rules, s.outline.default_corner_degrees, s.outline.join, s.outline.unite_islands,
           s.outline.blocks, s.outline.lines);
  dump.add(s.mesh.type, s.mesh.quads, s.mesh.snap, s.mesh.may_vanish, s.mesh.mirror, s.mesh.pairs,
           size.gradation, size.curvature, size.gap, size.sources, size.root);
  dump.add(s.smooth.sweeps, s.smooth.objective, s.smooth.method, s.solver.kind, s.solver.case_template);
  dump.add(e.mach, e.alpha, e.gamma, e.viscosity, e.prandtl, e.time, e.end_time, e.time_step, e.average_from,
           e.unsteady, e.flow_throughs, e.cfl, e.iterations, e.tolerance, e.limiter, e.initial, e.far_field,
           e.reference_length, e.goals, e.adjoint_fields);
  const adapt::CommandSolver& c = s.solver.command;
  dump.add(c.command.arguments, c.command.timeout, c.mesh, c.solution, c.ranks);
  for (const auto& [key, value] : s.solver.warm) dump.add(key, value);
  for (const auto& [key, value] : s.solver.finish) dump.add(key, value);
  for (const OutflowPressure& outflow : s.solver.pressures) dump.add(outflow.pattern, outflow.pressure);
  for (const WallTemperature& wall : s.solver.wall_temperatures) dump.add(wall.pattern, wall.temperature);
  return dump.text();
}

/// Where a table stands in the case of this test.
std::string place_of(const std::string& table) {
  const std::map<std::string, std::string> places{{"boundary.NAME", "boundary.box"},
                                                  {"boundary.NAME.layers", "boundary.box.layers"},
                                                  {"pair", "pair.0"},
                                                  {"shape", "shape.0"},
                                                  {"source", "source.0"},
                                                  {"block", "block.0"},
                                                  {"line", "line.0"},
                                                  {"wake", "wake.0"},
                                                  {"layer_line", "layer_line.0"}};
  const auto found = places.find(table);
  return found == places.end() ? table : found->second;
}

const TableText& table_named(const std::string& name) {
  return *std::ranges::find(case_tables(), name, &TableText::name);
}

/// Assignments under which a key is accepted: its example, and what its row says that it requires.
class Accepted {
 public:
  void set(const TableText& table, const std::string& key, const std::string& value = "") {
    const auto row = std::ranges::find(table.keys, key, &KeyText::name);
    ASSERT_NE(row, table.keys.end()) << table.name << "." << key;
    const std::string dotted = (table.name.empty() ? "" : place_of(table.name) + ".") + key;
    if (!values_.emplace(dotted, value.empty() ? row->example : value).second) return;
    for (const KeyNeed& need : row->needs) satisfy(need.condition, table);
    for (const KeyText& other : table.keys) {
      for (const KeyRequired& required : other.required) {
        if (is_asked(required.when, table)) set(table, other.name);
      }
    }
  }

  /// All of them, but that of the key left out.
  std::vector<std::string> assignments(const std::string& left_out = "") const {
    std::vector<std::string> all;
    for (const auto& [key, value] : values_) {
      if (key != left_out) all.push_back(key + "=" + value);
    }
    return all;
  }

 private:
  bool is_asked(const std::string& when, const TableText& table) const {
    if (const auto other = when.find(" or "); other != std::string::npos)
      return is_asked(when.substr(0, other), table) || is_asked(when.substr(other + 4), table);
    const auto value_of = [&](const std::string& key) {
      const auto found = values_.find(place_of(table.name) + "." + key);
      return found == values_.end() ? std::string() : found->second;
    };
    if (when.starts_with("no ")) return value_of(when.substr(3)).empty();
    const auto sign = when.find(" = ");
    return when.empty() || value_of(when.substr(0, sign)) == when.substr(sign + 3);
  }

  /// Sets the first of the keys that a condition names, if it is not one that says "no" or that defaults
  /// meet.
  void satisfy(const std::string& condition, const TableText& table) {
    const std::string first = condition.substr(0, condition.find(" or "));
    if (first.starts_with("no ") || first.find(" < ") != std::string::npos) return;
    const auto sign = first.find_first_of("=>");
    const std::string name = sign == std::string::npos ? first : first.substr(0, sign - 1);
    const std::string value = sign == std::string::npos ? ""
                              : first[sign] == '>'      ? "1"
                                                        : first.substr(sign + 2);
    const auto dot = name.find('.');
    if (dot == std::string::npos)
      set(table, name, value);
    else
      set(table_named(name.substr(0, dot)), name.substr(dot + 1), value);
  }

  std::map<std::string, std::string> values_;
};

class CaseKeys : public ::testing::Test {
 protected:
  /// Reads a case with the key and what it requires, as a whole and into its own target alone.
  template <class Target>
  void expect_effect(const KeyTable<Target>& table, const Key<Target>& key) {
    const std::string name = table.text().name + "." + key.text.name;
    Accepted accepted;
    if (name == "solver.goal_about") accepted.set(table.text(), "goal", "\"moment\"");
    if (name == "geometry.layers" || name == "geometry.names")
      accepted.set(table.text(), "file", "\"box.dxf\"");
    if (name == "shape.scale" || name.starts_with("shape.rot") || name == "shape.translate" ||
        name == "shape.name")
      accepted.set(table.text(), "code");
    if (name == "source.spacing") accepted.set(table.text(), "box");
    if (name == "block.name" || name == "block.spacing") accepted.set(table.text(), "inside");
    if (name == "line.name" || name == "line.kind") accepted.set(table.text(), "boundary");
    if (name == "line.spline") accepted.set(table.text(), "path");
    if (name == "line.kind" || name == "line.path" || name == "line.spline")
      accepted.set(table.text(), "name");
    accepted.set(table.text(), key.text.name);
    accepted.set(table_named("geometry"), "file");
    std::string tables;
    for (const char* const list : {"pair", "shape", "source", "block", "line", "wake", "layer_line"})
      if (table.text().name == list) tables += "[[" + std::string(list) + "]]\n";
    const std::string path = folder_.write("case.toml", tables);
    const Settings settings = read_settings(path, accepted.assignments());
    for (const std::string& warning : settings.warnings)
      EXPECT_EQ(warning.find("nothing: it needs"), std::string::npos) << name << ": " << warning;
    expect_other_settings(path, accepted, name, place_of(table.text().name) + "." + key.text.name, settings);
    io::CaseTable below = io::read_case(path, accepted.assignments());
    for (std::string rest = place_of(table.text().name); !rest.empty();) {
      const std::string first = rest.substr(0, rest.find('.'));
      rest.erase(0, first.size() + 1);
      const bool is_list = rest == "0";
      below = is_list ? below.tables(first).at(0) : *below.table(first);
      if (is_list) rest.clear();
    }
    Target target;
    ASSERT_TRUE(below.has(key.text.name)) << name;
    key.read(below, target);
    EXPECT_TRUE(key.differs(target, Target{})) << name << " changes nothing";
    ++keys_;
  }
  /// Without the key the settings are others, or the case is refused, as the key is required.
  void expect_other_settings(const std::string& path, const Accepted& accepted, const std::string& name,
                             const std::string& place, const Settings& settings) {
    try {
      const Settings without =
          read_settings(path, accepted.assignments(place.starts_with('.') ? place.substr(1) : place));
      EXPECT_NE(text_of(without), text_of(settings)) << name << " is ignored";
      ++compared_;
    } catch (const InputError& error) {
      const std::string said = error.what();
      EXPECT_TRUE(said.find("missing") < said.size() || said.find("needs") < said.size())
          << name << ": " << said;
    }
  }
  template <class Target>
  void expect_effects(const KeyTable<Target>& table) {
    for (const Key<Target>& key : table.keys()) expect_effect(table, key);
    ++tables_;
  }

  test::InputFolder folder_;
  std::size_t keys_ = 0, tables_ = 0, compared_ = 0;
};

TEST_F(CaseKeys, EachIsAcceptedAndChangesWhatItSets) {
  expect_effects(title_keys());
  expect_effects(geometry_keys());
  expect_effects(pair_keys());
  expect_effects(shape_keys());
  expect_effects(far_field_keys());
  expect_effects(spacing_keys());
  expect_effects(boundary_keys());
  expect_effects(layer_keys());
  expect_effects(wake_keys());
  expect_effects(layer_line_keys());
  expect_effects(flow_keys());
  expect_effects(source_keys());
  expect_effects(block_keys());
  expect_effects(line_keys());
  expect_effects(mesh_keys());
  expect_effects(smooth_keys());
  expect_effects(adapt_keys());
  expect_effects(until_keys());
  expect_effects(design_keys());
  expect_effects(solver_keys());
  expect_effects(output_keys());
  EXPECT_EQ(tables_, case_tables().size()) << "each table is tried";
  EXPECT_GT(keys_, 100U);
  EXPECT_GT(compared_, 90U) << "the others are required";
}

TEST_F(CaseKeys, EachIsDescribedOnce) {
  for (const TableText& table : case_tables()) {
    for (const KeyText& key : table.keys) {
      EXPECT_EQ(std::ranges::count(table.keys, key.name, &KeyText::name), 1) << table.name << "." << key.name;
      EXPECT_TRUE(key.meaning.ends_with(".")) << table.name << "." << key.name;
      const std::string name = table.name.empty() ? key.name : table.name + "." + key.name;
      EXPECT_NE(key_help(name).find(name + ": "), std::string::npos) << key_help(name);
    }
  }
}

TEST_F(CaseKeys, HelpFindsKeysAndTables) {
  EXPECT_EQ(
      key_help("spacing.max"),
      "spacing.max: number, above 0 (length); default: a sixteenth of the domain\n    Largest cell size.\n");
  EXPECT_EQ(key_help("max"), key_help("spacing.max"));
  EXPECT_EQ(key_help("boundary.wing.bc"), key_help("boundary.NAME.bc"));
  EXPECT_TRUE(key_help("boundary.a.b.layers.count").starts_with("boundary.NAME.layers.count: whole number"));
  EXPECT_TRUE(key_help("shape.0.hinge").starts_with("shape.hinge: "));
  EXPECT_TRUE(key_help("source.0.spacing").starts_with("source.spacing: "));
  EXPECT_TRUE(key_help("[smooth]").starts_with("[smooth]\n  sweeps "));
  EXPECT_TRUE(key_help("boundary.wing").starts_with("[boundary.NAME]\n"));
  EXPECT_NE(key_help("").find("[output]\n  prefix "), std::string::npos);
  EXPECT_EQ(key_help("boundary.a.layers.first").find('`'), std::string::npos);
}

TEST_F(CaseKeys, HelpNamesTheNearestKey) {
  const auto guess = [](const std::string& topic) {
    try {
      return key_help(topic);
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
  };
  EXPECT_EQ(guess("spacing.maxi"),
            "'spacing.maxi' is no key and no table of a case file; do you mean 'spacing.max'? See "
            "'quadloop help', or 'quadloop COMMAND --help' for a command");
  EXPECT_NE(guess("gradatoin").find("'spacing.gradation'?"), std::string::npos);
  EXPECT_NE(guess("qqqqqq").find("no table of a case file; see"), std::string::npos);
}

TEST_F(CaseKeys, TheReferenceHasARowForEachKey) {
  const std::string text = key_reference();
  const auto has = [&](const std::string& part) { EXPECT_NE(text.find(part), std::string::npos) << part; };
  has("<!-- keys of boundary.NAME -->\n| key | value | default | meaning |\n");
  has("| `half` | text | none | Mesh only the half above the x axis");
  has("Requires `mirror`. |");
  has("| `bc` | `wall`, `farfield`, `inflow`, `outflow`, `symmetry`, `interface` or `none` | `none` |");
  has("Required with `time = \"accurate\"`. |");
}

}  // namespace
}  // namespace quadloop
