"""Pictures, edits, errors, warnings; scenes made in code."""

import copy
import io
import json
import pickle
import re
import signal
import sys
import urllib.parse
import warnings

import numpy as np
import pytest

import csgrt

pillow = pytest.importorskip("PIL.Image")


def test_a_picture_has_the_bits_of_the_command(operators, scenes, command, tmp_path):
    view = {"azimuth": 60, "elevation": 10, "perspective": 30}
    image = operators.render(96, 64, **view)
    options = [word for name, value in view.items() for word in (f"--{name}", value)]
    command(scenes / "operators.json", "--size", "96x64", *options, "-o", tmp_path / "theirs.png")
    theirs = np.asarray(pillow.open(tmp_path / "theirs.png").convert("RGBA"))
    np.testing.assert_array_equal(image.color, theirs)
    image.save(tmp_path / "ours.png")
    np.testing.assert_array_equal(np.asarray(pillow.open(tmp_path / "ours.png").convert("RGBA")), theirs)
    assert pillow.open(tmp_path / "ours.png").mode == "RGB"
    assert pillow.open(io.BytesIO(image._repr_png_())).size == (96, 64)


def test_a_picture_without_pillow_is_not_saved_and_says_what_to_install(operators, monkeypatch):
    monkeypatch.setitem(sys.modules, "PIL", None)
    with pytest.raises(ModuleNotFoundError, match=r"pictures need Pillow: pip install 'csgrt\[pictures\]'"):
        operators.render(8, 8).save("view.png")


def test_views_of_a_picture_share_its_memory(operators):
    image = operators.render(40, 30, every_partition=True)
    assert image.color.shape == (30, 40, 4) and image.color.dtype == np.uint8
    assert image.rgba.shape == (30, 40, 4) and image.rgba.dtype == np.float32
    assert image.normal.shape == (30, 40, 3) and image.depth.shape == (30, 40)
    assert image.region_ids.dtype == np.uint32
    assert np.shares_memory(image.color, image.color) and np.shares_memory(image.color, image["RGBA8"])
    assert np.shares_memory(image.rgba[..., 1], image["G"]) and np.shares_memory(image.normal, image["N.Z"])
    assert np.shares_memory(image.depth, image["Z"]) and np.shares_memory(image.region_ids, image["region"])
    assert (image["partitions"][image.region_ids > 0] > 0).all()
    assert (np.isinf(image.depth) == (image.region_ids == 0)).all()
    with pytest.raises(KeyError, match="no channel depht"):
        image["depht"]


def test_pick_tells_what_the_picture_shows(operators):
    view = {"azimuth": 60, "clip": [((0, 0, 1), 500.0)]}
    image = operators.render(64, 64, **view)
    row, column = np.argwhere(image.region_ids > 0)[100]
    found = operators.pick(column, row, 64, 64, **view)
    assert found.region_id + 1 == image.region_ids[row, column]
    np.testing.assert_allclose(found.point, np.asarray(found.ray[0]) + found.t * np.asarray(found.ray[1]))
    assert found.partitions


@pytest.mark.parametrize("error, view, message", [
    (TypeError, {"width": (64, 64)}, "width: expected a whole number, not (64, 64)"),
    (TypeError, {"azimuth": "30"}, "azimuth: expected a number, not '30'"),
    (TypeError, {"eye": (0, 1)}, "eye: expected three numbers or None, not (0, 1)"),
    (TypeError, {"view_size": "a"}, "view_size: expected a number or None, not 'a'"),
    (TypeError, {"transparent": 1}, "transparent: expected True or False, not 1"),
    (TypeError, {"clip": ((0, 0, 1), 3)}, "clip: expected a list of (normal, distance), not ((0, 0, 1), 3)"),
    (TypeError, {"azimut": 3}, "a view has no azimut: did you mean 'azimuth'?"),
    (ValueError, {"eye": (0, 0, 1), "azimuth": 3}, "eye cannot be combined with azimuth"),
])
def test_a_view_names_the_member_that_it_refuses(operators, error, view, message):
    with pytest.raises(error, match=re.escape(message)):
        operators.render(**view)


