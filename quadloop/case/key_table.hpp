#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "io/input/case_file.hpp"
#include "mesher/base/word_table.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop {

/// Requirement of a key on other keys. A condition is one of these, or several separated by " or ":
///
///     rotate                        the key is given
///     no viscosity                  the key is not given
///     kind = "su2"                  its value in the case, else its default
///     mach > 0, mach < 1
///
/// A name without a dot is a key of the same table; others are dotted names: solver.time = "steady".
struct KeyNeed {
  std::string condition;
  std::string remedy = {};
  std::string when = {};  ///< condition under which it is required; empty: always
  bool warns = false;     ///< if true, the key is accepted without it, with a warning that it has no effect
};

/// A required key: under a condition, or always if that is empty.
struct KeyRequired {
  std::string what;  ///< what the key specifies, for the message
  std::string when = {};
};

/// A row of the table of keys, as shown to users.
struct KeyText {
  std::string unit = {};
  std::string fallback = {};  ///< the default in words, if it is not a value
  std::string example = {};   ///< a valid value that is not the default, as TOML
  std::vector<KeyNeed> needs = {};
  std::vector<KeyRequired> required = {};

  // key() fills in the rest:
  std::string name = {};
  std::string meaning = {};  ///< sentences, with code and links in Markdown
  std::string value = {};    ///< type and range in words
  std::string initial = {};  ///< the default as JSON; empty: none, or one in words
};

/// All rows of one table. Its name is that in the file, with NAME for a name chosen by the user:
/// "boundary.NAME.layers"; empty for top-level keys.
struct TableText {
  std::string name;
  std::vector<KeyText> keys;
};

/// How the value of a key is read, described and printed.
template <class Value>
struct ValueForm {
  std::string text;                                                         ///< "number, above 0"
  std::string example;                                                      ///< as KeyText::example
  std::function<Value(const io::CaseTable&, const std::string& key)> read;  ///< throws InputError
  /// As JSON, empty for none; if not set, there is no default to print.
  std::function<std::string(const Value&)> show = {};
};

ValueForm<double> number(const io::Range& range = {});
ValueForm<std::int64_t> whole(const io::Range& range);
ValueForm<bool> flag();
ValueForm<std::string> text();
/// One string or a list of them; restricted to `words`, if there are any.
ValueForm<std::vector<std::string>> texts(const std::vector<std::string>& words = {});
ValueForm<Point> point();
/// `[x, y]` or a list of them.
ValueForm<std::vector<Point>> points();
/// A list of numbers, checked by `is_good`; `wanted` is what they must be. No geometry extends beyond 1e100.
ValueForm<std::vector<double>> numbers(const std::string& text, const std::string& example, std::size_t count,
                                       const std::string& wanted,
                                       bool (*is_good)(const std::vector<double>&));
/// `[x0, x1, y0, y1]`, a box that is not empty.
ValueForm<std::vector<double>> box();
/// A word that files can hold as a name.
ValueForm<std::string> boundary_name();

/// "`a`, `b` or `c`".
std::string words_in_text(const std::vector<std::string>& words);

/// A choice of words for values.
template <class Value>
ValueForm<Value> choice(std::vector<std::pair<const char*, Value>> values) {
  std::vector<std::string> words;
  for (const auto& [word, value] : values) words.emplace_back(word);
  const auto read = [values, words](const io::CaseTable& table, const std::string& key) {
    const std::string chosen = table.known_word(key, *table.text(key), words);
    return values[std::ranges::find(words, chosen) - words.begin()].second;
  };
  const auto show = [values](const Value& shown) {
    for (const auto& [word, value] : values) {
      if (value == shown) return "\"" + std::string(word) + "\"";
    }
    return std::string();
  };
  return {words_in_text(words), "\"" + words.back() + "\"", read, show};
}
template <class Value, std::size_t count>
ValueForm<Value> choice(const WordTable<Value, count>& values) {
  return choice(std::vector<std::pair<const char*, Value>>(values.begin(), values.end()));
}

