#include "adapt/solvers/openfoam_template.hpp"

#include <unistd.h>

#include <algorithm>
#include <system_error>

#include "io/files/reading/input_file.hpp"
#include "io/foam/foam_fields.hpp"
#include "io/foam/foam_text.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::adapt {

namespace {

namespace fs = std::filesystem;

/// Whether the folder contains a cycle of an adaptive run, complete or in progress.
bool is_of_a_run(const fs::path& folder) {
  std::error_code fault;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, fault)) {
    const std::string name = entry.path().filename();
    constexpr std::string_view head = "cycle_";
    const bool is_cycle =
        name.starts_with(head) && name.find_first_of("0123456789", head.size()) == head.size();
    if (is_cycle && entry.is_directory(fault)) return true;
  }
  return false;
}

class Listing {
 public:
  explicit Listing(const fs::path& root) : root_{root} { add_folder(root); }
  std::vector<std::string> take() {
    std::ranges::sort(files_);
    return std::move(files_);
  }

 private:
  void add_folder(const fs::path& folder) {
    std::error_code fault;
    const fs::path real = fs::canonical(folder, fault);
    if (fault) throw InputError(folder.string() + ": cannot be read: " + fault.message());
    if (std::ranges::find(around_, real) != around_.end())
      throw InputError(folder.string() +
                       ": is a link to a folder that contains it; remove it from solver.template");
    around_.push_back(real);
    fs::directory_iterator entries(folder, fault);
    if (fault) throw InputError(folder.string() + ": cannot be read: " + fault.message());
    for (const fs::directory_entry& entry : entries) add(entry);
    around_.pop_back();
  }

  void add(const fs::directory_entry& entry) {
    const fs::path& path = entry.path();
    if (is_left_by_openfoam(path)) return;
    std::error_code fault;
    const fs::file_status status = fs::status(path, fault);
    if (fs::is_directory(status)) {
      if (!is_of_a_run(path)) add_folder(path);
      return;
    }
    if (fs::is_regular_file(status)) {
      files_.push_back(path.lexically_relative(root_).string());
      return;
    }
    const char* const what = entry.is_symlink(fault)
                                 ? ": is a broken link; repair it, or remove it from solver.template"
                                 : ": is neither a file nor a folder; remove it from solver.template";
    throw InputError(path.string() + what);
  }

  fs::path root_;
  std::vector<fs::path> around_;
  std::vector<std::string> files_;
};

/// Returns the application named by controlDict; rejects settings that write unreadable fields.
std::string read_control(const std::string& path, bool has_allrun) {
  const std::string text = io::without_foam_comments(io::read_input(path));
  const std::vector<io::FoamEntry> entries = io::foam_entries(text);
  const auto word = [&](const char* key) {
    const auto entry = io::foam_entry(entries, key);
    return entry ? io::foam_word(text, *entry) : std::string();
  };
  if (word("writeFormat") == "binary")
    throw InputError(path + ": writeFormat is binary; make it ascii, as quadloop reads the fields as text");
  if (io::is_foam_true(word("writeCompression")))
    throw InputError(path + ": writeCompression is on; make it off, as quadloop reads the fields as text");
  if (has_allrun) return "Allrun";
  std::string application = word("application");
  if (application.empty())
    throw InputError(path + ": names no application; write it there itself, as in: application simpleFoam;");
  const auto may_stand = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '.' || c == '/' ||
           c == '+';
  };
  if (!std::ranges::all_of(application, may_stand))
    throw InputError(path + ": application is '" + application + "'; write the name of a program there");
  return application;
}

}  // namespace

bool is_left_by_openfoam(const fs::path& path) {
  const std::string name = path.filename();
  const bool is_time =
      name != "0" && !name.empty() && name.find_first_not_of("0123456789.e-+") == std::string::npos;
  return is_time || name.starts_with("processor") || name.starts_with("log.") || name == "postProcessing" ||
         name == "polyMesh";
}

std::vector<std::string> openfoam_template_files(const std::string& folder) {
  return Listing(fs::path(folder)).take();
}

OpenfoamTemplate read_openfoam_template(const std::string& folder) {
  const fs::path path = folder;
  const fs::path control = path / "system/controlDict", allrun = path / "Allrun";
  if (!fs::is_regular_file(control))
    throw InputError(folder + ": is not an OpenFOAM case: it has no system/controlDict");
  const bool has_fields = fs::is_directory(path / "0");
  if (!has_fields && !fs::is_directory(path / "0.orig"))
    throw InputError(folder + ": has no folder 0 or 0.orig with the initial fields");
  const bool has_allrun = fs::is_regular_file(allrun);
  if (has_allrun && ::access(allrun.c_str(), X_OK) != 0)
    throw InputError(allrun.string() + ": may not be run; allow it with: chmod +x " + allrun.string());
  OpenfoamTemplate given;
  given.application = read_control(control.string(), has_allrun);
  given.files = openfoam_template_files(folder);
  io::require_foam_fields((path / (has_fields ? "0" : "0.orig")).string());
  return given;
}

void copy_openfoam_template(const std::string& from, const OpenfoamTemplate& given, const fs::path& to) {
  for (const std::string& name : given.files) {
    const fs::path source = fs::path(from) / name, target = to / name;
    std::error_code fault;
    fs::create_directories(target.parent_path(), fault);
    if (fault) throw OutputError(target.parent_path().string() + ": cannot be made: " + fault.message());
    fs::copy_file(source, target, fs::copy_options::overwrite_existing, fault);
    if (fault) throw OutputError(source.string() + ": cannot be copied: " + fault.message());
    fs::permissions(target, fs::perms::owner_write, fs::perm_options::add, fault);
  }
}

}  // namespace quadloop::adapt
