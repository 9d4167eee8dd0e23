#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "adapt/morph/morph_report.hpp"
#include "adapt/remesh/demands/solved_mesh.hpp"
#include "adapt/transfer/transfer_by.hpp"
#include "adapt/transfer/transfer_map.hpp"
#include "flow/flow_solver.hpp"
#include "io/input/case_source.hpp"
#include "io/input/geometry_line.hpp"
#include "io/model/extruded_mesh.hpp"
#include "io/plot/plot_options.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/log.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/base/parallel/reproducible_sum.hpp"
#include "mesher/base/parallel/shared_stage.hpp"
#include "mesher/layers/boundary_layer_report.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/halo_mesh.hpp"
#include "mesher/mesh/mesh.hpp"

/// quadloop as a library: the public interface is this header and the headers that it includes.
///
/// Life cycle: MPI must be initialised before the first Communicator is constructed and finalised after the
/// last is destroyed. Every function here is *collective* over the communicator that it is given: all its
/// ranks call it, in the same order, with the same case. Meshes and fields are distributed over the ranks;
/// results are bitwise independent of the number of ranks. Only write(), write_solved(), extrude(), plot()
/// and an Adaptation with a folder write files.
///
/// Shapes and units: a Mesh holds one rank's partition (mesh.hpp); a Field stores nodal values for owned
/// nodes and, optionally, cell values, in the mesh's order, with the same names on all ranks. Lengths are in
/// the unit of the case's geometry. Values are in solver units; sense() and remesh() require finite values.
///
/// For parallel solvers, HaloMesh provides all cells adjacent to the owned nodes. Loop over all of them with
/// halo.for_each_cell(), but add contributions to owned nodes only. The cells are visited in global order, so
/// the sums do not depend on the partition. Then halo.exchange().update(values) copies the values of the
/// owners to the ghosts (update_rows() for several variables). Ghost contributions are never summed at the
/// owner, because that sum would depend on the partition. reproducible_sum() sums over all ranks.
///
/// Errors are exceptions derived from Error, the same on all ranks. InputError: a case, mesh or field cannot
/// be used. SolverError: the solver failed. OutputError: a file cannot be written. The message gives location
/// and remedy. Fault is an internal error. Other exceptions are documented at the function. User code that
/// may fail on a single rank must run inside comm.together(), which raises the error on all ranks.
///
/// Warnings are returned, the same on all ranks. Log lines go to stderr, warnings only, unless
/// log::configure() or log::send_to() says otherwise.
///
///     const Communicator comm(MPI_COMM_WORLD);
///     const Case wing(comm, "wing.toml");
///     SolvedMesh now = make_mesh(comm, wing).solved;
///     now.solution = my_solver(comm, now.mesh, now.solution, 0).solution;
///     now = remesh(comm, wing, sense(comm, wing, now), now).solved;
namespace quadloop {

using adapt::MorphReport, adapt::SolvedMesh;
using adapt::TransferFunction, adapt::TransferMap, adapt::TransferReport;
using flow::BoundaryForce, flow::FlowSolver, flow::GoalValue, flow::SolvedFlow;
using io::CaseSource, io::ExtrusionAxis, io::GeometryLine;
using io::PlotFormat, io::PlotOptions;
using progress::Cancelled;

struct CaseParts;
namespace adapt {
struct AdaptationPlan;
}

/// A case with its geometry: sizes, smoothing, adaptation, solver. Copies of the object share the data.
class Case {
 public:
  /// Reads a case file, or a case given as TOML text, on every rank, and its geometry files on the first one.
  /// Outlines need no file: [[shape]] tables hold their points. `assignments` override keys, e.g.
  /// "spacing.min=0.01". Throws InputError with file, line and key.
  Case(const Communicator& comm, const CaseSource& source, const std::vector<std::string>& assignments = {});

  const std::string& title() const;
  int cycles() const;  ///< adapt.cycles; 0 if the case has no adaptation
  /// Warnings about the case and the geometry.
  const std::vector<std::string>& warnings() const;

  const CaseParts& parts() const { return *parts_; }  ///< internal use only

