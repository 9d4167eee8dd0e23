#include "mesher/base/stage_mark.hpp"

#include <mpi.h>

namespace quadloop {

namespace {

constexpr int begin_level = 1, end_level = -1;

void mark(int level, const std::string& stage) {
  int has_begun = 0;
  MPI_Initialized(&has_begun);
  if (has_begun != 0) MPI_Pcontrol(level, stage.c_str());
}

}  // namespace

void mark_stage_begin(const std::string& stage) { mark(begin_level, stage); }
void mark_stage_end(const std::string& stage) { mark(end_level, stage); }

}  // namespace quadloop
