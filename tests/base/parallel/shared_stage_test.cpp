// Stages that an observer sees, and that it cancels.
#include "mesher/base/parallel/shared_stage.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

using Seen = std::vector<std::pair<std::string, double>>;

progress::Observer into(Seen& seen) {
  return [&](const std::string& stage, double share) { seen.emplace_back(stage, share); };
}

TEST(Progress, AnObserverSeesTheStagesOfItsCommunicator) {
  Seen seen;
  {
    const progress::Observed observed(world(), into(seen));
    progress::SharedStage stage(world(), "outer", 4);
    stage.advance(1);  // of this rank alone
    const progress::Stage alone("alone");
    const Communicator other(world().raw());
    const progress::SharedStage of_other(other, "of another communicator");
    stage.advance_together(2);
    stage.advance_together(8);
  }
  const progress::SharedStage after(world(), "after");
  EXPECT_EQ(seen, (Seen{{"outer", 0}, {"outer", 0.5}, {"outer", 1}}));
}

TEST(Progress, TheInnerObserverCounts) {
  Seen outer, inner;
  const progress::Observed observed(world(), into(outer));
  {
    const progress::Observed nested(world(), into(inner));
    const progress::SharedStage stage(world(), "a");
  }
  const progress::SharedStage stage(world(), "b");
  EXPECT_EQ(inner, (Seen{{"a", 0}}));
  EXPECT_EQ(outer, (Seen{{"b", 0}}));
}

TEST(Progress, OneRankCancelsForAll) {
  progress::Observer observer;  // on the last rank alone
  if (world().rank() == world().size() - 1)
    observer = [](const std::string& stage, double share) {
      if (stage == "b" && share > 0) throw std::runtime_error("enough");
    };
  const progress::Observed observed(world(), observer);
  std::string message;
  try {
    const progress::SharedStage a(world(), "a");
    progress::SharedStage b(world(), "b", 2);
    b.advance_together(1);
    ADD_FAILURE() << "not cancelled";
  } catch (const progress::Cancelled& error) {
    message = error.what();
  }
  EXPECT_EQ(message, "cancelled in stage 'b': enough");
  EXPECT_EQ(progress::SharedStage::current(), nullptr);
}

}  // namespace
}  // namespace quadloop
