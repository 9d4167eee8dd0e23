"""Three ranks: parts of the mesh, errors and wrong arguments on one rank, calls that differ between ranks. None may wait for ever."""
import os
import signal
import threading
import warnings

import numpy as np
from mpi4py import MPI

import quadloop as ql

comm = MPI.COMM_WORLD
CASE = ql.Case(outlines={"edge": [[0, 0], [1, 0], [1, 1], [0, 1]]}, spacing={"max": 0.05}, adapt={"cycles": 2, "variable": "u", "norm": 2, "max_nodes": 5000, "min": 0.005})


def raised(kind, work, text=True):
    """The text of the error, or the error."""
    try:
        work()
    except kind as error:
        return str(error) if text else error
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
    assert "the end of solve(): 'variables' is (['u', 'v'], []) on rank 2, but (['u'], []) on rank 0" in raised(ql.InputError, lambda: next(ql.adapt(CASE, renamed, comm=comm)))
    other = CASE.changed(spacing={"max": 0.05 + 0.01 * comm.rank})
    assert "mesh(): 'case' on rank 1 differs from that on rank 0" in raised(ql.InputError, lambda: ql.mesh(other, comm=comm))


def test_an_exit_on_one_rank_ends_all():
    def solve(mesh, start):
        if comm.rank == 0:
            raise KeyboardInterrupt
        return {"u": np.zeros(mesh.owned)}
    raised(KeyboardInterrupt if comm.rank == 0 else ql.SolverError, lambda: next(ql.adapt(CASE, solve, comm=comm)))


def test_an_error_while_other_ranks_are_in_a_collective_call():
    calls = (lambda mesh: mesh.quality, lambda mesh: mesh.check(), lambda mesh: mesh.write(os.devnull + ".mesh"), lambda mesh: ql.TransferMap(mesh, mesh))
    for call in calls:
        def solve(mesh, start):
            if comm.rank == 1:
                raise KeyError("lost")
            for _ in range(2 if comm.rank == 0 else 1):  # a program that goes on after the error
                assert "rank 1: KeyError: 'lost'" in raised(ql.SolverError, lambda: call(mesh))
            return {"u": np.zeros(mesh.owned)}
        message = raised(KeyError if comm.rank == 1 else ql.SolverError, lambda: next(ql.adapt(CASE, solve, comm=comm)))
        assert message == ("'lost'" if comm.rank == 1 else "rank 1: KeyError: 'lost'"), message


def test_an_error_in_a_transfer_while_other_ranks_interpolate():
    def transfer(old, solution, new, between):
        if comm.rank == 2:
            raise KeyError("lost")
        return {"u": between.interpolate(solution["u"])}
    cycles = ql.adapt(CASE, lambda mesh, start: {"u": np.tanh(30 * (mesh.points[:, 0] - 0.4))}, comm=comm, transfer=transfer)
    message = raised(KeyError if comm.rank == 2 else ql.SolverError, lambda: list(cycles))
    assert message == ("'lost'" if comm.rank == 2 else "rank 2: KeyError: 'lost'"), message


def test_a_rank_that_returns_early_waits_for_the_others():
    def solve(mesh, start):
        if comm.rank > 0:
            return {"u": np.zeros(mesh.owned)}
        assert "the end of solve() on rank 1, but Mesh.quality on rank 0" in raised(ql.InputError, lambda: mesh.quality)
        return {"u": np.zeros(mesh.owned)}
    assert next(ql.adapt(CASE, solve, comm=comm)).number == 0


