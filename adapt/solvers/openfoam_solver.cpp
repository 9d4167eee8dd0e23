#include "adapt/solvers/openfoam_solver.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <utility>

#include "adapt/solvers/cycle_paths.hpp"
#include "adapt/solvers/openfoam_template.hpp"
#include "flow/command/solver_command.hpp"
#include "io/files/output_file.hpp"
#include "io/foam/foam_fields.hpp"
#include "io/foam/foam_file.hpp"
#include "io/stream/mesh_stream.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "mesher/mesh/scatter_mesh.hpp"

namespace quadloop::adapt {

namespace {

namespace fs = std::filesystem;

constexpr const char* script_name = "openfoam.sh";
constexpr const char* allrun_name = "Allrun";
constexpr const char* done_name = "openfoam.done";

void write_text(const fs::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file << text;
  file.close();
  if (!file) throw OutputError(path.string() + ": cannot be written");
}

/// Decomposition in slices along x.
std::string decompose_dict(int ranks) {
  return fmt::format(
      "FoamFile\n{{\n    version 2.0;\n    format ascii;\n    class dictionary;\n    object "
      "decomposeParDict;\n"
      "}}\n\nnumberOfSubdomains {0};\nmethod simple;\nsimpleCoeffs\n{{\n    n ({0} 1 1);\n    delta "
      "0.001;\n}}\n",
      ranks);
}

/// Debian's package needs only this variable; elsewhere the user has set up OpenFOAM's environment.
constexpr const char* script_head =
    "#!/bin/sh\n"
    "# What this cycle runs, in the folder above its case; written by quadloop.\n"
    "set -e\n"
    "if [ -z \"$WM_PROJECT_DIR\" ] && [ -d /usr/share/openfoam ]; then\n"
    "  export WM_PROJECT_DIR=/usr/share/openfoam\n"
    "fi\n";

/// Runs the solver, first with controlDict.start if there is one.
constexpr const char* script_run =
    "if [ -f system/controlDict.start ]; then\n"
    "  mv system/controlDict system/controlDict.then\n"
    "  cp system/controlDict.start system/controlDict\n"
    "  solve\n"
    "  mv system/controlDict.then system/controlDict\n"
    "fi\n"
    "solve\n";

std::string script(const std::string& application, int ranks) {
  std::string text = std::string(script_head) + "cd " + OpenfoamSolver::folder_name + "\n";
  if (application == allrun_name) {
    text += fmt::format("./Allrun {}\n", ranks);
  } else if (ranks == 1) {
    text += fmt::format("solve() {{ {}; }}\n{}", application, script_run);
  } else {
    text += fmt::format(
        "solve() {{ mpirun -n {} {} -parallel; }}\ndecomposePar\n{}"
        "reconstructPar -latestTime\n",
        ranks, application, script_run);
  }
  return text + "cd ..\necho done > " + done_name + "\n";
}

/// Copies the case to the cycle's files and returns its application. On the root only.
std::string make_case(const OpenfoamSolver& solver, const fs::path& folder, int ranks,
                      const CellValues& start) {
  const OpenfoamTemplate given = read_openfoam_template(solver.case_template);
  const fs::path own = folder / OpenfoamSolver::folder_name;
  fs::remove_all(own);
  copy_openfoam_template(solver.case_template, given, own);
  if (!fs::exists(own / "0") && fs::exists(own / "0.orig")) fs::rename(own / "0.orig", own / "0");
  for (const char* const part : {"0", "constant"}) fs::create_directories(own / part);
  if (start.width() > 0) io::set_foam_fields((own / "0").string(), start);
  if (ranks > 1 && !fs::exists(own / "system/decomposeParDict"))
    write_text(own / "system/decomposeParDict", decompose_dict(ranks));
  write_text(folder / script_name, script(given.application, ranks));
  return given.application;
}

MeshOrder order_of(const Communicator& comm, const MeshCounts& counts) {
  MeshOrder order;
  if (!comm.is_root()) return order;
  order.triangles.resize(counts.triangles);
  order.quads.resize(counts.quads);
  std::iota(order.triangles.begin(), order.triangles.end(), 0);
  std::iota(order.quads.begin(), order.quads.end(), 0);
  return order;
}

/// Reads the solver's last time step and distributes it. *Collective.*
Field read_time_step(const Communicator& comm, const Mesh& mesh, const MeshCounts& counts,
                     const flow::SolverCommand& command, const flow::SolverFiles& files) {
  Field whole;
  comm.together([&] {
    if (!comm.is_root()) return;
    try {
      const std::string own = (fs::path(files.folder) / OpenfoamSolver::folder_name).string();
      const std::string time = io::latest_foam_time(own);
      if (time.empty()) throw InputError(own + ": has no time folder above 0");
      const std::size_t cells = counts.triangles + counts.quads;
      whole.cells = io::read_foam_fields(time, cells);
      io::put_wall_values(time, own + "/constant/polyMesh", whole.cells);
      if (whole.cells.names.empty()) throw InputError(time + ": contains no cell field");
    } catch (const InputError& fault) {
      throw SolverError(flow::solver_message(command, files,
                                             std::string("left no solution for its mesh: ") + fault.what()));
    }
  });
  return scatter_field(comm, whole, mesh, order_of(comm, counts));
}

/// *Collective.*
void write_mesh_of(const Communicator& comm, const Mesh& mesh, const std::string& folder) {
  io::OutputSet outputs(comm);
  const io::ExtrudedMesh one_thick =
      io::extruded(mesh, io::even_heights(1, 1), io::ExtrusionAxis::z, nullptr);
  io::write_foam(outputs, io::MeshStream(comm, one_thick),
                 folder + "/" + OpenfoamSolver::folder_name + "/constant/polyMesh");
  outputs.commit();
}

}  // namespace

flow::FlowSolver openfoam_solver(OpenfoamSolver solver, std::function<std::string(int cycle)> folder_of) {
  return [solver = std::move(solver), folder_of = std::move(folder_of)](
             const Communicator& comm, const Mesh& mesh, const Field& start, int cycle) {
    flow::SolverFiles files;
    files.folder = fs::absolute(folder_of(cycle)).string();
    files.mesh = (fs::path(files.folder) / OpenfoamSolver::folder_name).string();
    files.solution = (fs::path(files.folder) / done_name).string();
    files.ranks = solver.ranks > 0 ? solver.ranks : comm.size();
    files.cycle = cycle;
    const MeshCounts counts = count(comm, mesh);
    const Field whole = gather_field(comm, {{}, {}, {}, start.cells}, mesh, order_of(comm, counts));
    flow::SolverCommand command{{"/bin/sh", script_name}, solver.timeout};
    comm.together([&] {
      if (comm.is_root()) command.name = make_case(solver, files.folder, files.ranks, whole.cells);
    });
    write_mesh_of(comm, mesh, files.folder);
    flow::run_solver(comm, command, files);
    flow::SolvedFlow flow;
    flow.solution = read_time_step(comm, mesh, counts, command, files);
    return flow;
  };
}

}  // namespace quadloop::adapt
