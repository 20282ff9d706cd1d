"""Simulated runs, certificates and recordings, against the files of the program."""

import json
import os
import pathlib
import unittest
import warnings

import numpy as np

import tactus
from support import EXAMPLES, FolderTest, rows_of, run_python, run_tactus


def hashes_of(run):
    return [f"{each:016x}" for each in run["state_hash"]]


class SimulateTest(FolderTest):
    def test_a_run_is_the_program_s_to_the_bit(self):
        image = self.baked_example("heart")
        scene = tactus.Scene(image)
        path = EXAMPLES / "heart" / "wish.csv"
        for device, hand, seed, options in (
            ("cartesian", "pen", 1, {}),
            ("falcon", "firm", 7, {"path": path}),
            ("woodenhaptics", "finger", 3, {"path": path, "faults": ["stale@0.5x3"], "rate_hz": 2000.0}),
        ):
            with self.subTest(device):
                arguments = ["--device", device, "--hand", hand, "--seed", seed, "--seconds", 2]
                for name, value in options.items():
                    option = {"path": "--path", "faults": "--fault", "rate_hz": "--rate-hz"}[name]
                    arguments += [option, value[0] if isinstance(value, list) else value]
                out, hashes = self.folder / "run.csv", self.folder / "hashes.csv"
                run_tactus("sim", image, *arguments, "--output", out, "--hashes", hashes)
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore", tactus.SimulationWarning)
                    run = tactus.simulate(scene, device, hand, seed=seed, seconds=2, **options)
                self.assertEqual(hashes_of(run), [row["hash"] for row in rows_of(hashes)])
                self.assert_same_rows(run, rows_of(out))

    def assert_same_rows(self, run, rows):
        """The file has nine digits of each number."""
        names = {"t_s": "time_s", "depth_m": "depth_m"}
        for letter in "xyz":
            names[f"tool_{letter}_m"] = f"tool_{letter}_m"
            names[f"proxy_{letter}_m"] = f"proxy_{letter}_m"
            names[f"force_{letter}_N"] = f"rendered_{letter}_N"
            names[f"commanded_force_{letter}_N"] = f"force_{letter}_N"
            names[f"wish_{letter}_m"] = f"wish_{letter}_m"
        for column, field in names.items():
            self.assertEqual([row[column] for row in rows], [f"{each:.9g}" for each in run[field]], column)
        self.assertEqual([int(row["contact"]) for row in rows], run["contact"].tolist())
        self.assertEqual([int(row["faults"]) for row in rows], run["faults"].tolist())

    def test_a_path_of_numbers_is_the_path_of_a_file(self):
        scene = tactus.Scene(self.baked_example("heart"))
        file = EXAMPLES / "heart" / "wish.csv"
        steps = np.genfromtxt(file, delimiter=",", names=True)
        rows = np.column_stack([steps[name] for name in ("t_s", "x_m", "y_m", "z_m")])
        self.assertEqual(
            hashes_of(tactus.simulate(scene, path=rows, seconds=1)),
            hashes_of(tactus.simulate(scene, path=str(file), seconds=1)),
        )

    def test_several_devices_are_several_arrays(self):
        image = self.baked_example("grasp")
        paths = [EXAMPLES / "grasp" / name for name in ("thumb.csv", "finger.csv")]
        hashes = self.folder / "hashes.csv"
        run_tactus("sim", image, "--device", "falcon", "--device", "falcon", "--path", paths[0], "--path", paths[1],
                   "--seconds", 1, "--hashes", hashes)
        runs = tactus.simulate(tactus.Scene(image), ["falcon", "falcon"], path=paths, seconds=1)
        for run, file in zip(runs, (hashes, self.folder / "hashes.2.csv")):
            self.assertEqual(hashes_of(run), [row["hash"] for row in rows_of(file)])

    def test_what_cannot_be_simulated_is_told(self):
        scene = self.baked_floor()
        for kind, words, options in (
            (tactus.Error, "--device: there is no 'nix'; there are cartesian", {"device": "nix"}),
            (tactus.Error, "--hand nix: there are finger, pen and firm", {"hand": "nix"}),
            (tactus.Error, "--fault nix", {"faults": ["nix"]}),
            (tactus.Error, "none.csv", {"path": "none.csv"}),
            (tactus.Error, "--compensate 2", {"compensate": 2}),
            (ValueError, "seconds is -1.0", {"seconds": -1}),
            (ValueError, r"path has to have the shape \(N, 4\)", {"path": np.zeros((3, 3))}),
            (ValueError, r"path\[1, 2\] is nan", {"path": [[0, 0, 0, 0], [1, 0, np.nan, 0]]}),
            (ValueError, "does not come after", {"path": [[1, 0, 0, 0], [1, 0, 0, 0]]}),
            (TypeError, "device has to be text", {"device": [7]}),
        ):
            with self.subTest(words), self.assertRaisesRegex(kind, words):
                tactus.simulate(scene, **options)
        with self.assertRaises(TypeError):
            tactus.simulate("floor.tactus")

    def test_a_path_that_the_device_cannot_follow_is_warned_of(self):
        with self.assertWarnsRegex(tactus.SimulationWarning, "its stops will hold the hand"):
            tactus.simulate(self.baked_floor(), path=[[0, -1, 0.1, 0], [1, 1, 0.1, 0]], seconds=0.01)

    def test_ctrl_c_ends_a_long_run(self):
        script = """
import sys, tactus
scene = tactus.Scene(sys.argv[1])
try:
    print("begins", flush=True)
    tactus.simulate(scene, seconds=1e5)
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""
        process = run_python(script, self.baked_example("gem"), stdout=-1)
        self.assertEqual(process.stdout.readline(), "begins\n")
        process.send_signal(2)
        self.assertEqual(process.communicate(timeout=60)[0], "interrupted\n")


class RecordingTest(FolderTest):
    def setUp(self):
        super().setUp()
        self.image = self.baked_example("heart")
        self.recording = self.folder / "run.mcap"
        run_tactus("sim", self.image, "--seconds", 2, "--record", self.recording)

    def exported(self, *options):
        run_tactus("export", self.recording, "-o", self.folder / "run.npz", *options)
        return np.load(self.folder / "run.npz")

    def test_its_fields_are_the_arrays_that_export_writes(self):
        for options, fields, chosen in (
            ([], (), {}),
            (["--fields", "tick,force,mode", "--every", "7"], ("tick", "force", "mode"), {"every": 7}),
            (["--from", "0.5", "--to", "1.25"], (), {"from_s": 0.5, "to_s": 1.25}),
        ):
            with self.subTest(options):
                arrays = self.exported(*options)
                found = tactus.read_recording(self.recording, fields, **chosen)
                self.assertEqual(list(found.dtype.names), arrays.files)
                for name in arrays.files:
                    self.assertEqual(found.dtype[name], arrays[name].dtype, name)
                    np.testing.assert_array_equal(found[name], arrays[name], name)
                os.remove(self.folder / "run.npz")

    def test_it_is_the_simulated_run(self):
        run = tactus.simulate(tactus.Scene(self.image), seconds=2)
        found = tactus.read_recording(self.recording)
        self.assertEqual(list(run.dtype.names), [*found.dtype.names, "wish_x_m", "wish_y_m", "wish_z_m"])
        for name in found.dtype.names:
            np.testing.assert_array_equal(found[name], run[name], name)

    def test_events_and_information_are_those_of_the_file(self):
        info, events = tactus.read_events(self.recording)
        self.assertEqual(info["program"], "tactus sim")
        self.assertIn(tactus.Scene(self.image).checksum, info.values())
        run_tactus("export", self.recording, "-o", self.folder / "run.csv", "--events", self.folder / "events.csv")
        rows = rows_of(self.folder / "events.csv")
        self.assertEqual([(str(each.tick), each.kind, each.name) for each in events],
                         [(row["tick"], row["kind"], row["name"]) for row in rows])

    def test_what_is_no_recording_is_told(self):
        damaged = self.folder / "damaged.mcap"
        damaged.write_bytes(b"\x00" * 1000)
        empty = self.folder / "empty.mcap"
        empty.write_bytes(b"")
        for file, words in ((damaged, "MCAP"), (empty, "no recording|not a recording"), (self.image, "MCAP"),
                            (self.folder / "none.mcap", "cannot read"), (self.folder, "cannot read|recording")):
            with self.subTest(file), self.assertRaisesRegex(tactus.Error, words):
                tactus.read_recording(file)
        with self.assertRaisesRegex(tactus.Error, "there is no field 'nix'; there are: tick"):
            tactus.read_recording(self.recording, ["nix"])
        with self.assertRaisesRegex(tactus.Error, "no tick"):
            tactus.read_recording(self.recording, from_s=100.0)
        with self.assertRaisesRegex(ValueError, "every is 0"):
            tactus.read_recording(self.recording, every=0)

    def test_a_cut_recording_gives_its_beginning_or_an_error(self):
        whole = self.recording.read_bytes()
        all_ticks = tactus.read_recording(self.recording, ["tick", "state_hash"])
        for share in (0.3, 0.6, 0.9):
            cut = self.folder / "cut.mcap"
            cut.write_bytes(whole[: int(share * len(whole))])
            try:
                found = tactus.read_recording(cut, ["tick", "state_hash"])
            except tactus.Error:
                continue
            np.testing.assert_array_equal(found, all_ticks[: len(found)])


class CertifyTest(FolderTest):
    def test_it_is_the_program_s_certificate(self):
        text = (EXAMPLES / "devices" / "hapkit.toml").read_text(encoding="utf-8")
        own, other = self.write("own.toml", text), self.write("other.toml", text)
        found = tactus.certify(own, dampings=2)
        told = json.loads(run_tactus("certify", other, "--dampings", 2, "--json"))
        files = ("certificate", "csv", "picture")
        self.assertEqual({key: found[key] for key in found if key not in files},
                         {key: told[key] for key in told if key not in files})
        for key in files:
            self.assertEqual(pathlib.Path(found[key]).read_bytes(), pathlib.Path(told[key]).read_bytes(), key)

    def test_what_cannot_be_certified_is_told(self):
        device = EXAMPLES / "devices" / "hapkit.toml"
        with self.assertRaisesRegex(tactus.Error, "--margin 0.5"):
            tactus.certify(device, margin=0.5)
        with self.assertRaisesRegex(tactus.Error, "--dampings 1"):
            tactus.certify(device, dampings=1)
        with self.assertRaisesRegex(tactus.Error, "is no device"):
            tactus.certify(EXAMPLES / "gem" / "scene.toml")


if __name__ == "__main__":
    unittest.main()
