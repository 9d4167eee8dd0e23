#include "quadloop/case/mesh_settings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "io/text/length_units.hpp"
#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

/// Sets the value of one file, from one value for all files or a list with one per file.
template <class Value, class Set>
void share_out(const io::CaseTable& table, const std::string& key, const std::vector<Value>& values,
               std::vector<GeometryInput>& files, const Set& set) {
  if (values.size() > 1 && values.size() != files.size())
    table.refuse(key,
                 fmt::format("is a list of {}, but there are {} files; give one value, or one for each file",
                             values.size(), files.size()));
  for (std::size_t i = 0; i < files.size() && !values.empty(); ++i)
    set(files[i], values[values.size() == 1 ? 0 : i]);
}

ValueForm<std::vector<double>> one_or_several(const io::Range& range, const std::string& text) {
  return {text, "2", [range](const io::CaseTable& table, const std::string& key) {
            return table.numbers_or_one(key, range);
          }};
}

std::vector<std::string> unit_words() {
  std::vector<std::string> words = io::length_unit_names();
  words.insert(words.begin(), {"none", "file"});
  return words;
}

/// What names the boundaries of drawings and maps.
ValueForm<io::BoundaryNames> boundary_names() {
  using From = io::BoundaryNames::From;
  const std::string prefix = "attribute:";
  const ValueForm<From> words = choice<From>(
      {{"layer", From::layer}, {"block", From::block}, {"colour", From::colour}, {"file", From::file}});
  return {words.text + ", or `\"attribute:NAME\"`", "\"block\"",
          [words, prefix](const io::CaseTable& table, const std::string& key) {
            const std::string given = *table.text(key);
            if (given.size() <= prefix.size() || !given.starts_with(prefix))
              return io::BoundaryNames{words.read(table, key)};
            return io::BoundaryNames{From::attribute, given.substr(prefix.size())};
          }};
}

/// The half width of a square, or a table.
ValueForm<FarField> far_field() {
  return {"number, above 0, or a table", "20", [](const io::CaseTable& table, const std::string& key) {
            FarField field;
            if (table.is_table(key))
              far_field_keys().read(*table.table(key), field);
            else
              field.radius = *table.number(key, io::Range::positive());
            field.where = fmt::format("{}: 'geometry.far_field'", table.place(key));
            return field;
          }};
}

/// The half above or beside the axis of mesh.mirror.
ValueForm<HalfDomain> half_domain() {
  return {"text", "\"axis\"", [](const io::CaseTable& table, const std::string& key) {
            return HalfDomain{
                table.has("mirror") && table.text("mirror") == "y" ? MirrorAxis::y : MirrorAxis::x,
                boundary_name().read(table, key)};
          }};
}

}  // namespace