 private:
  std::shared_ptr<const CaseParts> parts_;
};

/// A stage of a call, as it begins and as it advances.
struct Progress {
  std::string stage;  ///< e.g. "refinement", "cutting", "cells", "smoothing", "transfer", "solving"
  double share = 0;   ///< done, from 0 to 1; stays 0 if it is not known
  int cycle = -1;     ///< of an Adaptation; -1 in other calls
};

/// Called on each rank that has one, at the same stages on all ranks; returns false to cancel the call, on
/// one rank or on several. An exception also cancels it. Then all ranks throw Cancelled, with the message of
/// the exception, and files are complete or absent.
using ProgressCallback = std::function<bool(const Progress&)>;

/// A generated mesh with its solution.
struct NewMesh {
  SolvedMesh solved;           ///< transferred solution; empty for the initial mesh
  TransferReport transferred;  ///< conservation error of the transfer for each variable
  std::vector<std::string> warnings;
  LayerReport layers;  ///< of the boundaries and lines that have layers
};

/// Generates the initial mesh of the case, smoothed with the case's settings. Throws InputError, naming the
/// boundary, if the geometry cannot be meshed or the mesh would exceed free memory; Cancelled.
NewMesh make_mesh(const Communicator& comm, const Case& of, const ProgressCallback& progress = {});

/// Smooths a mesh with the case's settings; boundary nodes slide along the case's geometry. The mesh may be
/// any mesh of that geometry that is valid except for inverted cells. Connectivity is preserved, with one
/// exception: if the case generates triangles only and the mesh is Delaunay, edges are flipped so that it
/// remains Delaunay. (To find out whether it is, the mesh is gathered on one rank.) With quads = "parallel",
/// smoothing tries to keep parallelograms. make_mesh() then splits the quadrilaterals that are not
/// parallelograms into triangles; smooth() leaves them as they are. The nodes of layer cells do not move. The
/// quality of the worst cell does not decrease. Inverted cells are untangled as far as possible; check()
/// reports those that remain. Throws Cancelled; then the mesh may be partly smoothed.
void smooth(const Communicator& comm, const Case& of, Mesh& mesh, const ProgressCallback& progress = {});

/// Returns the built-in 2D Euler solver with the case's settings, for any mesh of the case's geometry.
/// The initial state and the solution have the variables density, x_velocity, y_velocity and pressure, in
/// units of the free-stream density and speed of sound. The solution also has entries in Field::constants, in
/// this order: steps, time, Mach number, angle of attack in degrees, CL, CD, residual. SolvedFlow has these
/// as numbers, the force on each wall, and for each functional of solver.goal a GoalValue: its value, error
/// and derivatives by angle of attack and Mach number. With solver.goal_adjoint = "write" the solution has
/// the derivatives of each functional by the node positions, e.g. drag_by_x and drag_by_y (without the change
/// of the other nodes), which Morph::pull_back() converts. Throws InputError if the case selects another
/// solver. The solver throws InputError for an initial state without these
/// variables, and SolverError, with the location, if the state becomes unphysical.
FlowSolver built_in_solver(const Communicator& comm, const Case& of);

/// Refinement decisions computed by sense(), valid only for the mesh passed to sense(). Copies of the object
/// share the data.
class RefinementFlags {
 public:
  std::int64_t refined() const;  ///< quadtree cells, over all ranks
  std::int64_t coarsened() const;
  const std::vector<std::string>& warnings() const;  ///< e.g. why no cell is refined, or limits not met
  /// Whether remesh() returns a different mesh. It does if any quadtree cell is refined or coarsened, or if
  /// the flags contain a metric, target sizes for the nodes or new first-layer heights.
  bool changes_mesh() const;

 private:
  RefinementFlags(const SolvedMesh& of, std::shared_ptr<const adapt::AdaptationPlan> plan);
  friend RefinementFlags sense(const Communicator& comm, const Case& of, const SolvedMesh& solved);
  friend NewMesh remesh(const Communicator& comm, const Case& of, const RefinementFlags& flags,
                        const SolvedMesh& before, const ProgressCallback& progress);