@pytest.mark.parametrize("camera, view", [
    ({"eye": [9000, -20000, 9000], "up": [1, 0, 1], "perspective": 30}, {"azimuth": 60}),
    ({"azimuth": 10, "up": [1, 0, 1], "size": 7000}, {"eye": (9000.0, -20000.0, 9000.0)}),
    ({"eye": [9000, -20000, 9000], "size": 7000}, {"perspective": 20}),
    ({"look_at": [0, 0, 3000], "up": [1, 0, 1]}, {"center": (0.0, 6000.0, 0.0)}),
])
def test_what_a_view_gives_replaces_what_the_command_replaces(scenes, command, tmp_path, camera, view):
    scene = json.loads((scenes / "operators.json").read_text()) | {"camera": camera}
    (tmp_path / "scene.json").write_text(json.dumps(scene))
    options = [word for name, value in view.items()
               for word in (f"--{name}", ",".join(map(str, np.atleast_1d(value))))]
    command(tmp_path / "scene.json", "--size", "48x32", *options, "-o", tmp_path / "theirs.png")
    theirs = np.asarray(pillow.open(tmp_path / "theirs.png").convert("RGBA"))
    np.testing.assert_array_equal(csgrt.load(tmp_path / "scene.json").render(48, 32, **view).color, theirs)


def test_a_view_has_the_camera_that_is_given(operators):
    camera = operators.camera
    camera.azimuth, camera.perspective = 80, 10
    given = operators.rays_of(8, 8, camera=camera, perspective=30)
    np.testing.assert_array_equal(given, operators.rays_of(8, 8, azimuth=80, perspective=30))


def test_edits_take_effect_with_commit(operators):
    path = "/operators/union"
    before = operators.render(64, 64)
    operators[path].color = (0, 1, 0)
    operators["/operators/plinth@2"].state = "ghost"
    operators[path].finish = {"specular": 0.9, "shine": 3}
    operators[path].matrix = csgrt.translate(0, -4000, 0)
    assert (operators.render(64, 64).color == before.color).all()
    operators.commit()
    assert operators[path].color == (0, 1, 0) and operators["/operators/plinth@2"].state == "ghost"
    assert operators.regions[path].bounds[0][1] != -4670
    after = operators.render(64, 64)
    assert (after.color != before.color).any()
    with pytest.raises(csgrt.Error, match="a state is one of shown, ghost, hidden, not gone"):
        operators[path].state = "gone"
    operators["/operators/nothing"].color = (1, 0, 0)
    for _ in range(2):  # a refused edit waits
        with pytest.raises(csgrt.Error, match="no region at '/operators/nothing'"):
            operators.commit()
    operators.discard()
    with pytest.raises(AttributeError, match="colour"):
        operators[path].colour = (1, 0, 0)
    with pytest.raises(AttributeError):
        operators.regions[path].state = "hidden"
    operators.remove(path)
    operators.add("extra", csgrt.sphere(500))
    operators.replace("extra.sphere1", csgrt.sphere(700))
    operators.add_leg("operators", "extra", matrix=csgrt.translate(z=4000))
    operators.commit()
    assert path not in [region.path for region in operators.regions]
    assert operators.regions["/extra"].bounds == ((-700, -700, -700), (700, 700, 700))
    assert operators.regions["/operators/extra"].bounds[1][2] == 4700
    with pytest.raises(ValueError, match="single solid"):
        operators.replace("extra.sphere1", csgrt.sphere(1) - csgrt.box(1))
    with pytest.raises(ValueError, match="written as .json"):
        operators.save("edited.g")


