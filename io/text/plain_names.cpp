#include "io/text/plain_names.hpp"

#include <string_view>

#include "io/text/name_index.hpp"

namespace quadloop::io {

namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c & 0x80U) != 0; }

std::string plain(const std::string& name) {
  std::string result = name.empty() ? "_" : name;
  for (char& c : result) {
    const bool digit = c >= '0' && c <= '9';
    if (!is_letter(c) && !digit && std::string_view("_-.+").find(c) == std::string_view::npos) c = '_';
  }
  return result;
}

std::string plain_word(const std::string& name) {
  const std::string result = plain(name);
  return is_letter(result.front()) || result.front() == '_' ? result : "_" + result;
}

template <class Form>
std::vector<std::string> distinct(const std::vector<std::string>& names, const Form& form) {
  std::vector<std::string> result;
  DistinctNames taken;
  for (const std::string& name : names) {
    const std::string wanted = form(name);
    result.push_back(taken.name(wanted, [&](const std::string& suffix) { return wanted + suffix; }));
  }
  return result;
}

}  // namespace

std::vector<std::string> plain_names(const std::vector<std::string>& names) { return distinct(names, plain); }

std::vector<std::string> plain_words(const std::vector<std::string>& names) {
  return distinct(names, plain_word);
}

}  // namespace quadloop::io
