#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "adapt/remesh/demands/solved_mesh.hpp"
#include "adapt/transfer/transfer.hpp"
#include "flow/flow_solver.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/log.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/base/parallel/reproducible_sum.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/halo_mesh.hpp"
#include "mesher/mesh/mesh.hpp"

/// quadloop as a library: this header and those that it names are its whole interface.
///
/// Life cycle: MPI is begun before the first Communicator and ended after the last one is gone. Every
/// function here is *collective* over the communicator that it is given: all its ranks call it, in the same
/// order, with the same case. Meshes and fields are spread over the ranks, and their bits do not depend on
/// how many there are. Nothing is written to disk but by write() and write_solved().
///
/// Shapes and units: a Mesh is one rank's part, as mesh.hpp says; a Field has a row of values for each node
/// that the rank owns, and for each of its cells, in the mesh's order, with the same names on all ranks.
/// Lengths are in the unit of the case's geometry. Values are the solver's own; sense() and remesh() want
/// them finite.
///
/// A parallel solver of one's own has in HaloMesh all cells round its nodes, and in halo.exchange() what
/// brings owners' values to copies. There is no way that adds up copies at their owners: floating-point sums
/// would depend on the ranks. A rank adds up, for its owned nodes alone, over halo.for_each_cell(), which
/// goes by the global order of cells; reproducible_sum() adds up over all ranks.
///
/// Errors are exceptions derived from Error, the same on all ranks: InputError for a case, mesh or field that
/// cannot be used, SolverError, OutputError; their text names the place and the cure. Fault is a mistake of
/// this library's. What else a function throws stands with it. Code of a user's own that may fail on one rank
/// alone runs inside comm.together(), so that its error too is the same on all.
///
/// Warnings are returned, the same on all ranks. Nothing is printed unless log::configure() asks for it.
///
///     const Communicator comm(MPI_COMM_WORLD);
///     const Case wing(comm, "wing.toml");
///     SolvedMesh now = make_mesh(comm, wing).solved;
///     now.solution = my_solver(comm, now.mesh, now.solution, 0).solution;
///     now = remesh(comm, wing, sense(comm, wing, now), now).solved;
namespace quadloop {

struct CaseParts;
struct AdaptationPlan;

/// A case file with its geometry in place: sizes, smoothing, what to adapt to, the solver. Copies share it.
class Case {
 public:
  /// Reads the file on every rank. `assignments` take the place of keys in it, as in "spacing.min=0.01".
  /// Throws InputError with file, line and key.
  Case(const Communicator& comm, const std::string& path, const std::vector<std::string>& assignments = {});

  const std::string& title() const;
  int cycles() const;  ///< adapt.cycles; 0 where the case does not adapt
  /// What the user is to be told of case and geometry.
  const std::vector<std::string>& warnings() const;

  const CaseParts& parts() const { return *parts_; }  ///< for this library alone

 private:
  std::shared_ptr<const CaseParts> parts_;
};

/// A mesh that was made, and how.
struct NewMesh {
  SolvedMesh solved;       ///< the solution without variables in a first mesh, else carried over
  TransferReport carried;  ///< what carrying over did to each variable
  std::vector<std::string> warnings;
};

/// The case's first mesh, smoothed as the case says. Throws InputError, naming the boundary, where the
/// geometry cannot be meshed, or would have more cells than free memory holds.
NewMesh make_mesh(const Communicator& comm, const Case& of);

/// Moves the nodes of a mesh for better cells, as the case says; boundary nodes slide along its geometry. Any
/// valid mesh of that geometry will do. Its cells stay as they are, but where the case is of the Delaunay
/// type and the mesh too: flips then make it so again (and one rank holds the whole for a while, to tell).
/// With quads = "parallel" parallelograms are spared; those that become skew are not divided, as make_mesh()
/// does. Layers at walls, of boundaries with a number of them, stay to the last bit. Never makes the worst
/// cell worse. Of inverted cells as many are mended as can be: check() tells.
void smooth(const Communicator& comm, const Case& of, Mesh& mesh);

/// The built-in solver of the two-dimensional Euler equations with the case's settings, for any mesh of its
/// geometry. It starts from and gives density, x_velocity, y_velocity and pressure, in units of the free
/// stream's density and speed of sound; constants: steps, time, Mach number, angle of attack in degrees, CL,
/// CD, residual. Throws InputError where the case chooses a solver of its own; the solver throws it for a
/// start without these variables, and SolverError, with the place, where the flow cannot be kept physical.
FlowSolver built_in_solver(const Communicator& comm, const Case& of);

/// What a solution asks of the next mesh: sense() makes it, for one mesh alone. Copies share it.
class Marks {
 public:
  std::int64_t refined() const;  ///< leaves, of all ranks
  std::int64_t coarsened() const;
  const std::vector<std::string>& warnings() const;  ///< why nothing is marked, what was not reached
  /// Whether remesh() makes a mesh that differs from the last one: by refined or coarsened leaves, a metric,
  /// targets of nodes, or new first heights of layers.
  bool changes_mesh() const;

