#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace quadloop::io {

/// A pair of lines of a drawing: a group code, and its value without surrounding blanks.
struct DxfGroup {
  int code = 0;
  std::string_view value;
};

/// An ASCII DXF file in memory, as groups.
class DxfText {
 public:
  /// Reads the file up to EOF. Throws InputError for a binary drawing, and for a group code that is not a
  /// number.
  explicit DxfText(std::string path);
  DxfText(const DxfText&) = delete;
  DxfText& operator=(const DxfText&) = delete;

  std::span<const DxfGroup> groups() const { return groups_; }
  const std::string& path() const { return path_; }
  /// "file:line" of a group code; of the end, for the end of groups().
  std::string place(const DxfGroup* group) const;
  [[noreturn]] void refuse_damaged(const DxfGroup* group, const std::string& what) const;

 private:
  std::string path_, text_;
  std::vector<DxfGroup> groups_;
};

/// An entity or an entry of a table: the groups from its type up to the next type.
class DxfRecord {
 public:
  DxfRecord(const DxfText& text, std::span<const DxfGroup> groups) : text_{&text}, groups_{groups} {}

  std::span<const DxfGroup> groups() const { return groups_; }
  std::string_view type() const { return groups_.front().value; }
  std::string_view layer() const { return has(8) ? text(8) : "0"; }
  bool has(int code) const { return find(code) != nullptr; }
  /// The first value with this code; empty if there is none.
  std::string_view text(int code) const;
  /// The first value with this code, else `fallback`. Throws InputError for a value that is not a number, or
  /// not finite.
  double real(int code, double fallback = 0) const;
  std::int64_t whole(int code, std::int64_t fallback = 0) const;
  /// The value of a group of this record as a number.
  double real_of(const DxfGroup& group) const;

  /// "file:line: layer 'wall', LINE of handle 1F".
  std::string source() const;
  /// Throws InputError: the source, what is wrong, and a remedy.
  [[noreturn]] void refuse(const std::string& what) const;

 private:
  const DxfGroup* find(int code) const;

  const DxfText* text_;
  std::span<const DxfGroup> groups_;
};

}  // namespace quadloop::io
