"""Simulations from Python: the program's digest, tables without a copy, inputs, swaps, snapshots, errors."""

import gc
import signal
import threading
import unittest

import numpy as np

import muster
from common import FIRST_WORLD, InAScratchFolder, outcome


class Digests(InAScratchFolder):
    def test_a_run_has_the_digest_of_the_program(self):
        simulation = muster.Simulation(FIRST_WORLD, until=4)
        simulation.run()
        self.assertEqual(simulation.digest(), outcome("run", FIRST_WORLD, "--until", "4")["digest"])

    def test_seed_workers_and_parameters_mean_what_they_mean_there(self):
        world = "worlds/connectivity"
        simulation = muster.Simulation(world, until=1, seed=5, workers=2, set={"radio.multiwall/n": 2.5})
        simulation.run()
        program = outcome("run", world, "--until", "1", "--seed", "5", "--set", "radio.multiwall/n=2.5")
        self.assertEqual(simulation.digest(), program["digest"])

    def test_swaps_of_the_world_take_place(self):
        simulation = muster.Simulation("worlds/hot_swap", until=4)
        simulation.run()
        self.assertEqual(simulation.digest(), outcome("run", "worlds/hot_swap", "--until", "4")["digest"])
        self.assertRegex(simulation.instances()["physics"], "^physics.ode/")

    def test_a_batch_has_the_digests_of_single_runs(self):
        for threads in (1, 2):
            batch = muster.Batch(FIRST_WORLD, seeds=[1, 2, 3], until=1)
            batch.step(20, threads=threads)
            single = [outcome("run", FIRST_WORLD, "--until", "1", "--seed", str(s))["digest"] for s in (1, 2, 3)]
            self.assertEqual([s.digest() for s in batch.simulations], single)


class Tables(InAScratchFolder):
    def test_a_table_is_a_view_without_a_copy(self):
        simulation = muster.Simulation(self.world())
        poses = simulation["robot/*/pose"]
        self.assertEqual(poses.shape, (2, 7))
        self.assertEqual(poses.dtype, np.float64)
        self.assertFalse(poses.flags.writeable or poses.flags.owndata)
        self.assertTrue(np.shares_memory(poses, simulation["robot/*/pose"]))
        self.assertTrue(np.shares_memory(poses, simulation["robot/mate/pose"]))
        np.testing.assert_array_equal(simulation["robot/mate/pose"], poses[1])
        with self.assertRaises(ValueError):
            poses[0, 0] = 1

    def test_names_and_units_are_beside_it(self):
        simulation = muster.Simulation(self.world())
        columns = simulation.columns("robot/*/odometry")
        self.assertEqual([(c.name, c.unit) for c in columns][:3], [("x", "m"), ("y", "m"), ("yaw", "rad")])
        self.assertEqual(simulation.rows("robot/*/pose"), ["rover", "mate"])
        self.assertEqual(simulation.alive("robot/*/pose"), [True, True])
        self.assertIn("robot/*/wheels", simulation.tables())

    def test_a_view_keeps_its_moment_through_steps(self):
        simulation = muster.Simulation(self.world(), inputs=["robot/rover/command"])
        simulation["robot/rover/command"] = [0.3, 0]
        views, copies = [], []
        for _ in range(20):
            simulation.step()
            views.append(simulation["robot/*/pose"])
            copies.append(views[-1].copy())
        for view, copy in zip(views, copies):
            np.testing.assert_array_equal(view, copy)
        self.assertGreater(views[-1][0, 0], views[0][0, 0])

    def test_a_view_outlives_the_simulation(self):
        simulation = muster.Simulation(self.world())
        simulation.step()
        view = simulation["robot/*/pose"]
        copy = view.copy()
        simulation.close()
        del simulation
        gc.collect()
        filler = [np.full(view.shape, 7.0) for _ in range(100)]  # what a freed block would be given to
        np.testing.assert_array_equal(view, copy)
        del filler

    def test_a_table_of_another_size_is_another_array(self):
        simulation = muster.Simulation(FIRST_WORLD)
        views, copies = [], []
        for _ in range(60):
            simulation.step()
            views.append(simulation["inbox/*/message"])
            copies.append(views[-1].copy())
        self.assertEqual({v.shape[0] for v in views}, {0, 1})
        for view, copy in zip(views, copies):
            np.testing.assert_array_equal(view, copy)

    def test_a_view_keeps_its_moment_through_a_swap_and_a_restore(self):
        simulation = muster.Simulation(self.world())
        start = simulation.snapshot()
        simulation.step(5)
        views = {name: simulation[name] for name in simulation.tables()}
        copies = {name: view.copy() for name, view in views.items()}
        simulation.swap("physics", "physics.simbody")
        simulation.step(3)
        simulation.swap("physics", "physics.planar")
        simulation.restore(start)
        simulation.remove("odometry")
        simulation.step(3)
        for name, view in views.items():
            np.testing.assert_array_equal(view, copies[name], name)

    def test_an_empty_cell_is_nan_and_bytes_are_apart(self):
        simulation = muster.Simulation(FIRST_WORLD)
        simulation.step(1)
        while not len(simulation["inbox/*/message"]):
            simulation.step()
        self.assertEqual(simulation.payloads("inbox/*/message"), [b"beacon"])
        self.assertTrue(np.isnan(simulation["inbox/*/message"][0, 5]))  # lqi: an ideal network has none


