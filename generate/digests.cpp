#include "generate/digests.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <bit>
#include <optional>
#include <span>
#include <variant>

#include "mesher/base/mixed_bits.hpp"

namespace quadloop {

namespace {

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value + 0.0); }  // -0 becomes 0

/// A digest of words; depends on their order.
class WordDigest {
 public:
  void add(std::uint64_t word) { state_ = mixed_bits(state_ ^ word) + golden_step; }
  void add(double value) { add(bits(value)); }
  void add(Point p) {
    add(p.x);
    add(p.y);
  }
  void add(const std::optional<double>& value) {
    add(std::uint64_t{value.has_value()});
    add(value.value_or(0));
  }
  void add(const SizeSource& source) {
    const auto& [shape, spacing, where] = source;
    add(shape.index());
    add(spacing);
    if (const auto* box = std::get_if<Box>(&shape)) {
      add(box->low);
      add(box->high);
    } else if (const auto* disc = std::get_if<SizeSource::Disc>(&shape)) {
      add(disc->centre);
      add(disc->radius);
    } else if (const auto* line = std::get_if<SizeSource::Line>(&shape)) {
      add(line->from);
      add(line->to);
    } else {
      for (const unsigned char byte : std::get<SizeSource::Block>(shape).name) add(std::uint64_t{byte});
    }
  }
  void add(const LayerLine& line) {
    const auto& [names, path, length, spacing, layers, where, at, across, on_streamline, without_layers,
                 spacing_at_end] = line;  // across follows from mirror
    const std::string from = fmt::format("{}", fmt::join(names, "\n"));
    add(from.size());
    for (const unsigned char byte : from) add(std::uint64_t{byte});
    if (at) add(*at);
    add(path.size());
    for (const Point p : path) add(p);
    add(length);
    add(spacing);
    if (on_streamline) add(std::uint64_t{1});
    if (without_layers) add(spacing_at_end);
    if (!layers) return;
    const auto& [first, growth, growth_to, count, equal, y_plus, follows_flow] = *layers;
    add(first);
    add(growth);
    add(growth_to);
    add(static_cast<std::uint64_t>(count));
    add(static_cast<std::uint64_t>(equal));
    if (y_plus > 0) add(y_plus);
    if (follows_flow) add(std::uint64_t{1});
  }
  std::uint64_t value() const { return mixed_bits(state_); }

 private:
  std::uint64_t state_ = 0x6a09e667f3bcc908ULL;
};

/// Sum modulo 2^64 over all ranks, in two halves because a signed 64-bit sum could overflow. *Collective.*
std::uint64_t sum_over_ranks(const Communicator& comm, std::uint64_t own) {
  const std::uint64_t low = comm.sum(own & 0xffffffffULL), high = comm.sum(own >> 32);
  return low + (high << 32);
}

/// Digest of rows of `width` values; `number_of` gives the global number of each row. The digests of all
/// ranks are summed.
template <class NumberOf>
std::uint64_t digest_of_rows(std::span<const double> values, std::size_t width, const NumberOf& number_of) {
  std::uint64_t sum = 0;
  for (std::size_t begin = 0; begin < values.size(); begin += width) {
    WordDigest of_row;
    of_row.add(static_cast<std::uint64_t>(number_of(static_cast<std::int64_t>(begin / width))));
    for (const double value : values.subspan(begin, width)) of_row.add(value);
    sum += of_row.value();
  }
  return sum;
}

}  // namespace

// Structured bindings, so that a new option does not compile before it is considered here.
std::uint64_t case_digest(const MeshOptions& options, const std::vector<LayerLine>& lines,
                          const std::vector<LayerLine>& wakes_without_layers) {
  const auto& [type, quads, size, snap, may_vanish, limit, mirror, pairs, points] = options;
  // may_vanish and limit do not affect the mesh
  const auto& [min, max, aim, gradation, curvature, gap, sources, root, periods] = size;
  // aim and periods follow from the case's other options and the geometry
  WordDigest digest;
  digest.add(static_cast<std::uint64_t>(type));
  digest.add(static_cast<std::uint64_t>(quads));
  digest.add(min);
  digest.add(max);
  digest.add(gradation);
  digest.add(curvature);
  digest.add(gap);
  digest.add(sources.size());
  for (const SizeSource& source : sources) digest.add(source);
  digest.add(std::uint64_t{root.has_value()});
  if (root) {
    const auto& [corner, tree_edge, trees_x, trees_y, far_corner] =
        *root;  // far_corner follows from the others
    digest.add(corner);
    digest.add(tree_edge);
    digest.add(static_cast<std::uint64_t>(trees_x));
    digest.add(static_cast<std::uint64_t>(trees_y));
  }
  digest.add(snap);
  for (const LayerLine& line : lines) digest.add(line);
  for (const LayerLine& wake : wakes_without_layers) digest.add(wake);
  if (mirror) digest.add(std::uint64_t{*mirror == MirrorAxis::x ? 1U : 2U});
  for (const PeriodicPair& pair : pairs) {
    digest.add(text_digest(pair.from));
    digest.add(text_digest(pair.to));
    digest.add(pair.translation);
    digest.add(pair.degrees);
    digest.add(pair.centre);
  }
  for (const RequiredPoint& point : points) {
    digest.add(text_digest(point.name));
    digest.add(point.position);
  }
  return digest.value();
}

std::uint64_t text_digest(const std::string& text) {
  WordDigest digest;
  digest.add(text.size());
  for (const unsigned char byte : text) digest.add(std::uint64_t{byte});
  return digest.value();
}

std::uint64_t digest_of_owned(const Mesh& mesh) {
  std::uint64_t sum = 0;
  for (std::int32_t node = 0; node < mesh.owned_nodes; ++node) {
    WordDigest of_node;
    of_node.add(static_cast<std::uint64_t>(mesh.first_node + node));
    of_node.add(mesh.point(NodeId{node}));
    sum += of_node.value();
  }
  return sum;
}

std::uint64_t coordinate_digest(const Communicator& comm, const Mesh& mesh) {
  return sum_over_ranks(comm, digest_of_owned(mesh));
}

std::uint64_t solution_digest(const Communicator& comm, const Mesh& mesh, const Field& solution) {
  WordDigest whole;
  for (const auto* names : {&solution.names, &solution.cells.names}) {
    whole.add(names->size());
    for (const std::string& name : *names) whole.add(text_digest(name));
  }
  for (const double constant : solution.constants) whole.add(constant);
  const std::int64_t triangles = std::ssize(mesh.triangles), first_triangle = comm.exclusive_sum(triangles),
                     first_quad = comm.sum(triangles) + comm.exclusive_sum(std::ssize(mesh.quads));
  const std::size_t of_nodes = mesh.owned_nodes * solution.width();
  whole.add(sum_over_ranks(comm, digest_of_rows(std::span(solution.values).first(of_nodes), solution.width(),
                                                [&](std::int64_t node) { return mesh.first_node + node; })));
  whole.add(sum_over_ranks(
      comm, digest_of_rows(solution.cells.values, solution.cells.width(), [&](std::int64_t cell) {
        return cell < triangles ? first_triangle + cell : first_quad + cell - triangles;
      })));
  return whole.value();
}

}  // namespace quadloop
