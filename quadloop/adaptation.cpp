#include <optional>
#include <utility>

#include "adapt/loop/run_in_folder.hpp"
#include "mesher/base/log.hpp"
#include "quadloop/case/adaptive_input.hpp"
#include "quadloop/case_parts.hpp"
#include "quadloop/quadloop.hpp"
#include "quadloop/require_input.hpp"

namespace quadloop {

namespace {

/// Keeps the record of a cycle.
struct LastRecord final : adapt::CycleObserver {
  void finished(adapt::CycleRecord record, const std::vector<std::string>& /*notes*/,
                const std::vector<std::string>& warnings) override {
    report = report_of(record, warnings);
  }
  static CycleReport report_of(const adapt::CycleRecord& record, const std::vector<std::string>& warnings) {
    return {record.cycle, adapt::statistics_of(record).text(), warnings};
  }
  CycleReport report;
};

/// The case for the loop. On the calling rank only.
AdaptiveInput input_for(const Case& of, const AdaptationOptions& options) {
  const bool by_caller = options.solving == Solving::by_caller;
  AdaptiveInput input = adaptive_input(of.parts().input, of.parts().arguments,
                                       by_caller ? SolvedBy::caller : SolvedBy::solver_of_case);
  if (by_caller && input.adaptive.adapt.passes > 0)
    throw InputError(
        path_of(of) +
        ": 'adapt.passes' needs the built-in solver; remove it, or let the solver of the case run");
  if (!by_caller && options.folder.empty() && adapt::is_external(input.adaptive.solver))
    throw InputError(
        path_of(of) +
        ": the solver of the case is a program that reads and writes files; give a folder for them");
  return input;
}

}  // namespace

struct Adaptation::Parts {
  Parts(const Communicator& comm_of_run, const Case& of, AdaptationOptions options_of_run)
      : comm{comm_of_run}, options{std::move(options_of_run)} {
    std::string note;
    comm.together([&] {
      AdaptiveInput input = input_for(of, options);
      note = std::move(input.note);
      adaptive = std::move(input.adaptive);
    });
    if (comm.is_root() && !note.empty()) log::information(note);
    if (options.folder.empty()) {
      alone.emplace(comm, adaptive->mesh, adaptive->adapt, record, adapt::start_in_memory(comm, *adaptive));
      return;
    }
    adapt::RunReport report;
    report.warning = [this](const std::string& warning) { early_warnings.push_back(warning); };
    report.cycle = [this](const adapt::CycleRecord& of_cycle, const std::vector<std::string>& warnings) {
      record.report = LastRecord::report_of(of_cycle, warnings);
    };
    in_folder.emplace(comm, *adaptive, options.folder, options.resume, report);
  }

  ~Parts() {
    if (in_folder && !has_failed) in_folder->discard_unfinished();
  }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  adapt::AdaptiveLoop& loop() { return in_folder ? in_folder->loop() : *alone; }

  flow::FlowSolver solver() const {
    if (options.solving == Solving::by_caller)
      throw InputError(
          "solve() is for Solving::by_solver_of_case; call your solver, and give its solution to "
          "finish_cycle()");
    return in_folder ? in_folder->solver() : adapt::solver_in_memory(*adaptive);
  }

  /// Runs work that reports its stages, and notes failures. *Collective.*
  template <class Work>
  auto watched(const Work& work) {
    const progress::Observed observed(comm, observer_of(options.progress, [this] { return loop().cycle(); }));
    try {
      return work();
    } catch (const Cancelled&) {
      throw;
    } catch (...) {
      has_failed = true;
      throw;
    }
  }

  const Communicator& comm;
  AdaptationOptions options;
  std::optional<adapt::AdaptiveCase> adaptive;
  LastRecord record;
  std::vector<std::string> early_warnings;  ///< before the first cycle
  std::optional<adapt::AdaptiveLoop> alone;
  std::optional<adapt::FolderRun> in_folder;
  bool has_failed = false;  ///< by an error other than Cancelled, the files of which are kept
};

Adaptation::Adaptation(const Communicator& comm, const Case& of, AdaptationOptions options)
    : parts_{std::make_unique<Parts>(comm, of, std::move(options))} {
  parts_->loop().transfer_by(parts_->options.transfer);
}

Adaptation::~Adaptation() = default;

bool Adaptation::begin_cycle() {
  return parts_->watched([&] { return parts_->loop().begin_cycle(); });
}

int Adaptation::cycle() const { return parts_->loop().cycle(); }

std::shared_ptr<const SolvedMesh> Adaptation::solved() const {
  const adapt::AdaptiveLoop& loop = parts_->loop();
  const std::shared_ptr<const adapt::CycleEnd> end = loop.under_way() ? loop.under_way() : loop.end().left;
  return end ? std::shared_ptr<const SolvedMesh>(end, &end->solved) : nullptr;
}

const Field& Adaptation::initial_state() const { return parts_->loop().initial_state(); }

const TransferReport& Adaptation::transferred() const { return parts_->loop().remeshed().report; }

const LayerReport& Adaptation::layers() const { return parts_->loop().remeshed().generated.layers; }

SolvedFlow Adaptation::solve() {
  return parts_->watched(
      [&] { return parts_->solver()(parts_->comm, solved()->mesh, initial_state(), cycle()); });
}

CycleReport Adaptation::finish_cycle(SolvedFlow flow) {
  return parts_->watched([&] {
    const std::shared_ptr<const SolvedMesh> solved_mesh = solved();
    require_rows(parts_->comm, solved_mesh->mesh, flow.solution);
    parts_->loop().finish_cycle(std::move(flow));
    CycleReport report = parts_->record.report;
    const std::vector<std::string> early = std::exchange(parts_->early_warnings, {});
    report.warnings.insert(report.warnings.begin(), early.begin(), early.end());
    return report;
  });
}

}  // namespace quadloop
