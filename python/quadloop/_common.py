"""Warnings, communicators, and checks of arguments."""
from __future__ import annotations

import dataclasses
import logging
import warnings

import numpy as np

from ._core import InputError


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
        answer = progress(Progress(stage, share, cycle))
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
    """Warnings are the same on all ranks: the first one shows them."""
    for message in messages if rank == 0 else []:
        warnings.warn(message, QuadloopWarning, stacklevel=level)


def handle_of(comm):
    """Fortran handle of a communicator of mpi4py; None: this process alone."""
    if comm is None:
        return None
    if not hasattr(comm, "py2f") or not comm:
        raise InputError(f"comm is a communicator of mpi4py or None, not {comm!r}")
    return comm.py2f()


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
