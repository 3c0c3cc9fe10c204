"""fit and plot from Python are those of the program."""

import unittest
from pathlib import Path

import muster
from common import SOURCE, InAScratchFolder, outcome, program

SAMPLE = SOURCE / "docs" / "samples" / "calibrate"


class Fits(InAScratchFolder):
    def setUp(self):
        super().setUp()
        program("import", SAMPLE / "log.csv", "--map", SAMPLE / "log.map", "--out", "all.csv")
        lines = Path("all.csv").read_text().splitlines(keepends=True)
        Path("measured.csv").write_text("".join(lines[:201]))  # 200 readings, for speed

    def test_it_gives_what_the_program_prints(self):
        found = muster.fit(SAMPLE, "measured.csv", fix={"radio.multiwall/n": 1.8}, cell=0.5)
        self.assertEqual(
            found, outcome("fit", SAMPLE, "--data", "measured.csv", "--fix", "radio.multiwall/n=1.8", "--cell", "0.5")
        )
        self.assertNotIn("radio.multiwall/n", [p["name"] for p in found["parameters"]])

    def test_it_writes_figures(self):
        found = muster.fit(SAMPLE, "measured.csv", out="figures")
        self.assertTrue(found["pictures"] and all(Path(p).is_file() for p in found["pictures"]))

    def test_its_errors_are_those_of_the_program(self):
        with self.assertRaisesRegex(muster.Error, "absent.csv"):
            muster.fit(SAMPLE, "absent.csv")
        with self.assertRaisesRegex(muster.Error, "radio.multiwall/m"):
            muster.fit(SAMPLE, "measured.csv", free=["radio.multiwall/m"])
        with self.assertRaisesRegex(muster.Error, 'average: "median" is no average; expected one of dB, power'):
            muster.fit(SAMPLE, "measured.csv", average="median")


class Plots(InAScratchFolder):
    def test_lines_are_named(self):
        muster.plot("two.svg", [0, 1, 2], {"here": [1, 2, 3], "there": [3, float("nan"), 1]}, x_label="time [s]", title="Two")
        picture = Path("two.svg").read_text()
        for word in ("here", "there", "time [s]", "Two"):
            self.assertIn(word, picture)

    def test_lengths_that_differ_and_absent_folders_are_refused(self):
        self.assertRaisesRegex(muster.Error, "^plot: ", muster.plot, "a.svg", [0, 1], [1])
        self.assertRaisesRegex(muster.Error, "^plot: .*absent", muster.plot, "absent/a.svg", [0, 1], [1, 2])


if __name__ == "__main__":
    unittest.main()
