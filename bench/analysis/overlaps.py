#!/usr/bin/env python3
"""How often planted overlaps are found, by csgrt check and by Geant4's CheckOverlaps, against CPU seconds, as JSON.

    bench/analysis/overlaps.py [-o overlaps.json] [--kinds LIST] [--depths LIST] [--seeds N] [--limit S]

README.md tells more.
"""
import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
from statistics import median

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "chart"))
from cases import Refused, placed  # noqa: E402
from measure import versions  # noqa: E402
from methods import Geant4Solids, program, seconds, timed  # noqa: E402
from planted import BODY, DEPTHS, KINDS, random_turn, scene_of_planted  # noqa: E402

EFFORTS = (0.1, 0.3, 1, 3, 10)
POINTS = (1_000, 10_000, 100_000, 1_000_000)


def by_csgrt(planted, depth, effort, seed):
    """(what was found of the pair, other pairs that were found, CPU seconds of the command with one thread)."""
    command = [program("csgrt"), "check", "-", "--seed", str(seed), "--effort", str(effort), "--min-depth",
               repr(depth / 2), "--json", "-", "--threads", "1"]
    before = seconds(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, input=json.dumps(scene_of_planted({"all": (planted, random_turn(seed))})),
                          capture_output=True, text=True)
    spent = seconds(resource.RUSAGE_CHILDREN) - before
    if done.returncode not in (0, 8):
        raise Refused(done.stderr.strip())
    pair = {f"/all/{name}" for name in planted.pair}
    overlaps = json.loads(done.stdout)["overlaps"]
    here = [found for found in overlaps if set(found["regions"]) == pair]
    return here[0] if here else None, len(overlaps) - len(here), spent


def rows_by_csgrt(planted, depth, seeds, limit):
    for effort in EFFORTS:
        found, others, times = zip(*(by_csgrt(planted, depth, effort, seed) for seed in range(1, seeds + 1)))
        known = [each for each in found if each]
        row = {"method": "csgrt", "budget": effort, "found": len(known), "seeds": seeds, "others": sum(others),
               "seconds": median(times)}
        for name in ("depth", "depth_at_most"):
            if known:
                row[f"{name} by truth"] = [f(each[name] / depth for each in known) for f in (min, max)]
        yield row
        if max(times) > limit:
            return


def rows_by_geant4(planted, seeds, limit):
    solids = Geant4Solids(np.zeros(3))
    g4, keep = solids.g4, solids.keep
    air = g4.G4NistManager.Instance().FindOrBuildMaterial("G4_AIR")
    world = keep(g4.G4LogicalVolume(keep(g4.G4Box("world", 1000, 1000, 1000)), air, "world"))
    combinations = {name: {"tree": tree} for name, tree in planted.regions.items()}
    volumes = []
    for name, tree in planted.regions.items():
        solid = planted.solids.get(tree if isinstance(tree, str) else "", {})
        tree = ("mesh", solid["vertices"], solid["faces"]) if solid.get("type") == "bot" else \
            placed(name, np.eye(4), planted.solids, combinations)
        part = keep(g4.G4LogicalVolume(solids.made(tree), air, name))
        volumes.append(keep(g4.G4PVPlacement(None, g4.G4ThreeVector(), part, name, world, False, 0, False)))

    def check(points):
        return sum([volume.CheckOverlaps(points, 0.0, False, 1) for volume in volumes])  # each of them, found or not
    check(10)  # what is computed once
    for points in POINTS:
        found, times = zip(*(timed(check, points) for _ in range(seeds)))
        yield {"method": "Geant4", "budget": points, "found": sum(map(bool, found)), "seeds": seeds,
               "seconds": median(times)}
        if max(times) > limit:
            return


def job(kind, depth, seeds, limit):
    """What Geant4's process does, whose warnings are many."""
    out = os.dup(1)
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    try:
        answer = list(rows_by_geant4(KINDS[kind](depth), seeds, limit))
    except Refused as refused:
        answer = str(refused)
    os.write(out, json.dumps(answer).encode())


def by_geant4(kind, depth, seeds, limit):
    call = [sys.executable, __file__, "--seeds", str(seeds), "--limit", str(limit), "--job", kind, repr(depth)]
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(call, input="n\n", capture_output=True, text=True, cwd=folder)
    if done.returncode:
        return f"ended with {done.returncode}: {done.stderr.strip().splitlines()[-1:]}"
    return json.loads(done.stdout.splitlines()[-1])


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("-o", "--output", default="overlaps.json")
    arguments.add_argument("--kinds", default=",".join(KINDS))
    arguments.add_argument("--depths", default=",".join(map(str, DEPTHS)), help="shares of the body's 100 mm")
    arguments.add_argument("--methods", default="csgrt,Geant4")
    arguments.add_argument("--seeds", type=int, default=10)
    arguments.add_argument("--limit", type=float, default=5,
                           help="CPU seconds: no larger budget after a run that took longer (5)")
    arguments.add_argument("--job", nargs=2, help=argparse.SUPPRESS)
    options = arguments.parse_args()
    if options.job:
        job(options.job[0], float(options.job[1]), options.seeds, options.limit)
        return
    from drawing import save
    data = {"versions": versions(), "body": BODY, "results": [], "refusals": []}
    for kind in options.kinds.split(","):
        for share in map(float, options.depths.split(",")):
            depth = share * BODY
            for method in options.methods.split(","):
                rows = rows_by_csgrt(KINDS[kind](depth), depth, options.seeds, options.limit) if method == "csgrt" \
                    else by_geant4(kind, depth, options.seeds, options.limit)
                if isinstance(rows, str):
                    data["refusals"].append({"kind": kind, "depth": share, "method": method, "why": rows})
                    print(f"{kind}, {share:g}, {method}: {rows}", flush=True)
                    continue
                for row in rows:
                    data["results"].append({"kind": kind, "depth": share, **row})
                    print(f"{kind}, {share:g}, {method}, {row['budget']:g}: {row['found']} of {row['seeds']} in "
                          f"{row['seconds']:.3g} s", flush=True)
        save(data, options.output)


if __name__ == "__main__":
    main()
