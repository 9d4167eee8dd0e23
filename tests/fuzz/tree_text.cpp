#include "tests/fuzz/tree_text.hpp"

#include <array>
#include <fstream>
#include <sstream>
#include <vector>

#include "io/files/hdf5_handle.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::fuzz {

using io::Hdf5Handle;

namespace {

constexpr std::int64_t most_numbers = 1'000'000;

/// Types by name; text is none of them.
hid_t type_named(const std::string& name) {
  if (name == "i1") return io::file_type<std::int8_t>();
  if (name == "i2") return io::file_type<std::int16_t>();
  if (name == "i4") return io::file_type<std::int32_t>();
  if (name == "i8") return io::file_type<std::int64_t>();
  if (name == "u4") return io::file_type<std::uint32_t>();
  if (name == "u8") return io::file_type<std::uint64_t>();
  if (name == "f8") return io::file_type<double>();
  throw InputError("no type of number: " + name);
}

/// The numbers of the rest of a line, to the bit: as integers where they are integers.
struct Values {
  hid_t type = io::memory_type<double>();
  std::vector<double> reals;
  std::vector<std::uint64_t> whole;
  const void* data() const { return whole.empty() ? static_cast<const void*>(reals.data()) : whole.data(); }
};

std::uint64_t integer_of(const std::string& word) {
  char* end = nullptr;
  return word.starts_with("-") ? static_cast<std::uint64_t>(std::strtoll(word.c_str(), &end, 0))
                               : std::strtoull(word.c_str(), &end, 0);
}

Values values_in(std::istringstream& line, const std::string& type, std::int64_t count) {
  Values values;
  const bool real = type == "f8", is_unsigned = type.starts_with("u");
  if (!real) values.type = is_unsigned ? io::memory_type<std::uint64_t>() : io::memory_type<std::int64_t>();
  std::string word;
  for (std::int64_t i = 0; i < count; ++i) {
    if (!(line >> word)) word = "0";
    if (real) {
      values.reals.push_back(std::strtod(word.c_str(), nullptr));
    } else {
      values.whole.push_back(integer_of(word));
    }
  }
  return values;
}

class TreeOfText {
 public:
  explicit TreeOfText(const std::string& path) {
    const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_libver_bounds(access.id(), H5F_LIBVER_V18, H5F_LIBVER_V18);
    file_ = Hdf5Handle(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), H5Fclose);
    QUADLOOP_REQUIRE(file_.valid(), "no file can be made in the folder of the fuzzer");
  }

  void add_attribute(std::istringstream& line) {
    std::string name, type;
    line >> name >> type;
    const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    if (type == "text") {
      add_text(name, line, space);
      return;
    }
    const Values value = values_in(line, type, 1);
    const Hdf5Handle attribute(
        H5Acreate2(file_.id(), name.c_str(), type_named(type), space.id(), H5P_DEFAULT, H5P_DEFAULT),
        H5Aclose);
    require(attribute.valid() && H5Awrite(attribute.id(), value.type, value.data()) >= 0, name);
  }

  void add_dataset(std::istringstream& line, bool packed) {
    std::string name, type;
    std::int64_t rows = 0, columns = 0;
    line >> name >> type >> rows >> columns;
    const std::int64_t width = columns == 0 ? 1 : columns;
    if (rows < 0 || columns < 0 || rows > most_numbers || width > most_numbers || rows * width > most_numbers)
      throw InputError("no size of a dataset: " + name);
    const Values values = values_in(line, type, rows * width);
    const std::array size{static_cast<hsize_t>(rows), static_cast<hsize_t>(columns)};
    const Hdf5Handle space(H5Screate_simple(columns == 0 ? 1 : 2, size.data(), nullptr), H5Sclose);
    const Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    if (packed && rows * width > 0) {
      H5Pset_chunk(creation.id(), columns == 0 ? 1 : 2, size.data());
      H5Pset_deflate(creation.id(), 6);
    }
    const Hdf5Handle dataset(H5Dcreate2(file_.id(), name.c_str(), type_named(type), space.id(), H5P_DEFAULT,
                                        creation.id(), H5P_DEFAULT),
                             H5Dclose);
    require(dataset.valid() &&
                H5Dwrite(dataset.id(), values.type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0,
            name);
  }

  void close() { require(file_.close() >= 0, "the file"); }

 private:
  static void require(bool holds, const std::string& what) {
    if (!holds) throw InputError("HDF5 does not make " + what);
  }

  void add_text(const std::string& name, std::istringstream& line, const Hdf5Handle& space) {
    std::string text;
    std::getline(line >> std::ws, text);
    const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type.id(), text.empty() ? 1 : text.size());
    const Hdf5Handle attribute(
        H5Acreate2(file_.id(), name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    require(attribute.valid() && H5Awrite(attribute.id(), type.id(), text.c_str()) >= 0, name);
  }

  io::QuietHdf5 quiet_;  // first, so that it outlives what the handle releases
  Hdf5Handle file_;
};

void turn_bit(std::fstream& file, std::uint64_t place, int bit) {
  file.clear();
  file.seekg(0, std::ios::end);
  const std::streamoff size = file.tellg();
  if (size == 0) return;
  const auto at = static_cast<std::streamoff>(place % static_cast<std::uint64_t>(size));
  file.seekg(at);
  const int byte = file.get() ^ (1 << bit);
  file.seekp(at);
  file.put(static_cast<char>(byte));
}

}  // namespace

void write_tree_of_text(std::string_view text, const std::string& path) {
  TreeOfText tree(path);
  std::vector<std::pair<std::uint64_t, int>> damage;
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "attribute") {
      tree.add_attribute(words);
    } else if (kind == "dataset" || kind == "packed") {
      tree.add_dataset(words, kind == "packed");
    } else if (kind == "damage") {
      std::string place;
      unsigned bit = 0;
      words >> place >> bit;
      damage.emplace_back(integer_of(place), static_cast<int>(bit % 8));
    }
  }
  tree.close();
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  for (const auto& [place, bit] : damage) turn_bit(file, place, bit);
}

}  // namespace quadloop::fuzz
