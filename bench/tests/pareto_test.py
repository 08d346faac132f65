"""The Pareto front of the chart (bench/chart/pareto.py)."""
import os
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "bench", "chart"))
from pareto import beaten_at, front, judged_on_all  # noqa: E402


class Front(unittest.TestCase):
    def test_slower_and_no_better_is_not_on_it(self):
        self.assertEqual(front({"a": (1, 5), "b": (2, 5), "c": (3, 1), "d": (4, 2)}), {"a", "c"})

    def test_every_measure_counts(self):
        points = {"fast": (1, 9, 9), "right": (2, 0, 5), "near": (2, 5, 0), "neither": (2.5, 6, 6)}
        self.assertEqual(front(points), {"fast", "right", "near"})

    def test_times_within_the_noise_are_equal(self):
        self.assertEqual(front({"a": (1, 0), "b": (1.05, 0)}, noise=0.1), {"a", "b"})
        self.assertEqual(front({"a": (1, 0), "b": (1.05, 0)}, noise=0.01), {"a"})

    def test_noise_is_no_excuse_for_errors(self):
        self.assertEqual(front({"a": (1, 0), "b": (1.05, 1)}, noise=0.1), {"a"})
        self.assertEqual(front({"a": (1, 0), "b": (0.95, 1)}, noise=0.1), {"a"})
        self.assertEqual(front({"a": (1, 0), "b": (0.8, 1)}, noise=0.1), {"a", "b"})

    def test_a_chain_of_steps_within_the_noise_does_not_hide_its_end(self):
        chain = {"exact": (1, 0), "b": (0.93, 1), "c": (0.87, 2), "fast": (0.80, 3)}
        self.assertEqual(front(chain, noise=0.1), {"exact", "c"})
        self.assertEqual(front({**chain, "faster": (0.7, 4)}, noise=0.1), {"exact", "c", "faster"})

    def test_equals_stay_both(self):
        self.assertEqual(front({"a": (1, 1), "b": (1, 1)}), {"a", "b"})

    def test_what_was_judged_on_fewer_rays_is_left_out(self):
        self.assertEqual(judged_on_all({"a": {"rays": 9}, "b": {"rays": 8}, "c": {"rays": 9}}), {"a", "c"})
        self.assertEqual(judged_on_all({}), set())


class Beaten(unittest.TestCase):
    @staticmethod
    def row(variant, ns, wrong=0, decided=9, spread=0.01, off=1e-12):
        return {"variant": variant, "workload": "w", "ns_per_ray": ns, "wrong": wrong, "decided": decided,
                "error_mm": {"p999": off},
                "ns_per_ray_interval": (ns * (1 - spread), ns * (1 + spread))}

    def test_the_fastest_of_those_that_are_as_exact(self):
        rows = [self.row("default", 10), self.row("a", 8), self.row("b", 5), self.row("c", 1, wrong=1)]
        self.assertEqual(beaten_at(rows), [("w", "b", 0.5)])

    def test_not_by_what_is_farther_off(self):
        self.assertEqual(beaten_at([self.row("default", 10), self.row("a", 5, off=3e-12)]), [])
        self.assertEqual(beaten_at([self.row("default", 10), self.row("a", 5, off=None)]), [])

    def test_neither_noise_nor_wide_intervals_nor_fewer_rays(self):
        self.assertEqual(beaten_at([self.row("default", 10), self.row("a", 9.5)]), [])
        self.assertEqual(beaten_at([self.row("default", 10), self.row("a", 8, spread=0.3)]), [])
        self.assertEqual(beaten_at([self.row("default", 10), self.row("a", 5, decided=8)]), [])

    def test_not_by_what_was_timed_elsewhere(self):
        self.assertEqual(beaten_at([self.row("default", 10), dict(self.row("a", 5), outside=True)]), [])


if __name__ == "__main__":
    unittest.main()
