"""The environment against the contract of Gymnasium 1.0: with the package where it is installed, else with a stand-in of the parts used.
https://gymnasium.farama.org/api/env/"""

import importlib
import sys
import types
import unittest
from unittest import mock

import numpy as np

import muster
from common import PLAIN, InAScratchFolder, blocks_of


class Env:
    """Of gymnasium.Env what the contract says of reset() and np_random."""

    np_random = None

    def reset(self, *, seed=None, options=None):
        if seed is not None or self.np_random is None:
            self.np_random = np.random.default_rng(seed)


class Box:
    def __init__(self, low, high, shape=None, dtype=np.float32):
        self.shape = np.shape(low) if shape is None else tuple(shape)
        self.low, self.high, self.dtype = np.broadcast_to(low, self.shape), np.broadcast_to(high, self.shape), np.dtype(dtype)

    def sample(self):
        return np.random.default_rng(1).uniform(self.low, self.high)

    def contains(self, x):
        return x.shape == self.shape and x.dtype == self.dtype and bool(np.all(x >= self.low) and np.all(x <= self.high))


def stand_in():
    module = types.ModuleType("gymnasium")
    module.Env, module.spaces = Env, types.SimpleNamespace(Box=Box)
    return module


def gym_with(gymnasium):
    """muster.gym as it is imported where `gymnasium` is the package, or None where there is none."""
    with mock.patch.dict(sys.modules, {"gymnasium": gymnasium}):
        sys.modules.pop("muster.gym", None)
        return importlib.import_module("muster.gym")


try:
    import gymnasium as installed
except ImportError:
    installed = stand_in()


class WithoutGymnasium(InAScratchFolder):
    def test_it_is_imported_and_one_clear_error_says_what_is_missing(self):
        gym = gym_with(None)
        with self.assertRaisesRegex(muster.Error, "needs gymnasium, which Debian 12 does not package; expected pip install"):
            gym.Environment("nowhere", actions={}, observations=[], reward=lambda s: 0)


class Contract(InAScratchFolder):
    def environment(self, **words):
        settings = dict(
            actions={"robot/rover/command": ([-0.3, -1], [0.3, 1])},
            observations=["robot/rover/odometry", "robot/mate/pose"],
            reward=lambda s: s["robot/rover/pose"][0],
            ticks=4,
        )
        world = words.pop("world", None) or self.world()
        environment = gym_with(installed).Environment(world, **{**settings, **words})
        self.addCleanup(environment.close)
        return environment

    def test_spaces_and_results_have_the_promised_form(self):
        environment = self.environment()
        self.assertIsInstance(environment, installed.Env)
        self.assertEqual(environment.action_space.shape, (2,))
        np.testing.assert_array_equal(environment.action_space.high, [0.3, 1])
        observation, info = environment.reset(seed=1)
        self.assertTrue(environment.observation_space.contains(observation))
        self.assertEqual((observation.shape, info["time"]), ((12,), 0))
        result = environment.step(np.array([0.3, 0]))
        self.assertEqual([type(part) for part in result], [np.ndarray, float, bool, bool, dict])
        self.assertTrue(environment.observation_space.contains(result[0]))
        self.assertAlmostEqual(result[4]["time"], 0.2)
        self.assertGreater(result[1], 0)

    def test_an_episode_is_truncated_at_the_end_and_terminated_by_its_condition(self):
        environment = self.environment()
        environment.reset(seed=1)
        ends = [environment.step(np.zeros(2))[2:4] for _ in range(10)]
        self.assertEqual(ends, [(False, False)] * 9 + [(False, True)])
        with self.assertRaisesRegex(muster.Error, "expected reset"):
            environment.step(np.zeros(2))
        environment = self.environment(terminated=lambda s: s["robot/rover/pose"][0] > 0.1)
        environment.reset(seed=1)
        terminated = False
        while not terminated:
            _, reward, terminated, truncated, _ = environment.step(np.array([0.3, 0]))
            self.assertFalse(truncated)
        self.assertGreater(reward, 0.1)

    def test_the_same_seed_gives_the_same_episodes_and_no_seed_others(self):
        def episodes(environment):
            digests, seeds = [], []
            for seed in (7, None, None):
                _, info = environment.reset(seed=seed)
                for _ in range(5):
                    environment.step(np.array([0.2, 0.1]))
                digests.append(environment.simulation.digest())
                seeds.append(info["seed"])
            return digests, seeds

        one, other = episodes(self.environment()), episodes(self.environment())
        self.assertEqual(one, other)
        self.assertEqual(len(set(one[1])), 3)

    def test_an_empty_cell_is_a_number(self):
        radios = '<radio.multiwall tx_power="POWER" l0="40" n="2"/><network.ideal/><control.beacon radio="rover"/>'
        for power, heard in ((-50, False), (0, True)):  # a receiver hears from -95 dBm on
            world = self.world(PLAIN.replace("<physics", radios.replace("POWER", str(power)) + "<physics"))
            environment = self.environment(world=world, observations=["link/*/rssi"], empty=-200.0)
            environment.reset(seed=1)
            observation = environment.step(np.zeros(2))[0]
            self.assertEqual(observation.shape, (2,))
            self.assertEqual(np.isnan(environment.simulation["link/*/rssi"]).all(), not heard)
            np.testing.assert_array_equal(observation > -200, heard)

    def test_a_wrong_action_is_refused(self):
        environment = self.environment()
        with self.assertRaisesRegex(muster.Error, "expected reset"):
            environment.step(np.zeros(2))
        environment.reset(seed=1)
        with self.assertRaisesRegex(muster.Error, "the action has 3 numbers; expected 2"):
            environment.step(np.zeros(3))

    def test_the_page_shows_one(self):
        code = [code for kind, code in blocks_of("docs/how-to/drive_from_python.md") if kind == "py" and "gym" in code]
        self.assertEqual(len(code), 1)
        self.world(name="open.xml")
        gym = gym_with(installed)
        names = {"np": np}
        with mock.patch.dict(sys.modules, {"muster.gym": gym}):
            exec(code[0], names)
        self.addCleanup(names["environment"].close)
        self.assertEqual(names["info"]["time"], 0.1)
        self.assertLessEqual(names["reward"], 0)

    @unittest.skipUnless(hasattr(installed, "utils"), "gymnasium is not installed: its own checker is not run")
    def test_the_checker_of_gymnasium_passes(self):
        from gymnasium.utils.env_checker import check_env

        check_env(self.environment(), skip_render_check=True)


if __name__ == "__main__":
    unittest.main()
