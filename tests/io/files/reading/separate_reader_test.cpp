// Values through a pipe, from a child that may fail; paths of inputs and outputs; staging folders. On one
// rank alone.
#include "io/files/reading/separate_reader.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <thread>

#include "io/files/output_path.hpp"
#include "io/files/reading/input_file.hpp"
#include "io/files/reading/value_pipe.hpp"
#include "io/files/staging_folder.hpp"
#include "io/model/mesh_of_file.hpp"
#include "io/model/pass_mesh.hpp"
#include "mesher/base/error.hpp"
#include "tests/io/sample_mesh.hpp"

namespace quadloop {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// What comes out of a pipe into which a value was put, but for `lost` of its bytes.
template <class T>
T passed(T value) {
  std::array<int, 2> ends{};
  EXPECT_EQ(::pipe(ends.data()), 0);
  T result{};
  {
    PipeReader reader(ends[0]);
    std::thread sender([&] {
      PipeWriter writer(ends[1]);
      pass(writer, value);
      writer.flush();
    });
    pass(reader, result);
    sender.join();
  }
  return result;
}

TEST(ValuePipe, BringsValuesOfAnyShape) {
  EXPECT_EQ(passed(7.5), 7.5);
  EXPECT_EQ(passed(std::string("with \0 zero", 11)), std::string("with \0 zero", 11));
  EXPECT_EQ(passed(std::optional<std::string>()), std::nullopt);
  EXPECT_EQ(passed(std::optional<std::string>("")), "");
  EXPECT_EQ(passed(std::vector<std::vector<int>>{{}, {1}, {2, 3}}),
            (std::vector<std::vector<int>>{{}, {1}, {2, 3}}));
  std::vector<std::int64_t> many(300000);  // more than a pipe holds, and than is gathered before a write
  std::iota(many.begin(), many.end(), -5);
  EXPECT_EQ(passed(many), many);
}

TEST(ValuePipe, BringsAMeshWithItsSolution) {
  LoadedMesh loaded;
  loaded.mesh = test::sample_mesh(5);
  loaded.mesh.strips = {{"wake", {}, true, 1, {GlobalNodeId{2}}}};
  loaded.blocks = 2;
  loaded.triangle_to_block.assign(loaded.mesh.triangles.size(), 1);
  loaded.quad_to_block.assign(loaded.mesh.quads.size(), 0);
  loaded.block_names = {"a", ""};
  loaded.periodic_nodes = {NodeId{3}};
  loaded.solution = test::sample_solution(loaded.mesh);
  loaded.warnings = {"w"};
  const LoadedMesh found = loaded_mesh_of(passed(file_mesh_of(loaded)));
  EXPECT_EQ(found.mesh.points, loaded.mesh.points);
  EXPECT_EQ(found.mesh.owned_nodes, loaded.mesh.owned_nodes);
  EXPECT_EQ(found.mesh.triangles, loaded.mesh.triangles);
  EXPECT_EQ(found.mesh.quads, loaded.mesh.quads);
  ASSERT_EQ(found.mesh.boundaries.size(), loaded.mesh.boundaries.size());
  EXPECT_EQ(found.mesh.boundaries[1].name, loaded.mesh.boundaries[1].name);
  EXPECT_EQ(found.mesh.boundaries[1].condition, loaded.mesh.boundaries[1].condition);
  EXPECT_EQ(found.mesh.boundaries[1].edges, loaded.mesh.boundaries[1].edges);
  ASSERT_EQ(found.mesh.strips.size(), 1U);
  EXPECT_EQ(found.mesh.strips[0].name, "wake");
  EXPECT_EQ(found.mesh.strips[0].nodes, loaded.mesh.strips[0].nodes);
  EXPECT_EQ(found.blocks, 2);
  EXPECT_EQ(found.triangle_to_block, loaded.triangle_to_block);
  EXPECT_EQ(found.quad_to_block, loaded.quad_to_block);
  EXPECT_EQ(found.block_names, loaded.block_names);
  EXPECT_EQ(found.periodic_nodes, loaded.periodic_nodes);
  EXPECT_EQ(found.solution->names, loaded.solution->names);
  EXPECT_EQ(found.solution->values, loaded.solution->values);
  EXPECT_EQ(found.solution->constants, loaded.solution->constants);
  EXPECT_EQ(found.warnings, loaded.warnings);
}

TEST(ValuePipe, EndsWhereTheValuesDo) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  PipeReader reader(ends[0]);
  {
    PipeWriter writer(ends[1]);
    std::uint64_t promised = std::uint64_t{1} << 40;  // memory is taken as values come
    pass(writer, promised);
    writer.flush();
  }
  std::vector<char> result;
  EXPECT_THROW(pass(reader, result), PipeEnded);
}

