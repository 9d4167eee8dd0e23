"""Warnings, communicators, and checks of arguments."""
from __future__ import annotations

import contextlib
import dataclasses
import logging
import os
import traceback
import warnings

import numpy as np

from . import _core
from ._core import InputError, SolverError


@dataclasses.dataclass(frozen=True)
class Progress:
    """A stage of a call, as it begins and as it advances."""
    stage: str  # e.g. "refinement", "cutting", "cells", "smoothing", "transfer", "solving"
    share: float  # done, from 0 to 1; 0 if it is not known
    cycle: int | None  # of adapt(); None in other calls


def reporter(progress):
    """A function of stage, share and cycle that calls progress(Progress)."""
    if progress is None:
        return None
    if not callable(progress):
        raise TypeError(f"progress is a function of a Progress, not {type(progress).__name__}")
    def report(stage, share, cycle):
        collective.in_progress += 1
        try:
            answer = progress(Progress(stage, share, cycle))
        finally:
            collective.in_progress -= 1
        return answer is None or bool(answer)  # numpy's False cancels, too
    return report


LOGGER = logging.getLogger("quadloop")
LOGGER.addHandler(logging.NullHandler())  # silent until the program adds a handler
_LEVELS = (logging.DEBUG, logging.INFO, logging.WARNING)  # of log::Level


def log(level: int, line: str):
    LOGGER.log(_LEVELS[level], "%s", line)


class QuadloopWarning(UserWarning):
    """A warning of the library about a case, a mesh or a file."""


def warn(messages, rank=0, level=3):
    """Warnings are the same on all ranks. The first one shows them; where they are errors, they are so on all."""
    with contextlib.nullcontext() if rank == 0 else warnings.catch_warnings(record=True):
        for message in messages:
            warnings.warn(message, QuadloopWarning, stacklevel=level)


def handle_of(comm):
    """Fortran handle of a communicator of mpi4py; None: this process alone."""
    if comm is None:
        return None
    if not hasattr(comm, "py2f") or not comm:
        raise InputError(f"comm is a communicator of mpi4py or None, not {comm!r}")
    return comm.py2f()


class collective:
    """Checks of a rank's arguments before a collective call of the library.

        with collective(comm, "Mesh.write()") as call:
            path = path_of(path)
            call.same(path=path)

    At the end of the block the ranks of the `_core.Communicator` meet. An exception in the block on one rank is raised there and, as InputError or
    SolverError, on all others; so is a difference of the values passed to same(), or of the call. After the block all ranks call the library.
    """
    in_progress = 0  # functions of the user for progress that run now: on other ranks the library works

    def __init__(self, comm: _core.Communicator, call: str, waits: bool = False, **same):
        self._comm, self._call, self._waits = comm, call, waits
        self._same: list = []
        self.same(**same)
        if comm.size > 1 and collective.in_progress:
            raise InputError(f"{call} is collective and cannot be called in a function for progress")

    def __enter__(self) -> "collective":
        return self

    def same(self, **values):
        """Values that must be the same on all ranks, by what they are."""
        self._same += [(name.replace("_", " "), repr(value)) for name, value in values.items()]

    def __exit__(self, kind, error, trace) -> bool:
        text, failure = "", _core.Failure.none
        if getattr(error, "_of_ranks", False):
            text, failure = _text_of(error), _core.Failure.input if isinstance(error, InputError) else _core.Failure.of_other_rank
        elif error is not None:
            is_input = isinstance(error, InputError)
            text, failure = f"rank {self._comm.rank}: {'' if is_input else kind.__name__ + ': '}{_text_of(error)}", _core.Failure.input if is_input else _core.Failure.other
        try:
            self._comm.meet(self._call, self._same, self._waits, failure, text)
        except (InputError, SolverError) as raised:
            if error is None:
                raised._of_ranks = True  # type: ignore[union-attr]
                raise
        return False


def _text_of(error: BaseException) -> str:
    """The text of an exception, without what other ranks could not be told."""
    try:
        text = str(error)
    except Exception:  # of the exception's own method
        return "(without a text)"
    return text.encode("utf-8", "backslashreplace").decode().replace("\0", "\\0")


class users_function(collective):
    """The same for a function of the user that runs in a collective call, on all ranks. Ranks that return or fail wait for the others, whose
    collective calls raise an error meanwhile."""

    def __init__(self, comm: _core.Communicator, name: str):
        super().__init__(comm, f"the end of {name}", waits=True)

    def __exit__(self, kind, error, trace) -> bool:
        if error is not None and self._comm.size > 1 and not getattr(error, "_of_ranks", False):
            traceback.print_exception(kind, error, trace)  # at once, as other ranks may wait for this one in calls of their own
        return super().__exit__(kind, error, trace)


def communicator_of(comm) -> _core.Communicator:
    """The communicator of the module over the library for one of mpi4py; None: this process alone."""
    return _core.Communicator(handle_of(comm))


def path_of(path) -> str:
    """A path as text that the library can use."""
    text = os.fspath(path)
    try:
        if not isinstance(text, str) or "\0" in text:
            raise ValueError
        text.encode()
    except ValueError:
        raise InputError(f"a path is text in UTF-8 without zero bytes, not {text!r}") from None
    return text


def require(given, kind, what: str):
    if not isinstance(given, kind):
        raise TypeError(f"{what} is a {kind.__name__}, not {type(given).__name__}")
    return given


def numbers_of(given, shape: tuple, what: str) -> np.ndarray:
    """Finite real numbers of a shape, in which -1 stands for any number of rows."""
    try:
        array = np.asarray(given)
        fits = array.ndim == len(shape) and all(a in (-1, b) for a, b in zip(shape, array.shape)) and array.dtype.kind in "iuf"
    except ValueError:  # rows of different lengths
        fits = False
    if not fits:
        wanted = ", ".join("n" if size == -1 else str(size) for size in shape)
        found = f"{array.dtype} of shape {array.shape}" if isinstance(given, np.ndarray) else repr(given)[:60]
        raise InputError(f"{what}: needs real numbers of shape ({wanted}), not {found}")
    if np.ma.is_masked(given):
        raise InputError(f"{what}: contains masked values, the first in row {np.argwhere(np.ma.getmaskarray(given))[0][0]}; leave them out")
    array = array.astype(float)
    if not np.isfinite(array).all():
        raise InputError(f"{what}: contains values that are not finite, the first in row {np.argwhere(~np.isfinite(array))[0][0]}")
    return array
