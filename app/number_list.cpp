#include "app/number_list.hpp"

#include <charconv>
#include <cmath>

#include "mesher/base/error.hpp"

namespace quadloop::app {

std::vector<double> number_list(const std::string& text, char between, std::size_t least, std::size_t most,
                                const std::string& refusal) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (bool more = true; more;) {
    double number = 0;
    const auto [rest, error] = std::from_chars(at, end, number);
    more = rest != end;
    if (error != std::errc() || !std::isfinite(number) || (more && *rest != between)) {
      numbers.clear();
      break;
    }
    numbers.push_back(number);
    at = rest + (more ? 1 : 0);
  }
  if (numbers.size() < least || numbers.size() > most) throw UsageError(refusal + ", not '" + text + "'");
  return numbers;
}

}  // namespace quadloop::app
