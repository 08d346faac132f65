"""What is measured: six bodies whose figures are known, and the six models; each as a tree of solids in the world.

A tree is a solid of csgrt's JSON, or (operator, operand, ...).
"""
import json
import math
import os
import tempfile
from typing import NamedTuple

import numpy as np


class Refused(Exception):
    """A method cannot hold a case: says why."""


class Case(NamedTuple):
    name: str
    tree: object = None
    volume: float = 0
    area: float = 0
    file: str = ""
    objects: tuple = ()


CENTRE = np.array([30.0, -20.0, 50.0])
MODELS = (("boolean-ops", "boolean-ops.asc", "all"), ("operators", "operators.asc", "operators"),
          ("truck", "truck.asc", "g1 g2 g4"), ("tank_car", "tank_car.asc", "tank_car"), ("havoc", "havoc.asc", "havoc"),
          ("goliath", "goliath.g", "Goliath.c"))


def bodies():
    def ball(radius):
        return {"type": "sphere", "center": CENTRE.tolist(), "radius": radius}

    def rod(axis):
        half = 9 * np.eye(3)[axis]
        return {"type": "cylinder", "base": (CENTRE - half).tolist(), "height": (2 * half).tolist(), "radius": 5.0}

    a, b = 0.7, 0.4  # the angles of the turned box
    turn = np.array([[math.cos(a), -math.sin(a), 0], [math.sin(a), math.cos(a), 0], [0, 0, 1]]) @ np.array(
        [[1, 0, 0], [0, math.cos(b), -math.sin(b)], [0, math.sin(b), math.cos(b)]])
    corners = np.array(box_corners((-3.5, -5.5, -6.5), (3.5, 5.5, 6.5))) @ turn.T + CENTRE
    octant = {"type": "box", "low": CENTRE.tolist(), "high": (CENTRE + 12).tolist()}
    pi, r, thin = math.pi, 10.0, 1e-4
    return [
        Case("ball", ball(r), 4 / 3 * pi * r ** 3, 4 * pi * r ** 2),
        Case("turned box", {"type": "arb8", "vertices": corners.tolist()}, 7 * 11 * 13, 2 * (77 + 143 + 91)),
        Case("torus", {"type": "tor", "center": CENTRE.tolist(), "axis": [0, 0, 1], "radius": r, "tube": 3.0},
             2 * pi ** 2 * r * 9, 4 * pi ** 2 * r * 3),
        Case("ball less box", ("difference", ball(r), octant), 7 / 6 * pi * r ** 3, (7 / 2 + 3 / 4) * pi * r ** 2),
        Case("Steinmetz solid", ("intersection", rod(0), rod(1)), 16 / 3 * 5 ** 3, 16 * 5 ** 2),
        Case("shell of 1e-4", ("difference", ball(r), ball(r * (1 - thin))),
             4 / 3 * pi * r ** 3 * thin * (3 - 3 * thin + thin ** 2), 4 * pi * r ** 2 * (1 + (1 - thin) ** 2)),
    ]


def models(folder):
    return [Case(name, file=os.path.join(folder, file), objects=tuple(objects.split()))
            for name, file, objects in MODELS]


def box_corners(low, high):
    """Eight corners in BRL-CAD's order."""
    (x, y, z), (u, v, w) = low, high
    return [(x, y, z), (u, y, z), (u, v, z), (x, v, z), (x, y, w), (u, y, w), (u, v, w), (x, v, w)]


def scene_of(case):
    """csgrt's scene of a case, with one thread."""
    import csgrt

    def part(tree):
        if isinstance(tree, dict):
            return csgrt.solid(**tree)
        first, *rest = map(part, tree[1:])
        for other in rest:
            first = {"union": first.__or__, "intersection": first.__and__, "difference": first.__sub__}[tree[0]](other)
        return first
    if case.file:
        return csgrt.load(case.file, case.objects, threads=1)
    return csgrt.Scene({"body": part(case.tree)}, threads=1)


