"""A world as an environment of Gymnasium, which Debian 12 does not package: `pip install gymnasium`."""

from __future__ import annotations

import os
from typing import Any, Callable, Mapping, Sequence

import numpy as np

from ._muster import Error
from .simulation import Simulation

try:
    import gymnasium
except ImportError:
    gymnasium = None


class Environment(gymnasium.Env if gymnasium else object):
    """A world as an environment.

    actions: inputs of the simulation with their lowest and highest values, {"robot/rover/command": ([-0.3, -1], [0.3, 1])};
    the action is all of them in one array [numbers]. observations: tables or rows, flattened into one array of float64
    [numbers]; their number of rows must not change. empty: the number that stands for an empty cell.
    reward(simulation): called after each step. terminated(simulation): True ends the episode. It is truncated at the world's
    end. ticks: of the world in a step. The other words are those of Simulation.

    Each episode has a seed of its own, drawn from that of `reset(seed=...)`, and the same ones in the same order give the
    same bits. Raises Error without gymnasium, and for what Simulation refuses.
    """

    metadata = {"render_modes": []}

    def __init__(
        self,
        world: str | os.PathLike,
        *,
        actions: Mapping[str, tuple[Any, Any]],
        observations: Sequence[str],
        reward: Callable[[Simulation], float],
        terminated: Callable[[Simulation], bool] = lambda simulation: False,
        ticks: int = 1,
        empty: float = 0.0,
        **words: Any,
    ) -> None:
        if gymnasium is None:
            raise Error("muster.gym.Environment needs gymnasium, which Debian 12 does not package; expected pip install gymnasium")
        self._world, self._words = world, {**words, "inputs": list(actions)}
        self._observations, self._reward, self._terminated = list(observations), reward, terminated
        self._ticks, self._empty = ticks, empty
        self.render_mode = None
        self._first = self.simulation = Simulation(world, **self._words)
        self._shapes = {table: self.simulation[table].shape for table in actions}
        low, high = (
            np.concatenate([np.broadcast_to(np.asarray(ends[k], float), self._shapes[table]).ravel() for table, ends in actions.items()])
            for k in (0, 1)
        )
        self.action_space = gymnasium.spaces.Box(low, high, dtype=np.float64)
        size = self._observed().shape
        self.observation_space = gymnasium.spaces.Box(-np.inf, np.inf, size, dtype=np.float64)
        self._over = True

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[np.ndarray, dict[str, Any]]:
        """Begins an episode; `options` may have a world's "seed" for this episode alone."""
        super().reset(seed=seed)
        own = (options or {}).get("seed")
        world_seed = int(self.np_random.integers(2**31)) if own is None else int(own)
        self.simulation = Simulation(self._world, **{**self._words, "seed": world_seed}, like=self._first)
        self._over = False
        return self._observed(), self._info()

    def step(self, action: np.ndarray) -> tuple[np.ndarray, float, bool, bool, dict[str, Any]]:
        """One step: observation, reward, terminated, truncated, info with "time" [s] and "seed". Raises Error before reset()."""
        if self._over:
            raise Error("the episode is over; expected reset() before the next step")
        action, begin = np.asarray(action, float).ravel(), 0
        if action.shape != self.action_space.shape:
            raise Error(f"the action has {action.size} numbers; expected {self.action_space.shape[0]}")
        for table, shape in self._shapes.items():
            size = int(np.prod(shape))
            self.simulation[table] = action[begin : begin + size].reshape(shape)
            begin += size
        self.simulation.step(self._ticks)
        terminated, truncated = bool(self._terminated(self.simulation)), self.simulation.done
        self._over = terminated or truncated
        return self._observed(), float(self._reward(self.simulation)), terminated, truncated, self._info()

    def close(self) -> None:
        """Ends the simulation."""
        for simulation in {id(s): s for s in (self.simulation, self._first)}.values():
            simulation.close()

    def _observed(self) -> np.ndarray:
        flat = np.concatenate([self.simulation[table].ravel() for table in self._observations])
        return np.where(np.isnan(flat), self._empty, flat)

    def _info(self) -> dict[str, Any]:
        return {"time": self.simulation.time, "seed": self.simulation.seed}
