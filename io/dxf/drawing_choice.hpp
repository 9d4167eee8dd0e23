#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

namespace quadloop {

/// Names of layers of a drawing or map, with the wildcards * and ?. Empty: all layers; in a drawing the
/// visible ones.
using LayerNames = std::vector<std::string>;

/// Whether the layer has this name, in upper or lower case.
bool matches_layer(const std::string& pattern, const std::string& layer);

/// What names the boundaries of a drawing or a map.
struct BoundaryNames {
  /// usual: the layer of a drawing; in a map the attribute "name" or "boundary", else the layer
  enum class From { usual, layer, block, colour, file, attribute } from = From::usual;
  std::string attribute = {};  ///< its name

  friend bool operator==(const BoundaryNames&, const BoundaryNames&) = default;
};

/// What is read from a drawing or a map, and what names its boundaries.
struct DrawingChoice {
  LayerNames layers = {};
  BoundaryNames names = {};

  /// Whether a layer is to be read.
  bool has_layer(const std::string& layer) const;
};

/// What a file declares: the unit of length of its coordinates, its layers, and the plane of its curves.
struct FileUnit {
  std::string name;                 ///< empty where it declares none
  double metres = 0;                ///< in one of it; 0: not known
  std::vector<std::string> layers;  ///< of a drawing or map; ascending
  std::string plane = {};           ///< "XZ" or "YZ" if these axes of the file are x and y; else empty
};

/// Returns the name as one word, for a boundary: blanks, commas and # become underscores.
std::string one_word(std::string name);

/// Counts the content of a file that is left out, by kind.
class LeftOut {
 public:
  void add(const std::string& kind) { ++counts_[kind]; }
  bool empty() const { return counts_.empty(); }
  std::string text() const;

 private:
  std::map<std::string, long> counts_;
};

/// Throws InputError for a file without lines and polygons, or none in the layers to be read.
[[noreturn]] void refuse_empty(const std::string& path, const DrawingChoice& choice,
                               const std::vector<std::string>& layers, const LeftOut& left_out);

}  // namespace quadloop
