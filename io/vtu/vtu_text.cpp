#include "io/vtu/vtu_text.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "io/vtu/vtu_layers.hpp"

namespace quadloop::io {

std::string xml_escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&': result += "&amp;"; break;
      case '<': result += "&lt;"; break;
      case '>': result += "&gt;"; break;
      case '"': result += "&quot;"; break;
      default: result += static_cast<unsigned char>(c) < ' ' ? '_' : c;  // these cannot be written in XML
    }
  }
  return result;
}

std::string vtu_name_arrays(const std::vector<std::string>& names, int dimension) {
  const std::array<std::string_view, 4> ours{"boundary_names", "block_names", vtu_layer_counts,
                                             vtu_layer_thicknesses};
  std::string text;
  for (std::size_t n = 0; n < names.size(); ++n) {
    if (names[n].empty() || std::ranges::count(ours, names[n]) > 0) continue;
    text += "<DataArray type=\"Int32\" Name=\"" + xml_escaped(names[n]) +
            "\" NumberOfTuples=\"2\" format=\"ascii\">\n" + std::to_string(n + 1) + " " +
            std::to_string(dimension) + "\n</DataArray>\n";
  }
  return text;
}

std::string vtu_text_array(const std::string& name, const std::vector<std::string>& texts) {
  std::string codes;
  std::size_t count = 0;
  for (const std::string& text : texts) {
    for (const unsigned char c : text) codes += std::to_string(c) + " ";
    codes += "0\n";
    count += text.size() + 1;
  }
  return "<DataArray type=\"UInt8\" Name=\"" + name + "\" NumberOfTuples=\"" + std::to_string(count) +
         "\" format=\"ascii\">\n" + codes + "</DataArray>\n";
}

}  // namespace quadloop::io
