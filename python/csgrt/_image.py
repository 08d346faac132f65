"""Pictures."""

from __future__ import annotations

from typing import IO, TYPE_CHECKING, Any, overload

import numpy as np

if TYPE_CHECKING:
    from os import PathLike
    from typing import Literal

    from numpy.typing import NDArray
    from PIL.Image import Image as Pillow


class Image:
    """A picture: rows of pixels, the top left first. All arrays show the same memory, which outlives the scene."""

    def __init__(self, planes: NDArray[np.float32], names: list[str]):
        self._planes = planes  # (channels, height, width)
        self.names = names  #: of the channels

    @overload
    def __getitem__(self, name: Literal["region", "solid", "ghost", "RGBA8"]) -> NDArray[np.uint32]: ...
    @overload
    def __getitem__(self, name: str) -> NDArray[Any]: ...
    def __getitem__(self, name: str) -> NDArray[Any]:
        """A channel, (height, width) float32; of region, solid, ghost and RGBA8 uint32. Raises KeyError."""
        if name not in self.names:
            raise KeyError(f"the picture has no channel {name}, but {', '.join(self.names)}")
        plane: NDArray[Any] = self._planes[self.names.index(name)]
        return plane.view(np.uint32) if name in ("region", "solid", "ghost", "RGBA8") else plane

    def _group(self, first: str, count: int) -> NDArray[np.float32]:
        begin = self.names.index(first)
        return np.moveaxis(self._planes[begin : begin + count], 0, -1)

    @property
    def color(self) -> NDArray[np.uint8]:
        """(height, width, 4) uint8: what a display shows (sRGB)."""
        return self["RGBA8"].view(np.uint8).reshape(*self._planes.shape[1:], 4)

    @property
    def rgba(self) -> NDArray[np.float32]:
        """(height, width, 4) float32: linear light."""
        return self._group("R", 4)

    @property
    def depth(self) -> NDArray[np.float32]:
        """(height, width) float32: mm along the ray; infinity where it meets nothing."""
        return self["Z"]

    @property
    def normal(self) -> NDArray[np.float32]:
        """(height, width, 3) float32: unit normals, outward from the region."""
        return self._group("N.X", 3)

    @property
    def region_ids(self) -> NDArray[np.uint32]:
        """(height, width) uint32: id in Scene.regions + 1; 0 where the ray meets nothing."""
        return self["region"]

    def to_pillow(self) -> Pillow:
        """The colours as a Pillow image: RGB if all pixels are opaque, else RGBA. Raises ImportError without Pillow."""
        try:
            from PIL import Image as pillow
        except ModuleNotFoundError:
            raise ModuleNotFoundError("pictures need Pillow: pip install 'csgrt[pictures]'", name="PIL") from None
        color = self.color
        return pillow.fromarray(color[..., :3] if (color[..., 3] == 255).all() else color)

    def save(self, path: str | PathLike[str] | IO[bytes], format: str | None = None) -> None:  # noqa: A002
        """Writes the colours by Pillow, whose format the extension tells: .png, .jpg, .tif, ..."""
        picture = self.to_pillow()
        from PIL import PngImagePlugin

        header = PngImagePlugin.PngInfo()
        header.add(b"sRGB", b"\0")  # other formats do not look at it
        picture.save(path, format, pnginfo=header)

    def _repr_png_(self) -> bytes:
        from io import BytesIO

        file = BytesIO()
        self.save(file, "png")
        return file.getvalue()

    def __repr__(self) -> str:
        return f"<csgrt.Image {self._planes.shape[2]} x {self._planes.shape[1]}: {' '.join(self.names)}>"
