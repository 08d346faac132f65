"""Scenes: load, ask, edit."""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Iterable, Mapping
from operator import index
from typing import TYPE_CHECKING, Any, NoReturn, SupportsIndex

import numpy as np

from . import _core
from ._image import Image
from ._page import Page
from ._solids import Part, scene_text, shape_text, sphere
from ._values import (
    CheckResult, Child, Measurement, Pick, Place, Region, Regions, SceneWarning, Solid, Warning, did_you_mean, unmasked,
)

if TYPE_CHECKING:
    from typing import Union

    from numpy.typing import ArrayLike, NDArray
    from typing_extensions import Unpack

    from ._core import Operator, State
    from ._values import Hits, Material, Partitions, ThreeNumbers, Triple

    Name = Union[str, os.PathLike[str]]

# What members take, by their annotations in the stub.
_TAKEN = {"float": "a number", "int": "a whole number", "bool": "True or False", "str": "a string",
          "float | None": "a number or None", "csgrt._values.DeviceChoice": "a number or a name",
          "csgrt._values.ThreeNumbers | None": "three numbers or None",
          "csgrt._values.AllowedPairs": "a list of pairs of patterns of paths, or a file's path",
          "dict[int | str, float]": "a dict of g/cm^3 by numbers of materials or by paths",
          "collections.abc.Sequence[tuple[csgrt._values.ThreeNumbers, float]]": "a list of (normal, distance)"}


def _assign(members: Mapping[str, object], what: str, *targets: object) -> None:
    """Each member's value becomes that of the first target that has the member. Raises TypeError."""
    for name, value in members.items():
        target = next((t for t in targets if not name.startswith("_") and hasattr(t, name)), None)
        if target is None:
            known = [name for t in targets for name in dir(t) if not name.startswith("_")]
            near = did_you_mean(name, known) or "; there are " + ", ".join(known)
            raise TypeError(f"{what} {name}{near}")
        try:
            setattr(target, name, value)
        except TypeError:
            taken = getattr(type(target), name).fset.__doc__.split("arg: ")[1].split(", /")[0]
            taken = _TAKEN.get(taken, taken.replace("typing.Literal", "one of "))
            raise TypeError(f"{name}: expected {taken}, not {value!r}") from None


def _settings(given: _core.SettingsKeywords) -> _core.Settings:
    settings = _core.Settings()
    _assign(given, "csgrt has no setting", settings)
    return settings


def _doubles(values: ArrayLike, last: int, what: str) -> NDArray[np.float64]:
    """The values as they are, if they are float64 in C order; else a copy."""
    if isinstance(values, np.ndarray) and values.dtype.kind == "c":
        raise TypeError(f"{what} are real, not {values.dtype}")
    array = np.ascontiguousarray(unmasked(values, what), np.float64)
    if array.shape[-1] != last:
        raise ValueError(f"{what} have the shape (..., {last}), not {array.shape}")
    return array


def _range(rays: NDArray[np.float64], tnear: ArrayLike,
           tfar: ArrayLike) -> tuple[float, float, NDArray[np.float64] | None]:
    """near, far, and in their place a list of both, if one of them is an array."""
    if np.ndim(tnear) == 0 and np.ndim(tfar) == 0:
        return float(tnear), float(tfar), None  # type: ignore[arg-type]
    ranges = np.empty(rays.shape[:-1] + (2,))
    for i, (name, end) in enumerate((("tnear", tnear), ("tfar", tfar))):
        end = unmasked(end, f"elements of {name}")
        try:
            ranges[..., i] = end
        except ValueError:
            raise ValueError(f"{name} has the shape {np.shape(end)}, and the rays have {ranges.shape[:-1]}") from None
    return 0.0, 0.0, ranges


def _parse(text: str | bytes, name: str = "scene", strict: bool = False,
           file_folders: Iterable[Name] = ()) -> _core.Source:
    contents = text.encode() if isinstance(text, str) else text
    return _core.parse(contents, name, strict, [os.fspath(folder) for folder in file_folders])


