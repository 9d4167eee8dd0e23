#include "io/plot/canvas/plot_format.hpp"

#include "mesher/base/error.hpp"
#include "mesher/base/suffix.hpp"

namespace quadloop::io {

PlotFormat plot_format_of(const std::string& path) {
  const std::string suffix = suffix_of(path);
  if (suffix == ".png") return PlotFormat::png;
  if (suffix == ".svg") return PlotFormat::svg;
  if (suffix == ".pdf") return PlotFormat::pdf;
  throw InputError(path + ": a picture cannot be written in the format '" + suffix +
                   "'; end its name in .png, .svg or .pdf");
}

}  // namespace quadloop::io
