#include "io/tree/tree_file.hpp"

#include <algorithm>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

#include "io/files/hdf5_handle.hpp"
#include "io/files/output_path.hpp"
#include "io/files/row_stream.hpp"
#include "io/tree/tree_layout.hpp"
#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

constexpr std::int64_t rows_per_chunk = std::int64_t{1} << 16;

/// The file on rank 0. Rows arrive in pieces of any length and are written in whole chunks: where HDF5 puts a
/// chunk follows the order of the calls, which must not follow the ranks.
class TreeSink {
 public:
  TreeSink(const StagedFile& staged, std::int64_t leaves) : shown_{staged.path}, rows_{leaves} {
    const Hdf5Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose),
        access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_obj_track_times(creation.id(), false);
    H5Pset_libver_bounds(access.id(), H5F_LIBVER_V18, H5F_LIBVER_V18);
    file_ =
        Hdf5Handle(H5Fcreate(staged.temporary.c_str(), H5F_ACC_TRUNC, creation.id(), access.id()), H5Fclose);
    check(file_.valid());
    for_each_tree_dataset([&](const char* name, const auto& members) { create_dataset(name, members); });
  }

  void put_attributes(TreeAttributes attributes) {
    put_text("format", tree_format_name);
    put_number("format_version", tree_format_version);
    for_each_attribute(attributes, [&](const char* name, auto value) { put_number(name, value); });
  }

  void put_measured_wall(const MeasuredWall& wall) {
    if (wall.empty()) return;
    const std::array<hsize_t, 2> size{wall.size(), measured_wall_columns};
    const Hdf5Handle space(H5Screate_simple(2, size.data(), nullptr), H5Sclose);
    const Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(creation.id(), false);
    Hdf5Handle dataset(H5Dcreate2(file_.id(), measured_wall_name, file_type<double>(), space.id(),
                                  H5P_DEFAULT, creation.id(), H5P_DEFAULT),
                       H5Dclose);
    check(dataset.valid() &&
          H5Dwrite(dataset.id(), memory_type<double>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, wall.data()) >= 0 &&
          dataset.close() >= 0);
  }

  void put_leaves(std::span<const LeafRecord> leaves) {
    while (!leaves.empty()) {
      const std::size_t count = std::min<std::size_t>(leaves.size(), rows_per_chunk - waiting_.size());
      waiting_.insert(waiting_.end(), leaves.begin(), leaves.begin() + count);
      leaves = leaves.subspan(count);
      if (std::ssize(waiting_) == rows_per_chunk) write_waiting();
    }
  }

  void close() {
    write_waiting();
    for (Hdf5Handle& dataset : datasets_) check(dataset.close() >= 0);
    check(file_.close() >= 0);
  }

 private:
  template <class Member>
  struct ValueOf;
  template <class T>
  struct ValueOf<T LeafRecord::*> {
    using type = T;
  };

  /// What failed stays as it is: HDF5 may crash on a file that it could not write.
  void check(bool good) {
    if (good) return;
    for (Hdf5Handle& dataset : datasets_) dataset.abandon();
    file_.abandon();
    if (quiet_.reason() != 0) refuse_output(shown_, quiet_.reason());
    throw OutputError(shown_ + ": cannot be written; is the disk full?");
  }

  template <class Member, std::size_t width>
  void create_dataset(const char* name, const std::array<Member, width>&) {
    using Value = typename ValueOf<Member>::type;
    const int rank = width == 1 ? 1 : 2;
    const std::array<hsize_t, 2> size{static_cast<hsize_t>(rows_), width}, largest{H5S_UNLIMITED, width};
    const std::array<hsize_t, 2> chunk{
        static_cast<hsize_t>(std::clamp(rows_, std::int64_t{1}, rows_per_chunk)), width};
    const Hdf5Handle space(H5Screate_simple(rank, size.data(), largest.data()), H5Sclose);
    const Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(creation.id(), false);
    H5Pset_chunk(creation.id(), rank, chunk.data());
    H5Pset_fill_time(creation.id(),
                     H5D_FILL_TIME_ALLOC);  // the rest of the last chunk: zeros, not what memory held
    datasets_.emplace_back(
        H5Dcreate2(file_.id(), name, file_type<Value>(), space.id(), H5P_DEFAULT, creation.id(), H5P_DEFAULT),
        H5Dclose);
    check(datasets_.back().valid());
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

  void write_waiting() {
    if (waiting_.empty()) return;
    std::size_t dataset = 0;
    for_each_tree_dataset(
        [&](const char*, const auto& members) { write_column(datasets_[dataset++], members); });
    written_ += std::ssize(waiting_);
    waiting_.clear();
  }

  template <class Member, std::size_t width>
  void write_column(const Hdf5Handle& dataset, const std::array<Member, width>& members) {
    using Value = typename ValueOf<Member>::type;
    std::vector<Value> column;
    column.reserve(waiting_.size() * width);
    for (const LeafRecord& leaf : waiting_) {
      for (const Member member : members) column.push_back(leaf.*member);
    }
    const std::array<hsize_t, 2> begin{static_cast<hsize_t>(written_), 0}, count{waiting_.size(), width};
    const Hdf5Handle memory(H5Screate_simple(width == 1 ? 1 : 2, count.data(), nullptr), H5Sclose);
    const Hdf5Handle file(H5Dget_space(dataset.id()), H5Sclose);
    H5Sselect_hyperslab(file.id(), H5S_SELECT_SET, begin.data(), nullptr, count.data(), nullptr);
    check(H5Dwrite(dataset.id(), memory_type<Value>(), memory.id(), file.id(), H5P_DEFAULT, column.data()) >=
          0);
  }

  QuietHdf5 quiet_;  // first, so that it outlives what the handles release
  std::string shown_;
  std::int64_t rows_ = 0, written_ = 0;
  Hdf5Handle file_;
  std::vector<Hdf5Handle> datasets_;
  std::vector<LeafRecord> waiting_;
};

}  // namespace

void write_tree(OutputSet& outputs, const TreeRecord& tree, const std::string& path) {
  const Communicator& comm = outputs.communicator();
  const auto own = std::ssize(tree.leaves);
  const std::int64_t all = comm.sum(own);
  const StagedFile staged = outputs.stage(path);
  std::unique_ptr<TreeSink> sink;
  comm.together([&] {
    if (!comm.is_root()) return;
    sink = std::make_unique<TreeSink>(staged, all);
    sink->put_attributes(tree.attributes);
    sink->put_measured_wall(tree.measured_wall);
  });
  const RowStream stream{comm, own, rows_per_chunk};
  stream.run<LeafRecord>(
      [&](std::int64_t begin, std::int64_t end) {
        return std::vector<LeafRecord>(tree.leaves.begin() + begin, tree.leaves.begin() + end);
      },
      [&](std::span<const LeafRecord> leaves) { sink->put_leaves(leaves); });
  comm.together([&] {
    if (sink) sink->close();
  });
}

void write_tree(const Communicator& comm, const TreeRecord& tree, const std::string& path) {
  OutputSet outputs(comm);
  write_tree(outputs, tree, path);
  outputs.commit();
}

}  // namespace quadloop
