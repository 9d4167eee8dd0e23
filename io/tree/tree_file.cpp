#include "io/tree/tree_file.hpp"

#include <bit>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include "io/files/binary_output.hpp"
#include "io/files/hdf5_handle.hpp"
#include "io/files/output_path.hpp"
#include "io/files/row_output.hpp"
#include "io/tree/tree_layout.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

/// The file without its leaves, for which only space is reserved: HDF5 writes it on rank 0.
class TreeFrame {
 public:
  TreeFrame(const StagedFile& staged, std::int64_t leaves) : shown_{staged.path}, rows_{leaves} {
    const Hdf5Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose),
        access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_obj_track_times(creation.id(), false);
    H5Pset_libver_bounds(access.id(), H5F_LIBVER_V18, H5F_LIBVER_V18);
    file_ =
        Hdf5Handle(H5Fcreate(staged.temporary.c_str(), H5F_ACC_TRUNC, creation.id(), access.id()), H5Fclose);
    check(file_.valid());
    for_each_tree_dataset([&](const char* name, const auto& members) { create_dataset(name, members); });
  }

  /// Offsets of the datasets in the file, in their order.
  const std::vector<std::int64_t>& places() const { return places_; }

  void put_attributes(TreeAttributes attributes) {
    put_text("format", tree_format_name);
    put_number("format_version", tree_format_version);
    for_each_attribute(attributes, [&](const char* name, auto value) { put_number(name, value); });
    if (!attributes.root_far) return;
    put_number(root_far_names[0], attributes.root_far->x);
    put_number(root_far_names[1], attributes.root_far->y);
  }

  template <class Dataset>
  void put_rows(const Dataset& kind, const std::vector<typename Dataset::Row>& rows) {
    if (rows.empty()) return;
    using Number = typename Dataset::Number;
    const std::array<hsize_t, 2> size{rows.size(), Dataset::columns};
    const Hdf5Handle space(H5Screate_simple(2, size.data(), nullptr), H5Sclose);
    const Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(creation.id(), false);
    Hdf5Handle dataset(H5Dcreate2(file_.id(), kind.name, file_type<Number>(), space.id(), H5P_DEFAULT,
                                  creation.id(), H5P_DEFAULT),
                       H5Dclose);
    check(dataset.valid() &&
          H5Dwrite(dataset.id(), memory_type<Number>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data()) >= 0 &&
          dataset.close() >= 0);
  }

  void close() { check(file_.close() >= 0); }

 private:
  /// After a failure the file is not touched: HDF5 may crash on a file that it could not write.
  void check(bool good) {
    if (good) return;
    file_.abandon();
    if (quiet_.reason() != 0) refuse_output(shown_, quiet_.reason());
    throw OutputError(shown_ + ": cannot be written; is the disk full?");
  }

  /// Contiguous, allocated immediately and not filled.
  template <class Value, std::size_t width>
  void create_dataset(const char* name, const std::array<Value LeafRecord::*, width>&) {
    const std::array<hsize_t, 2> size{static_cast<hsize_t>(rows_), width};
    const Hdf5Handle space(H5Screate_simple(width == 1 ? 1 : 2, size.data(), nullptr), H5Sclose);
    const Hdf5Handle creation = creation_of_reserved_space();
    Hdf5Handle dataset(
        H5Dcreate2(file_.id(), name, file_type<Value>(), space.id(), H5P_DEFAULT, creation.id(), H5P_DEFAULT),
        H5Dclose);
    check(dataset.valid());
    places_.push_back(static_cast<std::int64_t>(H5Dget_offset(dataset.id())));
    check((places_.back() >= 0 || rows_ == 0) && dataset.close() >= 0);
  }

  template <class T>
  void put_number(const char* name, T value) {
    const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Hdf5Handle attribute(
        H5Acreate2(file_.id(), name, file_type<T>(), space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    check(attribute.valid() && H5Awrite(attribute.id(), memory_type<T>(), &value) >= 0);
  }

  void put_text(const char* name, const char* text) {
    const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose), space(H5Screate(H5S_SCALAR), H5Sclose);
    H5Tset_size(type.id(), std::strlen(text));
    const Hdf5Handle attribute(H5Acreate2(file_.id(), name, type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT),
                               H5Aclose);
    check(attribute.valid() && H5Awrite(attribute.id(), type.id(), text) >= 0);
  }

  QuietHdf5 quiet_;  // first, so that it outlives what the handles release
  std::string shown_;
  std::int64_t rows_;
  Hdf5Handle file_;
  std::vector<std::int64_t> places_;
};

/// Writes one dataset: a row for each leaf.
template <class Value, std::size_t width>
void write_column(RowOutput& file, const std::array<Value LeafRecord::*, width>& members,
                  const std::vector<LeafRecord>& leaves) {
  file.write_rows(std::ssize(leaves), [&](std::int64_t i) {
    std::array<Value, width> row;
    for (std::size_t k = 0; k < width; ++k) row[k] = in_order<std::endian::little>(leaves[i].*members[k]);
    return row;
  });
}

/// Writes everything except the leaves; returns the offsets of the datasets on every rank. *Collective.*
std::vector<std::int64_t> write_frame(const Communicator& comm, const TreeRecord& tree,
                                      const StagedFile& staged, std::int64_t leaves) {
  std::vector<std::int64_t> places;
  comm.together([&] {
    if (!comm.is_root()) return;
    TreeFrame frame(staged, leaves);
    frame.put_attributes(tree.attributes);
    frame.put_rows(measured_wall_rows, tree.measured.walls);
    std::vector<Point> points;
    std::vector<std::int64_t> sizes;
    for (const std::vector<Point>& path : tree.measured.wakes) {
      points.insert(points.end(), path.begin(), path.end());
      sizes.push_back(std::ssize(path));
    }
    frame.put_rows(wake_point_rows, points);
    frame.put_rows(wake_size_rows, sizes);
    frame.put_rows(measured_thickness_rows, tree.measured.thickness);
    frame.put_rows(block_run_rows, tree.block_runs);
    places = frame.places();
    frame.close();
  });
  comm.broadcast(places);
  return places;
}

}  // namespace

void write_tree(OutputSet& outputs, const TreeRecord& tree, const std::string& path) {
  const Communicator& comm = outputs.communicator();
  const StagedFile staged = outputs.stage(path);
  RowOutput file(outputs, staged);
  const std::vector<std::int64_t> places = write_frame(comm, tree, staged, comm.sum(std::ssize(tree.leaves)));
  auto place = places.begin();
  for_each_tree_dataset([&](const char*, const auto& members) {
    file.move_to(*place++);
    write_column(file, members, tree.leaves);
  });
  file.close();
}

void write_tree(const Communicator& comm, const TreeRecord& tree, const std::string& path) {
  OutputSet outputs(comm);
  write_tree(outputs, tree, path);
  outputs.commit();
}

}  // namespace quadloop::io
