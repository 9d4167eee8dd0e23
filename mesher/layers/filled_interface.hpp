#pragma once

#include <cstdint>
#include <vector>

#include "mesher/base/ids.hpp"
#include "mesher/layers/front_places.hpp"

namespace quadloop {

/// A part of the wall with layers whose columns stand on nodes of another block, in the direction of the
/// wall: the places from one station to another.
struct InterfacePart {
  std::int32_t begin = 0, end = 0;  ///< stations; equal for a closed part
  bool closed = false;
};

/// All such parts, in the order of their stations. A closed part begins at a fan, if it has one.
std::vector<InterfacePart> interface_parts(const WallLine& line);

/// A node of another block on an interface: the foot of a column.
struct InterfaceFoot {
  GlobalNodeId node;
  Point point;
  FrontPlace place;
};

/// A node of the front, and the leaf of the front's edge that begins there.
struct FrontNode {
  GlobalNodeId node;
  Point point;
  FrontPlace place;
  std::int32_t rank = 0, leaf = 0;
};

/// Reports a station that is a node on the wall or on the front only. Throws InputError.
[[noreturn]] void refuse_lost_foot(const LayerFront& front, std::int32_t station);

/// The layers of one part: columns on its feet, all layers but the last; between their ends and the nodes of
/// the front a row of triangles. The same on all ranks.
class FilledInterface {
 public:
  /// Both lists in any order; the front's nodes of an open part include the last one. Throws InputError where
  /// a feature point of the part is no node.
  FilledInterface(const LayerFront& front, const InterfacePart& part, std::vector<InterfaceFoot> feet,
                  std::vector<FrontNode> tops);

  struct Column {
    std::int32_t foot = 0;  ///< index of its foot
    std::int32_t top = 0;   ///< index of its front node, if it is a ray of a fan or not its own
    /// Whether its nodes are those of an ordinary column, numbered after its front node.
    bool is_walls = false;
    int lowest = 1;             ///< ring of its first node
    std::vector<Point> points;  ///< from ring `lowest` to the ring before the front
  };
  /// A node: of a column, by ring (0 is the foot), or of the front.
  struct Corner {
    bool on_front = false;
    std::int32_t number = 0;  ///< of the column, or of the front's node
    int ring = 0;
  };
  struct Cell {
    std::int32_t edge = 0;  ///< the front's node that begins the edge to whose leaf the cell belongs
    std::vector<Corner> corners;
  };

  const std::vector<InterfaceFoot>& feet() const { return feet_; }
  const std::vector<FrontNode>& tops() const { return tops_; }
  const std::vector<Column>& columns() const { return columns_; }
  const std::vector<Cell>& cells() const { return cells_; }
  int layers() const { return layers_; }
  const InterfacePart& part() const { return part_; }

 private:
  struct Item {
    std::int32_t column = 0;
    double position = 0;
  };
  struct Fan {
    std::int32_t first = 0, last = 0;  ///< stations
  };

  void refuse_fan_beside(std::int32_t station) const;
  double position(const FrontPlace& place) const;
  bool is_fan(const FrontPlace& place) const;
  Fan fan_at(std::int32_t station) const;
  void sort_by_position();
  void close();
  std::int32_t top_at(std::int32_t station) const;
  std::int32_t top_near(double position, std::int32_t from, std::int32_t to) const;
  std::int32_t add_column(std::int32_t foot);
  void add_columns();
  void add_fan(std::int32_t foot);
  void add_piece(std::int32_t last_top);
  void zip(std::size_t from, std::size_t to, std::int32_t from_top, std::int32_t to_top);
  void add_quads(std::int32_t a, std::int32_t b, std::int32_t edge);
  Point at(const Corner& c) const;

  const LayerFront& front_;
  const WallLine& line_;
  InterfacePart part_;
  int layers_ = 0;
  std::vector<InterfaceFoot> feet_;
  std::vector<FrontNode> tops_;
  std::vector<double> position_of_feet_, position_of_tops_;
  std::vector<Column> columns_;
  std::vector<Cell> cells_;
  std::vector<Item> items_;  ///< columns of the piece that is being made
  std::int32_t first_top_ = 0;
};

}  // namespace quadloop
