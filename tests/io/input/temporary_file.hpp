#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "tests/support/temporary_folder.hpp"

namespace quadloop::test {

/// The folder of one test on one rank.
class InputFolder : public TemporaryFolder {
 public:
  std::filesystem::path path() const { return TemporaryFolder::path(); }
};

/// The message of the InputError that the call must throw, with `folder` cut out of it.
std::string refusal(const InputFolder& folder, const std::function<void()>& call);

}  // namespace quadloop::test
