#include "io/tree/tree_share.hpp"

#include <algorithm>
#include <vector>

#include "io/files/hdf5_handle.hpp"
#include "io/files/reading/input_file.hpp"
#include "io/tree/tree_check.hpp"
#include "io/tree/tree_layout.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

/// A tree file opened by one rank.
class TreeSource {
 public:
  explicit TreeSource(const std::string& path) : path_{path} {
    require_input_file(path);
    file_ = Hdf5Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    if (!file_.valid()) refuse("cannot be opened, or is no HDF5 file");
  }

  TreeAttributes attributes() const {
    if (H5Aexists(file_.id(), "format") <= 0) refuse("is no tree file: it has no attribute \"format\"");
    std::int32_t version = 0;
    read_number("format_version", version);
    if (version != tree_format_version) {
      refuse("has format version " + std::to_string(version) + "; this program reads version " +
             std::to_string(tree_format_version));
    }
    TreeAttributes result;
    for_each_attribute(result, [&](const char* name, auto& value) { read_number(name, value); });
    if (H5Aexists(file_.id(), root_far_names[0]) > 0) {
      Point& far = result.root_far.emplace();
      read_number(root_far_names[0], far.x);
      read_number(root_far_names[1], far.y);
    }
    return result;
  }

  std::int64_t leaves() const { return rows_of(open("x")); }

  /// Rejects datasets that declare more rows than the file contains, before memory is allocated for them.
  void require_stored(std::int64_t leaves) const {
    for_each_tree_dataset([&](const char* name, const auto& members) {
      const Hdf5Handle dataset = open(name);
      if (rows_of(dataset) != leaves)
        refuse(std::string("its dataset \"") + name + "\" has another length than \"x\"");
      if (!may_hold(dataset, leaves * members.size())) {
        refuse(std::string("its dataset \"") + name + "\" is said to have " + std::to_string(leaves) +
               " rows, more than the file holds; it is cut short or damaged");
      }
    });
  }

  /// Returns the whole dataset; empty if the file has none.
  template <class Dataset>
  std::vector<typename Dataset::Row> rows(const Dataset& kind) const {
    if (H5Lexists(file_.id(), kind.name, H5P_DEFAULT) <= 0) return {};
    const Hdf5Handle dataset = open(kind.name);
    const Hdf5Handle space(H5Dget_space(dataset.id()), H5Sclose);
    std::array<hsize_t, 32> size{};
    const bool shaped = H5Sget_simple_extent_dims(space.id(), size.data(), nullptr) == 2 &&
                        size[1] == Dataset::columns && may_hold(dataset, size[0] * size[1]);
    std::vector<typename Dataset::Row> rows(shaped ? size[0] : 0);
    if (!shaped || H5Dread(dataset.id(), memory_type<typename Dataset::Number>(), H5S_ALL, H5S_ALL,
                           H5P_DEFAULT, rows.data()) < 0)
      refuse(std::string("its dataset \"") + kind.name + "\" cannot be read; the file is damaged");
    return rows;
  }

