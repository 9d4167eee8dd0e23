#include <stdlib.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "io/gis/gis_formats.hpp"
#include "io/input/case_file.hpp"
#include "io/input/geometry_file.hpp"
#include "io/mesh_file.hpp"
#include "io/model/tidy_mesh.hpp"
#include "io/solution_file.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/suffix.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace quadloop::fuzz {

namespace {

namespace fs = std::filesystem;

/// A folder of this process alone, removed at its end.
class Folder {
 public:
  Folder() : path_{fs::temp_directory_path() / "quadloop_fuzz_XXXXXX"} {
    if (mkdtemp(path_.data()) == nullptr) std::abort();
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string file(std::string_view name) const { return path_ + "/" + std::string(name); }

 private:
  std::string path_;
};

/// What `check` does with a mesh, and `smooth` before it begins.
void read_and_look(const std::string& path) {
  LoadedMesh loaded = read_mesh(path);
  validate(loaded.mesh, {loaded.blocks, loaded.triangle_to_block, loaded.quad_to_block});
  tidy_mesh(loaded, path);
}

void read_file(std::string_view name, const std::uint8_t* data, std::size_t size) {
  static const Folder folder;
  const std::string path = folder.file(name);
  fs::remove(path);
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  std::vector<std::string> warnings;
  if (name.ends_with(".toml")) {
    const CaseTable table = read_case(path);
    table.values({});
  } else if (name.ends_with(".csv")) {
    read_solution(path);
  } else if (name.ends_with(".geom") || name.ends_with(".dat") || name.ends_with(".dxf") ||
             name.ends_with(".geojson")) {
    add_gis_formats();
    read_outline(path, warnings);
  } else {
    read_and_look(path);
  }
}

void run_unguarded(std::string_view target, const std::uint8_t* data, std::size_t size) {
  if (target == "cut") {
    cut_leaf(data, size);
  } else if (target == "flips") {
    flip_edges(data, size);
  } else {
    read_file(target, data, size);
  }
}

}  // namespace

std::string run(std::string_view target, const std::uint8_t* data, std::size_t size) {
  try {
    run_unguarded(target, data, size);
    return {};
  } catch (const InputError& refusal) {
    return refusal.what();
  } catch (const std::exception& other) {
    std::fprintf(stderr, "finding: %s\n", other.what());
    std::abort();
  }
}

}  // namespace quadloop::fuzz
