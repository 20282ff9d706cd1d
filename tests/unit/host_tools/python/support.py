"""Folders, the program `tactus`, and small scenes for the tests of the Python module."""

import contextlib
import csv
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import unittest

import tactus

REPOSITORY = pathlib.Path(__file__).resolve().parents[4]
EXAMPLES = REPOSITORY / "host_tools" / "examples"
PROGRAM = os.environ["TACTUS_PROGRAM"]


def run_tactus(*arguments, cwd=None):
    """Runs the program, which must succeed, and returns its output."""
    return subprocess.run(
        [PROGRAM, *map(str, arguments)], check=True, capture_output=True, text=True, cwd=cwd, timeout=300
    ).stdout


def run_python(text, *arguments, **options):
    """Returns a started process of this Python with a script of its own."""
    return subprocess.Popen([sys.executable, "-c", text, *map(str, arguments)], text=True, **options)


def rows_of(file):
    """Returns a CSV file as a list of dictionaries of texts."""
    with open(file, newline="", encoding="utf-8") as table:
        return list(csv.DictReader(table))


class FolderTest(unittest.TestCase):
    """A test with an empty folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="tactus-test-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, text):
        file = self.folder / name
        file.write_text(text, encoding="utf-8")
        return file

    def baked_example(self, name):
        """Returns the image of an example scene."""
        image = self.folder / f"{name}.tactus"
        run_tactus("bake", "--quiet", EXAMPLES / name / "scene.toml", "-o", image)
        return image

    def baked_floor(self, more="", stiffness_N_per_m=500.0, damping_Ns_per_m=0.0):
        """Returns a scene with a large flat box below y = 0, touched by a ball of 2 mm."""
        scene = self.write(
            "floor.toml",
            "[tool]\nradius_m = 0.002\n[[object]]\nname = 'floor'\nprimitive = 'box'\nsize_m = [1.0, 0.1, 1.0]\n"
            f"position_m = [0.0, -0.05, 0.0]\nstiffness_N_per_m = {stiffness_N_per_m}\n"
            f"damping_Ns_per_m = {damping_Ns_per_m}\n{more}\n",
        )
        tactus.bake(scene, self.folder / "floor.tactus")
        return tactus.Scene(self.folder / "floor.tactus")

    @contextlib.contextmanager
    def served(self, *arguments):
        """Serves a simulation, and ends it; yields the folder of its sockets."""
        run_dir = self.folder / "run"
        process = subprocess.Popen(
            [PROGRAM, "sim", *map(str, arguments), "--serve", "--run-dir", str(run_dir)],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        try:
            tactus.connect(run_dir, timeout_s=60).close()
            yield run_dir
        finally:
            process.send_signal(signal.SIGINT)
            process.wait(timeout=60)
