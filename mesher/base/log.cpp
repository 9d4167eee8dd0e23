#include "mesher/base/log.hpp"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <utility>

#include "mesher/base/progress.hpp"
#include "mesher/base/utf8.hpp"

namespace quadloop::log {

namespace {

/// The program's logger on stderr, not in spdlog's registry, so that it cannot interfere with loggers of an
/// application that uses the library.
spdlog::logger& logger() {
  static const auto instance = [] {
    auto made =
        std::make_shared<spdlog::logger>("quadloop", std::make_shared<spdlog::sinks::stderr_sink_st>());
    made->set_pattern("quadloop: %l: %v");
    made->set_level(spdlog::level::warn);
    return made;
  }();
  return *instance;
}

Sink& sink() {
  static Sink instance;
  return instance;
}

// The message is passed as an argument, not as a format string, as file names may contain braces. It may
// quote damaged input.
void log(Level level, spdlog::level::level_enum of_logger, const std::string& message) {
  progress::clear();
  if (sink())
    sink()(level, printable(message));
  else
    logger().log(of_logger, "{}", printable(message));
}

}  // namespace

void send_to(Sink to) { sink() = std::move(to); }

void configure(const Options& options) {
  const bool names_rank = options.verbose && options.ranks > 1;
  logger().set_pattern(names_rank ? "quadloop[" + std::to_string(options.rank) + "]: %l: %v"
                                  : std::string("quadloop: %l: %v"));
  if (options.verbose) {
    logger().set_level(spdlog::level::debug);
  } else if (options.rank != 0) {
    logger().set_level(spdlog::level::off);
  } else {
    logger().set_level(options.quiet ? spdlog::level::warn : spdlog::level::info);
  }
}

void warning(const std::string& message) { log(Level::warning, spdlog::level::warn, message); }

void information(const std::string& message) { log(Level::information, spdlog::level::info, message); }

void detail(const std::string& message) { log(Level::detail, spdlog::level::debug, message); }

}  // namespace quadloop::log
