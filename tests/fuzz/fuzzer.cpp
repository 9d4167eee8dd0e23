// What libFuzzer calls. QUADLOOP_FUZZ_TARGET names the target. Half of the changes to text are made line by
// line or number by number, so that the rest of the file still makes sense to its reader.
// Sanitizers in child processes leave their reports in the folder QUADLOOP_FUZZ_REPORTS.
#include <mpi.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "tests/fuzz/fuzz.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t room);

namespace {

std::string target() {
  const char* const name = std::getenv("QUADLOOP_FUZZ_TARGET");
  return name == nullptr ? "" : name;
}

void change_number(std::string& text, std::size_t at, unsigned lot) {
  static const std::array<const char*, 13> numbers{
      "-1", "0",    "2147483647", "2147483648", "9223372036854775807", "1e999", "nan", "-inf", "268435456",
      "1",  "0x10", "3",          "1e-320"};
  const std::size_t begin = text.find_first_of("0123456789", at);
  if (begin == std::string::npos) return;
  const std::size_t end = std::min(text.find_first_not_of("0123456789.e+-", begin), text.size());
  text.replace(begin, end - begin, numbers[lot % numbers.size()]);
}

/// The line that holds a place, with its end.
std::string line_at(const std::string& text, std::size_t at) {
  const std::size_t before = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  return text.substr(begin, text.find('\n', begin) - begin) + "\n";
}

/// Whether a sanitizer's report is of code of ours: where it begins, the C and C++ libraries left out, in the
/// program itself. Crashes of libraries, and memory that a reader's limit refuses it, end in a refusal.
bool is_of_ours(const std::filesystem::path& report) {
  std::ifstream file(report);
  bool is_error = false;  // other lines are warnings, of a lacking symbolizer say
  for (std::string line; std::getline(file, line);) {
    const auto has = [&](const char* words) { return line.find(words) != std::string::npos; };
    if (has("out-of-memory") || has("out of memory") || has("allocation-size-too-big") || has("failed to "))
      return false;
    is_error = is_error || has("ERROR: ") || has("runtime error: ");
    if (!is_error || !line.starts_with("    #") || has("libc.so") || has("libstdc++.so") ||
        has("compiler-rt") || has("__interceptor") || has(" in operator ") || has(" in __asan") ||
        has(" in __ubsan"))
      continue;
    return !has(".so");
  }
  return is_error;  // without a frame
}

void abort_at_report_of_child() {
  const char* const folder = std::getenv("QUADLOOP_FUZZ_REPORTS");
  if (folder == nullptr) return;
  for (const auto& report : std::filesystem::directory_iterator(folder)) {
    if (is_of_ours(report)) std::abort();
    std::filesystem::remove(report);
  }
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  if (target().empty()) std::abort();
  MPI_Init(argc, argv);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  quadloop::fuzz::run(target(), data, size);
  abort_at_report_of_child();
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t room,
                                               unsigned seed) {
  std::minstd_rand random(seed);
  random();
  const bool is_text = target().find('.') != std::string::npos;
  if (!is_text || size == 0 || random() % 2 == 0) return LLVMFuzzerMutate(data, size, room);
  std::string text(reinterpret_cast<const char*>(data), size);
  const std::size_t at = random() % size, from = random() % size;
  const std::string line = line_at(text, from);
  switch (random() % 3) {
    case 0: change_number(text, at, static_cast<unsigned>(random())); break;
    case 1: text.insert(std::min(text.find('\n', at), text.size() - 1) + 1, line); break;
    default: text.erase(text.find(line) == std::string::npos ? at : text.find(line), line.size()); break;
  }
  const std::size_t length = std::min(text.size(), room);
  std::memcpy(data, text.data(), length);
  return length;
}
