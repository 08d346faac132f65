"""Planted overlaps: pairs of regions of some 100 mm, whose overlap is known.

Of each kind it is known why no ball in the overlap is larger than `depth`, and that one of that diameter is there.
"""
import math
import random
from typing import NamedTuple

BODY = 100.0
DEPTHS = (1e-1, 1e-2, 1e-3, 1e-4)


class Planted(NamedTuple):
    """Solids and trees of csgrt's JSON. `regions` has the trees by their names, `pair` the two that overlap."""
    solids: dict
    regions: dict
    pair: tuple = ("first", "second")


def block(low, high):
    return {"type": "box", "low": list(low), "high": list(high)}


def ball(center, radius):
    return {"type": "sphere", "center": list(center), "radius": radius}


def rod(base, height, radius):
    return {"type": "cylinder", "base": list(base), "height": list(height), "radius": radius}


def turned_block(low, high, axes, lift=0):
    """A box whose sides are along three unit vectors, moved along z."""
    (x, y, z), (u, v, w) = low, high
    corners = [(x, y, z), (u, y, z), (u, v, z), (x, v, z), (x, y, w), (u, y, w), (u, v, w), (x, v, w)]
    return {"type": "arb8", "vertices": [
        [sum(c * axis[k] for c, axis in zip(corner, axes)) + lift * (k == 2) for k in range(3)] for corner in corners]}


PLATE = block((-60, -60, -20), (60, 60, 0))
ROOT = math.sqrt(0.5)
TURNED = [[ROOT, 0, ROOT], [0, 1, 0], [-ROOT, 0, ROOT]]  # by 45 degrees about y


def two(first, second):
    return Planted({"a": first, "b": second}, {"first": "a", "second": "b"})


# The overlap is a plate of that thickness.
def faces(depth):
    return two(PLATE, block((-40, -30, -depth), (40, 30, 60)))


# A cube's corner h below the face: the ball touches this and the corner's three faces, r + sqrt(3) r = h.
def corner_in_a_plate(depth):
    h, third = depth / 2 * (1 + math.sqrt(3)), math.sqrt(1 / 3)
    edges = [[math.sqrt(2 / 3), 0, third], [-math.sqrt(1 / 6), ROOT, third], [-math.sqrt(1 / 6), -ROOT, third]]
    return two(PLATE, turned_block((0, 0, 0), (60, 60, 60), edges, -h))


# Two right-angled edges that cross at a right angle, h deep: a tetrahedron, from whose middle each face is h / sqrt(8).
def edge_on_edge(depth):
    h = math.sqrt(2) * depth
    return two(turned_block((-50, -20, -20), (50, 0, 0), [[1, 0, 0], [0, ROOT, ROOT], [0, -ROOT, ROOT]], h / 2),
               turned_block((0, -50, 0), (20, 50, 20), TURNED, -h / 2))


# A tip h below the face: the ball touches this and the cone all around, r + r / sine = h.
def cones_tip(depth):
    sine = 50 / math.hypot(50, 100)
    h = depth / 2 * (1 + 1 / sine)
    return two(PLATE, {**rod((0, 0, 100 - h), (0, 0, -100), 50), "type": "cone", "top_radius": 0})


# A ring between two cylinders with one axis.
def shaft_in_a_hole(depth):
    return Planted({"body": block((-50, -50, -30), (50, 50, 30)), "hole": rod((0, 0, -50), (0, 0, 100), 20),
                    "shaft": rod((0, 0, -50), (0, 0, 100), 20 + depth)},
                   {"first": {"difference": ["body", "hole"]}, "second": "shaft"})


# A ball of the socket's radius R, moved by the depth: a centre p has |p| - R and R + depth - |p| to the two at most.
def ball_in_a_socket(depth):
    return Planted({"body": block((-60, -60, -60), (60, 60, 0)), "socket": ball((0, 0, 0), 40),
                    "ball": ball((0, 0, -depth), 40)},
                   {"first": {"difference": ["body", "socket"]}, "second": "ball"})


# It lies on the plate: the ball touches the face, and the torus at its lowest circle.
def torus(depth):
    return two(PLATE, {"type": "tor", "center": [0, 0, 10 - depth], "axis": [0, 0, 1], "radius": 40, "tube": 10})


# Two bars that cross at 30 degrees: a rhombic plate of that thickness, 12 wide.
def long_oblique_bar(depth):
    along = [[math.sqrt(0.75), 0.5, 0], [-0.5, math.sqrt(0.75), 0], [0, 0, 1]]
    return two(block((-200, -6, -12), (200, 6, 0)), turned_block((-200, -6, 0), (200, 6, 12), along, -depth))


