// Damaged files of the formats that we parse ourselves: flipped bits, cut ends, other numbers, pieces that
// stand twice. Whatever comes is read as a mesh or refused with a place; nothing else is thrown, and no
// memory is taken that the file does not explain. Seeded; QUADLOOP_DAMAGES sets how many.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "io/mesh_file.hpp"
#include "io/model/tidy_mesh.hpp"
#include "io/solution_file.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::io {
namespace {

using test::TemporaryFolder;

int damages() {
  const char* const text = std::getenv("QUADLOOP_DAMAGES");
  return text == nullptr ? 1500 : std::atoi(text);
}

/// As much more memory as a file of a few kilobytes can never need.
void limit_memory() {
  std::ifstream statm("/proc/self/statm");
  std::array<rlim_t, 6> pages{};
  for (rlim_t& number : pages) statm >> number;
  const rlim_t bytes = pages[5] * 4096 + (rlim_t{1} << 30);
  rlimit limit{};
  ASSERT_EQ(getrlimit(RLIMIT_DATA, &limit), 0);
  limit.rlim_cur = std::min(bytes, limit.rlim_max);
  ASSERT_EQ(setrlimit(RLIMIT_DATA, &limit), 0);
}

class Damager {
 public:
  explicit Damager(unsigned seed) : random_{seed} {}

  std::string damaged(std::string text) {
    for (std::size_t times = 1 + below(3); times > 0; --times) damage(text);
    return text;
  }

 private:
  std::size_t below(std::size_t end) { return end == 0 ? 0 : random_() % end; }

  void damage(std::string& text) {
    const std::size_t at = below(text.size());
    switch (below(6)) {
      case 0:
      case 1: flip(text, at); break;
      case 2: text.resize(at); break;
      case 3: text.erase(at, below(40)); break;
      case 4: text.insert(at, text.substr(below(text.size()), below(60))); break;
      default: replace_number(text, at); break;
    }
  }

  void flip(std::string& text, std::size_t at) {
    if (!text.empty()) text[at] = static_cast<char>(static_cast<unsigned>(text[at]) ^ (1U << below(8)));
  }

  void replace_number(std::string& text, std::size_t at) {
    static const std::array<const char*, 14> numbers{"-1",
                                                     "0",
                                                     "2147483647",
                                                     "2147483648",
                                                     "4294967295",
                                                     "9223372036854775807",
                                                     "99999999999999999999",
                                                     "1e999",
                                                     "nan",
                                                     "-inf",
                                                     "268435456",
                                                     "1",
                                                     "0x10",
                                                     "-9223372036854775808"};
    const std::size_t begin = text.find_first_of("0123456789", at);
    if (begin == std::string::npos) return;
    const std::size_t end = std::min(text.find_first_not_of("0123456789.e+-", begin), text.size());
    text.replace(begin, end - begin, numbers[below(numbers.size())]);
  }

