#pragma once
#include <cstdio>
#include <cstdlib>
#include <ctime>
inline long g_visits = 0;
inline double g_last = 0;
inline void tick(const char* what) {
  static const bool on = std::getenv("TICK") != nullptr;
  if (!on) return;
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  const double now = static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  std::fprintf(stderr, "%-16s %.3f\n", what, now - g_last);
  g_last = now;
}
inline void tick_sweep(long stars, long moves) {
  static const bool on = std::getenv("TICK") != nullptr;
  if (on) std::fprintf(stderr, "free %ld moves %ld visits %ld ", stars, moves, g_visits);
  g_visits = 0;
  tick("sweep");
}
