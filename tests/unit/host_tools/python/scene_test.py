"""Baking, scenes and the touch, against the program's files and closed forms."""

import json
import threading
import unittest
import warnings

import numpy as np

import tactus
from support import EXAMPLES, FolderTest, rows_of, run_python, run_tactus


class BakeTest(FolderTest):
    def test_an_image_is_the_program_s_to_the_byte(self):
        for name in ("gem", "stack", "effects"):
            with self.subTest(name), warnings.catch_warnings():
                warnings.simplefilter("ignore", tactus.BakeWarning)
                report = tactus.bake(EXAMPLES / name / "scene.toml", self.folder / "own.tactus")
            self.assertEqual((self.folder / "own.tactus").read_bytes(), self.baked_example(name).read_bytes())
            self.assertEqual(report["bytes"], (self.folder / "own.tactus").stat().st_size)

    def test_the_image_of_a_file_without_a_name_stands_beside_it(self):
        scene = self.write("ball.toml", "[[object]]\nname='ball'\nprimitive='sphere'\nradius_m=0.05\n")
        tactus.bake(scene)
        self.assertEqual(tactus.Scene(scene.with_suffix(".tactus")).names, ["ball"])

    def test_a_device_is_baked_and_reported_as_by_the_program(self):
        device = EXAMPLES / "devices" / "hapkit.toml"
        with self.assertWarnsRegex(tactus.BakeWarning, "without a certificate"):
            report = tactus.bake(device, self.folder / "own.tactus")
        told = json.loads(run_tactus("bake", device, "--json", "-o", self.folder / "other.tactus"))
        self.assertEqual((self.folder / "own.tactus").read_bytes(), (self.folder / "other.tactus").read_bytes())
        self.assertEqual({**report, "image": ""}, {**told, "image": ""})

    def test_a_mistake_is_told_in_the_program_s_words(self):
        scene = self.write("wrong.toml", "[[object]]\nname='ball'\nprimitive='sphere'\nradius_mm=0.05\n")
        with self.assertRaisesRegex(tactus.Error, r"wrong\.toml:\d+: .*radius_mm"):
            tactus.bake(scene)
        with self.assertRaisesRegex(tactus.Error, "none.toml: "):
            tactus.bake(self.folder / "none.toml")

    def test_a_warning_of_baking_is_a_warning_of_python(self):
        self.write("open.off", "OFF\n4 2 0\n0 0 0\n.1 0 0\n0 .1 0\n.1 .1 0\n3 0 1 2\n3 1 2 3\n")
        scene = self.write("open.toml", "[[object]]\nname='sheet'\nmesh='open.off'\n")
        told = json.loads(run_tactus("bake", scene, "--json"))["objects"][0]["warnings"]
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            tactus.bake(scene)
        self.assertEqual([str(each.message) for each in caught], told)
        self.assertGreater(len(told), 0)

    def test_other_threads_run_while_a_file_is_read(self):
        # The thread reads a pipe that the main one fills afterwards: neither ends if the lock is held.
        script = """
import os, threading, tactus
os.mkfifo("pipe.toml")
def work():
    try:
        tactus.bake("pipe.toml", "pipe.tactus")
    except tactus.Error as error:
        print("read:", error)
thread = threading.Thread(target=work)
thread.start()
pipe = os.open("pipe.toml", os.O_WRONLY)
os.close(pipe)
thread.join()
"""
        process = run_python(script, cwd=self.folder, stdout=-1)
        self.addCleanup(process.kill)
        self.assertRegex(process.communicate(timeout=60)[0], "^read: pipe.toml")


class SceneTest(FolderTest):
    def test_it_knows_names_checksum_and_objects_as_the_program_does(self):
        image = self.baked_example("gem")
        scene = tactus.Scene(image)
        told = json.loads(run_tactus("inspect", image, "--json"))
        self.assertEqual(scene.checksum, told["checksum"])
        self.assertEqual(scene.tool_radius_m, told["tool_radius_m"])
        self.assertEqual(scene.names, [each["name"] for each in told["objects"]])
        for own, other in zip(scene.objects, told["objects"]):
            self.assertEqual(own, {key: other[key] for key in own})

    def test_bytes_are_the_same_scene_as_their_file(self):
        image = self.baked_example("gem")
        path = np.linspace([-0.08, 0, 0.06], [-0.08, 0, 0.02], 50)
        of_file = tactus.Scene(image)
        of_bytes = tactus.Scene(image.read_bytes())
        self.assertEqual(of_bytes.checksum, of_file.checksum)
        np.testing.assert_array_equal(of_bytes.touch(path).state_hash, of_file.touch(path).state_hash)

    def test_a_damaged_image_is_refused(self):
        image = bytearray(self.baked_example("gem").read_bytes())
        for damaged in (b"", b"short", image[:100], image[:-1], image[:200] + b"\x55" + image[201:]):
            with self.assertRaises(tactus.Error):
                tactus.Scene(bytes(damaged))
        with self.assertRaisesRegex(tactus.Error, "nothing.tactus: cannot read"):
            tactus.Scene(self.folder / "nothing.tactus")
        with self.assertRaises(TypeError):
            tactus.Scene(7)
        with self.assertRaisesRegex(ValueError, "has a zero in it"):
            tactus.Scene("a\0b")

    def test_a_mesh_has_the_corners_of_its_file(self):
        scene = tactus.Scene(self.baked_example("gem"))
        vertices, triangles = scene.mesh("met")
        lines = (EXAMPLES / "gem" / "gem.off").read_text().split("\n")
        self.assertEqual(vertices.shape, (scene.objects[1]["vertices"], 3))
        self.assertEqual(triangles.shape, (scene.objects[1]["triangles"], 3))
        self.assertLess(triangles.max(), len(vertices))
        self.assertIn("OFF", lines[0])
        with self.assertRaisesRegex(tactus.Error, "there is no object 'nix'; there are walked, met, pushed"):
            scene.mesh("nix")
        with self.assertRaises(tactus.Error):
            scene.mesh(3)


