"""The ray queries that the documents of Open3D and trimesh show, of a box, a ball and a torus: the same numbers, exact
where theirs are those of a mesh. docs/python.md has the names side by side."""

import numpy as np

import csgrt


def test_open3d_s_rays_through_a_unit_box():
    scene = csgrt.Scene(csgrt.box((1, 1, 1)))
    rays = [[0.5, 0.5, 10, 0, 0, -1], [-1, -1, -1, 0, 0, -1]]
    hits = scene.cast_rays(rays)
    assert hits["t_hit"].tolist() == [9, np.inf]
    assert hits["region_ids"].tolist() == [0, -1]
    assert hits["normals"][0].tolist() == [0, 0, 1]
    assert scene.test_occlusions(rays).tolist() == [True, False]
    assert scene.test_occlusions(rays, tnear=0, tfar=8).tolist() == [False, False]
    parts = scene.partitions(rays)  # two intersections of the first, as list_intersections has them
    assert (parts["t_in"].tolist(), parts["t_out"].tolist()) == ([9], [10])
    assert (2 * np.diff(parts["ray_splits"])).tolist() == [2, 0]


def test_open3d_s_pinhole_rays():
    rays = csgrt.rays_pinhole(60, [0.5, 0.5, 0.5], [-1, -1, -1], [0, 0, 1], 320, 240)
    assert rays.shape == (240, 320, 6)
    assert (rays[..., :3] == -1).all()
    middle = rays[119:121, 159:161, 3:].mean((0, 1))
    np.testing.assert_allclose(middle / np.linalg.norm(middle), np.ones(3) / np.sqrt(3), rtol=1e-12)
    depth = csgrt.Scene(csgrt.box((1, 1, 1))).cast_rays(rays)["t_hit"]
    assert np.isfinite(depth).any() and abs(depth.min() - np.sqrt(3)) < 1e-2  # the corner at the origin


def test_open3d_s_occupancy():
    points = np.stack(np.meshgrid(*[np.linspace(-2, 2, 16)] * 3, indexing="ij"), -1)
    scene = csgrt.Scene(csgrt.sphere(0.5).translate(0.7, 0.8, 0))
    inside = np.linalg.norm(points - [0.7, 0.8, 0], axis=-1) < 0.5
    assert ((scene.region_at(points) >= 0) == inside).all()


def test_trimesh_s_rays_through_a_unit_ball():
    scene = csgrt.Scene(csgrt.sphere(1))
    origins, directions = np.array([[0, 0, -3], [2, 2, -3.0]]), np.array([[0, 0, 1], [0, 0, 1.0]])
    parts = scene.partitions(np.hstack([origins, directions]))
    ray = np.repeat(np.arange(2), np.diff(parts["ray_splits"]))
    assert ray.tolist() == [0]
    locations = [origins[ray] + parts[t][:, None] * directions[ray] for t in ("t_in", "t_out")]
    assert np.concatenate(locations).tolist() == [[0, 0, -1], [0, 0, 1]]  # an icosphere's may lie inside
    assert scene.region_at([[0, 0, 0], [0, 0, 0.999], [0.8, 0.8, 0]]).tolist() == [0, 0, -1]


def test_rays_through_a_torus():
    scene = csgrt.Scene(csgrt.torus(3, 1))
    parts = scene.partitions([[-10, 0, 0, 1, 0, 0], [0, 0, -10, 0, 0, 1], [3, 0, -10, 0, 0, 2]])
    assert np.diff(parts["ray_splits"]).tolist() == [2, 0, 1]
    np.testing.assert_allclose(parts["t_in"], [6, 12, 4.5], rtol=1e-14)
    np.testing.assert_allclose(parts["t_out"], [8, 14, 5.5], rtol=1e-14)
