#include "adapt/remesh/streamlines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "adapt/transfer/linear_values.hpp"
#include "adapt/transfer/locate/cell_triangles.hpp"
#include "adapt/transfer/locate/locate_points.hpp"
#include "mesher/geometry/box_tree.hpp"
#include "mesher/layers/front/wall_line.hpp"
#include "mesher/mesh/cells/cells_round_nodes.hpp"
#include "mesher/mesh/variable_names.hpp"

namespace quadloop::adapt {

namespace {

/// The indices of both components of the velocity, or else of the momentum.
std::optional<std::array<std::size_t, 2>> direction_in(const std::vector<std::string>& names) {
  for (const char* what : {"velocity", "momentum"}) {
    const auto x = only_variable_like(names, std::string("x_") + what),
               y = only_variable_like(names, std::string("y_") + what);
    if (x && y) return std::array{*x, *y};
  }
  return std::nullopt;
}

/// Unit vectors of the flow at places that all ranks ask for; empty where there is none. Each rank searches
/// its own cells. Of several triangles at a place the one with the lowest number counts.
class FlowAt {
 public:
  /// *Collective.*
  FlowAt(const Communicator& comm, const Mesh& mesh, const Field& direction)
      : comm_{comm},
        mesh_{mesh},
        field_{with_ghosts(comm, mesh, direction)},
        triangles_{cell_triangles(comm, mesh, centre_of_nodes(comm, mesh))},
        tree_(size32(triangles_), [this](std::int32_t k) {
          Box box;
          for (const Point p : corners(k)) box.include(p);
          return box;
        }) {}

  struct Answer {
    bool is_inside = false;
    std::optional<Point> direction;
  };
  /// *Collective.*
  std::vector<Answer> at(const std::vector<Point>& places) const {
    std::vector<Found> own;
    for (const Point p : places) own.push_back(found_at(p));
    const std::vector<Found> all = comm_.all_gather_values(std::span<const Found>(own));
    std::vector<Answer> answers;
    for (std::size_t i = 0; i < places.size(); ++i) {
      Found first;
      for (std::size_t k = i; k < all.size(); k += places.size()) {
        if (all[k].triangle < first.triangle) first = all[k];
      }
      answers.push_back({first.triangle != nowhere, {}});
      const double speed = length(first.flow);
      if (speed > 0 && std::isfinite(speed)) answers.back().direction = unit(first.flow);
    }
    return answers;
  }

 private:
  static constexpr std::int64_t nowhere = std::numeric_limits<std::int64_t>::max();
  struct Found {
    std::int64_t triangle = nowhere;  ///< its global number
    Point flow;
  };

  std::array<Point, 3> corners(std::int32_t k) const {
    const auto& [a, b, c] = triangles_[k].nodes;
    return {mesh_.point(a), mesh_.point(b), mesh_.point(c)};
  }
  Found found_at(Point p) const {
    Found found;
    tree_.for_each_meeting({p, p}, [&](std::int32_t k) {
      if (triangles_[k].number >= found.triangle || !contains(corners(k), p)) return;
      const auto& [a, b, c] = triangles_[k].nodes;
      std::array<double, 2> flow{};
      interpolate_in_triangle(corners(k), {field_.row(a), field_.row(b), field_.row(c)}, p, flow);
      found = {triangles_[k].number, {flow[0], flow[1]}};
    });
    return found;
  }

  const Communicator& comm_;
  const Mesh& mesh_;
  Field field_;
  std::vector<CellTriangle> triangles_;
  BoxTree tree_;
};

/// The streamlines during the integration.
class Growing {
 public:
  Growing(const FlowAt& flow, const std::vector<StreamlineStart>& starts)
      : flow_{flow}, starts_{starts}, lines_(starts.size()), left_(starts.size()) {
    for (std::size_t i = 0; i < starts.size(); ++i) {
      lines_[i].points = {starts[i].edge};
      active_.push_back(i);
    }
  }

