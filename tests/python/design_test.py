"""Morphing with derivatives in both directions, on this number of ranks."""
import unittest

import numpy as np
from mpi4py import MPI

import quadloop as ql

comm = MPI.COMM_WORLD
ANGLES = np.linspace(0, 2 * np.pi, 40, endpoint=False)
OVAL = np.column_stack([np.cos(ANGLES), 0.5 * np.sin(ANGLES)])
LAYERS = {"first": 0.005, "growth": 1.2, "count": 8}


def run_of(points, layers=LAYERS):
    return ql.Run(ql.Case(outlines={"body": points}, geometry={"far_field": 8.0}, spacing={"max": 1.0, "min": 0.02},
                          boundary={"body": {"spacing": 0.08, "bc": "wall", "layers": layers}}), comm)


def changed(points, by=0.05):
    return points + by * np.column_stack([np.sin(3 * points[:, 1]), points[:, 0] ** 2])


class Design(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.runs = [run_of(OVAL), run_of(OVAL[::-1])]

    def test_the_mesh_follows_its_outline(self):
        for run, points in zip(self.runs, (OVAL, OVAL[::-1])):
            new = changed(points)
            morphed = run.morph({"body": new})
            self.assertEqual(morphed.mesh.check(), [])
            np.testing.assert_array_equal(morphed.mesh.quads, run.mesh.quads)
            nodes = comm.allgather(morphed.mesh.points[np.unique(morphed.mesh.edges["body"])])
            nodes = np.vstack(nodes)
            for corner in new[::5]:
                self.assertLess(np.hypot(*(nodes - corner).T).min(), 0.09)
            far = np.unique(run.mesh.edges["farfield"])
            np.testing.assert_array_equal(morphed.mesh.points[far], run.mesh.points[far])
            self.assertGreater(morphed.worst_quality, 0.2)

    def test_derivatives_in_both_directions(self):
        for run, points in zip(self.runs, (OVAL, OVAL[::-1])):
            by_difference, by_transpose = run.verify({"body": changed(points, 0.02)})
            self.assertLess(by_difference, 1e-8)
            self.assertLess(by_transpose, 1e-12)

    def test_gradients_are_the_same_on_any_number_of_ranks(self):
        here = self.runs[0].morph({"body": changed(OVAL, 0.02)})
        alone = ql.Run(self.runs[0].case).morph({"body": changed(OVAL, 0.02)})
        weights = np.sin(np.arange(2 * alone.mesh.owned)).reshape(-1, 2)
        ids = here.mesh.global_ids[:here.mesh.owned]
        np.testing.assert_array_equal(here.pull_back(weights[ids])["body"], alone.pull_back(weights)["body"])

    def test_a_change_that_is_too_large_names_the_possible_share(self):
        with self.assertRaises(ql.TooFar) as caught:
            self.runs[0].morph({"body": changed(OVAL, 0.5)})
        self.assertTrue(0 < caught.exception.share < 1, caught.exception.share)
        quality = self.runs[0].morph({"body": OVAL}).worst_quality
        with self.assertRaises(ql.TooFar) as caught:
            self.runs[0].morph({"body": changed(OVAL, 0.3)}, min_quality=0.95 * quality)
        share = caught.exception.share
        self.assertTrue(0 < share < 1, share)
        self.runs[0].morph({"body": OVAL + share * (changed(OVAL, 0.3) - OVAL)}, min_quality=0.95 * quality)
        with self.assertRaises(ql.TooFar) as caught:
            self.runs[0].morph({"body": OVAL}, min_quality=0.999)
        self.assertEqual(caught.exception.share, 0)
        with self.assertRaisesRegex(ql.InputError, "outline '[a-z]+': contains values that are not finite"):
            self.runs[0].morph({"body": OVAL * np.nan})
        with self.assertRaisesRegex(ql.InputError, "shape"):
            self.runs[0].morph({"body": OVAL}).pull_back(np.zeros((3, 2)))
        with self.assertRaisesRegex(ql.InputError, "other direction"):
            self.runs[0].morph({"body": OVAL[::-1]})
        with self.assertRaisesRegex(ql.InputError, "as many points"):
            self.runs[0].morph({"body": OVAL[:-1]})
        with self.assertRaisesRegex(ql.InputError, "wing"):
            self.runs[0].morph({"wing": OVAL})


unittest.main(argv=["design_test"])
