"""scene.view(): the command serves the page."""

import json
import os
import signal
import subprocess
import sys
import time
import urllib.error
import urllib.request

import pytest

import csgrt


def ask(page, name):
    request = urllib.request.Request(f"{page.address}api/{name}", b"{}", {"Content-Type": "application/json"})
    with urllib.request.urlopen(request, timeout=30) as answer:
        return json.load(answer)


@pytest.fixture
def command(command):
    if "csgrt view" not in command("--help", capture_output=True, text=True).stdout:
        pytest.skip("this csgrt was built without zlib")
    return os.environ["CSGRT_COMMAND"]


def test_a_page_shows_the_scene_as_it_is_and_ends(operators, command):
    operators["/operators/union"].color = (0, 0.25, 1)
    operators["/operators/intersection"].state = "hidden"
    operators.commit()
    with operators.view(command=command, height=300) as page:
        model = ask(page, "model")
        assert model["paths"] == [region.path for region in operators.regions]
        own = [(look["color"], look["state"]) for look in model["own_looks"]]
        looks = {path: own[look] for path, look in zip(model["paths"], model["look_of"])}
        assert looks["/operators/union"] == ([0, 0.25, 1], "shown")
        assert looks["/operators/intersection"][1] == "hidden"
        assert page.address in page._repr_html_() and "300px" in page._repr_html_()
    with pytest.raises(urllib.error.URLError):
        ask(page, "model")
    page = operators.view(command=command)
    address = page.address
    del page  # ends it, too
    time.sleep(0.1)
    with pytest.raises(urllib.error.URLError):
        urllib.request.urlopen(address, timeout=5)


@pytest.mark.parametrize("name", ["SIGTERM", "SIGKILL"])
def test_a_python_that_is_killed_takes_its_page_with_it(scenes, command, name):
    program = ("import csgrt, sys, time\n"
               "page = csgrt.load(sys.argv[1]).view(command=sys.argv[2])\n"
               "print(page.address, flush=True)\n"
               "time.sleep(60)\n")
    with subprocess.Popen([sys.executable, "-c", program, scenes / "operators.json", command],
                          stdout=subprocess.PIPE, text=True) as python:
        address = python.stdout.readline().strip()
        urllib.request.urlopen(address, timeout=30).close()
        python.send_signal(getattr(signal, name))
        python.wait(30)
    for _ in range(200):
        try:
            urllib.request.urlopen(address, timeout=5).close()
        except OSError:
            return
        time.sleep(0.05)
    raise AssertionError("the page is still there")


def test_without_the_command_a_sentence_says_what_is_missing(operators):
    with pytest.raises(FileNotFoundError, match="scene.view.. needs the command no-such-csgrt"):
        operators.view(command="no-such-csgrt")


def test_a_command_that_fails_raises(operators, command, tmp_path):
    broken = tmp_path / "csgrt"
    broken.write_text("#!/bin/sh\nexit 4\n")
    broken.chmod(0o755)
    with pytest.raises(RuntimeError, match="ended with status 4"):
        operators.view(command=str(broken))
