"""Rays and points: shapes, memory, and the bits of the command."""

import json

import numpy as np
import pytest

import csgrt
from csgrt._scene import _doubles


def test_any_leading_shape_is_kept(operators):
    rays = csgrt.rays_parallel(operators.bounds, "x", (30, 20))
    assert rays.shape == (20, 30, 6)
    flat, grid = operators.cast_rays(rays.reshape(-1, 6)), operators.cast_rays(rays)
    assert grid["t_hit"].shape == grid["region_ids"].shape == grid["solid_ids"].shape == (20, 30)
    assert grid["normals"].shape == (20, 30, 3)
    for name, values in grid.items():
        np.testing.assert_array_equal(values.reshape(flat[name].shape), flat[name])
    assert operators.partitions(rays)["ray_splits"].shape == (601,)
    assert operators.test_occlusions(rays[3, 4]).shape == ()
    assert operators.region_at(np.zeros((2, 1, 4, 3))).shape == (2, 1, 4)
    assert operators.partitions(np.zeros((0, 6)))["ray_splits"].tolist() == [0]


def test_types_and_misses(operators):
    rays = [[1e6, 1e6, 1e6, 1, 0, 0], [0, -9000, 0, 0, 1, 0]]  # any sequence is taken
    hits, parts = operators.cast_rays(rays), operators.partitions(rays)
    assert hits["t_hit"][0] == np.inf and hits["region_ids"][0] == hits["solid_ids"][0] == -1
    assert parts["ray_splits"][1] == 0 and parts["t_in"][0] == hits["t_hit"][1]
    assert operators.test_occlusions(rays).tolist() == [False, True]
    assert operators.test_occlusions(rays).dtype == bool


def test_rays_are_read_in_place_and_answers_are_not_copied(operators):
    rays = csgrt.rays_parallel(operators.bounds, "z", (10, 10))
    assert np.shares_memory(_doubles(rays, 6, "rays"), rays)
    parts, hits = operators.partitions(rays), operators.cast_rays(rays)
    assert not any(values.flags.owndata for values in (*parts.values(), *hits.values()))


def test_few_rays_have_the_bits_of_many(operators, random_rays):
    """Up to 64 rays are answered by the model itself."""
    rays = random_rays(operators, 500)
    every = {"solids": True, "normals": True, "overlaps": True}
    many, hits, dark = operators.partitions(rays, **every), operators.cast_rays(rays), operators.test_occlusions(rays)
    points = rays[:, :3] + 0.5 * rays[:, 3:]
    ids = operators.region_at(points)
    for first, last in ((0, 1), (1, 65), (65, 130), (130, 133)):
        few = operators.partitions(rays[first:last], **every)
        rows = slice(*many["ray_splits"][[first, last]])
        for name in ("region_ids", "t_in", "t_out", "in_solids", "out_normals"):
            assert few[name].tobytes() == many[name][rows].tobytes()
        for name, answer in operators.cast_rays(rays[first:last]).items():
            assert answer.tobytes() == hits[name][first:last].tobytes()
        assert (operators.test_occlusions(rays[first:last]) == dark[first:last]).all()
        assert (operators.region_at(points[first:last]) == ids[first:last]).all()


def test_answers_outlive_their_scene(scenes):
    scene = csgrt.load(scenes / "operators.json")
    rays = csgrt.rays_parallel(scene.bounds, "x", (200, 200))
    image, parts, hits = scene.render(64, 64), scene.partitions(rays, normals=True), scene.cast_rays(rays)
    arrays = [image.rgba, image.color, image.region_ids, *parts.values(), *hits.values()]
    before = [values.tobytes() for values in arrays]
    del scene, image, parts, hits
    other = csgrt.load(scenes / "solids.json")  # takes memory that was freed
    other.partitions(rays)
    assert before == [values.tobytes() for values in arrays]


def test_ranges_for_all_rays_and_for_each(operators):
    rays = csgrt.rays_parallel(operators.bounds, "x", (40, 30))
    whole = operators.cast_rays(rays)
    near = np.where(np.isinf(whole["t_hit"]), 0, whole["t_hit"] + 1)
    cut = operators.partitions(rays, tnear=near, tfar=near + 100)
    assert (cut["t_in"] >= near.min()).all()
    counts = np.diff(cut["ray_splits"])
    np.testing.assert_array_less(cut["t_out"], np.repeat(near.ravel() + 100, counts) + 1e-9)
    one = operators.partitions(rays, 100, 2000)
    np.testing.assert_array_equal(operators.partitions(rays, np.full((30, 40), 100.0), 2000)["t_in"], one["t_in"])
    assert (one["t_in"] >= 100).all() and (one["t_out"] <= 2000).all()


def test_partitions_begin_at_the_origin_and_tell_whose_surfaces_bound_them():
    scene = csgrt.Scene(csgrt.box(20, center=True) - csgrt.sphere(5).translate(x=-10))
    ray = [[0, 0, 0, -2, 0, 0]]  # from inside the box into the ball that is subtracted from it
    cut, whole = (scene.partitions(ray, tnear=tnear, solids=True) for tnear in (0, -np.inf))
    assert (cut["t_in"], cut["t_out"], cut["in_solids"]) == (0, 2.5, -1)
    assert (whole["t_in"], whole["t_out"]) == (-5, 2.5)
    assert [scene.solids[whole[side][0]].type for side in ("in_solids", "out_solids")] == ["arb8", "ell"]


