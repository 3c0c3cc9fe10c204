"""What tests of the Python package share: paths, the program, worlds in scratch folders."""

import json
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ["MUSTER_SOURCE_DIR"])
PROGRAM = os.environ["MUSTER_PROGRAM"]
FIRST_WORLD = SOURCE / "docs" / "samples" / "first_world"

#: A robot with wheels and an odometer, and nobody who drives it.
PLAIN = """<world name="plain" dt="0.05" until="2" seed="1">
  <robot name="rover" model="scarab" at="0 0 0" heading="0"/>
  <robot name="mate" model="scarab" at="0 3 0" heading="0"/>
  <physics.planar name="physics"/>
  <robots.odometry name="odometry"/>
</world>"""


def program(*words: str) -> str:
    """Output of the program muster."""
    return subprocess.run([PROGRAM, *map(str, words)], check=True, capture_output=True, text=True).stdout


def outcome(*words: str) -> dict:
    """What a run or a swap prints as JSON."""
    return json.loads(program(*words, "--json"))


def blocks_of(page: str) -> list[tuple[str, str]]:
    """The fenced blocks of a page: language and text."""
    return re.findall(r"^```(\w+)\n(.*?)^```$", (SOURCE / page).read_text(), re.MULTILINE | re.DOTALL)


class InAScratchFolder(unittest.TestCase):
    """Each test runs in a folder of its own, in which docs/ and worlds/ are those of the tree."""

    def setUp(self) -> None:
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        before = os.getcwd()
        self.addCleanup(os.chdir, before)
        os.chdir(scratch.name)
        for folder in ("docs", "worlds"):
            os.symlink(SOURCE / folder, folder)

    def world(self, text: str = PLAIN, name: str = "world.xml") -> str:
        Path(name).write_text(text)
        return name