def test_a_path_tells_where_it_is_and_what_is_below_it(operators):
    path = "/operators/plinth@2"
    place = operators[path].matrix
    np.testing.assert_array_equal(operators[path].placement, place)
    assert [child.path for child in operators["/"].children] == ["/operators"]
    below = operators["operators"].children
    assert path in [child.path for child in below] and {child.op for child in below} == {"union"}
    assert operators["/operators/difference"].children[1].op == "difference"
    assert operators.regions[path].path == below[[child.path for child in below].index(path)].path
    with pytest.raises(csgrt.Error, match="no member 'nothing'"):
        operators["/operators/nothing"].matrix  # noqa: B018
    with pytest.raises(ValueError, match=r"the shape \(4, 4\), not \(3, 3\)"):
        operators[path].move(np.eye(3))
    with pytest.raises(csgrt.Error, match="'/' is all, not one object"):
        operators["/"].matrix = np.eye(4)
    operators[path].move(csgrt.rotate(z=90))
    operators["/"].move(csgrt.translate(z=5))
    operators["/"].state = "hidden"
    operators[path].state = "shown"
    operators.commit()
    np.testing.assert_array_equal(operators[path].matrix, csgrt.rotate(z=90) @ place)
    np.testing.assert_array_equal(operators[path].placement, csgrt.translate(z=5) @ csgrt.rotate(z=90) @ place)
    np.testing.assert_array_equal(operators["operators"].matrix, csgrt.translate(z=5))
    assert [region.path for region in operators.regions if region.state == "shown"] == [path]


def test_commits_are_undone_and_done_again(operators):
    pictures = [operators.render(32, 32).color]
    operators.add("lamp", csgrt.sphere(900))
    operators.commit()
    pictures.append(operators.render(32, 32).color)
    for z in range(3):
        operators["lamp"].move(csgrt.translate(0, -2000, 1000 * z))
        operators.commit()
        pictures.append(operators.render(32, 32).color)
    operators.commit()  # nothing waits: no commit
    for picture in pictures[-2::-1]:
        operators.undo()
        assert (operators.render(32, 32).color == picture).all()
    assert "/lamp" not in [region.path for region in operators.regions]
    with pytest.raises(csgrt.Error, match="no commit to undo"):
        operators.undo()
    for picture in pictures[1:]:
        operators.redo()
        assert (operators.render(32, 32).color == picture).all()
    with pytest.raises(csgrt.Error, match="only 4 commits"):
        operators.undo(5)
    operators.undo(None)
    assert (operators.render(32, 32).color == pictures[0]).all()
    operators.redo(4)
    assert (operators.render(32, 32).color == pictures[-1]).all()
    operators.undo()
    operators["lamp"].color = (1, 0, 0)
    with pytest.raises(csgrt.Error, match="edits wait"):
        operators.undo()
    operators.commit()
    with pytest.raises(csgrt.Error, match="no commit to redo"):
        operators.redo()
    with pytest.raises(csgrt.Error, match="components from 0 to 1"):
        operators["lamp"].color = (2, 0, 0)
    operators.undo()  # nothing waits


def test_what_was_removed_comes_back_and_what_is_erased_is_gone(operators):
    lamp = csgrt.sphere(100) - csgrt.box(20)
    operators.add("lamp", lamp)
    operators.commit()
    operators.remove("lamp")
    operators.commit()
    with pytest.raises(csgrt.Error, match="already(.|\n)*erase"):
        operators.add("lamp", lamp)
    operators.add_top("lamp", csgrt.translate(z=50))
    operators.commit()
    assert operators.regions["/lamp"].bounds[1][2] == 150
    operators.erase("lamp")
    operators.add("lamp", csgrt.sphere(7).translate(z=1))
    operators.replace("lamp.sphere1", csgrt.sphere(3).translate(z=2))
    operators.commit()
    assert operators.regions["/lamp"].bounds[1][2] == 6


