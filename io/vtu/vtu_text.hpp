#pragma once

#include <string>
#include <vector>

namespace quadloop {

/// A text between the quotes of an XML attribute.
std::string xml_escaped(const std::string& text);

/// The codes of the texts' bytes, after each text a 0: what an array of strings holds, but under a type of
/// numbers, since not every reader knows strings. A whole DataArray.
std::string vtu_text_array(const std::string& name, const std::vector<std::string>& texts);

}  // namespace quadloop
