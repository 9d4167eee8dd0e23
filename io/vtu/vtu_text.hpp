#pragma once

#include <string>
#include <vector>

namespace quadloop {

/// A text between the quotes of an XML attribute, each control character as "_".
std::string xml_escaped(const std::string& text);

/// The codes of the texts' bytes, after each text a 0: what an array of strings holds, but under a type of
/// numbers, since not every reader knows strings. A whole DataArray.
std::string vtu_text_array(const std::string& name, const std::vector<std::string>& texts);

/// For each boundary an array of its own name, so that people, and meshio, see them: its number, from 1, and
/// the dimension of its edges or faces. Left out are names that field data of ours have.
std::string vtu_name_arrays(const std::vector<std::string>& names, int dimension);

}  // namespace quadloop