def test_scenes_are_copied_and_go_from_process_to_process(scenes):
    scene = csgrt.load(scenes / "operators.json", ["/operators/union", "/operators/plinth@2"], max_memory=2**30)
    scene.add("lamp", csgrt.sphere(3000))
    scene["/operators/union"].color = (0, 1, 0)
    scene.remove("/operators/plinth@2")
    scene.commit()
    scene["lamp"].color = (1, 0, 0)  # waits
    picture = scene.render(32, 32)
    for other in (scene.copy(), copy.copy(scene), copy.deepcopy(scene), pickle.loads(pickle.dumps(scene))):
        assert [region.path for region in other.regions] == ["/operators/union", "/lamp"]
        assert (other.render(32, 32).rgba == picture.rgba).all()
        with pytest.raises(csgrt.Error, match="no commit to undo"):
            other.undo()
        other["lamp"].state = "hidden"
        other.commit()
        assert (other.render(32, 32).region_ids != picture.region_ids).any()
    assert (scene.render(32, 32).rgba == picture.rgba).all()
    two = csgrt.Scene({"a": csgrt.sphere(1), "b": csgrt.sphere(2)}, ["a", "b"])
    two.erase("a")
    two.commit()
    assert two.verify(100)["passed"]


def test_booleans_in_code():
    ball, cube = csgrt.sphere(10), csgrt.box(12, center=True)
    points = [[0, 0, 0], [0, 0, 8], [5.5, 5.5, 5.5], [20, 0, 0], [9.5, 0, 0]]
    inside = {"|": [0, 0, 0, -1, 0], "&": [0, -1, 0, -1, -1], "-": [-1, 0, -1, -1, 0], "^": [-1, 0, -1, -1, 0]}
    points[2] = [5.5, 5.5, 5.5]  # in the ball: 9.53 from the origin
    for operator, ids in inside.items():
        part = {"|": ball | cube, "&": ball & cube, "-": ball - cube, "^": ball ^ cube}[operator]
        np.testing.assert_array_equal(csgrt.Scene(part).region_at(points), ids, operator)
    np.testing.assert_array_equal(csgrt.Scene(ball + cube).region_at(points), inside["|"])


def test_solids_in_code_are_exact():
    hits = csgrt.Scene(csgrt.torus(5, 1)).partitions([[-10, 0, 0, 1, 0, 0]])
    np.testing.assert_allclose(hits["t_in"], [4, 14])
    np.testing.assert_allclose(hits["t_out"], [6, 16])
    assert csgrt.Scene(csgrt.cylinder(4, 2)).cast_rays([[0, 0, -1, 0, 0, 1]])["t_hit"] == [1]
    assert csgrt.Scene(csgrt.cone(4, 2)).cast_rays([[-9, 0, 2, 1, 0, 0]])["t_hit"] == pytest.approx(8)
    made = csgrt.solid("ell", center=(0, 0, 0), a=np.array([2.0, 0, 0]), b=(0, 1, 0), c=(0, 0, 1))
    scene = csgrt.Scene(made.rotate(z=90).scale(2).translate(z=5))
    assert scene.cast_rays([[0, -10, 5, 0, 1, 0]])["t_hit"] == [6]  # a quarter turn is exact
    assert csgrt.rotate(x=90).tolist() == [[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]]


def test_code_names_what_is_no_part_or_no_size():
    ball = csgrt.sphere(1)
    for wrong in (lambda: ball - 1, lambda: ball | 1, lambda: csgrt.Scene({"a": 1})):
        with pytest.raises(TypeError, match="expected a Part, not 1"):
            wrong()
    with pytest.raises(TypeError, match="csgrt.load"):
        csgrt.Scene("a.json")
    with pytest.raises(ValueError, match=r"the size of a box is a number or \(x, y, z\), not \(1, 2\)"):
        csgrt.box((1, 2))
    assert (csgrt.translate((1, 2, 3)) == csgrt.translate(1, 2, 3)).all()


def test_colours_make_regions(tmp_path):
    wheel = csgrt.torus(2, 0.5).color((0, 0, 0), shine=5)
    hull = csgrt.box((8, 4, 2), center=True)
    car = (hull.color((1, 0, 0)) | wheel.translate(x=5) | wheel.translate(x=-5)) - csgrt.cylinder(9, 0.2, center=True)
    scene = csgrt.Scene({"car": car | csgrt.sphere(1).translate(z=3), "ball": csgrt.sphere(1).translate(z=9)})
    assert [region.color for region in scene.regions][:3] == [(1, 0, 0), (0, 0, 0), (0, 0, 0)]
    assert [r.path for r in scene.regions][3:] == ["/car/car.rest", "/ball"]
    assert scene.region_at([[0, 0, 0], [1, 1, 0], [0, 0, 3], [0, 0, 9]]).tolist() == [-1, 0, 3, 4]
    pair = csgrt.Scene({"pair": wheel | wheel.translate(z=3)})
    assert [region.path for region in pair.regions] == ["/pair/pair.region1", "/pair/pair.region1@2"]
    scene.save(tmp_path / "car.json")
    assert repr(csgrt.load(tmp_path / "car.json").regions) == repr(scene.regions)
    assert len(csgrt.Scene(car.color((0, 1, 0))).regions) == 1


