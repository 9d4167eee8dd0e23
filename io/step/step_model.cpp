#include "io/step/step_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "io/step/step_assembly.hpp"
#include "io/step/step_curves.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

/// What an entity takes over from those that contain it.
struct Inherited {
  std::string name, layer;
  double radians = 1;
  int depth = 0;
};

/// Layers of entities, and those that are invisible.
class StepLayers {
 public:
  explicit StepLayers(const Part21File& file) {
    for (std::size_t i = 0; i < file.size(); ++i) {
      const StepEntity entity = file.entity(i);
      if (entity.is("PRESENTATION_LAYER_ASSIGNMENT")) {
        const StepValues own = entity.own("PRESENTATION_LAYER_ASSIGNMENT", 0);
        const std::string name = own[0].text();
        for (const StepValue item : own[2].list()) layers_.try_emplace(styled(item.entity()).number(), name);
        numbers_.emplace(entity.number(), name);
      }
      if (entity.is("INVISIBILITY")) {
        for (const StepValue item : entity.own("INVISIBILITY", 0)[0].list())
          invisible_.insert(styled(item.entity()).number());
      }
    }
    for (const auto& [number, name] : numbers_) {
      if (invisible_.contains(number)) hidden_layers_.insert(name);
    }
  }

  /// Null if the entity has no layer of its own.
  const std::string* layer_of(const StepEntity& entity) const {
    const auto found = layers_.find(entity.number());
    return found == layers_.end() ? nullptr : &found->second;
  }
  bool is_invisible(const StepEntity& entity) const { return invisible_.contains(entity.number()); }
  bool is_hidden(const std::string& layer) const { return hidden_layers_.contains(layer); }

 private:
  /// The item of a STYLED_ITEM; any other entity itself.
  static StepEntity styled(const StepEntity& entity) {
    return entity.is("STYLED_ITEM") ? entity.own("STYLED_ITEM", 2)[0].entity() : entity;
  }

  std::unordered_map<std::uint64_t, std::string> layers_, numbers_;
  std::unordered_set<std::uint64_t> invisible_;
  std::set<std::string> hidden_layers_;
};

/// An edge of a face, and how many faces have it.
struct FaceEdge {
  StepEntity edge;
  Inherited inherited;
  int uses = 0;
};

/// Collects the curves of one representation after another.
class StepCollector {
 public:
  StepCollector(const Part21File& file, const DrawingChoice& choice, StepModel& model)
      : file_{file}, choice_{choice}, layers_{file}, assembly_{file}, model_{model} {}

  void collect() {
    for (std::size_t i = 0; i < file_.size(); ++i) {
      if (const StepEntity entity = file_.entity(i); is_shape(entity)) read_representation(entity);
    }
  }

 private:
  void read_representation(const StepEntity& representation) {
    const StepValues own = representation.own("REPRESENTATION", 0);
    const StepUnits units = own[2].is_omitted() ? StepUnits() : units_of(own[2].entity());
    if (representation.type().starts_with("TESSELLATED")) return skip(std::string(representation.type()));
    Inherited inherited;
    inherited.radians = units.radians;
    const std::size_t before = model_.curves.size();
    read_all(own[1].list(), inherited_by(representation, inherited));
    add_edges_of_faces();
    if (model_.curves.size() == before) return;
    move_to_places(representation, before);
    if (units_are_known_ && (units.metres != model_.units.metres || units.length != model_.units.length))
      representation.refuse(
          fmt::format("is in {}, but other parts of the file are in {}; export all in one unit",
                      units.length.empty() ? "no unit" : units.length,
                      model_.units.length.empty() ? "no unit" : model_.units.length));
    model_.units = units;
    units_are_known_ = true;
  }

