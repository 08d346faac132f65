#!/usr/bin/env python3
"""Draws what csgrt_chart measured: a PNG a file, named like it, and one HTML page with advice.

    bench/draw_chart.py [-o FOLDER] [--outside OTHER.json]... MEASURED.json...

Programs that csgrt_chart cannot call are judged by another program, which writes a file of the same kind
(csgrt_judge_pov). Their rows join the charts of devices of the same type. The time of such a row is a ratio to csgrt's
default, measured beside it in its own file. What has been joined is written, too: a file a device.

Needs matplotlib, and plotly for the page (Debian, Ubuntu: python3-matplotlib, python3-plotly).
"""
import argparse
import html
import json
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "chart"))
from drawing import draw_floor, draw_front, draw_names, load, look, save, write, write_page  # noqa: E402
from pareto import beaten_at, mark_all  # noqa: E402

pyplot, ticker = load()

ADVICE = """<ul>
<li><b>To measure, cut or check anything: the default.</b> Double precision, bracketed quartics; ends on one surface
are one.
<li><b>For pictures on a device with slow double precision: <code>--precision single</code>.</b> The table shows where
it errs. Its distance errors are some 10<sup>8</sup> times as large.
<li><b>To agree with BRL-CAD: <code>--tolerance 0.0005</code></b>, which its files contain. Thinner parts vanish.
<li><b>To ignore a file's tolerance and use its numbers as they are: <code>--tolerance surfaces</code>.</b>
<li><b>Never: <code>single-world</code>, <code>ferrari</code>, <code>bracketed-unshifted</code>,
<code>--tolerance none</code>.</b> They are here to show their failures.
</ul>"""

HOW = """<p>Every method shoots the same rays: a grid of the default view of each model and scene, and the rays of the
stress families. The judge is the reference in 113-bit arithmetic. It moves the ray's origin to four sides by some units
in the last place, and makes the tolerance for rounding four times as large. A ray is decided if its regions stay the
same each time, and if no move takes an end of a region or gap an eighth of its length away. The other rays are ties.
Rays on which a file's own tolerance makes other regions than its numbers are counted apart. A ray is wrong if it has
another sequence of regions and gaps; for first hits, another first region.</p>
<p>A distance error in ulp is in units of how far the end moves when the ray moves by one unit in the last place. Double
precision cannot do better than about 1. The judge shares formulas and compiled scenes with the library's own variants.
So errors of scene compilation, such as the loss of very thin plates, do not show there. The oracle
(<code>tests/oracle</code>, <code>tests/integration/stress</code>) judges the formulas.</p>
<p>Times of the library's variants are the device's own times of its kernels, medians of warm frames. The variants run
in turn, in another order each time. The laboratory's methods are timed on the rays that they trace, by their kernels'
time where they have kernels, and else by the clock, on all processors. Methods that do the same work differ by the
machine's noise.</p>"""


class Measured:
    """What one device's file says of one mode."""

    def __init__(self, data, mode):
        self.data, self.mode = data, mode
        self.totals = {t["variant"]: t for t in data["totals"] if t["mode"] == mode and t.get("decided")}
        self.results = [r for r in data["results"] if r["mode"] == mode and "error" not in r and r["decided"]]
        self.whole = {n for n, t in self.totals.items() if "wrong rays" in t["whole"]}
        self.front = {n for n, t in self.totals.items() if "wrong rays" in t["front"]}


def join(data, outside):
    """Adds the rows of `outside`, but the default's, to `data`: what is theirs there is their share of its time."""
    beside = {(r["workload"], r["mode"]): r["ns_per_ray"] for r in outside["results"]
              if r["variant"] == "default" and r.get("ns_per_ray")}
    for kind in ("results", "totals", "families"):
        for row in outside[kind]:
            if row["variant"] == "default":
                continue
            row = dict(row, outside=True)
            if kind == "results" and row.get("ns_per_ray") and (row["workload"], row["mode"]) in beside:
                row["of_default"] = row["ns_per_ray"] / beside[row["workload"], row["mode"]]
            data[kind].append(row)
    known = {m["name"] for m in data["methods"]}
    data["methods"] += [m for m in outside["methods"] if m["name"] not in known]


