#include "mesher/build/islands.hpp"

#include <algorithm>
#include <sstream>
#include <utility>

#include "mesher/base/error.hpp"
#include "mesher/base/id_vector.hpp"
#include "mesher/build/outline_losses.hpp"

namespace quadloop {

namespace {

Box box_of_loop(const Geometry& g, std::int32_t loop) {
  Box box;
  for (std::int32_t v = g.loop_start(loop); v < g.loop_start(loop + 1); ++v) box.include(g.point(v));
  return box;
}

/// Whether a segment has its twin in another loop, where it would remain.
bool is_part_of_line(const Geometry& g, std::int32_t loop) {
  std::int32_t s = g.loop_start(loop);
  while (s < g.loop_start(loop + 1) && (g.twin(s) < 0 || g.loop_of(g.twin(s)) == loop)) ++s;
  return s < g.loop_start(loop + 1);
}

Geometry with_loops(const Geometry& g, const std::vector<char>& keep) {
  GeometryBuilder builder;
  for (std::int32_t loop = 0; loop < g.loop_count(); ++loop) {
    if (keep[loop] != 0) builder.add_loop(g, loop);
  }
  return std::move(builder).geometry(g.boundaries(), g.block_names());
}

/// Returns the names in the order of the geometry.
std::vector<std::string> names_without_segments(const Geometry& g) {
  IdVector<BoundaryId, char> found(g.boundaries().size(), 0);
  for (std::int32_t s = 0; s < g.size(); ++s) found[g.boundary_of(s)] = 1;
  std::vector<std::string> names;
  for (const BoundaryId b : found.ids()) {
    if (found[b] == 0) names.push_back(g.boundary(b).name);
  }
  return names;
}

}  // namespace

Geometry without_small_islands(const Geometry& g, double min, MeshReport& report) {
  std::optional<Geometry> kept = small_islands_dropped(g, min, report);
  return kept ? std::move(*kept) : g;
}

std::optional<Geometry> small_islands_dropped(const Geometry& g, double min, MeshReport& report) {
  if (g.has_blocks()) return {};  // a small block would leave a hole in the one around it
  std::vector<char> keep(g.loop_count(), 1);
  for (std::int32_t loop = 0; loop < g.loop_count(); ++loop) {
    const Box box = box_of_loop(g, loop);
    if (box.width() >= min || box.height() >= min || is_part_of_line(g, loop)) continue;
    keep[loop] = 0;  // loops nested in it are smaller still and dropped by the same rule
    ++report.islands_dropped;
    report.area_dropped += area_of_loop(g, loop);
    std::ostringstream line;
    line.precision(12);
    line << "boundary " << g.boundary(g.boundary_of(g.loop_start(loop))).name << ": a loop near ("
         << box.centre().x << ", " << box.centre().y << ") is smaller than spacing.min = " << min
         << " in both directions and was dropped";
    report.warnings.push_back(line.str());
  }
  if (report.islands_dropped == 0) return {};
  if (std::find(keep.begin(), keep.end(), 1) == keep.end()) {
    const Box box = box_of_loop(g, 0);
    std::ostringstream message;
    message << "boundary " << g.boundary(g.boundary_of(0)).name << " near (" << box.centre().x << ", "
            << box.centre().y
            << "): this and every other loop of the geometry is smaller than spacing.min = " << min
            << " in both directions; reduce spacing.min";
    throw InputError(message.str());
  }
  Geometry kept = with_loops(g, keep);
  report.boundaries_vanished = names_without_segments(kept);
  return kept;
}

}  // namespace quadloop
