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
