// Values through a pipe, from a program that may fail; paths of inputs and outputs; staging folders. On one
// rank alone.
#include "io/files/reading/separate_reader.hpp"

#include <fcntl.h>
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

#include "io/cgns/cgns_contents.hpp"
#include "io/files/output_path.hpp"
#include "io/files/reading/input_file.hpp"
#include "io/files/reading/value_pipe.hpp"
#include "io/files/staging_folder.hpp"
#include "io/model/mesh_of_file.hpp"
#include "io/model/serialize_mesh.hpp"
#include "io/tree/tree_share.hpp"
#include "mesher/base/error.hpp"
#include "tests/io/sample_mesh.hpp"

namespace quadloop::io {
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

TEST(ValuePipe, TypesHaveSignatures) {
  EXPECT_EQ(signature_of<FileMesh>(), signature_of<FileMesh>());
  EXPECT_NE(signature_of<std::vector<int>>(), signature_of<std::vector<double>>());
  EXPECT_NE(signature_of<std::vector<int>>(), signature_of<std::vector<std::vector<int>>>());
  EXPECT_NE(signature_of<std::optional<int>>(), signature_of<std::optional<std::string>>());
  EXPECT_NE(signature_of<FileBoundary>(), signature_of<StripLayers>());
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

/// A script in the place of quadloop-reader.
struct ReadSeparately : testing::Test {
  ReadSeparately() {
    test::write_bytes(path, "some bytes");
    write_numbers("begin", std::vector<std::uint64_t>{ReaderProtocol::begin<std::string>()});
    write_numbers("end", std::vector<std::uint64_t>{ReaderProtocol::end});
  }
  ~ReadSeparately() override { ::unsetenv("QUADLOOP_READER"); }

  template <class Number>
  void write_numbers(const std::string& name, std::vector<Number> numbers) const {
    test::write_bytes(folder.file(name), std::string(reinterpret_cast<const char*>(numbers.data()),
                                                     numbers.size() * sizeof(Number)));
  }
  /// What such a reader sends first, but for a text.
  void write_status(int status, std::uint64_t length) const {
    write_numbers("status", std::vector<int>{status});
    write_numbers("length", std::vector<std::uint64_t>{length});
  }
  std::string read_by(const std::string& script) const {
    const std::string program = folder.file("reader");
    test::write_bytes(program, "#!/bin/sh\ncd '" + folder.path() + "'\n" + script + "\n");
    fs::permissions(program, fs::perms::owner_all);
    ::setenv("QUADLOOP_READER", program.c_str(), 1);
    return read_separately<std::string>("cgns", path, {"more"});
  }
  std::string refusal_of(const std::string& script) const {
    return test::refusal_text<Error>([&] { read_by(script); });
  }
  TemporaryFolder folder;
  std::string path = folder.file("a.cgns");
};

TEST_F(ReadSeparately, GivesWhatTheReaderSends) {
  write_status(0, 10);
  EXPECT_EQ(read_by("cat begin status length \"$4\" end >&3"), "some bytes");
  write_status(0, 4);  // what it is asked for, and nothing but its three standard files and the pipe
  const int ours = ::open("/dev/null", O_RDONLY), also_ours = ::dup(ours);
  EXPECT_EQ(read_by("test \"$3 $5\" = 'cgns more' && test \"$(ls /proc/self/fd | wc -l)\" -le 5 && "
                    "(cat begin status length; printf good; cat end) >&3"),
            "good");
  ::close(ours);
  ::close(also_ours);
}

TEST_F(ReadSeparately, AnErrorOfTheReaderIsThrownHere) {
  write_status(static_cast<int>(ExitStatus::bad_input), 5);
  const std::string script = "(cat begin status length; printf wrong; cat end) >&3";
  EXPECT_EQ(refusal_of(script), "wrong");
  write_status(static_cast<int>(ExitStatus::output_failed), 5);
  try {
    read_by(script);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::output_failed);
  }
  write_status(ReaderProtocol::too_much_memory, 5);
  EXPECT_TRUE(says(refusal_of(script), "a.cgns: is damaged: reading it takes more than 256 MB of memory"));
}

TEST_F(ReadSeparately, ACrashOrAnEarlyEndIsADamagedFile) {
  const std::string crashed = refusal_of("cat begin >&3; kill -SEGV $$");
  EXPECT_TRUE(says(crashed, "a.cgns: is damaged: the library that reads it crashed (")) << crashed;
  const std::string ended = refusal_of("cat begin >&3; exit 0");
  EXPECT_TRUE(says(ended, "a.cgns: is damaged: the library that reads it gave up")) << ended;
  const std::string slow = refusal_of("cat begin >&3; kill -XCPU $$");
  EXPECT_TRUE(says(slow, "a.cgns: is damaged: reading it did not end within 5 seconds")) << slow;
  write_status(0, 10);
  const std::string wrong = refusal_of("cat begin status length a.cgns begin >&3");
  EXPECT_TRUE(says(wrong, "a.cgns: is damaged: what was read from it did not come through")) << wrong;
}

TEST_F(ReadSeparately, AReaderThatIsNotThereOrNotOursIsNamed) {
  ::setenv("QUADLOOP_READER", "/nowhere/reader", 1);
  const std::string missing = test::refusal_text<Error>([&] { read_separately<std::string>("cgns", path); });
  EXPECT_TRUE(says(missing,
                   "a.cgns: cannot be read: the program that reads such files is not at "
                   "/nowhere/reader; install quadloop again, or set QUADLOOP_READER"))
      << missing;
  const std::string ended = refusal_of("exit 127");
  EXPECT_TRUE(says(ended, "/reader ended at once, with status 127; install quadloop again")) << ended;
  const std::string other = refusal_of("cat end begin >&3");
  EXPECT_TRUE(says(other, "/reader is of another version than this program")) << other;
}

TEST_F(ReadSeparately, IsDoneByTheProgramOfThisBuild) {
  const std::string refused = test::refusal_text<Error>([&] { read_separately<CgnsContents>("cgns", path); });
  EXPECT_TRUE(says(refused, "a.cgns: the CGNS library refuses: ")) << refused;
  const std::string no_tree = test::refusal_text<Error>([&] {
    read_separately<TreeShare>("tree", path, {"0", "1"});
  });
  EXPECT_TRUE(says(no_tree, "a.cgns: cannot be opened, or is no HDF5 file")) << no_tree;
  const std::string other = test::refusal_text<Error>([&] { read_separately<std::string>("cgns", path); });
  EXPECT_TRUE(says(other, "quadloop-reader is of another version than this program")) << other;
}

TEST_F(ReadSeparately, AMissingFileIsRefusedBeforeAnyReader) {
  EXPECT_TRUE(says(test::refusal_text<Error>([&] { read_separately<int>("cgns", folder.file("none")); }),
                   "cannot be opened"));
}

TEST(PassedMesh, IsRefusedWhereItNamesWhatItHasNot) {
  FileMesh mesh;
  mesh.points.resize(3);
  add_cell<CellKind::triangle>(mesh, std::array{0, 1, 2}, mesh.block_named("a"));
  EXPECT_NO_THROW(require_consistent(mesh, "m"));
  FileMesh other = mesh;
  other.triangles[0][2] = 3;
  EXPECT_THROW(require_consistent(other, "m"), InputError);
  other = mesh;
  other.cell_to_block[0][0] = 1;
  EXPECT_THROW(require_consistent(other, "m"), InputError);
  other = mesh;
  other.solution.emplace().names = {"p"};
  EXPECT_THROW(require_consistent(other, "m"), InputError);
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
}  // namespace quadloop::io
