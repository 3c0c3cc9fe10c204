#!/usr/bin/env python3
"""Steps many bare worlds of one robot from Python, by CPU time. Limit: 1e5 robot-steps a second and core.

usage: PYTHONPATH=build/release/python /usr/bin/python3 benchmarks/environments.py [WORLDS]
"""

import resource
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import muster

LIMIT = 1e5  # robot-steps a second and core
BARE = """<world name="bare" dt="0.05" until="1000" seed="1">
  <robot name="rover" model="scarab" at="0 0 0" heading="0"/>
  <physics.planar name="physics"/>
</world>"""


def rate(work, robots: int, ticks: int) -> float:
    """The best of three: robot-steps a second of CPU time, of this thread and those that it starts."""
    best = 0.0
    for _ in range(3):
        began = time.process_time()
        work(ticks)
        best = max(best, robots * ticks / (time.process_time() - began))
    return best


def main() -> None:
    worlds = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    with tempfile.TemporaryDirectory() as folder:
        world = Path(folder) / "bare.xml"
        world.write_text(BARE)
        began = time.process_time()
        batch = muster.Batch(world, seeds=range(worlds), inputs=["robot/rover/command"])
        print(f"{worlds} worlds made in {time.process_time() - began:.2f} s of CPU, "
              f"{resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024:.0f} MB in all")
        commands = np.random.default_rng(1).uniform([0, -1], [0.3, 1], (worlds, 2))
        function = muster.Simulation(world, functions=[muster.controller(lambda tick: [0.2, 0.1], robot="rover", name="steer")])

        def whole(ticks: int) -> None:
            for _ in range(ticks):
                batch["robot/rover/command"] = commands
                batch.step()
                batch["robot/rover/pose"]

        def loop(ticks: int) -> None:
            for _ in range(ticks):
                for simulation, command in zip(batch.simulations, commands):
                    simulation["robot/rover/command"] = command
                    simulation.step()
                    simulation["robot/rover/pose"]

        def one_by_one(ticks: int) -> None:
            for _ in range(ticks):
                batch.step()

        # What is slow is memory: a world that is stepped once a round has left the caches since.
        batch["robot/rover/command"] = commands
        rows = (
            ("batch: a tick of each world in turn", one_by_one, worlds, 100),
            ("batch: 100 ticks of each world in turn", batch.step, worlds, 100),
            ("batch: set commands, step, read poses", whole, worlds, 100),
            ("loop of Python: set, step, read", loop, worlds, 10),
            ("one world, a controller in Python", function.step, 1, 20000),
        )
        for name, work, robots, ticks in rows:
            found = rate(work, robots, ticks)
            print(f"{name:<40} {found:12,.0f} robot-steps/s of CPU, {found / LIMIT:6.2f} x the limit")


if __name__ == "__main__":
    main()
