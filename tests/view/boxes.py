"""The model that the tests of the page look at."""
import json

# Seen from +x (azimuth 0): front.r, a gap of 10 mm, twin.r, which overlaps back.r from x = 20 to x = 40.
BOXES = {"front": ([60, -50, -50], [80, 50, 50], [0.8, 0.1, 0.1]),
         "back": ([0, -60, -60], [40, 60, 60], [0.1, 0.8, 0.1]),
         "twin": ([20, -40, -40], [50, 40, 40], [0.1, 0.1, 0.9])}
HOSTILE = "<img src=x onerror=document.title='broken'>.r"


def scene(**boxes):
    boxes = {**BOXES, **boxes}
    region = {n + ".r": {"tree": n, "region": True, "id": 100 + i, "material": n} for i, n in enumerate(boxes)}
    made = {"csgrt": 1, "title": "Three boxes",
            "camera": {"azimuth": 0, "elevation": 0, "center": [40, 0, 0], "size": 200}, "ambient": 1,
            "materials": {n: {"color": c, "diffuse": 0.2, "specular": 0} for n, (_, _, c) in boxes.items()},
            "solids": {n: {"type": "box", "low": low, "high": high} for n, (low, high, _) in boxes.items()},
            "combinations": {**region, HOSTILE: {"tree": {"intersection": ["front", "back"]}, "region": True, "id": 7},
                             "pair": {"tree": {"union": ["back.r", "twin.r"]}},
                             "all": {"tree": {"union": [*(n for n in region if n not in ("back.r", "twin.r")), "pair",
                                                        HOSTILE]}}}}
    return json.dumps(made)


def bodies():
    """Bodies of known sizes at y = 0, 20, 40, ..., seen from +x. All but three of them are turned."""
    solids = {"ball": {"type": "sphere", "center": [0, 0, 0], "radius": 7.3},
              "egg": {"type": "ell", "center": [0, 0, 0], "a": [3, 0, 0], "b": [0, 5, 0], "c": [0, 0, 7]},
              "rod": {"type": "cylinder", "base": [0, 0, -10], "height": [0, 0, 20], "radius": 4.7},
              "cone": {"type": "cone", "base": [0, 0, -5], "height": [0, 0, 10], "radius": 6, "top_radius": 2},
              "ring": {"type": "tor", "center": [0, 0, 0], "axis": [1, 0, 0], "radius": 8, "tube": 2.1},
              "block": {"type": "box", "low": [-4, -5, -6], "high": [4, 5, 6]},
              "pill": {"type": "part", "base": [0, 0, -3], "height": [0, 0, 6], "radius": 4, "top_radius": 3},
              "bowl": {"type": "epa", "base": [0, 0, -5], "height": [0, 0, 10], "a": [1, 0, 0], "r1": 6, "r2": 6},
              "horn": {"type": "ehy", "base": [0, 0, -5], "height": [0, 0, 10], "a": [1, 0, 0], "r1": 6, "r2": 5,
                       "c": 2},
              "waist": {"type": "hyp", "base": [0, 0, -6], "height": [0, 0, 12], "a": [5, 0, 0], "b": 5, "neck": 0.6},
              "nut": {"type": "superell", "center": [0, 0, 0], "a": [5, 0, 0], "b": [0, 6, 0], "c": [0, 0, 7],
                      "n": 0.5, "e": 0.5},
              "oval": {"type": "eto", "center": [0, 0, 0], "axis": [1, 0, 0], "radius": 7, "c": [3, 0, 0], "d": 2},
              "plate": {"type": "box", "low": [-3, -5, -5], "high": [3, 5, 5]},
              "behind": {"type": "box", "low": [-3, -5, -5], "high": [-0.7, 5, 5]},
              "tilted": {"type": "box", "low": [-3, -5, -5], "high": [3, 5, 5]}}
    turns = {**dict.fromkeys(solids, {"axis": [1, 2, 3], "angle": 40}), "tilted": {"axis": [0, 0, 1], "angle": 30}}
    for name in ("ball", "plate", "behind"):
        turns[name] = {"axis": [1, 0, 0], "angle": 0}
    legs = [{"object": name + ".r", "translate": [0, 20 * i, 0], "rotate": turns[name]}
            for i, name in enumerate(solids)]
    return json.dumps({
        "csgrt": 1, "camera": {"azimuth": 0, "elevation": 0, "center": [0, 140, 0], "size": 310}, "solids": solids,
        "combinations": {**{name + ".r": {"tree": name, "region": True, "id": i} for i, name in enumerate(solids)},
                         "all": {"tree": {"union": legs}}}})
