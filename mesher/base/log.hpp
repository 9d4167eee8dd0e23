#pragma once

#include <string>

namespace quadloop::log {

/// How much of what is logged is shown. Warnings and information come from the root rank alone; `verbose`
/// adds the details, and those of every rank, each line with its rank.
struct Options {
  int rank = 0, ranks = 1;
  bool quiet = false;    ///< nothing but warnings
  bool verbose = false;  ///< details too
};

/// Sets what is shown; before it is called, warnings alone are, on any rank: a program that uses the library
/// hears of the rest only where it asks. Logs go to stderr.
void configure(const Options& options);

void warning(const std::string& message);
void information(const std::string& message);
void detail(const std::string& message);

}  // namespace quadloop::log