class Inputs(InAScratchFolder):
    def test_an_input_drives_a_robot_until_it_is_set_again(self):
        simulation = muster.Simulation(self.world(), inputs=["robot/rover/command"])
        simulation["robot/rover/command"] = [0.2, 0]
        simulation.step(20)
        np.testing.assert_array_equal(simulation["robot/rover/command"], [0.2, 0])
        self.assertAlmostEqual(simulation["robot/rover/pose"][0], 0.2, delta=0.1)
        simulation["robot/rover/command"] = [0, 0]
        simulation.step(20)
        rest = simulation["robot/rover/pose"][0]
        simulation.step(10)
        self.assertEqual(simulation["robot/rover/pose"][0], rest)

    def test_all_rows_are_set_at_once(self):
        simulation = muster.Simulation(self.world(), inputs=["robot/*/command"])
        simulation["robot/*/command"] = [[0.1, 0], [0.3, 0]]
        simulation.step(20)
        x = simulation["robot/*/pose"][:, 0]
        self.assertTrue(0 < x[0] < x[1])

    def test_a_restore_has_the_input_of_the_snapshot(self):
        simulation = muster.Simulation(self.world(), inputs=["robot/rover/command"])
        simulation["robot/rover/command"] = [0.2, 0.1]
        simulation.step(10)
        middle = simulation.snapshot()
        simulation.step(10)
        end = simulation.digest()
        simulation["robot/rover/command"] = [0, 0]
        simulation.step(10)
        simulation.restore(middle)
        simulation.step(10)
        self.assertEqual(simulation.digest(), end)

    def test_what_is_no_truth_for_controllers_can_be_an_input_too(self):
        simulation = muster.Simulation(FIRST_WORLD, inputs=["door/*/state"])
        simulation.step()
        before = simulation["link/*/level"].copy()
        simulation["door/*/state"] = [[0]]
        simulation.step()
        np.testing.assert_array_equal(simulation["door/*/state"], [[0]])
        self.assertEqual(before.shape, simulation["link/*/level"].shape)

    def test_wrong_shapes_and_names_are_refused(self):
        simulation = muster.Simulation(self.world(), inputs=["robot/*/command"])
        for values in ([1, 2], [[1, 2]], [[1, 2, 3], [1, 2, 3]], "fast"):
            with self.assertRaises(muster.Error):
                simulation["robot/*/command"] = values
        with self.assertRaisesRegex(muster.Error, 'is no input of the simulation; expected robot/\\*/command'):
            simulation["robot/*/comand"] = [[1, 2], [1, 2]]
        with self.assertRaisesRegex(muster.Error, "holds messages"):
            muster.Simulation("world.xml", inputs=["outbox/rover/message"])
        with self.assertRaisesRegex(muster.Error, "NaN"):
            simulation["robot/*/command"] = [[np.nan, 0], [0, 0]]
            simulation.step()


class Changes(InAScratchFolder):
    def test_a_plugin_is_swapped_as_by_the_program(self):
        simulation = muster.Simulation("worlds/square_path", until=2)
        simulation.step(100)
        simulation.swap("physics", "physics.planar", acceleration=4)
        simulation.run()
        program = outcome("swap", "worlds/square_path", "--until", "2", "--at", "1", "--instance", "physics", "--plugin",
                          "physics.planar", "acceleration=4")
        self.assertEqual(simulation.digest(), program["digest"])

    def test_a_snapshot_is_restored_here_and_by_the_program(self):
        simulation = muster.Simulation(FIRST_WORLD, until=2)
        simulation.step(20)
        simulation.snapshot().save("half")
        simulation.run()
        end = simulation.digest()
        self.assertEqual(end, outcome("run", FIRST_WORLD, "--until", "2", "--restore", "half")["digest"])
        simulation.restore(muster.Snapshot.load("half"))
        self.assertEqual(simulation.tick, 20)
        simulation.run()
        self.assertEqual(simulation.digest(), end)

    def test_parameters_are_read_and_set_by_their_paths(self):
        simulation = muster.Simulation(FIRST_WORLD)
        self.assertEqual(simulation.parameters()["radio.multiwall/n"], 1.8)
        simulation.set("material/brick/loss", 9)
        self.assertEqual(simulation.get("material/brick/loss"), 9)
        simulation.evaluate()
        one = simulation["link/*/level"][0, 0]
        simulation.set("radio.multiwall/tx_power", 3)
        simulation.evaluate()
        self.assertAlmostEqual(simulation["link/*/level"][0, 0] - one, 3)

    def test_a_loop_runs_to_the_end(self):
        simulation = muster.Simulation(self.world())
        times = list(simulation)
        self.assertEqual((len(times), times[-1], simulation.done), (40, 2.0, True))