  std::mt19937 random_;
};

/// Reads `damages()` damaged copies of what `path` holds.
void expect_read_or_refused(const std::string& path, const std::function<void(const std::string&)>& read) {
  limit_memory();
  const std::string whole = test::bytes_of(path);
  ASSERT_NO_THROW(read(path));
  Damager damager(12);
  int refused = 0;
  for (int n = 0; n < damages(); ++n) {
    const std::string text = damager.damaged(whole);
    std::filesystem::remove(
        path);  // a file cut to nothing and written again is brought to the disk at once, a new one is not
    test::write_bytes(path, text);
    try {
      read(path);
    } catch (const InputError&) {
      ++refused;
    } catch (const std::exception& other) {
      const std::string kept =
          std::filesystem::temp_directory_path() /
          ("quadloop_damaged_" + std::to_string(getpid()) + path.substr(path.rfind('.')));
      test::write_bytes(kept, text);
      FAIL() << "damage " << n << ": " << other.what() << "; the file is kept as " << kept;
    }
  }
  EXPECT_GT(refused, damages() / 4);
}

/// What `check` does with a mesh, and `smooth` before it begins.
void read_and_look(const std::string& path) {
  LoadedMesh loaded = read_mesh(path);
  validate(loaded.mesh, {loaded.blocks, loaded.triangle_to_block, loaded.quad_to_block});
  tidy_mesh(loaded, path);
}

void damage_written(const std::string& name) {
  const TemporaryFolder folder;
  const Mesh mesh = test::sample_mesh(7);
  const Field solution = test::sample_solution(mesh);
  OutputSet outputs(test::world());
  write_mesh(outputs, mesh, folder.file(name), &solution);
  outputs.commit();
  expect_read_or_refused(folder.file(name), read_and_look);
}

TEST(DamagedFile, OfTheNativeFormat) { damage_written("m.mesh"); }
TEST(DamagedFile, OfTheBinaryFormat) { damage_written("m.qmesh"); }
TEST(DamagedFile, OfVtk) { damage_written("m.vtu"); }
TEST(DamagedFile, OfSu2) { damage_written("m.su2"); }
TEST(DamagedFile, OfGmsh) { damage_written("m.msh"); }
TEST(DamagedFile, OfFluent) { damage_written("m.fluent.msh"); }
TEST(DamagedFile, OfUgrid) { damage_written("m.ugrid"); }
TEST(DamagedFile, OfMedit) { damage_written("m.medit"); }

TEST(DamagedFile, OfSu2WithZones) {
  const TemporaryFolder folder;
  const std::string zone =
      "NDIME= 2\nNELEM= 2\n9 0 1 2 3 0\n5 3 2 4 1\nNPOIN= 5\n0 0 0\n1 0 1\n1 1 2\n0 1 3\n0.5 1.5 4\n"
      "NMARK= 2\nMARKER_TAG= SEND_RECEIVE\nMARKER_ELEMS= 1\nSEND_TO= 1\n1 0 0\n"
      "MARKER_TAG= walls\nMARKER_ELEMS= 5\n3 0 1\n3 1 2\n3 2 4\n3 4 3\n3 3 0\n";
  test::write_bytes(folder.file("m.su2"), "NZONE= 2\nIZONE= 1\n" + zone + "IZONE= 2\n" + zone);
  expect_read_or_refused(folder.file("m.su2"), read_and_look);
}

TEST(DamagedFile, OfGmshsNewFormat) {
  const TemporaryFolder folder;
  test::write_bytes(folder.file("m.msh"),
                    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 5 \"wall\"\n2 6 "
                    "\"water\"\n$EndPhysicalNames\n"
                    "$Entities\n1 2 1 0\n1 0 0 0 0\n1 0 0 0 2 0 0 1 5 2 1 -1\n2 0 0 0 0 1 0 0 2 1 -1\n1 0 0 "
                    "0 2 1 0 1 6 2 1 2\n$EndEntities\n"
                    "$Nodes\n2 6 1 6\n1 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n2 0 0\n2 1 0\n2 1 0 2\n5\n6\n1 1 "
                    "0\n0 1 0\n$EndNodes\n"
                    "$Elements\n3 5 1 5\n1 1 1 2\n1 1 2\n2 2 3\n2 1 3 1\n3 1 2 5 6\n2 1 2 2\n4 2 3 4\n5 2 4 "
                    "5\n$EndElements\n");
  expect_read_or_refused(folder.file("m.msh"), read_and_look);
}

/// An array of the appended data: its size, then its values.
template <class T>
std::string with_size(const std::vector<T>& values) {
  std::string bytes(8 + values.size() * sizeof(T), '\0');
  const std::uint64_t size = values.size() * sizeof(T);
  std::memcpy(bytes.data(), &size, 8);
  std::memcpy(bytes.data() + 8, values.data(), values.size() * sizeof(T));
  return bytes;
}

TEST(DamagedFile, OfVtkWithRawData) {
  const TemporaryFolder folder;
  const std::array<std::string, 4> arrays{with_size<double>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 0.5, 0}),
                                          with_size<std::int64_t>({0, 1, 2, 3, 1, 4, 2}),
                                          with_size<std::int64_t>({4, 7}), with_size<std::uint8_t>({9, 5})};
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
      "<UnstructuredGrid><Piece NumberOfPoints=\"5\" NumberOfCells=\"2\"><Points>\n"
      "<DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" format=\"appended\" "
      "offset=\"0\"/></Points><Cells>\n";
  std::string data = arrays[0];
  const std::array<const char*, 3> heads{"Int64\" Name=\"connectivity", "Int64\" Name=\"offsets",
                                         "UInt8\" Name=\"types"};
  for (std::size_t k = 0; k < heads.size(); ++k) {
    text += std::string("<DataArray type=\"") + heads[k] + "\" format=\"appended\" offset=\"" +
            std::to_string(data.size()) + "\"/>\n";
    data += arrays[k + 1];
  }
  text += "</Cells></Piece></UnstructuredGrid><AppendedData encoding=\"raw\">_" + data +
          "</AppendedData></VTKFile>\n";
  test::write_bytes(folder.file("m.vtu"), text);
  expect_read_or_refused(folder.file("m.vtu"), read_and_look);
}

TEST(DamagedFile, OfSu2sRestart) {
  const TemporaryFolder folder;
  test::write_bytes(folder.file("s.csv"),
                    "\"PointID\",\"x\",\"y\",\"Density\",\"Momentum_x\"\n0, 0.0, 0, 1.0, 2e-1\n1, 1, 0.5, 3, "
                    "-4\n2, 1, 2, 5, 6\n");
  expect_read_or_refused(folder.file("s.csv"), [](const std::string& path) { read_solution(path); });
}

}  // namespace
}  // namespace quadloop::io
