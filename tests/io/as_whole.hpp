#pragma once

#include <gtest/gtest.h>

#include <string>
#include <variant>

#include "io/formats.hpp"
#include "io/model/distribute.hpp"
#include "tests/io/read_plane.hpp"
#include "tests/io/same_mesh.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/world.hpp"

namespace quadloop::test {

/// Reads a file with all ranks, as commands do, and as a whole on one rank with `read_whole`. Compares the
/// meshes, or the errors. *Collective.*
template <auto read_whole>
void expect_as_whole(const std::string& format, const std::string& path) {
  io::MeshOfFile part;
  io::LoadedMesh wanted;
  const std::string refusal = refusal_text([&] { part = io::format_named(format)->read(world(), path); }),
                    of_one = refusal_text([&] { wanted = read_plane<read_whole>(path); });
  EXPECT_EQ(refusal, of_one);
  if (!refusal.empty() || !of_one.empty() || !std::holds_alternative<io::LoadedMesh>(part)) return;
  const io::LoadedMesh whole = io::gathered(world(), std::get<io::LoadedMesh>(part));
  if (world().is_root()) expect_same(whole, wanted);
}

}  // namespace quadloop::test
