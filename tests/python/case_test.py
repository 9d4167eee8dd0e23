"""Cases from keys and values: every key of the case file, errors and warnings."""
import json
import pickle
import tempfile
import unittest
import warnings
from pathlib import Path

import numpy as np

import quadloop as ql

SQUARE = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])


class Cases(unittest.TestCase):
    def test_a_case_from_arrays_is_that_of_a_file(self):
        foil = np.array([[1, 0], [0.5, 0.1], [0, 0], [0.5, -0.1]])
        tables = {"geometry": {"far_field": 5.0}, "spacing": {"max": 0.8}, "boundary": {"foil": {"spacing": 0.05, "bc": "wall"}}}
        given = ql.Case(outlines={"foil": foil}, **tables)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "case.toml")
            path.write_text(given.toml)
            from_file = ql.Case.from_file(path)
            a, b = ql.mesh(given), ql.mesh(from_file)
            coarser = ql.Case.from_file(path, spacing={"max": 1.6}, boundary={"foil": {"spacing": 0.2}})
        np.testing.assert_array_equal(a.points, b.points)
        np.testing.assert_array_equal(a.triangles, b.triangles)
        self.assertLess(ql.mesh(coarser).nodes, a.nodes)
        self.assertEqual(ql.mesh(given.changed(spacing={"max": 1.6}, boundary={"foil": {"spacing": 0.2}})).nodes, ql.mesh(coarser).nodes)

    def test_every_key_is_accepted_under_its_own_name(self):
        tables = ql.keys()
        self.assertGreater(sum(map(len, tables.values())), 150)
        for table, rows in tables.items():
            for key, (_, initial, meaning) in rows.items():
                self.assertTrue(meaning, (table, key))
                value = json.loads(initial) if initial else "no value of this key"
                parts = [*table.replace("NAME", "edge").split("."), key] if table else [key]
                nested = value
                for part in reversed(parts[1:]):
                    nested = {part: nested}
                if parts[0] in ("shape", "pair", "source", "block", "line", "wake", "point"):
                    nested = [nested]
                try:
                    with warnings.catch_warnings():
                        warnings.simplefilter("ignore")
                        ql.Case(outlines={"edge": SQUARE}, **{parts[0]: nested})
                except ql.InputError as error:  # wrong values and missing companions; never an unknown key
                    self.assertNotIn("unknown key", str(error))

    def test_errors_name_the_key_and_the_remedy(self):
        with self.assertRaisesRegex(ValueError, "case: unknown key 'spacing.mx'.*max"):
            ql.Case(outlines={"edge": SQUARE}, spacing={"mx": 1})
        with self.assertRaisesRegex(ql.InputError, "must be a number"):
            ql.Case(outlines={"edge": SQUARE}, spacing={"max": "wide"})
        for points in (np.full((4, 2), np.nan), [[0, 0], [1]], "abc", np.zeros((0, 2)), SQUARE + 1j):
            with self.assertRaisesRegex(ql.InputError, "outline 'edge': "):
                ql.Case(outlines={"edge": points})
        with self.assertRaises(TypeError):
            ql.Case(outlines=SQUARE)
        with self.assertRaises(TypeError):
            ql.mesh("case.toml")
        with self.assertRaisesRegex(ql.InputError, r"shape \(n, 2\)"):
            ql.Case(outlines={"edge": np.zeros((3, 3))})
        hidden = np.ma.masked_array([[0, 0], [1, 0], [1, 1]], mask=[[0, 0], [0, 1], [0, 0]])
        with self.assertRaisesRegex(ql.InputError, "outline 'edge': contains masked values, the first in row 1"):
            ql.Case(outlines={"edge": hidden})
        outside = {"body": [[5, 0], [6, 0], [5, 1]], "outer": [[0, 0], [1, 0], [1, 1]]}
        with self.assertWarnsRegex(ql.QuadloopWarning, "not connected; the first is inside boundary 'body'.*inside boundary 'outer'"):
            ql.Case(outlines=outside)
        with self.assertRaisesRegex(ql.InputError, "no value of a case"):
            ql.Case(outlines={"edge": SQUARE}, spacing={"max": object()})
        with self.assertRaisesRegex(ql.InputError, "none.toml"):
            ql.Case.from_file("none.toml")

    def test_sides_with_names_and_splines(self):
        bump = np.array([[0, 0], [0.25, 0.02], [0.5, 0.05], [0.75, 0.02], [1, 0]])
        sides = {"bump": ql.curve(bump, spline=True), "outlet": ql.curve([[1, 0], [1, 1]]), "rest": [ql.curve([[1, 1], [0, 1]]), ql.curve([[0, 1], [0, 0]])]}
        mesh = ql.mesh(ql.Case(outlines=sides, spacing={"max": 0.05}))
        self.assertEqual(set(mesh.edges), {"bump", "outlet", "rest"})
        on_bump = mesh.points[np.unique(mesh.edges["bump"])]
        between = on_bump[(on_bump[:, 0] > 0.3) & (on_bump[:, 0] < 0.45)]
        chord = np.interp(between[:, 0], bump[:, 0], bump[:, 1])
        self.assertTrue((between[:, 1] > chord + 1e-4).all(), "the nodes lie on the spline, above its chords")

    def test_cases_keep_their_own_points_and_can_be_pickled(self):
        points = SQUARE.astype(float)
        case = ql.Case(outlines={"edge": points}, spacing={"max": 0.1})
        before = case.toml
        points *= 2
        self.assertEqual(case.toml, before)
        self.assertEqual(pickle.loads(pickle.dumps(case)).toml, before)
        larger = case.changed(outlines={"edge": points})
        self.assertGreater(ql.mesh(larger).nodes, 3 * ql.mesh(case).nodes)
        with self.assertRaisesRegex(ql.InputError, "the case has no outline 'egde'; it has edge"):
            case.changed(outlines={"egde": points})

    def test_warnings_of_the_case(self):
        with self.assertWarnsRegex(ql.QuadloopWarning, "."):
            ql.Case(outlines={"edge": SQUARE}, spacing={"max": 0.2, "min": 0.1}, boundary={"edge": {"spacing": 0.01}})


unittest.main(argv=["case_test"])
