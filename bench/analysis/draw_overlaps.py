#!/usr/bin/env python3
"""Draws what overlaps.py measured: the share of planted overlaps that is found against CPU seconds, overlaps.png.
Prints a table of the CPU seconds from which on all seeds find.

    bench/analysis/draw_overlaps.py [-o FOLDER] OVERLAPS.json

Needs matplotlib.
"""
import argparse
import json
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "chart"))
from drawing import load, look, write  # noqa: E402

METHODS = ("csgrt", "Geant4")
LATTICE = "part of a lattice"  # of 125 regions, which take as much time as all others together


def curve(rows):
    """(mean CPU seconds, share found, budget) of each budget that all kinds have had."""
    kinds = {row["kind"] for row in rows}
    for budget in sorted({row["budget"] for row in rows}):
        of = [row for row in rows if row["budget"] == budget]
        if len(of) == len(kinds):
            yield (sum(row["seconds"] for row in of) / len(of),
                   sum(row["found"] for row in of) / sum(row["seeds"] for row in of), budget)


def draw(data, path):
    pyplot, ticker = load()
    depths = sorted({row["depth"] for row in data["results"]}, reverse=True)
    figure, panels = pyplot.subplots(1, len(depths), figsize=(11, 3), layout="constrained", sharex=True, sharey=True)
    for axes, depth in zip(panels, depths):
        for index, method in enumerate(METHODS):
            points = list(curve([row for row in data["results"] if row["kind"] != LATTICE and
                                 (row["depth"], row["method"]) == (depth, method)]))
            axes.plot([x for x, _, _ in points], [y for _, y, _ in points], linewidth=1, label=method,
                      **{**look(index, method == "csgrt"), **({"markersize": 9} if method == "csgrt" else {})})
        axes.set(xscale="log", ylim=(-0.03, 1.05), xlabel="CPU seconds")
        axes.set_title(f"{depth:g} of the body", fontsize=10)
        axes.xaxis.set_major_locator(ticker.LogLocator(numticks=20))
        axes.grid(color="0.93", linewidth=0.6, zorder=0)
    panels[0].set_ylabel("share found")
    panels[-1].legend(fontsize=8)
    write(figure, path)


def cell(rows):
    """The CPU seconds of the least budget from which on all seeds find; else how many do with the largest."""
    rows = sorted(rows, key=lambda row: row["budget"])
    if not rows:
        return "-"
    if rows[-1]["found"] < rows[-1]["seeds"]:
        return f"{rows[-1]['found']} of {rows[-1]['seeds']}"
    missing = [i for i, row in enumerate(rows) if row["found"] < row["seeds"]]
    return f"{rows[missing[-1] + 1 if missing else 0]['seconds']:.2g}"


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("measured")
    arguments.add_argument("-o", "--output", default=".", help="folder for the picture")
    options = arguments.parse_args()
    os.makedirs(options.output, exist_ok=True)
    with open(options.measured, encoding="utf-8") as file:
        data = json.load(file)
    draw(data, os.path.join(options.output, "overlaps.png"))
    depths = sorted({row["depth"] for row in data["results"]}, reverse=True)
    print("| kind | " + " | ".join(f"{depth:g}" for depth in depths) + " |\n|---" + "|---" * len(depths) + "|")
    for kind in dict.fromkeys(row["kind"] for row in data["results"]):
        print(f"| {kind} | " + " | ".join(" / ".join(cell([
            row for row in data["results"] if (row["kind"], row["depth"], row["method"]) == (kind, depth, method)])
            for method in METHODS) for depth in depths) + " |")
    for name in ("depth by truth", "depth_at_most by truth"):
        ends = [row[name] for row in data["results"] if name in row]
        print(f"{name}: {min(low for low, _ in ends)!r} to {max(high for _, high in ends)!r}")


if __name__ == "__main__":
    main()