  std::vector<LeafRecord> read(std::int64_t begin, std::int64_t end) const {
    std::vector<LeafRecord> result(end - begin);
    for_each_tree_dataset([&](const char* name, const auto& members) {
      if (begin < end) read_column(open(name), name, members, begin, result);
    });
    return result;
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const { throw InputError(path_ + ": " + what); }

  template <class T>
  void read_number(const char* name, T& value) const {
    const Hdf5Handle attribute(H5Aopen(file_.id(), name, H5P_DEFAULT), H5Aclose);
    if (!attribute.valid() || H5Aread(attribute.id(), memory_type<T>(), &value) < 0) {
      refuse(std::string("is no tree file, or damaged: it has no number \"") + name + "\"");
    }
  }

  Hdf5Handle open(const char* name) const {
    Hdf5Handle dataset(H5Dopen2(file_.id(), name, H5P_DEFAULT), H5Dclose);
    if (!dataset.valid())
      refuse(std::string("is no tree file, or damaged: it has no dataset \"") + name + "\"");
    return dataset;
  }

  static std::int64_t rows_of(const Hdf5Handle& dataset) {
    const Hdf5Handle space(H5Dget_space(dataset.id()), H5Sclose);
    std::array<hsize_t, 32> size{};
    return H5Sget_simple_extent_dims(space.id(), size.data(), nullptr) < 1
               ? 0
               : static_cast<std::int64_t>(size[0]);
  }

  /// Whether the stored bytes can contain this many numbers; filters compress by at most 1032.
  bool may_hold(const Hdf5Handle& dataset, hsize_t numbers) const {
    const Hdf5Handle type(H5Dget_type(dataset.id()), H5Tclose),
        creation(H5Dget_create_plist(dataset.id()), H5Pclose);
    const hsize_t largest_ratio = H5Pget_nfilters(creation.id()) == 0 ? 1 : 1100;
    const hsize_t width = H5Tget_size(type.id());
    hsize_t whole_file = 0;
    H5Fget_filesize(file_.id(), &whole_file);
    const hsize_t stored = std::min(whole_file, H5Dget_storage_size(dataset.id()));
    return width > 0 && numbers <= stored * largest_ratio / width;
  }

  template <class T, std::size_t width>
  void read_column(const Hdf5Handle& dataset, const char* name,
                   const std::array<T LeafRecord::*, width>& members, std::int64_t first,
                   std::vector<LeafRecord>& leaves) const {
    std::vector<T> column(leaves.size() * width);
    const std::array<hsize_t, 2> begin{static_cast<hsize_t>(first), 0}, count{leaves.size(), width};
    const Hdf5Handle memory(H5Screate_simple(width == 1 ? 1 : 2, count.data(), nullptr), H5Sclose);
    const Hdf5Handle file(H5Dget_space(dataset.id()), H5Sclose);
    const bool shaped =
        H5Sget_simple_extent_ndims(file.id()) == (width == 1 ? 1 : 2) &&
        H5Sselect_hyperslab(file.id(), H5S_SELECT_SET, begin.data(), nullptr, count.data(), nullptr) >= 0 &&
        H5Sselect_valid(file.id()) > 0;
    if (!shaped ||
        H5Dread(dataset.id(), memory_type<T>(), memory.id(), file.id(), H5P_DEFAULT, column.data()) < 0) {
      refuse(std::string("its dataset \"") + name + "\" cannot be read; the file is cut short or damaged");
    }
    auto value = column.begin();
    for (LeafRecord& leaf : leaves) {
      for (const auto member : members) leaf.*member = *value++;
    }
  }

  QuietHdf5 quiet_;
  std::string path_;
  Hdf5Handle file_;
};

}  // namespace

TreeShare read_tree_share(const std::string& path, std::int64_t rank, std::int64_t ranks) {
  const TreeSource source(path);
  TreeShare share;
  share.tree.attributes = source.attributes();
  const std::int64_t all = source.leaves();
  require_possible_attributes(share.tree.attributes, all, path);
  source.require_stored(all);
  const std::int64_t begin = all / ranks * rank + std::min(all % ranks, rank),
                     end = all / ranks * (rank + 1) + std::min(all % ranks, rank + 1);
  share.tree.leaves = source.read(begin, end);
  share.tree.measured.walls = source.rows(measured_wall_rows);
  share.tree.measured.thickness = source.rows(measured_thickness_rows);
  require_possible_flow(share.tree.measured, path);
  share.tree.measured.wakes = possible_wakes(source.rows(wake_point_rows), source.rows(wake_size_rows), path);
  share.tree.block_runs = source.rows(block_run_rows);
  require_possible_runs(share.tree.block_runs, share.tree.attributes, path);
  if (begin > 0 && begin < end) share.before = source.read(begin - 1, begin).front();
  return share;
}

}  // namespace quadloop::io
