// What options a flow is not solved with, and what is said of them.
#include "flow/euler/model/euler_options.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "mesher/base/error.hpp"

namespace quadloop::flow {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity(),
                 nothing = std::numeric_limits<double>::quiet_NaN();

/// What is said of the options once `spoil` has had them, after "the flow solver's "; nothing where they are
/// good.
template <class Spoil>
std::string said_of(const Spoil& spoil) {
  EulerOptions options;
  spoil(options);
  try {
    validate(options);
  } catch (const InputError& error) {
    return std::string(error.what()).substr(std::string("the flow solver's ").size());
  }
  return "";
}

TEST(EulerOptions, AreGoodAsTheyAre) {
  EXPECT_EQ(said_of([](EulerOptions&) {}), "");
}

TEST(EulerOptions, AreRefusedByNameAndValue) {
  EXPECT_EQ(said_of([](EulerOptions& o) { o.gamma = 1; }), "gamma is 1, but must be above 1");
  EXPECT_EQ(said_of([](EulerOptions& o) { o.mach = -0.5; }), "mach is -0.5, but must be 0 or more");
  EXPECT_EQ(said_of([](EulerOptions& o) { o.cfl = 0; }), "cfl is 0, but must be above 0");
  EXPECT_EQ(said_of([](EulerOptions& o) { o.time_step = -1; }), "time_step is -1, but must be above 0");
}

TEST(EulerOptions, AreRefusedWhereTheyAreNotFinite) {
  EXPECT_EQ(said_of([](EulerOptions& o) { o.cfl = infinite; }), "cfl is inf, but must be finite, above 0");
  EXPECT_EQ(said_of([](EulerOptions& o) { o.alpha = nothing; }),
            "alpha is nan, but must be finite, a number of degrees");
}

TEST(EulerOptions, TakeMeansFromATimeBeforeTheEnd) {
  EXPECT_EQ(said_of([](EulerOptions& o) { o.end_time = o.average_from.emplace(2); }),
            "average_from is 2, but must be 0 or more and below end_time");
}

TEST(EulerOptions, CarryOnWhatMoves) {
  EXPECT_EQ(said_of([](EulerOptions& o) {
              o.mach = 0;
              o.unsteady = EulerOptions::Unsteady::continue_in_time;
            }),
            "mach is 0, but must be above 0 for a flow that is continued in time");
}

TEST(EulerOptions, NameTheBoundary) {
  EXPECT_EQ(said_of([](EulerOptions& o) {
              o.boundaries.emplace_back().name = "outlet";
              o.boundaries.back().pressure = 0;
            }),
            "pressure at 'outlet' is 0, but must be above 0");
}

}  // namespace
}  // namespace quadloop::flow
