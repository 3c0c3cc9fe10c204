"""Simulations: one, or many in a batch."""

from __future__ import annotations

import operator
import os
from typing import Any, Iterator, Mapping, NamedTuple, Sequence

import numpy as np

from . import _muster
from ._muster import Snapshot
from .functions import Function
from .places import plugin_folders


class Column(NamedTuple):
    """A column of a table."""

    name: str
    unit: str  #: "" where it has none
    reference: str  #: the set whose row numbers it holds, or ""
    nullable: bool  #: NaN is an empty cell
    bytes: bool  #: cells are bytes, which payloads() returns


class Event(NamedTuple):
    """A line of the run's list of events."""

    time: float  #: [s]
    instance: str  #: "" for the kernel's
    message: str


def _texts(attributes: Mapping[str, Any]) -> dict[str, str]:
    texts = {}
    for name, value in attributes.items():
        texts[name] = ("true" if value else "false") if isinstance(value, (bool, np.bool_)) else str(value)
    return texts


def _integer(what: str, value: Any, lowest: int, highest: int) -> int:
    """The value as an int. Raises Error with what it is of."""
    try:
        number = operator.index(value)
    except TypeError:
        number = lowest - 1
    if not lowest <= number <= highest:
        bounds = f"from {lowest}" if highest >= 2**63 - 1 else f"from {lowest} to {highest}"
        raise _muster.Error(f"{what}: {value!r} is no value; expected an integer {bounds}")
    return number


def _ticks(value: Any, dt: float) -> int:
    """The value as a number of ticks. Raises Error; of a time it says how many ticks it is."""
    if isinstance(value, (float, np.floating)) and value >= 0 and np.isfinite(value):
        count = round(value / dt)
        raise _muster.Error(
            f"step: {value:g} is no number of ticks; expected an integer from 0: a tick is {dt:g} s, and {value:g} s are "
            f"{count} ticks, step({count})"
        )
    return _integer("step: ticks", value, 0, 2**63 - 1)


