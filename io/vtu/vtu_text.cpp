#include "io/vtu/vtu_text.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "io/text/text_output.hpp"
#include "io/vtu/vtk_output.hpp"
#include "io/vtu/vtu_layers.hpp"

namespace quadloop::io {

namespace {

std::string data_array(const char* type, const std::string& name, std::size_t count,
                       const std::string& values) {
  return std::string("<DataArray type=\"") + type + "\" Name=\"" + xml_escaped(name) +
         "\" NumberOfTuples=\"" + std::to_string(count) + "\" format=\"ascii\">\n" + values +
         "</DataArray>\n";
}

template <class Number>
std::string rows_of(const std::vector<Number>& numbers) {
  TextRows rows(std::ssize(numbers), 1);
  for (const Number number : numbers) rows.put(number, '\n');
  return std::string(rows.view());
}

}  // namespace

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
  const std::array<std::string_view, 4> ours{vtk_boundary_names, "block_names", vtu_layer_counts,
                                             vtu_layer_thicknesses};
  std::string text;
  for (std::size_t n = 0; n < names.size(); ++n) {
    if (names[n].empty() || std::ranges::count(ours, names[n]) > 0) continue;
    text += data_array("Int32", names[n], 2, std::to_string(n + 1) + " " + std::to_string(dimension) + "\n");
  }
  return text;
}

std::string vtu_field_array(const std::string& name, const std::vector<std::string>& texts) {
  std::string codes;
  std::size_t count = 0;
  for (const std::string& text : texts) {
    for (const unsigned char c : text) codes += std::to_string(c) + " ";
    codes += "0\n";
    count += text.size() + 1;
  }
  return data_array("UInt8", name, count, codes);
}

std::string vtu_field_array(const std::string& name, const std::vector<std::int32_t>& numbers) {
  return data_array("Int32", name, numbers.size(), rows_of(numbers));
}

std::string vtu_field_array(const std::string& name, const std::vector<double>& numbers) {
  return data_array("Float64", name, numbers.size(), rows_of(numbers));
}

}  // namespace quadloop::io
