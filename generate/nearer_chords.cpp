#include "generate/nearer_chords.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <vector>

#include "mesher/base/error.hpp"
#include "mesher/geometry/halved_curves.hpp"
#include "mesher/geometry/predicates.hpp"

namespace quadloop {

namespace {

/// The boxes of the inverted and flat cells on all ranks. *Collective.*
std::vector<Box> boxes_of_inverted_cells(const Communicator& comm, const Mesh& mesh) {
  std::vector<Box> own;
  mesh.for_each_cell([&](const auto& nodes) {
    const std::size_t width = nodes.size();
    bool inverted = false;
    Box box;
    for (std::size_t k = 0; k < width; ++k) {
      const Point a = mesh.point(nodes[k]), b = mesh.point(nodes[(k + 1) % width]),
                  c = mesh.point(nodes[(k + 2) % width]);
      inverted = inverted || orientation(a, b, c) <= 0;
      box.include(a);
    }
    if (inverted) own.push_back(box);
  });
  return comm.all_gather_values(std::span<const Box>(own));
}

}  // namespace

std::optional<Geometry> nearer_chords(const Communicator& comm, const Geometry& geometry, const Mesh& mesh) {
  const std::vector<Box> inverted = boxes_of_inverted_cells(comm, mesh);
  if (inverted.empty()) return {};
  std::vector<char> flagged(geometry.size(), 0);
  for (std::int32_t s = 0; s < geometry.size(); ++s) {
    if (!geometry.is_curved(s)) continue;
    const Box box = box_of(geometry.segment(s));
    flagged[s] = std::ranges::any_of(inverted, [&](const Box& cell) { return cell.meets(box); }) ? 1 : 0;
  }
  if (std::ranges::count(flagged, 1) == 0) return {};
  return with_halved_curves(geometry, flagged);
}

void require_not_inverted(const Communicator& comm, const Geometry& geometry, const Mesh& mesh) {
  if (!geometry.has_curves()) return;
  const std::vector<Box> inverted = boxes_of_inverted_cells(comm, mesh);
  if (inverted.empty()) return;
  const Point place = std::ranges::min_element(inverted, {}, &Box::low)->low;
  throw InputError(fmt::format(
      "near ({:.6g}, {:.6g}): a cell at a curve is inverted, as its nodes move from the chord onto "
      "the curve; reduce spacing.min, move curves and points that nearly touch there apart, or increase "
      "smooth.sweeps",
      place.x, place.y));
}

}  // namespace quadloop
