#include "mesher/layers/fans.hpp"

#include <algorithm>
#include <tuple>

namespace quadloop {

Fans::Fans(const LayerFront& front) : front_{&front}, first_of_(front.line.size(), WallLine::none) {
  const WallLine& line = front.line;
  for (std::int32_t i = 0; i < line.size(); ++i) {
    if (line[i].shape != Station::Shape::fan) continue;
    const std::int32_t before = line.previous(i);
    const bool goes_on =
        before != WallLine::none && line[before].shape == Station::Shape::fan && line.width(before) == 0;
    first_of_[i] = goes_on && before < i ? first_of_[before] : i;
  }
}

std::int32_t Fans::fan_of(const FrontPlace& place) const {
  const bool beyond = !place.at_station() && front_->line.width(place.station) > 0;
  return beyond ? WallLine::none : first_of_[place.station];
}

void Fans::gather(const Communicator& comm, const std::vector<Ray>& own) {
  rays_ = comm.all_gather_values(std::span<const Ray>(own));
  std::ranges::sort(rays_, {},
                    [](const Ray& r) { return std::tuple(r.fan, r.place.station, r.place.share); });
  rows_.clear();
  for (std::size_t i = 0; i < rays_.size();) {
    const std::int32_t fan = rays_[i].fan;
    const auto rays = rays_of(fan);
    std::vector<Point> directions;
    for (const Ray& ray : rays) directions.push_back(unit(ray.point - front_->line[fan].wall));
    rows_.emplace(fan, FanRows(directions, front_->line.spec(fan).count));
    i += rays.size();
  }
}

std::span<const Ray> Fans::rays_of(std::int32_t fan) const {
  const auto [begin, end] = std::ranges::equal_range(rays_, fan, {}, &Ray::fan);
  return {begin, end};
}

std::int32_t Fans::ray_on(std::int32_t fan, GlobalNodeId node) const {
  const auto rays = rays_of(fan);
  return static_cast<std::int32_t>(std::ranges::find(rays, node, &Ray::node) - rays.begin());
}

}  // namespace quadloop
