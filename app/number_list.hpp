#pragma once

#include <string>
#include <vector>

namespace quadloop::app {

/// Parses finite numbers with a separator between them: `least` to `most` of them. Throws UsageError, which
/// begins with `refusal` and ends with the text.
std::vector<double> number_list(const std::string& text, char between, std::size_t least, std::size_t most,
                                const std::string& refusal);

}  // namespace quadloop::app
