#include "io/gis/gdal_library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

[[noreturn]] void refuse() {
  const char* reason = dlerror();
  throw InputError(
      fmt::format("maps are read by GDAL, which cannot be loaded ({}); install it, or convert the "
                  "file to .geom",
                  reason != nullptr ? reason : QUADLOOP_GDAL));
}

}  // namespace

const GdalLibrary& GdalLibrary::instance() {
  static const GdalLibrary library;
  return library;
}

/// Never unloaded, as its libraries have exit handlers.
GdalLibrary::GdalLibrary() {
  void* library = dlopen(QUADLOOP_GDAL, RTLD_LAZY | RTLD_LOCAL);
  if (library == nullptr) refuse();
#define QUADLOOP_LOAD(function)                                               \
  function = reinterpret_cast<decltype(function)>(dlsym(library, #function)); \
  if (function == nullptr) refuse();
  QUADLOOP_FOR_EACH_GDAL_FUNCTION(QUADLOOP_LOAD)
#undef QUADLOOP_LOAD
}

}  // namespace quadloop::io
