"""A running controller, against what the program says of it and records."""

import json
import itertools
import signal
import socket
import threading
import unittest

import numpy as np

import tactus
from support import EXAMPLES, FolderTest, run_python, run_tactus


class LiveTest(FolderTest):
    def setUp(self):
        super().setUp()
        self.image = self.baked_example("heart")

    def test_parameters_are_those_that_the_program_lists(self):
        with self.served(self.image) as run_dir, tactus.connect(run_dir) as controller:
            reply = json.loads(run_tactus("get", "--json", "--run-dir", run_dir))
            listed = {parameter["name"]: parameter["value"] for parameter in reply["parameters"]}
            found = controller.get()
            self.assertEqual(found, listed)
            for name, value in found.items():
                self.assertEqual(controller.get(name), value)

    def test_a_changed_parameter_is_the_controller_s(self):
        with self.served(self.image) as run_dir, tactus.connect(run_dir) as controller:
            self.assertEqual(controller.set("max_force_N", 3.5), 3.5)
            self.assertIn("max_force_N=3.5 ", run_tactus("get", "max_force_N", "--run-dir", run_dir))
            self.assertEqual(controller.get("object.0.contact"), controller.get()["object.0.contact"])
            with self.assertRaisesRegex(tactus.Refused, "refused set"):
                controller.set("max_force_N", 1e6)
            with self.assertRaisesRegex(tactus.Refused, "refused get"):
                controller.get("nix")
            for wrong in ("a b", "", "a\nestop"):
                with self.assertRaisesRegex(ValueError, "one word"):
                    controller.get(wrong)
            with self.assertRaisesRegex(ValueError, "one word"):
                controller.set("max_force_N", "1\nestop")

    def test_it_is_homed_enabled_and_stopped(self):
        with self.served(self.image) as run_dir, tactus.connect(run_dir) as controller:
            controller.home()
            self.assertEqual(controller.status()["mode"], "ready")
            controller.enable()
            self.assertEqual(controller.status()["mode"], "active")
            controller.disable()
            self.assertEqual(controller.status()["mode"], "ready")
            controller.estop()
            status = controller.status()
            self.assertEqual((status["mode"], status["faults"] != "none"), ("fault", True))
            with self.assertRaises(tactus.Refused):
                controller.enable()

    def test_watched_ticks_are_the_recorded_ones(self):
        recording = self.folder / "run.mcap"
        with self.served(self.image, "--record", recording) as run_dir, tactus.connect(run_dir) as controller:
            controller.home()
            controller.enable()
            controller.set("max_force_N", 3.5)
            with controller.watch() as ticks:
                watched = list(itertools.islice(ticks, 300))
        recorded = {int(row["tick"]): row for row in tactus.read_recording(recording)}
        info, events = tactus.read_events(recording)
        self.assertIn(("parameter", "max_force_N", 3.5), [tuple(each)[1:] for each in events])
        self.assertEqual(len(watched), 300)
        for tick in watched:
            row = recorded[tick["tick"]]
            self.assertEqual(list(tick), list(row.dtype.names))
            for name, value in tick.items():
                self.assertEqual(value, row[name].item(), name)

    def test_threads_share_the_ticks(self):
        found = [[], []]
        with self.served(self.image) as run_dir, tactus.connect(run_dir) as controller:
            with controller.watch("tick") as ticks:
                threads = [
                    threading.Thread(target=lambda own=own: own.extend(itertools.islice(ticks, 200))) for own in found
                ]
                for thread in threads:
                    thread.start()
                for thread in threads:
                    thread.join()
        numbers = sorted(tick["tick"] for own in found for tick in own)
        self.assertEqual(len(set(numbers)), 400)

    def test_fields_and_every_choose(self):
        with self.served(self.image) as run_dir, tactus.connect(run_dir) as controller:
            with controller.watch(["tick", "force"], every=5) as ticks:
                watched = list(itertools.islice(ticks, 20))
            self.assertEqual(list(watched[0]), ["tick", "force_x_N", "force_y_N", "force_z_N"])
            steps = np.diff([tick["tick"] for tick in watched])
            self.assertTrue((steps >= 5).all())
            with controller.watch("nix") as ticks, self.assertRaisesRegex(tactus.Error, "there is no field 'nix'"):
                next(ticks)

    def test_the_iterator_ends_with_the_controller(self):
        with self.served(self.image) as run_dir:
            controller = tactus.connect(run_dir)
            ticks = controller.watch("tick")
            next(ticks)
        for _ in ticks:
            pass
        with self.assertRaises(tactus.Unreachable):
            controller.status()

    def test_nobody_there_is_told_with_the_remedy(self):
        with self.assertRaisesRegex(tactus.Unreachable, "no controller runs there"):
            tactus.connect(self.folder)
        with self.assertRaisesRegex(tactus.Unreachable, "start tactusd"):
            tactus.connect(self.folder / "none", device="left")
        with self.assertRaises(tactus.Error):
            tactus.connect(serial=str(self.folder / "no-port"))


class SilentSocketTest(FolderTest):
    """A telemetry socket that sends nothing until the test says so."""

    def setUp(self):
        super().setUp()
        self.server = socket.socket(socket.AF_UNIX)
        self.addCleanup(self.server.close)
        self.server.bind(str(self.folder / "telemetry.sock"))
        self.server.listen()

    def ticks(self, timeout_s):
        return tactus.Controller(tactus._core.ControllerPlace(str(self.folder), "1", "")).watch(timeout_s=timeout_s)

    def test_a_silent_controller_is_a_timeout(self):
        with self.ticks(timeout_s=0.05) as ticks, self.assertRaisesRegex(TimeoutError, "no tick for 0.05 s"):
            next(ticks)

    def test_other_threads_run_while_it_waits(self):
        # The main thread closes the socket during the wait: that ends the iterator only if the lock is free.
        found = []
        ticks = self.ticks(timeout_s=1e5)
        connection, _ = self.server.accept()
        thread = threading.Thread(target=lambda: found.append(list(ticks)))
        thread.start()
        connection.close()
        thread.join(timeout=60)
        self.assertEqual(found, [[]])

    def test_bytes_that_are_no_ticks_are_an_error(self):
        ticks = self.ticks(timeout_s=10)
        connection, _ = self.server.accept()
        connection.sendall(b"\xff" * 64)
        with self.assertRaisesRegex(tactus.Error, "not the telemetry of tactusd"):
            next(ticks)
        connection.close()

    def test_ctrl_c_ends_the_wait(self):
        script = """
import sys, tactus
ticks = tactus.Controller(tactus._core.ControllerPlace(sys.argv[1], "1", "")).watch(timeout_s=1e5)
try:
    print("waits", flush=True)
    next(ticks)
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""
        process = run_python(script, self.folder, stdout=-1)
        self.assertEqual(process.stdout.readline(), "waits\n")
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.communicate(timeout=60)[0], "interrupted\n")


if __name__ == "__main__":
    unittest.main()
