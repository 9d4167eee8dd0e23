#include "flow/command/log_tail.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <sstream>
#include <string_view>

#include "mesher/base/trimmed.hpp"

namespace quadloop::flow {

namespace {

constexpr std::streamoff most_bytes = 1 << 16;

bool says_something(const std::string& line) {
  return std::any_of(line.begin(), line.end(), [](char c) {
    const unsigned char byte = c;
    return std::isalnum(byte) != 0 || byte >= 0x80U;  // non-ASCII: part of a UTF-8 letter
  });
}

bool inside_character(char byte) { return (byte & 0xC0U) == 0x80U; }  // UTF-8

/// Trims a line and truncates it to `length` bytes between characters; tabs become blanks and other control
/// characters '?'.
std::string fit_for_message(std::string line, std::size_t length) {
  line = std::string(trimmed(line));
  if (line.size() > length) {
    std::size_t end = length;
    while (end > 0 && inside_character(line[end])) --end;
    line = line.substr(0, end) + "...";
  }
  for (char& c : line) {
    const unsigned char byte = c;
    if (c == '\t')
      c = ' ';
    else if (byte < 0x20U || byte == 0x7FU)
      c = '?';
  }
  return line;
}

/// Whether a line of an OpenFOAM message is its source location, or the next message.
bool ends_message(const std::string& line) {
  for (const char* const head : {"From ", "in file ", "FOAM exiting", "FOAM aborting", "-->"}) {
    if (line.starts_with(head)) return true;
  }
  return false;
}

/// Returns OpenFOAM's first error in the text.
std::string foam_error(const std::string& text) {
  constexpr std::string_view head = "--> FOAM FATAL";
  std::istringstream lines(text);
  std::string message, of_rank, line;
  while (std::getline(lines, line)) {
    if (message.empty()) {
      const std::size_t at = line.find(head);
      if (at == std::string::npos) continue;
      of_rank = trimmed(line.substr(0, at));  // "[2]", if there are several ranks
      message = trimmed(line.substr(at + 4));
      continue;
    }
    std::string words(trimmed(line));
    if (!words.starts_with(of_rank)) continue;
    words = std::string(trimmed(std::string_view(words).substr(of_rank.size())));
    if (ends_message(words)) break;
    if (!words.empty()) message += " " + words;
  }
  return message;
}

/// Returns SU2's first error in the text: the lines between its two rulers (CBaseMPIWrapper::Error).
std::string su2_error(const std::string& text) {
  std::istringstream lines(text);
  std::string message, line;
  bool inside = false;
  while (std::getline(lines, line)) {
    const std::string words(trimmed(line));
    if (words.find("Error Exit") != std::string::npos) break;
    if (inside && says_something(words)) message += (message.empty() ? "" : " ") + words;
    inside = inside || words.starts_with("Error in \"");
  }
  return message;
}

}  // namespace

std::string end_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) return {};
  const std::streamoff size = file.tellg();
  file.seekg(std::max<std::streamoff>(0, size - most_bytes));
  std::string bytes(std::min(size, most_bytes), '\0');
  file.read(bytes.data(), bytes.size());
  bytes.resize(file.gcount());
  return bytes;
}

std::string last_line(const std::string& path, std::size_t length) {
  const std::string bytes = end_of_file(path);
  for (std::size_t end = bytes.size(); end > 0;) {
    const std::size_t before = bytes.find_last_of("\r\n", end - 1);
    const std::size_t begin = before == std::string::npos ? 0 : before + 1;
    const std::string line = bytes.substr(begin, end - begin);
    if (says_something(line)) return fit_for_message(line, length);
    end = before == std::string::npos ? 0 : before;
  }
  return {};
}

std::string reported_error(const std::string& path, std::size_t length) {
  const std::string text = end_of_file(path);
  const std::string of_foam = foam_error(text);
  return fit_for_message(of_foam.empty() ? su2_error(text) : of_foam, length);
}

}  // namespace quadloop::flow