class Subtree:
    """The object at the end of a path, in its place. Changes take effect with Scene.commit()."""

    __slots__ = ("_scene", "path")

    def __init__(self, scene: Scene, path: str):
        self._scene: Scene = scene
        self.path: str = path

    @property
    def color(self) -> Triple:
        """Of a region: red, green, blue; display values, 0 to 1. Set: of all regions below the path, here alone."""
        return self._scene.regions[self.path].color

    @color.setter
    def color(self, rgb: ThreeNumbers) -> None:
        self._scene._set_color(self.path, rgb)

    @property
    def state(self) -> State:
        """Of a region: "shown", "ghost" or "hidden". Set: as color."""
        return self._scene.regions[self.path].state

    @state.setter
    def state(self, state: State) -> None:
        self._scene._set_state(self.path, state)

    @property
    def finish(self) -> NoReturn:
        """Set: a dict of specular, diffuse, ambient, shine, as in csgrt's JSON."""
        raise AttributeError("finish can be set, not read")

    @finish.setter
    def finish(self, members: Material) -> None:
        part = sphere(1).color((1, 1, 1), **members)
        self._scene._set_finish(self.path, _parse(scene_text({"finish": part})))

    @property
    def bounds(self) -> NDArray[np.float64]:
        """(2, 3) float64: the low and the high corner of the box around the boxes of all regions at or below the path,
        mm. Raises KeyError if there are none."""
        boxes = np.array([region.bounds for region in self._scene.regions.below(self.path)])
        if not len(boxes):
            raise KeyError(f"no region lies at or below {self.path!r}")
        return np.array([boxes[:, 0].min(0), boxes[:, 1].max(0)])

    @property
    def matrix(self) -> NDArray[np.float64]:
        """The (4, 4) matrix of the path's last leg, in its parent; the place of a top object. Set: here alone."""
        return self._scene._matrix_of(self.path)

    @matrix.setter
    def matrix(self, matrix: ArrayLike) -> None:
        self._scene._set_matrix(self.path, _matrix(matrix))

    @property
    def placement(self) -> NDArray[np.float64]:
        """The (4, 4) matrix from the object's coordinates to the world's: all matrices on the way, the last one too."""
        return self._scene._placement_of(self.path)

    @property
    def children(self) -> list[Child]:
        """The legs of the combination; of a solid none. scene["/"].children: the objects that are rendered."""
        return [Child(*row) for row in self._scene._child_rows(self.path)]

    def move(self, matrix: ArrayLike, shared: bool = False) -> None:
        """Moves it in the world: placement becomes matrix @ placement. shared: all instances that share its leg."""
        self._scene._move(self.path, _matrix(matrix), shared)

    def __repr__(self) -> str:
        return f"<csgrt.Subtree {self.path}>"


def _matrix(matrix: ArrayLike) -> NDArray[np.float64]:
    array = np.ascontiguousarray(unmasked(matrix, "a matrix's elements"), np.float64)
    if array.shape != (4, 4):
        raise ValueError(f"a matrix has the shape (4, 4), not {array.shape}")
    return array


