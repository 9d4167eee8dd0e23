#include "io/formats.hpp"

#include <algorithm>
#include <filesystem>

#include "io/cgns/cgns_file.hpp"
#include "io/cgns/cgns_names.hpp"
#include "io/msh/msh_file.hpp"
#include "io/native/native_file.hpp"
#include "io/su2/su2_csv_file.hpp"
#include "io/su2/su2_file.hpp"
#include "io/vtu/vtu_file.hpp"

namespace quadloop {

namespace {

using enum Content;
using Path = std::string;
using Names = std::vector<std::string>;

const char* const append_rows = "let the solver append its variables, a row of values for each node";

FileFormat native_format() {
  return {"mesh", "", {mesh, solution, constants, blocks}, append_rows, read_native, nullptr,
          [](OutputSet& outputs, const Mesh& mesh, const Path& path, const Field* solution, double) {
            write_native(outputs, mesh, path, solution);
          },
          write_native, nullptr};
}

FileFormat cgns_format() {
  return {"cgns", "", {mesh, solution, conditions}, append_rows, read_cgns, nullptr,
          [](OutputSet& outputs, const Mesh& mesh, const Path& path, const Field* solution, double) {
            write_cgns(outputs, mesh, path, solution);
          },
          [](OutputSet& outputs, const LoadedMesh& whole, const Path& path) {
            write_cgns(outputs, whole.mesh, path, whole.solution ? &*whole.solution : nullptr);
          },
          cgns_boundary_names};
}

FileFormat vtu_format() {
  return {"vtu", "", {mesh, solution, blocks},
          "let the solver save values at points (in ParaView: Cell Data to Point Data)", read_vtu, nullptr,
          [](OutputSet& outputs, const Mesh& mesh, const Path& path, const Field* solution, double) {
            write_vtu(outputs, mesh, path, solution);
          },
          write_vtu, nullptr};
}

FileFormat su2_format() {
  return {"su2", "", {mesh}, append_rows, read_su2, nullptr,
          [](OutputSet& outputs, const Mesh& mesh, const Path& path, const Field*, double) {
            write_su2(outputs, mesh, path);
          },
          [](OutputSet& outputs, const LoadedMesh& whole, const Path& path) {
            write_su2(outputs, whole.mesh, path);
          },
          su2_marker_names};
}

FileFormat msh_format() {
  return {"msh", "", {mesh, blocks}, append_rows, read_msh, nullptr,
          [](OutputSet& outputs, const Mesh& mesh, const Path& path, const Field*, double) {
            write_msh(outputs, mesh, path);
          },
          write_msh,
          [](const Names& names) {
            Names written = names;
            std::ranges::transform(names, written.begin(), msh_group_name);
            return written;
          }};
}

FileFormat su2_csv_format() {
  return {"csv", "SU2", {solution}, append_rows, nullptr, read_su2_csv,
          [](OutputSet& outputs, const Mesh& mesh, const Path& path, const Field* solution, double gamma) {
            if (solution != nullptr) write_su2_csv(outputs, mesh, path, *solution, gamma);
          },
          nullptr, nullptr};
}

}  // namespace

bool FileFormat::holds(Content content) const { return std::ranges::count(places, content) > 0; }

const std::vector<FileFormat>& file_formats() {
  static const std::vector<FileFormat> formats{native_format(), cgns_format(), vtu_format(),
                                               su2_format(),    msh_format(),  su2_csv_format()};
  return formats;
}

const FileFormat* format_named(const std::string& name) {
  const auto found = std::ranges::find(file_formats(), name, &FileFormat::name);
  return found == file_formats().end() ? nullptr : &*found;
}

const FileFormat* format_of(const std::string& path) {
  const std::string suffix = std::filesystem::path(path).extension();
  return suffix.empty() ? nullptr : format_named(suffix.substr(1));
}

std::vector<std::string> formats_for(std::initializer_list<Content> contents) {
  std::vector<std::string> names;
  for (const FileFormat& format : file_formats()) {
    if (std::ranges::all_of(contents, [&](Content content) { return format.holds(content); }))
      names.push_back(format.name);
  }
  return names;
}

std::string suffixes_for(std::initializer_list<Content> contents, const std::string& last) {
  const std::vector<std::string> names = formats_for(contents);
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " " + last + " " : ", ";
    text += "." + names[i];
  }
  return text;
}

}  // namespace quadloop
