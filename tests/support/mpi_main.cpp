// The main of every test program. It runs alone or under mpirun: rank 0 tells the story, the others speak up
// only where something fails, and a failure on any rank fails the program on all.

#include <gtest/gtest.h>
#include <mpi.h>

#include <cstdio>

#include "tests/support/world.hpp"

namespace {

class FailurePrinter : public testing::EmptyTestEventListener {
 public:
  explicit FailurePrinter(int rank) : rank_{rank} {}

 private:
  void OnTestStart(const testing::TestInfo& info) override { test_ = &info; }

  void OnTestPartResult(const testing::TestPartResult& result) override {
    if (!result.failed()) return;
    const char* file = result.file_name() == nullptr ? "unknown file" : result.file_name();
    std::fprintf(stderr, "rank %d: %s.%s: %s:%d: %s\n", rank_,
                 test_ == nullptr ? "-" : test_->test_suite_name(), test_ == nullptr ? "-" : test_->name(),
                 file, result.line_number(), result.message());
  }

  int rank_;
  const testing::TestInfo* test_ = nullptr;
};

void let_only_the_root_print(int rank) {
  if (rank == 0) return;
  testing::TestEventListeners& listeners = testing::UnitTest::GetInstance()->listeners();
  delete listeners.Release(listeners.default_result_printer());
  delete listeners.Release(listeners.default_xml_generator());
  listeners.Append(new FailurePrinter{rank});
}

int worst_of_all_ranks(int status) {
  int worst = status;
  MPI_Allreduce(&status, &worst, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  return worst;
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  testing::InitGoogleTest(&argc, argv);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  let_only_the_root_print(rank);
  const bool no_test = testing::UnitTest::GetInstance()->total_test_count() == 0;
  if (no_test && rank == 0) std::fprintf(stderr, "this program holds no test\n");
  const int status = worst_of_all_ranks(RUN_ALL_TESTS() != 0 || no_test ? 1 : 0);
  quadloop::test::forget_world();
  MPI_Finalize();
  return status;
}
