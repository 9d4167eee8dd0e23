#include "io/tree/tree_file.hpp"

#include <bit>
#include <span>
#include <utility>
#include <vector>

#include "io/files/binary_output.hpp"
#include "io/files/hdf5_output.hpp"
#include "io/files/row_output.hpp"
#include "io/tree/tree_layout.hpp"

namespace quadloop::io {

namespace {

/// The file without its leaves, for which only space is reserved: HDF5 writes it on rank 0.
class TreeFrame {
 public:
  TreeFrame(const StagedFile& staged, std::int64_t leaves)
      : file_{staged, Hdf5Output::State::created}, rows_{leaves} {
    for_each_tree_dataset([&](const char* name, const auto& members) { create_dataset(name, members); });
  }

  /// Offsets of the datasets in the file, in their order.
  const std::vector<std::int64_t>& places() const { return places_; }

  void put_attributes(TreeAttributes attributes) {
    file_.put_text(file_.id(), "format", tree_format_name);
    const auto put = [&](const char* name, auto value) { file_.put_number(file_.id(), name, value); };
    put("format_version", tree_format_version);
    for_each_attribute(attributes, put);
    if (!attributes.root_far) return;
    put(root_far_names[0], attributes.root_far->x);
    put(root_far_names[1], attributes.root_far->y);
  }

  template <class Dataset>
  void put_rows(const Dataset& kind, const std::vector<typename Dataset::Row>& rows) {
    if (rows.empty()) return;
    using Number = typename Dataset::Number;
    const std::array<hsize_t, 2> size{rows.size(), Dataset::columns};
    file_.put_array(file_.id(), kind.name, size, reinterpret_cast<const Number*>(rows.data()));
  }

  void close() { file_.close(); }

 private:
  template <class Value, std::size_t width>
  void create_dataset(const char* name, const std::array<Value LeafRecord::*, width>&) {
    const std::array<hsize_t, 2> size{static_cast<hsize_t>(rows_), width};
    places_.push_back(
        file_.reserve(file_.id(), name, file_type<Value>(), std::span(size).first(width == 1 ? 1 : 2)));
  }

  Hdf5Output file_;
  std::int64_t rows_;
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
