"""Outlines and cases."""
from __future__ import annotations

import dataclasses
import json
import os
from collections.abc import Mapping, Sequence

import numpy as np

from . import _core
from ._common import collective, handle_of, numbers_of, require, warn
from ._core import InputError


@dataclasses.dataclass(frozen=True, eq=False)
class Outline:
    """A curve through points, an array of shape (n, 2). See polygon(), spline() and curve()."""
    points: np.ndarray
    kind: str = "polygon"
    spline: bool = False


def points_of(points, what: str = "outline"):
    """A read-only copy of points."""
    array = numbers_of(points, (-1, 2), what)
    if len(array) < 2:
        raise InputError(f"{what}: needs at least two points, not {len(array)}")
    array.setflags(write=False)
    return array


def polygon(points) -> Outline:
    """A closed outline of straight lines through points of shape (n, 2), in either direction. The last point may repeat the first one."""
    array = points_of(points)
    return Outline(array[:-1] if len(array) > 1 and (array[0] == array[-1]).all() else array)


def spline(points) -> Outline:
    """A closed outline of cubic splines from corner to corner. Corners turn by more than the outline's `corner` angle, 30 degrees by default."""
    return dataclasses.replace(polygon(points), spline=True)


def curve(points, spline: bool = False) -> Outline:
    """An open curve. Curves that meet at their ends form an outline with a name for each side."""
    return Outline(points_of(points), "curve", spline)


def _toml(value) -> str:
    """A value of Python as TOML."""
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    if isinstance(value, (str, os.PathLike)):
        return json.dumps(os.fspath(value))
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{json.dumps(str(key))} = {_toml(entry)}" for key, entry in value.items()) + " }"
    if isinstance(value, np.ndarray):
        return _toml(value.tolist())
    if isinstance(value, Sequence):
        return "[" + ", ".join(map(_toml, value)) + "]"
    raise InputError(f"{value!r} is no value of a case: use numbers, texts, True, False, lists and dictionaries")


def outlines_of(given) -> dict:
    """Boundary -> the list of its Outlines."""
    result = {}
    for name, parts in require(given if given is not None else {}, Mapping, "outlines").items():
        is_list = isinstance(parts, (list, tuple)) and len(parts) > 0 and isinstance(parts[0], (Outline, np.ndarray))
        try:
            result[name] = [part if isinstance(part, Outline) else polygon(part) for part in (parts if is_list else [parts])]
        except InputError as error:
            raise InputError(f"outline '{name}': {str(error).removeprefix('outline: ')}") from None
    return result


def _shapes(outlines: Mapping) -> list:
    return [{"name": name, "kind": part.kind, "points": part.points, "spline": part.spline} for name, parts in outlines.items() for part in parts]


def _merged(tables: Mapping, changes: Mapping) -> dict:
    merged = dict(tables)
    for key, value in changes.items():
        both = isinstance(value, Mapping) and isinstance(merged.get(key), Mapping)
        merged[key] = _merged(merged[key], value) if both else value
    return merged


def _assignments(changes: Mapping, above: str = "") -> list:
    """Changes of a case file, as for --set."""
    result = []
    for key, value in changes.items():
        name = f"{above}{json.dumps(key) if not key.replace('_', 'a').isalnum() else key}"
        result += _assignments(value, name + ".") if isinstance(value, Mapping) else [f"{name}={_toml(value)}"]
    return result


class Case:
    """Geometry, sizes, layers, smoothing and adaptation: what a case file says.

    outlines  name of a boundary -> an Outline, an array of shape (n, 2) (a polygon), or a list of them
    tables    the tables of a case file by their names (keys() lists all), e.g. spacing={"min": 1e-3}. Paths are
              relative to the working folder.

    Raises InputError for unknown keys, wrong values and outlines that cannot be meshed.
    """

    def __init__(self, outlines: Mapping | None = None, **tables):
        self._set(None, tables, outlines_of(outlines))

    def _set(self, file, tables: Mapping, outlines: Mapping, told=()):
        self._file, self._tables, self._outlines = file, dict(tables), dict(outlines)
        self._cores: dict = {}
        self._told = set(told)  # warnings of the case from which this one was made
        self._core(None)

    @classmethod
    def from_file(cls, path, **tables) -> "Case":
        """The case of a file. Keyword arguments override keys of its tables."""
        case = cls.__new__(cls)
        case._set(os.fspath(path), tables, {})
        return case

    def changed(self, outlines: Mapping | None = None, **tables) -> "Case":
        """The same case with other values of some keys, or other points of some of its outlines. Lists such as `wake` are replaced."""
        if outlines and self._file is not None:
            raise InputError(f"{self._file}: outlines of a case file cannot be changed; name another file, geometry={{'file': ...}}")
        changed = outlines_of(outlines)
        if unknown := [name for name in changed if name not in self._outlines]:
            raise InputError(f"the case has no outline '{unknown[0]}'; it has {', '.join(self._outlines) or 'none'}")
        case = Case.__new__(Case)
        case._set(self._file, _merged(self._tables, tables), {**self._outlines, **changed}, self.warnings)
        return case

    def __reduce__(self):
        return _case_of, (self._file, self._tables, self._outlines)

    @property
    def title(self) -> str:
        return self._core(None).title

    @property
    def warnings(self) -> list:
        """Warnings about the case and its geometry."""
        return self._core(None).warnings

    @property
    def toml(self) -> str:
        """The case as the text of a case file; of a case from a file only what was changed."""
        shapes = [*self._tables.get("shape", []), *_shapes(self._outlines)]
        tables = {**self._tables, "shape": shapes} if shapes else self._tables
        return "".join(f"{key} = {_toml(value)}\n" for key, value in tables.items())

    def _meet(self, call: collective, comm):
        """The case must be the same on all ranks, and be prepared for a communicator on all or on none of them."""
        call.same(case=(self._file, self.toml), first_use_of_the_case=_number_of(comm) not in self._cores)

    def _core(self, comm):
        """The case of the library, for a communicator. The first time collective."""
        handle, number = handle_of(comm), _number_of(comm)
        if number not in self._cores:
            if self._file is None:
                core = _core.Case("case", self.toml, [], handle)
            else:
                core = _core.Case(self._file, None, _assignments(self._tables), handle)
            if not self._cores:
                warn([message for message in core.warnings if message not in self._told], level=5)
            self._cores[number] = core
        return self._cores[number]


def _number_of(comm) -> int | None:
    """A number of the communicator that no later one has, unlike its handle; None for this process alone."""
    return None if comm is None else _core.Communicator(handle_of(comm)).number


def _case_of(file, tables, outlines) -> Case:
    case = Case.__new__(Case)
    case._set(file, tables, outlines)
    return case


def keys() -> dict:
    """Every key of a case: table -> key -> (value, default as JSON or "", meaning)."""
    return _core.keys()