def scatter(axes, measured):
    """Time against wrong rays: a point a variant, a curve where a method has a knob, and the front."""
    drawn = {n: t for n, t in measured.totals.items() if t.get("of_default")}
    if not drawn:
        axes.text(0.5, 0.5, "not measured", ha="center", transform=axes.transAxes)
        return
    floor = 1e6 / max(t["decided"] for t in drawn.values()) / 3

    def height(total):
        return max(total["wrong_ppm"], floor)
    # Of all modes: a method looks the same in all of them, and has one line of the legend.
    methods = list(dict.fromkeys(t["method"] for t in measured.data["totals"]))
    for index, method in enumerate(methods):
        of = sorted((t for t in drawn.values() if t["method"] == method), key=lambda t: t.get("knob_value", 0))
        if not of:
            continue
        style = look(index, method == "default")
        xs, ys = [t["of_default"] for t in of], [height(t) for t in of]
        bars = [[max(0, y - t["wrong_ppm_interval"][0]) * 0.99 if t["wrong"] else 0 for t, y in zip(of, ys)],
                [max(0, t["wrong_ppm_interval"][1] - y) for t, y in zip(of, ys)]]
        whole = all(t["variant"] in measured.whole for t in of)
        axes.errorbar(xs, ys, yerr=bars, label=method + ("" if whole else " *"), **style,
                      markerfacecolor=style["color"] if whole else "white", linestyle=":" if len(of) > 1 else "",
                      linewidth=1, elinewidth=0.6, zorder=3)
    draw_front(axes, [(drawn[n]["of_default"], height(drawn[n])) for n in measured.front])
    times = [t["of_default"] for t in drawn.values()]
    wide = max(times) > 3 * min(times)
    axes.set_xscale("log")
    axes.set_yscale("log")
    draw_floor(axes, floor, "none wrong")
    axes.xaxis.set_major_locator(
        ticker.LogLocator(subs=(1, 1.5, 2, 3, 5, 7) if wide else (1, 1.1, 1.2, 1.5, 6, 7, 8, 9)))
    axes.xaxis.set_major_formatter(ticker.FuncFormatter(lambda v, _: f"{v:g}"))
    axes.xaxis.set_minor_formatter(ticker.NullFormatter())
    axes.tick_params(labelsize=8)
    axes.set_xlabel("time, in times of the default's")
    axes.set_ylabel("decided rays with wrong regions, parts per million")
    axes.set_title(measured.mode, fontsize=10)


def draw(data, modes, name, folder):
    figure = pyplot.figure(figsize=(11, 6.2), layout="constrained")
    grid = figure.add_gridspec(2, len(modes), height_ratios=[1, 0.22])
    panels = [figure.add_subplot(grid[0, i]) for i in range(len(modes))]
    for axes, mode in zip(panels, modes):
        scatter(axes, Measured(data, mode))
    draw_names(figure.add_subplot(grid[1, :]), panels, 6)
    decided = max((t["decided"] for t in data["totals"] if t.get("decided")), default=0)
    figure.suptitle(f"csgrt {data['csgrt']} on {data['device']}: up to {decided:,} decided rays a method; time: "
                    f"geometric mean over {len(data['timed_workloads'])} workloads, {data['size']} x {data['size']}; "
                    "*: part of the rays",
                    fontsize=9)
    write(figure, os.path.join(folder, name + ".png"))
    pyplot.close(figure)


def facts(data, modes):
    """What the figures say of the default: is it on the front, and where another method beats it at the same error."""
    lines = []
    for mode in modes:
        m = Measured(data, mode)
        default = m.totals.get("default")
        if default is None:
            continue
        said = "is on" if "default" in m.front else "is <b>not</b> on"
        low, high = default["wrong_ppm_interval"]
        lines.append(
            f"<li>{html.escape(data['device'])}, {mode}: the default {said} the front of time and wrong rays, with "
            f"{default['wrong']:,} of {default['decided']:,} decided rays wrong ({low:.3g} to {high:.3g} ppm). The "
            f"front: {html.escape(', '.join(sorted(m.front)))}.")
        beaten = beaten_at(m.results)
        timed = len({r["workload"] for r in m.results if r["variant"] == "default" and r.get("ns_per_ray")})
        where = "; ".join(f"{workload}: {method} ({ratio:.2f} of its time)" for workload, method, ratio in beaten)
        lines.append(f"<li>Another method is faster at the same error on {len(beaten)} of {timed} timed workloads" +
                     (f": {html.escape(where)}." if where else "."))
    return "<ul>" + "\n".join(lines) + "</ul>"


def page(measured, modes, folder):
    texts = {"ADVICE": ADVICE + "".join(facts(data, modes) for data in measured), "HOW": HOW}
    write_page(os.path.join(HERE, "chart", "page.html"), measured, texts, folder)


def read(path):
    """What the file says, and its modes."""
    try:
        with open(path, encoding="utf-8") as file:
            data = json.load(file)
        return data, list(dict.fromkeys(t["mode"] for t in data["totals"]))
    except (OSError, ValueError, KeyError, TypeError) as error:
        sys.exit(f"draw_chart.py: {path}: not a file that csgrt_chart wrote: {error!r}")


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("measured", nargs="+", help="what csgrt_chart wrote, a file a device")
    arguments.add_argument("--outside", action="append", default=[], metavar="FILE",
                           help="what csgrt_judge_pov wrote; may be repeated")
    arguments.add_argument("-o", "--output", default=".", help="folder for the pictures and the page")
    options = arguments.parse_args()
    os.makedirs(options.output, exist_ok=True)
    measured = []
    outside = [read(path)[0] for path in options.outside]
    for path in options.measured:
        data, modes = read(path)
        name = os.path.splitext(os.path.basename(path))[0]
        joining = [other for other in outside if other["device_type"] == data["device_type"]]
        for other in joining:
            join(data, other)
        if joining:
            save(data, os.path.join(options.output, name + ".json"))
        mark_all(data)
        draw(data, modes, name, options.output)
        measured.append(data)
        for mode in modes:
            print(f"{data['device']}, {mode}: the front is {', '.join(sorted(Measured(data, mode).front))}")
    page(measured, list(dict.fromkeys(t["mode"] for data in measured for t in data["totals"])), options.output)


if __name__ == "__main__":
    main()
