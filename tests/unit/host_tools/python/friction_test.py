"""Friction models, against closed forms and the program."""

import json
import unittest

import numpy as np

import tactus
from support import EXAMPLES, FolderTest, rows_of, run_tactus


class FrictionTest(FolderTest):
    def test_coulomb_s_force_is_a_level_and_a_viscous_part_along_the_motion(self):
        t_s = np.arange(0.0, 1.0, 1e-3)
        x_m = 0.01 * np.sin(2 * np.pi * t_s)
        found = tactus.Friction("coulomb", Fc=0.5, sigma2=3.0).motion(t_s, x_m)
        speed = np.diff(x_m) / np.diff(t_s)
        np.testing.assert_allclose(found["v_m_per_s"][1:], speed, rtol=1e-12)
        moving = np.abs(speed) > 1e-4
        wanted = 0.5 * np.sign(speed) + 3.0 * speed
        np.testing.assert_allclose(found["force_N"][1:][moving], wanted[moving], rtol=1e-9)

    def test_dahl_s_force_follows_his_exponential(self):
        # From rest along x: F = Fc (1 - exp(-sigma0 x / Fc)).
        x_m = np.linspace(0.0, 1e-4, 20001)
        found = tactus.Friction("dahl", Fc=1.0, sigma0=1e5, sigma2=0.0).motion(np.arange(len(x_m)) * 1e-3, x_m)
        np.testing.assert_allclose(found["force_N"], 1.0 - np.exp(-1e5 * x_m), atol=2e-3)

    def test_a_pushed_mass_obeys_newton_until_friction_holds_it(self):
        t_s = [0.0, 1.0]
        held = tactus.Friction("coulomb", Fc=1.0, sigma2=0.0).push(t_s, [0.5, 0.5], mass_kg=2.0)
        np.testing.assert_array_equal(held["x_m"], 0.0)
        free = tactus.Friction("coulomb", Fc=1.0, sigma2=0.0).push(t_s, [3.0, 3.0], mass_kg=2.0)
        np.testing.assert_allclose(free["x_m"], 0.5 * (3.0 - 1.0) / 2.0 * free["t_s"] ** 2, atol=1e-6)
        np.testing.assert_array_equal(free["push_N"], 3.0)

    def test_motions_and_pushes_are_the_program_s(self):
        motion, push = EXAMPLES / "friction" / "record.csv", EXAMPLES / "friction" / "push.csv"
        for model in ("coulomb", "stribeck", "karnopp", "dahl", "lugre", "elasto_plastic"):
            with self.subTest(model):
                out = self.folder / "out.csv"
                run_tactus("friction", "--model", model, "--param", "Fc=0.3", "--normal-force-N", 2, "--motion", motion,
                           "--output", out)
                model_of_two = tactus.Friction(model, normal_force_N=2, Fc=0.3)
                steps = np.genfromtxt(motion, delimiter=",", names=True)
                self.assert_same(model_of_two.motion(steps["t_s"], steps["x_m"]), rows_of(out))
                run_tactus("friction", "--model", model, "--push", push, "--mass-kg", 0.5, "--output", out)
                steps = np.genfromtxt(push, delimiter=",", names=True)
                self.assert_same(tactus.Friction(model).push(steps["t_s"], steps["force_N"], mass_kg=0.5), rows_of(out))

    def test_experiments_are_the_program_s(self):
        for name, setup in (("presliding", {}), ("lag", {"omegas_rad_per_s": (1.0, 10.0)}), ("break-away", {}),
                            ("stick-slip", {}), ("hunting", {}), ("hysteresis", {"amplitudes_m": 1e-5})):
            with self.subTest(name):
                try:
                    self.compare_experiment(name, setup)
                except tactus.Error as error:
                    self.fail(str(error))

    def compare_experiment(self, name, setup):
        out = self.folder / "out.csv"
        words = [["--setup", f"{key}={','.join(str(each) for each in np.atleast_1d(value))}"] for key, value in setup.items()]
        told = json.loads(run_tactus("friction", "--model", "lugre", "--experiment", name, "--output", out, "--json",
                                     *sum(words, [])))
        track, findings = tactus.Friction("lugre").experiment(name, **setup)
        self.assert_same(track, rows_of(out))
        if findings is None:
            self.assertFalse(told.get("findings"))
            return
        for column in findings.dtype.names:
            wanted = [np.nan if row[column] is None else row[column] for row in told["findings"]]
            np.testing.assert_array_equal(findings[column], wanted)

    def assert_same(self, found, rows):
        self.assertEqual(list(found.dtype.names), list(rows[0]))
        for name in found.dtype.names:
            np.testing.assert_array_equal(found[name], [float(row[name]) for row in rows], name)

    def test_parameters_are_the_model_s(self):
        model = tactus.Friction("lugre", Fc=0.7, Fs=1.1)
        self.assertEqual(model.parameters["Fc"], 0.7)
        self.assertEqual(list(model.parameters)[:2], ["Fc", "Fs"])
        self.assertIn("Fc=0.7", repr(model))

    def test_what_is_wrong_is_told(self):
        model = tactus.Friction()
        for kind, words, call in (
            (tactus.Error, "there is no friction model 'nix'", lambda: tactus.Friction("nix")),
            (tactus.Error, "--param nix", lambda: tactus.Friction(nix=1)),
            (tactus.Error, "Fs", lambda: tactus.Friction(Fc=2, Fs=1)),
            (tactus.Error, "nix", lambda: model.experiment("nix")),
            (ValueError, "Fc.* is nan", lambda: tactus.Friction(Fc=float("nan"))),
            (ValueError, "normal_force_N is -1.0", lambda: tactus.Friction(normal_force_N=-1)),
            (ValueError, "give two or more of each", lambda: model.motion([0], [0])),
            (ValueError, "give two or more of each", lambda: model.motion([0, 1], [0, 1, 2])),
            (ValueError, r"t_s\[1\]", lambda: model.motion([1, 0], [0, 1])),
            (tactus.Error, "rate_hz is 1e\\+300; it has to be from 1", lambda: model.push([0, 1], [0, 1], rate_hz=1e300)),
            (tactus.Error, "rate_hz is 0.5", lambda: model.experiment("hysteresis", rate_hz=0.5)),
            (ValueError, "mass_kg is 0.0", lambda: model.push([0, 1], [0, 1], mass_kg=0)),
            (TypeError, "x_m has to hold real numbers", lambda: model.motion([0, 1], ["a", "b"])),
        ):
            with self.subTest(words), self.assertRaisesRegex(kind, words):
                call()


if __name__ == "__main__":
    unittest.main()
