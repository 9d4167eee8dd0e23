#pragma once

#include <string>
#include <vector>

namespace quadloop {

/// Names of letters, digits and "_-.+" alone, as readers of text want them, all different: any other sign
/// becomes "_", an empty name too, and names that are then the same get a number. Bytes above ASCII, parts of
/// letters in UTF-8, stay. The same names always give the same answer.
std::vector<std::string> plain_names(const std::vector<std::string>& names);

/// The same, each beginning with a letter or "_", for files in which a name must not look like a number.
std::vector<std::string> plain_words(const std::vector<std::string>& names);

}  // namespace quadloop