def regions_of(case):
    """The trees of all regions, whose solids are ("ell", centre, axes), ("tgc", base, height, a, b, c, d),
    ("arb", points) or ("tor", centre, axis, radius, tube). Others raise Refused."""
    if case.tree is not None:
        return [placed(case.tree, np.eye(4), {}, {})]
    with tempfile.TemporaryDirectory() as folder:
        scene_of(case).save(os.path.join(folder, "scene.json"))
        with open(os.path.join(folder, "scene.json"), encoding="utf-8") as file:
            scene = json.load(file)
    found, combinations = [], scene["combinations"]

    def walk(tree, matrix):
        name, matrix = leg(tree, matrix)
        inner = combinations.get(name, {})
        if name is None and "union" in tree:
            for operand in tree["union"]:
                walk(operand, matrix)
        elif "tree" in inner and not inner.get("region"):
            walk(inner["tree"], matrix)
        elif not inner.get("air") and inner.get("tree", name):
            found.append(placed(name or tree, matrix, scene["solids"], combinations))
    for name in case.objects:
        walk(name, np.eye(4))
    return found


def leg(tree, matrix):
    """The name of the object that an operand is (None: an operator), and its matrix in the world."""
    if isinstance(tree, str):
        return tree, matrix
    if {"scale", "rotate", "postfix"} & set(tree):
        raise Refused("not translated: a placement that is no matrix")
    move = np.reshape(tree.get("matrix", np.eye(4)), (4, 4)).astype(float)
    move[:3, 3] += tree.get("translate", 0)
    return tree.get("object"), matrix @ move


def placed(tree, matrix, solids, combinations):
    """A tree of csgrt's JSON, or of a case, with its solids in the world."""
    if isinstance(tree, tuple):
        return (tree[0], *(placed(operand, matrix, solids, combinations) for operand in tree[1:]))
    if isinstance(tree, dict) and "type" in tree:
        return solid(tree, matrix)
    name, matrix = leg(tree, matrix)
    if name in solids:
        return solid(solids[name], matrix)
    if name is not None:
        return placed(combinations[name]["tree"], matrix, solids, combinations)
    operator = next(o for o in ("union", "intersection", "difference", "xor", "not") if o in tree)
    if operator in ("xor", "not"):
        raise Refused(f"not translated: the operator {operator}")
    return (operator, *(placed(operand, matrix, solids, combinations) for operand in tree[operator]))


def solid(shape, matrix):
    turn, kind = matrix[:3, :3], shape["type"]

    def point(key):
        return turn @ shape[key] + matrix[:3, 3]

    def vectors(*keys):
        return [turn @ shape[key] for key in keys]
    if kind in ("sphere", "ell"):
        axes = shape["radius"] * turn.T if kind == "sphere" else vectors("a", "b", "c")
        return ("ell", point("center"), np.array(axes))
    if kind == "tgc":
        return ("tgc", point("base"), *vectors("height", "a", "b", "c", "d"))
    if kind in ("cylinder", "cone"):
        height = np.array(shape["height"], float)
        a = np.cross(height, np.eye(3)[np.argmin(abs(height))])
        b = np.cross(height, a)
        a, b = (shape["radius"] * turn @ v / np.linalg.norm(v) for v in (a, b))
        top = shape.get("top_radius", shape["radius"]) / shape["radius"]
        return ("tgc", point("base"), turn @ height, a, b, top * a, top * b)
    if kind == "box" or kind.startswith("arb") and kind != "arbn":
        points = np.array(box_corners(shape["low"], shape["high"]) if kind == "box" else shape["vertices"], float)
        return ("arb", points @ turn.T + matrix[:3, 3])
    if kind == "tor":
        scale = abs(np.linalg.det(turn)) ** (1 / 3)
        axis = turn @ shape["axis"]
        return ("tor", point("center"), axis / np.linalg.norm(axis), scale * shape["radius"], scale * shape["tube"])
    raise Refused(f"not translated: a solid of type {kind}")
