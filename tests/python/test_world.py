"""What `import taut` promises: test_world.py, with TAUT_PROGRAM the program of the same build.

Expected values are of theory, or of the program.
"""
import contextlib
import gc
import json
import multiprocessing
import os
import pathlib
import pickle
import signal
import subprocess
import tempfile
import threading
import unittest
import weakref

import numpy as np
from scenes import CLOTH, MASSES

import taut

PROGRAM = os.environ["TAUT_PROGRAM"]


class Case(unittest.TestCase):
    @contextlib.contextmanager
    def refused(self, *parts, kind=None, error=taut.Error):
        """Raises, with all of that in its message."""
        with self.assertRaises(error) as caught:
            yield caught
        for part in parts:
            self.assertIn(part, str(caught.exception))
        if kind:
            self.assertEqual(caught.exception.kind, kind)


class Runs(Case):
    def test_600_ticks_have_the_hash_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "cloth.toml"
            file.write_text(CLOTH)
            arguments = ["-o", f"{folder}/p_######.png", "--frames", "600-600", "--size", "32x32", "--quiet"]
            subprocess.run([PROGRAM, "render", file, *arguments], check=True)
            hashes = json.loads((pathlib.Path(folder) / "run_600-600.json").read_text())["state_hash"]
            world = taut.load(file, threads=2)
            world.step(600)
        self.assertEqual(world.tick, 600)
        self.assertEqual(world.hash, hashes[-1])
        self.assertTrue(world.equal_bits)

    def test_a_copy_of_the_points_stands_in_the_order_of_authoring(self):
        world = taut.loads(CLOTH)
        x = world.positions("cloth.scarf")
        # A grid of 7 x 7 from the top left, along the width first.
        i, j = np.divmod(np.arange(49), 7)
        np.testing.assert_allclose(x, np.stack([j / 6, np.full(49, 2.0), i / 6], axis=1), atol=1e-6)
        x[:] = 0
        self.assertAlmostEqual(world.positions("cloth.scarf@bottom-right")[0, 2], 1.0, places=6)
        self.assertAlmostEqual(world.masses("cloth.*").sum(), 0.1, places=6)  # 0.1 kg/m² on 1 m²
        np.testing.assert_allclose(world.velocities("cloth.scarf"), np.zeros((49, 3)), atol=1e-8)

    def test_energies_are_a_sum_and_fall_freely(self):
        world = taut.loads(CLOTH, {"wind.breeze.velocity": [0, 0, 0], "cloth.scarf.hold": [],
                                   "material.silk.drag_per_s": 0.0, "wind.breeze.drag": 0.0, "wind.breeze.lift": 0.0})
        world.run(until=0.1)
        e = world.energies("cloth.scarf")
        self.assertAlmostEqual(e["total"], e["kinetic"] + e["elastic"] + e["gravitational"], places=12)
        # m g h = 0.1 * 9.81 * 2 J, and of it m (g t)²/2 as motion after 0.1 s
        self.assertAlmostEqual(e["total"], 1.962, places=4)
        self.assertAlmostEqual(e["kinetic"], 0.05 * 0.981**2, places=4)

    def test_a_picture_and_its_surfaces(self):
        world = taut.loads(CLOTH)
        picture = world.render((64, 48), samples=1)
        self.assertEqual((picture.shape, picture.dtype), ((48, 64, 3), np.uint8))
        self.assertGreater(picture.std(), 5)
        scarf = next(s for s in world.surfaces() if s.name == "cloth.scarf")
        self.assertEqual(scarf.triangles.shape[1], 3)
        self.assertLess(scarf.triangles.max(), len(scarf.positions))
        with self.refused("no camera \"back\"", "front"):
            world.render(camera="back")

    def test_a_camera_by_name_follows_as_that_of_the_scene(self):
        world = taut.loads(CLOTH + 'follow = "cloth.scarf"\nfollow_lag_s = 0.0\n')
        world.run(until=0.3)
        of_scene, by_name = (world.render((64, 48), samples=1, camera=name) for name in ("", "front"))
        self.assertTrue(np.array_equal(of_scene, by_name))

    def test_a_process_forked_from_one_that_has_drawn_refuses_to(self):
        world = taut.loads(CLOTH)
        world.render((16, 16), samples=1)
        context = multiprocessing.get_context("fork")
        said = context.SimpleQueue()

        def draw():
            for drawn in (world, taut.loads(CLOTH)):
                try:
                    drawn.render((32, 32), samples=1)
                except taut.Error as error:
                    said.put(f"{error.kind}: {error}")

        child = context.Process(target=draw)
        child.start()
        child.join(20)
        if child.is_alive():
            child.kill()
        self.assertEqual(child.exitcode, 0)
        for _ in range(2):
            self.assertFalse(said.empty())
            self.assertRegex(said.get(), "^renderer: this process was forked .*spawn")
        world.render((16, 16), samples=1)

    def test_actions_of_a_timeline_happen_now(self):
        world = taut.loads(MASSES)
        world.apply({"do": "push", "target": "net.ball1@m", "impulse_Ns": np.array([0.0, 6.0, 0.0])})
        world.run(until=1.0)
        self.assertAlmostEqual(world.positions("net.ball1@m")[0, 1], 3.0, places=5)  # 6 N s on 2 kg for 1 s

    def test_joints_are_listed_and_released_by_their_name(self):
        w = taut.loads(
            'schema = 1\n[net.n]\npoints = [{ name = "a", position = [0, 2, 0], hold = true }]\n'
            '[net.o]\npoints = [{ name = "b", position = [0, 2, 0] }]\n'
            '[[joint]]\nname = "peg"\na = "net.o@b"\nb = "net.n@a"\n')
        told = {"name": "peg", "kind": "weld", "a": "net.o@b", "b": "net.n@a", "points": 1}
        self.assertEqual(w.joints, [{**told, "left": 1}])
        w.step()
        self.assertEqual(w.positions("net.o")[0, 1], 2.0)
        w.apply({"do": "release", "id": "peg"})
        self.assertEqual(w.joints, [{**told, "left": 0}])
        w.step()
        self.assertLess(w.positions("net.o")[0, 1], 2.0)

    def test_two_threads_and_an_interruption(self):
        world = taut.load("flag")
        done = threading.Event()
        thread = threading.Thread(target=lambda: (world.step(40), done.set()))
        thread.start()
        refusals = 0
        while not done.is_set():  # which goes on while the other steps
            try:
                world.positions("cloth.flag")
            except taut.Error:
                refusals += 1
        thread.join()
        self.assertGreater(refusals, 0)
        self.assertEqual(world.tick, 40)
        timer = threading.Timer(0.2, lambda: signal.raise_signal(signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            world.step(10**9)
        before = world.tick
        world.step()
        self.assertEqual(world.tick, before + 1)


class States(Case):
    def test_saved_bytes_and_pickles_go_on_bit_for_bit(self):
        world = taut.loads(CLOTH)
        world.step(5)
        world.apply({"do": "ramp", "key": "wind.breeze.velocity", "to": [4, 0, 0], "over_s": 0.5})
        world.step(5)
        saved, again = world.save(), pickle.loads(pickle.dumps(world))
        world.step(20)
        again.step(20)
        self.assertEqual(again.hash, world.hash)
        again.restore(saved)
        self.assertEqual(again.tick, 10)
        again.step(20)
        self.assertEqual(again.hash, world.hash)

    def test_a_pickle_of_a_file_is_read_in_another_folder_and_says_what_is_amiss(self):
        with tempfile.TemporaryDirectory() as folder, contextlib.ExitStack() as back:
            back.callback(os.chdir, os.getcwd())
            os.chdir(folder)
            file = pathlib.Path("cloth.toml")
            file.write_text(CLOTH)
            world = taut.load(b"cloth.toml")
            world.step(3)
            pickled = pickle.dumps(world)
            os.chdir("/")
            self.assertEqual(pickle.loads(pickled).hash, world.hash)
            (folder / file).write_text(CLOTH.replace("radius = 0.3", "radius = 0.4"))
            with self.refused("this pickle's scene: ", f"{folder}/cloth.toml has changed; load the scene"):
                pickle.loads(pickled)
            (folder / file).unlink()
            with self.refused("this pickle's scene: ", f"{folder}/cloth.toml: there is no such file", "put that back",
                              kind="file"):
                pickle.loads(pickled)
        flag = taut.load("flag")
        self.assertEqual(pickle.loads(pickle.dumps(flag)).hash, flag.hash)  # by its name

    def test_a_pickle_holds_the_scene_s_name_and_bytes_alone(self):
        world = taut.loads(CLOTH)
        constructor, arguments, state = world.__reduce_ex__(2)[:3]
        self.assertEqual(arguments, (taut.World,))
        self.assertIsInstance(state, bytes)
        world.add_system(lambda w, t, dt: None)
        with self.refused("cannot be pickled", "save()"):
            pickle.dumps(world)

    def test_foreign_and_damaged_bytes_change_nothing(self):
        world = taut.loads(CLOTH)
        world.step(3)
        saved = world.save()
        before = world.hash
        damaged = bytearray(saved)
        damaged[len(damaged) // 2] ^= 1
        for wrong in (b"", b"no state", saved[:-9], bytes(damaged)):
            with self.refused("these bytes", kind="content"):
                world.restore(wrong)
        with self.refused("of another scene", kind="content"):
            world.restore(taut.loads(CLOTH, ["cloth.scarf.cells=[5, 5]"]).save())
        self.assertEqual(world.hash, before)


class Callbacks(Case):
    def test_a_force_moves_masses_as_theory_says(self):
        # F = -k x, 72 N/m on 2 kg: x = cos 6 t. Leap-frog's phase is ω³h²t/24 = 2.5e-3 off at 1 s, so 1e-3 m.
        world = taut.loads(MASSES)
        name = world.add_force(lambda t, x, v, m: -72.0 * x, on="net.*@m",
                               energy=lambda t, x, v, m: 36.0 * (x**2).sum(axis=1), stiffness=72.0)
        start = world.energies()["total"]
        world.run(until=1.0)
        np.testing.assert_allclose(world.positions("net.*@m")[:, 0], np.cos(6.0) * np.array([1, 2, 3]), atol=5e-3)
        self.assertLess(abs(world.energies()["total"] / start - 1), 0.01)
        self.assertEqual(name, "force.function")
        self.assertFalse(world.equal_bits)
        self.assertTrue(any("force.function is a callback" in w for w in world.warnings))

    def test_forces_are_asked_one_island_after_another(self):
        world = taut.loads(MASSES, threads=4)
        inside, order = [], []

        def force(t, x, v, m):
            self.assertFalse(inside)
            inside.append(1)
            order.append(round(x[0, 0]))
            inside.pop()
            return np.zeros_like(x)

        world.add_force(force, on="net.*@m")
        world.step(5)
        self.assertEqual([a for a, b in zip(order, [0] + order) if a != b][-3:], [1, 2, 3])

    def test_what_a_function_raises_passes_through_and_the_tick_has_not_happened(self):
        world = taut.loads(CLOTH)
        after = []

        def pull(t, x, v, m):
            if len(after) == 3:
                raise ZeroDivisionError("mine")
            return np.zeros_like(x)

        def lead(w, t, dt):
            w.place("collider.ball", [0.5, 1.2 + 0.1 * t, 0.4])
            if len(after) == 6:
                raise KeyError("mine too")

        with self.assertRaises(IndexError) as caught:
            world.add_force(lambda t, x, v, m: [][0], name="early")
        self.assertRegex(caught.exception.__notes__[0], "^taut: in force.early at 0 s, asked for 49 points$")
        world.add_force(pull)
        world.add_system(lead)
        for error, note in ((ZeroDivisionError, "in force.pull at "), (KeyError, "in the system lead of the tick to")):
            while len(after) % 6 != 3 and len(after) != 6:
                world.step()
                after.append(world.save())
            before = world.save(), world.hash, world.place_of("collider.ball")[0].tolist()
            with self.assertRaises(error) as caught:
                world.step()
            self.assertRegex("".join(caught.exception.__notes__), f"{note}.*undone")
            self.assertEqual((world.save(), world.hash, world.place_of("collider.ball")[0].tolist()), before)
            after.append(b"")
        world.step(10)

    def test_what_is_no_force_is_refused_by_its_shape_and_type(self):
        world = taut.loads(CLOTH)
        answers = {
            "(3,); it must have (49, 3)": lambda x: np.zeros(3),
            "(3, 49)": lambda x: x.T,
            "complex128": lambda x: x * 1j,
            "array of <U3": lambda x: np.full(x.shape, "one"),
            "is None": lambda x: None,
            "array of object": lambda x: [[None] * 3] * len(x),
            "force on point 42 of cloth.scarf at 0 s is not finite": lambda x: x / (x[:, 2:] - 1),
        }
        answer = [lambda x: np.zeros_like(x)]
        world.add_force(lambda t, x, v, m: answer[0](x), name="mine")
        for part, wrong in answers.items():
            answer[0] = wrong
            with np.errstate(all="ignore"), self.refused("force.mine", part):
                world.step()
        answer[0] = lambda x: np.zeros(x.shape, dtype=np.float32)
        world.step()
        world.add_force(lambda t, x, v, m: 0 * x, energy=lambda t, x, v, m: x[:, 0] * np.nan, name="vague")
        with self.refused("force.vague: its energy of point 0 of cloth.scarf at ", "not finite", kind="content"):
            world.energies()
        for bounds in ({"stiffness": np.inf}, {"damping_per_s": np.inf}, {"stiffness": -1.0}):
            with self.refused("must be finite and not negative"):
                world.add_force(lambda t, x, v, m: 0 * x, name="more", **bounds)
        with self.refused("there is no cloth.scraf", "cloth.scarf"):
            world.add_force(lambda t, x, v, m: x, on="cloth.scraf")
        with self.refused("a force force.mine already"):
            world.add_force(lambda t, x, v, m: x, name="mine")

    def test_a_force_that_is_asked_does_not_touch_its_world(self):
        world = taut.loads(CLOTH)
        state, touch, refusals = world.save(), [], []

        def zeros(t, x, v, m):
            for each in touch:
                with self.refused("has answered"):
                    each()
                refusals.append(each)
            return np.zeros_like(x)

        def from_another_thread():
            raised = []

            def ask():
                try:
                    world.positions("cloth.scarf")
                except taut.Error as error:
                    raised.append(error)

            thread = threading.Thread(target=ask)
            thread.start()
            thread.join()
            raise raised[0]

        touch[:] = [lambda: world.restore(state), world.step, world.energies, world.save,
                    lambda: world.add_force(zeros, name="another"),
                    lambda: world.place("collider.ball", [0, 0, 0]), from_another_thread]
        for ask in (lambda: world.add_force(zeros, energy=lambda t, x, v, m: zeros(t, x, v, m)[:, 0]), world.energies,
                    world.measures, world.step, lambda: world.velocities("cloth.scarf"),
                    lambda: world.add_force(zeros, name="late")):
            refusals.clear()
            ask()
            self.assertEqual(set(refusals), set(touch))
        touch.clear()
        self.assertEqual(world.tick, 1)
        world.step()

    def test_a_system_leads_a_collider_and_asks_but_does_not_step(self):
        world = taut.loads(CLOTH)
        seen = []

        def lead(w, t, dt):
            seen.append((t, w.positions("cloth.scarf").shape))
            w.place("collider.ball", position=[0.5, 1.2 + t, 0.4], rotation_deg=[0, 90, 0])
            with self.refused("may not step"):
                w.step()

        world.add_system(lead)
        world.step(3)
        self.assertEqual(seen[-1], (3 / 60, (49, 3)))
        position, rotation = world.place_of("collider.ball")
        np.testing.assert_allclose(position, [0.5, 1.25, 0.4])
        np.testing.assert_allclose(rotation, [0.5**0.5, 0, 0.5**0.5, 0], atol=1e-12)

    def test_a_world_that_its_functions_know_is_collected(self):
        world = taut.loads(MASSES)

        class Controller:
            def lead(self, w, t, dt):
                self.world = world

        controller = Controller()
        controller.world = world
        gone = weakref.ref(controller)
        world.add_system(controller.lead)
        world.step()
        del world, controller
        gc.collect()
        self.assertIsNone(gone())


class Refusals(Case):
    def test_a_run_that_diverges_says_what_to_do_and_keeps_the_last_good_state(self):
        world = taut.loads(CLOTH, ["solver.dt=0.016"])
        with self.refused("diverged", "remedy: dt = ", error=taut.Diverged, kind="diverged") as caught:
            world.step(600)
        self.assertEqual(caught.exception.body, "cloth.scarf")
        self.assertGreater(caught.exception.safe_step, 1e-4)
        self.assertEqual(caught.exception.tick, world.tick)
        self.assertTrue(np.isfinite(world.positions("cloth.scarf")).all())
        with self.assertRaises(taut.Diverged):
            world.step()

    def test_scenes_targets_and_actions_that_are_not_there(self):
        with self.refused("cloth.scarf.cels", "did you mean \"cells\"?", kind="content"):
            taut.loads(CLOTH, {"cloth.scarf.cels": [2, 2]})
        with self.refused("scene.toml:3:11: error", kind="content"):
            taut.loads("schema = 1\n[run]\nseconds = \"long\"")
        with self.refused("did you mean \"flag\"?", kind="file"):
            taut.load("flagg")
        world = taut.loads(CLOTH)
        before = world.hash
        for wrong, part in (("cloth.scraf", "cloth.scarf"), ("cloth.scarf@lft", "left"), ("scarf", "KIND.NAME")):
            with self.refused(part):
                world.positions(wrong)
        for wrong, part in (({"do": "pull"}, "did you mean"), ({"do": "release", "id": "hand"}, "hand"),
                            ({"do": "push", "target": "cloth.scarf", "impulse_Ns": [object()] * 3}, "no value")):
            with self.refused(part):
                world.apply(wrong)
        with self.refused("no collider \"collider.bowl\"", "collider.ball"):
            world.place("collider.bowl", [0, 0, 0])
        with self.refused("has the shape (2,); it must have (3,)"):
            world.place("collider.ball", [0, 0])
        endless = []
        endless.append(endless)
        with self.refused("apply(): ", "in itself"):
            world.apply({"do": endless})
        self.assertEqual(world.hash, before)
        for threads in (-1, 1025):
            with self.refused(f"threads = {threads}; it must be 1 to 1024"):
                taut.loads(CLOTH, threads=threads)

    def test_objects_that_hold_nothing(self):
        with self.refused("this World holds no scene", "taut.load()"):
            taut.World.__new__(taut.World).positions("cloth.scarf")
        with self.refused("this Surface is empty"):
            taut.Surface.__new__(taut.Surface).name


if __name__ == "__main__":
    unittest.main()
