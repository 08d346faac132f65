"""The chart of analysis (bench/analysis): its errors, its estimators with a ball and a box in place of csgrt, what it
gives OpenMC, and its pictures."""
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import unittest

ANALYSIS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "bench", "analysis")
sys.path.insert(0, ANALYSIS)
try:
    import numpy as np
except ImportError as missing:
    print(f"SKIPPED: {missing} (Debian, Ubuntu: apt-get install python3-numpy)")
    sys.exit(0)
from cases import box_corners, solid  # noqa: E402
from draw_overlaps import cell, curve  # noqa: E402
from errors import error_at, rows_of  # noqa: E402
from methods import (  # noqa: E402
    by_grid, by_lines, by_points, gqa_spacing, grid_rays, half_spaces, quadric, random_lines,
)


def ball(rays, near):
    """The partitions of a ball of radius 2 about the origin."""
    middle = -(rays[:, :3] * rays[:, 3:]).sum(1)
    half = 4 - (rays[:, :3] ** 2).sum(1) + middle ** 2
    hit = half > 0
    return {"t_in": middle[hit] - np.sqrt(half[hit]), "t_out": middle[hit] + np.sqrt(half[hit])}


def box(rays, near):
    """The partitions of a box of 1 x 2 x 3 from the origin on, of rays along the axes inside it."""
    length = rays[:, 3:] @ [1.0, 2.0, 3.0]
    return {"t_in": 0 * length, "t_out": length}


BALL_BOX = np.array([[-2.0] * 3, [2.0] * 3])


class Overlaps(unittest.TestCase):
    def test_a_curve_has_the_budgets_of_all_kinds_and_a_cell_the_seconds_from_which_on_all_seeds_find(self):
        rows = [{"kind": kind, "budget": budget, "found": found, "seeds": 10, "seconds": budget / 8}
                for kind, budget, found in (("a", 1, 10), ("a", 2, 9), ("a", 4, 10), ("b", 2, 3), ("b", 4, 4),
                                            ("a", 8, 10))]
        self.assertEqual(list(curve(rows)), [(0.25, 0.6, 2), (0.5, 0.7, 4)])
        self.assertEqual([cell([row for row in rows if row["kind"] == kind]) for kind in "abc"],
                         ["0.5", "4 of 10", "-"])


class Errors(unittest.TestCase):
    def test_a_budget_has_the_rms_of_its_seeds_and_their_median_time(self):
        runs = [(10, {"volume": (2.0 * (1 + e), t)}) for e, t in ((0.3, 5), (-0.4, 1), (0, 2))]
        row, = rows_of(runs, {"volume": 2.0})
        self.assertAlmostEqual(row["error"], 0.5 / math.sqrt(3), 12)
        self.assertEqual((row["figure"], row["budget"], row["seeds"], row["seconds"]), ("volume", 10, 3, 2))

    def test_budgets_and_figures_are_apart_and_figures_without_truth_left_out(self):
        runs = [(10, {"volume": (1.1, 1), "area": (3.0, 4)}), (20, {"volume": (1.0, 2)})]
        self.assertEqual([(r["figure"], r["budget"], r["seconds"]) for r in rows_of(runs, {"volume": 1, "area": 2})],
                         [("volume", 10, 1), ("area", 10, 4), ("volume", 20, 2)])
        self.assertEqual(len(rows_of(runs, {"volume": 1})), 2)

    def test_an_error_at_a_time_lies_between_budgets(self):
        rows = [{"seconds": t, "error": e} for t, e in ((1, 0.1), (0.01, 0.1), (100, 0.001))]
        self.assertAlmostEqual(error_at(rows, 10)[0], 0.01, 12)
        self.assertAlmostEqual(error_at(rows, 0.1)[0], 0.1, 12)
        self.assertEqual(error_at(rows, 1e3), (0.001, 100))
        self.assertIsNone(error_at(rows, 0.001))
        self.assertIsNone(error_at([], 1))


class Estimators(unittest.TestCase):
    def test_lines_and_points_have_no_bias(self):
        lines = by_lines(ball, BALL_BOX, 200_000, np.random.default_rng(1))
        self.assertAlmostEqual(lines["volume"][0] / (32 / 3 * math.pi), 1, delta=0.015)
        self.assertAlmostEqual(lines["area"][0] / (16 * math.pi), 1, delta=0.015)

        def region_at(points):
            return np.where((points ** 2).sum(1) < 4, 0, -1)
        points = by_points(region_at, BALL_BOX, 200_000, np.random.default_rng(1))
        self.assertAlmostEqual(points["volume"][0] / (32 / 3 * math.pi), 1, delta=0.015)

    def test_lines_have_all_directions_and_lie_in_the_ball(self):
        rays = random_lines(np.random.default_rng(1), 100_000, np.array([5.0, 0, 0]), 2)
        offset, d = rays[:, :3] - [5, 0, 0], rays[:, 3:]
        self.assertLess(abs((d[:, :, None] * d[:, None]).mean(0) - np.eye(3) / 3).max(), 0.01)
        self.assertLess(abs((offset * d).sum(1)).max(), 1e-12)
        self.assertAlmostEqual((offset ** 2).sum(1).mean(), 2, delta=0.02)  # half of the square of the radius

    def test_the_grid_has_the_rays_and_the_error_of_gqa(self):
        sides = np.array([[0.0] * 3, [1.0, 2.0, 3.0]])
        self.assertAlmostEqual(by_grid(box, sides, 16)["volume"][0], 6, 12)
        self.assertEqual(gqa_spacing([1, 2, 3], 16), 0.16)
        self.assertEqual(gqa_spacing([0.1, 2, 3], 16), 0.04)
        rays = grid_rays(sides, 0.75, 0)
        self.assertEqual(rays.tolist(), [[0, y, z, 1, 0, 0] for z in (0.75, 1.5, 2.25, 3) for y in (0.75, 1.5)])
        # 6 rays a side stand for 4 mm, though their spacing is 0.64 mm.
        error = by_grid(ball, BALL_BOX, 5)["volume"][0] / (32 / 3 * math.pi) - 1
        self.assertAlmostEqual(error, (4 / 3.84) ** 2 - 1, delta=0.02)


