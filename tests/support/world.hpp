#pragma once

#include "mesher/base/parallel/communicator.hpp"

namespace quadloop::test {

/// All ranks that the test runs on. *Collective* at its first call; it ends before MPI does.
const Communicator& world();

/// Frees what world() made. The test main calls it.
void forget_world();

}  // namespace quadloop::test
