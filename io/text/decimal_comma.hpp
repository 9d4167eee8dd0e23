#pragma once

#include <string>
#include <string_view>

namespace quadloop::io {

/// Returns "0,5: a decimal comma; write 0.5" if the word is such a number; else an empty string.
std::string decimal_comma_in(std::string_view word);

}  // namespace quadloop::io
