#pragma once

// Inside io/ only: the one header that names the CGNS library, for the sources that talk to it.
#include <cgnslib.h>

#include <string>
#include <type_traits>
#include <utility>

#include "io/files/hdf5_handle.hpp"
#include "io/files/output_path.hpp"
#include "mesher/base/error.hpp"

namespace quadloop {

/// An open CGNS file; `Failure` is the error that a failed call becomes. Serial: one rank owns it. A file
/// that could not be written is never closed: the libraries may crash on it.
template <class Failure>
class CgnsFile {
 public:
  /// `shown` names the file in messages.
  CgnsFile(const std::string& path, std::string shown, int mode) : shown_{std::move(shown)} {
    check(cg_open(path.c_str(), mode, &id_));
    hdf5_.listen();
    open_ = true;
  }
  ~CgnsFile() {
    if (open_) cg_close(id_);
  }
  CgnsFile(const CgnsFile&) = delete;
  CgnsFile& operator=(const CgnsFile&) = delete;

  int id() const { return id_; }
  const std::string& shown() const { return shown_; }

  /// To be wrapped around every call of the library.
  void check(int status) const {
    if (status == CG_OK) return;
    if constexpr (std::is_same_v<Failure, OutputError>) {
      open_ = false;
      if (hdf5_.reason() != 0) refuse_output(shown_, hdf5_.reason());
    }
    throw Failure(shown_ + ": the CGNS library refuses: " + cg_get_error());
  }
  /// What was buffered may fail only here; the destructor can say nothing.
  void close() {
    open_ = false;
    check(cg_close(id_));
  }

 private:
  QuietHdf5 hdf5_;
  std::string shown_;
  int id_ = 0;
  mutable bool open_ = false;
};

}  // namespace quadloop
