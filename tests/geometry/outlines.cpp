#include "tests/geometry/outlines.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesher/base/error.hpp"

namespace quadloop::test {

Chain closed(const std::string& name, std::vector<Point> points) {
  return {name, false, std::move(points), "test:" + name};
}

Chain open(const std::string& name, std::vector<Point> points) {
  return {name, true, std::move(points), "test:" + name};
}

Chain square(const std::string& name, Point c, double w) {
  return closed(name, {{c.x - w, c.y - w}, {c.x + w, c.y - w}, {c.x + w, c.y + w}, {c.x - w, c.y + w}});
}

Chain reversed(Chain chain) {
  std::reverse(chain.points.begin(), chain.points.end());
  return chain;
}

double loop_area(const Geometry& geometry, std::int32_t loop) {
  double sum = 0;
  for (std::int32_t v = geometry.loop_start(loop); v < geometry.loop_start(loop + 1); ++v) {
    sum += cross(geometry.point(v), geometry.point(geometry.next(v)));
  }
  return 0.5 * sum;
}

std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "a refusal is one line";
    return error.what();
  }
  ADD_FAILURE() << "nothing was refused";
  return {};
}

}  // namespace quadloop::test
