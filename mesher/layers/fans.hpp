#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "mesher/base/communicator.hpp"
#include "mesher/layers/fan_rows.hpp"
#include "mesher/layers/front_places.hpp"

namespace quadloop {

/// A node of the front in a fan.
struct Ray {
  std::int32_t fan = 0;  ///< its first station
  FrontPlace place;
  GlobalNodeId node;      ///< its number in the mesh outside
  GlobalNodeId numbered;  ///< its number in the mesh with layers, once there is one
  Point point;
};

/// The fans of a wall, with all of their rays on each rank.
class Fans {
 public:
  /// `front` must outlive it.
  explicit Fans(const LayerFront& front);

  /// The first station of the fan to which the place belongs, or WallLine::none.
  std::int32_t fan_of(const FrontPlace& place) const;
  /// Takes the rays that each rank knows, in the place of those before. *Collective.*
  void gather(const Communicator& comm, const std::vector<Ray>& own);

  /// Of one fan, in the order of the front.
  std::span<const Ray> rays_of(std::int32_t fan) const;
  /// The number of the ray on which the node stands, among those of its fan.
  std::int32_t ray_on(std::int32_t fan, GlobalNodeId node) const;
  const FanRows& rows_of(std::int32_t fan) const { return rows_.at(fan); }

 private:
  const LayerFront* front_;
  std::vector<std::int32_t> first_of_;  ///< of each station: the first one of its fan, or none
  std::vector<Ray> rays_;               ///< of all fans, in order
  std::map<std::int32_t, FanRows> rows_;
};

}  // namespace quadloop
