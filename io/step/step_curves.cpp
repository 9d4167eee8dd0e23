#include "io/step/step_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace quadloop::io {

namespace {

std::string text_of(const SpacePoint& p) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.at[0], p.at[1], p.at[2]);
}

SpacePoint triple_of(const StepEntity& entity, const StepValues& list) {
  SpacePoint p;
  std::size_t count = 0;
  for (const StepValue value : list) {
    if (count < 3) p.at[count] = value.number();
    ++count;
  }
  if (count < 2 || count > 3) entity.refuse(fmt::format("has {} coordinates, but 2 or 3 are needed", count));
  return p;
}

SpacePoint unit_of(const StepEntity& entity, const SpacePoint& vector) {
  const double size = length(vector);
  if (!(size > 0) || !std::isfinite(size))
    entity.refuse("the direction has no length; export the file again");
  return (1 / size) * vector;
}

SpacePoint direction_of(const StepEntity& entity) {
  entity.require("DIRECTION");
  return unit_of(entity, triple_of(entity, entity.own("DIRECTION", 1)[0].list()));
}

/// One end of a trimmed curve or an edge.
struct TrimEnd {
  std::optional<SpacePoint> point;
  std::optional<double> parameter;
};

/// A part of a curve, along its direction.
struct Trim {
  TrimEnd from, to;
  bool is_whole_turn = false;  ///< both ends are one vertex
};

TrimEnd trim_end(const StepEntity& curve, const StepValues& list) {
  TrimEnd end;
  for (const StepValue value : list) {
    if (value.is_record("PARAMETER_VALUE"))
      end.parameter = value.number();
    else
      end.point = point_of(value.entity());
  }
  if (!end.point && !end.parameter) curve.refuse("an end has neither a point nor a parameter");
  return end;
}

/// Distances of the given ends from the curve, relative to its size.
struct Deviation {
  double largest = 0;

  void take(const StepEntity& curve, const SpacePoint& given, const SpacePoint& on_curve, double size) {
    constexpr double farthest = 1e-3;
    const double distance = length(given - on_curve);
    if (distance > farthest * size)
      curve.refuse(
          fmt::format("its end {} is {:.3g} off the curve, which ends at {}; repair the geometry in the CAD "
                      "program",
                      text_of(given), distance, text_of(on_curve)));
    largest = std::max(largest, distance);
  }
};

std::vector<double> knots_of(const StepEntity& curve, const StepValues& own, std::size_t count) {
  std::vector<double> knots, values;
  for (const StepValue value : own[1].list()) values.push_back(value.number());
  std::size_t i = 0;
  for (const StepValue multiplicity : own[0].list()) {
    const int times = multiplicity.small_integer();
    if (i >= values.size() || times < 1 || knots.size() + times > count) break;
    knots.insert(knots.end(), times, values[i++]);
  }
  if (i != values.size() || knots.size() != count)
    curve.refuse(
        fmt::format("its knots and multiplicities do not make {} knots; export the file again", count));
  return knots;
}

/// Knots 0, 1, 2, ... with the multiplicities of BEZIER_CURVE, QUASI_UNIFORM_CURVE and UNIFORM_CURVE.
std::vector<double> implied_knots(const StepEntity& curve, int degree, std::size_t poles) {
  const std::size_t count = poles + degree + 1;
  std::vector<double> knots;
  if (curve.is("UNIFORM_CURVE")) {
    for (std::size_t i = 0; i < count; ++i) knots.push_back(static_cast<double>(i) - degree);
    return knots;
  }
  const std::size_t inner = curve.is("BEZIER_CURVE") ? degree : 1;
  knots.assign(degree + 1, 0);
  for (double knot = 1; knots.size() + degree + 1 < count; ++knot) knots.insert(knots.end(), inner, knot);
  knots.insert(knots.end(), degree + 1, knots.back() + 1);
  return knots;
}

bool is_bspline(const StepEntity& curve) {
  return curve.is("B_SPLINE_CURVE") || curve.is("B_SPLINE_CURVE_WITH_KNOTS") || curve.is("BEZIER_CURVE") ||
         curve.is("QUASI_UNIFORM_CURVE") || curve.is("UNIFORM_CURVE");
}

