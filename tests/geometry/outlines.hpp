#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop::test {

Chain closed(const std::string& name, std::vector<Point> points);
Chain open(const std::string& name, std::vector<Point> points);

/// An axis-parallel square around a centre, counter-clockwise.
Chain square(const std::string& name, Point centre, double half_width);
Chain reversed(Chain chain);

/// Of the loop, positive where it is counter-clockwise.
double loop_area(const Geometry& geometry, std::int32_t loop);

/// The message of the InputError that the call must throw.
std::string refusal(const std::function<void()>& call);

}  // namespace quadloop::test
