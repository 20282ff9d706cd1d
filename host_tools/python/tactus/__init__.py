"""Haptic rendering with Tactus, from Python.

The functions do what the verbs of the program `tactus` do, through the same code: the same inputs give
the same bits. Everything is in SI units, in the world frame (right-handed: x right, y up, z toward the
user), with numpy arrays in and out.

    import numpy as np
    import tactus

    tactus.bake("scene.toml", "scene.tactus")
    scene = tactus.Scene("scene.tactus")
    positions_m = np.linspace([0, 0, 0.05], [0, 0, 0.03], 500)
    touch = scene.touch(positions_m, rate_hz=1000)
    print(touch.force_N.max())

A mistake in a scene, a file or a parameter raises `tactus.Error` with the message of the program. An
array of a wrong shape or type raises `ValueError` or `TypeError`.
"""

from ._core import Error, Unreachable, __version__
from ._friction import Friction
from ._live import Controller, Refused, Ticks, connect
from ._recording import Event, read_events, read_recording
from ._scene import BakeWarning, Scene, Touch, bake
from ._simulation import SimulationWarning, certify, simulate

__all__ = [
    "BakeWarning",
    "Controller",
    "Error",
    "Event",
    "Friction",
    "Refused",
    "Scene",
    "SimulationWarning",
    "Ticks",
    "Touch",
    "Unreachable",
    "__version__",
    "bake",
    "certify",
    "connect",
    "read_events",
    "read_recording",
    "simulate",
]

Error.__module__ = "tactus"
Error.__doc__ = "A mistake that the user can mend; the message says where it is and what to do."
Unreachable.__module__ = "tactus"
Unreachable.__doc__ = "No controller could be asked, or none replied."