  void add_edges_of_faces() {
    for (const std::uint64_t number : edge_order_) {
      const auto& [edge, inherited, uses] = edges_.at(number);
      if (!is_chosen(edge, inherited.layer)) continue;
      if (uses > 1)
        ++model_.inner_edges;
      else
        add_edge(edge, inherited);
    }
    edges_.clear();
    edge_order_.clear();
  }

  /// Moves the curves from `first` on to the place of the representation, and copies them to its other
  /// places.
  void move_to_places(const StepEntity& representation, std::size_t first) {
    const std::vector<StepCurve> own(model_.curves.begin() + first, model_.curves.end());
    model_.curves.erase(model_.curves.begin() + first, model_.curves.end());
    const std::vector<SpaceMotion>& places = assembly_.places_of(representation);
    refuse_many_copies(representation, own, places.size());
    for (const SpaceMotion& place : places) {
      for (StepCurve curve : own) {
        curve.curve = place.of_curve(std::move(curve.curve));
        model_.curves.push_back(std::move(curve));
      }
    }
  }

  static void refuse_many_copies(const StepEntity& representation, std::span<const StepCurve> curves,
                                 std::size_t places) {
    constexpr double most_points = 1e7;
    double points = 0;
    for (const StepCurve& curve : curves) points += static_cast<double>(sample_of(curve.curve).size());
    if (places > 1 && points * static_cast<double>(places) > most_points)
      representation.refuse(fmt::format(
          "has {} places in an assembly, which makes more than 1e7 points; export the part alone", places));
  }

  Inherited inherited_by(const StepEntity& entity, Inherited from) const {
    if (const std::string* layer = layers_.layer_of(entity)) from.layer = *layer;
    ++from.depth;
    return from;
  }

  void read_all(const StepValues& items, const Inherited& inherited) {
    for (const StepValue item : items) read(item.entity(), inherited);
  }

  void read(const StepEntity& entity, const Inherited& from) {
    if (from.depth > deepest_nesting)
      entity.refuse("refers to itself, or items are nested too deep; export the file again");
    if (entity.is("AXIS2_PLACEMENT_3D") || entity.is("AXIS2_PLACEMENT_2D") || entity.is("MAPPED_ITEM") ||
        !read_.insert(entity.number()).second)
      return;
    const Inherited inherited = inherited_by(entity, from);
    if (choice_.layers.empty() && layers_.is_invisible(entity))
      return skip(fmt::format("invisible {}", entity.type()));
    if (entity.is("ADVANCED_FACE") || entity.is("FACE_SURFACE")) return read_face(entity, inherited);
    if (!read_container(entity, inherited) && is_chosen(entity, inherited.layer))
      read_leaf(entity, inherited);
  }

  /// Whether an entity of a layer is to be read; counts it if the layer is invisible.
  bool is_chosen(const StepEntity& entity, const std::string& layer) {
    model_.layers.insert(layer);
    if (!choice_.has_layer(layer)) return false;
    const bool hidden = choice_.layers.empty() && layers_.is_hidden(layer);
    if (hidden) skip(fmt::format("{} on invisible layer '{}'", entity.type(), layer));
    return !hidden;
  }

