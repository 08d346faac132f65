"""Solids and Booleans in code. A Part is a value: each operation gives a new one."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from ._values import unmasked

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from numpy.typing import ArrayLike, NDArray
    from typing_extensions import Unpack

    from ._values import Material, ThreeNumbers


def translate(x: float | ThreeNumbers = 0, y: float = 0, z: float = 0) -> NDArray[np.float64]:
    """The (4, 4) matrix that moves by x, y, z mm: three numbers, or one sequence of three."""
    matrix = np.eye(4)
    matrix[:3, 3] = x if np.ndim(x) else (x, y, z)
    return matrix


def scale(x: float, y: float | None = None, z: float | None = None) -> NDArray[np.float64]:
    """The (4, 4) matrix that scales by x, or by x, y and z. A negative number mirrors."""
    return np.diag([x, x if y is None else y, x if z is None else z, 1.0])


def rotate(x: float = 0, y: float = 0, z: float = 0) -> NDArray[np.float64]:
    """The (4, 4) matrix that turns about x, then about y, then about z, degrees. Quarter turns are exact."""
    matrix = np.eye(4)
    for axis, degrees in enumerate((x, y, z)):
        quarters, rest = divmod(degrees, 90)
        c, s = math.cos(math.radians(rest)), math.sin(math.radians(rest))
        for _ in range(int(quarters) % 4):
            c, s = -s, c
        turn = np.eye(4)
        i, j = (axis + 1) % 3, (axis + 2) % 3
        turn[i, i], turn[i, j], turn[j, i], turn[j, j] = c, -s, s, c
        matrix = turn @ matrix
    return matrix


def _part(value: object) -> Part:
    if not isinstance(value, Part):
        raise TypeError(f"expected a Part, not {value!r}")
    return value


class Part:
    """A tree of solids: a | b or a + b is the union, a - b, a & b, and a ^ b the exclusive or.

    color() makes a region of a part. A Boolean with a coloured part keeps the colours of its first operand, and a union
    those of all.
    """

    # _kind: "solid" (_data: its members in JSON), "region" (_data: part, material), or an operator (_data: operands).
    __slots__ = ("_kind", "_data", "_matrix", "_coloured")

    def __init__(self, kind: str, data: Any, matrix: NDArray[np.float64] | None = None):
        self._kind, self._data = kind, data
        self._matrix = np.eye(4) if matrix is None else matrix
        self._coloured: bool = kind == "region" or (kind == "union" and any(part._coloured for part in data))

    def transform(self, matrix: ArrayLike) -> Part:
        """The part moved by a (4, 4) matrix on column vectors, in mm."""
        return Part(self._kind, self._data, np.asarray(unmasked(matrix, "a matrix's elements"), float) @ self._matrix)

    def translate(self, x: float | ThreeNumbers = 0, y: float = 0, z: float = 0) -> Part:
        """The part moved by x, y, z mm: three numbers, or one sequence of three."""
        return self.transform(translate(x, y, z))

    def rotate(self, x: float = 0, y: float = 0, z: float = 0) -> Part:
        """The part turned about the origin: about x, then about y, then about z, degrees."""
        return self.transform(rotate(x, y, z))

    def scale(self, x: float, y: float | None = None, z: float | None = None) -> Part:
        """The part scaled about the origin by x, or by x, y and z. A negative number mirrors."""
        return self.transform(scale(x, y, z))

    def color(self, rgb: ThreeNumbers, **finish: Unpack[Material]) -> Part:
        """All of the part as one region of this colour: red, green, blue; display values, 0 to 1.

        finish: members of a material in csgrt's JSON, such as specular=0.5, shine=20.
        """
        return Part("region", (self._plain(), {"color": [float(c) for c in rgb], **finish}))

    def __or__(self, other: Part) -> Part:
        return _join("union", self, _part(other))

    __add__ = __or__

    def __and__(self, other: Part) -> Part:
        return self._each(lambda part: _join("intersection", part, _part(other)._plain()))

    def __sub__(self, other: Part) -> Part:
        return self._each(lambda part: _join("difference", part, _part(other)._plain()))

    def __xor__(self, other: Part) -> Part:
        return _join("xor", self._plain(), _part(other)._plain())

    def _each(self, change: Callable[[Part], Part]) -> Part:
        """Changes each coloured part by itself, and keeps its colour."""
        if not self._coloured:
            return change(self)
        if self._kind == "region":
            part, material = self._data
            return Part("region", (change(part.transform(self._matrix)), material))
        return Part("union", tuple(part.transform(self._matrix)._each(change) for part in self._data))

    def _plain(self) -> Part:
        if not self._coloured:
            return self
        if self._kind == "region":
            part: Part = self._data[0]
            return part.transform(self._matrix)
        return Part("union", tuple(part._plain() for part in self._data), self._matrix)


def _join(operator: str, a: Part, b: Part) -> Part:
    # A long chain is one operator of many operands, since csgrt limits how deep trees nest.
    chain = a._kind == operator and (a._matrix == np.eye(4)).all() and (a._coloured or not b._coloured)
    return Part(operator, a._data + (b,) if chain else (a, b))


def solid(type: str, **members: object) -> Part:  # noqa: A002
    """Any solid of csgrt's JSON, with the members that scenes/README.md lists; lengths in mm.

    solid("tgc", base=(0, 0, 0), height=(0, 0, 9), a=(2, 0, 0), b=(0, 1, 0), c=(1, 0, 0), d=(0, 1, 0))
    """
    return Part("solid", {"type": type, **members})


def sphere(radius: float) -> Part:
    """A ball about the origin."""
    return solid("sphere", center=(0, 0, 0), radius=radius)


def box(size: float | ThreeNumbers, center: bool = False) -> Part:
    """A box of that size, a number or (x, y, z), from the origin on, or about it."""
    if np.shape(size) not in ((), (3,)):
        raise ValueError(f"the size of a box is a number or (x, y, z), not {size!r}")
    sides = np.broadcast_to(np.asarray(unmasked(size, "sides"), float), 3)
    low = -sides / 2 if center else np.zeros(3)
    return solid("box", low=low, high=low + sides)


def cylinder(height: float, radius_low: float, radius_high: float | None = None, center: bool = False) -> Part:
    """A cylinder along z from the origin on, or about it. radius_high: that of the top; default: radius_low."""
    low = (0, 0, -height / 2 if center else 0)
    axis: dict[str, object] = {"base": low, "height": (0, 0, height), "radius": radius_low}
    if radius_high is None:
        return solid("cylinder", **axis)
    return solid("cone", **axis, top_radius=radius_high)


def cone(height: float, radius_low: float, radius_high: float = 0, center: bool = False) -> Part:
    """A cone along z from the origin on, or about it, with its tip at the top, or cut there."""
    return cylinder(height, radius_low, radius_high, center)


def torus(radius: float, tube: float) -> Part:
    """A torus about z: the radius of the circle in the tube's middle, and the tube's own."""
    return solid("tor", center=(0, 0, 0), axis=(0, 0, 1), radius=radius, tube=tube)


class _Writer:
    """Writes parts as a scene in JSON. What occurs several times is one object."""

    def __init__(self) -> None:
        self.solids: dict[str, object] = {}
        self.combinations: dict[str, object] = {}
        # By the identity of a part's data, with the data, so that it keeps its identity.
        self.names: dict[int, tuple[str, object]] = {}
        self.counts: dict[str, int] = {}

    def leg(self, prefix: str, part: Part) -> str | dict[str, object]:
        name = self.named(prefix, part)
        if (part._matrix == np.eye(4)).all():
            return name
        return {"object": name, "matrix": part._matrix.ravel().tolist()}

    def named(self, prefix: str, part: Part) -> str:
        data = part._data
        if id(data) in self.names:
            return self.names[id(data)][0]
        kind = f"{prefix}.{data['type'] if part._kind == 'solid' else part._kind}"
        self.counts[kind] = self.counts.get(kind, 0) + 1
        name = f"{kind}{self.counts[kind]}"
        self.names[id(data)] = name, data
        if part._kind == "solid":
            self.solids[name] = data
        elif part._coloured:
            self.top(name, Part(part._kind, data))
        else:
            self.combinations[name] = {"tree": {part._kind: [self.leg(prefix, operand) for operand in data]}}
        return name

    def top(self, name: str, part: Part) -> None:
        """A region, or a combination of regions."""
        if part._kind == "region":
            inner, material = part._data
            tree = self.leg(name, inner.transform(part._matrix))
            self.combinations[name] = {"region": True, "material": material, "tree": tree}
        elif part._coloured:
            legs = [self.leg(name, p.transform(part._matrix)) for p in part._data if p._coloured]
            plain = tuple(p.transform(part._matrix) for p in part._data if not p._coloured)
            if plain:
                self.top(f"{name}.rest", Part("union", plain))
                legs.append(f"{name}.rest")
            self.combinations[name] = {"tree": {"union": legs}}
        else:
            self.combinations[name] = {"region": True, "tree": self.leg(name, part)}


def scene_text(parts: Mapping[str, Part]) -> str:
    """The JSON of a scene of these parts: each is a region, or a combination of regions, of that name."""
    import json

    writer = _Writer()
    for name, part in parts.items():
        writer.top(name, _part(part))
    scene = {"csgrt": 1, "solids": writer.solids, "combinations": writer.combinations, "objects": list(parts)}
    return json.dumps(scene, default=lambda value: unmasked(value, "a solid's numbers").tolist())


def shape_text(part: Part) -> str:
    """The JSON of a single solid, as the only leaf of a region."""
    if _part(part)._kind != "solid":
        raise ValueError("a solid is replaced by a single solid; add() takes any part")
    return scene_text({"part": part})
