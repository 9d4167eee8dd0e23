#include "mesher/geometry/assemble/stray_chains.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "mesher/base/ids.hpp"
#include "mesher/geometry/box_tree.hpp"

namespace quadloop {

namespace {

/// Length of the control polygon.
double length_of(const Chain& chain) {
  double sum = 0;
  Point last = chain.points.front();
  const auto go_to = [&](Point p) {
    sum += length(p - last);
    last = p;
  };
  for (std::size_t i = 1; i < chain.points.size(); ++i) {
    if (!chain.curves.empty()) std::ranges::for_each(chain.curves[i - 1].inner, go_to);
    go_to(chain.points[i]);
  }
  return sum;
}

/// The ends of open chains that meet no other end.
class LoosePlaces {
 public:
  explicit LoosePlaces(const std::vector<Chain>& chains) {
    for (const Chain& chain : chains) {
      if (!chain.open) continue;
      ++ends_[chain.points.front()];
      ++ends_[chain.points.back()];
    }
    for (const auto& [place, ends] : ends_) {
      if (ends == 1) places_.push_back(place);
    }
    tree_ = BoxTree(size32(places_), [&](std::int32_t i) { return Box{places_[i], places_[i]}; });
  }

  bool is_stray(const Chain& chain) const {
    constexpr double of_own_ends = 0.5, of_other_ends = 0.01;
    const Point front = chain.points.front(), back = chain.points.back();
    if (!chain.open || chain.directed || ends_.at(front) != 1 || ends_.at(back) != 1) return false;
    const double size = length_of(chain);
    return length(back - front) >= of_own_ends * size && !others_near(front, of_other_ends * size) &&
           !others_near(back, of_other_ends * size);
  }

 private:
  bool others_near(Point place, double distance) const {
    const Point reach{distance, distance};
    return tree_.any_meeting({place - reach, place + reach}, [&](std::int32_t i) {
      return places_[i] != place && length(places_[i] - place) < distance;
    });
  }

  std::map<Point, int> ends_;
  std::vector<Point> places_;
  BoxTree tree_;
};

}  // namespace

void leave_out_strays(std::vector<Chain>& chains, const std::string& far_field,
                      std::vector<std::string>& warnings) {
  constexpr std::size_t most_named = 5;
  const LoosePlaces loose(chains);
  const auto is_stray = [&](const Chain& chain) { return loose.is_stray(chain); };
  const bool all = std::ranges::all_of(chains, [&](const Chain& chain) {
    return is_stray(chain) || (!far_field.empty() && chain.source == far_field);
  });
  if (all) return;
  std::size_t count = 0;
  std::vector<std::string> sources;
  std::erase_if(chains, [&](const Chain& chain) {
    if (!is_stray(chain)) return false;
    if (++count <= most_named) sources.push_back(chain.source);
    return true;
  });
  if (count == 0) return;
  const std::string more = count > most_named ? fmt::format("; and {} more", count - most_named) : "";
  const bool one = count == 1;
  warnings.push_back(
      fmt::format("left out {} line{} that {} no other line: {}{}; if {} part of an outline, make {} ends "
                  "meet those of other lines",
                  count, one ? "" : "s", one ? "joins" : "join", fmt::join(sources, "; "), more,
                  one ? "it is" : "they are", one ? "its" : "their"));
}

}  // namespace quadloop