def test_long_chains_and_shared_parts_stay_small():
    row = csgrt.sphere(0.4)
    for i in range(1, 1500):
        row = row | csgrt.sphere(0.4).translate(x=i)
    assert len(csgrt.Scene(row).partitions([[-5, 0, 0, 1, 0, 0]])["t_in"]) == 1500
    doubled = csgrt.sphere(0.4)
    for i in range(10):
        doubled = doubled | doubled.translate(x=2**i)
    assert len(csgrt.Scene(doubled).partitions([[-5, 0, 0, 1, 0, 0]])["t_in"]) == 1024


def test_the_contents_of_a_file_are_text_or_bytes(operators, scenes):
    for contents in ((scenes / "operators.json").read_text(), (scenes / "operators.json").read_bytes()):
        assert repr(csgrt.parse(contents).regions) == repr(operators.regions)


def test_an_error_has_status_place_and_suggestion(tmp_path):
    with pytest.raises(csgrt.Error) as caught:
        csgrt.parse('{"csgrt": 1,\n "solids": {"a": {"type": "spere"}}}', name="a.json")
    error = caught.value
    assert (error.status, error.place.file, error.place.line) == ("scene", "a.json", 2)
    assert error.place.pointer == "/solids/a/type" and "sphere" in error.suggestion
    assert pickle.loads(pickle.dumps(error)).diagnostics == error.diagnostics
    with pytest.raises(csgrt.Error) as caught:
        csgrt.load(tmp_path / "none.json")
    assert caught.value.status == "file"
    with pytest.raises(csgrt.Error) as caught:
        csgrt.Scene(csgrt.sphere(1), device="no such device")
    assert caught.value.status == "no_device"
    with pytest.raises(TypeError, match="csgrt has no setting devise: did you mean 'device'?"):
        csgrt.Scene(csgrt.sphere(1), devise="cpu")
    with pytest.raises(TypeError, match="tolerance: expected a number, not 'surfaces'"):
        csgrt.Scene(csgrt.sphere(1), tolerance="surfaces")


def test_warnings_are_values_and_warn_once(tmp_path):
    text = ('title {t}\nunits mm\nput {b.s} ell V {0 0 0} A {1 0 0} B {0 1 0} C {0 0 1}\n'
            'put {x.r} comb region yes tree {u {l b.s} {l missing.s}}\n')
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        scene = csgrt.parse(text)
    assert [w.category for w in caught] == [csgrt.SceneWarning] and caught[0].filename == __file__
    assert len(scene.warnings) >= 1
    assert scene.warnings[0].text in str(caught[0].message)
    assert scene.warnings[0].reason and scene.warnings[0].count >= 1


def test_verify_judges_a_scene(operators):
    result = operators.verify(rays=200)
    assert result["passed"] and result["rays"] == 200 and result["wrong"] == result["bit_differences"] == 0
    with pytest.raises(csgrt.Error, match="needs a ray at least"):
        operators.verify(0)


