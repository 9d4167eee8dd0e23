#pragma once

#include <string>
#include <vector>

namespace quadloop::io {

/// Returns distinct names of letters, digits and "_-.+" only, for readers of text formats: any other
/// character, or an empty name, becomes "_", and duplicates get a number. Non-ASCII bytes (parts of UTF-8
/// letters) are kept. Deterministic.
std::vector<std::string> plain_names(const std::vector<std::string>& names);

/// The same, each beginning with a letter or "_", for files in which a name must not look like a number.
std::vector<std::string> plain_words(const std::vector<std::string>& names);

}  // namespace quadloop::io
