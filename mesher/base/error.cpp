#include "mesher/base/error.hpp"

namespace quadloop {

void require(bool condition, const char* message, const char* file, int line) {
  if (!condition) throw Fault(std::string(file) + ":" + std::to_string(line) + ": " + message);
}

}  // namespace quadloop
