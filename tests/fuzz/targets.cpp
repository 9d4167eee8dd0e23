#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include "mesher/base/error.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace quadloop::fuzz {

namespace {

void run_unguarded(std::string_view target, const std::uint8_t* data, std::size_t size) {
  if (target == "cut") {
    cut_leaf(data, size);
  } else if (target == "flips") {
    flip_edges(data, size);
  } else if (target == "layers") {
    layer_fronts(data, size);
  } else if (target == "mesh") {
    small_mesh(data, size);
  } else {
    read_file(target, {reinterpret_cast<const char*>(data), size});
  }
}

}  // namespace

std::string run(std::string_view target, const std::uint8_t* data, std::size_t size) {
  try {
    run_unguarded(target, data, size);
    return {};
  } catch (const InputError& refusal) {
    return refusal.what();
  } catch (const std::exception& other) {
    std::fprintf(stderr, "finding: %s\n", other.what());
    std::abort();
  }
}

}  // namespace quadloop::fuzz
