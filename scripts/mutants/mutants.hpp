// Included by the sources that scripts/mutate rewrites: each mutation is a switch, and QUADLOOP_MUTANT names
// the one that is on. An operator `a < b` is written as `a < Less<17>{} < b`, which C++ groups as `(a <
// Less<17>{}) < b` whatever a and b are.
#pragma once
#pragma GCC system_header

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <type_traits>

namespace quadloop_mutant {

constexpr int most = 20000;
inline unsigned char reached[most];     ///< 1: evaluated since the last report
inline unsigned char impossible[most];  ///< 1: its types do not have the other operator
inline const int active = std::getenv("QUADLOOP_MUTANT") ? std::atoi(std::getenv("QUADLOOP_MUTANT")) : -1;

/// Appends `name` and what was reached since the last report to the file that QUADLOOP_REACHED names, one for
/// each process.
inline void report(const std::string& name) {
  const char* path = std::getenv("QUADLOOP_REACHED");
  if (path == nullptr) return;
  std::FILE* file = std::fopen((path + ("." + std::to_string(getpid()))).c_str(), "a");
  std::fputs(name.c_str(), file);
  for (int id = 0; id < most; ++id) {
    if (reached[id] != 0) std::fprintf(file, " %s%d", impossible[id] != 0 ? "-" : "", id);
    reached[id] = 0;
  }
  std::fputs("\n", file);
  std::fclose(file);
}

struct LastReport {
  ~LastReport() { report("*"); }
};
inline const LastReport last_report;

constexpr bool on(int id) {
  if (std::is_constant_evaluated()) return false;
  reached[id] = 1;
  return id == active;
}

template <int id, class T>
constexpr T number(T before, T after) {
  return on(id) ? after : before;
}

/// The same for what initialises a constant: the compiler must not evaluate it.
template <int id, class T>
T constant(T before, T after) {
  return number<id>(before, after);
}

#define QUADLOOP_MUTANT(Name, op, other)                                                                    \
  template <int id>                                                                                         \
  struct Name {};                                                                                           \
  template <int id, class A>                                                                                \
  struct Name##Left {                                                                                       \
    const A& a;                                                                                             \
  };                                                                                                        \
  template <int id, class A>                                                                                \
  constexpr Name##Left<id, A> operator op(const A& a, Name<id>) {                                           \
    return {a};                                                                                             \
  }                                                                                                         \
  template <int id, class A, class B>                                                                       \
  constexpr auto operator op(Name##Left<id, A> left, const B& b) {                                          \
    if constexpr (requires { requires std::is_same_v<decltype(left.a op b), decltype(left.a other b)>; }) { \
      return on(id) ? left.a other b : left.a op b;                                                         \
    } else {                                                                                                \
      if (!std::is_constant_evaluated()) reached[id] = impossible[id] = 1;                                  \
      return left.a op b;                                                                                   \
    }                                                                                                       \
  }
QUADLOOP_MUTANT(Less, <, <=)
QUADLOOP_MUTANT(LessEqual, <=, <)
QUADLOOP_MUTANT(Greater, >, >=)
QUADLOOP_MUTANT(GreaterEqual, >=, >)
QUADLOOP_MUTANT(Equal, ==, !=)
QUADLOOP_MUTANT(Unequal, !=, ==)
QUADLOOP_MUTANT(Plus, +, -)
QUADLOOP_MUTANT(Minus, -, +)
QUADLOOP_MUTANT(Times, *, /)
QUADLOOP_MUTANT(Divided, /, *)
#undef QUADLOOP_MUTANT

}  // namespace quadloop_mutant
