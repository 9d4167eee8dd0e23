// Runs every file of a corpus once, FOLDER/TARGET/*, with any compiler. Fails also where a whole target
// refuses all of its inputs: then they test little.
#include <mpi.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/fuzz/fuzz.hpp"

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int inputs = 0, idle_targets = 0;
  for (const auto& target : std::filesystem::directory_iterator(argc > 1 ? argv[1] : ".")) {
    int accepted = 0;
    for (const auto& input : std::filesystem::directory_iterator(target)) {
      std::ifstream file(input.path(), std::ios::binary);
      const std::string text{std::istreambuf_iterator<char>(file), {}};
      std::printf("%s\n", input.path().c_str());
      std::fflush(stdout);
      const std::string refusal = quadloop::fuzz::run(
          target.path().filename().string(), reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
      if (!refusal.empty()) std::printf("  refused: %s\n", refusal.c_str());
      accepted += refusal.empty() ? 1 : 0;
      ++inputs;
    }
    if (accepted == 0) {
      std::printf("%s: all inputs are refused\n", target.path().c_str());
      ++idle_targets;
    }
  }
  MPI_Finalize();
  std::printf("%d inputs\n", inputs);
  return inputs > 0 && idle_targets == 0 ? 0 : 1;
}
