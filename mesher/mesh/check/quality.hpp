#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Returns the angle at p between the edges to `next` and to `previous`, in degrees: 0 to 180 if the corner
/// turns left, negative if it is inverted.
double corner_degrees(Point previous, Point p, Point next);

/// Returns 1 for the best shape, 0 for a degenerate cell, negative for an inverted one. Triangle: 4 sqrt(3)
/// area / sum of squared edges, 1 if equilateral. Quad: the minimum over its corners of 2 J / (|e1|^2 +
/// |e2|^2), 1 if a square.
double quality_of(std::span<const Point> cell);

/// Returns the deviation of a quad from a parallelogram: |x1 - x2 + x3 - x4| / sqrt(area); the area must be
/// positive.
double skew_of(const std::array<Point, 4>& quad);
/// Largest skew of a quad that counts as a parallelogram.
inline constexpr double parallel_skew = 0.01;

/// Quality of all cells over all ranks. For empty meshes angles and qualities are 0.
struct QualitySummary {
  MeshCounts counts;
  double smallest_degrees = 0, largest_degrees = 0;  ///< over all corners
  double worst = 0, mean = 0;                        ///< quality_of() the cells
};

MeshCounts count(const Communicator& comm, const Mesh& mesh);

/// Bitwise independent of the number of ranks: the mean is summed in fixed point (2^-30). *Collective.*
QualitySummary summarise_quality(const Communicator& comm, const Mesh& mesh);

/// Returns the larger of two cell areas over the smaller; infinite for cells without area.
double area_ratio(double area, double other);

/// Returns the areas of this rank's cells, triangles first, then quads.
std::vector<double> cell_areas(const Mesh& mesh);

/// Returns the total area of this rank's cells.
double area_of(const Mesh& mesh);

}  // namespace quadloop