struct ReadSeparately : testing::Test {
  ReadSeparately() { test::write_bytes(path, "some bytes"); }
  std::string by(const std::function<std::string()>& read) const {
    return read_separately<std::string>(path, read);
  }
  TemporaryFolder folder;
  std::string path = folder.file("a.cgns");
};

TEST_F(ReadSeparately, GivesWhatTheChildHasRead) {
  int here = 0;
  const std::string text = by([&] {
    here = 1;  // in the child alone
    return test::bytes_of(path);
  });
  EXPECT_EQ(text, "some bytes");
  EXPECT_EQ(here, 0);
}

TEST_F(ReadSeparately, AnErrorOfTheChildIsThrownHere) {
  EXPECT_EQ(
      test::refusal_text<Error>([&] { by([]() -> std::string { throw InputError("line 3 is wrong"); }); }),
      "line 3 is wrong");
  try {
    by([]() -> std::string { throw OutputError("full"); });
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::output_failed);
  }
}

TEST_F(ReadSeparately, ACrashOrAnEarlyEndIsADamagedFile) {
  const auto crashed = test::refusal_text<Error>([&] {
    by([]() -> std::string {
      ::raise(SIGSEGV);
      return {};
    });
  });
  EXPECT_TRUE(says(crashed, "a.cgns: is damaged: the library that reads it crashed (")) << crashed;
  const auto ended = test::refusal_text<Error>([&] { by([]() -> std::string { std::exit(0); }); });
  EXPECT_TRUE(says(ended, "a.cgns: is damaged: the library that reads it gave up")) << ended;
}

TEST_F(ReadSeparately, AMissingFileIsRefusedBeforeAnyChild) {
  EXPECT_TRUE(
      says(test::refusal_text<Error>([&] { read_separately<int>(folder.file("none"), [] { return 1; }); }),
           "cannot be opened"));
}