  /// Reads the items of an entity that contains others; returns whether it is one.
  bool read_container(const StepEntity& entity, const Inherited& inherited) {
    if (entity.is("GEOMETRIC_CURVE_SET") || entity.is("GEOMETRIC_SET"))
      read_all(entity.own("GEOMETRIC_SET", 1)[0].list(), inherited);
    else if (entity.is("EDGE_BASED_WIREFRAME_MODEL"))
      read_all(entity.own("EDGE_BASED_WIREFRAME_MODEL", 1)[0].list(), inherited);
    else if (entity.is("SHELL_BASED_WIREFRAME_MODEL"))
      read_all(entity.own("SHELL_BASED_WIREFRAME_MODEL", 1)[0].list(), inherited);
    else if (entity.is("WIRE_SHELL"))
      read_all(entity.own("WIRE_SHELL", 1)[0].list(), inherited);
    else if (entity.is("CONNECTED_EDGE_SET"))
      read_all(entity.own("CONNECTED_EDGE_SET", 1)[0].list(), inherited);
    else if (entity.is("SHELL_BASED_SURFACE_MODEL"))
      read_all(entity.own("SHELL_BASED_SURFACE_MODEL", 1)[0].list(), inherited);
    else if (entity.is("FACE_BASED_SURFACE_MODEL"))
      read_all(entity.own("FACE_BASED_SURFACE_MODEL", 1)[0].list(), inherited);
    else if (entity.is("OPEN_SHELL") || entity.is("CLOSED_SHELL") || entity.is("CONNECTED_FACE_SET"))
      read_all(entity.own("CONNECTED_FACE_SET", 1)[0].list(), inherited);
    else if (entity.is("ORIENTED_FACE"))
      read(entity.own("ORIENTED_FACE", 2)[0].entity(), inherited);
    else if (entity.is("COMPOSITE_CURVE") || entity.is("BOUNDARY_CURVE") || entity.is("OUTER_BOUNDARY_CURVE"))
      read_composite(entity, inherited);
    else if (entity.is("EDGE_LOOP"))
      read_loop(entity, inherited);
    else
      return false;
    return true;
  }

  void read_composite(const StepEntity& curve, Inherited inherited) {
    if (const std::string name = curve.name(); !name.empty()) inherited.name = name;
    for (const StepValue item : curve.own("COMPOSITE_CURVE", 1)[0].list()) {
      const StepEntity segment = item.entity();
      if (!segment.is("REPARAMETRISED_COMPOSITE_CURVE_SEGMENT")) segment.require("COMPOSITE_CURVE_SEGMENT");
      read(segment.own("COMPOSITE_CURVE_SEGMENT", 0)[2].entity(), inherited);
    }
  }

  /// The edges of a wire.
  void read_loop(const StepEntity& loop, const Inherited& inherited) {
    for (const StepValue item : loop.own("PATH", 1)[0].list()) read(edge_of(item.entity()), inherited);
  }

  static StepEntity edge_of(const StepEntity& edge) {
    return edge.is("ORIENTED_EDGE") ? edge.own("ORIENTED_EDGE", 3)[0].entity() : edge;
  }

  void read_leaf(const StepEntity& entity, const Inherited& inherited) {
    if (entity.is("EDGE_CURVE") || entity.is("ORIENTED_EDGE")) return add_edge(edge_of(entity), inherited);
    if (entity.is("MANIFOLD_SOLID_BREP") || entity.is("BREP_WITH_VOIDS") || entity.is("FACETED_BREP"))
      return read_solid(entity, inherited);
    if (entity.is("POLY_LOOP")) return add_poly_loop(entity, inherited);
    if (!is_bounded_curve(entity)) return skip(std::string(entity.type()));
    add(entity, bounded_curve(entity, inherited.radians), inherited);
  }

  /// A solid with a single face, as some programs write a sheet.
  void read_solid(const StepEntity& solid, const Inherited& inherited) {
    const StepEntity shell = solid.own("MANIFOLD_SOLID_BREP", 1)[0].entity();
    const StepValues faces = shell.own("CONNECTED_FACE_SET", 1)[0].list();
    if (faces.size() != 1)
      solid.refuse(
          fmt::format("is a solid with {} faces, but the geometry must be plane; export one planar face, a "
                      "sketch or a section of it",
                      faces.size()));
    read_all(faces, inherited);
  }

  void read_face(const StepEntity& face, Inherited inherited) {
    if (const std::string name = face.name(); !name.empty()) inherited.name = name;
    if (is_on_chosen_layer(face, inherited)) require_plane(face);
    for (const StepValue value : face.own("FACE", 1)[0].list()) {
      const StepEntity bound = value.entity(), loop = bound.own("FACE_BOUND", 1)[0].entity();
      if (loop.is("EDGE_LOOP"))
        count_edges(loop, inherited);
      else if (is_chosen(loop, inherited.layer) && loop.is("POLY_LOOP"))
        add_poly_loop(loop, inherited);
    }
  }

