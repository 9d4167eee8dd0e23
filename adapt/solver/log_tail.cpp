#include "adapt/solver/log_tail.hpp"

#include <algorithm>
#include <fstream>

namespace quadloop {

namespace {

constexpr std::streamoff most_bytes = 1 << 16;

std::string end_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) return {};
  const std::streamoff size = file.tellg();
  file.seekg(std::max<std::streamoff>(0, size - most_bytes));
  std::string bytes(static_cast<std::size_t>(std::min(size, most_bytes)), '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

bool inside_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; }  // UTF-8

std::string shown(std::string line, std::size_t length) {
  const std::string blanks = " \t";
  line.erase(line.find_last_not_of(blanks) + 1);
  line.erase(0, line.find_first_not_of(blanks));
  if (line.size() > length) {
    std::size_t end = length;
    while (end > 0 && inside_character(line[end])) --end;
    line = line.substr(0, end) + "...";
  }
  for (char& c : line) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '\t')
      c = ' ';
    else if (byte < 0x20U || byte == 0x7FU)
      c = '?';
  }
  return line;
}

}  // namespace

std::vector<std::string> last_lines(const std::string& path, std::size_t lines, std::size_t length) {
  const std::string bytes = end_of_file(path);
  std::vector<std::string> found;
  for (std::size_t end = bytes.size(); found.size() < lines;) {
    const std::size_t before = end == 0 ? std::string::npos : bytes.find_last_of("\r\n", end - 1);
    const std::size_t begin = before == std::string::npos ? 0 : before + 1;
    const std::string line = shown(bytes.substr(begin, end - begin), length);
    if (!line.empty()) found.push_back(line);
    if (before == std::string::npos) break;
    end = before;
  }
  std::reverse(found.begin(), found.end());
  return found;
}

}  // namespace quadloop
