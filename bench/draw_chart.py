#!/usr/bin/env python3
"""Draws what csgrt_chart measured: an SVG and a PNG per file, named like it, and one HTML page with advice.

    bench/draw_chart.py [-o FOLDER] MEASURED.json...

Needs matplotlib (Debian, Ubuntu: python3-matplotlib).
"""
import argparse
import base64
import html
import json
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "chart"))
from pareto import NOISE, front, judged_on_all  # noqa: E402

try:
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot, ticker
except ImportError:
    sys.exit("draw_chart.py: matplotlib is not there (Debian, Ubuntu: apt-get install python3-matplotlib)")

# The judge itself: it has no errors by definition, so it is drawn but does not compete.
JUDGE = "113 bits"
# A method this many times slower than the default would squeeze the chart; the caption names it instead.
OFF_THE_CHART = 20

USE = {
    "default": "the one to use",
    "single": "pictures on devices with slow double precision; not for measuring, thin or touching parts",
    "single-world": "nothing: it shows single precision without coordinates relative to the eye",
    "bracketed-unshifted": "nothing: without the shift, tori far from the ray's origin lose roots",
    "ferrari": "nothing that measures: closed form, roots lost near tangency",
    "yuksel": "many tori and tapered cones, if the last digit does not matter",
    "tolerance 0.0005 mm": "comparison with BRL-CAD; parts thinner than this vanish",
    "tolerance surfaces": "the default's own rule, also where a file brings a tolerance",
    "tolerance relative": "models with sloppy coincidences; corners closer than 1e-9 of the scene are lost",
    "tolerance none": "showing which skins rounding leaves where surfaces coincide",
    "contraction": "devices whose kernels get faster by it; the last bits differ between devices",
    "reference": "checking a device: the same bits from the CPU",
    JUDGE: "the judge: it measures the rounding of the others",
}


class Measured:
    """One device's file."""

    def __init__(self, path, mode):
        with open(path, encoding="utf-8") as file:
            data = json.load(file)
        self.mode = mode
        data["totals"] = [t for t in data["totals"] if t["mode"] == mode]
        data["results"] = [r for r in data["results"] if r["mode"] == mode]
        self.name, self.data = os.path.splitext(os.path.basename(path))[0], data
        self.device = data["device"]
        self.totals = {t["variant"]: t for t in data["totals"] if t.get("decided")}
        self.variants = list(self.totals)
        self.workloads = list(dict.fromkeys(r["workload"] for r in data["results"]))
        self.cells = {(r["variant"], r["workload"]): r for r in data["results"]}
        self.timed = {n: t for n, t in self.totals.items() if t.get("ns_per_ray")}
        all_rays = judged_on_all(self.totals)
        self.on_fewer = [n for n in self.timed if n not in all_rays]
        competing = {n: t for n, t in self.timed.items() if n != JUDGE and n in all_rays}
        self.front_wrong = front({n: (t["ns_per_ray"], t["wrong_ppm"]) for n, t in competing.items()})
        self.front_ulp = front({n: (t["ns_per_ray"], ulps(t)) for n, t in competing.items()})
        self.front = front({n: (t["ns_per_ray"], t["wrong_ppm"], ulps(t)) for n, t in competing.items()})
        self.decided = max(t["decided"] for t in self.totals.values())

    def anchors(self):
        """BRL-CAD's times in nanoseconds a ray, over the same models; none if those were not measured."""
        over = self.data["timed_workloads"]
        for anchor in self.data["anchors"]:
            if anchor["device_type"] == self.data["device_type"] and over and all(w in anchor["ms"] for w in over):
                logs = [math.log(anchor["ms"][w] * 1e6 / 1024 ** 2) for w in over]
                yield anchor["name"], math.exp(sum(logs) / len(logs))


def ulps(total):
    value = total["error_ulp"]["p999"]
    return math.inf if value is None else value