/// A row, with functions for the member of the options that it sets.
template <class Target>
struct Key {
  KeyText text;
  std::function<void(const io::CaseTable&, Target&)> read;    ///< called if the table has the key
  std::function<bool(const Target&, const Target&)> differs;  ///< whether the member differs
};

template <class Member>
struct OwnerOf;
template <class Value, class Owner>
struct OwnerOf<Value Owner::*> {
  using Type = Owner;
};
template <class Member>
struct InOptional {
  using Type = Member;
};
template <class Value>
struct InOptional<std::optional<Value>> {
  using Type = Value;
};

/// Returns the member at the end of a path of member pointers.
template <auto... path, class Target>
auto& member_of(Target& target) {
  return (target.*....*path);
}

/// Returns the row of a key whose value is stored in the member at the end of the path.
template <auto first, auto... path, class Value>
auto key(const std::string& name, ValueForm<Value> form, const std::string& meaning, KeyText text = {}) {
  using Target = typename OwnerOf<decltype(first)>::Type;
  const Target usual{};
  const auto& member = member_of<first, path...>(usual);
  using Member = std::remove_cvref_t<decltype(member)>;
  using Taken = typename InOptional<Member>::Type;
  text.name = name;
  text.meaning = meaning;
  text.value = form.text;
  if (text.example.empty()) text.example = form.example;
  if constexpr (std::is_constructible_v<Value, const Taken&>) {
    const std::optional<Taken> initial = member;
    if (form.show && initial) text.initial = form.show(static_cast<Value>(*initial));
  }
  const auto read = [name, form](const io::CaseTable& table, Target& target) {
    member_of<first, path...>(target) = static_cast<Taken>(form.read(table, name));
  };
  const auto differs = [](const Target& a, const Target& b) {
    return !(member_of<first, path...>(a) == member_of<first, path...>(b));
  };
  return Key<Target>{std::move(text), read, differs};
}

/// Throws InputError, with the nearest known key, for the first key of the table that is not in `names`.
void refuse_unknown_keys(const io::CaseTable& table, const std::vector<std::string>& names);

/// Throws InputError for a missing required key, and for a key whose requirements are not met, or warns of
/// it.
void require_needs(const io::CaseTable& table, const TableText& text);

/// The keys of one table, with the options that they set.
template <class Target>
class KeyTable {
 public:
  KeyTable(std::string name, std::vector<Key<Target>> keys)
      : text_{std::move(name), {}}, keys_{std::move(keys)} {
    for (const Key<Target>& key : keys_) text_.keys.push_back(key.text);
  }

  const TableText& text() const { return text_; }
  const std::vector<Key<Target>>& keys() const { return keys_; }

  /// Throws InputError with location, key and remedy.
  void read(const io::CaseTable& table, Target& target) const {
    std::vector<std::string> names;
    for (const KeyText& key : text_.keys) names.push_back(key.name);
    refuse_unknown_keys(table, names);
    for (const Key<Target>& key : keys_) {
      if (table.has(key.text.name)) key.read(table, target);
    }
    require_needs(table, text_);
  }

  /// Returns the same rows for a struct that has the options as a member.
  template <auto member>
  auto keys_of() const {
    using Whole = typename OwnerOf<decltype(member)>::Type;
    std::vector<Key<Whole>> lifted;
    for (const Key<Target>& key : keys_) {
      lifted.push_back({key.text,
                        [read = key.read](const io::CaseTable& t, Whole& whole) { read(t, whole.*member); },
                        [differs = key.differs](const Whole& a, const Whole& b) {
                          return differs(a.*member, b.*member);
                        }});
    }
    return lifted;
  }

 private:
  TableText text_;
  std::vector<Key<Target>> keys_;
};

/// The rows of several tables.
template <class Target>
std::vector<Key<Target>> joined(const std::vector<std::vector<Key<Target>>>& tables) {
  std::vector<Key<Target>> all;
  for (const std::vector<Key<Target>>& keys : tables) all.insert(all.end(), keys.begin(), keys.end());
  return all;
}

}  // namespace quadloop
