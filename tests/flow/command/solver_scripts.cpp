#include "tests/flow/command/solver_scripts.hpp"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

#include "tests/support/world.hpp"

namespace quadloop::test {

namespace {

/// True once `condition` holds; false after ten seconds.
bool comes_true(const std::function<bool()>& condition) {
  for (int i = 0; i < 2000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

bool runs(pid_t process) {
  const std::string state = bytes_of("/proc/" + std::to_string(process) + "/stat");
  const std::size_t name_end = state.rfind(") ");
  return name_end != std::string::npos && state[name_end + 2] != 'Z';
}

}  // namespace

const std::string start_stubborn_processes =
    "trap '' TERM\n"
    "sleep 1000 & echo $! > child\n"
    "setsid sleep 1000 & echo $! > leader\n"
    "( setsid sh -c 'echo $$ > orphan; exec sleep 1000' & )\n"
    "while ! test -s orphan; do sleep 0.01; done\n";
const std::vector<std::string> stubborn_processes{"child", "leader", "orphan"};

flow::SolverFiles CycleFolder::files() const {
  return {path(), file("mesh.mesh"), file("solution.mesh"), path(), 6, 4};
}

flow::SolverCommand CycleFolder::script(const std::string& lines) const {
  write("solver.sh", "#!/bin/sh\n" + lines + "\n");
  if (world().is_root()) std::filesystem::permissions(file("solver.sh"), std::filesystem::perms::owner_all);
  world().barrier();
  return {{"{case}/solver.sh", "{solution}"}, 30};
}

Refusal refusal_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return {error.status(), error.what()};
  }
  return {};
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

pid_t written_process(const std::string& path) {
  std::string text;
  const bool whole = comes_true([&] {
    text = bytes_of(path);
    return text.ends_with('\n');
  });
  return whole ? std::stoi(text) : 0;
}

bool vanishes(pid_t process) {
  return comes_true([&] { return !runs(process); });
}

}  // namespace quadloop::test
