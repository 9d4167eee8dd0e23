#include "io/vtu/vtu_text.hpp"

namespace quadloop {

std::string xml_escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&': result += "&amp;"; break;
      case '<': result += "&lt;"; break;
      case '>': result += "&gt;"; break;
      case '"': result += "&quot;"; break;
      default: result += c;
    }
  }
  return result;
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

}  // namespace quadloop
