"""diagnose from Python is that of the program."""

import unittest
from pathlib import Path

import muster
from common import SOURCE, InAScratchFolder, blocks_of, outcome, program

SAMPLE = SOURCE / "docs" / "samples" / "calibrate"


class Diagnoses(InAScratchFolder):
    def test_it_gives_what_the_program_prints_and_writes_a_report(self):
        program("import", SAMPLE / "log.csv", "--map", SAMPLE / "log.map", "--out", "measured.csv")
        names = {"muster": muster}
        for kind, code in blocks_of("docs/how-to/drive_from_python.md"):
            if kind == "py" and "diagnose" in code:  # as the page does
                exec(code, names)
        self.assertEqual(names["report"], outcome("diagnose", "docs/samples/calibrate", "--data", "measured.csv"))
        self.assertTrue(Path("found/report.html").is_file())
        with self.assertRaisesRegex(muster.Error, "absent.csv"):
            muster.diagnose(SAMPLE, "absent.csv")


if __name__ == "__main__":
    unittest.main()
