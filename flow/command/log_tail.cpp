#include "flow/command/log_tail.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>

namespace quadloop {

namespace {

constexpr std::streamoff most_bytes = 1 << 16;

bool says_something(const std::string& line) {
  return std::any_of(line.begin(), line.end(), [](char c) {
    const unsigned char byte = c;
    return std::isalnum(byte) != 0 || byte >= 0x80U;  // above ASCII: part of a letter in UTF-8
  });
}

bool inside_character(char byte) { return (byte & 0xC0U) == 0x80U; }  // UTF-8

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

std::string fit_for_message(std::string line, std::size_t length) {
  const std::string blanks = " \t";
  line.erase(line.find_last_not_of(blanks) + 1);
  line.erase(0, line.find_first_not_of(blanks));
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

}  // namespace quadloop
