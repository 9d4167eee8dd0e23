#include "io/model/check_mesh3d.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "io/model/cell_faces.hpp"
#include "io/model/mesh3d_faces.hpp"

namespace quadloop::io {

namespace {

constexpr std::ptrdiff_t most_kept = 20;  // maximum number of recorded errors per rule

/// Compensated sum of many values of one sign (Neumaier 1974).
class LongSum {
 public:
  void add(double value) {
    const double next = sum_ + value;
    lost_ += std::abs(sum_) >= std::abs(value) ? (sum_ - next) + value : (value - next) + sum_;
    sum_ = next;
  }
  double value() const { return sum_ + lost_; }

 private:
  double sum_ = 0, lost_ = 0;
};

class Mesh3dCheck {
 public:
  explicit Mesh3dCheck(const FileMesh& mesh) : mesh_{mesh} {}

  Mesh3dStatistics run() {
    check_indices();
    if (!statistics_.faults.empty()) return std::move(statistics_);
    measure_cells();
    measure_patches();
    for_each_face(
        mesh_, [this](std::int32_t lowest, std::span<const FaceMention> same) { judge_face(lowest, same); });
    return std::move(statistics_);
  }

 private:
  void report(Mesh3dRule rule, const std::string& what, Point3 place) {
    ++statistics_.all_faults;
    const auto same = std::ranges::count(statistics_.faults, rule, &Mesh3dFault::rule);
    if (same < most_kept) statistics_.faults.push_back({rule, what, place});
  }

  /// Returns the name of the cell with this number over all kinds: "prism 17", each kind counted from 1.
  std::string cell_name(std::int64_t cell) const {
    std::string name;
    const auto take = [&]<std::size_t width>(const std::vector<std::array<std::int32_t, width>>& cells) {
      if (name.empty() && cell < std::ssize(cells))
        name = std::string(CellFaces<width>::name) + " " + std::to_string(cell + 1);
      cell -= std::ssize(cells);
    };
    take(mesh_.tetrahedra);
    take(mesh_.pyramids);
    take(mesh_.prisms);
    take(mesh_.hexahedra);
    return name;
  }

  Point3 middle(std::span<const std::int32_t> nodes) const {
    Point3 sum;
    double count = 0;
    for (const std::int32_t node : nodes) {
      if (node < 0 || node >= std::ssize(mesh_.points)) continue;
      sum = sum + mesh_.points[node];
      ++count;
    }
    return (1 / std::max(count, 1.0)) * sum;
  }

  /// Whether the nodes exist and are distinct.
  bool is_sound(std::span<const std::int32_t> nodes) const {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (nodes[i] < 0 || nodes[i] >= std::ssize(mesh_.points)) return false;
      for (std::size_t j = 0; j < i; ++j) {
        if (nodes[i] == nodes[j]) return false;
      }
    }
    return true;
  }

  void check_indices() {
    for (std::size_t i = 0; i < mesh_.points.size(); ++i) {
      const Point3 p = mesh_.points[i];
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        report(Mesh3dRule::indices, "node " + std::to_string(i + 1) + " has a coordinate that is not finite",
               {});
    }
    if (cell_count(mesh_) == 0) report(Mesh3dRule::indices, "there are no cells", {});
    for_each_cell(mesh_, [&](const auto& nodes, std::int64_t cell) {
      if (!is_sound(nodes))
        report(Mesh3dRule::indices, cell_name(cell) + " names a node twice, or one that is none",
               middle(nodes));
    });
    for (const FileBoundary& patch : mesh_.boundaries) {
      for (const FileBoundary::Face& face : patch.faces) {
        if (!is_sound(corners_of(face)))
          report(Mesh3dRule::indices, "a face of " + patch.name + " names a node twice, or one that is none",
                 middle(corners_of(face)));
      }
    }
  }

  /// Returns twice the area vector; for a quad from its diagonals.
  Point3 twice_area(const FileBoundary::Face& face) const {
    const auto at = [&](std::size_t i) { return mesh_.points[face[i]]; };
    if (is_triangle(face)) return cross(at(1) - at(0), at(2) - at(0));
    return cross(at(2) - at(0), at(3) - at(1));
  }

  void measure_cells() {
    LongSum sum;
    const std::vector<std::int32_t> block_of = blocks_of_cells(mesh_);
    if (mesh_.has_blocks()) {
      for (const std::string& name : mesh_.block_names) statistics_.blocks.push_back({name});
    }
    std::vector<LongSum> of_blocks(statistics_.blocks.size());
    statistics_.least_volume = std::numeric_limits<double>::infinity();
    for_each_cell(mesh_, [&](const auto& nodes, std::int64_t cell) {
      const double volume = cell_volume(mesh_, nodes);
      sum.add(volume);
      if (!of_blocks.empty()) {
        of_blocks[block_of[cell]].add(volume);
        ++statistics_.blocks[block_of[cell]].cells;
      }
      if (volume < statistics_.least_volume) {
        statistics_.least_volume = volume;
        statistics_.least_place = middle(nodes);
      }
      if (!(volume > 0))
        report(Mesh3dRule::positive, cell_name(cell) + " has no positive volume", middle(nodes));
    });
    statistics_.volume = sum.value();
    for (std::size_t b = 0; b < of_blocks.size(); ++b) statistics_.blocks[b].volume = of_blocks[b].value();
  }

  void measure_patches() {
    for (const FileBoundary& patch : mesh_.boundaries) {
      LongSum area;
      for (const FileBoundary::Face& face : patch.faces) area.add(0.5 * length(twice_area(face)));
      statistics_.patches.push_back({patch.name, std::ssize(patch.faces), area.value()});
    }
  }

  /// Checks all occurrences of one face; patches come first.
  void judge_face(std::int32_t lowest, std::span<const FaceMention> same) {
    const auto patches = std::ranges::count_if(same, [](const FaceMention& face) { return face.owner < 0; });
    const auto cells = std::ssize(same) - patches;
    if ((cells == 2 && patches == 0) || (cells == 1 && patches == 1)) return;
    const auto& others = same.front().others;
    const Point3 place = middle(std::array{lowest, others[0], others[1], others[2]});
    const auto patch = [&] { return mesh_.boundaries[-1 - same.front().owner].name; };
    std::string what;
    if (cells == 0) {
      what = "a face of " + patch() + " is that of no cell";
    } else if (cells > 2) {
      what = "a face of " + cell_name(same.back().owner) + " belongs to " + std::to_string(cells) + " cells";
    } else if (patches == 0) {
      what = "a face of " + cell_name(same.back().owner) + " has no other cell and is on no patch";
    } else if (cells == 2) {
      what = "a face inside, of " + cell_name(same.back().owner) + ", is on " + patch();
    } else {
      what = "a face of " + cell_name(same.back().owner) + " is on patches " + std::to_string(patches) +
             " times, first on " + patch();
    }
    report(Mesh3dRule::conforming, what, place);
  }

  const FileMesh& mesh_;
  Mesh3dStatistics statistics_;
};

}  // namespace

const char* name_of(Mesh3dRule rule) {
  switch (rule) {
    case Mesh3dRule::indices: return "indices";
    case Mesh3dRule::positive: return "positive";
    case Mesh3dRule::conforming: return "conforming";
  }
  return "";
}

Mesh3dStatistics check_mesh3d(const FileMesh& mesh) { return Mesh3dCheck(mesh).run(); }

}  // namespace quadloop::io
