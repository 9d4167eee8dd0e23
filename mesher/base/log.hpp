#pragma once

#include <functional>
#include <string>

namespace quadloop::log {

/// Verbosity. Warnings and information are shown by the root rank only; `verbose` adds details of every rank,
/// each line with its rank.
struct Options {
  int rank = 0, ranks = 1;
  bool quiet = false;    ///< warnings only
  bool verbose = false;  ///< details too
};

/// Sets the verbosity. Before the first call only warnings are shown, on every rank. Logs go to stderr.
void configure(const Options& options);

enum class Level { detail, information, warning };

/// Called for each line, on every rank.
using Sink = std::function<void(Level, const std::string&)>;

/// From now on lines of all levels go to `sink` instead of stderr; to stderr again if it is empty. For the
/// whole process, like configure().
void send_to(Sink sink);

void warning(const std::string& message);
void information(const std::string& message);
void detail(const std::string& message);

}  // namespace quadloop::log
