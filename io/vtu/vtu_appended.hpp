#pragma once

#include <cstdint>
#include <string>

#include "io/vtu/vtk_output.hpp"

namespace quadloop::io {

/// A VTK XML file whose arrays are appended as raw little-endian bytes after the XML.
class VtuAppended : public VtkOutput {
 public:
  using VtkOutput::VtkOutput;

  bool has_first_offset() const override { return false; }
  void write(std::int64_t points, std::int64_t cells) override;

 private:
  std::string head(std::int64_t points, std::int64_t cells) const;
  std::string tags_of(VtkSection section, std::int64_t& offset) const;
};

}  // namespace quadloop::io
