#pragma once

// For io/msh only: shared by the writers of both dimensions.
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "io/model/point3.hpp"
#include "io/msh/msh_file.hpp"
#include "io/text/text_output.hpp"

namespace quadloop::io {

/// A physical group with its only point, curve, surface or volume, which has the same number.
struct MshOutputGroup {
  int dimension;
  std::string name;
  Point3 place = {};  ///< of a point
};

/// An MSH file being written, in either version. Groups are numbered 1, 2, ... over all dimensions, as some
/// readers identify them by number only; elements in the order of writing. All functions are *collective*.
class MshOutput {
 public:
  MshOutput(OutputSet& outputs, const std::string& path, MshVersion version,
            std::vector<MshOutputGroup> groups)
      : file_{outputs, path}, is_new_{version == MshVersion::msh_4_1}, groups_{std::move(groups)} {}

  const Communicator& communicator() const { return file_.communicator(); }

  /// Writes this rank's nodes, `point(i)` each; their numbers follow those of lower ranks. In version 4.1
  /// they are nodes of the last surface or volume.
  template <class PointOf>
  void write_nodes(std::int64_t rows, const PointOf& point) {
    const std::int64_t first = communicator().exclusive_sum(rows) + 1, all = communicator().sum(rows);
    write_head(box_of(rows, point));
    file_.write(is_new_ ? new_nodes_head(all) : "$Nodes\n" + std::to_string(all) + "\n");
    if (is_new_)
      file_.write_rows(rows, 1, [&](TextRows& text, std::int64_t i) { text.put(first + i, '\n'); });
    file_.write_rows(rows, 4, [&](TextRows& text, std::int64_t i) {
      const Point3 p = point(i);
      if (!is_new_) text.put(first + i, ' ');
      text.put(p.x, ' ');
      text.put(p.y, ' ');
      text.put(p.z, '\n');
    });
    file_.write("$EndNodes\n");
  }

  /// `blocks` is the number of blocks that follow.
  void begin_elements(std::int64_t blocks, std::int64_t all) {
    file_.write(is_new_ ? "$Elements\n" + std::to_string(blocks) + " " + std::to_string(all) + " 1 " +
                              std::to_string(all) + "\n"
                        : "$Elements\n" + std::to_string(all) + "\n");
  }

  /// Returns the text before `count` elements, over all ranks, of one type and group.
  std::string block_head(int type, std::int64_t group, std::int64_t count) const {
    if (!is_new_) return {};
    return std::to_string(groups_[group - 1].dimension) + " " + std::to_string(group) + " " +
           std::to_string(type) + " " + std::to_string(count) + "\n";
  }

  /// Writes a block of elements from this rank's rows: `nodes(i)` are numbers from 0.
  template <std::size_t width, class Nodes>
  void write_elements(int type, std::int64_t group, std::int64_t rows, const Nodes& nodes) {
    const std::int64_t all = communicator().sum(rows);
    if (all == 0) return;
    const std::int64_t first = next_ + communicator().exclusive_sum(rows);
    next_ += all;
    file_.write(block_head(type, group, all));
    file_.write_rows(rows, 5 + width, [&](TextRows& text, std::int64_t i) {
      put_element<width>(text, first + i, type, group, nodes(i));
    });
  }

  /// Writes elements on the boundary edges, `on_each` per edge, with nodes `nodes(edge, k)`; boundary n is
  /// group n + 1.
  template <std::size_t width, class Nodes>
  void write_on_boundaries(const BoundaryStream& boundaries, int type, std::int64_t on_each,
                           const Nodes& nodes) {
    RowSections sections{boundaries.own_rows()};
    for (std::int64_t n = 0; communicator().is_root() && n < std::ssize(sections.rows); ++n)
      sections.heads.push_back(block_head(type, n + 1, boundaries.edges_of(n) * on_each));
    file_.write_sections(std::move(sections), (5 + width) * on_each,
                         [&](TextRows& text, std::int64_t n, std::int64_t i) {
                           const BoundaryStream::Edge edge = boundaries.own_edge(n, i);
                           const std::int64_t first = next_ + (boundaries.before_own(n) + i) * on_each;
                           for (std::int64_t k = 0; k < on_each; ++k)
                             put_element<width>(text, first + k, type, n + 1, nodes(edge, k));
                         });
    next_ += boundaries.all_edges() * on_each;
  }

  void end_elements() { file_.write("$EndElements\n"); }

  /// A periodic curve, by its group, with its partner and their nodes, from 0.
  struct Link {
    std::int64_t group, partner;
    std::string affine;  ///< 16 numbers: the map from the partner, row by row
    std::vector<std::array<std::int64_t, 2>> nodes;
  };
  void write_periodic(const std::vector<Link>& links);
  void close() { file_.close(); }

 private:
  using Box = std::array<double, 6>;  ///< minimum x, y and z, then the maxima

  template <class PointOf>
  Box box_of(std::int64_t rows, const PointOf& point) const {
    if (!is_new_) return {};
    Box box;
    const auto none = std::numeric_limits<double>::infinity();
    box.fill(none);
    std::fill(box.begin() + 3, box.end(), -none);
    for (std::int64_t i = 0; i < rows; ++i) {
      const Point3 p = point(i);
      const std::array<double, 3> at{p.x, p.y, p.z};
      for (std::size_t k = 0; k < 3; ++k) {
        box[k] = std::min(box[k], at[k]);
        box[k + 3] = std::max(box[k + 3], at[k]);
      }
    }
    for (std::size_t k = 0; k < 3; ++k) {
      box[k] = communicator().minimum(box[k]);
      box[k + 3] = communicator().maximum(box[k + 3]);
    }
    return box;
  }

  /// Writes version, names and, in version 4.1, entities, each with the bounding box of the whole mesh.
  void write_head(const Box& box);
  std::string new_nodes_head(std::int64_t all) const;

  /// Version 2.2: number, type, two tags (group and entity), nodes; version 4.1: number and nodes.
  template <std::size_t width, class Nodes>
  void put_element(TextRows& text, std::int64_t number, int type, std::int64_t group,
                   const Nodes& nodes) const {
    text.put(number, ' ');
    if (!is_new_) {
      text.put(type, ' ');
      text.put(2, ' ');
      text.put(group, ' ');
      text.put(group, ' ');
    }
    for (std::size_t k = 0; k < width; ++k) text.put(nodes[k] + 1, k + 1 < width ? ' ' : '\n');
  }

  TextOutput file_;
  bool is_new_;
  std::vector<MshOutputGroup> groups_;
  std::int64_t next_ = 1;
};

}  // namespace quadloop::io
