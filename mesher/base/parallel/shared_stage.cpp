#include "mesher/base/parallel/shared_stage.hpp"

#include <algorithm>
#include <utility>

namespace quadloop::progress {

namespace {

/// What a thread works on.
struct SharedWork {
  SharedStage* stage = nullptr;
  const Observed* observed = nullptr;
};

SharedWork& shared_work() {
  static thread_local SharedWork of_thread;
  return of_thread;
}

}  // namespace

Observed::Observed(const Communicator& comm, Observer observer)
    : comm_{comm},
      observer_{std::move(observer)},
      active_{comm.any(observer_ != nullptr)},
      outer_{std::exchange(shared_work().observed, this)} {}

Observed::~Observed() { shared_work().observed = outer_; }

void Observed::report(const Communicator& comm, const char* stage, double share) const {
  if (!active_ || &comm != &comm_) return;
  try {
    comm.together([&] {
      if (observer_) observer_(stage, share);
    });
  } catch (const std::exception& reason) {  // the same on all ranks
    throw Cancelled(std::string("cancelled in stage '") + stage + "': " + reason.what());
  }
}

SharedStage::SharedStage(const Communicator& comm, const char* name, double total, const char* unit)
    : comm_{comm}, name_{name}, total_{total}, stage_{name, total, unit}, outer_{shared_work().stage} {
  report(0);
  shared_work().stage = this;
}

SharedStage::~SharedStage() { shared_work().stage = outer_; }

void SharedStage::advance_together(double done) {
  advance(done);
  report(total_ > 0 ? std::min(done / total_, 1.0) : 0);
}

SharedStage* SharedStage::current() { return shared_work().stage; }

void SharedStage::report(double share) const {
  if (const Observed* observed = shared_work().observed) observed->report(comm_, name_, share);
}

}  // namespace quadloop::progress
