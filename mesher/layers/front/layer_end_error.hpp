#pragma once

#include <string>
#include <utility>

#include "mesher/base/error.hpp"

namespace quadloop {

/// The layers of a boundary cannot end where they would; the message gives the place and a remedy.
class LayerEndError : public InputError {
 public:
  LayerEndError(std::string boundary, const std::string& message)
      : InputError(message), boundary_{std::move(boundary)} {}
  const std::string& boundary() const { return boundary_; }

 private:
  std::string boundary_;
};

}  // namespace quadloop
