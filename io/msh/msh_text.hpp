#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "io/model/point3.hpp"
#include "io/msh/msh_groups.hpp"
#include "io/msh/msh_nodes.hpp"
#include "io/msh/msh_values.hpp"
#include "io/text/text_scanner.hpp"

namespace quadloop::io {

/// Gmsh's numbers of element types.
enum MshType : std::uint8_t {
  msh_line = 1,
  msh_triangle = 2,
  msh_quad = 3,
  msh_tetrahedron = 4,
  msh_hexahedron = 5,
  msh_prism = 6,
  msh_pyramid = 7,
  msh_point = 15
};

/// An element of an MSH file.
struct MshElement {
  std::int64_t tag = 0, type = 0;
  std::int64_t physical = 0, entity = 0;  ///< its groups: 0 for none
  std::array<std::int32_t, 8> nodes{};    ///< as many as the type has, as indices of the points
  std::size_t place = 0;                  ///< position in the file's text, for error messages

  /// Returns the first `width` nodes.
  template <std::size_t width>
  std::array<std::int32_t, width> as() const {
    std::array<std::int32_t, width> result;
    std::copy_n(nodes.begin(), width, result.begin());
    return result;
  }
};

/// The text of an MSH file, version 2.2 or 4.1, of any dimension: its points and elements one after another.
/// Errors are InputErrors "file:line: ...".
class MshText {
 public:
  using PutPoint = std::function<void(std::int64_t tag, Point3 point)>;
  using PutElement = std::function<void(const MshElement& element)>;

  explicit MshText(const std::string& path) : scan_{path, TextScanner::no_comments} {}

  /// Reads all points, then all elements.
  void read(const PutPoint& put_point, const PutElement& put_element);

  /// Reads the solution in the file; call after read().
  MshSolution read_values() { return read_msh_values(scan_); }
  /// Whether the word of that length is alone on its line.
  static bool is_line(std::string_view text, std::size_t at, std::size_t length);

  /// Nodes that the file pairs with others on periodic curves or surfaces, after read(); as indices of the
  /// points.
  const std::vector<std::int32_t>& periodic_nodes() const { return periodic_nodes_; }

  /// Whether an element in several groups is stored once for each (version 2.2).
  bool may_repeat() const { return is_old_; }
  const TextScanner& scan() const { return scan_; }
  const MshGroups& groups() const { return groups_; }
  /// Returns warnings about groups, where those of dimension `lowest` are boundaries.
  std::vector<std::string> warnings(int lowest) const;

 private:
  /// Goes to after the line "$name"; returns false if the file has no such section.
  bool go_to_section(const std::string& name);
  void go_to_needed(const std::string& name);
  void end_section(const std::string& name);
  /// Returns true for version 2.2, false for 4.1.
  bool read_format();
  std::int64_t physical_tag();
  void read_names();
  void read_entities();
  /// Tag, coordinates and the physical groups.
  void read_point_entity();
  /// Tag, six numbers of a box, the physical groups, and bounding entities.
  void read_entity(int dimension, const char* expected);
  void read_point(std::int64_t tag);
  void end_nodes(const std::string& section);
  std::int64_t node_tag();
  void read_old_nodes();
  /// Numbers of blocks and nodes, smallest and largest tag; then blocks of nodes on one entity, first their
  /// tags, then their coordinates.
  void read_nodes();
  void refuse_unknown(std::int64_t type) const;
  void read_element(std::int64_t tag, std::int64_t type, std::int64_t physical, std::int64_t entity);
  /// Each row: number, type, tags (the first is the physical group, the second the entity), nodes.
  void read_old_elements();
  void note_member(int dimension, std::int64_t entity, std::int64_t physical);
  /// Numbers of blocks and elements, smallest and largest tag; then blocks of elements of one type on one
  /// entity.
  void read_elements();
  std::size_t read_element_block();
  /// Links of two entities: their dimension and tags, an optional transformation, then pairs of nodes.
  void read_periodic();
  void pass_over_transformation();

  TextScanner scan_;
  bool is_old_ = false;
  MshGroups groups_;
  std::array<std::int64_t, 3> last_member_{-1, 0, 0};  ///< dimension, entity, group
  NodeTags tags_;
  std::size_t points_ = 0;
  std::vector<std::int32_t> periodic_nodes_;
  const PutPoint* put_point_ = nullptr;
  const PutElement* put_element_ = nullptr;
};

}  // namespace quadloop::io