def test_measure_weighs_parts():
    block, bore = csgrt.box((20, 20, 5)), csgrt.cylinder(7, 3).translate((10, 10, -1))
    scene = csgrt.Scene({"plate": block - bore, "pin": csgrt.cylinder(5, 3).translate((10, 10, 0))})
    result = scene.measure(rel_error=1e-3, densities={1: 7.85, "/pin": 8.8})
    plate, pin = result["/plate"], result["/pin"]
    assert result.reached and result.has_densities and result.rays > 0
    for part, volume, density in ((plate, 2000 - 45 * np.pi, 7.85e-6), (pin, 45 * np.pi, 8.8e-6)):
        assert part.kind == "region" and part.volume.half_width < 1e-3 * volume
        assert abs(part.volume.nominal - volume) < 2.5 * part.volume.half_width
        assert abs(part.mass.nominal - density * volume) < 2.5 * part.mass.half_width
    assert result.volume["/pin"] == pin.volume and result.mass["all"] == result.parts[0].mass
    assert abs(result["all"].volume.nominal - 2000) < 2.5 * result["all"].volume.half_width
    assert scene.measure(rel_error=1e-3, densities={1: 7.85, "/pin": 8.8}).parts == result.parts
    assert plate.wall is None
    thin = scene.measure(wall_limit=5.5)["/plate"]
    assert thin.thin == 1 and thin.wall == (5, thin.wall.start, thin.wall.end, False)
    assert sorted((thin.wall.start[2], thin.wall.end[2])) == [0, 5]
    assert result.grid is None
    grid = scene.measure(rel_error=1e-3, grid=(4, 5, 2)).grid
    assert grid.shape == (4, 5, 2) and grid.box == ((0, 0, 0), (20, 20, 5))
    cells, ids, volumes, half_widths = grid.regions
    assert cells.shape == (len(ids), 3) and cells.max(axis=0).tolist() == [3, 4, 1]
    full = (ids == plate.id) & (cells[:, 0] == 0)
    assert full.sum() == 10 and np.all(abs(volumes[full] - 50) < 3 * half_widths[full])
    assert np.isclose(grid.materials.volumes.sum(), volumes.sum(), rtol=1e-12)
    with pytest.raises(KeyError, match="did you mean '/plate'"):
        result["/plat"]
    for wrong in ({"rel_eror": 1}, {"rel_error": "x"}, {"densities": {1: "a"}}, {"densities": {1.5: 1}}):
        with pytest.raises(TypeError, match="rel_error|a dict of g/cm"):
            scene.measure(**wrong)
    with pytest.raises(csgrt.Error, match="must be greater than 0"):
        scene.measure(rel_error=0)


def test_the_model_stays_while_it_is_measured():
    scene = csgrt.Scene({"ball": csgrt.sphere(1)})
    told = []

    def undo(*_):
        with pytest.raises(csgrt.Error, match="a signal handler asks the scene whose call it interrupts"):
            scene.undo()
        told.append(scene["/ball"].color)

    before = signal.signal(signal.SIGALRM, undo)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.1)
        assert not scene.measure(rel_error=1e-12, time=0.5).reached
    finally:
        signal.signal(signal.SIGALRM, before)
    assert told
    with pytest.raises(csgrt.Error, match="there is no commit to undo"):
        scene.undo()