def style(index):
    colors = matplotlib.colormaps["tab20"].colors
    return {"color": colors[(2 * index) % 20 + (2 * index) // 20], "marker": "osD^v<>Pp*hX8"[index % 13]}


def scatter(axes, measured, value, floor, floor_label, on_front, label):
    default = measured.timed.get("default", next(iter(measured.timed.values())))["ns_per_ray"]
    drawn, left_out = [], []
    for index, name in enumerate(measured.variants):
        if name not in measured.timed:
            continue
        x, y = measured.timed[name]["ns_per_ray"], value(measured.timed[name])
        if x > OFF_THE_CHART * default:
            left_out.append(name)
            continue
        if not math.isfinite(y):
            continue
        y = max(y, floor)
        drawn.append((x, y, name))
        # The default is drawn larger and below the others, so that methods at the same place do not hide it.
        size, order = (130, 3) if name == "default" else (46, 4)
        axes.scatter(x, y, s=size, zorder=order, label=name, **style(index), edgecolors="white", linewidths=0.6)
        if name in on_front:
            axes.scatter(x, y, s=260, zorder=2, facecolors="none", edgecolors="black", linewidths=1.1)
    steps = sorted((x, y) for x, y, name in drawn if name in on_front)
    if steps:
        axes.step([x for x, _ in steps], [y for _, y in steps], where="post", color="black", linewidth=0.8, zorder=1)
    axes.set_xscale("log")
    axes.set_yscale("log")
    top = max([y for _, y, _ in drawn] + [floor * 10]) * 30
    axes.set_ylim(floor / 3, top)
    for number, (name, x) in enumerate(measured.anchors()):
        axes.axvline(x, color="0.55", linestyle=("--", ":")[number % 2], linewidth=1)
        axes.text(x, top / 1.5, " " + name, rotation=90, va="top", ha="right", fontsize=7, color="0.35")
    axes.axhline(floor, color="0.8", linewidth=0.8, zorder=0)
    axes.text(0.01, floor, floor_label, transform=axes.get_yaxis_transform(), ha="left", va="top", fontsize=7,
              color="0.4")
    axes.set_xlabel("nanoseconds a ray")
    axes.set_ylabel(label)
    xs = [x for x, _, _ in drawn] + [x for _, x in measured.anchors()]
    if xs:
        axes.set_xlim(0.6 * min(xs), 1.7 * max(xs))
    axes.xaxis.set_major_locator(ticker.LogLocator(subs=(1, 1.5, 2, 3, 5, 7)))
    axes.xaxis.set_minor_locator(ticker.NullLocator())
    axes.xaxis.set_major_formatter(ticker.FuncFormatter(lambda v, _: f"{v:g}"))
    axes.tick_params(labelsize=8)
    return left_out


def heat_map(axes, measured):
    """Wrong regions, variant by workload: where each method fails."""
    shades = [[math.log10(max(cell.get("wrong_ppm") or 0, 1)) if (cell := measured.cells.get((v, w), {})) else 0
               for w in measured.workloads] for v in measured.variants]
    axes.imshow(shades, cmap="OrRd", vmin=0, vmax=6, aspect="auto")
    for y, variant in enumerate(measured.variants):
        for x, workload in enumerate(measured.workloads):
            cell = measured.cells.get((variant, workload), {})
            if "error" in cell:
                text = "none"
            elif cell.get("wrong_ppm") is None:
                text = "-"
            else:
                text = f"{cell['wrong_ppm']:,.0f}"
            axes.text(x, y, text, ha="center", va="center", fontsize=6.5, color="0.75" if text == "0" else
                      "white" if shades[y][x] > 4.6 else "black")
    axes.set_xticks(range(len(measured.workloads)), measured.workloads, rotation=40, ha="right", fontsize=7.5)
    axes.set_yticks(range(len(measured.variants)), measured.variants, fontsize=7.5)
    axes.set_title("wrong regions by workload, parts per million of decided rays", fontsize=9)


def draw(measured, folder):
    figure = pyplot.figure(figsize=(11, 9.2), layout="constrained")
    grid = figure.add_gridspec(3, 2, height_ratios=[1.15, 0.1, 1])
    left, right, names, below = (figure.add_subplot(grid[place]) for place in
                                 ((0, 0), (0, 1), (1, slice(None)), (2, slice(None))))
    # One wrong ray among all stands at 1e6 / decided; the floor is below it.
    floor = 10 ** math.floor(math.log10(1e6 / measured.decided) - 0.3)
    left_out = scatter(left, measured, lambda t: t["wrong_ppm"], floor, f"none wrong of {measured.decided:,}",
                       measured.front_wrong, "decided rays with wrong regions, parts per million")
    scatter(right, measured, ulps, 0.01, "0.01 or less", measured.front_ulp,
            "distance error, condition-scaled ulp (99.9 % of ends)")
    heat_map(below, measured)
    names.axis("off")
    names.legend(*left.get_legend_handles_labels(), fontsize=7.5, loc="center", ncol=6, frameon=False, markerscale=0.8)
    words = "; ".join(f"{n}: {measured.timed[n]['ns_per_ray']:,.0f} ns" for n in left_out)
    fewer = f" Judged on fewer rays, so never ringed: {', '.join(measured.on_fewer)}." if measured.on_fewer else ""
    data = measured.data
    figure.suptitle(
        f"csgrt {data['csgrt']} on {measured.device}: kernels' time over {', '.join(data['timed_workloads'])}\n"
        f"(geometric mean, {data['size']} x {data['size']}, {measured.mode}). Ringed: each picture's Pareto front, "
        f"times within {100 * NOISE:.0f} % taken as equal.{fewer}" + (f"\nOff the chart: {words}." if words else ""),
        fontsize=9)
    for kind in ("svg", "png"):
        path = os.path.join(folder, f"{measured.name}.{kind}")
        # Without a date and a version the same figures give the same file.
        metadata = dict.fromkeys(("Creator", "Date", "Format", "Type")) if kind == "svg" else None
        figure.savefig(path + ".part", format=kind, dpi=100, metadata=metadata)
        os.replace(path + ".part", path)
        print(path)
    pyplot.close(figure)
    return os.path.join(folder, measured.name + ".svg")


def figure_of(value, digits=3):
    if value is None:
        return "-"
    return "0" if value == 0 else f"{value:,.0f}" if 100 <= abs(value) < 1e7 else f"{value:.{digits}g}"


def worst_places(measured, variant):
    rows = [measured.cells.get((variant, w), {}) for w in measured.workloads]
    rows = sorted((r for r in rows if r.get("wrong")), key=lambda r: -r["wrong_ppm"])
    return ", ".join(f"{r['workload']} {figure_of(r['wrong_ppm'])}" for r in rows[:3]) or "none"


def table(measured):
    default = measured.timed.get("default", {}).get("ns_per_ray")
    lines = ["<table><tr><th>method<th>ns a ray<th>of the default<th>wrong, ppm<th>wrong / decided"
             "<th>99.9 % of ends, ulp<th>worst, ulp<th>worst, mm<th>fails most at (ppm)<th>front<th>for"]
    for name in measured.variants:
        t = measured.totals[name]
        ns = t.get("ns_per_ray")
        lines.append("<tr><td>" + "<td>".join([
            html.escape(name), figure_of(ns), f"{ns / default:.2f}" if ns and default else "-",
            figure_of(t["wrong_ppm"]), f"{t['wrong']:,} / {t['decided']:,}", figure_of(t["error_ulp"]["p999"]),
            figure_of(t["error_ulp"]["worst"]), figure_of(t["error_mm"]["worst"]),
            html.escape(worst_places(measured, name)),
            "yes" if name in measured.front else "judge" if name == JUDGE else "", html.escape(USE.get(name, ""))]))
    return "\n".join(lines) + "</table>"


def verdict(measured):
    if "default" not in measured.totals:
        return "The default was not measured."
    t = measured.totals["default"]
    said = "is on" if "default" in measured.front else "is <b>not</b> on"
    text = (f"The default {said} the Pareto front of time, wrong regions and distance error: "
            f"{t['wrong']:,} of {t['decided']:,} decided rays wrong, {figure_of(ulps(t))} ulp for 99.9 % of the ends.")
    anchors = [f"{html.escape(name)} needs {ns:,.0f} ns a ray" for name, ns in measured.anchors()]
    def names(chosen):
        return ", ".join(n for n in measured.variants if n in chosen)
    text += (f" On the front: {names(measured.front)}; of time and wrong regions alone: {names(measured.front_wrong)}; "
             f"of time and distance error alone: {names(measured.front_ulp)}.")
    if measured.on_fewer:
        text += f" Judged on fewer rays, so not compared: {names(measured.on_fewer)}."
    if anchors:
        text += (" For first hits alone, over the same models, " + "; ".join(anchors) +
                 "; its accuracy was not measured in this run.")
    return text


PAGE = """<!doctype html><meta charset="utf-8"><title>csgrt: how fast, how exact</title>
<style>body{{font:16px/1.5 sans-serif;max-width:1150px;margin:2em auto;padding:0 1em}}img{{width:100%}}
table{{border-collapse:collapse;font-size:13px}}td,th{{border-bottom:1px solid #ddd;padding:.2em .6em;text-align:right}}
td:first-child,th:first-child,td:last-child,th:last-child,td:nth-child(9){{text-align:left}}</style>
<h1>csgrt: how fast, how exact</h1>
<h2>What to choose when</h2>
<ul>
<li><b>To measure, cut or check anything: the default.</b> Double precision, bracketed quartics; ends on one surface
are one.
<li><b>For pictures on a device with slow double precision: <code>--precision single</code>.</b> The heat map shows
where it errs. Its distance errors are some 10<sup>8</sup> times as large.
<li><b>To agree with BRL-CAD: <code>--tolerance 0.0005</code></b>, which its files contain. Thinner parts vanish.
<li><b>To ignore a file's tolerance and use its numbers as they are: <code>--tolerance surfaces</code>.</b>
<li><b>Never: <code>single-world</code>, <code>ferrari</code>, <code>bracketed-unshifted</code>,
<code>--tolerance none</code>.</b> They are here to show their failures. Use <code>--contraction on</code> only if the
bits of different devices need not agree.
</ul>
{devices}
<h2>How it is measured</h2>
<p>Every method shoots the same rays: a grid of the default view of each model and scene, and the rays of the stress
families. The judge is the reference in 113-bit arithmetic. A ray is decided if its regions stay the same when its
origin moves to four sides by some units in the last place, and when the tolerance for rounding is four times as large.
The other rays are ties. Rays on which a file's own tolerance makes other regions than its numbers are counted apart
(<code>rule</code>). A ray is wrong if it has another sequence of regions and gaps.</p>
<p>A distance error is given in units of how far the end moves when the ray moves by one unit in the last place. Double
precision cannot do better than about 1. The judge shares formulas and compiled scenes with what it judges. So errors of
scene compilation, such as the loss of very thin plates, do not show. The oracle (<code>tests/oracle</code>,
<code>tests/integration/stress</code>) judges the formulas.</p>
<p>Times are the device's own times of the kernels, medians of warm frames; the methods run in turn. Times of the two
methods on the CPU are wall time. Methods that do the same work differ by the machine's noise.</p>
"""


def page(measured, pictures, folder):
    parts = []
    for m, picture in zip(measured, pictures):
        with open(picture, "rb") as file:
            inline = base64.b64encode(file.read()).decode("ascii")
        parts.append(f"<h2>{html.escape(m.device)}</h2><p>{verdict(m)}</p>"
                     '<img alt="time against wrong regions and distance error" '
                     f'src="data:image/svg+xml;base64,{inline}">{table(m)}')
    path = os.path.join(folder, "index.html")
    with open(path + ".part", "w", encoding="utf-8") as file:
        file.write(PAGE.format(devices="\n".join(parts)))
    os.replace(path + ".part", path)
    print(path)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("measured", nargs="+", help="what csgrt_chart wrote, a file a device")
    arguments.add_argument("-o", "--output", default=".", help="folder for the pictures and the page")
    arguments.add_argument("--mode", default="every partition", choices=("first hits", "every partition"))
    options = arguments.parse_args()
    matplotlib.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "csgrt", "font.size": 8.5})
    os.makedirs(options.output, exist_ok=True)
    try:
        measured = [Measured(path, options.mode) for path in options.measured]
    except (OSError, ValueError, KeyError) as error:
        sys.exit(f"draw_chart.py: not a file that csgrt_chart wrote: {error}")
    page(measured, [draw(m, options.output) for m in measured], options.output)
    for m in measured:
        print(f"{m.device}: the Pareto front is {', '.join(n for n in m.variants if n in m.front)}")


if __name__ == "__main__":
    main()
