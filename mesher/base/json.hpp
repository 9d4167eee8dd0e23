#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace quadloop {

/// The text between quotes as JSON wants it. Bytes that are no UTF-8 are taken as Latin-1.
std::string json_of(std::string_view text);

inline std::string json_of(const char* text) { return json_of(std::string_view(text)); }

/// The shortest text that reads back to the same double; null where it is not finite.
std::string json_of(double value);

template <std::integral Number>
std::string json_of(Number value) {
  if constexpr (std::same_as<Number, bool>) return value ? "true" : "false";
  return std::to_string(value);
}

/// null where there is none.
template <class Value>
std::string json_of(const std::optional<Value>& value);

/// A list on one line.
template <class Value>
std::string json_of(const std::vector<Value>& values);

/// A JSON object with its members in the order in which they are added. Names are not looked at for
/// repetition.
class JsonObject {
 public:
  template <class Value>
  void add(std::string_view name, const Value& value) {
    add_raw(name, json_of(value));
  }
  /// A value that is JSON already.
  void add_raw(std::string_view name, std::string_view value) {
    members_.push_back(json_of(name) + ": " + std::string(value));
  }
  void append(const JsonObject& other) {
    members_.insert(members_.end(), other.members_.begin(), other.members_.end());
  }

  /// On one line.
  std::string text() const;
  /// A member a line, below `indent`.
  std::string lines(const std::string& indent = {}) const;

 private:
  std::vector<std::string> members_;
};

inline std::string json_of(const JsonObject& object) { return object.text(); }

/// `[a, b]` of values that are JSON already.
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
