#!/usr/bin/env python3
"""Draws what measure.py measured: error against CPU seconds, bodies.png, models.png, and a page on which to choose.
Prints the errors at one time.

    bench/analysis/draw.py [-o FOLDER] [--at S] MEASURED.json

Needs matplotlib, and plotly for the page.
"""
import argparse
import json
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "chart"))
from errors import error_at  # noqa: E402
from drawing import draw_floor, draw_front, draw_names, load, look, write, write_page  # noqa: E402
from pareto import front  # noqa: E402

pyplot, ticker = load()
# Errors of rounding alone stand here.
FLOOR = 1e-8

HOW = """<p>A method's process measures one case: each budget with each seed. The error is the root of the mean square
of the seeds' relative errors, the time the median of their CPU seconds, user and system, of one thread. Times begin
when the scene is loaded; the start of each program stands in the table of the <code>README.md</code> in
<code>bench/analysis</code>, which tells more.</p>"""


def mark(results):
    """Adds where each row is drawn, and whether it is on the front of its figure."""
    for chosen in {(row["case"], row["figure"]) for row in results}:
        rows = [row for row in results if (row["case"], row["figure"]) == chosen]
        points = {}
        for index, row in enumerate(rows):
            row["drawn"] = max(row["error"], FLOOR)
            points[index] = row["seconds"], row["drawn"]
        on = front(points)
        for index, row in enumerate(rows):
            row["front"] = index in on


def panel(axes, data, case, figure):
    """One figure of one case: a line a method, and the front of all budgets of all methods."""
    rows = [row for row in data["results"] if (row["case"], row["figure"]) == (case["case"], figure)]
    for index, method in enumerate(data["methods"]):
        of = [row for row in rows if row["method"] == method["method"]]
        own = method["method"] == "csgrt"
        style = {**look(index, own), **({"markersize": 9} if own else {})}
        axes.plot([row["seconds"] for row in of], [row["drawn"] for row in of], linewidth=1, zorder=4 if own else 3,
                  **style, label=f"{method['method']} (start {method['start']:.2g} s)")
    draw_front(axes, [(row["seconds"], row["drawn"]) for row in rows if row["front"]])
    if any(row["drawn"] == FLOOR for row in rows):
        draw_floor(axes, FLOOR, "exact")
    if case["model"]:
        draw_floor(axes, case["interval"], "half of the truth's interval", "left")
    lacking = [row["method"] for row in data["refusals"] if row["case"] == case["case"]]
    if case["model"] and lacking:
        axes.text(0.02, 0.02, "without " + ", ".join(lacking), transform=axes.transAxes, fontsize=7, color="0.4")
    axes.set(xscale="log", yscale="log")
    axes.set_title(f"{figure} of {case['case']}", fontsize=10)
    axes.tick_params(labelsize=8)
    axes.xaxis.set_major_locator(ticker.LogLocator(numticks=20))
    axes.yaxis.set_major_locator(ticker.LogLocator(numticks=20))
    axes.grid(color="0.93", linewidth=0.6, zorder=0)


def draw(data, shown, title, path):
    """shown: (case, figure), three a line."""
    lines = -(-len(shown) // 3)
    figure = pyplot.figure(figsize=(11, 3.1 * lines + 0.8), layout="constrained")
    grid = figure.add_gridspec(lines + 1, 3, height_ratios=[1] * lines + [0.12])
    panels = []
    for i, (case, name) in enumerate(shown):
        first = panels[0] if panels else None
        panels.append(figure.add_subplot(grid[i // 3, i % 3], sharex=first, sharey=first))
        panel(panels[-1], data, case, name)
        panels[-1].tick_params(labelleft=i % 3 == 0, labelbottom=i // 3 == lines - 1)
        panels[-1].set_ylabel("relative error" if i % 3 == 0 else "")
        panels[-1].set_xlabel("CPU seconds" if i // 3 == lines - 1 else "")
    panels[0].set(xlim=(5e-6, 20), ylim=(FLOOR / 3, 3))
    draw_names(figure.add_subplot(grid[lines, :]), panels, 4)
    figure.suptitle(title, fontsize=9)
    write(figure, path)
    pyplot.close(figure)


def print_errors(data, figure, seconds):
    """A table of Markdown: the errors of all methods at a time; in brackets the time if it is less."""
    methods = [method["method"] for method in data["methods"]]
    print(f"\n| {figure} of | " + " | ".join(methods) + " |\n|---" + "|---" * len(methods) + "|")
    for case in data["cases"]:
        cells = []
        for method in methods:
            found = error_at([row for row in data["results"] if row["method"] == method and row["figure"] == figure and
                              row["case"] == case["case"]], seconds)
            less = found and found[1] < seconds
            cells.append("-" if found is None else f"{found[0]:.1e}" + (f" ({found[1]:.1g} s)" if less else ""))
        print(f"| {case['case']} | " + " | ".join(cells) + " |")


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("measured")
    arguments.add_argument("-o", "--output", default=".", help="folder for the pictures")
    arguments.add_argument("--at", type=float, default=0.1, help="CPU seconds of the tables that are printed (0.1)")
    options = arguments.parse_args()
    os.makedirs(options.output, exist_ok=True)
    with open(options.measured, encoding="utf-8") as file:
        data = json.load(file)
    # A program's time less its start may be nothing.
    data["results"] = [row for row in data["results"] if row["seconds"] > 0]
    mark(data["results"])
    versions = ", ".join(f"{name} {version}" for name, version in data["versions"].items())
    for name, model, figures in (("bodies", False, ("volume", "area")), ("models", True, ("volume",))):
        shown = [(case, figure) for figure in figures for case in data["cases"] if case["model"] == model]
        if shown:
            draw(data, shown, f"RMS of {data['seeds']} seeds; {versions}", os.path.join(options.output, name + ".png"))
    for figure in ("volume", "area"):
        print_errors(data, figure, options.at)
    write_page(os.path.join(HERE, "page.html"), data, {"HOW": HOW}, options.output)


if __name__ == "__main__":
    main()
