#pragma once

// For io/ only: the only header that includes the HDF5 library. Ids are used only in hdf5_output and in the
// sources of the tree file, cgns_nodes, cgns_places and vtkhdf_output; libcgns has its own.
#include <hdf5.h>

#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace quadloop::io {

/// An HDF5 id with the function that releases it.
class Hdf5Handle {
 public:
  using Release = herr_t (*)(hid_t);

  Hdf5Handle() = default;
  Hdf5Handle(hid_t id, Release release) : id_{id}, release_{release} {}
  ~Hdf5Handle() {
    if (id_ >= 0) release_(id_);
  }
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_{std::exchange(other.id_, -1)}, release_{other.release_} {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(release_, other.release_);
    return *this;
  }

  hid_t id() const { return id_; }
  bool valid() const { return id_ >= 0; }
  /// Releases the id; for a file, a full disk may be detected only here.
  herr_t close() { return release_(std::exchange(id_, -1)); }
  /// Drops the id without releasing it.
  void abandon() { id_ = -1; }

 private:
  hid_t id_ = -1;
  Release release_ = nullptr;
};

/// Suppresses HDF5's error output, which is replaced by a one-line message, and its exit handler: after a
/// failed write it would crash there. Must be constructed before any other use of HDF5.
class QuietHdf5 {
 public:
  QuietHdf5() {
    static const herr_t nothing_at_exit = H5dont_atexit();
    static_cast<void>(nothing_at_exit);
    H5Eget_auto2(H5E_DEFAULT, &printer_, &data_);
    H5Eset_auto2(H5E_DEFAULT, &QuietHdf5::note, this);
  }
  ~QuietHdf5() { H5Eset_auto2(H5E_DEFAULT, printer_, data_); }
  QuietHdf5(const QuietHdf5&) = delete;
  QuietHdf5& operator=(const QuietHdf5&) = delete;

  /// The errno of the first system call that failed within HDF5; 0 if none is known.
  int reason() const { return reason_; }

 private:
  /// Called by HDF5 for each of its calls that fails, with the error stack.
  static herr_t note(hid_t account, void* self) {
    return H5Ewalk2(account, H5E_WALK_UPWARD, &QuietHdf5::read_entry, self);
  }
  static herr_t read_entry(unsigned, const H5E_error2_t* entry, void* self) {
    constexpr std::string_view label = "errno = ";
    const std::string_view text = entry->desc == nullptr ? "" : entry->desc;
    const std::size_t at = text.find(label);
    int& reason = static_cast<QuietHdf5*>(self)->reason_;
    if (reason == 0 && at != std::string_view::npos)
      std::from_chars(text.data() + at + label.size(), text.data() + text.size(), reason);
    return 0;
  }

  H5E_auto2_t printer_ = nullptr;
  void* data_ = nullptr;
  int reason_ = 0;
};

/// Returns the creation properties of a dataset of which only the space is reserved, as one piece of the file
/// that is not filled: its contents are written later at H5Dget_offset(), without HDF5.
inline Hdf5Handle creation_of_reserved_space() {
  Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.id(), false);
  H5Pset_layout(creation.id(), H5D_CONTIGUOUS);
  H5Pset_alloc_time(creation.id(), H5D_ALLOC_TIME_EARLY);
  H5Pset_fill_time(creation.id(), H5D_FILL_TIME_NEVER);
  return creation;
}

/// Types of a number in memory and in a file: always little-endian in files.
template <class T>
hid_t memory_type() {
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, std::int8_t>) return H5T_NATIVE_INT8;
  if constexpr (std::is_same_v<T, std::uint8_t>) return H5T_NATIVE_UINT8;
  if constexpr (std::is_same_v<T, std::int16_t>) return H5T_NATIVE_INT16;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5T_NATIVE_INT32;
  if constexpr (std::is_same_v<T, std::uint32_t>) return H5T_NATIVE_UINT32;
  if constexpr (std::is_same_v<T, std::int64_t>) return H5T_NATIVE_INT64;
  if constexpr (std::is_same_v<T, std::uint64_t>) return H5T_NATIVE_UINT64;
}
template <class T>
hid_t file_type() {
  if constexpr (std::is_same_v<T, double>) return H5T_IEEE_F64LE;
  if constexpr (std::is_same_v<T, std::int8_t>) return H5T_STD_I8LE;
  if constexpr (std::is_same_v<T, std::uint8_t>) return H5T_STD_U8LE;
  if constexpr (std::is_same_v<T, std::int16_t>) return H5T_STD_I16LE;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5T_STD_I32LE;
  if constexpr (std::is_same_v<T, std::uint32_t>) return H5T_STD_U32LE;
  if constexpr (std::is_same_v<T, std::int64_t>) return H5T_STD_I64LE;
  if constexpr (std::is_same_v<T, std::uint64_t>) return H5T_STD_U64LE;
}

}  // namespace quadloop::io
