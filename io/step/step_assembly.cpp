#include "io/step/step_assembly.hpp"

#include <string_view>
#include <utility>
#include <variant>

#include "io/step/step_curves.hpp"

namespace quadloop::io {

namespace {

SpaceMotion motion_to(const StepPlacement& place) { return {place.x, place.y, place.z, place.origin}; }

SpaceMotion inverse(const SpaceMotion& motion) {
  const auto& [x, y, z, origin] = motion;
  SpaceMotion back{
      {{x.at[0], y.at[0], z.at[0]}}, {{x.at[1], y.at[1], z.at[1]}}, {{x.at[2], y.at[2], z.at[2]}}, {}};
  back.origin = -1 * back.of_vector(origin);
  return back;
}

/// The motion that moves one placement onto another one.
SpaceMotion motion_between(const StepEntity& entity, const StepEntity& from, const StepEntity& to) {
  if (from.number() == to.number()) return {};
  if (!from.is("AXIS2_PLACEMENT_3D") || !to.is("AXIS2_PLACEMENT_3D"))
    entity.refuse("moves a part by a " + std::string(to.type()) +
                  ", which is not read; export the part alone");
  const SpaceMotion first = motion_to(placement_of(from)), second = motion_to(placement_of(to));
  return first == second ? SpaceMotion() : second.after(inverse(first));
}

}  // namespace

SpacePoint SpaceMotion::of_vector(const SpacePoint& v) const {
  return v.at[0] * x + v.at[1] * y + v.at[2] * z;
}

SpaceMotion SpaceMotion::after(const SpaceMotion& first) const {
  return {of_vector(first.x), of_vector(first.y), of_vector(first.z), of_point(first.origin)};
}

SpaceCurve SpaceMotion::of_curve(SpaceCurve curve) const {
  if (*this == SpaceMotion()) return curve;
  curve.first = of_point(curve.first);
  curve.last = of_point(curve.last);
  if (auto* spline = std::get_if<SpaceSpline>(&curve.shape)) {
    for (SpacePoint& pole : spline->poles) pole = of_point(pole);
  } else {
    auto& arc = std::get<SpaceArc>(curve.shape);
    arc.centre = of_point(arc.centre);
    arc.major = of_vector(arc.major);
    arc.minor = of_vector(arc.minor);
  }
  return curve;
}

bool is_shape(const StepEntity& entity) {
  const std::string_view type = entity.type();
  if (type == "CONTEXT_DEPENDENT_SHAPE_REPRESENTATION") return false;
  return entity.is("SHAPE_REPRESENTATION") || type.ends_with("_SHAPE_REPRESENTATION") ||
         type == "GEOMETRICALLY_BOUNDED_2D_WIREFRAME_REPRESENTATION";
}

StepAssembly::StepAssembly(const Part21File& file) {
  find_assemblies(file);
  for (std::size_t i = 0; i < file.size(); ++i) {
    const StepEntity entity = file.entity(i);
    if (entity.is("SHAPE_REPRESENTATION_RELATIONSHIP")) add_relationship(entity);
    if (is_shape(entity)) add_mapped_items(entity);
  }
  for (const auto& [child, part] : links_)
    parts_[group_of(child)].push_back({group_of(part.parent), part.motion});
}

/// The product of an assembly tells which of two related representations contains the other one: programs
/// write them in either order.
void StepAssembly::find_assemblies(const Part21File& file) {
  std::unordered_map<Number, Number> shapes;  // product definition -> representation
  for (std::size_t i = 0; i < file.size(); ++i) {
    const StepEntity entity = file.entity(i);
    if (!entity.is("SHAPE_DEFINITION_REPRESENTATION")) continue;
    const StepValues own = entity.own("PROPERTY_DEFINITION_REPRESENTATION", 0);
    const StepEntity definition = own[0].entity();
    if (definition.is("PRODUCT_DEFINITION_SHAPE"))
      shapes[definition.own("PROPERTY_DEFINITION", 0)[2].entity().number()] = own[1].entity().number();
  }
  for (std::size_t i = 0; i < file.size(); ++i) {
    const StepEntity entity = file.entity(i);
    if (!entity.is("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION")) continue;
    const StepValues own = entity.own("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION", 0);
    const StepEntity usage = own[1].entity().own("PROPERTY_DEFINITION", 0)[2].entity();
    if (!usage.is("NEXT_ASSEMBLY_USAGE_OCCURRENCE")) continue;
    const Number product = usage.own("PRODUCT_DEFINITION_RELATIONSHIP", 0)[3].entity().number();
    if (const auto shape = shapes.find(product); shape != shapes.end())
      assemblies_[own[0].entity().number()] = shape->second;
  }
}

void StepAssembly::add_relationship(const StepEntity& relationship) {
  const StepValues own = relationship.own("REPRESENTATION_RELATIONSHIP", 0);
  Number child = own[2].entity().number(), parent = own[3].entity().number();
  if (!relationship.is("REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION")) {
    groups_[group_of(child)] = group_of(parent);
    return;
  }
  const StepEntity moved = relationship.own("REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION", 4)[0].entity();
  if (!moved.is("ITEM_DEFINED_TRANSFORMATION"))
    relationship.refuse("moves a part by a " + moved.title() + ", which is not read; export the part alone");
  const StepValues items = moved.own("ITEM_DEFINED_TRANSFORMATION", 2);
  SpaceMotion motion = motion_between(relationship, items[0].entity(), items[1].entity());
  if (const auto found = assemblies_.find(relationship.number());
      found != assemblies_.end() && found->second == child) {
    std::swap(child, parent);
    motion = motion == SpaceMotion() ? motion : inverse(motion);
  }
  links_.push_back({child, {parent, motion}});
}

void StepAssembly::add_mapped_items(const StepEntity& representation) {
  for (const StepValue value : representation.own("REPRESENTATION", 0)[1].list()) {
    const StepEntity item = value.entity();
    if (!item.is("MAPPED_ITEM")) continue;
    const StepValues own = item.own("MAPPED_ITEM", 1), map = own[0].entity().own("REPRESENTATION_MAP", 0);
    links_.push_back({map[1].entity().number(),
                      {representation.number(), motion_between(item, map[0].entity(), own[1].entity())}});
  }
}

StepAssembly::Number StepAssembly::group_of(Number representation) {
  Number root = representation;
  for (auto above = groups_.find(root); above != groups_.end() && above->second != root;
       above = groups_.find(root))
    root = above->second;
  for (auto above = groups_.find(representation); above != groups_.end() && above->second != root;) {
    above = groups_.find(std::exchange(above->second, root));
  }
  return root;
}

const std::vector<SpaceMotion>& StepAssembly::places_of(const StepEntity& representation) {
  return places_of_group(group_of(representation.number()), representation, 0);
}

const std::vector<SpaceMotion>& StepAssembly::places_of_group(Number group, const StepEntity& representation,
                                                              int depth) {
  constexpr std::size_t most = 100000;
  if (const auto found = places_.find(group); found != places_.end()) return found->second;
  if (depth > deepest_nesting)
    representation.refuse("is part of an assembly that contains itself, or is nested too deep");
  std::vector<SpaceMotion> places;
  const auto parts = parts_.find(group);
  if (parts == parts_.end()) places.emplace_back();
  for (std::size_t i = 0; parts != parts_.end() && i < parts->second.size(); ++i) {
    const auto& [parent, motion] = parts->second[i];
    for (const SpaceMotion& place : places_of_group(parent, representation, depth + 1)) {
      if (++count_ > most)
        representation.refuse("is part of an assembly with more than 100000 parts; export the part alone");
      places.push_back(motion == SpaceMotion() ? place : place.after(motion));
    }
  }
  return places_[group] = std::move(places);
}

}  // namespace quadloop::io
