#pragma once

#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "io/step/part21.hpp"
#include "io/step/space_curve.hpp"

namespace quadloop::io {

/// A rigid motion: what becomes of the axes and of the origin.
struct SpaceMotion {
  SpacePoint x{{1, 0, 0}}, y{{0, 1, 0}}, z{{0, 0, 1}}, origin;

  friend bool operator==(const SpaceMotion&, const SpaceMotion&) = default;
  SpacePoint of_vector(const SpacePoint& v) const;
  SpacePoint of_point(const SpacePoint& p) const { return origin + of_vector(p); }
  /// This motion after another one.
  SpaceMotion after(const SpaceMotion& first) const;
  SpaceCurve of_curve(SpaceCurve curve) const;
};

/// Whether a representation has the shape of a part.
bool is_shape(const StepEntity& entity);

/// Where the parts of an assembly are: by relationships of representations with a transformation, and by
/// mapped items.
class StepAssembly {
 public:
  /// Throws InputError for motions that are not rigid.
  explicit StepAssembly(const Part21File& file);

  /// The places of a representation in the whole: the one without motion if it is no part of another, one for
  /// each path of parts else. Throws InputError for an assembly that contains itself, and for more than
  /// 100000 places.
  const std::vector<SpaceMotion>& places_of(const StepEntity& representation);

 private:
  using Number = std::uint64_t;
  /// A representation within another one.
  struct Part {
    Number parent;
    SpaceMotion motion;
  };

  void add_relationship(const StepEntity& relationship);
  void add_mapped_items(const StepEntity& representation);
  void find_assemblies(const Part21File& file);
  Number group_of(Number representation);
  const std::vector<SpaceMotion>& places_of_group(Number group, const StepEntity& representation, int depth);

  std::unordered_map<Number, Number> groups_;  ///< representations of one shape, as a forest
  std::vector<std::pair<Number, Part>> links_;
  std::unordered_map<Number, std::vector<Part>> parts_;  ///< by group
  std::unordered_map<Number, std::vector<SpaceMotion>> places_;
  std::unordered_map<Number, Number> assemblies_;  ///< relationship -> representation of the assembly
  std::size_t count_ = 0;
};

}  // namespace quadloop::io
