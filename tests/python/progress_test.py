"""On any number of ranks: stages that are reported, calls that are cancelled or interrupted, log lines."""
import logging
import os
import shutil
import signal
import tempfile
import threading
import time

import numpy as np
from mpi4py import MPI

import quadloop as ql

comm = MPI.COMM_WORLD
LAST = comm.size - 1
CASE = ql.Case(outlines={"edge": [[0, 0], [1, 0.1], [1, 1], [0, 0.8]]}, spacing={"max": 0.1}, adapt={"cycles": 2, "variable": "u", "norm": 2, "max_nodes": 1500, "min": 0.01})


def front(mesh, start):
    return {"u": np.tanh(30 * (mesh.points[:mesh.owned, 0] - 0.4))}


def raised(kind, work):
    try:
        work()
    except kind as error:
        return str(error)
    raise AssertionError(f"no {kind} on rank {comm.rank}")


def test_stages_are_reported():
    seen = []
    ql.mesh(CASE, comm=comm, progress=seen.append)
    assert {"refinement", "cutting", "cells", "smoothing"} == {progress.stage for progress in seen}, seen
    assert all(progress.cycle is None and 0 <= progress.share <= 1 for progress in seen)
    seen.clear()
    rough = ql.mesh(CASE.changed(smooth={"sweeps": 0}), comm=comm)
    ql.smooth(CASE, rough, comm=comm, progress=seen.append)
    assert seen[0] == ql.Progress("smoothing", 0.0, None), seen
    seen.clear()
    list(ql.adapt(CASE, front, comm=comm, progress=seen.append))
    assert {progress.cycle for progress in seen} == {0, 1, 2}
    assert {"transfer", "planning"} <= {progress.stage for progress in seen if progress.cycle == 1}
    raised(TypeError, lambda: ql.mesh(CASE, comm=comm, progress=3))


def test_false_on_one_rank_cancels_on_all():
    seen = []

    def at_smoothing(progress):
        seen.append(progress.stage)
        return np.bool_(progress.stage != "smoothing")
    message = raised(ql.Cancelled, lambda: ql.mesh(CASE, comm=comm, progress=at_smoothing if comm.rank == LAST else None))
    assert "'smoothing'" in message, message
    assert comm.rank != LAST or seen[-1] == "smoothing"


def test_an_exception_is_raised_on_its_rank():
    def stops(progress):
        if comm.rank == LAST:
            raise KeyError("enough")
    message = raised(KeyError if comm.rank == LAST else ql.Cancelled, lambda: ql.mesh(CASE, comm=comm, progress=stops))
    assert "enough" in message, message


def test_an_interrupt_takes_effect_within_the_call():
    signal.signal(signal.SIGINT, signal.default_int_handler)
    many = CASE.changed(spacing={"max": 0.001})
    completed = []

    def interrupt():
        time.sleep(0.03)
        os.kill(os.getpid(), signal.SIGINT)

    def work():
        if comm.rank == LAST:
            threading.Thread(target=interrupt).start()
        completed.append(ql.mesh(many, comm=comm))
    message = raised(KeyboardInterrupt if comm.rank == LAST else ql.Cancelled, work)
    assert not completed
    assert comm.rank == LAST or "KeyboardInterrupt" in message, message


def test_a_cancelled_run_leaves_whole_cycles():
    folder = comm.bcast(tempfile.mkdtemp() if comm.rank == 0 else None)

    def in_cycle_1(progress):
        if progress.cycle == 1 and progress.stage == "transfer" and comm.rank == LAST:
            raise KeyboardInterrupt

    def stops(mesh, start):
        raise KeyboardInterrupt
    try:
        raised(KeyboardInterrupt if comm.rank == LAST else ql.Cancelled, lambda: list(ql.adapt(CASE, front, comm=comm, folder=folder, progress=in_cycle_1)))
        comm.barrier()
        assert os.listdir(folder) == ["cycle_00"], os.listdir(folder)
        comm.barrier()
        raised(KeyboardInterrupt, lambda: list(ql.adapt(CASE, stops, comm=comm, folder=folder, resume=True)))
        comm.barrier()
        assert os.listdir(folder) == ["cycle_00"], os.listdir(folder)
        comm.barrier()
        assert [cycle.number for cycle in ql.adapt(CASE, front, comm=comm, folder=folder, resume=True)] == [1, 2]
        comm.barrier()
        assert sorted(os.listdir(folder)) == ["cycle_00", "cycle_01", "cycle_02"]
    finally:
        comm.barrier()
        if comm.rank == 0:
            shutil.rmtree(folder)


def test_log_lines_go_to_the_logger():
    records = []
    handler = logging.Handler()
    handler.emit = records.append
    logger = logging.getLogger("quadloop")
    logger.addHandler(handler)
    logger.setLevel(logging.DEBUG)
    try:
        ql.mesh(CASE, comm=comm)
        assert any(record.levelno == logging.DEBUG and "smoothed" in record.getMessage() for record in records), records
        records.clear()
        logger.setLevel(logging.INFO)
        ql.mesh(CASE, comm=comm)
        assert not records, records
    finally:
        logger.removeHandler(handler)
        logger.setLevel(logging.NOTSET)


for name, test in list(globals().items()):
    if name.startswith("test_"):
        test()
