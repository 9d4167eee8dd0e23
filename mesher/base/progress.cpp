#include "mesher/base/progress.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>

namespace quadloop::progress {

namespace {

constexpr double between_lines = 0.2, short_run = 0.5;  // seconds
constexpr int most_calls_between = 4096;
constexpr std::size_t narrow = 20, usual = 80;  // columns

struct Terminal {
  bool shown = false;
  bool dirty = false;    ///< whether the line is displayed
  double next_line = 0;  ///< earliest time of the next update
};

/// What a thread works on.
struct Running {
  std::string prefix;
  Stage* stage = nullptr;
};

Running& running() {
  static thread_local Running of_thread;
  return of_thread;
}

Terminal& terminal() {
  static Terminal instance;
  return instance;
}

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::size_t columns() {
  winsize size{};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col >= narrow;
  return known ? size.ws_col : usual;
}

template <class... Values>
std::string formatted(const char* format, Values... values) {
  std::array<char, 128> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

std::string duration_text(double seconds) {
  constexpr double minute = 60, hour = 3600;
  if (seconds < minute) return formatted("%.0f s", std::max(1.0, seconds));
  if (seconds < hour)
    return formatted("%d min %02d s", static_cast<int>(seconds / minute),
                     static_cast<int>(seconds) % static_cast<int>(minute));
  return formatted("%d h %02d min", static_cast<int>(seconds / hour),
                   static_cast<int>(seconds / minute) % static_cast<int>(minute));
}

std::string rate_text(double rate) {
  constexpr double thousand = 1e3, million = 1e6;
  if (rate >= million) return formatted("%.1f million", rate / million);
  return rate >= thousand ? formatted("%.0f thousand", rate / thousand) : formatted("%.3g", rate);
}

}  // namespace

void show() {
  Terminal& t = terminal();
  t.shown = isatty(STDERR_FILENO) == 1;
  t.next_line = now() + short_run;
}

void set_prefix(const std::string& prefix) { running().prefix = prefix; }

Stage* current() { return running().stage; }

void clear() {
  Terminal& t = terminal();
  if (!t.dirty) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  t.dirty = false;
}

Stage::Stage(const char* name, double total, const char* unit)
    : name_{name}, unit_{unit}, total_{total}, started_{now()}, outer_{running().stage} {
  running().stage = this;
  look();
}

Stage::~Stage() {
  running().stage = outer_;
  clear();
}

/// Redraws the line if it is time, and adjusts the number of calls until the next look at the clock.
void Stage::look() {
  calls_left_ = most_calls_between;
  Terminal& t = terminal();
  if (!t.shown) return;
  const double time = now(), left = t.next_line - time;
  if (left <= 0) {
    draw();
    t.next_line = time + between_lines;
    calls_between_ = std::max(1, calls_between_ / 2);
  } else {
    calls_between_ = left > between_lines / 2 ? std::min(2 * calls_between_, most_calls_between) : 1;
  }
  calls_left_ = calls_between_;
}

void Stage::draw() {
  const double seconds = now() - started_, share = total_ > 0 ? std::min(done_ / total_, 1.0) : 0;
  const std::string& prefix = running().prefix;
  std::string line = prefix.empty() ? std::string(name_) : prefix + ": " + name_;
  if (total_ > 0) line += formatted("  %3.0f %%", 100 * share);
  for (const std::string* text : {&text_, &then_}) line += text->empty() ? "" : "  " + *text;
  if (done_ > 0 && seconds > 0) line += "  " + rate_text(done_ / seconds) + " " + unit_ + "/s";
  if (share > 0 && share < 1 && seconds > between_lines)
    line += "  " + duration_text(seconds * (1 - share) / share) + " left";
  line.resize(std::min(line.size(), columns() - 1));
  std::fprintf(stderr, "\r%s\033[K", line.c_str());
  std::fflush(stderr);
  terminal().dirty = true;
}

}  // namespace quadloop::progress
