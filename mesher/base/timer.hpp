#pragma once

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "mesher/base/stage_mark.hpp"

namespace quadloop {

using StageSeconds = std::vector<std::pair<std::string, double>>;

/// Seconds that this rank spent in each named stage, in the order of the stages; profilers are told of them.
class StageTimes {
 public:
  /// Ends the running stage, if any, and starts the named one.
  void begin(std::string stage) {
    end();
    mark_stage_begin(stage);
    stages_.emplace_back(std::move(stage), 0.0);
    started_ = std::chrono::steady_clock::now();
    running_ = true;
  }
  void end() {
    if (!running_) return;
    stages_.back().second =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
    running_ = false;
    mark_stage_end(stages_.back().first);
  }
  /// Appends the stages of `other`.
  void append(const StageTimes& other) {
    end();
    stages_.insert(stages_.end(), other.stages_.begin(), other.stages_.end());
  }
  /// Appends the stages of `other` as a single one.
  void append_as(std::string stage, const StageTimes& other) {
    end();
    double sum = 0;
    for (const auto& [name, seconds] : other.stages_) sum += seconds;
    stages_.emplace_back(std::move(stage), sum);
  }
  const StageSeconds& stages() const { return stages_; }

 private:
  StageSeconds stages_;
  std::chrono::steady_clock::time_point started_;
  bool running_ = false;
};

/// Adds up stages of the same name.
inline StageSeconds added_up(const StageSeconds& stages) {
  StageSeconds sums;
  for (const auto& [stage, seconds] : stages) {
    const auto known = std::ranges::find(sums, stage, &StageSeconds::value_type::first);
    if (known == sums.end())
      sums.emplace_back(stage, seconds);
    else
      known->second += seconds;
  }
  return sums;
}

}  // namespace quadloop
