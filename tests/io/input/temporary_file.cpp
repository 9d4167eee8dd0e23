#include "tests/io/input/temporary_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "mesher/base/error.hpp"

namespace quadloop::test {

InputFolder::InputFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "quadloop_test_XXXXXX").string();
  EXPECT_NE(mkdtemp(pattern.data()), nullptr);
  path_ = pattern;
}

InputFolder::~InputFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string InputFolder::write(const std::string& name, const std::string& text) const {
  std::ofstream(path_ / name, std::ios::binary) << text;
  return (path_ / name).string();
}

std::string refusal(const InputFolder& folder, const std::function<void()>& call) {
  try {
    call();
  } catch (const InputError& error) {
    std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << "a refusal is one line";
    const std::string prefix = folder.path().string() + "/";
    for (auto at = message.find(prefix); at != std::string::npos; at = message.find(prefix))
      message.erase(at, prefix.size());
    return message;
  }
  ADD_FAILURE() << "nothing was refused";
  return {};
}

}  // namespace quadloop::test