class Scene(_core.Scene):
    """A compiled scene. Any thread may use it; calls of several wait for each other. A child of fork() loads its own.

    scene: a Part (then its name is "part") or a dict of them by name. objects: names or paths of what is rendered;
    none: the scene's top objects. settings: attributes of csgrt.Settings. Raises csgrt.Error.
    """

    def __init__(self, scene: Part | Mapping[str, Part] | _core.Source, objects: Iterable[str] = (),
                 **settings: Unpack[_core.SettingsKeywords]):
        if isinstance(scene, Part):
            scene = {"part": scene}
        if not isinstance(scene, (Mapping, _core.Source)):
            raise TypeError("a Scene takes a Part or a dict of Parts; csgrt.load(path) reads a file")
        if not isinstance(scene, _core.Source):
            scene = _parse(scene_text(scene))
        super().__init__(scene, [objects] if isinstance(objects, str) else list(objects), _settings(settings))
        self._given = settings
        self._regions: Regions | None = None
        found = self.warnings
        if found:
            more = f" (and {len(found) - 1} more: Scene.warnings)" if len(found) > 1 else ""
            level = 2
            while _inside(level):
                level += 1
            warnings.warn(found[0].text + more, SceneWarning, stacklevel=level)

    @property
    def regions(self) -> Regions:
        """The regions, by id or by path; see csgrt.Region for its members and its ids."""
        if self._regions is None:
            self._regions = Regions(self._region_rows())
        return self._regions

    @property
    def solids(self) -> list[Solid]:
        """The solids, by the ids that solid_ids, in_solids and out_solids have."""
        return [Solid(*row) for row in self._solid_rows()]

    def solid_shape(self, solid: int) -> dict[str, Any] | None:
        """The type and the parameters of a solid in the world, as the JSON format has them: {"type": "torus", ...}, mm.

        solid: an index into solids. None if the type has lists of points, triangles, curves or cells, or if matrices
        give the solid a form that its type does not have. Raises an IndexError if there is no such solid."""
        text = self._solid_text(index(solid))
        return None if text is None else json.loads(text)

    @property
    def warnings(self) -> list[Warning]:
        """What was tolerated or left out, and what is to be said of devices."""
        return [Warning(row[0], Place(*row[1]), *row[2:]) for row in self._warning_rows()]

    @property
    def bounds(self) -> NDArray[np.float64]:
        """(2, 3) float64: the low and the high corner of the box around all regions, mm."""
        return np.array(self._box, np.float64)

    # ---- Rays

    def cast_rays(self, rays: ArrayLike, tnear: ArrayLike = 0.0, tfar: ArrayLike = np.inf, *, solids: bool = True,
                  normals: bool = True) -> Hits:
        """Where rays first meet a region that pictures show.

        rays: (..., 6): origin in mm, direction of any length but 0. A distance along a ray counts lengths of the
        direction from the origin: mm if the direction is a unit vector. tnear, tfar: numbers, or arrays that fit the
        shape (...): where rays begin and end. Returns a dict of arrays: t_hit (...) float64, infinity for a miss;
        region_ids (...) int32, indices into regions, -1 for a miss; solid_ids (...) int32, indices into solids: whose
        surface it is, -1 for a miss; normals (..., 3) float64, outward from the region.
        Raises csgrt.Error (usage, out_of_memory, device_fault), TypeError or ValueError (arrays of wrong shapes, or
        masked in part).
        """
        rays = _doubles(rays, 6, "rays")
        return self._hit_arrays(rays, *_range(rays, tnear, tfar), solids, normals)

    def partitions(self, rays: ArrayLike, tnear: ArrayLike = 0.0, tfar: ArrayLike = np.inf, *, solids: bool = False,
                   normals: bool = False, overlaps: bool = False, hidden: bool = True) -> Partitions:
        """Which region holds which part of each ray.

        rays, tnear, tfar: as in cast_rays. hidden=False leaves out regions whose state is "ghost" or "hidden".
        Returns a dict of arrays without the rays' leading shape: the rows of ray i, from 0, in the order of
        rays.reshape(-1, 6), are ray_splits[i] to ray_splits[i + 1], from front to back.
        ray_splits: (rays + 1) int64. region_ids: (rows) int32, indices into regions.
        t_in, t_out: (rows) float64: where the ray enters and leaves the region, in lengths of its direction from its
        origin. They are cut at tnear and tfar: with tnear=0 what is before the origin is left out, and t_in is 0 if the
        origin is inside; tnear=-np.inf gives all of the line.
        solids=True: in_solids, out_solids, (rows) int32, indices into solids: through whose surface the ray enters and
        leaves; -1 where the range cuts. It is a solid of the region, one that is subtracted from it, or one of the
        region that has the neighbouring partition.
        normals=True: in_normals, out_normals, (rows, 3) float64, outward.
        overlaps=True: overlap_splits (rays + 1), overlap_t_in, overlap_t_out (overlaps),
        overlap_region_splits (overlaps + 1), overlap_region_ids.
        Raises csgrt.Error (usage, out_of_memory, device_fault).
        """
        rays = _doubles(rays, 6, "rays")
        return self._partition_arrays(rays, *_range(rays, tnear, tfar), solids, normals, overlaps, hidden)

    def test_occlusions(self, rays: ArrayLike, tnear: ArrayLike = 0.0,
                        tfar: ArrayLike = np.inf) -> NDArray[np.bool_]:
        """Whether rays meet a region that pictures show: (...) bool. Arguments and errors: as of cast_rays."""
        rays = _doubles(rays, 6, "rays")
        return self._occluded(rays, *_range(rays, tnear, tfar))

    def region_at(self, points: ArrayLike) -> NDArray[np.int32]:
        """The ids of the regions that hold points: (..., 3) float64, mm, gives (...) int32; -1: nothing.

        Of two regions that touch at the point it is the one that begins there along +x. Raises csgrt.Error.
        """
        return self._regions_at(_doubles(points, 3, "points"))

    def measure(self, **request: Unpack[_core.MeasureKeywords]) -> Measurement:
        """Volumes, masses, areas, centroids and moments of all parts, each with a 95 % interval.

        request: attributes of csgrt.MeasureRequest: rel_error=1e-3, densities={1: 7.85}, seed=2, ...
        Raises csgrt.Error (usage, out_of_memory, device_fault), TypeError (members and their values).
        """
        wanted = _core.MeasureRequest()
        _assign(request, "a measure has no", wanted)
        return Measurement(*self._measurement(wanted))

    def check(self, **request: Unpack[_core.CheckKeywords]) -> CheckResult:
        """The pairs of regions that overlap, each with a place, a depth, a volume and a ray that shows it.

        request: attributes of csgrt.CheckRequest: min_depth=0.1 (mm), allowed=[("/bolt*", "/plate")] or a file, ...
        It checks the model of the last commit(), also if another thread commits meanwhile.
        Raises csgrt.Error (usage, out_of_memory, device_fault; of the file: file, scene), TypeError (members and their
        values).
        """
        wanted = _core.CheckRequest()
        _assign(request, "a check has no", wanted)
        return CheckResult(*self._checked(wanted))

    # ---- Views

    def _view(self, width: int, height: int, options: _core.ViewKeywords) -> _core.View:
        """What is given replaces what it contradicts in the camera, as the command's options do."""
        view, given = _core.View(), _core.Camera()
        _assign({"width": width, "height": height, **options}, "a view has no", given, view)
        base = view.camera if "camera" in options else self.camera
        view.camera = base._merged(given, set(options))
        return view

    def render(self, width: int = 1024, height: int = 1024, **view: Unpack[_core.ViewKeywords]) -> Image:
        """A picture: .color, .rgba, .depth, .normal, .region_ids, and by name image["ghost"].

        view: attributes of csgrt.View and of csgrt.Camera; those of the camera that are not given are those of camera=,
        or of the scene's camera. every_partition=True adds the channels depth, partitions, overlap.
        Raises csgrt.Error (usage, out_of_memory, device_fault), TypeError or ValueError (members and their values).
        """
        made = self._view(width, height, {"every_partition": False, **view})
        if "channels" not in view:
            made.channels = _core.channels["all"] | _core.channels["display"] | _core.channels["ghosts"]
            if not made.every_partition:
                made.channels -= _core.channels["counts"]
        return Image(*self._planes(made))

    def pick(self, column: SupportsIndex, row: SupportsIndex, width: int = 1024, height: int = 1024,
             **view: Unpack[_core.ViewKeywords]) -> Pick:
        """What render() with the same view shows at a pixel, from the top left, and all partitions along its ray."""
        return Pick(*self._pick_row(self._view(width, height, view), index(column), index(row)))

    def rays_of(self, width: int = 1024, height: int = 1024,
                **view: Unpack[_core.ViewKeywords]) -> NDArray[np.float64]:
        """The rays of a picture: (height, width, 6) float64."""
        return self._view_rays(self._view(width, height, view))

    # ---- Edits, which take effect with commit()

    def __getitem__(self, path: str) -> Subtree:
        """What is at a path such as "/all/turret@2": its color, finish, state and matrix, which can be set; move().
        "/" is all.

        commit() looks up paths of colours, finishes and states, and raises csgrt.Error for an unknown one.
        """
        return Subtree(self, path)

    def add(self, name: str, part: Part, top: bool = True) -> None:
        """Adds a part under a new name. It is rendered if it is a top object, or joined to one. Raises csgrt.Error."""
        self._add_objects(_parse(scene_text({name: part})), name if top else "")

    def add_top(self, name: str, matrix: ArrayLike = np.eye(4)) -> None:
        """Renders an object that the scene has, such as one that was removed, at a place. Raises csgrt.Error."""
        self._add_top(name, _matrix(matrix))

    def add_leg(self, combination: str, object: str, operator: Operator = "union",  # noqa: A002
                matrix: ArrayLike = np.eye(4)) -> None:
        """A combination's tree becomes: tree, operator ("union", "difference", "intersection", "xor"), object."""
        self._join(combination, operator, object, _matrix(matrix))

    def replace(self, solid: str, part: Part) -> None:
        """A solid gets another shape, in all of its places; `part` is a single solid, moved or not.

        Raises csgrt.Error, or ValueError for another part.
        """
        self._replace_shape(solid, _parse(shape_text(part)))

    def commit(self) -> None:
        """Makes all edits. If csgrt.Error is raised, the scene is as it was, and the edits wait: see discard().

        Paths of colours, finishes and states are looked up here, those of other edits at once.
        """
        self._commit_edits()
        self._regions = None

    def undo(self, steps: int | None = 1) -> None:
        """Takes the last commits back: so many, or all for None; the last 100 are kept. Raises csgrt.Error, and changes
        nothing, if there are fewer, or none, or if edits wait."""
        self._step(True, steps)
        self._regions = None

    def redo(self, steps: int | None = 1) -> None:
        """Makes commits again that undo() took back, the last one first. Raises as undo() does."""
        self._step(False, steps)
        self._regions = None

    def copy(self) -> Scene:
        """Another Scene of the same model, with edits of its own. Edits that wait and commits to undo stay here."""
        made = Scene.__new__(Scene)
        _core.Scene.__init__(made, self)
        made._given, made._regions = self._given, None
        return made

    __copy__ = copy

    def __deepcopy__(self, _: object) -> Scene:
        return self.copy()

    def __reduce__(self) -> tuple[Any, ...]:  # from a process to another, as JSON
        import tempfile

        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "scene.json")
            self.save(path)
            with open(path, "rb") as file:
                return _unpickled, (file.read(), self._rendered(), self._given)

    def save(self, path: Name) -> None:
        """Writes the scene with all committed edits as .json. Raises csgrt.Error, or ValueError for another format."""
        path = os.fspath(path)
        if not path.endswith(".json"):
            raise ValueError("scenes are written as .json")
        self._save_json(path)

    def view(self, *, in_browser: bool = False, height: int = 640, command: str = "csgrt") -> Page:
        """A page that shows the scene as it is now: to turn it, cut it, hide parts, ask what is behind a pixel. A
        notebook has it as a frame of `height` pixels; `in_browser` opens the desktop's browser. The command csgrt
        serves it as long as the Page lives; FileNotFoundError tells that there is none.
        """
        return Page(self, in_browser, height, command)

    def __repr__(self) -> str:
        return f"<csgrt.Scene: {len(self.regions)} regions>"


