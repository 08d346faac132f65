"""A scene in a browser: the command csgrt serves the page."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from subprocess import Popen

    from ._scene import Scene


def _end(process: Popen[str]) -> None:
    import subprocess

    if process.stdout:
        process.stdout.close()  # at which it ends, as it does when this process is killed
    try:
        process.wait(5)
    except subprocess.TimeoutExpired:  # a child of this process has the pipe, too
        process.terminate()
        process.wait()


class Page:
    """A page that shows a scene as it was when Scene.view() made it. A notebook shows it where it is the last value of
    a cell. It ends with close(), with the last reference, or with Python."""

    def __init__(self, scene: Scene, in_browser: bool = False, height: int = 640, command: str = "csgrt"):
        import os  # here: these take as long to load as the rest of the package
        import shutil
        import subprocess
        import tempfile
        import weakref

        program = shutil.which(command)
        if program is None:
            raise FileNotFoundError(
                f"scene.view() needs the command {command}, built with zlib, which is not in this package: "
                "./setup builds it, and PATH or command= tells where it is")
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "scene.json")
            scene.save(path)
            arguments = [program, "view", "-"] + ["--open"] * in_browser
            with open(path) as text:
                process = subprocess.Popen(arguments, stdin=text, stdout=subprocess.PIPE, text=True)
            address = process.stdout.readline().strip() if process.stdout else ""
        self._end = weakref.finalize(self, _end, process)
        if not address:
            self.close()
            raise RuntimeError(f"{program} view ended with status {process.returncode}; it has written why")
        self.address: str = address
        self.height: int = height

    def close(self) -> None:
        """Ends the page."""
        self._end()

    def __enter__(self) -> Page:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _repr_html_(self) -> str:
        return (f'<iframe src="{self.address}" style="width: 100%; height: {self.height}px; border: 0">'
                "</iframe>")

    def __repr__(self) -> str:
        return f"<csgrt.Page {self.address}>"
