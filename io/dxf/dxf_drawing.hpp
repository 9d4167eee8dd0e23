#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/dxf/dxf_text.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop::io {

struct DxfLayer {
  std::string name, colour;
  bool frozen = false, off = false;
};

struct DxfBlock {
  std::string name;
  Point base;
  std::span<const DxfRecord> entities;
};

/// The parts of a drawing that outlines are made of. Names of layers and blocks are equal in upper and lower
/// case; a layer has the spelling of its definition, else that of its first use.
class DxfDrawing {
 public:
  /// Reads the file. Throws InputError for a file that is damaged or no ASCII DXF.
  explicit DxfDrawing(const std::string& path);

  std::span<const DxfRecord> entities() const { return entities_; }
  /// The layer of this name, which an entity or the table of layers has.
  const DxfLayer& layer(std::string_view name) const;
  /// All names of layers, ascending.
  std::vector<std::string> layer_names() const;
  /// The block of this name; null if its content is not in the file.
  const DxfBlock* block(std::string_view name) const;
  /// The unit that the drawing declares, a name of length_units.hpp; empty where it declares none.
  const std::string& unit() const { return unit_; }
  std::size_t size() const { return records_.size(); }  ///< number of all entities and table entries

 private:
  void take_section(std::string_view section, std::span<const DxfRecord> records);
  void take_layer(const DxfRecord& entry);
  void take_blocks(std::span<const DxfRecord> records);
  void name_layers(std::span<const DxfRecord> records);

  DxfText text_;
  std::vector<DxfRecord> records_;
  std::span<const DxfRecord> entities_;
  std::map<std::string, DxfLayer> layers_;  ///< by name in lower case
  std::map<std::string, DxfBlock> blocks_;
  std::string unit_;
};

/// The name of the colour of an entity or a layer: red, yellow, green, cyan, blue, magenta, white, else
/// colour_9 (AutoCAD's index) or colour_ff8000 (a true colour). `by_layer` and `by_block` are the colours of
/// its layer and of the reference to its block, which it may take.
std::string colour_of(const DxfRecord& record, const std::string& by_layer, const std::string& by_block);

}  // namespace quadloop::io
