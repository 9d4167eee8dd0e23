#pragma once

// For io/ only: the only header that includes the CGNS library.
#include <cgnslib.h>

#include <array>
#include <optional>
#include <string>
#include <utility>

#include "io/files/hdf5_handle.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

/// A CGNS file that is open for reading; a failed call throws InputError. Serial: used by one rank.
class CgnsFile {
 public:
  /// `shown` is the name of the file in messages.
  CgnsFile(const std::string& path, std::string shown) : shown_{std::move(shown)} {
    check(cg_open(path.c_str(), CG_MODE_READ, &id_));
    open_ = true;
  }
  ~CgnsFile() {
    if (open_) cg_close(id_);
  }
  CgnsFile(const CgnsFile&) = delete;
  CgnsFile& operator=(const CgnsFile&) = delete;

  int id() const { return id_; }
  const std::string& shown() const { return shown_; }

  /// Checks the status of a library call; to be used for every call.
  void check(int status) const {
    if (status == CG_OK) return;
    throw InputError(shown_ + ": the CGNS library refuses: " + cg_get_error());
  }
  /// Returns the text of the last descriptor of this name below the current node, if there is one.
  std::optional<std::string> descriptor_here(const std::string& name) const {
    int descriptors = 0;
    check(cg_ndescriptors(&descriptors));
    std::optional<std::string> result;
    for (int d = 1; d <= descriptors; ++d) {
      std::array<char, 33> label{};
      char* text = nullptr;
      check(cg_descriptor_read(d, label.data(), &text));
      if (label.data() == name) result = text;
      cg_free(text);
    }
    return result;
  }

 private:
  QuietHdf5 hdf5_;
  std::string shown_;
  int id_ = 0;
  bool open_ = false;
};

/// The first base of a file; meshes are read only from this one.
struct CgnsBase {
  int cell_dimension = 0, zones = 0;
  std::string path;  ///< "/Base"
};

inline CgnsBase first_base(const CgnsFile& file) {
  CgnsBase base;
  int bases = 0, physical_dimension = 0;
  char name[33] = {};
  file.check(cg_nbases(file.id(), &bases));
  if (bases == 0) throw InputError(file.shown() + ": holds no CGNS base");
  file.check(cg_base_read(file.id(), 1, name, &base.cell_dimension, &physical_dimension));
  file.check(cg_nzones(file.id(), 1, &base.zones));
  base.path = std::string("/") + name;
  return base;
}

}  // namespace quadloop::io
