#include "flow/command/foam_error.hpp"

#include <sstream>
#include <string_view>

#include "flow/command/log_tail.hpp"

namespace quadloop {

namespace {

std::string trimmed(const std::string& line) {
  constexpr const char* blanks = " \t\r";
  const std::size_t begin = line.find_first_not_of(blanks);
  if (begin == std::string::npos) return {};
  return line.substr(begin, line.find_last_not_of(blanks) + 1 - begin);
}

bool ends_message(const std::string& line) {
  for (const char* const head : {"From ", "in file ", "FOAM exiting", "FOAM aborting", "-->"}) {
    if (line.starts_with(head)) return true;
  }
  return false;
}

}  // namespace

std::string foam_error(const std::string& path, std::size_t length) {
  constexpr std::string_view head = "--> FOAM FATAL";
  std::istringstream lines(end_of_file(path));
  std::string message, of_rank, line;
  while (std::getline(lines, line)) {
    if (message.empty()) {
      const std::size_t at = line.find(head);
      if (at == std::string::npos) continue;
      of_rank = trimmed(line.substr(0, at));  // "[2]", where there are several
      message = trimmed(line.substr(at + 4));
      continue;
    }
    std::string words = trimmed(line);
    if (!words.starts_with(of_rank)) continue;
    words = trimmed(words.substr(of_rank.size()));
    if (ends_message(words)) break;
    if (!words.empty()) message += " " + words;
  }
  return fit_for_message(message, length);
}

}  // namespace quadloop