const KeyTable<Settings>& geometry_keys() {
  static const std::vector<KeyNeed> of_files{{"file", "a [[shape]] is placed by its own keys"}};
  static const KeyTable<Settings> keys{
      "geometry",
      {key<&Settings::placement, &Placement::files>(
           "file", texts(),
           "Geometry file or files: `.geom`, `.dat`, `.dxf`, `.stp`, `.step`, `.geojson`, `.shp`, `.gpkg` "
           "([formats](formats.md)). Required without a [`[[shape]]`](#shape).",
           {.example = "\"box.geom\""}),
       key<&Settings::placement, &Placement::scale>(
           "scale", one_or_several(io::Range::positive(), "number, above 0, or a list"),
           "Scale factor of the coordinates, about the origin.", {.fallback = "1", .needs = of_files}),
       key<&Settings::placement, &Placement::rotate>(
           "rotate", one_or_several({}, "number, or a list"),
           "Rotation after scaling, counter-clockwise, about `rotate_about`. An angle of attack of 9 degrees "
           "is `rotate = -9`.",
           {.unit = "degrees", .fallback = "0", .needs = of_files}),
       key<&Settings::placement, &Placement::rotate_about>(
           "rotate_about", points(),
           "Centre of rotation, for example the hinge of a flap, in scaled coordinates.",
           {.fallback = "the origin", .needs = {{"rotate", "the angle in degrees"}}}),
       key<&Settings::placement, &Placement::translate>("translate", points(),
                                                        "Translation after the rotation.",
                                                        {.fallback = "`[0, 0]`", .needs = of_files}),
       key<&Settings::placement, &Placement::choice, &io::DrawingChoice::layers>(
           "layers", texts(),
           "Layers to read from a drawing or a map, with wildcards `*` and `?`. All: of a drawing, those "
           "that are neither off nor frozen.",
           {.fallback = "all"}),
       key<&Settings::placement, &Placement::choice, &io::DrawingChoice::names>(
           "names", boundary_names(),
           "What names the boundaries of a drawing or a map; see [formats](formats.md#dxf).",
           {.fallback = "`\"layer\"`; of a map the attribute `name` or `boundary`, else the layer"}),
       key<&Settings::outline, &AssembleOptions::join>(
           "join", number({0, 0.1, true, false}),
           "Tolerance for joining the ends of chains, as a fraction of the extent. A warning counts the "
           "joints."),
       key<&Settings::placement, &Placement::unit>(
           "unit", texts(unit_words()),
           "Unit of the coordinates. They are converted to metres, and all lengths of the case are then in "
           "metres; see [units](#units).",
           {.fallback = "`\"none\"`", .needs = of_files}),
       key<&Settings::placement, &Placement::spline>(
           "spline", flag(),
           "Join the points by cubic splines from corner to corner instead of straight lines, see below.",
           {.fallback = "`true` for `.dat`, else `false`", .needs = of_files}),
       key<&Settings::outline, &AssembleOptions::unite_islands>(
           "overlap", choice<bool>({{"error", false}, {"union", true}}),
           "`union`: islands that overlap or share edges are merged, see below."),
       key<&Settings::far_field>("far_field", far_field(),
                                 "Half width of a generated square boundary `farfield`, centred on the "
                                 "bounding box of all other boundaries. A table gives "
                                 "[other shapes](#far-field).",
                                 {.unit = "length"}),
       key<&Settings::inside>("inside", flag(),
                              "Mesh the inside of an airfoil (`.dat` or `[[shape]]`) without outer boundary. "
                              "Without this key such a case is an error."),
       key<&Settings::mesh, &MeshOptions::may_vanish>(
           "vanish", choice<bool>({{"error", false}, {"allow", true}}),
           "Treatment of a named boundary whose loops are all "
           "smaller than `spacing.min`: `\"error\"` stops the run, `\"allow\"` drops the boundary.")}};
  return keys;
}

const KeyTable<FarField>& far_field_keys() {
  using FarShape = FarFieldShape;
  static const KeyTable<FarField> keys{
      "geometry.far_field",
      {key<&FarField::shape>("shape",
                             choice<FarShape>({{"square", FarShape::square},
                                               {"rectangle", FarShape::rectangle},
                                               {"c", FarShape::rounded_front},
                                               {"circle", FarShape::circle}}),
                             "Shape of the boundary `farfield`, see below."),
       key<&FarField::radius>(
           "radius", number(io::Range::positive()),
           "Half width of the square, radius of the circle and of the half circle of `\"c\"`, distance of "
           "the rectangle from the bounding box of all other boundaries.",
           {.unit = "length", .required = {{"the size of the far field, as in radius = 50.0"}}}),
       key<&FarField::spacing>("spacing", number(io::Range::positive()),
                               "Cell size along it. `spacing` in `[boundary.farfield]` overrides it.",
                               {.unit = "length", .fallback = "`spacing.max`"})}};
  return keys;
}

const KeyTable<Settings>& spacing_keys() {
  static const KeyTable<Settings> keys{
      "spacing",
      {key<&Settings::min>(
           "min", number(io::Range::positive()),
           "No quadtree cell is split into cells smaller than this; see [available sizes](#available-sizes).",
           {.unit = "length",
            .fallback = "half the smallest requested size, where `curvature` does not count; smaller where "
                        "`gap` requires it"}),
       key<&Settings::max>("max", number(io::Range::positive()), "Largest cell size.",
                           {.unit = "length", .fallback = "a sixteenth of the domain"}),
       key<&Settings::mesh, &MeshOptions::size, &SizeOptions::gradation>(
           "gradation", number({1, 2, true, false}),
           "Growth limit g: at distance d from a cell of prescribed size h', the size is at most h' + "
           "(g-1)d/2."),
       key<&Settings::mesh, &MeshOptions::size, &SizeOptions::curvature>(
           "curvature", number({0, 180, true, false}),
           "Largest turning angle of the boundary per cell, down to the size `min`, which should then be "
           "given; feature points are excluded.",
           {.unit = "degrees", .fallback = "off"}),
       key<&Settings::mesh, &MeshOptions::size, &SizeOptions::gap>(
           "gap", number({0, 1000, true, false}),
           "Number of cells across the gap between two facing boundaries.", {.fallback = "off"}),
       key<&Settings::outline, &AssembleOptions::default_corner_degrees>(
           "corner", number({0, 180}),
           "Feature angle: a point where the boundary turns by more becomes a node of the mesh; 180 keeps "
           "none.",
           {.unit = "degrees"})}};
  return keys;
}

