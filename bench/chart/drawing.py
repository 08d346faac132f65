"""What the charts share: how their files are written, and how their pictures look."""
import json
import os
import re
import sys

HERE = os.path.dirname(os.path.abspath(__file__))


def load():
    """matplotlib's pyplot and ticker."""
    try:
        import matplotlib
        matplotlib.use("Agg")
        from matplotlib import pyplot, ticker
    except ImportError:
        sys.exit(f"{os.path.basename(sys.argv[0])}: matplotlib is not there (Debian, Ubuntu: apt-get install "
                 "python3-matplotlib)")
    matplotlib.rcParams.update({"font.size": 8.5})
    return pyplot, ticker


def save(data, path):
    """As csgrt_chart writes it: an element of a list a line."""
    def text(value):
        lines = isinstance(value, list) and value
        return "[\n" + ",\n".join(map(text, value)) + "]" if lines and isinstance(value[0], dict) else \
            json.dumps(value, separators=(",", ":"), ensure_ascii=False)
    with open(path + ".part", "w", encoding="utf-8") as file:
        file.write("{" + ",\n".join(f"{json.dumps(key)}: {text(value)}" for key, value in data.items()) + "}\n")
    os.replace(path + ".part", path)


def look(index, own):
    """Colour and mark of the method with that index. own: csgrt's default."""
    from matplotlib import colormaps
    return {"color": colormaps["tab20"].colors[(2 * index) % 20 + (2 * index) // 20 % 2],
            "marker": "*" if own else "os^Dvp"[index % 6], "markersize": 13 if own else 5}


def draw_front(axes, points):
    """A line along (time, error)."""
    points = sorted(points)
    axes.step([x for x, _ in points], [y for _, y in points], where="post", color="black", linestyle="--",
              linewidth=1.2, zorder=2, label="front")


def draw_floor(axes, floor, text, side="right"):
    """A line below which errors say nothing, such as that of errors that are 0."""
    axes.axhline(floor, color="0.85", linewidth=0.8, zorder=0)
    axes.text(0.99 if side == "right" else 0.01, floor, text, transform=axes.get_yaxis_transform(), ha=side,
              va="bottom", fontsize=7, color="0.4")


def draw_names(axes, panels, columns):
    """One legend for all panels."""
    handles = {}
    for panel in panels:
        handles.update(zip(*reversed(panel.get_legend_handles_labels())))
    axes.axis("off")
    axes.legend(handles.values(), handles.keys(), loc="center", ncol=columns, fontsize=7.5, frameon=False)


def write(figure, path):
    # Without a version the same figures give the same file.
    figure.savefig(path + ".part", format="png", dpi=100, metadata={"Software": None})
    os.replace(path + ".part", path)
    print(path)


def write_page(template, data, texts, folder):
    """index.html: `template` with the data, some texts by their names in it, and what all pages share."""
    try:
        from plotly.offline import get_plotlyjs
    except ImportError:
        sys.exit(f"{os.path.basename(sys.argv[0])}: the pictures are drawn, the page is not: plotly is not there "
                 "(Debian, Ubuntu: apt-get install python3-plotly)")

    def read(path):
        with open(path, encoding="utf-8") as file:
            return file.read()
    parts = {**texts, "STYLE": read(os.path.join(HERE, "page.css")), "HELPERS": read(os.path.join(HERE, "page.js")),
             "PLOTLY": get_plotlyjs().replace("</script", "<\\/script"),
             "DATA": json.dumps(data, separators=(",", ":")).replace("</", "<\\/")}
    text = re.sub(r"\b(" + "|".join(parts) + r")\b", lambda found: parts[found[0]], read(template))
    path = os.path.join(folder, "index.html")
    with open(path + ".part", "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(path + ".part", path)
    print(path)
