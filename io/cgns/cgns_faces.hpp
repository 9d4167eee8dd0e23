#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/model/file_mesh.hpp"

namespace quadloop::io {

/// The elements of a zone that may be on its boundary, BAR_2 or, in a 3D mesh, TRI_3 and QUAD_4, in the order
/// of its sections. Boundaries take them by their element numbers.
class CgnsFaces {
 public:
  using Face = FileBoundary::Face;

  void begin_section(const std::string& name) { sections_.push_back({name, faces_.size()}); }
  /// Adds a face to the last section.
  void add(std::int64_t element, const Face& face) { faces_.push_back({element, face, false}); }

  /// Call after the last section.
  void sort() {
    by_element_.resize(faces_.size());
    for (std::size_t i = 0; i < faces_.size(); ++i) by_element_[i] = i;
    std::ranges::stable_sort(by_element_, {}, [&](std::size_t i) { return faces_[i].element; });
  }

  std::size_t size() const { return faces_.size(); }

  /// Empty if no face has that number, or another boundary has taken it.
  std::optional<Face> take(std::int64_t element) {
    for (auto at = first_of(element); at != by_element_.end() && faces_[*at].element == element; ++at) {
      if (faces_[*at].taken) continue;
      faces_[*at].taken = true;
      return faces_[*at].nodes;
    }
    return {};
  }

  /// Returns the first face of that number, taken or not.
  std::optional<Face> find(std::int64_t element) const {
    const auto at = first_of(element);
    if (at == by_element_.end() || faces_[*at].element != element) return {};
    return faces_[*at].nodes;
  }

  /// Calls `visit(section's name, face)` for the faces not taken.
  template <class Visit>
  void for_each_left(const Visit& visit) const {
    for (std::size_t s = 0; s < sections_.size(); ++s) {
      const std::size_t end = s + 1 < sections_.size() ? sections_[s + 1].first : faces_.size();
      for (std::size_t i = sections_[s].first; i < end; ++i) {
        if (!faces_[i].taken) visit(sections_[s].name, faces_[i].nodes);
      }
    }
  }

 private:
  struct Section {
    std::string name;
    std::size_t first;  ///< index of its first face
  };
  struct Entry {
    std::int64_t element;
    Face nodes;
    bool taken;
  };

  std::vector<std::size_t>::const_iterator first_of(std::int64_t element) const {
    return std::ranges::lower_bound(by_element_, element, {},
                                    [&](std::size_t i) { return faces_[i].element; });
  }

  std::vector<Section> sections_;
  std::vector<Entry> faces_;
  std::vector<std::size_t> by_element_;
};

}  // namespace quadloop::io
