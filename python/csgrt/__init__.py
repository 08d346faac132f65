"""csgrt: exact ray tracing of Constructive Solid Geometry.

    import csgrt
    scene = csgrt.load("scenes/operators.json")
    scene.render(640, 480).save("view.png")
    rays = csgrt.rays_parallel(scene.bounds, "x", (100, 100))
    parts = scene.partitions(rays)

Lengths are millimetres, angles degrees, coordinates right-handed with z up, matrices 4 x 4 on column vectors. Distances
along a ray count lengths of its direction. Failures are csgrt.Error; see there.
"""

from ._core import Camera, CheckRequest, MeasureRequest, Settings, View, device_rows, rays_parallel, rays_pinhole
from ._core import version as __version__
from ._image import Image
from ._page import Page
from ._scene import Scene, Subtree, load, parse
from ._solids import Part, box, cone, cylinder, rotate, scale, solid, sphere, torus, translate
from ._values import (
    CellVolumes, CheckResult, Child, Device, DeviceName, Diagnostic, Error, Estimate, FoundOverlap, Hits, Material,
    Measured, MeasuredGrid, Measurement, Partitions, Pick, Place, Region, Regions, SceneWarning, Solid, Verification,
    UnlistedPair, Wall, Warning,
)


def devices() -> list[Device]:
    """Every device, in the order of the numbers that the setting `device` takes. It loads the drivers."""
    return [Device(*row) for row in device_rows()]


__all__ = [
    "Camera", "CellVolumes", "CheckRequest", "CheckResult", "Child", "Device", "DeviceName", "Diagnostic", "Error",
    "Estimate", "FoundOverlap", "Hits", "Image", "Material", "MeasureRequest", "Measured", "MeasuredGrid",
    "Measurement", "Page", "Part", "Partitions", "Pick", "Place", "Region", "Regions", "Scene", "SceneWarning",
    "Settings", "Solid", "Subtree", "UnlistedPair", "Verification", "View", "Wall", "Warning", "box", "cone",
    "cylinder", "devices", "load", "parse", "rays_parallel", "rays_pinhole", "rotate", "scale", "solid", "sphere",
    "torus", "translate",
]
