#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/vtu/vtu_document.hpp"

namespace quadloop::io {

/// Reads the numbers of a document's arrays in any encoding. Errors name the line of the array.
class VtuNumbers {
 public:
  /// Both must outlive the object.
  VtuNumbers(const TextScanner& scan, const VtuDocument& document) : scan_{scan}, document_{document} {}

  /// `count` is the expected number; empty: all there are.
  std::vector<double> reals(const VtuArray& array, std::optional<std::int64_t> count) const;
  std::vector<std::int64_t> integers(const VtuArray& array, std::optional<std::int64_t> count) const;
  /// Reads an array of type String, or of byte codes: each string ends with 0.
  std::vector<std::string> texts(const VtuArray& array) const;

 private:
  template <class Number>
  std::vector<Number> numbers(const VtuArray& array, std::optional<std::int64_t> count) const;
  template <class Number>
  std::vector<Number> ascii_numbers(const VtuArray& array, std::optional<std::int64_t> count) const;
  template <class Number>
  std::vector<Number> converted(const VtuArray& array, const std::vector<char>& bytes) const;
  std::vector<char> bytes(const VtuArray& array, std::optional<std::size_t> count) const;
  [[noreturn]] void refuse(const VtuArray& array, const std::string& message) const;

  const TextScanner& scan_;
  const VtuDocument& document_;
};

}  // namespace quadloop::io
