"""Lets a simulated hand and device stroke a heart through the real controller, and draws the run.

python3 simulate.py [FOLDER]
"""

# %% The scene is a formula; the path is where the hand wants to be.
import pathlib
import tempfile

import matplotlib.pyplot as plt
import numpy as np

import tactus
from style import EXAMPLES, save

folder = tempfile.TemporaryDirectory()
image = pathlib.Path(folder.name) / "heart.tactus"
tactus.bake(EXAMPLES / "heart" / "scene.toml", image)
scene = tactus.Scene(image)
run = tactus.simulate(scene, device="cartesian", hand="pen", seed=1, path=EXAMPLES / "heart" / "wish.csv")
print(f"{len(run)} ticks; the last state hash is {run['state_hash'][-1]:016x}")

# %% Vectors are three fields; these are arrays with a row for each tick.
proxy_m = np.column_stack([run[f"proxy_{axis}_m"] for axis in "xyz"])
force_N = np.column_stack([run[f"force_{axis}_N"] for axis in "xyz"])
size_N = np.linalg.norm(force_N, axis=1)

# %% From the front: the outline of the heart, and the proxy coloured by the force.
figure, (front, over_time) = plt.subplots(1, 2, figsize=(9.0, 4.0), gridspec_kw={"width_ratios": [1, 1.2], "wspace": 0.08})
vertices_m, triangles = scene.mesh(0)
front.triplot(1e3 * vertices_m[:, 0], 1e3 * vertices_m[:, 1], triangles, color="#e4e4e4", linewidth=0.3)
touching = run["contact"] > 0
points = front.scatter(
    *(1e3 * proxy_m[touching][:, :2]).T, c=size_N[touching], s=4, cmap="viridis", rasterized=True
)
figure.colorbar(points, ax=front, label="force, N", shrink=0.8)
front.set_aspect("equal")
front.grid(False)
front.set_title("The stroke from the front")
front.set_xlabel("x, mm")
front.set_ylabel("y, mm")

# %% Over time: the force on the hand along each axis.
for axis, component_N in zip("xyz", force_N.T):
    over_time.plot(run["time_s"], component_N, label=axis)
over_time.set_title("The force on the hand")
over_time.set_xlabel("time, s")
over_time.set_ylabel("force, N")
over_time.legend(loc="upper left", title="along")
save(figure, "simulate")