# Cubes in contact, side x side x side, of which one near the middle is moved by the depth: a plate of that thickness.
def part_of_a_lattice(depth, side=5):
    middle, regions = side ** 3 // 2, {}
    for number in range(side ** 3):
        at = [20.0 * (number // side ** axis % side - side // 2) for axis in range(3)]
        regions[f"part{number}"] = {"object": "cube", "translate": [at[0] + depth * (number == middle), *at[1:]]}
    return Planted({"cube": block((-10, -10, -10), (10, 10, 10))}, regions, (f"part{middle}", f"part{middle + 1}"))


# 2,048 triangles whose vertices lie on a ball; one vertex h below the plate, between four triangles that are as steep.
# The ball touches the face and these four, r + r / cosine = h.
def mesh(depth):
    vertices, triangles = ball_of_triangles(50, 4)
    a, b, c = (vertices[i] for i in next(triangle for triangle in triangles if 0 in triangle))
    u, v = ([to - of for to, of in zip(end, a)] for end in (b, c))
    normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
    h = depth / 2 * (1 + math.hypot(*normal) / abs(normal[2]))
    return two(PLATE, {"type": "bot", "vertices": [[x, y, z + 50 - h] for x, y, z in vertices], "faces": triangles})


def ball_of_triangles(radius, level):
    """An octahedron whose faces are cut in four so many times. Vertex 0 is the lowest."""
    vertices = [(0, 0, -1), (1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0), (0, 0, 1)]
    triangles = [[0, 2, 1], [0, 3, 2], [0, 4, 3], [0, 1, 4], [5, 1, 2], [5, 2, 3], [5, 3, 4], [5, 4, 1]]
    for _ in range(level):
        middles, finer = {}, []
        for a, b, c in triangles:
            cut = []
            for edge in ((a, b), (b, c), (c, a)):
                key = min(edge), max(edge)
                if key not in middles:
                    middles[key] = len(vertices)
                    point = [sum(of) for of in zip(*(vertices[i] for i in key))]
                    vertices.append(tuple(x / math.hypot(*point) for x in point))
                cut.append(middles[key])
            ab, bc, ca = cut
            finer += [[a, ab, ca], [b, bc, ab], [c, ca, bc], cut]
        triangles = finer
    return [[radius * x for x in vertex] for vertex in vertices], triangles


# A wedge of 45 degrees and its mirror image, whose edges overlap by h: a triangle with the legs h / sqrt(2) and the
# base h, whose incircle has the diameter h / (1 + sqrt(2)).
def mirrored(depth):
    h = (1 + math.sqrt(2)) * depth
    wedge, away = {"difference": ["whole", "away"]}, turned_block((0, -50, -80), (80, 50, 80), TURNED)
    return Planted({"whole": block((-50, -40, 0), (0, 40, 50)), "away": away},
                   {"first": wedge, "second": {**wedge, "matrix": [-1, 0, 0, -h, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}})


# A rod through a tube's wall of that thickness.
def in_a_wall(depth):
    return Planted({"outer": rod((0, 0, -50), (0, 0, 100), 50), "inner": rod((0, 0, -60), (0, 0, 120), 50 - depth),
                    "bolt": rod((30, 0, 0), (40, 0, 0), 8)},
                   {"first": {"difference": ["outer", "inner"]}, "second": "bolt"})


KINDS = {
    "faces": faces, "corner in a plate": corner_in_a_plate, "edge on edge": edge_on_edge, "cone's tip": cones_tip,
    "shaft in a hole": shaft_in_a_hole, "ball in a socket": ball_in_a_socket, "torus": torus,
    "long oblique bar": long_oblique_bar, "part of a lattice": part_of_a_lattice, "mesh": mesh, "mirrored": mirrored,
    "in a wall": in_a_wall}


def random_turn(seed, at=(30, -20, 50)):
    """A matrix of csgrt's JSON: each rotation is as likely; then a move."""
    chance = random.Random(seed)
    q = [chance.gauss(0, 1) for _ in range(4)]
    w, x, y, z = (each / math.hypot(*q) for each in q)
    return [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), at[0],
            2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), at[1],
            2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y), at[2], 0, 0, 0, 1]


def scene_of_planted(all_planted):
    """csgrt's JSON of {name: (planted, matrix)}. Each is turned as a whole, so that what touches still does. A region's
    path is /NAME/REGION."""
    solids, combinations = {}, {}

    def named(name, tree):
        if isinstance(tree, str):
            return f"{name} {tree}"
        return {key: [named(name, operand) for operand in value] if key == "difference" else
                named(name, value) if key == "object" else value for key, value in tree.items()}
    for name, (planted, _) in all_planted.items():
        solids |= {f"{name} {key}": solid for key, solid in planted.solids.items()}
        for key, tree in planted.regions.items():
            combinations[f"{name} {key}"] = {"region": True, "tree": named(name, tree)}
        combinations[name] = {"tree": {"union": [{"object": f"{name} {key}", "name": key} for key in planted.regions]}}
    return {"csgrt": 1, "solids": solids, "combinations": combinations,
            "objects": [{"object": name, "matrix": matrix} for name, (_, matrix) in all_planted.items()]}
