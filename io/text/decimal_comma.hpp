#pragma once

#include <string>
#include <string_view>

namespace quadloop {

/// "0,5: a decimal comma; write 0.5" where the word is a number written so; else empty.
std::string decimal_comma_in(std::string_view word);

}  // namespace quadloop
