"""diagnose from Python is that of the program."""

import unittest
from pathlib import Path

import muster
from common import SOURCE, InAScratchFolder, outcome, program

SAMPLE = SOURCE / "docs" / "samples" / "calibrate"


class Diagnoses(InAScratchFolder):
    def test_it_gives_what_the_program_prints_and_writes_a_report(self):
        program("import", SAMPLE / "log.csv", "--map", SAMPLE / "log.map", "--out", "measured.csv")
        found = muster.diagnose(SAMPLE, "measured.csv", out="found")
        self.assertEqual(found, outcome("diagnose", SAMPLE, "--data", "measured.csv"))
        self.assertIn("verdict", found)
        self.assertTrue(Path("found/report.html").is_file())
        with self.assertRaisesRegex(muster.Error, "absent.csv"):
            muster.diagnose(SAMPLE, "absent.csv")


if __name__ == "__main__":
    unittest.main()