const KeyTable<SourceKeys>& source_keys() {
  using Numbers = std::vector<double>;
  static const KeyTable<SourceKeys> keys{
      "source",
      {key<&SourceKeys::box>("box", box(), "A rectangle. A source has one of `box`, `disc` and `line`."),
       key<&SourceKeys::disc>(
           "disc",
           numbers("`[x, y, radius]`", "[1, 2, 0.5]", 3, "[x, y, radius] with a radius above 0",
                   [](const Numbers& d) { return d[2] > 0; }),
           "A disc."),
       key<&SourceKeys::line>("line",
                              numbers("`[x0, y0, x1, y1]`", "[1, 2, 3, 2]", 4, "[x0, y0, x1, y1]",
                                      [](const Numbers&) { return true; }),
                              "A line."),
       key<&SourceKeys::spacing>(
           "spacing", number(io::Range::positive()),
           "Cells that intersect the shape are no larger than this.",
           {.unit = "length", .required = {{"the size of cells that meet the shape"}}})}};
  return keys;
}

const KeyTable<BlockRule>& block_keys() {
  static const KeyTable<BlockRule> keys{
      "block",
      {key<&BlockRule::name>("name", text(),
                             "Name of the block in the mesh. Blocks of one name are one block. Where blocks "
                             "overlap, the last one takes the place.",
                             {.required = {{"a word for the block, as in name = \"solid\""}}}),
       key<&BlockRule::boundaries>(
           "boundaries", texts(),
           "The boundaries around the block and around its holes, in any order and direction. A minus before "
           "a name, which denotes the opposite direction, is accepted and has no effect. A block has one of "
           "`boundaries`, `loop` and `inside`."),
       key<&BlockRule::loop>("loop", text(), "The closed boundary that encloses the block."),
       key<&BlockRule::inside>(
           "inside", point(),
           "A point inside the block, which extends from there to the nearest boundaries in all "
           "directions. Inner lines bound no block."),
       key<&BlockRule::spacing>("spacing", number(io::Range::positive()), "Largest cell size in the block.",
                                {.unit = "length", .fallback = "`spacing.max`"})}};
  return keys;
}

ValueForm<std::vector<Point>> path_of_line() {
  ValueForm<std::vector<Point>> form = points();
  form.text = "`[[x, y], ...]`";
  form.example = "[[0, 0], [1, 2]]";
  return form;
}

const KeyTable<LineRule>& line_keys() {
  static const KeyTable<LineRule> keys{
      "line",
      {key<&LineRule::name>(
           "name", text(),
           "Name of the line. `[boundary.NAME]` sets its `spacing` and `corner`. Required with `path`.",
           {.fallback = "the name in `boundary`", .example = "\"screen\""}),
       key<&LineRule::path>("path", path_of_line(),
                            "The points of the line, which is closed if it ends where it begins; a single "
                            "point becomes [a node](#single-points). A line has either `path` or "
                            "`boundary`."),
       key<&LineRule::boundary>("boundary", text(),
                                "A chain of the geometry that is an inner line, not a part of the outline."),
       key<&LineRule::spline>("spline", flag(),
                              "Join the points of `path` by cubic splines from corner to corner instead of "
                              "straight lines ([splines](#splines)).",
                              {.fallback = "`false`"}),
       key<&LineRule::baffle>("kind", choice<bool>({{"line", false}, {"baffle", true}}),
                              "`line`: a named row of edges. `baffle`: a wall of no thickness with nodes of "
                              "its own on each side.")}};
  return keys;
}

