#include "io/dxf/dxf_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "mesher/base/error.hpp"
#include "mesher/base/suffix.hpp"

namespace quadloop::io {

namespace {

/// Returns the unit for a value of $INSUNITS.
std::string unit_named(std::string_view value) {
  constexpr std::array<const char*, 17> names{"",   "inch",   "foot",      "mile", "mm",   "cm",
                                              "m",  "km",     "microinch", "mil",  "yard", "angstrom",
                                              "nm", "micron", "dm",        "dam",  "hm"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (value == std::to_string(i)) return names[i];
  }
  return {};
}

std::string declared_unit(const DxfRecord& header) {
  std::string_view variable;
  for (const DxfGroup& group : header.groups()) {
    if (group.code == 9) variable = group.value;
    if (group.code == 70 && variable == "$INSUNITS") return unit_named(group.value);
  }
  return {};
}

/// Splits the groups where a type begins.
std::vector<DxfRecord> records_of(const DxfText& text) {
  std::vector<DxfRecord> records;
  const auto groups = text.groups();
  const auto is_type = [](const DxfGroup& group) { return group.code == 0; };
  for (auto begin = std::ranges::find_if(groups, is_type); begin != groups.end();) {
    const auto end = std::find_if(begin + 1, groups.end(), is_type);
    records.emplace_back(text, std::span(begin, end));
    begin = end;
  }
  return records;
}

std::string key_of(std::string_view name) { return small_letters(std::string(name)); }

}  // namespace

std::string colour_of(const DxfRecord& record, const std::string& by_layer, const std::string& by_block) {
  constexpr std::array<const char*, 8> words{"",     "red",  "yellow",  "green",
                                             "cyan", "blue", "magenta", "white"};
  constexpr std::int64_t of_block = 0, of_layer = 256;
  if (record.has(420)) return fmt::format("colour_{:06x}", record.whole(420) & 0xffffff);
  const std::int64_t index = std::abs(record.whole(62, of_layer));  // negative: a layer that is off
  if (index == of_layer) return by_layer;
  if (index == of_block) return by_block;
  return index < std::ssize(words) ? words[index] : fmt::format("colour_{}", index);
}

DxfDrawing::DxfDrawing(const std::string& path) : text_{path}, records_{records_of(text_)} {
  const DxfRecord* section = nullptr;
  bool any = false;
  for (const DxfRecord& record : records_) {
    const std::string_view type = record.type();
    if (section != nullptr && (type == "SECTION" || type == "EOF")) {
      text_.refuse_damaged(record.groups().data(),
                           fmt::format("section {} does not end with ENDSEC", section->text(2)));
    }
    if (type == "SECTION") section = &record;
    if (type != "ENDSEC" || section == nullptr) continue;
    any = true;
    take_section(section->text(2), {section, &record});
    section = nullptr;
  }
  const DxfGroup* const end = text_.groups().data() + text_.groups().size();
  if (section != nullptr)
    text_.refuse_damaged(end, fmt::format("section {} does not end with ENDSEC", section->text(2)));
  if (!any) text_.refuse_damaged(end, "there is no SECTION");
}

void DxfDrawing::take_section(std::string_view section, std::span<const DxfRecord> records) {
  if (section == "HEADER") unit_ = declared_unit(records.front());
  if (section == "TABLES") {
    for (const DxfRecord& record : records) {
      if (record.type() == "LAYER") take_layer(record);
    }
  }
  if (section == "BLOCKS") take_blocks(records.subspan(1));
  if (section == "ENTITIES") {
    if (!entities_.empty())
      text_.refuse_damaged(records.front().groups().data(), "this section ENTITIES is the second one");
    entities_ = records.subspan(1);
    name_layers(entities_);
  }
}

void DxfDrawing::take_layer(const DxfRecord& entry) {
  constexpr std::int64_t frozen = 1;
  const std::string name(entry.text(2));
  layers_[key_of(name)] = {name, colour_of(entry, "white", "white"), (entry.whole(70) & frozen) != 0,
                           entry.whole(62) < 0};
}

void DxfDrawing::take_blocks(std::span<const DxfRecord> records) {
  constexpr std::int64_t external = 4;  // the content is in another file
  for (auto head = records.begin(); head != records.end();) {
    const auto next = std::find_if(head + 1, records.end(), [](const DxfRecord& r) {
      return r.type() == "BLOCK" || r.type() == "ENDBLK";
    });
    if (head->type() == "BLOCK" && (head->whole(70) & external) == 0) {
      const DxfBlock block{std::string(head->text(2)), {head->real(10), head->real(20)}, {head + 1, next}};
      blocks_.emplace(key_of(block.name), block);
      name_layers(block.entities);
    }
    head = next;
  }
}

void DxfDrawing::name_layers(std::span<const DxfRecord> records) {
  for (const DxfRecord& record : records) {
    const std::string name(record.layer());
    layers_.try_emplace(key_of(name), DxfLayer{name, "white"});
  }
}

const DxfLayer& DxfDrawing::layer(std::string_view name) const { return layers_.at(key_of(name)); }

std::vector<std::string> DxfDrawing::layer_names() const {
  std::vector<std::string> names;
  for (const auto& [key, layer] : layers_) names.push_back(layer.name);
  std::ranges::sort(names);
  return names;
}

const DxfBlock* DxfDrawing::block(std::string_view name) const {
  const auto found = blocks_.find(key_of(name));
  return found == blocks_.end() ? nullptr : &found->second;
}

}  // namespace quadloop::io
