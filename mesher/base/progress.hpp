#pragma once

#include <string>

/// One line on a terminal that says what a long run is doing: stage, share done, rate, time left. It is
/// written anew in place, some times a second, and goes before anything else is said. Without a terminal, and
/// on ranks that are not to show it, nothing happens. No communication: the share is the calling rank's own.
/// No influence on results.
namespace quadloop::progress {

/// Shows the line on stderr from now on, where that is a terminal. Runs of less than half a second show
/// nothing.
void show();

/// What all lines begin with, as in "cycle 2 of 5"; empty for none.
void set_prefix(const std::string& prefix);

/// A stage under way, until it goes out of scope. Stages may lie within each other: the inner one is shown.
class Stage {
 public:
  /// `total` as advance() counts; 0 where it is not known.
  explicit Stage(const char* name, double total = 0, const char* unit = "");
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  /// So much of the total is done. Cheap enough to be called for every leaf.
  void advance(double done) {
    done_ = done;
    if (--calls_left_ <= 0) look();
  }
  /// What else is to be seen behind the share, and behind that, until it is said anew.
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

/// The innermost stage, or none: for those who are called in the middle of one.
Stage* current();

/// Takes the line from the terminal, so that something else can be said. It comes back with the next advance.
void clear();

}  // namespace quadloop::progress