  /// The first pieces. *Collective.*
  void start() {
    constexpr double least_cosine = 0.5;
    const auto answers =
        ask([&](std::size_t i) { return starts_[i].edge + starts_[i].offset * starts_[i].bisector; });
    const auto begin = [&](std::size_t i, Point flow) {
      const StreamlineStart& from = starts_[i];
      if (dot(flow, from.bisector) < least_cosine) return end(i, Streamline::End::no_start);
      first_.resize(starts_.size());
      first_[i] = unit(flow + from.bisector);
      lines_[i].points.push_back(from.edge + from.offset * first_[i]);
      left_[i] = from.length - from.offset;
      if (left_[i] <= 0) end(i, Streamline::End::complete);
    };
    visit(answers, begin, Streamline::End::no_start);
  }

  /// A step of all that have not ended; returns whether there are any. *Collective.*
  bool step() {
    if (active_.empty()) return false;
    std::vector<Point> middle(starts_.size());
    visit(
        ask([&](std::size_t i) { return last(i); }),
        [&](std::size_t i, Point flow) { middle[i] = last(i) + 0.5 * width(i) * flow; },
        Streamline::End::reversed);
    const auto move = [&](std::size_t i, Point flow) {
      if (dot(flow, first_[i]) <= 0) return end(i, Streamline::End::reversed);
      const double wide = width(i);
      lines_[i].points.push_back(last(i) + wide * flow);
      left_[i] -= wide;
      if (left_[i] <= 0) end(i, Streamline::End::complete);
    };
    visit(ask([&](std::size_t i) { return middle[i]; }), move, Streamline::End::reversed);
    return !active_.empty();
  }

  std::vector<Streamline> lines() && { return std::move(lines_); }

 private:
  Point last(std::size_t i) const { return lines_[i].points.back(); }
  double width(std::size_t i) const { return std::min(starts_[i].step, left_[i]); }
  void end(std::size_t i, Streamline::End end) {
    lines_[i].end = end;
    std::erase(active_, i);
  }

  template <class PlaceOf>
  std::vector<FlowAt::Answer> ask(const PlaceOf& place_of) const {
    std::vector<Point> places;
    for (const std::size_t i : active_) places.push_back(place_of(i));
    return flow_.at(places);
  }
  /// Calls `use(line, direction)` for each active line; the others end.
  template <class Use>
  void visit(const std::vector<FlowAt::Answer>& answers, const Use& use, Streamline::End without) {
    const std::vector<std::size_t> asked = active_;
    for (std::size_t k = 0; k < asked.size(); ++k) {
      if (answers[k].direction)
        use(asked[k], *answers[k].direction);
      else
        end(asked[k], answers[k].is_inside ? without : Streamline::End::outside);
    }
  }

  const FlowAt& flow_;
  const std::vector<StreamlineStart>& starts_;
  std::vector<Streamline> lines_;
  std::vector<double> left_;  ///< of the length
  std::vector<Point> first_;  ///< directions of the first pieces
  std::vector<std::size_t> active_;
};

}  // namespace

std::optional<Field> flow_direction(const Communicator& comm, const Mesh& mesh, const Field& solution) {
  Field direction{{"x", "y"}, std::vector<double>(2 * static_cast<std::size_t>(mesh.owned_nodes)), {}};
  if (const auto nodal = direction_in(solution.names)) {
    for (std::int32_t node = 0; node < mesh.owned_nodes; ++node) {
      for (std::size_t k = 0; k < 2; ++k)
        direction.row(NodeId{node})[k] = solution.row(NodeId{node})[(*nodal)[k]];
    }
    return direction;
  }
  const auto in_cells = direction_in(solution.cells.names);
  if (!in_cells) return std::nullopt;
  const CellsRoundNodes around(comm, mesh);
  for (std::size_t k = 0; k < 2; ++k) {
    const std::vector<AroundNode> values = around.of(solution.cells.column((*in_cells)[k]));
    for (std::int32_t node = 0; node < mesh.owned_nodes; ++node)
      direction.row(NodeId{node})[k] = 0.5 * (values[node].smallest + values[node].largest);
  }
  return direction;
}

std::vector<Streamline> streamlines(const Communicator& comm, const Mesh& mesh, const Field& direction,
                                    const std::vector<StreamlineStart>& starts) {
  if (starts.empty()) return {};
  const FlowAt flow(comm, mesh, direction);
  Growing growing(flow, starts);
  growing.start();
  while (growing.step()) {
  }
  return std::move(growing).lines();
}

}  // namespace quadloop::adapt