def test_check_finds_overlaps(tmp_path):
    box, low = csgrt.box((10, 10, 10)), csgrt.solid("half", normal=(0, 0, 1), distance=-1)
    scene = csgrt.Scene({"left": box, "right": box.translate((9, 0, 0)), "touching": box.translate((0, 10, 0)),
                         "ground": low})
    result = scene.check()
    assert len(result) == 1 and list(result) == result.overlaps == result.new and result.is_complete
    assert result.new_overlaps == 1 and result.candidates >= 1 and result.shallow == 0 and result.rays > 0
    assert result.unbounded == ["/ground"] and result.unused == []
    assert {pair.paths for pair in result.unlisted} == {(part, "/ground") for part in ("/left", "/right", "/touching")}
    assert all(pair.regions[1] == 3 and not pair.is_seen for pair in result.unlisted)
    overlap = result.overlaps[0]
    assert overlap.paths == ("/left", "/right") == tuple(scene.regions[i].path for i in overlap.regions)
    assert 0.99 < overlap.depth <= overlap.depth_at_most < 1.01 and not overlap.is_allowed and not overlap.is_near_limit
    assert abs(overlap.volume.nominal - 100) < 2.5 * overlap.volume.half_width
    assert abs(overlap.place[0] - 9.5) < 0.01 and np.allclose(overlap.box, ((9, 0, 0), (10, 10, 10)), atol=0.6)
    origin, direction = np.asarray(overlap.ray)
    for t in (overlap.t_in, overlap.t_out):
        assert np.all(np.abs(origin + t * direction - (9.5, 5, 5)) < (0.51, 5.1, 5.1))
    link = json.loads(urllib.parse.unquote(overlap.link.removeprefix("#")))
    assert link["camera"]["center"] == list(overlap.place) and link["selected"] == ["/left", "/right"]
    assert scene.check().overlaps == result.overlaps
    (hostile,) = csgrt.Scene({'a "b\\" 100% \u00fc&#': box, "c\td": box.translate((9, 0, 0))}).check()
    assert json.loads(urllib.parse.unquote(hostile.link[1:], errors="strict"))["selected"] == list(hostile.paths)

    allowed = tmp_path / "allowed"
    allowed.write_text("/right /l*  # welded\n/left /ground\n")
    for given in (allowed, str(allowed), [("/right", "/l*"), ("/left", "/ground")]):
        told = scene.check(allowed=given)
        assert told.new == [] and told.overlaps[0].is_allowed and told.unused == [("/left", "/ground")]
    assert not scene.check(min_depth=3)
    request = csgrt.CheckRequest()
    request.allowed = allowed
    assert request.allowed == [("/right", "/l*"), ("/left", "/ground")] and request.min_depth == 0.01
    for wrong, text in (({"min_dept": 1}, "did you mean 'min_depth'"), ({"seed": "x"}, "a whole number"),
                        ({"allowed": 3}, "a list of pairs of patterns of paths, or a file's path"),
                        ({"allowed": [("ab", "cd", "e")]}, "a list of pairs"),
                        ({"allowed": ("ab", "cd")}, "a list of pairs")):
        with pytest.raises(TypeError, match=text):
            scene.check(**wrong)
    with pytest.raises(csgrt.Error, match="greater than 0 mm"):
        scene.check(min_depth=0)
    with pytest.raises(csgrt.Error) as missing:
        scene.check(allowed="/nowhere")
    assert missing.value.status == "file"


def test_the_command_writes_volumes_in_cells_for_numpy(command, scenes, tmp_path):
    scene = scenes / "bracket.json"
    command("measure", scene, "--grid", "7,5,3", "--grid-output", tmp_path / "cells.npz", capture_output=True)
    grid = csgrt.load(scene).measure(grid=(7, 5, 3)).grid
    with np.load(tmp_path / "cells.npz") as cells:
        assert tuple(cells["shape"]) == grid.shape
        np.testing.assert_array_equal(cells["box"], grid.box)
        assert list(cells["region_names"]) == [region.path for region in csgrt.load(scene).regions]
        assert list(cells["material_names"]) == [f"material {number}" for number in cells["material_numbers"]]
        for kind, known in (("region", grid.regions), ("material", grid.materials)):
            for name in known._fields:
                np.testing.assert_array_equal(cells[f"{kind}_{name}"], getattr(known, name))


def test_a_path_has_the_box_of_the_regions_below_it():
    pair = csgrt.box((1, 1, 1)).color((1, 0, 0)) | csgrt.sphere(1).translate(5, 0, 0).color((0, 1, 0))
    scene = csgrt.Scene({"pair": pair, "other": csgrt.box((2, 3, 4))})
    assert (scene["/"].bounds == scene.bounds).all()
    assert (scene["pair/"].bounds == [[0, -1, -1], [6, 1, 1]]).all()
    assert (scene["/other"].bounds == [[0, 0, 0], [2, 3, 4]]).all()
    with pytest.raises(KeyError, match="2 regions lie below it, as '/pair/"):
        scene["/pair"].state
    with pytest.raises(KeyError, match="no region lies at or below '/nothing'"):
        scene["/nothing"].bounds


def test_devices_are_listed():
    assert any(device.platform == "csgrt" for device in csgrt.devices())
