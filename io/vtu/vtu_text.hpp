#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace quadloop::io {

/// Escapes a text for an XML attribute; control characters become "_".
std::string xml_escaped(const std::string& text);

/// Return a whole DataArray of field data. Texts become byte codes, each text followed by 0: as in an array
/// of strings, but of a numeric type, since not every reader supports strings.
std::string vtu_field_array(const std::string& name, const std::vector<std::string>& texts);
std::string vtu_field_array(const std::string& name, const std::vector<std::int32_t>& numbers);
std::string vtu_field_array(const std::string& name, const std::vector<double>& numbers);

/// Returns an array for each boundary, with its name, for users and for meshio: its number, from 1, and the
/// dimension of its edges or faces. Names used by our own field data are omitted.
std::string vtu_name_arrays(const std::vector<std::string>& names, int dimension);

}  // namespace quadloop::io
