"""What csgrt answers besides arrays: errors, warnings, regions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from operator import index
from typing import TYPE_CHECKING, Any, NamedTuple, SupportsIndex, TypedDict, TypeVar, overload

import numpy as np

from ._core import (
    child_members, device_members, overlap_members, region_members, solid_members, unlisted_members,
)


class DeviceName(str):
    """Part of a device's or a platform's name, or choices with commas between them, as a value of the setting `device`:
    device=DeviceName("PoCL"). At run time any string will do; type checkers take one for a misspelled word."""


if TYPE_CHECKING:  # numpy.typing takes as long to load as csgrt
    import os
    from collections.abc import Callable, Iterable, Iterator
    from typing import Literal, Union

    from numpy.typing import NDArray

    from ._core import Fastgen, Operator, State, Status

    DeviceChoice = Union[int, Literal["", "cpu", "gpu", "gpus"], DeviceName]
    ThreeNumbers = Union[Sequence[float], NDArray[np.floating[Any]], NDArray[np.integer[Any]]]
    TwoPoints = Union[Sequence[ThreeNumbers], NDArray[np.floating[Any]], NDArray[np.integer[Any]]]
    Triple = tuple[float, float, float]
    Bounds = tuple[Triple, Triple]
    AllowedPairs = Union[Sequence[tuple[str, str]], str, os.PathLike[str]]

T = TypeVar("T")


def _describe(kind: Any, **members: str) -> None:
    """Gives the members of a NamedTuple docstrings. Those that their names describe have none."""
    for name, sentence in {**dict.fromkeys(kind._fields, ""), **members}.items():
        getattr(kind, name).__doc__ = sentence


def did_you_mean(wrong: str, known: Iterable[str]) -> str:
    """What a sentence about an unknown name ends with: the nearest known one, if any is near."""
    from difflib import get_close_matches

    near = [name for name in known if name.endswith(wrong)] or get_close_matches(wrong, known)
    return f": did you mean {near[0]!r}?" if near else ""


def unmasked(values: T, what: str) -> T:
    """The values. Raises ValueError for an array of numpy.ma that masks some: numpy would hand them over unmasked."""
    is_masked: Callable[[object], bool] = np.ma.is_masked  # numpy 2.2 gives it no types
    if is_masked(values):
        raise ValueError(f"{what} are masked in part, and csgrt knows no masks: give compressed() or filled() arrays")
    return values


class Place(NamedTuple):
    """A place in a file. Text has line and column (from 1; 0: unknown), binary formats the offset (-1: unknown)."""

    file: str
    line: int
    column: int
    offset: int
    pointer: str


_describe(Place, pointer="A JSON pointer, or the name of an object")


class Diagnostic(NamedTuple):
    """One finding of an Error: what is wrong, where, and what to do."""

    place: Place
    message: str
    suggestion: str
    excerpt: str


_describe(Diagnostic)


class Error(RuntimeError):
    """A failure of csgrt. Wrong types, shapes, paths and ids raise TypeError, ValueError, KeyError and IndexError.

    status: "usage", "scene", "no_device", "out_of_memory", "file", "device_fault", "differs" or "interrupted".
    diagnostics: all findings, at least one. place, suggestion: those of the first.
    """

    def __init__(self, message: str, status: Status = "usage", diagnostics: Sequence[tuple[Any, ...]] = ()):
        super().__init__(message)
        self.status: Status = status
        self.diagnostics: list[Diagnostic] = [Diagnostic(Place(*place), *texts) for place, *texts in diagnostics]

    @property
    def place(self) -> Place | None:
        return self.diagnostics[0].place if self.diagnostics else None

    @property
    def suggestion(self) -> str:
        return self.diagnostics[0].suggestion if self.diagnostics else ""

    def __reduce__(self) -> tuple[Any, ...]:  # from a process of multiprocessing to another
        findings = [(tuple(place), *texts) for place, *texts in self.diagnostics]
        return type(self), (str(self), self.status, findings)


class Warning(NamedTuple):  # noqa: A001
    """A fault that was tolerated: csgrt left something out or replaced it, and uses the rest as it is."""

    object: str
    place: Place
    reason: str
    count: int  # type: ignore[assignment]  # a tuple has a method of that name
    appearance: bool
    text: str


_describe(Warning, object='Its name; "": the whole file, or a device', text="All of it on one line",
          appearance="It changes colours only, not what rays hit")


class SceneWarning(UserWarning):
    """The Python warning that a scene has Warnings. Scene.warnings lists them."""


class Region(NamedTuple):
    """One region of a scene: a piece of one material. To change it: scene[path].color, .state, ..., then commit().

    Its number in csgrt is id, the index in Scene.regions. The region_ids of rays and points and Pick.region_id are this
    number, -1 for a miss; Image.region_ids is id + 1, 0 for a miss. The member region_id is BRL-CAD's number, which no
    array has.
    """

    id: int
    path: str
    fastgen: Fastgen
    region_id: int
    air: int
    material_id: int
    los: int
    color: Triple
    state: State
    bounds: Bounds


_describe(Region, id="The index in Scene.regions", **region_members)


class Solid(NamedTuple):
    """One solid of a scene."""

    name: str
    type: str
    piece: int


_describe(Solid, **solid_members)


class Child(NamedTuple):
    """A leg of a combination, or an object that is rendered."""

    path: str
    name: str
    object: str
    type: str
    op: Operator | Literal["not"]


_describe(Child, **child_members)


class Regions(Sequence[Region]):
    """The regions of a scene, by id or by path. A table when printed.

    Raises IndexError for negative ids, since -1 is a miss, and KeyError for unknown paths.
    """

    def __init__(self, rows: Iterable[tuple[Any, ...]]):
        self._rows = [Region(*row) for row in rows]
        self._by_path = {region.path: region for region in self._rows}

    def __len__(self) -> int:
        return len(self._rows)

    @overload
    def __getitem__(self, key: str | SupportsIndex) -> Region: ...
    @overload
    def __getitem__(self, key: slice) -> list[Region]: ...
    def __getitem__(self, key: str | SupportsIndex | slice) -> Region | list[Region]:
        if isinstance(key, str):
            path = "/" + key.removeprefix("/")
            if path not in self._by_path:
                if below := self.below(path):
                    raise KeyError(f"{key!r} is not a region: {len(below)} regions lie below it, as {below[0].path!r}")
                raise KeyError(f"no region has the path {key!r}" + did_you_mean(path, self._by_path))
            return self._by_path[path]
        if not isinstance(key, slice) and index(key) < 0:
            raise IndexError(f"no region has the id {key}; -1 is a miss")
        return self._rows[key]

    def below(self, path: str) -> list[Region]:
        """The regions at a path or below it; "/": all."""
        start = "/" + path.strip("/")
        return [r for r in self._rows if start == "/" or r.path == start or r.path.startswith(start + "/")]

    def __repr__(self) -> str:
        shown = self._rows if len(self) <= 40 else self._rows[:20] + self._rows[-20:]
        width = max([len(region.path) for region in shown], default=4)
        lines = [f"{'id':>6}  {'path':{width}}  material  bounds (mm)"]
        for region in shown:
            box = " to ".join("(" + ", ".join(f"{x:.6g}" for x in corner) + ")" for corner in region.bounds)
            lines.append(f"{region.id:6}  {region.path:{width}}  {region.material_id:8}  {box}")
        if len(self) > len(shown):
            lines.insert(21, f"   ...  {len(self) - len(shown)} more")
        return "\n".join(lines)


class Device(NamedTuple):
    """A device, as its driver describes it. Its index in devices() is a choice for the setting `device`."""

    name: str
    platform: str
    version: str
    driver: str
    type: str
    memory: int
    max_allocation: int
    compute_units: int
    fp64: bool


_describe(Device, **device_members)


class Pick(NamedTuple):
    """What a picture shows at a pixel, and everything along its ray."""

    region_id: int
    solid_id: int
    t: float
    point: Triple
    normal: Triple
    ray: tuple[Triple, Triple]
    partitions: list[tuple[int, float, float]]


_describe(Pick, region_id="The index in Scene.regions; -1: nothing", solid_id="The index in Scene.solids; -1: nothing",
          t="Lengths of the ray's direction", point="mm", normal="Unit, outward from the region",
          ray="Origin, direction", partitions="(index in Scene.regions, t_in, t_out) of all regions along the ray, "
          "hidden ones, too")


class Hits(TypedDict):
    """What Scene.cast_rays() answers, which tells shapes and units. It has solid_ids and normals if they are asked."""

    t_hit: NDArray[np.float64]
    region_ids: NDArray[np.int32]
    solid_ids: NDArray[np.int32]
    normals: NDArray[np.float64]


class Partitions(TypedDict):
    """What Scene.partitions() answers, which tells shapes and units. It has ray_splits, region_ids, t_in and t_out, and
    what else is asked."""

    ray_splits: NDArray[np.int64]
    region_ids: NDArray[np.int32]
    t_in: NDArray[np.float64]
    t_out: NDArray[np.float64]
    in_solids: NDArray[np.int32]
    out_solids: NDArray[np.int32]
    in_normals: NDArray[np.float64]
    out_normals: NDArray[np.float64]
    overlap_splits: NDArray[np.int64]
    overlap_t_in: NDArray[np.float64]
    overlap_t_out: NDArray[np.float64]
    overlap_region_splits: NDArray[np.int64]
    overlap_region_ids: NDArray[np.int32]


class Verification(TypedDict):
    """What Scene.verify() answers."""

    passed: bool
    device: str
    rays: int
    hits: int
    decided: int
    ties: int
    wrong: int
    bit_differences: int
    ends: int
    farthest_mm: float
    worst_ulps: float


class Estimate(NamedTuple):
    """A number, and half the width of the interval that holds the true one in 95 of 100 measures."""

    nominal: float
    half_width: float


_describe(Estimate)


class Wall(NamedTuple):
    """The smallest wall of a part: thickness in mm, its ends, and whether its faces are not parallel there."""

    thickness: float
    start: Triple
    end: Triple
    is_tapered: bool


_describe(Wall)


class Measured(NamedTuple):
    """The figures of one region, or of several together.

    kind: "all", "assembly", "material" or "region". name: a path, or a material's name. id: of a region its id, of a
    material its number, else -1. volume (what the regions own), claimed (an overlap counts for each claimant): mm^3;
    area: mm^2; mass: kg, 0 without densities; centroid: x, y, z, mm. origin, central: moments xx, yy, zz and products
    xy, yz, zx of inertia about the origin and the centroid: kg mm^2, without densities mm^5. box: (low, high), mm.
    regions, reached, unmet, weightless: numbers of regions: all, those that have reached the error, those that no ray
    has met, those without a density. unmet_bound: mm^3, what the unmet ones may have at most. thin: the number of
    regions with a wall below wall_limit. wall: the smallest wall, if walls=True; None: there is none.
    """

    kind: str
    name: str
    id: int
    volume: Estimate
    claimed: Estimate
    area: Estimate
    mass: Estimate
    centroid: tuple[Estimate, ...]
    origin: tuple[Estimate, ...]
    central: tuple[Estimate, ...]
    box: Bounds
    regions: int
    reached: int
    unmet: int
    weightless: int
    unmet_bound: float
    thin: int
    wall: Wall | None


_describe(Measured)


class CellVolumes(NamedTuple):
    """The volumes of regions, or materials, in the n cells that have some, in the order of ids, z, y, x.

    cells: (n, 3) int32, numbers along x, y and z from 0. ids: (n,) int32, ids of regions or numbers of materials.
    volumes, half_widths of their 95 % intervals: (n,) float64, mm^3.
    """

    cells: NDArray[np.int32]
    ids: NDArray[np.int32]
    volumes: NDArray[np.float64]
    half_widths: NDArray[np.float64]


_describe(CellVolumes)


class MeasuredGrid(NamedTuple):
    """The volumes in the cells of a grid. shape: numbers of cells along x, y and z. box: (low, high), mm."""

    shape: tuple[int, int, int]
    box: Bounds
    regions: CellVolumes
    materials: CellVolumes


_describe(MeasuredGrid)


class Measurement:
    """What Scene.measure() answers. measurement[path] is a part; measurement["all"] is all together.

    parts: all together, assemblies, materials, regions. grid: None without grid=(nx, ny, nz). has_densities: whether
    there are masses. reached: whether each region has reached the error, or with rays=N whether all rays were traced.
    rays: how many were traced. seconds: what it took.
    """

    def __init__(self, rows: Iterable[Any], grid: Any, has_densities: bool, reached: bool, rays: int, seconds: float):
        def estimates(pairs: Iterable[Any]) -> tuple[Estimate, ...]:
            return tuple(Estimate(*pair) for pair in pairs)

        self.parts: list[Measured] = [
            Measured._make((kind, name, number, *estimates(figures), *map(estimates, moments), *rest,
                            Wall(*wall) if wall else None))
            for kind, name, number, figures, moments, *rest, wall in rows]
        self.grid: MeasuredGrid | None = None
        if grid:
            shape, box, regions, materials = grid
            self.grid = MeasuredGrid(shape, box, CellVolumes(*regions), CellVolumes(*materials))
        self.has_densities: bool = has_densities
        self.reached: bool = reached
        self.rays: int = rays
        self.seconds: float = seconds
        self._by_name: dict[str, Measured] = {part.name: part for part in reversed(self.parts)}

    def __getitem__(self, name: str) -> Measured:
        try:
            return self._by_name[name]
        except KeyError:
            raise KeyError(f"no part {name!r}{did_you_mean(name, self._by_name)}") from None

    @property
    def volume(self) -> dict[str, Estimate]:
        """The volumes of all parts by their names, mm^3."""
        return {name: part.volume for name, part in self._by_name.items()}

    @property
    def mass(self) -> dict[str, Estimate]:
        """The masses of all parts by their names, kg."""
        return {name: part.mass for name, part in self._by_name.items()}


class FoundOverlap(NamedTuple):
    """Two regions that overlap."""

    paths: tuple[str, str]
    link: str
    regions: tuple[int, int]
    place: Triple
    depth: float
    is_estimate: bool
    depth_at_most: float
    volume: Estimate
    box: Bounds
    ray: tuple[Triple, Triple]
    t_in: float
    t_out: float
    is_allowed: bool
    is_near_limit: bool
    is_new: bool


_describe(FoundOverlap, paths="Those of the regions",
          link="Behind the address that `csgrt view` prints it leads to the overlap", **overlap_members)


class UnlistedPair(NamedTuple):
    """Two regions whose boxes overlap, which are not among the overlaps that a check lists."""

    paths: tuple[str, str]
    regions: tuple[int, int]
    is_seen: bool
    depth_at_most: float


_describe(UnlistedPair, paths="Those of the regions", **unlisted_members)


class CheckResult:
    """What Scene.check() answers: its overlaps, the deepest first. It is false if there are none.

    overlaps: those at least half of the least depth deep. unlisted: an UnlistedPair for each other pair whose boxes
    overlap, the largest depth_at_most first. unused: rows of `allowed` that no overlap needs. unbounded:
    paths of regions without an end, which were searched within the box of the others. new_overlaps: the number of
    those that are new. candidates: the number of pairs whose boxes overlap. shallow: the number of pairs that overlap
    by less than half of the least depth. rays: how many were traced. is_complete: always True, since Ctrl-C raises
    KeyboardInterrupt. seconds: what it took.
    """

    new_overlaps: int
    candidates: int
    shallow: int
    rays: int
    is_complete: bool
    seconds: float

    def __init__(self, rows: Iterable[Any], unlisted: Iterable[Any], unused: list[tuple[str, str]],
                 unbounded: list[str], numbers: Mapping[str, Any]):
        overlaps = [FoundOverlap(*row) for row in rows]
        self.overlaps: list[FoundOverlap] = [o._replace(volume=Estimate(*o.volume)) for o in overlaps]
        self.unlisted: list[UnlistedPair] = [UnlistedPair(*pair) for pair in unlisted]
        self.unused: list[tuple[str, str]] = unused
        self.unbounded: list[str] = unbounded
        vars(self).update(numbers)

    def __iter__(self) -> Iterator[FoundOverlap]:
        return iter(self.overlaps)

    def __len__(self) -> int:
        return len(self.overlaps)

    @property
    def new(self) -> list[FoundOverlap]:
        """The overlaps that are not allowed, and at least the least depth deep."""
        return [overlap for overlap in self.overlaps if overlap.is_new]


class Material(TypedDict, total=False):
    """Members of a material in csgrt's JSON, besides its colour: what Part.color() and Subtree.finish take."""

    specular: float
    diffuse: float
    ambient: float
    shine: int
    transmit: float
    reflect: float
    light: Mapping[str, object]
