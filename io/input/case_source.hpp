#pragma once

#include <optional>
#include <string>
#include <utility>

namespace quadloop::io {

/// A case file, or a case as TOML text.
struct CaseSource {
  CaseSource(std::string file) : path{std::move(file)} {}
  CaseSource(const char* file) : path{file} {}
  /// `name` stands for the file in messages, without line numbers; relative paths begin at its folder.
  CaseSource(std::string name, std::string toml) : path{std::move(name)}, text{std::move(toml)} {}

  std::string path;
  std::optional<std::string> text = {};
};

}  // namespace quadloop::io