 private:
  Marks(const SolvedMesh& of, std::shared_ptr<const AdaptationPlan> plan);
  friend Marks sense(const Communicator& comm, const Case& of, const SolvedMesh& solved);
  friend NewMesh remesh(const Communicator& comm, const Case& of, const Marks& marks,
                        const SolvedMesh& before);

  std::uint64_t case_digest_, coordinate_digest_;  ///< of the tree of the mesh that it is for
  std::shared_ptr<const AdaptationPlan> plan_;
};

/// Marks leaves by the case's table [adapt], from the solution. `solved` is what make_mesh() or remesh() made
/// of this case, with a solution. Throws InputError where the case has no such table, or the solution no such
/// variable, not a row for each owned node, or a value that is not finite.
Marks sense(const Communicator& comm, const Case& of, const SolvedMesh& solved);

/// The next mesh, smoothed, with the solution of the one before carried over to it: all its variables, as
/// transfer() does. `marks` are those of sense() for `before`, whose nodes may have moved since. Throws
/// InputError as make_mesh() and sense() do, and for marks of another mesh.
NewMesh remesh(const Communicator& comm, const Case& of, const Marks& marks, const SolvedMesh& before);

/// What is wrong with a mesh: one line for each fault, with its place; none where it is valid. Gathers the
/// mesh on one rank. The same lines on every rank.
std::vector<std::string> check(const Communicator& comm, const Mesh& mesh);

/// A mesh as a file had it, its blocks made one. Spread along a space-filling curve: its nodes and cells
/// stand in another order than in the file.
struct MeshFile {
  Mesh mesh;
  Field field;  ///< without variables where the file has none
  std::vector<std::string> warnings;
};

/// Reads a mesh, and the field at its nodes, in the format that the suffix tells: .mesh, .cgns, .vtu, .su2,
/// .msh. The first rank reads it whole; .cgns by the installed program quadloop-reader. Throws InputError with
/// the file and, in text, the line.
MeshFile read(const Communicator& comm, const std::string& path);

/// Writes a mesh, with the field where the format has a place for one, as the suffix tells; the file appears
/// whole or not at all. The same bytes on any number of ranks. Returns warnings, the same on all ranks: what
/// the format has no place for (solution, constants, boundary conditions, the number of layers), and names
/// that it cannot hold.
/// Throws InputError for a suffix that read() does not know, or a field without a row for each owned node;
/// OutputError where the file cannot be written.
std::vector<std::string> write(const Communicator& comm, const Mesh& mesh, const std::string& path,
                               const Field& field = {});

/// Keeps a mesh that make_mesh() or remesh() made, with its tree and solution, as `stem`.mesh and
/// `stem`.tree.h5: both appear or none. Throws as write() does.
void write_solved(const Communicator& comm, const SolvedMesh& solved, const std::string& stem);

/// The way back, to the last bit, on any number of ranks, so that an adaptation goes on as if it had not been
/// interrupted. The tree is read as read() reads .cgns. Throws InputError where they do
/// not belong to each other, or are not of this case.
SolvedMesh read_solved(const Communicator& comm, const Case& of, const std::string& stem);

}  // namespace quadloop
