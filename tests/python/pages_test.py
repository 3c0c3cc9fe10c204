"""The Python of README.md and of docs/how-to/drive_from_python.md runs as printed, and prints what they show."""

import contextlib
import io
import re
import unittest
from pathlib import Path

from common import FIRST_WORLD, InAScratchFolder, blocks_of, outcome


def fits(pattern: str, text: str) -> bool:
    """Whether a text is as a page shows it, where `...` is any text."""
    return re.fullmatch(".*".join(re.escape(part) for part in pattern.split("...")), text, re.DOTALL) is not None


class Pages(InAScratchFolder):
    def run_page(self, page: str) -> tuple[int, dict]:
        """Runs the blocks of `python` in one namespace; a block of `text` after one is what it prints."""
        names, count, blocks = {"__name__": "page"}, 0, blocks_of(page)
        for (kind, code), (next_kind, expected) in zip(blocks, blocks[1:] + [("", "")]):
            if kind != "python":
                continue
            printed, count = io.StringIO(), count + 1
            with contextlib.redirect_stdout(printed):
                exec(compile(code, f"{page}, block {count}", "exec"), names)
            if next_kind == "text":
                self.assertTrue(fits(expected, printed.getvalue()), f"block {count} prints\n{printed.getvalue()}")
        return count, names

    def test_the_how_to(self):
        count, _ = self.run_page("docs/how-to/drive_from_python.md")
        self.assertGreaterEqual(count, 8)

    def test_the_fifteen_lines_of_the_readme(self):
        lines = [code for kind, code in blocks_of("README.md") if kind == "python"]
        self.assertEqual(len(lines), 1)
        self.assertLessEqual(len(lines[0].splitlines()), 15)
        _, names = self.run_page("README.md")
        picture = Path("rssi.svg").read_text()
        self.assertIn("RSSI", picture)
        self.assertGreater(len(picture), 5000)
        # A plugin that drives as the function does gives the same run, to the bit.
        program = outcome("swap", FIRST_WORLD, "--at", "0", "--instance", "driver", "--plugin", "control.steady",
                          "robot=rover", "v=0.3", "w=0.1")
        self.assertEqual(names["simulation"].digest(), program["digest"])


if __name__ == "__main__":
    unittest.main()