TEST(InputFile, WhatIsNoFileIsRefused) {
  const TemporaryFolder folder;
  EXPECT_TRUE(
      says(test::refusal_text<Error>([&] { read_input(folder.path()); }), "is a folder; name a file in it"));
  EXPECT_TRUE(says(test::refusal_text<Error>([&] { read_input(folder.file("none")); }), "cannot be opened"));
  EXPECT_TRUE(says(test::refusal_text<Error>([&] { read_input("/dev/zero"); }), "is a device"));
  EXPECT_TRUE(says(test::refusal_text<Error>([&] { require_input_file(folder.file(std::string(300, 'a'))); }),
                   "give a shorter name"));
  const std::string pipe = folder.file("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_TRUE(says(test::refusal_text<Error>([&] { read_input(pipe); }), "is a pipe"));
}

TEST(InputFile, PipesAreReadWhereTheyAreAllowed) {
  const TemporaryFolder folder;
  const std::string pipe = folder.file("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  allow_piped_input(true);
  std::thread writer([&] { std::ofstream(pipe) << "through the pipe"; });
  EXPECT_EQ(read_input(pipe), "through the pipe");
  writer.join();
  EXPECT_TRUE(says(test::refusal_text<Error>([&] { require_input_file(pipe); }), "is a pipe"));
  allow_piped_input(false);
}

TEST(InputFile, EveryByteIsRead) {
  const TemporaryFolder folder;
  const std::string bytes("a\0\r\n\xff", 5);
  test::write_bytes(folder.file("a"), bytes);
  EXPECT_EQ(read_input(folder.file("a")), bytes);
  test::write_bytes(folder.file("empty"), "");
  EXPECT_EQ(read_input(folder.file("empty")), "");
}

TEST(OutputPath, LinksAreFollowedToWhatTheyStandFor) {
  const TemporaryFolder folder;
  fs::create_directory(folder.file("there"));
  fs::create_symlink("there/file", folder.file("link"));
  fs::create_symlink("link", folder.file("link_to_link"));
  EXPECT_EQ(output_target(folder.file("plain")), folder.file("plain"));
  EXPECT_EQ(output_target(folder.file("link_to_link")), folder.file("there/file"))
      << "which is not there yet";
  fs::create_symlink("round", folder.file("round"));
  EXPECT_NE(test::refusal_text<Error>([&] { output_target(folder.file("round")); }), "");
}

TEST(OutputPath, WhatCannotBecomeAFileIsRefused) {
  const TemporaryFolder folder;
  EXPECT_TRUE(says(test::refusal_text<Error>([&] { require_possible_output(folder.path()); }),
                   "is a folder, not a file"));
  EXPECT_TRUE(says(test::refusal_text<Error>([&] { require_possible_output(folder.file("no/file")); }),
                   "does not exist; create it first"));
  EXPECT_TRUE(says(test::refusal_text<Error>([&] { require_possible_output("/dev/null"); }), "is a device"));
  EXPECT_TRUE(says(test::refusal_text<Error>([&] { require_possible_output("/dev/./stdout"); }),
                   "is a stream of the process"));
  EXPECT_TRUE(
      says(test::refusal_text<Error>([&] { require_possible_output(folder.file(std::string(300, 'a'))); }),
           "give a shorter name"));
  fs::create_symlink("no/file", folder.file("link"));
  EXPECT_TRUE(says(test::refusal_text<Error>([&] { require_possible_output(folder.file("link")); }),
                   "link: cannot be written: the folder"));
}

TEST(OutputPath, FoldersOfPaths) {
  EXPECT_EQ(folder_of("a"), ".");
  EXPECT_EQ(folder_of("a/b"), "a");
  EXPECT_EQ(folder_of("/b"), "/");
}

TEST(StagingFolder, IsOneOwnsAloneAndGoesWithAllInIt) {
  const TemporaryFolder folder;
  std::string first, second;
  {
    StagingFolder one(folder.path(), "out.mesh"), other(folder.path(), "out.mesh");
    first = one.new_file("out.mesh");
    second = one.new_file("out.mesh");
    EXPECT_NE(first, second);
    EXPECT_NE(folder_of(first), folder_of(other.new_file("out.mesh")));
    EXPECT_EQ(fs::file_size(first), 0U);
    EXPECT_EQ(fs::status(folder_of(first)).permissions() & fs::perms::others_all, fs::perms::none);
    EXPECT_EQ(one.parent(), folder.path());
  }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(StagingFolder, RemovesWhatAKilledRunLeftButNotWhatALivingOneNeeds) {
  const TemporaryFolder folder;
  const pid_t child = ::fork();
  if (child == 0) {
    StagingFolder left(folder.path(), "out.mesh");
    left.new_file("out.mesh");
    ::_exit(0);  // no destructor runs
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(test::files_in(folder.path()), 1U);
  const StagingFolder living(folder.path(), "out.mesh");
  EXPECT_EQ(test::files_in(folder.path()), 1U) << "its own";
  const StagingFolder another(folder.path(), "out.mesh");
  EXPECT_EQ(test::files_in(folder.path()), 2U);
}

TEST(StagingFolder, InNoFolderIsRefused) {
  EXPECT_TRUE(says(test::refusal_text<Error>([] { StagingFolder("/nowhere/at/all", "out.mesh"); }),
                   "out.mesh: cannot be written"));
}

}  // namespace
}  // namespace quadloop
