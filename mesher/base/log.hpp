#pragma once

#include <string>

namespace quadloop::log {

/// Verbosity. Warnings and information are shown by the root rank only; `verbose` adds details of every rank,
/// each line with its rank.
struct Options {
  int rank = 0, ranks = 1;
  bool quiet = false;    ///< warnings only
  bool verbose = false;  ///< details too
};

/// Sets the verbosity. Before the call only warnings are shown, on any rank, so that a program that uses the
/// library gets further output on request only. Logs go to stderr.
void configure(const Options& options);

void warning(const std::string& message);
void information(const std::string& message);
void detail(const std::string& message);

}  // namespace quadloop::log