def test_wrong_arguments_on_one_rank_are_refused_on_all():
    made, run = ql.mesh(CASE, comm=comm), ql.Run(CASE, comm=comm)
    between, square = ql.TransferMap(made, made), CASE._outlines["edge"][0].points
    solve = lambda mesh, start: {"u": np.zeros(mesh.owned)}
    other, alone = ql.mesh(CASE.changed(spacing={"max": 0.1}), comm=comm), made.gathered()
    loops = ql.adapt(CASE, solve, comm=comm), ql.adapt(CASE, solve, comm=comm)
    wrong = comm.rank == 1
    pick = lambda bad, good: bad if wrong else good
    calls = {
        "mesh: case": lambda: ql.mesh(pick("case", CASE), comm=comm),
        "mesh: progress": lambda: ql.mesh(CASE, comm=comm, progress=pick(3, None)),
        "read: path": lambda: ql.read(pick("one.mesh", "other.mesh"), comm=comm),
        "smooth: mesh": lambda: ql.smooth(CASE, pick(None, made), comm=comm),
        "write: path": lambda: made.write(pick(7, "a.mesh")),
        "write: suffix": lambda: made.write(pick("a.doc", "a.mesh")),
        "write: solution": lambda: made.write("a.mesh", pick({"u": [1, 2]}, None)),
        "plot: size": lambda: made.plot("a.png", size=pick(3, 800)),
        "plot: field": lambda: made.plot("a.png", field=pick(4, "")),
        "picture: format": lambda: made.picture(pick("gif", "png")),
        "extrude: heights": lambda: made.extrude("a.vtu", pick([0, 2], [0, 1])),
        "extrude: axis": lambda: made.extrude("a.vtu", [0, 1], axis=pick("x", "z")),
        "adapt: solve": lambda: ql.adapt(CASE, pick(5, solve), comm=comm),
        "adapt: no solve": lambda: ql.adapt(CASE, pick(None, solve), comm=comm),
        "adapt: transfer": lambda: ql.adapt(CASE, solve, comm=comm, transfer=pick(len, None)),
        "adapt: folder": lambda: ql.adapt(CASE, solve, comm=comm, folder=pick("run", None)),
        "adapt: resume": lambda: ql.adapt(CASE, solve, comm=comm, folder="run", resume=pick(True, False)),
        "adapt: keys": lambda: ql.adapt(CASE, solve, comm=comm, cycles=pick(-1, 2)),
        "solve: keys": lambda: ql.solve(CASE, made, mach=pick(0.4, 0.3)),
        "map: mesh": lambda: ql.TransferMap(made, pick(None, made)),
        "map: values": lambda: between.rows(np.zeros(pick(3, made.owned))),
        "morph: outlines": lambda: run.morph(pick({}, {"edge": square})),
        "morph: quality": lambda: run.morph({"edge": square}, min_quality=pick(2, 0)),
        "verify: step": lambda: run.verify({"edge": square}, step=pick(1, 1e-6)),
        "evaluate: gradient": lambda: run.evaluate(gradient=pick("lift", "drag")),
        "verify: seed": lambda: run.verify({"edge": square}, seed=pick(None, 0)),
        "write: variables": lambda: made.write("a.vtu", {pick("v", "u"): np.zeros(made.owned)}),
        "write: path with a zero": lambda: made.write(pick("a\0b.mesh", "a.mesh")),
        "write: path that is not UTF-8": lambda: made.write(pick("a\udcff.mesh", "a.mesh")),
        "another mesh": lambda: pick(other, made).check(),
        "another mesh to smooth": lambda: ql.smooth(CASE, pick(other, made), comm=comm),
        "a mesh of one rank to smooth": lambda: ql.smooth(CASE, pick(alone, made), comm=comm),
        "a mesh of one rank in a map": lambda: ql.TransferMap(made, pick(alone, made)),
        "another run": lambda: next(pick(*loops)),
        "another call": lambda: pick(made.check, made.gathered)(),
    }
    for name, call in calls.items():
        try:
            raised((ql.InputError, ql.SolverError) if comm.rank != 1 else (ql.InputError, TypeError), call)
        except BaseException as error:
            raise AssertionError(f"{name}: {error!r}") from error
    assert not os.path.exists("a.mesh")


def test_errors_without_a_text_that_can_be_told():
    class Silent(Exception):
        def __str__(self):
            raise RuntimeError
    for error in (Silent(), ValueError("a\udcff\0b")):
        def solve(mesh, start):
            if comm.rank == 1:
                raise error
            return {"u": np.zeros(mesh.owned)}
        message = raised(type(error) if comm.rank == 1 else ql.SolverError, lambda: next(ql.adapt(CASE, solve, comm=comm)), text=False)
        assert comm.rank == 1 or f"rank 1: {type(error).__name__}" in str(message), message


def test_warnings_that_are_errors_are_so_on_all_ranks():
    few = CASE.changed(adapt={"max_nodes": 100})
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        raised(ql.QuadloopWarning, lambda: list(ql.adapt(few, lambda mesh, start: {"u": np.tanh(30 * (mesh.points[:, 0] - 0.4))}, comm=comm)))


def test_a_communicator_whose_handle_is_used_again():
    first = comm.Dup()
    case = CASE.changed(spacing={"max": 0.1})
    ql.mesh(case, comm=first)
    first.Free()
    second = comm.Split(comm.rank, 0)
    assert ql.mesh(case, comm=second).owned == ql.mesh(case).owned
    second.Free()


def test_an_interrupt_of_the_flow_solver():
    signal.signal(signal.SIGINT, signal.default_int_handler)
    tunnel = ql.Case(outlines={"edge": [[0, 0], [1, 0], [1, 1], [0, 1]]}, spacing={"max": 0.02}, boundary={"edge": {"bc": "farfield"}},
                     solver={"kind": "euler", "mach": 0.3, "iterations": 100000, "tolerance": 1e-300})
    made = ql.mesh(tunnel, comm=comm)
    start = {"density": 1 + 0.01 * made.points[:, 0], "x_velocity": 0 * made.points[:, 0], "y_velocity": 0 * made.points[:, 0], "pressure": 0.7 + 0 * made.points[:, 0]}
    if comm.rank == 1:
        threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    raised(KeyboardInterrupt if comm.rank == 1 else ql.Cancelled, lambda: [ql.solve(tunnel, made, start) for _ in range(1000)])


def test_no_collective_call_in_a_function_for_progress():
    made = ql.mesh(CASE, comm=comm)

    def progress(stage):
        made.check()
    wants = (ql.InputError, "cannot be called") if comm.rank == 2 else (ql.Cancelled, "cannot be called")
    assert wants[1] in raised(wants[0], lambda: ql.mesh(CASE, comm=comm, progress=progress if comm.rank == 2 else None))


def test_the_loop_goes_on_after_errors():
    cycles = list(ql.adapt(CASE, lambda mesh, start: {"u": np.tanh(30 * (mesh.points[:, 0] - 0.4))}, comm=comm))
    assert [cycle.number for cycle in cycles] == [0, 1, 2]


for name, test in list(globals().items()):
    if name.startswith("test_"):
        test()
