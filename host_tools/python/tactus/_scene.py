"""Baked scenes, and the touch without a device."""

import json
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict, List, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import Numbers, PathLike, above_zero, numbers, path_text, times


class BakeWarning(UserWarning):
    """Baking found something in a scene or a device that may not be what was meant."""


def bake(file: PathLike, image: Optional[PathLike] = None) -> Dict[str, Any]:
    """Bakes a scene.toml or device.toml into an image, as `tactus bake` does.

    Without `image` the image takes the file's name with .tactus. Returns the report that
    `tactus bake --json` prints. Warns with BakeWarning; raises Error if the file cannot be baked, and an
    older image is then still there.
    """
    source = path_text("file", file)
    output = str(Path(source).with_suffix(".tactus")) if image is None else path_text("image", image)
    report, found = _core.bake(source, output)
    for text in found:
        warnings.warn(text, BakeWarning, stacklevel=2)
    return dict(json.loads(report))


@dataclass(frozen=True)
class Touch:
    """The course of one tool that was led over a scene: an array with N rows for each quantity."""

    t_s: Numbers
    """The time, s, (N,)."""
    tool_m: Numbers
    """The tool's centre, m, (N, 3)."""
    proxy_m: Numbers
    """The proxy's centre, m, (N, 3)."""
    force_N: Numbers
    """The force on the hand, N, (N, 3)."""
    normal: Numbers
    """The unit normal of the contact; zero without one, (N, 3)."""
    depth_m: Numbers
    """How far the proxy stands above the tool along the normal, m, (N,)."""
    contact: npt.NDArray[np.uint8]
    """0 none, 1 face, 2 edge, 3 vertex, (N,)."""
    friction_state: npt.NDArray[np.uint8]
    """0 free, 1 stick, 2 slip, (N,)."""
    object: npt.NDArray[np.int64]
    """The number of the touched object in Scene.objects; -1 without contact, (N,)."""
    flags: npt.NDArray[np.uint32]
    """The limits that the tick reached, one bit each; 0: none, (N,)."""
    short_of_goal_m: Numbers
    """How far a limit ended the proxy's moves before their goal, m, (N,)."""
    state_hash: npt.NDArray[np.uint64]
    """A chain over all ticks so far, as `tactus touch --hashes` writes it: equal hashes are equal bits, (N,)."""

    def __len__(self) -> int:
        return len(self.t_s)


class Scene:
    """A baked scene. It does not change, so any number of threads may use it at once."""

    def __init__(self, image: Union[PathLike, bytes]) -> None:
        """Opens and checks an image: a path, or its bytes. Raises Error if it is damaged or no scene."""
        if isinstance(image, (bytes, bytearray, memoryview)):
            self._file = _core.SceneFile.of_bytes(bytes(image))
        else:
            self._file = _core.SceneFile(path_text("image", image))

    @property
    def checksum(self) -> str:
        """The checksum of the image, as `tactus inspect` prints it."""
        return f"{self._file.checksum:016x}"

    @property
    def tool_radius_m(self) -> float:
        """The radius of the tool, m; 0 is a god-object point."""
        return self._file.tool_radius_m

    @property
    def objects(self) -> List[Dict[str, Any]]:
        """What the image says of each object: name, triangles, vertices, contact, stiffness, damping, moves."""
        return self._file.objects()

    @property
    def names(self) -> List[str]:
        """The names of the objects."""
        return [entry["name"] for entry in self.objects]

    def mesh(self, name: Union[str, int]) -> Tuple[Numbers, npt.NDArray[np.uint32]]:
        """Returns an object's vertices, m, (V, 3), and the numbers of each triangle's corners, (T, 3).

        A primitive or a formula has the mesh of its picture. Raises Error if there is no such object.
        """
        names = self.names
        known = name in names if isinstance(name, str) else 0 <= name < len(names)
        if not known:
            raise _core.Error(f"{self._file.name}: there is no object {name!r}; there are {', '.join(names)}")
        return self._file.mesh(names.index(name) if isinstance(name, str) else name)

    def touch(
        self, positions_m: Any, *, rate_hz: float = 1000.0, t_s: Any = None
    ) -> Union[Touch, List[Touch]]:
        """Leads a tool over the scene, one tick a position, as `tactus touch` does.

        `positions_m` is (N, 3): the tool's centre at each tick, m. The proxy starts at the first. With
        (tools, N, 3) each tool has a path of its own in one world, and a list of Touch is returned. The
        ticks are 1 / rate_hz apart, or at the times `t_s`, (N,), which grow. Velocities are differences.
        """
        places = np.asarray(positions_m)
        several = places.ndim == 3
        lengths: List[Union[int, str]] = ["tools", "N", 3] if several else ["N", 3]
        places = numbers("positions_m", places, tuple(lengths))
        if t_s is None:
            moments = np.arange(places.shape[-2]) / above_zero("rate_hz", rate_hz)
        else:
            moments = times("t_s", t_s)
            if len(moments) != places.shape[-2]:
                raise ValueError(f"t_s has {len(moments)} times for {places.shape[-2]} positions")
        tools = places if several else places[np.newaxis]
        found = [
            Touch(t_s=moments, tool_m=tool, **rows)
            for tool, rows in zip(tools, self._file.touch(moments, tools))
        ]
        return found if several else found[0]

    def __repr__(self) -> str:
        return f"<tactus.Scene {self._file.name}: {', '.join(self.names)}>"
