#include "mesher/grid/size_options.hpp"

#include <algorithm>

namespace quadloop {

bool meets(const SizeSource& source, const Box& box) {
  if (const auto* area = std::get_if<Box>(&source.shape)) return area->meets(box);
  if (const auto* disc = std::get_if<SizeSource::Disc>(&source.shape)) {
    const Point nearest{std::clamp(disc->centre.x, box.low.x, box.high.x),
                        std::clamp(disc->centre.y, box.low.y, box.high.y)};
    return length(nearest - disc->centre) <= disc->radius;
  }
  if (const auto* block = std::get_if<SizeSource::Block>(&source.shape)) return block->region->meets(box);
  const auto& line = std::get<SizeSource::Line>(source.shape);
  if (!box_of(source).meets(box)) return false;
  const auto side = [&](Point p) { return cross(line.to - line.from, p - line.from); };
  const double a = side(box.low), b = side({box.high.x, box.low.y}), c = side(box.high),
               d = side({box.low.x, box.high.y});
  return std::min({a, b, c, d}) <= 0 && std::max({a, b, c, d}) >= 0;
}

Box box_of(const SizeSource& source) {
  if (const auto* area = std::get_if<Box>(&source.shape)) return *area;
  if (const auto* block = std::get_if<SizeSource::Block>(&source.shape)) return block->region->box();
  if (const auto* disc = std::get_if<SizeSource::Disc>(&source.shape)) {
    const Point reach{disc->radius, disc->radius};
    return {disc->centre - reach, disc->centre + reach};
  }
  const auto& line = std::get<SizeSource::Line>(source.shape);
  Box box;
  box.include(line.from);
  box.include(line.to);
  return box;
}

}  // namespace quadloop
