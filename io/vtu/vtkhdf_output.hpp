#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/vtu/vtk_output.hpp"
#include "io/vtu/vtkhdf_file.hpp"

namespace quadloop::io {

/// A VTKHDF file. Rank 0 creates it by HDF5, with space for the arrays; all ranks fill these.
class VtkHdfOutput : public VtkOutput {
 public:
  using VtkOutput::VtkOutput;

  bool has_first_offset() const override { return true; }
  std::vector<std::string> names_of(const std::vector<std::string>& variables) const override {
    return vtkhdf_variable_names(variables);
  }
  void write(std::int64_t points, std::int64_t cells) override;

 private:
  std::vector<std::int64_t> create(std::int64_t points, std::int64_t cells) const;
};

}  // namespace quadloop::io
