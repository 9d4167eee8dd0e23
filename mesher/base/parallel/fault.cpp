#include <mpi.h>

#include <algorithm>
#include <string_view>

#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

/// Removes and returns the first name; a comma within brackets belongs to it.
std::string_view next_name(std::string_view& names) {
  int open = 0;
  std::size_t end = 0;
  for (; end < names.size() && (open > 0 || names[end] != ','); ++end) {
    if (names[end] == '(' || names[end] == '[' || names[end] == '{') ++open;
    if (names[end] == ')' || names[end] == ']' || names[end] == '}') --open;
  }
  const std::string_view name = names.substr(0, end);
  names.remove_prefix(std::min(names.size(), end + 2));  // ", "
  return name;
}

/// Returns the rank, if there are several; empty for a single one.
std::string text_of_rank() {
  int begun = 0, ended = 0, rank = 0, size = 1;
  MPI_Initialized(&begun);
  MPI_Finalized(&ended);
  if (begun == 0 || ended != 0) return {};
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  return size == 1 ? "" : "rank " + std::to_string(rank) + " of " + std::to_string(size);
}

}  // namespace

void fail(const char* file, int line, const char* message, const char* names,
          std::initializer_list<FaultValue> values) {
  std::string details;
  std::string_view left = names;
  const auto add = [&](const std::string& detail) { details += (details.empty() ? "" : ", ") + detail; };
  for (const FaultValue& value : values) add(std::string(next_name(left)) + " = " + value.text);
  if (const std::string rank = text_of_rank(); !rank.empty()) add(rank);
  throw Fault(std::string(file) + ":" + std::to_string(line) + ": " + message +
              (details.empty() ? "" : " (" + details + ")"));
}

}  // namespace quadloop
