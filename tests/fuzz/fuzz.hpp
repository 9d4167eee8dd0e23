#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace quadloop::fuzz {

/// Each runs the code under test on one input and returns 0. They throw InputError where the input is
/// refused; everything else that they throw is a finding.
int cut_leaf(const std::uint8_t* data, std::size_t size);
int flip_edges(const std::uint8_t* data, std::size_t size);
int layer_fronts(const std::uint8_t* data, std::size_t size);
int small_mesh(const std::uint8_t* data, std::size_t size);

/// Reads an input under that name of a file: "m.su2" as a plane mesh, "solid.su2" as a 3D one, "solution.vtu"
/// for its values; outlines, case files and trees by their suffixes. Throws InputError where it is refused.
void read_file(std::string_view name, std::string_view input);

/// Runs the target of that name: "cut", "flips", "layers", "mesh", or the name of a file that read_file()
/// gets.
/// Returns the message of a refusal, empty where there is none. A finding ends the process by abort(), with a
/// line on stderr.
std::string run(std::string_view target, const std::uint8_t* data, std::size_t size);

/// Takes an input apart into small numbers; beyond its end they are 0.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_{data}, size_{size} {}
  std::uint8_t next() { return at_ < size_ ? data_[at_++] : std::uint8_t{0}; }
  /// 0 to end - 1.
  int below(int end) { return next() % end; }
  bool empty() const { return at_ >= size_; }

 private:
  const std::uint8_t* data_;
  std::size_t size_, at_ = 0;
};

}  // namespace quadloop::fuzz
