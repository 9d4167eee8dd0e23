#include "tests/fuzz/input_files.hpp"

#include <stdlib.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "mesher/base/error.hpp"

namespace quadloop::fuzz {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view header = "=== ";

/// A path of at most two words, so that nothing outside the folder is written.
bool is_possible(std::string_view path) {
  constexpr std::string_view others = "._-/";
  const bool plain = std::ranges::all_of(path, [&](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           others.find(c) != std::string_view::npos;
  });
  return plain && !path.empty() && path.size() < 100 && path.front() != '/' && path.back() != '/' &&
         path.find("..") == std::string_view::npos && std::ranges::count(path, '/') <= 1;
}

void write_file(const std::string& path, std::string_view bytes) {
  std::error_code in_the_way;
  fs::create_directories(fs::path(path).parent_path(), in_the_way);
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace

Folder::Folder() : path_{fs::temp_directory_path() / "quadloop_fuzz_XXXXXX"} {
  if (mkdtemp(path_.data()) == nullptr) std::abort();
}

Folder::~Folder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void Folder::clear() const {
  for (const auto& entry : fs::directory_iterator(path_)) fs::remove_all(entry);
}

void write_input(const Folder& folder, std::string_view name, std::string_view input) {
  folder.clear();
  if (!input.starts_with(header)) {
    write_file(folder.file(name), input);
    return;
  }
  while (!input.empty()) {
    const std::size_t line = std::min(input.find('\n'), input.size());
    const std::string_view path = input.substr(header.size(), line - header.size());
    if (!is_possible(path)) throw InputError("no path within the folder: " + std::string(path));
    input.remove_prefix(std::min(line + 1, input.size()));
    const std::size_t next = input.starts_with(header) ? 0 : input.find("\n" + std::string(header));
    const std::size_t end = next == std::string_view::npos ? input.size() : next == 0 ? 0 : next + 1;
    write_file(folder.file(path), input.substr(0, end));
    input.remove_prefix(end);
  }
}

}  // namespace quadloop::fuzz