  std::uint64_t case_digest_, coordinate_digest_;  ///< digests of the mesh's tree
  std::shared_ptr<const adapt::AdaptationPlan> plan_;
};

/// Flags quadtree cells for refinement or coarsening by the case's table [adapt]. `solved` must be the result
/// of make_mesh() or remesh() for this case, with a solution. Throws InputError if the case has no such
/// table, or if the solution lacks the variable, lacks a row for an owned node, or has a value that is not
/// finite.
RefinementFlags sense(const Communicator& comm, const Case& of, const SolvedMesh& solved);

/// Returns the next mesh, smoothed, with all variables transferred from the previous mesh (transfer()).
/// `flags` must be the result of sense() for `before`; the nodes of `before` may have moved since. Throws
/// InputError as make_mesh() and sense() do, and if `flags` belongs to another mesh; Cancelled.
NewMesh remesh(const Communicator& comm, const Case& of, const RefinementFlags& flags,
               const SolvedMesh& before, const ProgressCallback& progress = {});

/// The results of one cycle of an Adaptation.
struct CycleReport {
  int cycle = 0;
  std::string record;  ///< a JSON object with the members of docs/reference/adaptive-run.md, without timings
  std::vector<std::string> warnings;
};

/// Who solves in an Adaptation.
enum class Solving {
  by_caller,         ///< whose solution is given to finish_cycle()
  by_solver_of_case  ///< the built-in one, SU2, OpenFOAM or another command: Adaptation::solve()
};

struct AdaptationOptions {
  /// Each cycle writes the files of `quadloop adapt` there; empty: no files.
  std::string folder = {};
  bool resume = false;  ///< continue after the last complete cycle in the folder
  Solving solving = Solving::by_caller;
  ProgressCallback progress = {};  ///< called in each member function that works
  /// Transfers the solutions instead of the transfer that the case chooses; TransferMap helps. An error on
  /// one rank must be thrown on all.
  TransferFunction transfer = {};
};

/// The adaptive loop of a case: cycles 0 to adapt.cycles, each on the mesh that the cycle before it planned,
/// from its transferred solution. Meshes and solutions have the same bits as those of the command `quadloop
/// adapt` with the same solver.
///
///     Adaptation run(comm, wing);
///     while (run.begin_cycle())
///       run.finish_cycle(my_solver(comm, run.solved()->mesh, run.initial_state(), run.cycle()));
class Adaptation {
 public:
  /// `comm` must outlive the object. Throws InputError, e.g. if the case has no table [adapt], if the folder
  /// belongs to another case, or if the solver of the case is another program and no folder is given;
  /// OutputError.
  Adaptation(const Communicator& comm, const Case& of, AdaptationOptions options = {});
  /// Removes the files of a cycle that was not finished, unless an error other than Cancelled stopped it.
  ~Adaptation();
  Adaptation(const Adaptation&) = delete;
  Adaptation& operator=(const Adaptation&) = delete;

  /// Generates the next mesh and the initial state on it. Returns false if the loop has ended: after
  /// adapt.cycles, if the mesh would not change, or as adapt.until says. Throws as make_mesh() does. After
  /// Cancelled, begin_cycle() repeats the cycle.
  bool begin_cycle();
  int cycle() const;  ///< the cycle under way, or the last one
  /// The mesh of this cycle, with the solution after finish_cycle(). Null before the first cycle. It does not
  /// change after finish_cycle(), and lives as long as the caller holds it.
  std::shared_ptr<const SolvedMesh> solved() const;
  /// The transferred solution; no variables in cycle 0. Valid until begin_cycle() is called again.
  const Field& initial_state() const;
  /// Its conservation error.
  const TransferReport& transferred() const;
  const LayerReport& layers() const;  ///< of the mesh under way
  /// Runs the solver of the case on the mesh under way. Throws InputError for Solving::by_caller,
  /// SolverError, Cancelled.
  SolvedFlow solve();
  /// Takes the solution, writes the files and plans the next mesh. Throws InputError if the solution lacks
  /// the variable of the sensor or is not finite; Cancelled.
  CycleReport finish_cycle(SolvedFlow flow);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// A geometry to which a mesh is morphed, or on which it was made. Copies of the object share the data.
class MorphGeometry {
 public:
  /// Lines through points. Open lines meet at their ends; without any line the geometry is not known.
  explicit MorphGeometry(std::vector<GeometryLine> lines = {});
  /// Reads a geometry file of any format. Throws InputError with the file and, for text formats, the line.
  MorphGeometry(const Communicator& comm, const std::string& path);

  std::vector<GeometryLine> lines() const;
  const std::vector<std::string>& warnings() const;  ///< e.g. what was left out, or ends that were joined

 private:
  friend class Morph;
  struct Parts;
  std::shared_ptr<const Parts> parts_;
};

/// The cells of a mesh cannot follow a change of its geometry.
class TooFar : public InputError {
 public:
  TooFar(const std::string& message, double possible_share) : InputError(message), share{possible_share} {}
  double share;  ///< of the change, up to which no cell is inverted, or worse than required
};

/// A mesh whose nodes have followed a change of its geometry; the cells are the same. The node positions are
/// differentiable functions of the points of the new geometry. The derivatives are exact, in both directions.
class Morph {
 public:
  /// Moves the nodes of the mesh. Boundaries that `to` lacks stay in place. If `from`, the geometry on which
  /// the mesh was made, is known and has as many points, nodes stay on their segments; otherwise they keep
  /// their relative arc length between corners. Meshes with inner lines or baffles, or with blocks that end
  /// on a boundary, need a `from` with the same lines, in the same order and with as many points. `comm` must
  /// outlive the object. Throws InputError for geometries that do not correspond, and if a node is not on
  /// `from`; TooFar if cells would become inverted, or if the quality of the worst cell would fall below
  /// `least_quality`, from 0 to 1.
  Morph(const Communicator& comm, Mesh mesh, const MorphGeometry& from, const MorphGeometry& to,
        double least_quality = 0);
  ~Morph();
  Morph(const Morph&) = delete;
  Morph& operator=(const Morph&) = delete;

