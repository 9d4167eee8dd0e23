#include "io/dxf/dxf_reader.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <optional>

#include "io/dxf/dxf_curves.hpp"
#include "io/dxf/dxf_drawing.hpp"
#include "mesher/geometry/assemble/transform.hpp"

namespace quadloop::io {

namespace {

/// Where entities stand: in the drawing itself, or in a block that is inserted.
struct Insertion {
  DxfPlacement placement = {};
  const DxfLayer* layer = nullptr;  ///< of the reference: that of what is on layer 0 of the block
  std::string colour = "white", block = {};
  bool hidden = false;
  int depth = 0;
};

class DxfReader {
 public:
  DxfReader(const DxfDrawing& drawing, const DrawingChoice& choice, const std::string& path)
      : drawing_{drawing}, choice_{choice}, file_{std::filesystem::path(path).stem().string()} {
    entities_left_ += static_cast<double>(drawing.size());
  }

  void read(std::span<const DxfRecord> entities, const Insertion& within) {
    for (std::size_t i = 0; i < entities.size(); ++i) {
      const DxfRecord& entity = entities[i];
      if (is_part(entity)) continue;
      count(entity, 1);
      const DxfLayer& own = drawing_.layer(entity.layer());
      const DxfLayer& layer = own.name == "0" && within.layer != nullptr ? *within.layer : own;
      if (entity.type() == "INSERT")
        insert(entity, layer, within);
      else
        add(entities.subspan(i), layer, within);
    }
  }

  std::vector<Chain> take_chains() { return std::move(chains_); }
  const LeftOut& left_out() const { return left_out_; }

 private:
  /// Whether it belongs to the entity before it.
  static bool is_part(const DxfRecord& entity) {
    const std::string_view type = entity.type();
    return type == "VERTEX" || type == "ATTRIB" || type == "SEQEND";
  }

  static bool in_paper_space(const DxfRecord& entity) { return entity.whole(67) == 1; }
  static bool is_invisible(const DxfRecord& entity) { return entity.whole(60) == 1; }

  /// Blocks within blocks may multiply beyond all bounds.
  void count(const DxfRecord& entity, double entities) {
    if (!(entities <= entities_left_))
      entity.refuse("it inserts blocks within blocks more than a million times");
    entities_left_ -= entities;
  }

  void leave_out(const DxfRecord& entity, const std::string& why) {
    left_out_.add(fmt::format("{} {}", entity.type(), why));
  }

  void insert(const DxfRecord& reference, const DxfLayer& layer, const Insertion& within) {
    constexpr int most_nested = 50;
    const DxfBlock* const block = drawing_.block(reference.text(2));
    if (in_paper_space(reference)) return leave_out(reference, "in paper space");
    if (block == nullptr) {
      if (choice_.has_layer(layer.name))
        leave_out(reference,
                  fmt::format("of block '{}', whose content is not in the file", reference.text(2)));
      return;
    }
    if (within.depth == most_nested)
      reference.refuse(
          fmt::format("it inserts block '{}', which contains itself or is nested too deep", block->name));
    const auto columns = static_cast<double>(std::max<std::int64_t>(1, reference.whole(70, 1))),
               rows = static_cast<double>(std::max<std::int64_t>(1, reference.whole(71, 1)));
    count(reference, columns * rows);
    Insertion inner{{},
                    &layer,
                    colour_in(reference, layer, within),
                    block->name,
                    within.hidden || layer.frozen || is_invisible(reference),
                    within.depth + 1};
    for (double row = 0; row < rows; ++row) {
      for (double column = 0; column < columns; ++column) {
        inner.placement = within.placement.after(placement_of(reference, block->base, column, row));
        read(block->entities, inner);
      }
    }
  }

  static DxfPlacement placement_of(const DxfRecord& reference, Point base, double column, double row) {
    const Point x = unit_vector(reference.real(50)), y = unit_vector(reference.real(50) + 90);
    const DxfPlacement turn{x, y, {reference.real(10), reference.real(20)}};
    const DxfPlacement in_row{{reference.real(41, 1), 0},
                              {0, reference.real(42, 1)},
                              {column * reference.real(44), row * reference.real(45)}};
    return plane_of(reference).after(turn).after(in_row).after({{1, 0}, {0, 1}, -1 * base});
  }

  std::string colour_in(const DxfRecord& entity, const DxfLayer& layer, const Insertion& within) const {
    return choice_.names.from == BoundaryNames::From::colour ? colour_of(entity, layer.colour, within.colour)
                                                             : "";
  }

  /// Why an entity is not part of the geometry, or not visible; empty if it is to be read.
  std::string why_left_out(const DxfRecord& entity, const DxfLayer& layer, const Insertion& within) const {
    if (in_paper_space(entity)) return "in paper space";
    const bool hidden = within.hidden || layer.frozen || layer.off || is_invisible(entity);
    if (hidden && choice_.layers.empty()) return fmt::format("not visible on layer '{}'", layer.name);
    return is_dxf_curve(entity) ? std::string() : fmt::format("on layer '{}'", layer.name);
  }

  void add(std::span<const DxfRecord> entities, const DxfLayer& layer, const Insertion& within) {
    const DxfRecord& entity = entities.front();
    if (!choice_.has_layer(layer.name)) return;
    if (const std::string why = why_left_out(entity, layer, within); !why.empty())
      return leave_out(entity, why);
    std::optional<Chain> chain = dxf_curve(entities, within.placement);
    if (!chain) return leave_out(entity, fmt::format("without extent on layer '{}'", layer.name));
    chain->name = one_word(name_of(entity, layer, within));
    chain->source = entity.source();
    chains_.push_back(std::move(*chain));
  }

  std::string name_of(const DxfRecord& entity, const DxfLayer& layer, const Insertion& within) const {
    switch (choice_.names.from) {
      case BoundaryNames::From::block: return within.block.empty() ? layer.name : within.block;
      case BoundaryNames::From::colour: return colour_in(entity, layer, within);
      case BoundaryNames::From::file: return file_;
      default: return layer.name;
    }
  }

  const DxfDrawing& drawing_;
  const DrawingChoice& choice_;
  std::string file_;
  double entities_left_ = 1e6;
  std::vector<Chain> chains_;
  LeftOut left_out_;
};

}  // namespace

std::vector<Chain> read_dxf(const std::string& path, const DrawingChoice& choice,
                            std::vector<std::string>& warnings, FileUnit& unit) {
  const DxfDrawing drawing(path);
  DxfReader reader(drawing, choice, path);
  reader.read(drawing.entities(), {});
  unit = {drawing.unit(), 0, drawing.layer_names()};
  std::vector<Chain> chains = reader.take_chains();
  if (chains.empty()) refuse_empty(path, choice, unit.layers, reader.left_out());
  if (!reader.left_out().empty())
    warnings.push_back(fmt::format("{}: left out: {}", path, reader.left_out().text()));
  return chains;
}

}  // namespace quadloop::io
