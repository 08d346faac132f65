"""The charts' pages (bench/draw_chart.py, bench/chart/page.html, bench/analysis) in a browser: what they show for each
choice.

    page_test.py FOLDER     writes the pages there from hand-made figures, and opens them in a headless chromium
"""
import html
import json
import os
import re
import shutil
import subprocess
import sys
import unittest

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
BROWSER = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)


def row(method, mode, workload, family, time, wrong, knob=None, answered=1.0):
    made = {
        "variant": method if knob is None else f"{method} {knob}", "method": method, "mode": mode, "laboratory": True,
        "exact": knob is None, "workload": workload, "family": family, "rays": 1000, "unanswered": 0,
        "answered_share": answered, "decided": 1000, "ties": 0, "rule": 0, "wrong": wrong, "wrong_ppm": 1000.0 * wrong,
        "misplaced": 0,
        "wrong_ppm_interval": [500.0 * wrong, 3800.0 + 2000 * wrong], "ends": 10, "rule_ends": 0,
        "error_mm": {"p999": 1e-12, "worst": 1e-11}, "error_ulp": {"p999": 1.0, "worst": 2.0}}
    if knob is not None:
        made.update(knob="epsilon, mm", knob_value=knob)
    if family != "stress":
        made.update(ns_per_ray=100.0 * time, ns_per_ray_interval=[99.0 * time, 101.0 * time])
    return made


def measured(device, modes):
    results, totals, families = [], [], []
    for mode in modes:
        for workload, family in (("truck", "models"), ("havoc", "models"), ("thin", "stress")):
            # The curve is fast and wrong, or slow and right, but for thin rays; the partial method answers half.
            results += [row("default", mode, workload, family, 1, 0),
                        row("curve", mode, workload, family, 0.5, 40, 0.1),
                        row("curve", mode, workload, family, 2, 5 if workload == "thin" else 0, 0.001),
                        row("partial", mode, workload, family, 0.1, 0, answered=0.5)]
        for family, into in (("all", totals), ("models", families), ("stress", families)):
            for method, time, wrong, knob, answered in (("default", 1, 0, None, 1), ("curve", 0.5, 120, 0.1, 1),
                                                        ("curve", 2, 5, 0.001, 1), ("partial", 0.1, 0, None, 0.5)):
                total = row(method, mode, "all", family, time, wrong, knob, answered)
                if family != "stress":
                    total["of_default"] = time
                into.append(total)
    return {"device": device, "device_type": "cpu", "csgrt": "0.1.0", "size": 64, "frames": 3, "rays": 1000,
            "seconds": 1, "anchors": [], "timed_workloads": ["truck", "havoc"], "totals": totals, "families": families,
            "results": results,
            "methods": [{"name": "curve", "source": "nobody", "about": "</script>", "breaks": "thin: as was foretold",
                         "knob": "epsilon, mm", "exact": False, "on_device": False}]}


def measured_outside():
    """Another program's first hits on one workload, beside csgrt's default, at another time and size."""
    default = row("default", "first hits", "truck", "models", 50, 0)
    other = row("other", "first hits", "truck", "models", 150, 7)
    other.update(rays=400, decided=400, ends=0)
    totals = [dict(default, workload="all", family="all", of_default=1),
              dict(other, workload="all", family="all", of_default=3)]
    return {"device": "processors", "device_type": "cpu", "results": [default, other], "totals": totals,
            "families": [dict(t, family="models") for t in totals],
            "methods": [{"name": "other", "source": "somebody", "about": "", "breaks": "nobody knows", "knob": "",
                         "exact": False, "on_device": False}]}


