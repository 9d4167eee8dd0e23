#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

#include "mesher/base/ids.hpp"

namespace quadloop::io {

/// Numbers names in the order of their first occurrence and finds them in constant time: a file may have
/// hundreds of thousands of boundaries.
class NameIndex {
 public:
  /// The name's number; `is_new`: first occurrence.
  struct Entry {
    std::int32_t number;
    bool is_new;
  };
  Entry entry_of(const std::string& name) {
    const auto [found, added] = numbers_.try_emplace(name, size32(numbers_));
    return {found->second, added};
  }

 private:
  std::unordered_map<std::string, std::int32_t> numbers_;
};

/// Makes names distinct: returns the wanted name, or that with the first free suffix _2, _3, ...
class DistinctNames {
 public:
  void reserve(const std::string& name) { used_.insert(name); }

  /// `with_suffix(suffix)` is the wanted name with a suffix.
  template <class WithSuffix>
  std::string name(const std::string& wanted, const WithSuffix& with_suffix) {
    std::string result = wanted;
    if (used_.contains(result)) {
      std::int64_t& number = next_suffix_.try_emplace(wanted, 2).first->second;  // lower numbers are used up
      while (used_.contains(result = with_suffix(suffix_of(number)))) ++number;
    }
    used_.insert(result);
    return result;
  }

 private:
  static std::string suffix_of(std::int64_t number) {
    return std::string("_").append(std::to_string(number));
  }

  std::unordered_set<std::string> used_;
  std::unordered_map<std::string, std::int64_t> next_suffix_;  ///< by the wanted name
};

}  // namespace quadloop::io
