"""Whole simulated runs, and certificates."""

import json
import os
import tempfile
import warnings
from typing import Any, Dict, List, Optional, Sequence, Union

from . import _core
from ._arrays import PathLike, Table, above_zero, numbers, path_text, table, texts, times
from ._scene import Scene


class SimulationWarning(UserWarning):
    """A simulation may not do what was meant, for example because the device does not reach so far."""


def simulate(
    scene: Scene,
    device: Union[str, Sequence[str]] = "cartesian",
    hand: Union[str, Sequence[str]] = "pen",
    *,
    seed: int = 1,
    seconds: Optional[float] = None,
    path: Any = None,
    rate_hz: float = 1000.0,
    compensate: float = 0.0,
    faults: Sequence[str] = (),
) -> Union[Table, List[Table]]:
    """Lets a simulated hand and device touch a scene through the controller, as `tactus sim` does.

    Returns an array with a row for each tick and a field for each column of a recording, such as
    tool_x_m, force_z_N, mode and state_hash, and where the hand wants to be: wish_x_m, wish_y_m, wish_z_m.

    `path` is a CSV file with the columns t_s,x_m,y_m,z_m, or an array of those four columns, (N, 4);
    without one the hand presses and strokes the scene for ten seconds. Several devices touch one scene:
    `device` is then a sequence of names, `path` one of paths, and a list of arrays is returned.
    Warns with SimulationWarning; raises Error for names and numbers that cannot be used.
    """
    if not isinstance(scene, Scene):
        raise TypeError(f"scene has to be a tactus.Scene, not {type(scene).__name__}")
    options = _core.RunOptions()
    options.devices = texts("device", device)
    options.hands = texts("hand", hand)
    options.seed = seed
    options.rate_hz = above_zero("rate_hz", rate_hz)
    options.compensated_share = float(numbers("compensate", compensate, ()))
    options.seconds = None if seconds is None else above_zero("seconds", seconds)
    options.faults = texts("faults", faults)
    several = not isinstance(device, str)
    paths = [] if path is None else list(path) if several else [path]
    with tempfile.TemporaryDirectory(prefix="tactus-") as folder:
        options.paths = [_path_file(each, folder, i) for i, each in enumerate(paths)]
        found, texts_of_warnings = _core.simulate(scene._file, options)
    for text in texts_of_warnings:
        warnings.warn(text, SimulationWarning, stacklevel=2)
    runs = [table(columns) for columns in found]
    return runs if several else runs[0]


def certify(
    device: PathLike, *, margin: float = 1.25, dampings: int = 9, threads: int = 0
) -> Dict[str, Any]:
    """Finds out how stiff a surface a device holds, as `tactus certify` does; it takes minutes.

    Writes the certificate, the table and the picture beside the device's file, and returns what
    `tactus certify --json` prints. `threads` is 0 for one a processor. Ctrl-C is heard at the end.
    """
    return dict(json.loads(_core.certify(path_text("device", device), margin, dampings, threads)))


def _path_file(path: Any, folder: str, number: int) -> str:
    """Returns the name of a path's file; an array is written to one, each number with all its bits."""
    if isinstance(path, (str, os.PathLike)):
        return path_text("path", path)
    rows = numbers("path", path, ("N", 4))
    times("path[:, 0]", rows[:, 0])
    name = os.path.join(folder, f"path{number}.csv")
    with open(name, "w", encoding="ascii") as file:
        file.write("t_s,x_m,y_m,z_m\n")
        file.writelines(",".join(repr(float(each)) for each in row) + "\n" for row in rows)
    return name
