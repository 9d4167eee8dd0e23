#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "tests/support/world.hpp"

namespace quadloop::test {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  std::string pattern = fs::temp_directory_path() / "quadloop_test_XXXXXX";
  const bool made = !world().is_root() || mkdtemp(pattern.data()) != nullptr;
  std::vector<char> name;
  if (made) name.assign(pattern.begin(), pattern.end());
  world().broadcast(name);
  EXPECT_FALSE(name.empty()) << "no temporary folder can be made";
  path_.assign(name.begin(), name.end());
}

TemporaryFolder::~TemporaryFolder() {
  world().barrier();
  std::error_code ignored;
  if (world().is_root() && !path_.empty()) fs::remove_all(path_, ignored);
}

std::string TemporaryFolder::write(const std::string& name, const std::string& text) const {
  if (world().is_root()) {
    fs::create_directories(fs::path(file(name)).parent_path());
    std::ofstream(file(name), std::ios::binary) << text;
  }
  world().barrier();
  return file(name);
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace quadloop::test