SpaceSpline bspline_of(const StepEntity& curve) {
  SpaceSpline spline;
  const StepValues own = curve.own("B_SPLINE_CURVE", 1);
  spline.degree = own[0].small_integer();
  for (const StepValue pole : own[1].list()) spline.poles.push_back(point_of(pole.entity()));
  if (spline.degree < 1 || spline.poles.size() <= static_cast<std::size_t>(spline.degree))
    curve.refuse(
        fmt::format("its degree {} does not suit {} control points", spline.degree, spline.poles.size()));
  spline.knots = curve.is("B_SPLINE_CURVE_WITH_KNOTS")
                     ? knots_of(curve, curve.own("B_SPLINE_CURVE_WITH_KNOTS", 6),
                                spline.poles.size() + spline.degree + 1)
                     : implied_knots(curve, spline.degree, spline.poles.size());
  if (curve.is_complex() && curve.is("RATIONAL_B_SPLINE_CURVE")) {
    for (const StepValue weight : curve.own("RATIONAL_B_SPLINE_CURVE", 0)[0].list())
      spline.weights.push_back(weight.number());
  }
  if (const std::string fault = fault_of(spline); !fault.empty()) curve.refuse(fault);
  return spline;
}

SpaceSpline polyline_of(const StepEntity& curve) {
  std::vector<SpacePoint> points;
  for (const StepValue value : curve.own("POLYLINE", 1)[0].list()) {
    const SpacePoint p = point_of(value.entity());
    if (points.empty() || p != points.back()) points.push_back(p);
  }
  if (points.size() < 2) curve.refuse("has fewer than two different points");
  return polyline(std::move(points));
}

double size_of(const SpaceSpline& spline) {
  double size = 0;
  for (const SpacePoint& p : spline.poles) size = std::max(size, length(p - spline.poles.front()));
  return size;
}

bool is_closed(const SpaceSpline& spline) {
  constexpr double rounding = 1e-9;
  return length(spline.point_at(spline.begin()) - spline.point_at(spline.end())) <=
         rounding * size_of(spline);
}

/// The whole B-spline; its ends become equal if they differ by rounding.
SpaceCurve whole(SpaceSpline spline) {
  const SpacePoint first = spline.point_at(spline.begin());
  const SpacePoint last = is_closed(spline) ? first : spline.point_at(spline.end());
  return {std::move(spline), first, last};
}

/// The parameter of an end of a part, and its coordinates.
struct SplineEnd {
  double parameter;
  SpacePoint point;
};

SplineEnd spline_end(const StepEntity& curve, const SpaceSpline& spline, const TrimEnd& end,
                     Deviation& deviation) {
  constexpr double rounding = 1e-9;
  const double size = size_of(spline);
  const auto clamped = [&](double t) {
    const double range = spline.end() - spline.begin();
    if (is_closed(spline) && t > spline.end()) t -= range * std::floor((t - spline.begin()) / range);
    return std::clamp(t, spline.begin(), spline.end());
  };
  if (!end.point) {
    const double t = clamped(*end.parameter);
    return {t, spline.point_at(t)};
  }
  const auto is_there = [&](double t) { return length(spline.point_at(t) - *end.point) <= rounding * size; };
  if (end.parameter && is_there(clamped(*end.parameter))) return {clamped(*end.parameter), *end.point};
  for (const double t : {spline.begin(), spline.end()}) {
    if (is_there(t)) return {t, *end.point};
  }
  const double t = nearest_parameter(spline, *end.point);
  deviation.take(curve, *end.point, spline.point_at(t), size);
  return {t, *end.point};
}

void add_part(std::vector<SpaceCurve>& curves, const SpaceSpline& spline, const SplineEnd& from,
              const SplineEnd& to) {
  constexpr double rounding = 1e-11;
  if (to.parameter - from.parameter > rounding * (spline.end() - spline.begin()))
    curves.push_back({part_of(spline, from.parameter, to.parameter), from.point, to.point});
}

/// The part of a B-spline between two ends; of a closed one that in its direction.
std::vector<SpaceCurve> trimmed(const StepEntity& curve, const SpaceSpline& spline, const Trim& trim,
                                Deviation& deviation) {
  const SplineEnd from = spline_end(curve, spline, trim.from, deviation);
  SplineEnd to = spline_end(curve, spline, trim.to, deviation);
  std::vector<SpaceCurve> parts;
  const bool closed = is_closed(spline);
  if (closed && to.parameter == spline.begin()) to.parameter = spline.end();
  if (from.parameter < to.parameter) {
    add_part(parts, spline, from, to);
  } else if (closed && (from.parameter > to.parameter || trim.is_whole_turn)) {
    const SplineEnd seam{spline.end(), spline.point_at(spline.begin())};
    add_part(parts, spline, from, seam);
    add_part(parts, spline, {spline.begin(), seam.point}, to);
  } else {
    add_part(parts, spline, to, from);
  }
  return parts;
}

