"""What mypy says, strictly, of the package, of the documents' Python, and of programs with mistakes."""

import re
import subprocess
import sys

import pytest

import csgrt
from conftest import ROOT
from documents_test import blocks

RIGHT = """
from typing import Literal, Optional
import csgrt, numpy as np
from numpy.typing import NDArray
from typing_extensions import assert_type

scene = csgrt.load("a.json", device=csgrt.DeviceName("PoCL"), precision="single")
csgrt.Scene(csgrt.box((1, 2, 3)) - csgrt.sphere(1).translate(np.ones(3)).color((1, 0, 0), shine=5), device=0, air=True)
assert_type(scene.regions["/a"], csgrt.Region)
assert_type(scene.regions[np.int32(0)].color, tuple[float, float, float])
assert_type(scene.regions[1:], list[csgrt.Region])
assert_type(scene.cast_rays(np.zeros((4, 6)), np.zeros(4), 3), csgrt.Hits)
assert_type(scene.cast_rays([])["t_hit"], NDArray[np.float64])
assert_type(scene.partitions([], solids=True)["in_solids"], NDArray[np.int32])
assert_type(scene.slice(np.array([0, 0, 1]), 3), NDArray[np.int32])
assert_type(csgrt.rays_parallel(scene.bounds, "x", (200, 100)), NDArray[np.float64])
assert_type(csgrt.rays_parallel(scene.regions[0].bounds, "x", (200, 100)), NDArray[np.float64])
assert_type(csgrt.rays_pinhole(40, (0, 0, 0), np.ones(3), (0, 0, 1), 80, 60), NDArray[np.float64])
assert_type(scene.test_occlusions([]), NDArray[np.bool_])
assert_type(scene.region_at([]), NDArray[np.int32])
image = scene.render(8, 8, eye=np.array([0, 0, 1]), clip=[((0, 0, 1), 5)], camera=scene.camera)
assert_type(image.color, NDArray[np.uint8])
assert_type(image["ghost"], NDArray[np.uint32])
assert_type(scene.pick(np.int64(3), 3).partitions, list[tuple[int, float, float]])
assert_type(scene.verify()["wrong"], int)
assert_type(scene.measure(rel_error=1e-3, densities={1: 7.85, "/a": 1})["/a"].mass.nominal, float)
assert_type(scene.check(min_depth=0.1, allowed=[("/a", "/b*")]).new[0].paths, tuple[str, str])
assert_type([overlap.volume.half_width for overlap in scene.check(allowed="known")], list[float])
assert_type(scene.measure(grid=(2, 3, 4)).grid, Optional[csgrt.MeasuredGrid])
assert_type(scene["/a"].state, Literal["shown", "ghost", "hidden"])
scene["/a"].color = np.array([0, 1, 0])
scene["/a"].finish = {"specular": 0.5}
scene["/a"].matrix = csgrt.rotate(z=15)
scene["/a"].move(csgrt.rotate(z=15), shared=True)
assert_type(scene["/a"].matrix, NDArray[np.float64])
assert_type(scene["/a"].children, list[csgrt.Child])
assert_type(scene["/a"].children[0].op, Literal["union", "intersection", "difference", "xor", "not"])
scene.add_top("a", np.eye(4))
"""

WRONG = """
csgrt.load("a.json", devise="cpu")
csgrt.load("a.json", device="gpuu")
csgrt.load("a.json", precision="singel")
csgrt.Scene(csgrt.sphere(1), air="yes")
csgrt.parse("", toleranse=1)
scene["/a"].state = "hiden"
scene["/a"].colour = (0, 1, 0)
scene["/a"].finish = {"specullar": 1}
scene.measure(rel_eror=1)
scene.check(allowed=["/a"])
scene.add_leg("a", "b", "unoin")
scene.render(azimut=3)
scene.render(eye=3)
scene.pick(0, 0, sampels=4)
scene.rays_of(up="z")
scene.cast_rays([], solid=True)
scene.cast_rays([])["t_hits"]
scene.partitions([])["tin"]
scene.verify()["wrongs"]
scene.regions["/a"].paht
scene.slice((0, 0, 1), "0")
csgrt.rays_parallel(scene.bounds, "w", (2, 2))
csgrt.sphere(1).color((0, 0, 0), shin=4)
"""


def test_the_documents_have_types_and_mistakes_are_found(tmp_path):
    pytest.importorskip("mypy", reason="the types are not checked: pip install mypy")
    programs = {f"block{i}": block.values[0] for i, block in enumerate(blocks())}
    programs |= {path.stem: path.read_text() for path in (ROOT / "examples").glob("*.py")}
    programs |= {"right": RIGHT, "wrong": "import csgrt\nscene = csgrt.Scene(csgrt.sphere(1))" + WRONG}
    for name, text in programs.items():
        (tmp_path / f"{name}.py").write_text(text)
    modules = [word for name in programs for word in ("-m", name)]
    program = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", ".mypy", "-p", "csgrt", *modules]
    said = subprocess.run(program, cwd=tmp_path, capture_output=True, text=True).stdout
    found = re.findall(r"^wrong\.py:(\d+): error: ", said, re.MULTILINE)
    assert sorted(set(map(int, found))) == list(range(3, 3 + WRONG.count("\n") - 1)), said
    others = [line for line in said.splitlines() if ": error: " in line and not line.startswith("wrong.py")]
    assert not others


def test_answers_have_the_members_of_their_types(operators):
    rays = [[0, -9000, 0, 0, 1, 0]]
    parts = operators.partitions(rays, solids=True, normals=True, overlaps=True)
    for kind, answer in ((csgrt.Partitions, parts), (csgrt.Hits, operators.cast_rays(rays))):
        types = {name: f"NDArray[np.{values.dtype}]" for name, values in answer.items()}
        assert types == {name: annotation.__forward_arg__ for name, annotation in kind.__annotations__.items()}
    assert list(operators.verify(100)) == list(csgrt.Verification.__annotations__)
