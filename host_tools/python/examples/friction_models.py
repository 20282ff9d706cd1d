"""Compares friction models by their hysteresis loops, and by how they let go.

python3 friction_models.py [FOLDER]
"""

# %% A tangential motion that is small at first and larger afterwards, as in Dahl's experiment.
import matplotlib.pyplot as plt
import numpy as np

import tactus
from style import save

t_s = np.arange(0.0, 4.0, 1e-4)
x_m = np.where(t_s < 2.0, 4e-6, 1.2e-5) * np.sin(2 * np.pi * t_s)

models = {"coulomb": "Coulomb", "dahl": "Dahl", "lugre": "LuGre", "elasto_plastic": "elasto-plastic"}
dashes = {"coulomb": ":", "dahl": "--", "lugre": "-", "elasto_plastic": "-."}

# %% The force over the displacement is a loop; its area is the energy that a cycle takes.
figure, (loops, slips) = plt.subplots(1, 2, figsize=(9.0, 4.0))
for model, name in models.items():
    friction = tactus.Friction(model)
    run = friction.motion(t_s, x_m)
    last = run[t_s >= 3.0]
    steps_m = np.diff(last["x_m"])
    energy_J = float(np.sum(0.5 * (last["force_N"][1:] + last["force_N"][:-1]) * steps_m))
    print(f"{name:14} {1e6 * energy_J:6.1f} uJ a cycle of {1e6 * x_m.max():.0f} um")
    loops.plot(1e6 * last["x_m"], last["force_N"], dashes[model], label=name)
loops.set_title("One cycle of 12 µm")
loops.set_xlabel("displacement, µm")
loops.set_ylabel("friction along the motion, N")
loops.set_ylim(-1.9, 1.9)
loops.legend(loc="upper left", ncol=2)

# %% A mass of 1 kg that a spring pulls sticks and slips, if the friction falls once it slides.
for model, dash in (("karnopp", "--"), ("lugre", "-")):
    track, findings = tactus.Friction(model).experiment("stick-slip", rate_hz=4000)
    slips.plot(track["t_s"], track["x_m"], dash, label={"karnopp": "Karnopp", "lugre": "LuGre"}[model])
slips.plot(track["t_s"], track["spring_end_m"], color="#555555", linewidth=1.0, label="end of the spring")
slips.set_title("A mass on a spring that is pulled")
slips.set_xlabel("time, s")
slips.set_ylabel("position, m")
slips.legend(loc="upper left")
save(figure, "friction_models")
