#include "quadloop/case/shape_settings.hpp"

#include "mesher/base/error.hpp"
#include "mesher/geometry/assemble/naca_section.hpp"
#include "mesher/geometry/assemble/shapes.hpp"

namespace quadloop {

namespace {

using Kind = ShapeKeys::Kind;

/// Calls `make`; its InputErrors become those of the key.
template <class Make>
auto of_key(const io::CaseTable& table, const std::string& key, const Make& make) {
  try {
    return make();
  } catch (const InputError& error) {
    table.refuse(key, std::string("is wrong: ") + error.what());
  }
}

ValueForm<std::string> naca_code() {
  return {"text", "\"2412\"", [](const io::CaseTable& table, const std::string& key) {
            const std::string code = *table.text(key);
            of_key(table, key, [&] { return NacaSection(code, true); });
            return code;
          }};
}

ValueForm<std::vector<double>> hinge() {
  return {"number, or `[x, y]`", "0.7", [](const io::CaseTable& table, const std::string& key) {
            std::vector<double> numbers = table.numbers_or_one(key);
            if (numbers.size() != 1 && numbers.size() != 2)
              table.refuse(key, "must be a place on the chord, or [x, y]");
            return numbers;
          }};
}

Chain chain_of(const io::CaseTable& table, const ShapeKeys& shape) {
  const std::string where = table.place();
  const std::vector<double>& box = shape.box;
  switch (shape.kind) {
    case Kind::circle: return circle(shape.name, shape.centre, shape.radius, where);
    case Kind::rectangle: return rectangle(shape.name, {{box[0], box[2]}, {box[1], box[3]}}, where);
    case Kind::polygon: return polygon(shape.name, shape.points, where);
    case Kind::curve: return open_curve(shape.name, shape.points, where);
    case Kind::naca: break;
  }
  return of_key(table, "flap", [&] { return naca_chain(shape.name, shape.naca, where); });
}

std::vector<Key<ShapeKeys>> kind_keys() {
  const std::vector<KeyNeed> for_naca{{"kind = \"naca\""}};
  return {
      key<&ShapeKeys::name>("name", boundary_name(), "Name of the boundary.",
                            {.required = {{"the name of the boundary"}}}),
      key<&ShapeKeys::kind>("kind",
                            choice<Kind>({{"naca", Kind::naca},
                                          {"circle", Kind::circle},
                                          {"rectangle", Kind::rectangle},
                                          {"polygon", Kind::polygon},
                                          {"curve", Kind::curve}}),
                            "Kind of the shape. A `curve` is open: curves that meet at their ends form an "
                            "outline with a name for each side."),
      key<&ShapeKeys::naca, &NacaAirfoil::code>(
          "code", naca_code(),
          "NACA section of four digits (`2412`), four digits modified (`0012-64`) or five digits (`23012`). "
          "The chord is 1, from the origin to (1, 0).",
          {.needs = for_naca, .required = {{"as in code = \"2412\"", "kind = \"naca\""}}}),
      key<&ShapeKeys::naca, &NacaAirfoil::sharp>(
          "sharp", flag(), "Sharp trailing edge. `false`: the blunt trailing edge of the original formula.",
          {.example = "false", .needs = for_naca}),
      key<&ShapeKeys::naca, &NacaAirfoil::flap_degrees>(
          "flap", number({-90, 90}), "Angle of a plain flap, positive if its trailing edge moves down.",
          {.unit = "degrees", .needs = for_naca}),
      key<&ShapeKeys::naca, &NacaAirfoil::hinge>(
          "hinge", hinge(), "Hinge of the flap: its place on the chord, on the camber line; or its x and y.",
          {.fallback = "0.75", .needs = {{"flap", "the angle in degrees"}}})};
}

std::vector<Key<ShapeKeys>> form_keys() {
  return {key<&ShapeKeys::centre>("centre", point(), "Centre of the circle.",
                                  {.fallback = "the origin", .needs = {{"kind = \"circle\""}}}),
          key<&ShapeKeys::radius>("radius", number(io::Range::positive()), "Radius of the circle.",
                                  {.unit = "length",
                                   .needs = {{"kind = \"circle\""}},
                                   .required = {{"the radius of the circle", "kind = \"circle\""}}}),
          key<&ShapeKeys::box>("box", box(), "The rectangle.",
                               {.needs = {{"kind = \"rectangle\""}},
                                .required = {{"[x0, x1, y0, y1]", "kind = \"rectangle\""}}}),
          key<&ShapeKeys::points>(
              "points", points(), "The points of the polygon or curve, in order.",
              {.example = "[[0, 0], [3, 0], [0, 4]]",
               .needs = {{"kind = \"polygon\" or kind = \"curve\""}},
               .required = {{"the points, [[x, y], ...]", "kind = \"polygon\" or kind = \"curve\""}}}),
          key<&ShapeKeys::spline>("spline", flag(),
                                  "Cubic splines through the points, from corner to corner, as for "
                                  "[files](#geometry). `false`: straight lines.",
                                  {.example = "true", .needs = {{"points"}}})};
}

std::vector<Key<ShapeKeys>> placement_keys() {
  return {key<&ShapeKeys::placement, &Transform::scale>("scale", number(io::Range::positive()),
                                                        "Scale factor about the origin; of an airfoil the "
                                                        "chord."),
          key<&ShapeKeys::placement, &Transform::rotate_degrees>(
              "rotate", number(),
              "Rotation after scaling, counter-clockwise, about `rotate_about`. An angle of attack of 9 "
              "degrees is `rotate = -9`.",
              {.unit = "degrees"}),
          key<&ShapeKeys::placement, &Transform::rotate_about>(
              "rotate_about", point(), "Centre of rotation, in scaled coordinates.",
              {.fallback = "the origin", .needs = {{"rotate", "the angle in degrees"}}}),
          key<&ShapeKeys::placement, &Transform::translate>(
              "translate", point(), "Translation after the rotation.", {.fallback = "`[0, 0]`"})};
}

}  // namespace

const KeyTable<ShapeKeys>& shape_keys() {
  static const KeyTable<ShapeKeys> keys{"shape",
                                        joined<ShapeKeys>({kind_keys(), form_keys(), placement_keys()})};
  return keys;
}

Shape read_shape(const io::CaseTable& table) {
  ShapeKeys keys;
  shape_keys().read(table, keys);
  std::vector<Chain> chains{chain_of(table, keys)};
  quadloop::apply(keys.placement, chains);  // not std::apply
  return {std::move(chains.front()), keys.kind == Kind::naca, keys.spline};
}

}  // namespace quadloop