  /// Whether the face or an edge of it is on a chosen layer.
  bool is_on_chosen_layer(const StepEntity& face, const Inherited& inherited) const {
    if (choice_.has_layer(inherited.layer)) return true;
    for (const StepValue value : face.own("FACE", 1)[0].list()) {
      const StepEntity loop = value.entity().own("FACE_BOUND", 1)[0].entity();
      if (!loop.is("EDGE_LOOP")) continue;
      for (const StepValue edge : loop.own("PATH", 1)[0].list()) {
        if (choice_.has_layer(inherited_by(edge_of(edge.entity()), inherited).layer)) return true;
      }
    }
    return false;
  }

  static void require_plane(const StepEntity& face) {
    const StepEntity surface = face.own("FACE_SURFACE", 2)[0].entity();
    if (!surface.is("PLANE"))
      face.refuse(fmt::format(
          "lies on a {}, but only planar faces are read; export one planar face, or its edges as a "
          "wireframe",
          surface.title()));
  }

  void count_edges(const StepEntity& loop, const Inherited& inherited) {
    for (const StepValue value : loop.own("PATH", 1)[0].list()) {
      const StepEntity edge = edge_of(value.entity());
      const auto [found, is_new] =
          edges_.try_emplace(edge.number(), FaceEdge{edge, inherited_by(edge, inherited), 0});
      if (is_new) edge_order_.push_back(edge.number());
      ++found->second.uses;
    }
  }

  void add_edge(const StepEntity& edge, Inherited inherited) {
    double deviation = 0;
    edge.require("EDGE_CURVE");
    std::vector<SpaceCurve> curves = curve_of_edge(edge, inherited.radians, deviation);
    model_.largest_deviation = std::max(model_.largest_deviation, deviation);
    const StepEntity geometry = edge.own("EDGE_CURVE", 3)[0].entity();
    for (const StepEntity& inner : {without_surface(geometry), geometry}) {
      if (const std::string name = inner.name(); !name.empty()) inherited.name = name;
    }
    add(edge, std::move(curves), inherited);
  }

  void add_poly_loop(const StepEntity& loop, const Inherited& inherited) {
    std::vector<SpacePoint> points;
    for (const StepValue value : loop.own("POLY_LOOP", 1)[0].list())
      points.push_back(point_of(value.entity()));
    if (points.size() < 3) loop.refuse("has fewer than three points; export the file again");
    points.push_back(points.front());
    const SpacePoint first = points.front();
    add(loop, {{polyline(std::move(points)), first, first}}, inherited);
  }

  void add(const StepEntity& entity, std::vector<SpaceCurve> curves, const Inherited& inherited) {
    const std::string own = entity.name();
    if (curves.empty()) skip(fmt::format("{} without length", entity.type()));
    for (SpaceCurve& curve : curves)
      model_.curves.push_back(
          {std::move(curve), own.empty() ? inherited.name : own, inherited.layer, entity});
  }

  void skip(const std::string& kind) { model_.left_out.add(kind); }

  const Part21File& file_;
  const DrawingChoice& choice_;
  StepLayers layers_;
  StepAssembly assembly_;
  StepModel& model_;
  std::unordered_set<std::uint64_t> read_;  ///< entities that are read; each is read once
  std::unordered_map<std::uint64_t, FaceEdge> edges_;
  std::vector<std::uint64_t> edge_order_;
  bool units_are_known_ = false;
};

}  // namespace

StepModel read_step_model(const Part21File& file, const DrawingChoice& choice) {
  StepModel model;
  StepCollector(file, choice, model).collect();
  model.layers.erase("");
  return model;
}

}  // namespace quadloop::io
