"""On any number of ranks: the map between two meshes, and a transfer of one's own in the adaptive loop."""
import numpy as np
from mpi4py import MPI

import quadloop as ql

comm = MPI.COMM_WORLD
CASE = ql.Case(outlines={"edge": [[0, 0], [1, 0.1], [1, 1], [0, 0.8]]}, spacing={"max": 0.05}, adapt={"cycles": 2, "variable": "u", "norm": 2, "max_nodes": 3000, "min": 0.005})


def front(mesh, start):
    return {"u": np.tanh(30 * (mesh.points[:mesh.owned, 0] - 0.4)), "v": mesh.points[:mesh.owned, 1] ** 2}


def raised(kind, work):
    try:
        work()
    except kind as error:
        return str(error)
    raise AssertionError(f"no {kind} on rank {comm.rank}")


def together(array):
    """The rows of all ranks."""
    return np.concatenate(comm.allgather(array))


def test_the_map_interpolates_as_the_transfer_does():
    starts, maps = [], []

    def solve(mesh, start):
        starts.append(start)
        return front(mesh, start)

    def transfer(old, solution, new, between):
        maps.append((old, new, between))
        return {name: between.interpolate(values) for name, values in solution.items()}
    own = list(ql.adapt(CASE, solve, comm=comm, transfer=transfer))
    by_map = starts.copy()
    starts.clear()
    usual = list(ql.adapt(CASE, solve, comm=comm))
    assert len(own) == len(usual) == 3
    for cycle, other, start, expected in zip(own, usual, by_map, starts):
        np.testing.assert_array_equal(cycle.mesh.points, other.mesh.points)
        for name in expected or ():
            np.testing.assert_allclose(start[name], expected[name], rtol=0, atol=1e-14)
        for name, drift in other.drift.items():
            assert abs(cycle.drift[name] - drift) < 1e-13
    for (old, new, between), cycle in zip(maps, own):
        np.testing.assert_array_equal(old.points, cycle.mesh.points)
        assert between.nodes.shape == between.weights.shape == (new.owned, 3)
        np.testing.assert_allclose(between.weights.sum(axis=1), 1, atol=1e-14)
        np.testing.assert_allclose((between.rows(old.points) * between.weights[:, :, None]).sum(axis=1), between.interpolate(old.points), atol=1e-14)
        np.testing.assert_allclose(between.interpolate(old.points), new.points[:new.owned], atol=1e-12)


def test_nodes_and_cells_in_common():
    old, new = ql.mesh(CASE, comm=comm), ql.mesh(CASE.changed(source=[{"disc": [0.8, 0.7, 0.05], "spacing": 0.01}]), comm=comm)
    between = ql.TransferMap(old, new)
    positions = together(old.points[:old.owned])
    kept = between.same >= 0
    np.testing.assert_array_equal(positions[between.same[kept]], new.points[:new.owned][kept])
    assert 0 < comm.allreduce(int(kept.sum())) < comm.allreduce(new.owned)
    centroids = [together(old.points[cells].mean(axis=1)) for cells in (old.triangles, old.quads)]
    of_new = np.concatenate([new.points[cells].mean(axis=1) for cells in (new.triangles, new.quads)])
    assert between.cells.shape == (len(of_new),)
    same = between.cells >= 0
    np.testing.assert_allclose(np.concatenate(centroids)[between.cells[same]], of_new[same], atol=1e-14)
    assert 0 < comm.allreduce(int(same.sum())) < comm.allreduce(len(of_new))
    itself = ql.TransferMap(old, old)
    np.testing.assert_array_equal(itself.same, old.global_ids[:old.owned])
    np.testing.assert_array_equal(itself.cells, old.cell_ids)


def test_the_map_is_the_same_on_any_ranks():
    meshes = [ql.mesh(CASE, comm=comm), ql.mesh(CASE.changed(spacing={"max": 0.03}), comm=comm)]
    whole = ql.TransferMap(ql.mesh(CASE), ql.mesh(CASE.changed(spacing={"max": 0.03})))
    parts = ql.TransferMap(*meshes)
    for name in ("nodes", "weights", "same"):
        np.testing.assert_array_equal(together(getattr(parts, name)), getattr(whole, name))


def test_wrong_results_are_refused_on_all_ranks():
    def refused(kind, result):
        return raised(kind, lambda: list(ql.adapt(CASE, front, comm=comm, transfer=lambda old, solution, new, between: result(new))))
    assert "variables u, v" in refused(ql.InputError, lambda new: {"u": np.zeros(new.owned)})
    assert "variables u, v" in refused(ql.InputError, lambda new: None)
    assert "values" in refused(ql.InputError, lambda new: {"u": np.zeros(3), "v": np.zeros(new.owned)})

    def fails(new):
        if comm.rank == comm.size - 1:
            raise KeyError("lost")
        return {"u": np.zeros(new.owned), "v": np.zeros(new.owned)}
    assert "lost" in refused(KeyError if comm.rank == comm.size - 1 else ql.SolverError, fails)
    mesh = ql.mesh(CASE, comm=comm)
    raised(ql.InputError, lambda: ql.TransferMap(mesh, mesh).rows(np.zeros(mesh.owned + 10 ** 6)))
    if comm.size > 1:
        assert "communicators" in raised(ql.InputError, lambda: ql.TransferMap(mesh, ql.mesh(CASE)))


for name, test in list(globals().items()):
    if name.startswith("test_"):
        test()
