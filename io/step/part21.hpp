#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace quadloop::io {

/// Lists within lists, and references to entities that refer to others: more are refused.
inline constexpr int deepest_nesting = 32;

/// A value in a STEP file: a parameter, a list or a record. The parts of a list or a record follow it.
struct Part21Value {
  enum class Kind : std::uint8_t { omitted, derived, number, text, word, reference, list, record };

  Kind kind = Kind::omitted;
  std::uint32_t end = 0;  ///< index behind the value and its parts
  double number = 0;      ///< the number, or that of the referenced entity
  std::string_view text;  ///< the text as written, without quotes; the word without points; a record's type
};

class StepEntity;
class StepValues;

/// The entities of a STEP file (ISO 10303-21, "Part 21").
class Part21File {
 public:
  /// Reads the file in one pass. Throws InputError "file:line: ..." if it does not follow the format.
  explicit Part21File(std::string path);
  Part21File(const Part21File&) = delete;
  Part21File& operator=(const Part21File&) = delete;

  const std::string& path() const { return path_; }
  std::size_t size() const { return entities_.size(); }
  /// In the order of the file.
  StepEntity entity(std::size_t index) const;
  /// None if the file has no entity of this number.
  std::optional<StepEntity> find(std::uint64_t number) const;

 private:
  friend class Part21Parser;
  friend class StepEntity;
  friend class StepValue;
  friend class StepValues;
  struct Entity {
    std::uint64_t number = 0;
    std::uint32_t line = 0, value = 0;  ///< value: index of its record, or of a list of records
  };

  std::string path_, text_;
  std::vector<Entity> entities_;
  std::vector<Part21Value> values_;
  std::unordered_map<std::uint64_t, std::uint32_t> index_;
};

/// A value within an entity. Functions that need a certain kind throw InputError for others.
class StepValue {
 public:
  StepValue(const Part21File& file, std::uint32_t entity, std::uint32_t value)
      : file_{&file}, entity_{entity}, value_{value} {}

  Part21Value::Kind kind() const { return value().kind; }
  bool is_omitted() const;
  /// The number, also as a typed parameter such as LENGTH_MEASURE(2.54).
  double number() const;
  int small_integer() const;
  /// The text in UTF-8.
  std::string text() const;
  /// A word such as MILLI for .MILLI.; empty if the value is omitted.
  std::string_view word() const;
  bool flag() const;
  StepEntity entity() const;
  StepValues list() const;
  /// Whether it is a typed parameter of this type.
  bool is_record(std::string_view type) const;

 private:
  const Part21Value& value() const { return file_->values_[value_]; }
  [[noreturn]] void refuse(std::string_view expected) const;

  const Part21File* file_;
  std::uint32_t entity_, value_;
};

/// The values of a list, or the parameters of a record.
class StepValues {
 public:
  class Iterator {
   public:
    Iterator(const StepValues& values, std::uint32_t at) : values_{&values}, at_{at} {}
    StepValue operator*() const { return {*values_->file_, values_->entity_, at_}; }
    Iterator& operator++();
    bool operator!=(const Iterator& other) const { return at_ != other.at_; }

   private:
    const StepValues* values_;
    std::uint32_t at_;
  };

  StepValues(const Part21File& file, std::uint32_t entity, std::uint32_t begin, std::uint32_t end)
      : file_{&file}, entity_{entity}, begin_{begin}, end_{end} {}

  Iterator begin() const { return {*this, begin_}; }
  Iterator end() const { return {*this, end_}; }
  /// O(n).
  std::size_t size() const;
  /// O(i). Throws InputError if there are not so many.
  StepValue operator[](std::size_t i) const;
  /// Without the first `count` values.
  StepValues after(std::size_t count) const;

 private:
  const Part21File* file_;
  std::uint32_t entity_, begin_, end_;
};

/// An entity #n: one record, or several (a complex instance).
class StepEntity {
 public:
  StepEntity(const Part21File& file, std::uint32_t index) : file_{&file}, index_{index} {}

  std::uint64_t number() const { return entity().number; }
  /// The type of a simple instance; of a complex one the first type.
  std::string_view type() const;
  bool is_complex() const { return root().kind == Part21Value::Kind::list; }
  /// Whether it is of this type, or one of its records is.
  bool is(std::string_view type) const;
  /// The parameters of a record: the one of `type` in a complex instance; in a simple instance those after
  /// the `inherited` first ones, which belong to supertypes. Throws InputError if there is no such record.
  StepValues own(std::string_view type, std::size_t inherited) const;
  /// Throws InputError if the entity is not of this type.
  void require(std::string_view type) const;
  /// The name of a representation item in UTF-8; empty for '' and 'NONE'.
  std::string name() const;
  /// "file:line: TYPE #n".
  std::string place() const;
  /// "TYPE #n".
  std::string title() const;
  [[noreturn]] void refuse(const std::string& message) const;

 private:
  const Part21File::Entity& entity() const { return file_->entities_[index_]; }
  const Part21Value& root() const { return file_->values_[entity().value]; }
  std::optional<StepValues> record(std::string_view type) const;

  const Part21File* file_;
  std::uint32_t index_;
};

/// The text of a Part-21 string in UTF-8: '' for a quote, \\ for a backslash, \S\, \X\, \X2\ and \X4\ for
/// other characters. Line ends are dropped.
std::string text_of_part21(std::string_view written);

}  // namespace quadloop::io