def _unpickled(text: bytes, objects: list[str], settings: _core.SettingsKeywords) -> Scene:
    return parse(text, objects, **settings)


def _inside(level: int) -> bool:
    """Whether that caller of Scene.__init__ is csgrt's own: a warning is about the line of the user."""
    import sys

    return sys._getframe(level).f_globals.get("__package__") == __package__


def load(path: Name, objects: Iterable[str] = (), *, strict: bool = False, file_folders: Iterable[Name] = (),
         **settings: Unpack[_core.SettingsKeywords]) -> Scene:
    """Reads and compiles a scene file: .json, or BRL-CAD's .g and .asc.

    objects: names or paths ("all.g/tor.r"); none: the scene's top objects. strict: a fault of a BRL-CAD database is an
    error. file_folders: below which a scene may name files, besides its own folder. settings: attributes of
    csgrt.Settings, such as device="gpu" or air=True. Raises csgrt.Error (file, scene, out_of_memory, no_device).
    """
    source = _core.load(os.fspath(path), strict, [os.fspath(folder) for folder in file_folders], _settings(settings))
    return Scene(source, objects, **settings)


def parse(text: str | bytes, objects: Iterable[str] = (), *, name: str = "scene", strict: bool = False,
          file_folders: Iterable[Name] = (), **settings: Unpack[_core.SettingsKeywords]) -> Scene:
    """As load(), from the contents of a file. Errors call it `name`, and files in it are relative to its folder."""
    return Scene(_parse(text, name, strict, file_folders), objects, **settings)
