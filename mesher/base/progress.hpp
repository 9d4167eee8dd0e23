#pragma once

#include <string>

/// A progress line on a terminal: stage, fraction done, rate, time left. It is updated in place a few times
/// per second and removed before other output. Without a terminal, and on ranks that do not show it, nothing
/// happens. No communication: the fraction is that of the calling rank. No influence on results.
namespace quadloop::progress {

/// Enables the line on stderr, if that is a terminal. Runs of less than half a second show nothing.
void show();

/// Sets the prefix of all lines, e.g. "cycle 2 of 5"; empty for none.
void set_prefix(const std::string& prefix);

/// A running stage, until it goes out of scope. Stages may be nested: the inner one is shown.
class Stage {
 public:
  /// `total` in units of advance(); 0 if it is not known.
  explicit Stage(const char* name, double total = 0, const char* unit = "");
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  /// Sets how much of the total is done. Cheap enough to be called for every leaf.
  void advance(double done) {
    done_ = done;
    if (--calls_left_ <= 0) look();
  }
  /// Sets texts shown after the fraction, until they are changed.
  void say(const std::string& text) { text_ = text; }
  void say_then(const std::string& text) { then_ = text; }

 private:
  void look();
  void draw();

  const char* name_;
  const char* unit_;
  double total_, done_ = 0, started_;
  int calls_left_ = 0, calls_between_ = 1;
  std::string text_, then_;
  Stage* outer_;
};

/// Returns the innermost stage, or null: for functions called within a stage.
Stage* current();

/// Removes the line from the terminal before other output. It reappears with the next advance().
void clear();

}  // namespace quadloop::progress
