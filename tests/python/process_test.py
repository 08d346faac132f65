"""What a process notices: memory, threads, forks, signals, the time of an import."""

import multiprocessing
import os
import pydoc
import re
import shutil
import signal
import subprocess
import sys
import textwrap
import threading
import time

import numpy as np
import pytest

import csgrt


def run(code, *arguments):
    """A Python of its own. The answer is what it prints."""
    program = [sys.executable, "-c", textwrap.dedent(code), *map(str, arguments)]
    return subprocess.run(program, check=True, capture_output=True, text=True, timeout=300).stdout


def test_scenes_made_and_dropped_leave_no_memory():
    grown = run("""
        import csgrt
        def resident():
            return int(open("/proc/self/statm").read().split()[1]) * 4096 / 1e6
        rays = [[-5, 0, 0, 1, 0, 0]] * 10
        def once(i):
            scene = csgrt.Scene(csgrt.sphere(1 + i % 7) - csgrt.box(1))
            parts = scene.partitions(rays, normals=True)
            if i % 10:
                return
            image = scene.render(16, 16)
            try:
                scene["/none"].color = (1, 0, 0)
                scene.commit()
            except csgrt.Error as error:
                scene.discard()
            scene["/part"].color = (1, 0, 0)
            scene.commit()
            len(scene.regions)
        for i in range(500):
            once(i)
        before = resident()
        for i in range(10000):
            once(i)
        print(resident() - before)
    """)
    assert float(grown) < 10


def test_four_threads_have_the_same_answers(operators, scenes, random_rays):
    rays = random_rays(operators, 3000)
    expected = operators.partitions(rays)
    wrong = []

    def work(scene):
        for _ in range(5):
            found = scene.partitions(rays)
            if any(found[name].tobytes() != expected[name].tobytes() for name in expected):
                wrong.append(scene)

    for own in (False, True):  # one scene for all, and one for each
        made = [csgrt.load(scenes / "operators.json") if own else operators for _ in range(4)]
        threads = [threading.Thread(target=work, args=(scene,)) for scene in made]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    assert not wrong


def test_computations_release_the_interpreter(operators):
    rays = csgrt.rays_parallel(operators.bounds, "x", (1500, 1500))
    done = threading.Event()

    def work():
        for _ in range(3):
            operators.partitions(rays)
        done.set()

    thread = threading.Thread(target=work)
    steps = 0
    thread.start()
    while not done.is_set():
        steps += 1
        time.sleep(0.001)
    thread.join()
    assert steps > 20


inherited = None


def child(path, answers):
    try:
        inherited.cast_rays([[0, -9000, 0, 0, 1, 0]])
        answers.put("the inherited scene answered")
    except csgrt.Error as error:
        answers.put((error.status, str(error)))
    scene = csgrt.load(path)
    answers.put(scene.partitions([[0, -9000, 0, 0, 1, 0]])["t_in"].tolist())


def test_a_child_loads_anew_and_an_inherited_scene_raises(operators, scenes):
    global inherited
    inherited = operators
    expected = operators.partitions([[0, -9000, 0, 0, 1, 0]])["t_in"].tolist()
    context = multiprocessing.get_context("fork")
    answers = context.SimpleQueue()
    process = context.Process(target=child, args=(scenes / "operators.json", answers))
    process.start()
    process.join(60)
    assert process.exitcode == 0
    status, text = answers.get()
    assert status == "usage" and "before this process was forked" in text
    assert answers.get() == expected
    inherited = None
    assert operators.partitions([[0, -9000, 0, 0, 1, 0]])["t_in"].tolist() == expected


def slice_in_child(path):
    return csgrt.load(path).slice((0, 0, 1), 0, (40, 30)).tolist()


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_children_of_multiprocessing_have_the_same_answers(operators, scenes, method):
    with multiprocessing.get_context(method).Pool(2) as pool:
        for found in pool.map(slice_in_child, [scenes / "operators.json"] * 2):
            assert found == operators.slice((0, 0, 1), 0, (40, 30)).tolist()


def test_ctrl_c_ends_a_call_between_batches(operators):
    rays = np.tile(csgrt.rays_parallel(operators.bounds, "x", (1000, 1000)).reshape(-1, 6), (6, 1))
    before = signal.signal(signal.SIGINT, signal.default_int_handler)  # a job in the background ignores it
    timer = threading.Timer(0.1, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        while time.monotonic() < begin + 60:  # however fast the machine is
            operators.partitions(rays, normals=True, overlaps=True)
    assert time.monotonic() - begin < 5
    timer.join()
    signal.signal(signal.SIGINT, before)
    assert operators.cast_rays(rays[:10])["t_hit"].shape == (10,)  # the next call is answered


def test_import_touches_no_device_and_takes_20_ms(monkeypatch, tmp_path):
    monkeypatch.delenv("PYTHONDONTWRITEBYTECODE", raising=False)  # with it each import compiles the package
    monkeypatch.setenv("PYTHONPYCACHEPREFIX", str(tmp_path))
    times = []
    for _ in range(6):
        took, drivers, threads = run("""
            import os, time, numpy
            before, begin = len(os.listdir("/proc/self/task")), time.process_time()
            import csgrt
            took = time.process_time() - begin
            maps = open("/proc/self/maps").read()
            print(took * 1e3, "OpenCL" in maps or "pocl" in maps, len(os.listdir("/proc/self/task")) - before)
        """).split()
        assert drivers == "False" and threads == "0"
        times.append(float(took))
    assert min(times) < 20


def test_the_package_needs_libc_only():
    if not shutil.which("readelf"):
        pytest.skip("no readelf")
    text = subprocess.run(["readelf", "-d", csgrt._core.__file__], check=True, capture_output=True, text=True).stdout
    assert set(re.findall(r"NEEDED.*\[(.*?)\.so", text)) <= {"libc", "libm", "ld-linux-x86-64", "ld-linux-aarch64"}


def test_the_package_has_stubs_and_every_name_a_docstring():
    folder = os.path.dirname(csgrt.__file__)
    assert os.path.exists(os.path.join(folder, "py.typed")) and os.path.exists(os.path.join(folder, "_core.pyi"))
    for name in csgrt.__all__:
        assert getattr(csgrt, name).__doc__, name
        assert "Alias for field" not in pydoc.render_doc(getattr(csgrt, name)), name
    assert all(getattr(csgrt.Scene, name).__doc__ for name in dir(csgrt.Scene) if not name.startswith("_"))
    for name in ("cast_rays", "partitions", "test_occlusions", "region_at", "slice", "render", "pick", "verify",
                 "measure", "check"):
        assert "Raises" in getattr(csgrt.Scene, name).__doc__ or name in ("test_occlusions", "pick"), name
