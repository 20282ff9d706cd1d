"""Watches a running controller, draws the force over the depth, and compares it with the recording.

python3 live.py [FOLDER]; it starts a simulation in wall-clock time with the program tactus
"""

# %% A controller that runs: here a simulated one, behind the sockets that tactusd has.
import pathlib
import signal
import subprocess
import tempfile

import matplotlib.pyplot as plt
import numpy as np

import tactus
from style import EXAMPLES, save

folder = tempfile.TemporaryDirectory()
place = pathlib.Path(folder.name)
tactus.bake(EXAMPLES / "heart" / "scene.toml", place / "heart.tactus")
simulation = subprocess.Popen(
    ["tactus", "sim", "heart.tactus", "--path", EXAMPLES / "heart" / "wish.csv", "--serve", "--run-dir", "run",
     "--record", "run.mcap"],
    cwd=place,
    stdout=subprocess.DEVNULL,
)

# %% Home it, let it push, and watch some seconds: a dictionary for each tick.
ticks = []
try:
    with tactus.connect(place / "run", timeout_s=30) as controller:
        controller.home()
        controller.enable()
        print("max_force_N is", controller.get("max_force_N"))
        with controller.watch(["tick", "depth", "rendered", "contact"]) as watched:
            for tick in watched:
                ticks.append(tick)
                if sum(each["contact"] > 0 for each in ticks[-3000:]) >= 2000 or len(ticks) >= 10000:
                    break
        controller.disable()
finally:
    simulation.send_signal(signal.SIGINT)
    simulation.wait()
live = {name: np.array([tick[name] for tick in ticks]) for name in ticks[0]}

# %% The recording has the same ticks, to the bit; so has the table that the program writes of it.
recorded = tactus.read_recording(place / "run.mcap", list(live))
recorded = recorded[np.isin(recorded["tick"], live["tick"])]
subprocess.run(
    ["tactus", "export", "run.mcap", "-o", "run.csv", "--fields", ",".join(live)],
    cwd=place, check=True, stdout=subprocess.DEVNULL,
)
exported = np.genfromtxt(place / "run.csv", delimiter=",", names=True)
exported = exported[np.isin(exported["tick"], live["tick"])]
for name, values in live.items():
    np.testing.assert_array_equal(values, recorded[name])
    np.testing.assert_array_equal(values, exported[name])
print(f"{len(ticks)} ticks: live, recorded and exported are equal")

# %% The force over the depth: the points that came live, on the curve of the recording.
def size_of(run):
    return np.sqrt(sum(run[f"rendered_{axis}_N"] ** 2 for axis in "xyz"))

figure, axis = plt.subplots()
axis.plot(1e3 * recorded["depth_m"], size_of(recorded), linewidth=4.0, alpha=0.35, label="recording")
some = slice(None, None, 20)
axis.plot(1e3 * live["depth_m"][some], size_of(live)[some], ".", markersize=4, label="live, every 20th tick")
axis.set_title("The force over the depth, live and recorded")
axis.set_xlabel("depth of the tool below the surface, mm")
axis.set_ylabel("size of the rendered force, N")
axis.legend(loc="upper left")
save(figure, "live")
