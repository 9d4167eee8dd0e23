#include "mesher/geometry/assemble/shapes.hpp"

#include <numbers>
#include <span>
#include <utility>

#include "mesher/geometry/assemble/curved_chain.hpp"

namespace quadloop {

namespace {

/// A closed chain whose direction does not matter.
Chain closed_chain(const std::string& name, std::vector<Point> points, const std::string& source) {
  return {name, false, std::move(points), source, false};
}

}  // namespace

Chain circle(const std::string& name, Point centre, double radius, const std::string& source) {
  Chain chain = closed_chain(name, {centre + Point{radius, 0}}, source);
  append_arc(chain, {centre, {radius, 0}, {0, radius}, 0, 2 * std::numbers::pi}, chain.points.front());
  chain.points.pop_back();
  return chain;
}

Chain rectangle(const std::string& name, const Box& box, const std::string& source) {
  const auto [low, high] = box;
  return closed_chain(name, {low, {high.x, low.y}, high, {low.x, high.y}}, source);
}

Chain polygon(const std::string& name, std::vector<Point> points, const std::string& source) {
  return closed_chain(name, std::move(points), source);
}

Chain open_curve(const std::string& name, std::vector<Point> points, const std::string& source) {
  return {name, true, std::move(points), source, false};
}

Chain naca_chain(const std::string& name, const NacaAirfoil& airfoil, const std::string& source) {
  constexpr double spacing = 0.01;
  const std::vector<std::vector<Point>> parts = smooth_parts(airfoil);
  Chain chain = closed_chain(name, {parts.front().front()}, source);
  for (const std::vector<Point>& part : parts) append_spline(chain, std::span(part).subspan(1));
  chain.points.pop_back();
  for (Curve& curve : chain.curves) {
    if (!curve.straight()) curve.spacing = spacing;
  }
  return chain;
}

}  // namespace quadloop