class TouchTest(FolderTest):
    def test_the_force_of_a_plane_is_hooke_s(self):
        scene = self.baked_floor(stiffness_N_per_m=500.0)
        # The ball's centre is 2 mm above the plane when they meet, and the proxy half a micron more.
        depths_m = np.linspace(-0.005, 0.01, 301)
        touch = scene.touch(np.column_stack([0 * depths_m, 0.002 - depths_m, 0 * depths_m]))
        wanted_N = 500.0 * np.maximum(depths_m, 0.0)
        np.testing.assert_allclose(touch.force_N[:, 1], wanted_N, atol=500.0 * 1e-6)
        np.testing.assert_allclose(touch.force_N[:, [0, 2]], 0.0, atol=1e-9)
        np.testing.assert_allclose(touch.depth_m[depths_m > 1e-6], depths_m[depths_m > 1e-6], atol=1e-6)
        np.testing.assert_array_equal(touch.contact[depths_m < -1e-6], 0)
        np.testing.assert_array_equal(touch.object[depths_m < -1e-6], -1)
        np.testing.assert_array_equal(touch.object[depths_m > 1e-6], 0)
        np.testing.assert_array_equal(touch.normal[-1], [0.0, 1.0, 0.0])

    def test_damping_is_against_the_velocity_that_the_rate_makes(self):
        scene = self.baked_floor(stiffness_N_per_m=500.0, damping_Ns_per_m=2.0)
        heights_m = np.linspace(0.003, -0.001, 41)  # 0.1 mm a tick
        positions = np.column_stack([0 * heights_m, heights_m, 0 * heights_m])
        for rate_hz in (500.0, 1000.0):
            touch = scene.touch(positions, rate_hz=rate_hz)
            speed_m_per_s = 1e-4 * rate_hz
            wanted_N = 500.0 * (0.002 - heights_m[-1]) + 2.0 * speed_m_per_s
            self.assertAlmostEqual(touch.force_N[-1, 1], wanted_N, delta=2e-3)

    def test_friction_is_coulomb_s(self):
        scene = self.baked_floor("friction = { model = 'cone', static = 0.6, dynamic = 0.4 }")
        # Pressed in by 5 mm, then drawn along x: first it holds, then it slips.
        y_m = np.concatenate([np.linspace(0.003, -0.003, 100), np.full(400, -0.003)])
        x_m = np.concatenate([np.zeros(100), np.linspace(0.0, 0.02, 400)])
        touch = scene.touch(np.column_stack([x_m, y_m, 0 * x_m]))
        sliding = touch.friction_state == 2
        self.assertGreater(sliding.sum(), 200)
        ratio = -touch.force_N[:, 0] / np.maximum(touch.force_N[:, 1], 1e-9)
        np.testing.assert_allclose(ratio[sliding], 0.4, rtol=1e-3)
        self.assertLess(ratio[~sliding].max(), 0.6 + 1e-3)
        self.assertGreater(ratio[~sliding].max(), 0.55)

    def test_it_is_the_program_s_touch_to_the_bit(self):
        for name, path in (("gem", "stroke.csv"), ("heart", "stroke.csv"), ("notch", "stroke.csv")):
            with self.subTest(name):
                image = self.baked_example(name)
                file = EXAMPLES / name / path
                out, hashes = self.folder / "out.csv", self.folder / "hashes.csv"
                run_tactus("touch", image, "--path", file, "--output", out, "--hashes", hashes)
                steps = np.genfromtxt(file, delimiter=",", names=True)
                touch = tactus.Scene(image).touch(
                    np.column_stack([steps["x_m"], steps["y_m"], steps["z_m"]]), t_s=steps["t_s"]
                )
                self.assertEqual(
                    [f"{each:016x}" for each in touch.state_hash], [row["hash"] for row in rows_of(hashes)]
                )
                self.assert_same_rows(touch, rows_of(out))

    def assert_same_rows(self, touch, rows):
        self.assertEqual(len(rows), len(touch))
        for axis, letter in enumerate("xyz"):
            for own, column in ((touch.proxy_m, f"proxy_{letter}_m"), (touch.force_N, f"force_{letter}_N"),
                                (touch.normal, f"normal_{letter}"), (touch.tool_m, f"tool_{letter}_m")):
                np.testing.assert_array_equal(own[:, axis], [float(row[column]) for row in rows])
        for own, column in ((touch.contact, "contact"), (touch.friction_state, "friction_state"), (touch.flags, "flags")):
            np.testing.assert_array_equal(own, [int(row[column]) for row in rows])
        for own, column in ((touch.depth_m, "depth_m"), (touch.short_of_goal_m, "short_of_goal_m"), (touch.t_s, "t_s")):
            np.testing.assert_array_equal(own, [float(row[column]) for row in rows])
        np.testing.assert_array_equal(touch.object, [int(row["object"] or -1) for row in rows])

    def test_two_tools_touch_one_world_as_in_the_program(self):
        image = self.baked_example("grasp")
        paths = [EXAMPLES / "grasp" / name for name in ("thumb.csv", "finger.csv")]
        hashes = self.folder / "hashes.csv"
        run_tactus("touch", image, "--path", paths[0], "--path", paths[1], "--rate", "1000", "--output",
                   self.folder / "out.csv", "--hashes", hashes)
        files = [hashes, self.folder / "hashes.2.csv"]
        rows = [rows_of(self.folder / name) for name in ("out.csv", "out.2.csv")]
        tools = np.array([[[float(row[f"tool_{letter}_m"]) for letter in "xyz"] for row in each] for each in rows])
        found = tactus.Scene(image).touch(tools, t_s=[float(row["t_s"]) for row in rows[0]])
        for touch, file in zip(found, files):
            self.assertEqual([f"{each:016x}" for each in touch.state_hash], [row["hash"] for row in rows_of(file)])

    def test_the_hash_tells_two_touches_apart(self):
        scene = self.baked_floor()
        path = np.linspace([0, 0.01, 0], [0, -0.01, 0], 100)
        moved = path.copy()
        moved[60, 0] += 1e-15
        first, other = scene.touch(path).state_hash, scene.touch(moved).state_hash
        np.testing.assert_array_equal(first[:60], other[:60])
        self.assertTrue((first[60:] != other[60:]).all())

    def test_threads_share_a_scene(self):
        scene = tactus.Scene(self.baked_example("heart"))
        steps = np.genfromtxt(EXAMPLES / "heart" / "stroke.csv", delimiter=",", names=True)
        path = np.column_stack([steps["x_m"], steps["y_m"], steps["z_m"]])
        alone = scene.touch(path).state_hash
        together = [None] * 4
        threads = [
            threading.Thread(target=lambda i=i: together.__setitem__(i, scene.touch(path).state_hash)) for i in range(4)
        ]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for found in together:
            np.testing.assert_array_equal(found, alone)

    def test_what_is_no_path_is_refused(self):
        scene = self.baked_floor()
        good = np.zeros((4, 3))
        for wrong, kind, words in (
            (np.zeros(3), ValueError, r"positions_m has to have the shape \(N, 3\), not \(3,\)"),
            (np.zeros((4, 2)), ValueError, r"shape \(N, 3\), not \(4, 2\)"),
            (np.zeros((0, 3)), ValueError, r"shape \(N, 3\)"),
            (np.zeros((2, 4, 4)), ValueError, r"shape \(tools, N, 3\)"),
            (np.full((4, 3), np.nan), ValueError, r"positions_m\[0, 0\] is nan"),
            (np.where(np.arange(12).reshape(4, 3) == 7, np.inf, 0.0), ValueError, r"positions_m\[2, 1\] is inf"),
            (good.astype(complex), TypeError, "real numbers, not complex128"),
            ([["a", "b", "c"]], TypeError, "real numbers"),
            (None, TypeError, "real numbers"),
        ):
            with self.subTest(words), self.assertRaisesRegex(kind, words):
                scene.touch(wrong)
        for options, words in (
            ({"rate_hz": 0}, "rate_hz is 0.0; it has to be above 0"),
            ({"rate_hz": np.nan}, "rate_hz.* is nan"),
            ({"t_s": [0, 1, 1, 2]}, r"t_s\[2\] is 1.0, which does not come after 1.0"),
            ({"t_s": [0, 1]}, "t_s has 2 times for 4 positions"),
        ):
            with self.subTest(words), self.assertRaisesRegex(ValueError, words):
                scene.touch(good, **options)
        with self.assertRaisesRegex(tactus.Error, "a world has 1 to 10 tools"):
            scene.touch(np.zeros((11, 2, 3)))

    def test_arrays_of_any_layout_and_type_are_the_same_path(self):
        scene = self.baked_floor()
        path = np.linspace([0, 0.01, 0], [0.01, -0.01, 0], 64)
        wanted = scene.touch(path).state_hash
        for other in (np.asfortranarray(path), path.tolist(), np.repeat(path, 2, axis=0)[::2], path.astype(">f8")):
            np.testing.assert_array_equal(scene.touch(other).state_hash, wanted)
        self.assertEqual(len(scene.touch(np.zeros((5, 3), dtype=np.int32))), 5)


if __name__ == "__main__":
    unittest.main()