def test_places_have_the_bits_of_the_command(operators, scenes, command, tmp_path):
    points = np.random.default_rng(2).uniform(*operators.bounds, (500, 3))
    np.savetxt(tmp_path / "points", points, fmt="%.17g")
    command("sample", scenes / "operators.json", "--points", tmp_path / "points", "-o", tmp_path / "points.npy")
    ids = operators.region_at(points)
    np.testing.assert_array_equal(ids, np.load(tmp_path / "points.npy"))
    assert ids.dtype == np.int32 and (ids >= 0).any() and (ids == -1).any()

    cut = operators.slice(normal=(0, 0, 1), offset=50, pixels=(80, 60))
    assert cut.shape == (60, 80) and cut.dtype == np.int32
    np.testing.assert_array_equal(cut, operators.slice(normal=(0, 0, 2), offset=50, pixels=(80, 60)))
    np.testing.assert_array_equal(operators.render(40, 40, clip=[((0, 0, 1), 50)]).region_ids,
                                  operators.render(40, 40, clip=[((0, 0, 2), 50)]).region_ids)


def test_overlaps_are_listed_with_all_claimants(scenes):
    scene = csgrt.load(scenes / "overlap.json")
    parts = scene.partitions(csgrt.rays_parallel(scene.bounds, "x", (50, 50)), overlaps=True)
    assert len(parts["overlap_splits"]) == 2501
    assert len(parts["overlap_t_in"]) == len(parts["overlap_region_splits"]) - 1 > 0
    assert (np.diff(parts["overlap_region_splits"]) >= 2).all()


def test_pinhole_rays_are_those_of_a_picture(operators):
    eye, center = (20000.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    rays = csgrt.rays_pinhole(40, center, eye, (0, 0, 1), 32, 24)
    assert rays.shape == (24, 32, 6)
    np.testing.assert_allclose(np.linalg.norm(rays[..., 3:], axis=-1), 1)
    view = operators.rays_of(32, 24, eye=eye, center=center, perspective=40)
    np.testing.assert_allclose(rays, view, rtol=1e-12, atol=1e-9)


def test_wrong_shapes_and_rays_are_refused_with_a_sentence(operators):
    with pytest.raises(ValueError, match=r"rays have the shape \(\.\.\., 6\), not \(3, 5\)"):
        operators.cast_rays(np.zeros((3, 5)))
    with pytest.raises(TypeError, match="rays are real, not complex128"):
        operators.cast_rays(np.zeros((3, 6), complex))
    with pytest.raises(ValueError, match=r"tnear has the shape \(2,\), and the rays have \(3,\)"):
        operators.cast_rays(np.zeros((3, 6)), tnear=[0, 1])
    with pytest.raises(csgrt.Error, match="ray 1: needs a direction other than 0") as caught:
        operators.partitions([[0, 0, 0, 1, 0, 0], [0] * 6])
    assert caught.value.status == "usage"


def test_an_array_with_masked_elements_is_refused_wherever_one_is_given(operators):
    rays = np.ma.array([[0.0, -9000, 0, 0, 1, 0]] * 2)
    expected = operators.partitions(rays.data)
    assert (operators.partitions(rays)["t_in"] == expected["t_in"]).all()  # it masks none
    rays[1] = np.ma.masked
    ends = np.ma.array([1.0, 2.0], mask=[False, True])
    matrix = np.ma.array(np.eye(4), mask=np.eye(4) == 0)
    for call, what in [
        (lambda: operators.partitions(rays), "rays"),
        (lambda: operators.cast_rays(rays), "rays"),
        (lambda: operators.test_occlusions(rays.data, tfar=ends), "elements of tfar"),
        (lambda: operators.region_at(rays[:, :3]), "points"),
        (lambda: operators.add_leg("operators", "union", matrix=matrix), "a matrix's elements"),
        (lambda: csgrt.sphere(1).transform(matrix), "a matrix's elements"),
        (lambda: csgrt.box(np.ma.array([1, 2, 3], mask=[0, 1, 0])), "sides"),
        (lambda: csgrt.Scene(csgrt.solid("sphere", center=rays[1, :3], radius=1)), "a solid's numbers"),
    ]:
        with pytest.raises(ValueError, match=f"^{what} are masked in part"):
            call()


@pytest.mark.parametrize("setting", ["tolerance", "device_timeout"])
@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_a_setting_without_end_is_refused(scenes, setting, value):
    with pytest.raises(csgrt.Error, match=f"the setting {setting} is .*, and must be a finite number"):
        csgrt.load(scenes / "operators.json", **{setting: value})


def test_a_name_of_a_file_with_a_nul_is_refused(operators, scenes, tmp_path):
    with pytest.raises(csgrt.Error, match="the name of a file has no NUL"):
        csgrt.load(str(scenes / "operators.json") + "\0.json")
    with pytest.raises(csgrt.Error, match="the name of a file has no NUL"):
        operators.save(str(tmp_path / "a.json") + "\0.json")
    assert not list(tmp_path.iterdir())


def test_regions_are_those_of_info(operators, scenes, command):
    listed = json.loads(command("info", "--json", scenes / "operators.json", capture_output=True).stdout)
    assert len(operators.regions) == len(listed["regions"])
    for region, row in zip(operators.regions, listed["regions"]):
        assert (region.id, region.path, region.material_id) == (row["index"], row["path"], row["material_id"])
        assert region.bounds == (tuple(row["bounds"]["low"]), tuple(row["bounds"]["high"]))
        assert operators.regions[region.path] is operators.regions[region.path[1:]] is region
    assert "/operators/xor" in repr(operators.regions)
    assert operators.bounds.tolist() == [listed["bounds"]["low"], listed["bounds"]["high"]]
    assert operators.units == "mm"
    with pytest.raises(IndexError, match="-1 is a miss"):
        operators.regions[-1]
    for path in ("union", "/operators/unoin"):
        with pytest.raises(KeyError, match="did you mean '/operators/union'?"):
            operators.regions[path]
