"""Recordings of tactusd and `tactus sim --record` as arrays."""

from typing import Dict, List, NamedTuple, Optional, Sequence, Tuple

import numpy as np

from . import _core
from ._arrays import PathLike, Table, path_text, table, texts


class Event(NamedTuple):
    """Something that happened between two ticks, such as a changed parameter."""

    tick: int
    kind: str
    name: str
    value: float


def read_recording(
    file: PathLike,
    fields: Sequence[str] = (),
    *,
    every: int = 1,
    from_s: Optional[float] = None,
    to_s: Optional[float] = None,
) -> Table:
    """Reads the ticks of a recording (.mcap) as `tactus export` writes them.

    Returns an array with a row for each tick and a field for each column. `fields` are names of columns
    or their beginnings: "force" stands for force_x_N, force_y_N and force_z_N; without any, all are read.
    `every`, `from_s` and `to_s` choose ticks. Raises Error if the file is no recording, is damaged, or
    has no such field or tick.
    """
    if every < 1:
        raise ValueError(f"every is {every}; it has to be 1 or more")
    return table(
        _core.read_recording(
            path_text("file", file),
            texts("fields", fields),
            every,
            -np.inf if from_s is None else from_s,
            np.inf if to_s is None else to_s,
        )
    )


def read_events(file: PathLike) -> Tuple[Dict[str, str], List[Event]]:
    """Returns what a recording says of its run, such as its program, and the events of the run."""
    info, events = _core.read_events(path_text("file", file))
    return info, [Event(*each) for each in events]