class Threads(InAScratchFolder):
    def test_an_interrupt_ends_steps_after_a_whole_tick(self):
        simulation = muster.Simulation(self.world())
        threading.Timer(0.3, signal.raise_signal, [signal.SIGINT]).start()
        with self.assertRaises(KeyboardInterrupt):
            simulation.step(10**12)
        self.assertGreater(simulation.tick, 0)
        other = muster.Simulation("world.xml")
        other.step(simulation.tick)
        self.assertEqual(simulation.digest(), other.digest())

    def test_another_thread_runs_meanwhile_and_is_refused_the_simulation(self):
        simulation, seen = muster.Simulation(self.world()), []

        def look():
            try:
                simulation["robot/rover/pose"]
            except muster.Error as error:
                seen.append(str(error))
            signal.raise_signal(signal.SIGINT)

        threading.Timer(0.2, look).start()
        with self.assertRaises(KeyboardInterrupt):
            simulation.step(10**12)
        self.assertEqual(len(seen), 1)
        self.assertIn("the simulation is in a step", seen[0])
        simulation["robot/rover/pose"]


class Errors(InAScratchFolder):
    def test_they_have_the_programs_words_and_code(self):
        self.world('<world name="w" dt="0.1" until="1"><robots.drve/></world>')
        with self.assertRaises(muster.Error) as caught:
            muster.Simulation("world.xml")
        self.assertRegex(str(caught.exception), r'^world.xml:1:\d+: plugin "robots.drve": robots_drve.so not found')
        self.assertEqual(caught.exception.code, 3)
        with self.assertRaisesRegex(muster.Error, 'did you mean "robot/\\*/pose"') as caught:
            muster.Simulation(self.world())["robot/*/poes"]
        self.assertEqual(caught.exception.code, 2)

    def test_numbers_out_of_bounds_are_named(self):
        world = self.world()
        for make, words in (
            (lambda: muster.Simulation(world, seed=-1), "seed: -1 is no value; expected an integer from 0"),
            (lambda: muster.Simulation(world, workers=0), "workers: 0 is no value; expected an integer from 1 to 256"),
            (lambda: muster.Simulation(world, until=-1), "until: -1 s is before the start"),
            (lambda: muster.Simulation(world).step(1.5), r"step: 1\.5 is no number of ticks; expected an integer from 0: a tick is 0\.05 s, and 1\.5 s are 30 ticks, step\(30\)"),
            (lambda: muster.Batch(world, seeds=[]), "a batch of no simulations"),
            (lambda: muster.controller(print, robot="rover", every=0), "every: 0 is no number of ticks"),
            (lambda: muster.controller(3, robot="rover"), "cannot be 3; expected something that can be called"),
        ):
            self.assertRaisesRegex(muster.Error, words, make)

    def test_a_refused_change_changes_nothing(self):
        simulation = muster.Simulation(self.world())
        simulation.step(3)
        before = simulation.digest()
        for change in (
            lambda: simulation.swap("physics", "physics.planer"),
            lambda: simulation.swap("fysics", "physics.planar"),
            lambda: simulation.set("physics/speed", 1),
            lambda: simulation.restore(muster.Simulation(FIRST_WORLD).snapshot()),
            lambda: muster.Snapshot.load("absent"),
        ):
            self.assertRaises(muster.Error, change)
        self.assertEqual(simulation.digest(), before)
        simulation.step()

    def test_a_closed_simulation_says_so(self):
        with muster.Simulation(self.world()) as simulation:
            simulation.step()
        with self.assertRaisesRegex(muster.Error, "the simulation is closed"):
            simulation.step()
        with self.assertRaisesRegex(muster.Error, "closed"):
            simulation["robot/*/pose"]

    def test_a_batch_tells_its_shapes(self):
        batch = muster.Batch(self.world(), seeds=range(3), inputs=["robot/rover/command"])
        batch["robot/rover/command"] = np.tile([0.1, 0.0], (3, 1))
        batch.step(10)
        self.assertEqual(batch["robot/rover/pose"].shape, (3, 7))
        self.assertEqual(batch["robot/*/pose"].shape, (3, 2, 7))
        self.assertTrue((batch["robot/rover/pose"][:, 0] > 0).all())
        with self.assertRaisesRegex(muster.Error, r"values are 2 x 2; expected 3 x 2"):
            batch["robot/rover/command"] = np.zeros((2, 2))


if __name__ == "__main__":
    unittest.main()