const KeyTable<Settings>& mesh_keys() {
  static const KeyTable<Settings> keys{
      "mesh",
      {key<&Settings::mesh, &MeshOptions::type>(
           "type",
           choice<MeshType>({{"hybrid", MeshType::hybrid},
                             {"delaunay", MeshType::delaunay},
                             {"metric", MeshType::metric}}),
           "Cells: quadrilaterals and triangles, or constrained Delaunay triangles, or triangles stretched "
           "by the solution; see [cell types](#cell-types).",
           {.example = "\"delaunay\""}),
       key<&Settings::mesh, &MeshOptions::quads>(
           "quads", choice<QuadChoice>({{"all", QuadChoice::all}, {"parallel", QuadChoice::parallel}}),
           "`parallel`: keep parallelograms only and divide the other quadrilaterals; see [cell "
           "types](#cell-types)."),
       key<&Settings::mesh, &MeshOptions::mirror>(
           "mirror", choice<MirrorAxis>({{"x", MirrorAxis::x}, {"y", MirrorAxis::y}}),
           "Make the mesh exactly symmetric about this axis ([symmetric "
           "meshes](../how-to/symmetric-meshes.md)).",
           {.fallback = "none",
            .needs = {{"half",
                       "a mesh of type = \"metric\" is not symmetric; mesh one half: add half = \"axis\"",
                       "type = \"metric\""}}}),
       key<&Settings::half>("half", half_domain(),
                            "Mesh only the half above the x axis (right of the y axis); the value names the "
                            "boundary along the axis.",
                            {.fallback = "none", .needs = {{"mirror", "of what it is the half"}}}),
       key<&Settings::root>(
           "root",
           numbers(
               "`[x0, y0, edge, columns, rows]`", "[-1, -1, 2, 3, 4]", 5,
               "[x0, y0, tree edge, trees along x, trees along y] with an edge above 0 and whole numbers of "
               "trees from 1 to 1024",
               [](const std::vector<double>& r) {
                 const auto is_count = [](double n) { return n == std::floor(n) && n >= 1 && n <= 1024; };
                 return r[2] > 0 && is_count(r[3]) && is_count(r[4]);
               }),
           "Lower left corner, edge and number of the root squares, for meshes that must share one "
           "background "
           "grid.",
           {.fallback = "from the geometry"}),
       key<&Settings::mesh, &MeshOptions::snap>("snap", number({0, 0.5, false, true}),
                                                "Snap tolerance as a fraction of the local cell size: grid "
                                                "vertices within it are moved onto the boundary.")}};
  return keys;
}

void read_geometry_table(const io::CaseTable& table, const std::string& case_path, Settings& settings) {
  geometry_keys().read(table, settings);
  const Placement& given = settings.placement;
  std::vector<GeometryInput>& files = settings.files;
  const auto folder = std::filesystem::path(case_path).parent_path();
  for (const std::string& file : given.files)
    files.push_back({(folder / file).string(),
                     fmt::format("{}: 'geometry.file'", table.place("file")),
                     {},
                     given.choice,
                     "none",
                     given.spline.value_or(io::is_airfoil_file(file))});
  const bool has_drawing = std::ranges::any_of(given.files, io::has_layers_of_drawings);
  if (!given.choice.layers.empty() && !has_drawing)
    table.refuse("layers", "chooses layers of drawings and maps, but no file is one");
  if (table.has("names") && !has_drawing)
    table.refuse("names", "names the boundaries of drawings and maps, but no file is one");
  share_out(table, "scale", given.scale, files,
            [](auto& file, double scale) { file.transform.scale = scale; });
  share_out(table, "rotate", given.rotate, files,
            [](auto& file, double turn) { file.transform.rotate_degrees = turn; });
  share_out(table, "rotate_about", given.rotate_about, files,
            [](auto& file, Point p) { file.transform.rotate_about = p; });
  share_out(table, "translate", given.translate, files,
            [](auto& file, Point p) { file.transform.translate = p; });
  share_out(table, "unit", given.unit, files, [](auto& file, const std::string& unit) { file.unit = unit; });
}

