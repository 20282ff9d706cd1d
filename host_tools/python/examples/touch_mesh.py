"""Presses a point into three gems of one mesh, and draws the force over the depth.

python3 touch_mesh.py [FOLDER]
"""

# %% A scene: one mesh three times, each with another contact method.
import pathlib
import tempfile

import matplotlib.pyplot as plt
import numpy as np

import tactus
from style import EXAMPLES, save

folder = tempfile.TemporaryDirectory()
image = pathlib.Path(folder.name) / "gem.tactus"
tactus.bake(EXAMPLES / "gem" / "scene.toml", image)
scene = tactus.Scene(image)
print(scene)

# %% Each gem is pressed from above, a tenth of a millimetre a tick, through its middle and out below.
methods = {"walked": ("feature walk", "-"), "met": ("god-object", "--"), "pushed": ("potential field", "-")}
figure, axis = plt.subplots()
for name, (method, line) in methods.items():
    vertices_m, triangles = scene.mesh(name)
    middle_m = 0.5 * (vertices_m.min(axis=0) + vertices_m.max(axis=0))
    # Beside the middle, where no two faces are equally near.
    z_m = np.arange(vertices_m[:, 2].max() + 0.002, vertices_m[:, 2].min() - 0.002, -1e-4)
    positions_m = np.column_stack(
        [np.full_like(z_m, middle_m[0] + 0.004), np.full_like(z_m, middle_m[1] + 0.003), z_m]
    )
    touch = scene.touch(positions_m, rate_hz=1000)
    print(f"{name:8} {touch.force_N[:, 2].max():.1f} N up, {touch.force_N[:, 2].min():.1f} N down")

    # %% The depth is how far the tool is below the first touch.
    first = np.flatnonzero(touch.contact)[0]
    axis.plot(1e3 * (z_m[first] - z_m), touch.force_N[:, 2], line, label=method)

axis.set_title("A point pressed through a gem of 51 mm")
axis.set_xlabel("depth below the first touch, mm")
axis.set_ylabel("force upward, N")
axis.set_xlim(left=0)
axis.legend(loc="upper left")
save(figure, "touch_mesh")
