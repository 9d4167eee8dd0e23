#include "tests/io/reader_check.hpp"

#include <gtest/gtest.h>

#include "mesher/base/error.hpp"
#include "tests/io/sample_mesh.hpp"

namespace quadloop::test {

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), with);
}

std::string with_crlf(const std::string& text) {
  std::string crlf;
  for (const char c : text) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  return crlf;
}

io::LoadedMesh ReaderCheck::of(const std::string& text) const {
  const TemporaryFolder folder;
  write_bytes(folder.file(name), text);
  return read(folder.file(name));
}

void ReaderCheck::expect_refusal(const std::string& text, const std::string& begins,
                                 const std::string& says) const {
  const TemporaryFolder folder;
  write_bytes(folder.file(name), text);
  std::string found;
  try {
    read(folder.file(name));
  } catch (const InputError& error) {
    found = std::string(error.what()).substr(folder.path().size() + 1);
  }
  EXPECT_EQ(found.substr(0, begins.size()), begins) << found << "\nof\n" << text;
  EXPECT_NE(found.find(says), std::string::npos) << found << "\nof\n" << text;
}

void ReaderCheck::expect_early_ends_refused(const std::string& text) const {
  for (std::size_t at = 0; at + 1 < text.size(); at = text.find('\n', at) + 1)
    expect_refusal(text.substr(0, at), name + ":", "");
}

}  // namespace quadloop::test
