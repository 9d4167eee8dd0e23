#include "io/text/decimal_comma.hpp"

#include <gtest/gtest.h>

namespace quadloop::io {
namespace {

TEST(DecimalComma, IsTheOnlyOneOfANumber) {
  EXPECT_EQ(decimal_comma_in("0,5"), "0,5: a decimal comma; write 0.5");
  EXPECT_EQ(decimal_comma_in("-1,25e-3"), "-1,25e-3: a decimal comma; write -1.25e-3");
  EXPECT_EQ(decimal_comma_in("+1,5D2"), "+1,5D2: a decimal comma; write +1.5D2");
  for (const char* word : {"", "0.5", "1,", ",5", "1,2,3", "1.5,2", "a,b", "1,2x", "5"})
    EXPECT_EQ(decimal_comma_in(word), "") << word;
}

}  // namespace
}  // namespace quadloop::io
