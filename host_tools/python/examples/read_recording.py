"""Reads a recording into arrays, and draws the modes, the force and where the energy went.

python3 read_recording.py [FOLDER [RUN.mcap]]; without a recording it lets the program tactus record one
"""

# %% A recording of tactusd or of a simulation.
import pathlib
import subprocess
import sys
import tempfile

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Patch

import tactus
from style import BLUE, EXAMPLES, GREEN, GREY, ORANGE, PINK, save

folder = tempfile.TemporaryDirectory()
if len(sys.argv) > 2:
    recording = pathlib.Path(sys.argv[2])
else:
    image = pathlib.Path(folder.name) / "heart.tactus"
    recording = pathlib.Path(folder.name) / "run.mcap"
    tactus.bake(EXAMPLES / "heart" / "scene.toml", image)
    subprocess.run(
        ["tactus", "sim", image, "--path", EXAMPLES / "heart" / "wish.csv", "--record", recording],
        check=True,
        stdout=subprocess.DEVNULL,
    )
run = tactus.read_recording(recording)
info, events = tactus.read_events(recording)
print(f"{info['program']}: {len(run)} ticks, {len(run.dtype.names)} fields, {len(events)} events")

# %% Words stay words: the mode of each tick, and where it changes.
changes = np.flatnonzero(np.concatenate([[True], run["mode"][1:] != run["mode"][:-1]]))
figure, (force, energy) = plt.subplots(2, 1, sharex=True, figsize=(7.2, 5.0))
size_N = np.sqrt(sum(run[f"force_{axis}_N"] ** 2 for axis in "xyz"))
force.plot(run["time_s"], size_N)
force.set_ylabel("force on the hand, N")
force.set_ylim(0, 1.25 * max(size_N.max(), 1e-3))
colours = dict(zip(np.unique(run["mode"]), (GREEN, ORANGE, PINK, GREY, BLUE)))
for begin, end in zip(changes, [*changes[1:], len(run) - 1]):
    force.axvspan(run["time_s"][begin], run["time_s"][end], 0.95, 1.0, color=colours[run["mode"][begin]])
modes = [Patch(color=colour, label=mode) for mode, colour in colours.items()]
force.legend(handles=modes, title="mode", loc="center left", bbox_to_anchor=(1.0, 0.5))
force.set_title("A recorded run: the modes and the force")

# %% The ledger of energy: every field that begins with energy_ and was not always zero.
for name in (each for each in run.dtype.names if each.startswith("energy_")):
    if np.abs(run[name]).max() > 1e-6:
        energy.plot(run["time_s"], 1e3 * run[name], label=name[len("energy_") : -len("_J")])
energy.set_title("The energy that the hand has got, by its source")
energy.set_xlabel("time, s")
energy.set_ylabel("energy, mJ")
energy.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), title="source")
save(figure, "read_recording")
