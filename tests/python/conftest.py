"""What the tests share. ctest names the scenes and the command in the environment."""

import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

import csgrt

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="session")
def scenes():
    return Path(os.environ.get("CSGRT_SCENES", ROOT / "scenes"))


@pytest.fixture
def operators(scenes):
    return csgrt.load(scenes / "operators.json")


@pytest.fixture(scope="session")
def command():
    """Runs the command csgrt."""
    program = os.environ.get("CSGRT_COMMAND")
    if not program:
        pytest.skip("CSGRT_COMMAND does not name the command")
    return lambda *arguments, **more: subprocess.run([program, *map(str, arguments)], check=True, **more)


@pytest.fixture
def random_rays():
    def make(scene, count, seed=1):
        """Rays through two random points of the scene's box, of any length."""
        random = np.random.default_rng(seed)
        low, high = scene.bounds
        ends = random.uniform(low, high, (2, count, 3))
        return np.concatenate([2 * ends[0] - ends[1], ends[1] - ends[0]], axis=-1)

    return make
