#include "mesher/mesh/variable_names.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include "mesher/base/error.hpp"
#include "mesher/base/nearest_word.hpp"

namespace quadloop {

namespace {

/// Groups of names that programs use for the same variable, without case, blanks and punctuation.
const std::vector<std::vector<std::string_view>>& usual_names() {
  static const std::vector<std::vector<std::string_view>> groups{
      {"density", "rho"},
      {"pressure", "p", "staticpressure"},
      {"temperature", "t", "statictemperature"},
      {"mach", "machnumber", "ma"},
      {"xvelocity", "velocityx", "u", "ux", "vx", "velocity0"},
      {"yvelocity", "velocityy", "v", "uy", "vy", "velocity1"},
      {"xmomentum", "momentumx", "rhou", "rhoux", "momentum0"},
      {"ymomentum", "momentumy", "rhov", "rhouy", "momentum1"},
      {"energy", "totalenergy", "energystagnationdensity", "rhoe", "e"}};
  return groups;
}

std::string plain(std::string_view name) {
  std::string result;
  for (const char c : name) {
    if (c >= 'A' && c <= 'Z') {
      result += static_cast<char>(c - 'A' + 'a');
    } else if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || (c & 0x80U) != 0) {
      result += c;
    }
  }
  return result;
}

std::string list_of(std::span<const std::string> names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list.empty() ? "none" : list;
}

bool are_aliases(const std::string& a, const std::string& b) {
  const auto holds = [](const auto& group, const std::string& name) {
    return std::find(group.begin(), group.end(), name) != group.end();
  };
  const auto& groups = usual_names();
  return std::any_of(groups.begin(), groups.end(),
                     [&](const auto& group) { return holds(group, a) && holds(group, b); });
}

template <class Fits>
std::vector<std::size_t> all_that(std::span<const std::string> names, const Fits& fits) {
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (fits(names[k])) found.push_back(k);
  }
  return found;
}

}  // namespace

std::vector<std::size_t> variables_like(std::span<const std::string> names, const std::string& wanted) {
  const std::string key = plain(wanted);
  std::vector<std::size_t> found = all_that(names, [&](const std::string& name) { return name == wanted; });
  if (found.empty()) found = all_that(names, [&](const std::string& name) { return plain(name) == key; });
  if (found.empty())
    found = all_that(names, [&](const std::string& name) { return are_aliases(plain(name), key); });
  return found;
}

std::size_t variable(std::span<const std::string> names, const std::string& wanted,
                     const std::string& where) {
  const std::vector<std::size_t> found = variables_like(names, wanted);
  if (found.size() == 1 || (!found.empty() && names[found.front()] == wanted)) return found.front();
  if (found.empty())
    throw InputError(where + ": no variable '" + wanted + "' in the solution; it has: " + list_of(names) +
                     guess_for(wanted, {names.begin(), names.end()}));
  throw InputError(where + ": '" + wanted + "' may be " + names[found[0]] + " or " + names[found[1]] +
                   "; name one of them as it is written");
}

std::optional<std::size_t> only_variable_like(std::span<const std::string> names, const std::string& wanted) {
  const std::vector<std::size_t> found = variables_like(names, wanted);
  if (found.size() != 1) return std::nullopt;
  return found.front();
}

std::optional<std::array<std::size_t, 2>> components_like(std::span<const std::string> names,
                                                          const std::string& wanted) {
  const auto x = only_variable_like(names, wanted + "_x"), y = only_variable_like(names, wanted + "_y");
  if (!x || !y) return std::nullopt;
  return {{*x, *y}};
}

std::string word_of(const std::string& name) {
  std::string word = name;
  for (char& c : word) {
    if (static_cast<unsigned char>(c) <= ' ' || c == '\x7f') c = '_';
  }
  return word;
}

void require_distinct(std::span<const std::string> names, const std::string& where) {
  std::vector<std::string> sorted(names.begin(), names.end());
  std::ranges::sort(sorted);
  const auto first = std::ranges::adjacent_find(sorted);
  if (first != sorted.end())
    throw InputError(where + ": two variables are named '" + *first + "'; give one of them another name");
}

std::vector<std::string> distinct_words(std::span<const std::string> names, const std::string& where) {
  std::vector<std::string> words;
  for (const std::string& name : names) {
    const std::string word = name.empty() ? "v" + std::to_string(words.size() + 1) : word_of(name);
    const auto same = std::find(words.begin(), words.end(), word);
    if (same != words.end()) {
      const std::string& other = names[same - words.begin()];
      const std::string fault = other == name ? "two variables are named '" + name + "'"
                                              : "the variables '" + other + "' and '" + name +
                                                    "' are both '" + word + "', as blanks become '_'";
      throw InputError(where + ": " + fault + "; give one of them another name");
    }
    words.push_back(word);
  }
  return words;
}

}  // namespace quadloop
