#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "quadloop/case/settings.hpp"
#include "tests/io/input/temporary_file.hpp"

namespace quadloop::test {

/// Cases whose geometry is a box from (0, 0) to (4, 4) in box.geom, unless a test writes another.
class SettingsFixture : public ::testing::Test {
 protected:
  SettingsFixture() { folder_.write("box.geom", "1\nbox\n4\n0 0\n4 0\n4 4\n0 4\n"); }

  Settings read(const std::string& text, const std::vector<std::string>& assignments = {}) {
    return read_settings(folder_.write("case.toml", "[geometry]\nfile = \"box.geom\"\n" + text), assignments);
  }
  Geometry load(const Settings& settings) {
    warnings_.clear();
    return load_geometry(settings, warnings_);
  }
  /// The refusal of case text that follows two lines of [geometry].
  std::string refused(const std::string& text) {
    return test::refusal(folder_, [&] { load(read(text)); });
  }

  test::InputFolder folder_;
  Warnings warnings_;  ///< of the last geometry
};

}  // namespace quadloop::test
