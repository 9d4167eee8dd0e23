"""Three ranks: parts of the mesh, errors on one rank, wrong solutions on one rank."""
import numpy as np
from mpi4py import MPI

import quadloop as ql

comm = MPI.COMM_WORLD
CASE = ql.Case(outlines={"edge": [[0, 0], [1, 0], [1, 1], [0, 1]]}, spacing={"max": 0.05}, adapt={"cycles": 2, "variable": "u", "norm": 2, "max_nodes": 5000, "min": 0.005})


def raised(kind, work):
    try:
        work()
    except kind as error:
        return str(error)
    raise AssertionError(f"no {kind} on rank {comm.rank}")


def test_parts():
    whole, part = ql.mesh(CASE), ql.mesh(CASE, comm=comm)
    assert comm.allreduce(part.owned) == whole.owned == part.nodes
    assert comm.allreduce(len(part.quads)) == len(whole.quads)
    np.testing.assert_array_equal(part.points, whole.points[part.global_ids])
    gathered = part.gathered()
    if comm.rank == 0:
        np.testing.assert_array_equal(gathered.points, whole.points)
        np.testing.assert_array_equal(gathered.quads, whole.quads)
    else:
        assert gathered.owned == 0


def test_an_error_on_one_rank_is_raised_on_all():
    def solve(mesh, start):
        if comm.rank == 1:
            raise KeyError("lost")
        return {"u": mesh.points[:mesh.owned, 0]}
    message = raised(KeyError if comm.rank == 1 else ql.SolverError, lambda: next(ql.adapt(CASE, solve, comm=comm)))
    assert "lost" in message, message


def test_a_wrong_solution_on_one_rank_is_refused_on_all():
    message = raised(ql.InputError, lambda: next(ql.adapt(CASE, lambda mesh, start: {"u": np.zeros(mesh.owned + (5 if comm.rank == 2 else 0))}, comm=comm)))
    assert "values" in message, message


def test_what_differs_between_ranks_is_refused_on_all():
    def values(mesh, start, given):
        u = np.zeros(mesh.owned)
        return given if comm.rank == 1 else {"u": u}
    for given in (None, 3, {"v": 1}, {"u": "x"}, {"my u": np.zeros(3)}):
        raised((ql.InputError, ql.SolverError), lambda: next(ql.adapt(CASE, lambda mesh, start: values(mesh, start, given), comm=comm)))
    renamed = lambda mesh, start: {"u": np.zeros(mesh.owned), **({"v": np.zeros(mesh.owned)} if comm.rank == 2 else {})}
    assert "rank 2: solve() returned other variables" in raised(ql.InputError, lambda: next(ql.adapt(CASE, renamed, comm=comm)))
    other = CASE.changed(spacing={"max": 0.05 + 0.01 * comm.rank})
    assert "another one than on rank 0" in raised(ql.InputError, lambda: ql.mesh(other, comm=comm))


def test_an_exit_on_one_rank_ends_all():
    def solve(mesh, start):
        if comm.rank == 0:
            raise KeyboardInterrupt
        return {"u": np.zeros(mesh.owned)}
    raised(KeyboardInterrupt if comm.rank == 0 else ql.SolverError, lambda: next(ql.adapt(CASE, solve, comm=comm)))


def test_the_loop_goes_on_after_errors():
    cycles = list(ql.adapt(CASE, lambda mesh, start: {"u": np.tanh(30 * (mesh.points[:, 0] - 0.4))}, comm=comm))
    assert [cycle.number for cycle in cycles] == [0, 1, 2]


for name, test in list(globals().items()):
    if name.startswith("test_"):
        test()
