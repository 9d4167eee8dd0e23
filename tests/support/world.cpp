#include "tests/support/world.hpp"

#include <memory>

namespace quadloop::test {

namespace {

std::unique_ptr<Communicator>& held_world() {
  static std::unique_ptr<Communicator> held;
  return held;
}

}  // namespace

const Communicator& world() {
  if (!held_world()) held_world() = std::make_unique<Communicator>(MPI_COMM_WORLD);
  return *held_world();
}

void forget_world() { held_world().reset(); }

}  // namespace quadloop::test