class Simulation:
    """A running world.

    world: its folder or file. seed, until [s]: instead of the world's. workers: threads; results do not depend on them.
    set: values of parameters by their paths. functions: instances beside those of the world. inputs: standard tables, or rows
    of them, that this program sets; before it does, they keep the world's values. plugins: folders, looked in first.
    like: another simulation, whose loaded libraries and files are used again. Raises Error.

    `simulation["robot/*/pose"]` is the table of this moment as a read-only array of float64 [rows x columns],
    `simulation["robot/rover/pose"]` one row, [columns]. There is no copy, and the array never changes: after a step, a
    swap, a restore or the simulation's end it still holds the values of its moment, and a table of other size is another
    array. Take it again after each step. `simulation["robot/rover/command"] = [0.3, 0]` sets an input from the next step on.

    A function that refers to its own simulation keeps it alive until close().
    """

    def __init__(
        self,
        world: str | os.PathLike,
        *,
        seed: int | None = None,
        until: float | None = None,
        workers: int = 1,
        set: Mapping[str, float] = {},
        functions: Sequence[Function] = (),
        inputs: Sequence[str] = (),
        plugins: Sequence[str | os.PathLike] = (),
        like: Simulation | None = None,
    ) -> None:
        self._run = _muster.Run(
            os.fspath(world),
            plugin_folders(plugins),
            None if seed is None else _integer("seed", seed, 0, 2**63 - 1),
            until,
            _integer("workers", workers, 1, 256),
            [function._named() for function in functions],
            list(inputs),
            like._run if like else None,
        )
        for path, value in set.items():
            self.set(path, value)

    # ---- Time ----

    @property
    def name(self) -> str:
        """The world's name."""
        return self._run.name()

    @property
    def seed(self) -> int:
        """The seed of all random numbers."""
        return self._run.seed()

    @property
    def tick(self) -> int:
        """Ticks so far."""
        return self._run.tick()

    @property
    def time(self) -> float:
        """Time in s."""
        return self._run.time()

    @property
    def dt(self) -> float:
        """Length of a tick in s."""
        return self._run.dt()

    @property
    def done(self) -> bool:
        """True at the world's end; steps may go on after it."""
        return self._run.tick() >= self._run.ticks()

    def step(self, ticks: int = 1) -> None:
        """Runs so many ticks. If one fails, raises Error, and the state is that of the tick before."""
        self._run.step(_ticks(ticks, self._run.dt()))

    def run(self) -> None:
        """Runs to the world's end. Ctrl-C ends it after a whole tick."""
        self._run.step(max(0, self._run.ticks() - self._run.tick()))

    def __iter__(self) -> Iterator[float]:
        """Runs to the world's end, and gives the time in s after each tick."""
        while not self.done:
            self._run.step(1)
            yield self._run.time()

    # ---- Tables ----

    def tables(self) -> list[str]:
        """Names of all tables."""
        return self._run.tables()

    def __getitem__(self, table: str) -> np.ndarray:
        """A table, [rows x columns], or a row of it, [columns]: see the class. Raises Error with the nearest name."""
        return self._run.table(table)

    def __setitem__(self, table: str, values: Any) -> None:
        """Sets an input of the simulation, as large as the table or the row. It holds until it is set again."""
        self._run.set_rows(table, values)

    def columns(self, table: str) -> list[Column]:
        """Columns of a table: names and units."""
        return [Column(*column) for column in self._run.columns(table)]

    def rows(self, table: str) -> list[str]:
        """Names of a table's rows, in their order; none in queues and lists, such as links, whose rows have numbers."""
        return self._run.rows(table)

    def alive(self, table: str) -> list[bool]:
        """False for a row that has left; it keeps its number and its last values."""
        return self._run.alive(table)

    def payloads(self, table: str) -> list[bytes]:
        """Bytes of each row of a table that has a column of them."""
        return self._run.payloads(table)

    # ---- Parameters and plugins ----

    def parameters(self) -> dict[str, float]:
        """Values of all parameters by their paths, such as "radio.multiwall/n"."""
        return {path: value for path, value, _ in self._run.parameters()}

    def get(self, path: str) -> float:
        """A parameter's value. Raises Error with the nearest path."""
        return self._run.parameter(path)

    def set(self, path: str, value: float) -> None:
        """Sets a parameter, inside its declared bounds. Raises Error."""
        self._run.set_parameter(path, value)

    def instances(self) -> dict[str, str]:
        """Plugins by the names of their instances, in world-file order: {"physics": "physics.simbody/1"}."""
        return {name: plugin for name, plugin, _ in self._run.instances()}

    def swap(self, instance: str, plugin: str | Function, **attributes: Any) -> None:
        """Exchanges an instance's plugin, state carried over; `attributes` are the new one's. Raises Error, and changes nothing
        then."""
        if isinstance(plugin, Function):
            if attributes:
                raise _muster.Error("swap: a function has no attributes; expected none")
            self._run.swap_to(instance, plugin._named())
        else:
            self._run.swap(instance, plugin, _texts(attributes))

    def insert(self, function: Function) -> None:
        """Adds a function as the last instance. What it reads must have a writer already. Raises Error."""
        self._run.insert(function._named())

    def remove(self, instance: str) -> None:
        """Removes an instance. Raises Error where another one reads what it writes."""
        self._run.remove(instance)

    def evaluate(self, expected: bool = True) -> None:
        """Evaluates the radio channel at this moment, as it is expected on average, or drawn. Time does not pass."""
        self._run.evaluate(expected)

    # ---- State ----

    def snapshot(self) -> Snapshot:
        """The state now, to restore() later: a copy."""
        return self._run.snapshot()

    def restore(self, snapshot: Snapshot) -> None:
        """Goes back, or on, to a snapshot of the same world. Inputs have its values. Raises Error, and changes nothing then."""
        self._run.restore(snapshot)

    def digest(self) -> str:
        """Hash of all tables in hex, the one that `muster run` prints."""
        return self._run.digest()

    def events(self) -> list[Event]:
        """Warnings, joins, swaps and what plugins report, since the start."""
        return [Event(*event) for event in self._run.events()]

    def close(self) -> None:
        """Destroys all instances. Arrays that were taken stay valid. Raises Error for a plugin that fails then."""
        self._run.close()

    def __enter__(self) -> Simulation:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


class Batch:
    """Many simulations of one world, stepped, read and set in one call each.

    seeds: one for each. The other words are those of Simulation. `batch["robot/rover/pose"]` is an array [simulations x
    columns], `batch["robot/*/pose"]` [simulations x rows x columns]; both are copies. `batch["robot/rover/command"] = array`
    sets an input in each.
    """

    def __init__(self, world: str | os.PathLike, seeds: Sequence[int], **words: Any) -> None:
        self.simulations: list[Simulation] = []
        for seed in seeds:
            like = self.simulations[0] if self.simulations else None
            self.simulations.append(Simulation(world, seed=seed, like=like, **words))
        self._runs = _muster.Runs([simulation._run for simulation in self.simulations])

    def __len__(self) -> int:
        return len(self.simulations)

    def step(self, ticks: int = 1, threads: int = 1) -> None:
        """Runs so many ticks of each. Where one fails the others are stepped all the same; then raises its Error."""
        self._runs.step(_integer("ticks", ticks, 0, 2**63 - 1), _integer("threads", threads, 1, 256))

    def __getitem__(self, table: str) -> np.ndarray:
        """A table of each simulation: see the class. Raises Error where numbers of rows differ."""
        return self._runs.table(table)

    def __setitem__(self, table: str, values: Any) -> None:
        """Sets an input of each simulation: one value set a simulation. Raises Error for another shape."""
        self._runs.set_rows(table, values)
