#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace quadloop {

/// Seconds that this rank spent in each named stage, in the order in which the stages ran.
class StageTimes {
 public:
  /// Ends the stage under way, if any, and begins the named one.
  void begin(std::string stage) {
    end();
    stages_.emplace_back(std::move(stage), 0.0);
    started_ = std::chrono::steady_clock::now();
    running_ = true;
  }
  void end() {
    if (!running_) return;
    stages_.back().second =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
    running_ = false;
  }
  /// The other's stages come after these.
  void append(const StageTimes& other) {
    end();
    stages_.insert(stages_.end(), other.stages_.begin(), other.stages_.end());
  }
  /// The other's stages come after these as one.
  void append_as(std::string stage, const StageTimes& other) {
    end();
    double sum = 0;
    for (const auto& [name, seconds] : other.stages_) sum += seconds;
    stages_.emplace_back(std::move(stage), sum);
  }
  const std::vector<std::pair<std::string, double>>& stages() const { return stages_; }

 private:
  std::vector<std::pair<std::string, double>> stages_;
  std::chrono::steady_clock::time_point started_;
  bool running_ = false;
};

}  // namespace quadloop
