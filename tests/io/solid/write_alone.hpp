#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "io/solid_file.hpp"

namespace quadloop::test {

/// The mesh, which one rank holds whole, as the only output of a set.
inline void write_alone(const Communicator& alone, const SolidMesh& mesh, const std::string& path,
                        const std::string& format = {}) {
  OutputSet outputs(alone);
  write_solid(outputs, mesh, path, format);
  outputs.commit();
}

}  // namespace quadloop::test
