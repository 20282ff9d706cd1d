"""What the figures of the examples share: colours that all eyes tell apart, sizes, and where they are saved."""

import os
import pathlib
import sys

import matplotlib.pyplot as plt

# Scenes and paths: those of the repository beside this file, or those that the package tactus installs.
EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"
if not (EXAMPLES / "heart").is_dir():
    EXAMPLES = pathlib.Path(os.environ.get("TACTUS_EXAMPLES", "/usr/share/tactus/examples"))
BLUE, ORANGE, GREEN, PINK, GREY = "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#555555"

plt.rcParams.update(
    {
        "figure.figsize": (7.2, 4.0),
        "figure.dpi": 100,
        "figure.constrained_layout.use": True,
        "font.size": 10,
        "axes.grid": True,
        "grid.color": "#dddddd",
        "axes.axisbelow": True,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.prop_cycle": plt.cycler(color=[BLUE, ORANGE, GREEN, PINK, GREY]),
        "legend.frameon": False,
        "lines.linewidth": 1.5,
    }
)


def save(figure, name):
    """Saves a figure in the folder that the command line names, or here."""
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    figure.savefig(folder / f"{name}.png")
    print(folder / f"{name}.png")
