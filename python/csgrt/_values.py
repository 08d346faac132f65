"""What csgrt answers besides arrays: errors, warnings, regions."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple


class Place(NamedTuple):
    """A place in a file. Text has line and column (from 1; 0: unknown), binary formats the offset (-1: unknown)."""

    file: str
    line: int
    column: int
    offset: int
    pointer: str  #: a JSON pointer, or the name of an object


class Diagnostic(NamedTuple):
    """One finding of an Error: what is wrong, where, and what to do."""

    place: Place
    message: str
    suggestion: str
    excerpt: str


class Error(RuntimeError):
    """Every failure of csgrt.

    status: "usage", "scene", "no_device", "out_of_memory", "file", "device_fault", "differs" or "interrupted".
    diagnostics: all findings, at least one. place, suggestion: those of the first.
    """

    def __init__(self, message: str, status: str = "usage", diagnostics: Sequence[tuple] = ()):
        super().__init__(message)
        self.status = status
        self.diagnostics = [Diagnostic(Place(*place), *texts) for place, *texts in diagnostics]

    @property
    def place(self) -> Place | None:
        return self.diagnostics[0].place if self.diagnostics else None

    @property
    def suggestion(self) -> str:
        return self.diagnostics[0].suggestion if self.diagnostics else ""

    def __reduce__(self):  # from a process of multiprocessing to another
        findings = [(tuple(place), *texts) for place, *texts in self.diagnostics]
        return type(self), (str(self), self.status, findings)


class Warning(NamedTuple):  # noqa: A001
    """A fault that was tolerated: csgrt left something out or replaced it, and uses the rest as it is."""

    object: str  #: its name; "": the whole file, or a device
    place: Place
    reason: str
    count: int
    appearance: bool  #: it changes colours only, not what rays hit
    text: str  #: all of it on one line


class SceneWarning(UserWarning):
    """The Python warning that a scene has Warnings. Scene.warnings lists them."""


class Region(NamedTuple):
    """One region of a scene: a piece of one material."""

    id: int  #: the index in Scene.regions, which region_ids have
    path: str
    material: int  #: BRL-CAD's number of the material
    bounds: tuple  #: (low, high), mm; as BRL-CAD computes it, so not always tight
    color: tuple  #: red, green, blue; display values, 0 to 1
    state: str  #: "shown", "ghost" or "hidden"
    region_id: int  #: BRL-CAD's number of the region
    air: int
    los: int


class Solid(NamedTuple):
    """One solid of a scene. csgrt cuts a pipe into several: piece counts them from 0."""

    name: str
    type: str
    piece: int


class Regions(Sequence):
    """The regions of a scene, by id or by path. A table when printed."""

    def __init__(self, rows):
        self._rows = [Region(*row) for row in rows]
        self._by_path = {region.path: region for region in self._rows}

    def __len__(self):
        return len(self._rows)

    def __getitem__(self, key):
        return self._by_path[key] if isinstance(key, str) else self._rows[key]

    def __repr__(self):
        shown = self._rows if len(self) <= 40 else self._rows[:20] + self._rows[-20:]
        width = max([len(region.path) for region in shown], default=4)
        lines = [f"{'id':>6}  {'path':{width}}  material  bounds (mm)"]
        for region in shown:
            box = " to ".join("(" + ", ".join(f"{x:.6g}" for x in corner) + ")" for corner in region.bounds)
            lines.append(f"{region.id:6}  {region.path:{width}}  {region.material:8}  {box}")
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
    memory: int  #: bytes
    max_allocation: int  #: bytes
    compute_units: int
    fp64: bool


class Pick(NamedTuple):
    """What a picture shows at a pixel, and everything along its ray."""

    region_id: int  #: -1: nothing
    solid_id: int
    t: float  #: lengths of the ray's direction
    point: tuple  #: mm
    normal: tuple
    ray: tuple  #: origin, direction
    partitions: list  #: (region id, t_in, t_out) of all regions along the ray, hidden ones, too
