#include "mesher/mesh/periodic_images.hpp"

#include <fmt/format.h>

#include <array>

#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

constexpr std::size_t most_maps = 3;
constexpr std::int32_t powers = 32;  ///< a shift is a number in this base, with digits from -15 to 15
constexpr int node_bits = 44;        ///< of an image number; the shift is above
constexpr std::int64_t node_mask = (std::int64_t{1} << node_bits) - 1;

/// The powers of the maps in a shift.
std::array<std::int32_t, most_maps> digits_of(PeriodicShift shift) {
  std::array<std::int32_t, most_maps> digits{};
  for (std::int32_t& digit : digits) {
    digit = ((shift % powers) + powers) % powers;
    if (digit >= powers / 2) digit -= powers;
    shift = (shift - digit) / powers;
  }
  return digits;
}

bool are_inverse(const PeriodicPair& a, const PeriodicPair& b) {
  return a.degrees == -b.degrees && a.centre == b.centre && a.translation == -1.0 * b.translation;
}

bool are_equal(const PeriodicPair& a, const PeriodicPair& b) {
  return a.degrees == b.degrees && a.centre == b.centre && a.translation == b.translation;
}

}  // namespace

PeriodicMaps::PeriodicMaps(const std::vector<PeriodicPair>& pairs) {
  for (const PeriodicPair& pair : pairs) {
    PeriodicShift shift = 1, of_pair = 0;
    for (const PeriodicPair& map : maps_) {
      if (are_equal(map, pair)) of_pair = shift;
      if (are_inverse(map, pair)) of_pair = -shift;
      shift *= powers;
    }
    if (of_pair == 0) {
      of_pair = shift;
      maps_.push_back(pair);
    }
    of_pairs_.push_back(of_pair);
    const bool commute = maps_.size() == 1 || (!maps_.front().rotates() && !pair.rotates());
    if (!commute || maps_.size() > most_maps)
      throw InputError(
          fmt::format("the map of the pair '{}' and '{}' cannot be combined with those of the "
                      "other pairs: the solver takes one rotation, or up to {} translations",
                      pair.from, pair.to, most_maps));
  }
}

Point PeriodicMaps::image(PeriodicShift shift, Point p) const {
  const std::array digits = digits_of(shift);
  for (std::size_t m = 0; m < maps_.size(); ++m) {
    for (std::int32_t k = 0; k < digits[m]; ++k) p = maps_[m].image(p);
    for (std::int32_t k = 0; k > digits[m]; --k) p = maps_[m].source(p);
  }
  return p;
}

double PeriodicMaps::degrees(PeriodicShift shift) const {
  return maps_.empty() ? 0 : digits_of(shift)[0] * maps_.front().degrees;
}

GlobalNodeId image_number(GlobalNodeId node, PeriodicShift shift) {
  return GlobalNodeId{node.value() | (std::int64_t{static_cast<std::uint16_t>(shift)} << node_bits)};
}

GlobalNodeId original_of(GlobalNodeId image) { return GlobalNodeId{image.value() & node_mask}; }

PeriodicShift shift_of(GlobalNodeId image) {
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(image.value() >> node_bits));
}

}  // namespace quadloop
