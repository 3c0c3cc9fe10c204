"""Functions of Python as controllers, radio terms and other instances of a world."""

import math
import unittest

import numpy as np

import muster
from common import FIRST_WORLD, InAScratchFolder, outcome

STEADY = """<world name="plain" dt="0.05" until="2" seed="1">
  <robot name="rover" model="scarab" at="0 0 0" heading="0"/>
  <physics.planar name="physics"/>
  <control.steady name="driver" robot="rover" v="0.3" w="0.1"/>
</world>"""

LINK = """<world name="link" dt="0.1" until="1" seed="1">
  <station name="a" at="0 0 1"/>
  <station name="b" at="10 0 1"/>
  <network.ideal/>
  <control.beacon radio="a" period="0.2"/>
  TERM
</world>"""


class Controllers(InAScratchFolder):
    def test_a_function_that_does_what_a_plugin_does_gives_its_digest(self):
        world = self.world(STEADY)
        simulation = muster.Simulation(world)
        simulation.swap("driver", muster.controller(lambda tick: [0.3, 0.1], robot="rover"))
        simulation.run()
        self.assertEqual(simulation.digest(), outcome("run", world)["digest"])

    def test_it_gets_what_its_robot_senses(self):
        world, seen = self.world(), []

        @muster.controller(robot="mate", read="odometry")
        def steer(tick, odometry):
            seen.append((tick.index, tick.time, odometry))
            return [0.3, 0]

        simulation = muster.Simulation(world, functions=[steer])
        simulation.step(20)
        self.assertEqual([s[0] for s in seen], list(range(1, 21)))
        self.assertAlmostEqual(seen[-1][1], 1.0)
        self.assertEqual(seen[-1][2].shape, (5,))
        self.assertTrue(seen[-1][2].flags.owndata)  # its own, and so it may keep it
        self.assertLess(seen[2][2][0], seen[-1][2][0])
        self.assertIn("steer", simulation.instances())

    def test_truth_is_refused_as_for_any_controller(self):
        with self.assertRaisesRegex(muster.Error, r"functions_test.py:\d+: look \(python.control\): claims .*which is truth"):

            def look(tick, pose):
                return [0, 0]

            muster.Simulation(self.world(), functions=[muster.controller(look, robot="rover", read="pose")])

    def test_a_word_of_several_workers_is_the_same(self):
        digests = set()
        for workers in (1, 3):
            steer = [
                muster.controller(lambda tick, o: [0.3, math.sin(o[0])], robot=r, read="odometry", name=r)
                for r in ("rover", "mate")
            ]
            simulation = muster.Simulation(self.world(), functions=steer, workers=workers)
            simulation.run()
            digests.add(simulation.digest())
        self.assertEqual(len(digests), 1)

    def test_messages_are_read_and_sent(self):
        heard = []

        def talk(tick, inbox):
            heard.extend(zip(inbox[:, 2], tick.payloads("inbox/a/message")))
            tick.send("outbox/a/message", b"tick %d" % tick.index)

        functions = [muster.Function(talk, "control", read="inbox/a/message", write="outbox/a/message")]
        told = []
        listen = lambda tick, inbox: told.extend(tick.payloads("inbox/b/message"))
        functions.append(muster.Function(listen, "control", read="inbox/b/message", name="listen"))
        world = self.world(LINK.replace("TERM", '<radio.multiwall l0="40" n="2"/>').replace('radio="a" period="0.2"', 'radio="b"'))
        simulation = muster.Simulation(world, functions=functions)
        simulation.run()
        self.assertEqual(told[:2], [b"tick 1", b"tick 2"])
        self.assertEqual({payload for _, payload in heard}, {b"beacon"})
        self.assertTrue(all(rssi < 0 for rssi, _ in heard))


class RadioTerms(InAScratchFolder):
    def test_a_term_has_the_levels_of_the_plugin(self):
        world = self.world(LINK.replace("TERM", '<radio.multiwall tx_power="0" l0="40" n="2"/>'))
        plugin = muster.Simulation(world)
        plugin.step()

        @muster.radio_term
        def one_slope(tick, poses, ends):
            tx, rx = poses[ends.astype(int)].transpose(1, 0, 2)
            return -40 - 20 * np.log10(np.linalg.norm(tx[:, :3] - rx[:, :3], axis=1))

        function = muster.Simulation(self.world(LINK.replace("TERM", "")), functions=[one_slope])
        function.step()
        np.testing.assert_allclose(function["link/*/level"], plugin["link/*/level"], atol=1e-9)
        np.testing.assert_allclose(function["link/*/level"], -60, atol=1e-9)
        self.assertEqual(function["link/*/level@one_slope"].shape, function["link/*/level"].shape)

    def test_it_adds_to_the_others(self):
        world = self.world(LINK.replace("TERM", '<radio.multiwall tx_power="0" l0="40" n="2"/>'))
        shift = muster.radio_term(lambda tick, poses, ends: np.full(len(ends), -3.0), name="shift")
        simulation = muster.Simulation(world, functions=[shift])
        simulation.step()
        np.testing.assert_allclose(simulation["link/*/level"], -63, atol=1e-9)

    def test_draws_from_its_seed_are_the_same_in_each_run(self):
        def noise(tick, poses, ends):
            return np.random.default_rng([tick.seed, tick.index]).normal(-60, 3, len(ends))

        digests = []
        for seed in (1, 1, 2):
            simulation = muster.Simulation(self.world(LINK.replace("TERM", "")), seed=seed, functions=[muster.radio_term(noise)])
            simulation.run()
            digests.append(simulation.digest())
        self.assertEqual(digests[0], digests[1])
        self.assertNotEqual(digests[1], digests[2])


