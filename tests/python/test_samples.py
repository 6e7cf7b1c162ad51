"""The samples in Python draw their pictures, print what theory says, and pass mypy with the stubs."""
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SAMPLES = ROOT / "game/samples/python"


class Samples(unittest.TestCase):
    def run_sample(self, name):
        """What it prints; the picture that it draws has 1920 pixels across."""
        with tempfile.TemporaryDirectory() as folder:
            said = subprocess.run([sys.executable, SAMPLES / f"{name}.py", "picture.png"], cwd=folder, check=True,
                                  capture_output=True, text=True).stdout
            header = (pathlib.Path(folder) / "picture.png").read_bytes()[:24]
        self.assertEqual(header[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(struct.unpack(">I", header[16:20]), (1920,))
        return said

    def test_help_says_how_to_call_them_and_draws_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            for sample in SAMPLES.glob("*.py"):
                said = subprocess.run([sys.executable, sample, "--help"], cwd=folder, check=True, capture_output=True,
                                      text=True).stdout
                self.assertIn(f"usage: {sample.name}", said)
            self.assertEqual(list(pathlib.Path(folder).iterdir()), [])

    def test_energy_of_eight_methods(self):
        off = dict(re.findall(r"^([\w-]+): (.*)$", self.run_sample("energy"), re.M))
        self.assertEqual(len(off), 8)
        # Undamped, Heun and midpoint grow by (ω h)⁴/8 a step, explicit Euler by (ω h)²/2; symplectic ones stay.
        for method in ("euler", "heun", "midpoint"):
            self.assertIn("diverges", off[method])
        # Leap-frog and velocity Verlet are the same way of going on; a method of order 1 strays further, order 4 less.
        second = [float(off[method]) for method in ("leapfrog", "velocity-verlet")]
        self.assertLess(max(second) / min(second), 2)
        self.assertLess(max(second), float(off["symplectic-euler"]))
        self.assertLess(float(off["symplectic-euler"]), 0.03)
        self.assertLess(float(off["blanes-moan"]), 1e-3 * min(second))
        self.assertGreater(float(off["rk4"]), max(second))  # it drifts

    def test_a_cloth_drawn_with_matplotlib(self):
        nearest = float(re.search(r"middle: ([\d.]+) m", self.run_sample("drawn"))[1])
        self.assertAlmostEqual(nearest, 0.305, delta=2e-4)  # radius and thickness, and four digits

    def test_a_sweep_over_stiffness(self):
        rows = [line.split() for line in self.run_sample("sweep").splitlines()]
        self.assertEqual(len(rows), 9)
        for _, _, measured, theory in rows:
            # Of the motion (1 + 10) exp(-10) = 5e-4 is left, and the last digit printed is 1e-6.
            self.assertAlmostEqual(float(measured), float(theory), delta=6e-4 * float(theory) + 1e-6)

    def test_a_controller_that_catches_a_ball(self):
        said = self.run_sample("catch")
        off, height = map(float, re.search(r"caught: ([\d.]+) m .*, ([\d.]+) m up", said).groups())
        missed = float(re.search(r"controller: ([\d.]+) m from it", said)[1])
        self.assertLess(off, 0.4)  # the ball of 0.2 m is over the net of 1.2 m
        self.assertGreater(height, 0.6)
        self.assertGreater(missed, 1.0)  # it came down beyond the frame and bounces on from there

    def test_the_stubs_agree_with_the_samples_and_with_the_module(self):
        environment = {**os.environ, "MYPYPATH": str(ROOT / "game/python")}
        ran = subprocess.run(["/usr/bin/mypy", "--check-untyped-defs", "--ignore-missing-imports", "--cache-dir",
                              os.devnull, "--python-executable", sys.executable, *sorted(SAMPLES.glob("*.py"))],
                             env=environment, capture_output=True, text=True)
        self.assertEqual(ran.returncode, 0, ran.stdout + ran.stderr)
        import taut
        text = (ROOT / "game/python/taut/__init__.pyi").read_text()
        declared = set(re.findall(r"^    def (\w+)\(", text[text.index("class World:"):text.index("def load(")], re.M))
        there = {name for name in dir(taut.World) if not name.startswith("_")}
        self.assertEqual(declared, there)
        self.assertTrue(all(getattr(taut.World, name).__doc__ for name in there))


if __name__ == "__main__":
    unittest.main()