SpaceArc conic_of(const StepEntity& curve) {
  const StepPlacement place = placement_of(curve.own("CONIC", 1)[0].entity());
  const bool is_circle = curve.is("CIRCLE");
  const StepValues own = curve.own(is_circle ? "CIRCLE" : "ELLIPSE", 2);
  const double first = own[0].number(), second = is_circle ? first : own[1].number();
  if (!(first > 0) || !(second > 0)) curve.refuse("a radius is not positive; export the file again");
  return {place.origin, first * place.x, second * place.y, 0, 2 * std::numbers::pi};
}

SpaceCurve whole(const SpaceArc& arc) { return {arc, arc.point_at(0), arc.point_at(0)}; }

/// The part of an ellipse from one end to the other, counter-clockwise about its axis.
std::vector<SpaceCurve> trimmed(const StepEntity& curve, SpaceArc arc, const Trim& trim, double radians,
                                Deviation& deviation) {
  constexpr double turn = 2 * std::numbers::pi, rounding = 1e-12;
  const double size = std::max(length(arc.major), length(arc.minor));
  const auto angle_of = [&](const TrimEnd& end) {
    return end.point ? arc.parameter_of(*end.point) : *end.parameter * radians;
  };
  const double from = angle_of(trim.from), to = angle_of(trim.to);
  const SpacePoint first = trim.from.point.value_or(arc.point_at(from));
  SpacePoint last = trim.to.point.value_or(arc.point_at(to));
  const double sweep = std::fmod(std::fmod(to - from, turn) + turn, turn);
  const bool is_whole = length(first - last) <= rounding * size;
  if (is_whole) last = first;
  arc.begin = std::remainder(from, turn);
  arc.end = arc.begin + (is_whole || sweep == 0 ? turn : sweep);
  const double reach = size * std::min(1.0, arc.end - arc.begin);
  deviation.take(curve, first, arc.point_at(from), reach);
  deviation.take(curve, last, arc.point_at(to), reach);
  return {{arc, first, last}};
}

/// The part of a line.
std::vector<SpaceCurve> trimmed_line(const StepEntity& line, const Trim& trim) {
  const StepValues own = line.own("LINE", 1);
  const StepEntity vector = own[1].entity();
  vector.require("VECTOR");
  const StepValues of_vector = vector.own("VECTOR", 1);
  const auto at = [&](const TrimEnd& end) {
    if (end.point) return *end.point;
    return point_of(own[0].entity()) +
           (*end.parameter * of_vector[1].number()) * direction_of(of_vector[0].entity());
  };
  const SpacePoint from = at(trim.from), to = at(trim.to);
  if (from == to) return {};
  return {{polyline({from, to}), from, to}};
}

std::vector<SpaceCurve> trimmed_curve(const StepEntity& basis, const Trim& trim, double radians,
                                      Deviation& deviation) {
  if (basis.is("LINE")) return trimmed_line(basis, trim);
  if (basis.is("CIRCLE") || basis.is("ELLIPSE"))
    return trimmed(basis, conic_of(basis), trim, radians, deviation);
  if (basis.is("POLYLINE")) return trimmed(basis, polyline_of(basis), trim, deviation);
  if (is_bspline(basis)) return trimmed(basis, bspline_of(basis), trim, deviation);
  basis.refuse("curves of this type are not read; convert it to a B-spline in the CAD program");
}

/// The curve below trimmed curves; `is_same` is inverted for each that has the other direction.
StepEntity untrimmed(StepEntity curve, bool& is_same) {
  for (int depth = 0; depth < deepest_nesting; ++depth) {
    curve = without_surface(curve);
    if (!curve.is("TRIMMED_CURVE")) return curve;
    const StepValues own = curve.own("TRIMMED_CURVE", 1);
    is_same = is_same == own[3].flag();
    curve = own[0].entity();
  }
  curve.refuse("refers to itself, or curves are nested too deep; export the file again");
}

Trim directed(TrimEnd from, TrimEnd to, bool is_same) {
  if (!is_same) std::swap(from, to);
  const bool is_whole_turn = from.point && to.point && *from.point == *to.point;
  return {std::move(from), std::move(to), is_whole_turn};
}