class Others(InAScratchFolder):
    def test_state_of_its_own_is_in_snapshots(self):
        def count(tick, odometry):
            return tick.last("self/sum") + odometry[0]

        function = muster.Function(count, "observe", read="robot/rover/odometry", write=("self/sum", "x[m]"))
        simulation = muster.Simulation(self.world(), functions=[function], inputs=["robot/rover/command"])
        simulation["robot/rover/command"] = [0.2, 0]
        simulation.step(10)
        middle = simulation.snapshot()
        simulation.step(10)
        end = simulation["instance/count/sum"].copy()
        self.assertGreater(end[0], 0)
        simulation.restore(middle)
        simulation.step(10)
        np.testing.assert_array_equal(simulation["instance/count/sum"], end)

    def test_a_stage_of_a_chain(self):
        half = muster.Function(lambda tick, command: command / 2, "control", modify="robot/rover/command", name="half")
        simulation = muster.Simulation(self.world(), functions=[half], inputs=["robot/rover/command"])
        simulation["robot/rover/command"] = [0.4, 0.2]
        simulation.step()
        np.testing.assert_array_equal(simulation["robot/rover/command"], [0.2, 0.1])

    def test_one_is_inserted_and_removed_during_a_run(self):
        simulation, times = muster.Simulation(self.world()), []
        look = muster.Function(lambda tick, poses: times.append(tick.time), "observe", read="robot/*/pose", every=2, name="look")
        simulation.step(2)
        simulation.insert(look)
        simulation.step(4)
        simulation.remove("look")
        simulation.step(2)
        np.testing.assert_allclose(times, [0.2, 0.3])

    def test_what_it_reports_is_an_event(self):
        say = muster.Function(lambda tick: tick.event("so far"), "observe", name="say")
        simulation = muster.Simulation(self.world(), functions=[say])
        simulation.step()
        self.assertIn((0.05, "say", "so far"), [tuple(e) for e in simulation.events()])


class Faults(InAScratchFolder):
    def simulation(self, code, **words):
        words.setdefault("write", "robot/rover/command")
        return muster.Simulation(self.world(), functions=[muster.Function(code, "control", name="faulty", **words)])

    def test_an_exception_ends_the_tick_which_is_taken_back(self):
        simulation = self.simulation(lambda tick: [1 / (3 - tick.index), 0])
        simulation.step(2)
        before = simulation.digest()
        with self.assertRaisesRegex(
            muster.Error, r"functions_test.py:\d+: faulty \(python.control\): step failed at tick 3 .*ZeroDivisionError: division"
        ) as caught:
            simulation.step()
        self.assertIsInstance(caught.exception.__cause__, ZeroDivisionError)
        self.assertEqual(caught.exception.code, 3)
        self.assertEqual((simulation.tick, simulation.digest()), (2, before))

    def test_an_interrupt_is_an_interrupt(self):
        def stop(tick):
            raise KeyboardInterrupt

        with self.assertRaises(KeyboardInterrupt):
            self.simulation(stop).step()

    def test_wrong_results_are_named(self):
        for result, words in (
            ([1, 2, 3], r"gives 3 for robot/rover/command; expected 2: v\[m/s\], w\[rad/s\]"),
            ([[1, 2], [1, 2]], "gives 2 x 2 for robot/rover/command; expected 2"),
            (1.0, "gives a single number for robot/rover/command; expected 2"),
            (None, "robot/rover/command"),
            ("ahead", "robot/rover/command: expected numbers, got <class 'str'>"),
            ([math.nan, 0], r"v\[m/s\] is NaN"),
            ([math.inf, 0], "is infinite"),
        ):
            with self.subTest(result), self.assertRaisesRegex(muster.Error, words):
                self.simulation(lambda tick: result).step()

    def test_wrong_claims_are_named(self):
        for words, text in (
            ({"read": "robot/rover"}, "expected set/row/quantity"),
            ({"read": "robot/rover/mood"}, "no standard table; expected its columns beside it"),
            ({"read": "robot/rovr/odometry"}, 'did you mean "rover"'),
            ({"read": ("self/x", "x[")}, "self/x"),
            ({"modify": "outbox/rover/message"}, "which holds messages; expected read and write"),
        ):
            with self.subTest(words), self.assertRaisesRegex(muster.Error, text):
                self.simulation(lambda tick, *_: [0, 0], **words)
        with self.assertRaisesRegex(muster.Error, "a phase cannot be \"radios\"; expected one of .*did you mean \"radio\""):
            muster.Simulation("world.xml", functions=[muster.Function(print, "radios")])

    def test_the_simulation_is_out_of_reach_in_a_step(self):
        held = []
        simulation = self.simulation(lambda tick: held[0]["robot/rover/pose"][:2])
        held.append(simulation)
        with self.assertRaisesRegex(muster.Error, "the simulation is in a step"):
            simulation.step()

    def test_a_tick_that_is_over_says_so(self):
        kept = []
        simulation = self.simulation(lambda tick: kept.append(tick) or [0, 0])
        simulation.step()
        with self.assertRaisesRegex(muster.Error, "the tick is over"):
            kept[0].time

    def test_a_program_that_lacks_the_function_says_so(self):
        world = self.world('<world name="w" dt="0.1" until="1"><python.control/></world>')
        with self.assertRaisesRegex(muster.Error, "lives in the process that made it"):
            muster.Simulation(world)


if __name__ == "__main__":
    unittest.main()