void read_spacing_table(const io::CaseTable& table, Settings& settings) {
  constexpr double height_share = 1.0 / 16;  // of the smallest cells, by which boundary nodes may move
  spacing_keys().read(table, settings);
  if (settings.min) settings.outline.chord_height = height_share * *settings.min;
  if (settings.mesh.size.curvature) settings.outline.cell_degrees = *settings.mesh.size.curvature;
  if (settings.min && settings.max && *settings.min > *settings.max)
    table.refuse("min", fmt::format("is {}, but must not be above spacing.max, which is {}", *settings.min,
                                    *settings.max));
}

SizeSource read_source(const io::CaseTable& table) {
  SourceKeys keys;
  source_keys().read(table, keys);
  const auto& [box, disc, line, spacing] = keys;
  if (int{!box.empty()} + int{!disc.empty()} + int{!line.empty()} != 1)
    throw InputError(table.place() +
                     ": a [[source]] needs exactly one of box = [x0, x1, y0, y1], disc = [x, y, radius], "
                     "line = [x0, y0, x1, y1]");
  if (!box.empty()) return {Box{{box[0], box[2]}, {box[1], box[3]}}, spacing, table.place()};
  if (!disc.empty()) return {SizeSource::Disc{{disc[0], disc[1]}, disc[2]}, spacing, table.place()};
  return {SizeSource::Line{{line[0], line[1]}, {line[2], line[3]}}, spacing, table.place()};
}

BlockRule read_block(const io::CaseTable& table) {
  BlockRule rule;
  block_keys().read(table, rule);
  const std::string& name = rule.name;
  const bool is_word = !name.empty() && name.front() != '#' &&
                       std::ranges::all_of(name, [](unsigned char c) { return c > ' ' && c != 127; });
  if (!is_word) table.refuse("name", "is no name for a block; give a word without blanks");
  if (int{!rule.boundaries.empty()} + int{!rule.loop.empty()} + int{rule.inside.has_value()} != 1)
    throw InputError(table.place() +
                     ": a [[block]] needs exactly one of boundaries = [\"A\", \"B\"], loop = \"A\", inside "
                     "= [x, y]");
  for (std::string& boundary : rule.boundaries) {
    if (boundary.starts_with('-')) boundary.erase(0, 1);
  }
  rule.where = table.place();
  return rule;
}

void read_line(const io::CaseTable& table, Settings& settings) {
  LineRule rule;
  line_keys().read(table, rule);
  rule.where = table.place();
  if (rule.path.empty() == rule.boundary.empty())
    throw InputError(rule.where + ": a [[line]] needs either path = [[0, 0], [1, 0]] or boundary = \"A\"");
  if (rule.name.empty()) rule.name = rule.boundary;
  if (rule.name.empty()) table.refuse("name", "is missing; give the line one, as in name = \"screen\"");
  if (table.has("name")) rule.name = boundary_name().read(table, "name");
  if (rule.spline && rule.path.empty())
    table.refuse("spline", "needs a path; the curves of boundary = \"" + rule.boundary +
                               "\" are those of its file or shape");
  if (rule.path.size() == 1 && rule.baffle)
    table.refuse("kind", "is \"baffle\", but the path has one point; give the baffle two points");
  if (rule.path.size() > 1 && std::ranges::count(rule.path, rule.path.front()) == std::ssize(rule.path))
    table.refuse("path", fmt::format("has no length: all its points are ({}, {}); give two different points",
                                     rule.path.front().x, rule.path.front().y));
  if (rule.path.size() == 1)
    settings.mesh.required_points.push_back({rule.name, rule.path.front(), rule.where});
  else
    settings.outline.lines.push_back(rule);
}

void read_mesh_table(const io::CaseTable& table, Settings& settings) {
  mesh_keys().read(table, settings);
  if (const std::vector<double>& r = settings.root; !r.empty())
    settings.mesh.size.root = RootOptions{{r[0], r[1]}, r[2], static_cast<int>(r[3]), static_cast<int>(r[4])};
  if (!settings.half) return;
  settings.mesh.mirror.reset();  // the half model is not symmetric
  settings.outline.rules.insert(
      settings.outline.rules.begin(),
      {settings.half->boundary, {}, {}, BoundaryCondition::symmetry, table.place("half"), false, true});
}

}  // namespace quadloop