class Geometry(unittest.TestCase):
    def test_the_quadric_of_a_skew_cone_is_zero_on_it(self):
        base, height, a, b = np.array([[1.0, 2, 3], [0.5, 0.2, 4], [2, 0.1, 0], [0.3, 1, 0.2]])
        top = 0.25
        local = np.diag([1, 1, -(top - 1) ** 2, -1])
        local[2, 3] = local[3, 2] = 1 - top
        q = quadric(local, base, (a, b, height))
        for angle, part in ((0.3, 0.0), (2.0, 0.4), (4.0, 1.0)):
            x, y, z = base + part * height + (1 + (top - 1) * part) * (math.cos(angle) * a + math.sin(angle) * b)
            self.assertAlmostEqual(
                np.dot(q, [x * x, y * y, z * z, x * y, y * z, x * z, x, y, z, 1]), 0, 12)
        x, y, z = base + 0.5 * height
        self.assertLess(np.dot(q, [x * x, y * y, z * z, x * y, y * z, x * z, x, y, z, 1]), 0)

    def test_the_half_spaces_of_a_turned_box_and_of_a_wedge(self):
        turn = np.array([[0.6, -0.8, 0], [0.8, 0.6, 0], [0, 0, 1.0]])
        corners = np.array(box_corners((0, 0, 0), (1, 2, 3)), float) @ turn.T
        faces = half_spaces(corners)
        self.assertEqual(sorted(round(distance, 9) for _, distance in faces), [0, 0, 0, 1, 2, 3])
        wedge = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 0, 1), (0, 0, 1)]) * 1.0
        self.assertEqual(len(half_spaces(wedge)), 5)

    def test_a_solid_is_placed(self):
        matrix = np.array([[0, -2, 0, 1], [2, 0, 0, 0], [0, 0, 2, 0], [0, 0, 0, 1.0]])
        kind, centre, axis, radius, tube = solid(
            {"type": "tor", "center": [1, 0, 0], "axis": [1, 0, 0], "radius": 3, "tube": 1}, matrix)
        self.assertEqual(kind, "tor")
        np.testing.assert_allclose(centre, [1, 2, 0])
        np.testing.assert_allclose(axis, [0, 1, 0])
        np.testing.assert_allclose([radius, tube], [6, 2])


class Pictures(unittest.TestCase):
    def test_a_picture_of_bodies_one_of_models_and_a_page(self):
        try:
            import matplotlib  # noqa: F401
            import plotly  # noqa: F401
        except ImportError as missing:
            self.skipTest(str(missing))
        results = [{"case": case, "method": method, "figure": "volume", "budget": budget, "seeds": 8,
                    "seconds": budget / 1e6, "error": error / budget}
                   for case in ("ball", "truck") for method, error in (("csgrt", 1), ("other", 0))
                   for budget in (10, 100)]
        data = {"versions": {"csgrt": "0"}, "seeds": 8, "results": results,
                "methods": [{"method": "csgrt", "start": 0.1}, {"method": "other", "start": 0}],
                "cases": [{"case": "ball", "model": False}, {"case": "truck", "model": True, "interval": 1e-4}],
                "refusals": [{"case": "truck", "method": "third", "why": "it is not installed"}]}
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "measured.json"), "w", encoding="utf-8") as file:
                json.dump(data, file)
            subprocess.run([sys.executable, os.path.join(ANALYSIS, "draw.py"), "-o", folder, file.name], check=True)
            for name in ("bodies.png", "models.png"):
                with open(os.path.join(folder, name), "rb") as file:
                    self.assertEqual(file.read(4), b"\x89PNG")
            with open(os.path.join(folder, "index.html"), encoding="utf-8") as file:
                data = json.loads(re.search('type="application/json">(.*)</script>', file.read())[1])
            # A method that costs nothing more and is exact leaves nothing else on the front.
            self.assertEqual({(row["method"], row["budget"]) for row in data["results"] if row["front"]},
                             {("other", 10)})


if __name__ == "__main__":
    unittest.main()
