#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesher/base/ids.hpp"

namespace quadloop {

/// The BAR_2 elements of a zone, in the order of its sections, until boundaries take them by their element
/// numbers.
class CgnsBars {
 public:
  using Edge = std::array<NodeId, 2>;

  void begin_section(const std::string& name) { sections_.push_back({name, bars_.size()}); }
  /// To the section that was begun last.
  void add(std::int64_t element, const Edge& edge) { bars_.push_back({element, edge, false}); }

  /// All sections are there.
  void sort() {
    by_element_.resize(bars_.size());
    for (std::size_t i = 0; i < bars_.size(); ++i) by_element_[i] = i;
    std::stable_sort(by_element_.begin(), by_element_.end(),
                     [&](std::size_t a, std::size_t b) { return bars_[a].element < bars_[b].element; });
  }

  std::size_t size() const { return bars_.size(); }

  /// Nothing where no bar has that number, or another boundary has taken it.
  std::optional<Edge> take(std::int64_t element) {
    auto at = std::lower_bound(by_element_.begin(), by_element_.end(), element,
                               [&](std::size_t i, std::int64_t n) { return bars_[i].element < n; });
    for (; at != by_element_.end() && bars_[*at].element == element; ++at) {
      if (bars_[*at].taken) continue;
      bars_[*at].taken = true;
      return bars_[*at].edge;
    }
    return {};
  }

  /// The first bar of that number, taken or not.
  std::optional<Edge> find(std::int64_t element) const {
    const auto at = std::lower_bound(by_element_.begin(), by_element_.end(), element,
                                     [&](std::size_t i, std::int64_t n) { return bars_[i].element < n; });
    if (at == by_element_.end() || bars_[*at].element != element) return {};
    return bars_[*at].edge;
  }

  /// `visit(section's name, edge)` for those that nobody took.
  template <class Visit>
  void for_each_left(const Visit& visit) const {
    for (std::size_t s = 0; s < sections_.size(); ++s) {
      const std::size_t end = s + 1 < sections_.size() ? sections_[s + 1].first : bars_.size();
      for (std::size_t i = sections_[s].first; i < end; ++i) {
        if (!bars_[i].taken) visit(sections_[s].name, bars_[i].edge);
      }
    }
  }

 private:
  struct Section {
    std::string name;
    std::size_t first;  ///< of its bars
  };
  struct Bar {
    std::int64_t element;
    Edge edge;
    bool taken;
  };

  std::vector<Section> sections_;
  std::vector<Bar> bars_;
  std::vector<std::size_t> by_element_;
};

}  // namespace quadloop
