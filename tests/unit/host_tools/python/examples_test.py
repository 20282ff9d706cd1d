"""The example scripts run and draw their figures; the live one compares its ticks with the recording and the table."""

import importlib.util
import os
import pathlib
import struct
import subprocess
import sys
import unittest

from support import PROGRAM, REPOSITORY, FolderTest

SCRIPTS = REPOSITORY / "host_tools" / "python" / "examples"


@unittest.skipIf(importlib.util.find_spec("matplotlib") is None, "python3-matplotlib is not installed")
class ExamplesTest(FolderTest):
    def drawn(self, name):
        """Runs a script; returns what it printed, after a look at its figure's size."""
        path = os.pathsep.join([str(pathlib.Path(PROGRAM).parent), os.environ["PATH"]])
        result = subprocess.run(
            [sys.executable, SCRIPTS / f"{name}.py", self.folder],
            env={**os.environ, "PATH": path, "MPLCONFIGDIR": str(self.folder)},
            cwd=self.folder, capture_output=True, text=True, timeout=200,
        )
        self.assertEqual(result.returncode, 0, result.stderr)
        head = (self.folder / f"{name}.png").read_bytes()[:24]
        self.assertEqual(head[:8], b"\x89PNG\r\n\x1a\n")
        width, height = struct.unpack(">II", head[16:])
        self.assertGreater(width, 600)
        self.assertGreater(height, 300)
        return result.stdout

    def test_touch_mesh(self):
        # The potential field pushes down below the gem's middle; the god-object never does.
        words = {line.split()[0]: line.split() for line in self.drawn("touch_mesh").splitlines() if " N up" in line}
        self.assertLess(float(words["pushed"][4]), -5.0)
        self.assertEqual(float(words["met"][4]), 0.0)

    def test_friction_models(self):
        # A cycle of Coulomb's friction takes four times level and amplitude: 48 uJ at 1 N and 12 um.
        self.assertIn("Coulomb          48.0 uJ a cycle of 12 um", self.drawn("friction_models"))

    def test_simulate(self):
        self.assertIn("10000 ticks", self.drawn("simulate"))

    def test_read_recording(self):
        self.assertIn("tactus sim: 10000 ticks", self.drawn("read_recording"))

    def test_live(self):
        self.assertIn("live, recorded and exported are equal", self.drawn("live"))

    def block(self, number):
        """Returns a block of Python of the README."""
        return (SCRIPTS.parent / "README.md").read_text(encoding="utf-8").split("```python\n")[number].split("```")[0]

    def run_block(self, number):
        result = subprocess.run([sys.executable, "-c", self.block(number)], cwd=self.folder, capture_output=True,
                                text=True, timeout=200)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def test_the_readme_s_first_lines_touch_and_simulate(self):
        (self.folder / "host_tools").symlink_to(REPOSITORY / "host_tools")
        touched, simulated = self.run_block(1).splitlines()
        self.assertGreater(float(touched.split()[0]), 1.0)
        self.assertGreater(float(simulated.split()[1]), 0.1)
        self.assertEqual(simulated.split()[2], "active")

    def test_the_readme_s_lines_operate_a_controller(self):
        path = REPOSITORY / "host_tools" / "examples" / "heart" / "wish.csv"
        with self.served(self.baked_example("heart"), "--path", path):
            self.run_block(2)

    def test_every_script_is_run(self):
        tested = {name.removeprefix("test_") for name in dir(self) if name.startswith("test_")}
        scripts = {file.stem for file in SCRIPTS.glob("*.py")} - {"style"}
        self.assertLessEqual(scripts, tested)


if __name__ == "__main__":
    unittest.main()
