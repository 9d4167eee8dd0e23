// Cases of hundreds of outlines, with a table for each: time grows with their number, not with its square.
#include "tests/support/growth.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "quadloop/case/case_input.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

TEST(Growth, OfFilesAndTables) {
  const test::TemporaryFolder folder;
  const auto written = [&](int count) {
    const int rows = static_cast<int>(std::ceil(std::sqrt(count)));
    folder.write("frame.geom", fmt::format("1\nframe\n4\n0 0\n{0} 0\n{0} {0}\n0 {0}\n", 4 * rows));
    std::string files = "\"frame.geom\"", tables;
    for (int k = 0; k < count; ++k) {
      const int x = 4 * (k % rows) + 2, y = 4 * (k / rows) + 2;
      folder.write(fmt::format("{}.geom", k),
                   fmt::format("1\nisland_{0}\n3\n{1} {2}\n{1} {4}\n{3} {2}\n", k, x, y, x + 1, y + 1));
      files += fmt::format(", \"{}.geom\"", k);
      tables += fmt::format("[boundary.island_{}]\nspacing = 0.5\n", k);
    }
    return folder.write(
        fmt::format("{}.toml", count),
        fmt::format("[geometry]\nfile = [{}]\n[spacing]\nmin = 0.1\nmax = 1\n{}", files, tables));
  };
  const auto seconds = [&](int count) {
    const std::string path = written(count);
    Warnings warnings;
    return test::processor_seconds([&] {
      EXPECT_EQ(
          std::ssize(load_case(test::world(), {path, {}, {}, {}}, warnings).mesh->geometry.boundaries()),
          count + 1);
    });
  };
  const double of_few = seconds(250);
  test::expect_linear("files and tables of a case", of_few, seconds(8 * 250));
}

}  // namespace
}  // namespace quadloop