  std::shared_ptr<const Mesh> mesh() const;
  const MorphReport& report() const;

  /// Velocity of each owned node for given velocities of the points of `to`: one list for each of its lines,
  /// the same on all ranks. Points that coincide count once, where they occur first. The first call of
  /// push_forward() or pull_back() prepares the derivatives, which takes as long as the morph and as much
  /// memory as the mesh. Throws InputError for lists of other lengths, if cells had to be smoothed, without a
  /// `from` with as many points, and for meshes that need the lines of `from`.
  std::vector<Point> push_forward(const std::vector<std::vector<Point>>& of_points) const;
  /// The transpose: from the gradient of a functional with respect to each owned node to that with respect to
  /// the points of `to`, the same on all ranks and any number of them. Throws as push_forward() does.
  std::vector<std::vector<Point>> pull_back(std::span<const Point> of_nodes) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Returns one line per error, with its location; empty for a valid mesh. The lines are the same on every
/// rank. The mesh is gathered on one rank only if it is not certainly valid, or has several blocks or inner
/// lines.
std::vector<std::string> check(const Communicator& comm, const Mesh& mesh);

/// A mesh read from a file, with its blocks and inner lines. Numbers of nodes and cells are those of the file
/// if neighbours are close in it, as in meshes of this library; otherwise they follow a space-filling curve.
struct MeshFile {
  Mesh mesh;
  Field field;  ///< no variables if the file has none
  std::vector<std::string> warnings;
};

/// Reads a mesh and its nodal field; the suffix selects the format: .mesh, .cgns, .vtu, .su2, .msh. All ranks
/// read .mesh and .qmesh files, each its share; the root reads those of other formats whole. CGNS files are
/// read by a separate program, quadloop-reader (see docs/how-to/library.md), which must be installed. Throws
/// InputError with the file and, for text formats, the line.
MeshFile read(const Communicator& comm, const std::string& path);

/// Writes a mesh and, if the format supports it, the field; the suffix selects the format. The file is
/// written atomically: complete or not at all. The bytes are the same on any number of ranks. Returns
/// warnings, the same on all ranks: data the format cannot store (solution, constants, boundary conditions,
/// number of layers), and names it cannot represent. Throws InputError for a suffix that read() does not
/// support, or a field without a row for each owned node; OutputError if the file cannot be written.
std::vector<std::string> write(const Communicator& comm, const Mesh& mesh, const std::string& path,
                               const Field& field = {});

/// Writes the 3D mesh of prisms and hexahedra between levels at these heights, two or more, ascending, with
/// the solution on each level. The suffix selects the format: .cgns, .vtu, .su2, .msh, .b8.ugrid, .fluent.msh
/// or polyMesh (a folder). The 3D mesh is never stored. Returns warnings as write() does; throws as write()
/// does, and InputError for other heights.
std::vector<std::string> extrude(const Communicator& comm, Mesh mesh, const std::vector<double>& heights,
                                 const std::string& path, const Field& solution = {},
                                 ExtrusionAxis axis = ExtrusionAxis::z);

/// Returns a picture of a mesh, or of the variable options.field of the solution, as the bytes of a file: on
/// the root rank, which gets the cells one after another; none on other ranks. "mach" and
/// "pressure_coefficient" are computed from a flow that lacks them. Throws InputError for a variable that
/// does not exist, or a window without cells.
std::string picture(const Communicator& comm, Mesh mesh, Field solution = {}, const PlotOptions& options = {},
                    PlotFormat format = PlotFormat::png);

/// Writes such a picture; the suffix selects the format: .png, .svg or .pdf. Throws OutputError, too.
void plot(const Communicator& comm, Mesh mesh, const std::string& path, Field solution = {},
          const PlotOptions& options = {});

/// Writes a mesh returned by make_mesh() or remesh(), its tree and its solution to `stem`.mesh and
/// `stem`.tree.h5, both or neither. Throws as write() does.
void write_solved(const Communicator& comm, const SolvedMesh& solved, const std::string& stem);

/// Reads files written by write_solved(), on any number of ranks, and restores the data bit for bit, so that
/// an interrupted adaptation continues with identical results. The tree file is read by the separate program
/// quadloop-reader, as CGNS files are by read(). Throws InputError if the files do not belong together, or
/// are not of this case.
SolvedMesh read_solved(const Communicator& comm, const Case& of, const std::string& stem);

}  // namespace quadloop
