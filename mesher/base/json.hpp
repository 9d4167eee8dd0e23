#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace quadloop {

/// Returns a quoted JSON string. Text that is not UTF-8 is taken as Latin-1.
std::string json_of(std::string_view text);

inline std::string json_of(const char* text) { return json_of(std::string_view(text)); }

/// Returns the shortest text that reads back to the same double; null if it is not finite.
std::string json_of(double value);

template <std::integral Number>
std::string json_of(Number value) {
  if constexpr (std::same_as<Number, bool>) return value ? "true" : "false";
  return std::to_string(value);
}

/// null if empty.
template <class Value>
std::string json_of(const std::optional<Value>& value);

/// Returns a list on one line.
template <class Value>
std::string json_of(const std::vector<Value>& values);

/// A JSON object with its members in the order of insertion. Duplicate names are not detected.
class JsonObject {
 public:
  template <class Value>
  void add(std::string_view name, const Value& value) {
    add_raw(name, json_of(value));
  }
  /// Adds a value that is already JSON.
  void add_raw(std::string_view name, std::string_view value) {
    members_.push_back(json_of(name) + ": " + std::string(value));
  }
  void append(const JsonObject& other) {
    members_.insert(members_.end(), other.members_.begin(), other.members_.end());
  }

  /// Returns the object on one line.
  std::string text() const;
  /// Returns one member per line, indented by `indent`.
  std::string lines(const std::string& indent = {}) const;

 private:
  std::vector<std::string> members_;
};

inline std::string json_of(const JsonObject& object) { return object.text(); }

/// Returns `[a, b]` for values that are already JSON.
std::string json_list(const std::vector<std::string>& values);

template <class Value>
std::string json_of(const std::optional<Value>& value) {
  return value ? json_of(*value) : "null";
}

template <class Value>
std::string json_of(const std::vector<Value>& values) {
  std::vector<std::string> parts;
  parts.reserve(values.size());
  for (const Value& value : values) parts.push_back(json_of(value));
  return json_list(parts);
}

}  // namespace quadloop