std::vector<SpaceCurve> read_trimmed(const StepEntity& curve, double radians) {
  const StepValues own = curve.own("TRIMMED_CURVE", 1);
  bool is_same = own[3].flag(), is_same_below = true;
  const StepEntity basis = untrimmed(own[0].entity(), is_same_below);
  const TrimEnd from = trim_end(curve, own[1].list()), to = trim_end(curve, own[2].list());
  if (!is_same_below && !(from.point && to.point))
    curve.refuse(
        "is a part by parameters of a reversed trimmed curve, which is not read; export the points of its "
        "ends");
  Deviation deviation;
  return trimmed_curve(basis, directed(from, to, is_same == is_same_below), radians, deviation);
}

}  // namespace

SpacePoint point_of(const StepEntity& entity) {
  if (entity.is("VERTEX_POINT")) {
    const StepEntity point = entity.own("VERTEX_POINT", 1)[0].entity();
    if (!point.is("VERTEX_POINT")) return point_of(point);
  }
  entity.require("CARTESIAN_POINT");
  return triple_of(entity, entity.own("CARTESIAN_POINT", 1)[0].list());
}

StepPlacement placement_of(const StepEntity& entity) {
  StepPlacement place{{}, {{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}};
  const bool is_plane = entity.is("AXIS2_PLACEMENT_2D");
  if (!is_plane) entity.require("AXIS2_PLACEMENT_3D");
  place.origin = point_of(entity.own("PLACEMENT", 1)[0].entity());
  SpacePoint towards = place.x;
  if (is_plane) {
    const StepValue direction = entity.own("AXIS2_PLACEMENT_2D", 2)[0];
    if (!direction.is_omitted()) towards = direction_of(direction.entity());
  } else {
    const StepValues own = entity.own("AXIS2_PLACEMENT_3D", 2);
    if (!own[0].is_omitted()) place.z = direction_of(own[0].entity());
    if (place.z.at[1] == 0 && place.z.at[2] == 0) towards = {{0, 1, 0}};
    if (!own[1].is_omitted()) towards = direction_of(own[1].entity());
  }
  place.x = unit_of(entity, towards - dot(towards, place.z) * place.z);
  place.y = cross(place.z, place.x);
  return place;
}

StepEntity without_surface(const StepEntity& curve) {
  StepEntity inner = curve;
  for (int depth = 0; depth < deepest_nesting; ++depth) {
    const bool is_wrapped =
        inner.is("SURFACE_CURVE") || inner.is("SEAM_CURVE") || inner.is("INTERSECTION_CURVE");
    if (!is_wrapped) return inner;
    inner = inner.own("SURFACE_CURVE", 1)[0].entity();
  }
  curve.refuse("refers to itself, or curves are nested too deep; export the file again");
}

bool is_bounded_curve(const StepEntity& entity) {
  const StepEntity curve = without_surface(entity);
  return curve.is("POLYLINE") || curve.is("CIRCLE") || curve.is("ELLIPSE") || curve.is("TRIMMED_CURVE") ||
         is_bspline(curve);
}

std::vector<SpaceCurve> bounded_curve(const StepEntity& entity, double radians) {
  const StepEntity curve = without_surface(entity);
  if (curve.is("TRIMMED_CURVE")) return read_trimmed(curve, radians);
  if (curve.is("CIRCLE") || curve.is("ELLIPSE")) return {whole(conic_of(curve))};
  if (curve.is("POLYLINE")) return {whole(polyline_of(curve))};
  if (is_bspline(curve)) return {whole(bspline_of(curve))};
  curve.refuse("curves of this type are not read; convert it to a B-spline in the CAD program");
}

std::vector<SpaceCurve> curve_of_edge(const StepEntity& edge, double radians, double& off) {
  const StepValues vertices = edge.own("EDGE", 1), own = edge.own("EDGE_CURVE", 3);
  const TrimEnd from{point_of(vertices[0].entity()), std::nullopt},
      to{point_of(vertices[1].entity()), std::nullopt};
  bool is_same = own[1].flag();
  const StepEntity curve = untrimmed(own[0].entity(), is_same);
  Deviation deviation;
  std::vector<SpaceCurve> curves = trimmed_curve(curve, directed(from, to, is_same), radians, deviation);
  off = deviation.largest;
  return curves;
}

}  // namespace quadloop::io
