#include "tests/io/input/temporary_file.hpp"

#include <gtest/gtest.h>

#include "mesher/base/error.hpp"

namespace quadloop::test {

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