def opened(folder, **choice):
    """The page's text after its scripts have run, and what the body's data say."""
    fragment = "&".join(f"{k}={v.replace(' ', '%20').replace('<', '%3C')}" for k, v in choice.items())
    command = [BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=5000",
               f"--user-data-dir={os.path.join(folder, 'profile')}", "--dump-dom",
               f"file://{os.path.abspath(folder)}/index.html#{fragment}"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=True)
    body = re.search(r"<body[^>]*>", done.stdout)[0]
    said = {k: html.unescape(v) for k, v in re.findall(r'data-(\w+)="([^"]*)"', body)}
    return re.sub(r"(?s)<script.*?</script>", "", done.stdout), said


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        os.makedirs(FOLDER, exist_ok=True)
        names = []
        second = measured("Device <Two>", ["first hits"])
        second["device_type"] = "gpu"
        for name, data in (("outside", measured_outside()),
                           ("first", measured("Device One", ["first hits", "every partition"])), ("second", second)):
            names.append(os.path.join(FOLDER, name + ".json"))
            with open(names[-1], "w", encoding="utf-8") as file:
                json.dump(data, file)
        draw = os.path.join(ROOT, "bench", "draw_chart.py")
        subprocess.run([sys.executable, draw, "-o", FOLDER, "--outside", *names], check=True)

    def opened(self, **choice):
        return opened(FOLDER, **choice)

    def test_all_rays_have_a_point_a_setting_and_the_front_leaves_out_what_answers_half(self):
        dom, said = self.opened(device="Device One", mode="every partition", family="all")
        self.assertEqual(said["points"], "4")
        self.assertEqual(said["front"], "curve 0.1; default")
        self.assertEqual(len(re.findall(r'<path class="point"', dom)), 4)  # drawn by the library
        self.assertIn("What to choose when", dom)

    def test_one_workload(self):
        dom, said = self.opened(device="Device One", mode="first hits", family="truck")
        self.assertEqual(said["front"], "curve 0.1; default")
        self.assertIn("0 / 1,000", dom)

    def test_a_program_judged_elsewhere_stands_at_its_ratio_to_the_default_beside_it(self):
        dom, said = self.opened(device="Device One", mode="first hits", family="truck")
        self.assertEqual(said["points"], "5")
        self.assertRegex(dom, r"<td>other</td><td>15,?000</td><td>3</td><td>7 / 400</td>")
        self.assertRegex(dom, r"nobody knows</td><td[^>]*>wrong, ppm: truck 7,?000</td>")
        _, said = self.opened(device="Device One", mode="first hits", family="truck", error="distance, mm")
        self.assertEqual(said["points"], "4")  # it tells no distances
        _, said = self.opened(device="Device <Two>", mode="first hits", family="truck")
        self.assertEqual(said["points"], "4")  # that is a GPU, the other ran on processors

    def test_rays_that_are_not_timed_stand_at_the_time_of_the_others(self):
        dom, said = self.opened(device="Device One", mode="first hits", family="thin")
        self.assertEqual(said["points"], "4")
        self.assertIn("These rays are not timed", dom)

    def test_another_device_has_its_own_modes(self):
        dom, said = self.opened(device="Device <Two>", mode="every partition", family="all models",
                                error="distance, mm")
        self.assertNotIn('<option value="every partition"', dom)
        self.assertEqual(said["points"], "4")

    def test_what_was_expected_stands_beside_what_was_measured(self):
        dom, _ = self.opened(device="Device One", mode="first hits", family="all")
        self.assertRegex(dom, r"thin: as was foretold</td><td[^>]*>wrong, ppm: thin 5,?000</td>")


class AnalysisPage(unittest.TestCase):
    def test_a_case_has_its_points_its_front_and_what_is_refused(self):
        folder = os.path.join(FOLDER, "analysis")
        os.makedirs(folder, exist_ok=True)
        results = [{"case": "ball", "method": method, "figure": "volume", "budget": budget, "seeds": 8,
                    "seconds": seconds, "error": error}
                   for method, budget, seconds, error in (("csgrt", 10, 1, 0.1), ("csgrt", 100, 9, 0.001),
                                                          ("slow <one>", 10, 2, 0.2))]
        with open(os.path.join(folder, "measured.json"), "w", encoding="utf-8") as file:
            json.dump({"versions": {}, "seeds": 8, "results": results, "cases": [{"case": "ball", "model": False}],
                       "methods": [{"method": m, "start": 0} for m in ("csgrt", "slow <one>")],
                       "refusals": [{"case": "ball", "method": "third", "why": "it holds no </script>"}]}, file)
        draw = os.path.join(ROOT, "bench", "analysis", "draw.py")
        subprocess.run([sys.executable, draw, "-o", folder, file.name], check=True)
        dom, said = opened(folder)
        self.assertEqual(said, {"points": "3", "front": "csgrt 10; csgrt 100"})
        self.assertEqual(len(re.findall(r'<path class="point"', dom)), 3)
        self.assertIn("it holds no &lt;/script&gt;", dom)


if __name__ == "__main__":
    if BROWSER is None:
        print("SKIPPED: there is no chromium (Debian, Ubuntu: apt-get install chromium)")
        sys.exit(0)
    try:
        import matplotlib  # noqa: F401
        import plotly  # noqa: F401
    except ImportError as missing:
        print(f"SKIPPED: {missing} (Debian, Ubuntu: apt-get install python3-matplotlib python3-plotly)")
        sys.exit(0)
    FOLDER = sys.argv.pop(1)
    unittest.main()
