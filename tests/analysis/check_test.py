"""csgrt check on overlaps and contact that are known, and on models whose overlaps many rays have found.

    check_test.py CSGRT [TEST...]

CSGRT is the program. With CSGRT_CHECK_LONG in the environment (1, or names of models) it takes many directions and the
models, of which it prints a table and what each seed misses.
"""
import json
import os
import resource
import subprocess
import sys
import unittest

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
sys.path.insert(0, os.path.join(ROOT, "bench", "analysis"))
from planted import BODY, DEPTHS, KINDS, ball, random_turn, scene_of_planted, two  # noqa: E402

CSGRT = sys.argv.pop(1)
LONG = os.environ.get("CSGRT_CHECK_LONG", "")
FOLDER = os.environ.get("CSGRT_BRLCAD", os.path.join(ROOT, "..", "shared", "brlcad"))
MODELS = ("goliath", "havoc", "truck", "tank_car", "castle", "shipping_container", "toyjeep", "demo")


def check(scene, **options):
    """What check finds in a scene or a file, and its CPU seconds."""
    words = [word for name, value in options.items() for word in (f"--{name.replace('_', '-')}", repr(value))]
    is_file = isinstance(scene, str)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([CSGRT, "check", scene if is_file else "-", "--json", "-", *words], text=True,
                          input=None if is_file else json.dumps(scene), capture_output=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode not in (0, 8):
        raise AssertionError(done.stderr)
    found = json.loads(done.stdout)
    return found, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def pairs_of(found):
    return {tuple(sorted(each["regions"])): each for each in found["overlaps"]}


def placed(kinds, depth, turns, seed=0):
    """A scene of these kinds, each turned so many times, and its pairs' paths."""
    scene, pairs = {}, {}
    for i, kind in enumerate(kinds):
        planted = kinds[kind](depth, 2) if kind == "part of a lattice" else kinds[kind](depth)
        for turn in range(1 if kind in ("mesh", "part of a lattice") else turns):  # these two take long
            name, at = f"{kind} {turn}", (500 * i, 500 * turn, 0)
            scene[name] = planted, random_turn(100 * (turn + turns * seed) + i, at)
            pairs[tuple(sorted(f"/{name}/{region}" for region in planted.pair))] = kind
    return scene_of_planted(scene), pairs


CONVEX = {"faces", "corner in a plate", "edge on edge", "cone's tip", "long oblique bar", "part of a lattice"}


class Known(unittest.TestCase):
    def test_planted_overlaps_are_found_and_their_depth_is_between_the_two(self):
        for seed, share in enumerate(DEPTHS):
            depth = share * BODY
            scene, pairs = placed(KINDS, depth, 1, seed)
            found = pairs_of(check(scene, seed=seed + 1, min_depth=depth / 2)[0])
            self.assertEqual(set(found) - set(pairs), set())
            # Distances to a mesh are not known, and a tip of 1e-3 of a body is smaller than the cells of rays.
            self.assertLessEqual({kind for pair, kind in pairs.items() if pair not in found},
                                 {"mesh"} if share <= 1e-3 else set(), depth)
            for pair, each in found.items():
                with self.subTest(kind=pairs[pair], depth=depth):
                    self.assertLessEqual(each["depth"], (1 + 1e-9) * depth)
                    self.assertGreaterEqual(each["depth"], 0.8 * depth)
                    self.assertGreaterEqual(each["depth_at_most"], (1 - 1e-9) * depth)
                    if pairs[pair] in CONVEX:
                        self.assertLessEqual(each["depth_at_most"], 1.1 * each["depth"])
                    self.assertEqual(each["estimate"], pairs[pair] == "mesh")

    def test_contact_and_gaps_are_no_overlap(self):
        """Parts that touch, or stand 1e-9 of their size apart; from 1,000 directions by the label."""
        kinds = {**KINDS, "balls": lambda depth: two(ball((0, 0, -50), 50), ball((0, 0, 50 - depth), 50))}
        del kinds["in a wall"]  # whose depth is that of the wall
        for depth in (0, -1e-9 * BODY):
            for seed in range(40 if LONG else 1):
                scene, pairs = placed(kinds, depth, 25 if LONG else 1, seed)
                found, _ = check(scene, min_depth=1e-6)
                with self.subTest(depth=depth, seed=seed):
                    self.assertEqual([(each["regions"], each["depth"]) for each in found["overlaps"]], [])
                    self.assertEqual(found["shallow"], 0)
                    self.assertGreaterEqual(found["candidates"], len(pairs))

    def test_the_overlap_of_gqas_regression_is_64_cubic_metres(self):
        box = {"type": "box", "low": [0, 0, 0], "high": [10, 10, 10]}
        inner, open_box = {**box, "low": [1, 1, 1], "high": [9, 9, 9]}, {**box, "low": [1, 1, 1], "high": [10, 9, 9]}
        regions = {"closed_box.r": {"difference": ["box1", "box2"]}, "overlap_obj.r": "box3"}
        found, _ = check({"csgrt": 1, "units": "m", "solids": {"box1": box, "box2": inner, "box3": open_box},
                          "combinations": {name: {"region": True, "tree": tree} for name, tree in regions.items()}})
        each, = found["overlaps"]
        volume, half = each["volume"]
        self.assertLessEqual(abs(volume - 64e9), half)
        self.assertLess(half, 0.05 * 64e9)


@unittest.skipUnless(LONG, "CSGRT_CHECK_LONG is not set")
class Models(unittest.TestCase):
    def test_each_seed_finds_what_ten_times_the_effort_finds(self):
        print("\n| model | candidates | --min-depth | seconds | pairs | by each seed | near the limit |", flush=True)
        for name in MODELS if LONG == "1" else LONG.split():
            file = os.path.join(FOLDER, f"{name}.g")
            if not os.path.exists(file):
                print(f"{name}.g is absent: left out", flush=True)
                continue
            with self.subTest(model=name):
                self.assertEqual(self.missed(name, file), [])

    def missed(self, name, file):
        """Prints the rows of a model, and gives the pairs at least twice the least depth deep that seeds miss."""
        depths, missed = {}, []

        def take(found):
            for pair, each in pairs_of(found).items():
                depths[pair] = max(each["depth"], depths.get(pair, 0))
            return set(pairs_of(found))
        for seed in (1001, 1002, 1003):
            take(check(file, seed=seed, effort=10)[0])
        for least in (0.01, 1.0):
            pairs, times = {}, []
            for seed in range(1, 11):
                found, spent = check(file, seed=seed, min_depth=least)
                pairs[seed] = take(found)
                times.append(spent)
            deep = {pair for pair, depth in depths.items() if depth >= 2 * least}
            near = sum(0.5 * least <= depth < 2 * least for depth in depths.values())
            counts = [len(deep & each) for each in pairs.values()]
            lost = [(seed, f"{depths[pair]:.3g} mm", *pair) for seed, each in pairs.items() for pair in deep - each]
            print(f"| {name} | {found['candidates']:,} | {least:g} | {sum(times) / len(times):.2g} | {len(deep)} | "
                  f"{min(counts)} to {max(counts)} | {near} |", flush=True)
            for each in sorted(lost):
                print("missed by seed", *each, flush=True)
            missed += lost
        return missed


if __name__ == "__main__":
    unittest.main(verbosity=2)
