# SPDX-License-Identifier: MIT
"""apps/loggers: filters that log themselves come out at level L2, whole; their twins with a fault
planted are found."""
import json
import shutil
import subprocess
import sys

import program

SOURCE = program.HERE.parent.parent
LOGGERS = SOURCE / "apps" / "loggers"
sys.path.insert(0, str(LOGGERS))
from slamscope_log import Log  # noqa: E402

EXACT = ("finite", "symmetric", "positive", "shrink", "support", "rank", "range", "map-still",
         "motion", "process-noise", "initialise")


class Logged(program.InAFolder):
    def report(self, file, status):
        found, text, errors = self.run_here("audit", file, "--json", "a.json")
        self.assertEqual(found, status, text + errors)
        report = self.load("a.json")
        return report, {law["law"]: law for law in report["laws"]}

    def is_whole(self, file, declared=True):
        report, laws = self.report(file, 0)
        self.assertEqual((report["verdict"], report["level"]), ("ok", "L2"))
        for law in EXACT + (("sensor-noise",) if declared else ()):
            self.assertEqual(laws[law]["status"], "ok", law)

    def has_a_late_jacobian(self, file):
        report, laws = self.report(file, 1)
        self.assertTrue(report["classes"]["code_fault"])
        self.assertEqual(laws["motion"]["status"], "violated")
        self.assertIn("heading after the move", " ".join(report["likely"]))


class Python(Logged):
    def run_filter(self, *words):
        subprocess.run([sys.executable, "-I", "-S", SOURCE / "tests" / "python" / "logged_ekf.py",
                        "run.jsonl", *words], cwd=self.folder, check=True, timeout=120)

    def test_a_correct_filter_is_whole(self):
        for seed in ("1", "2", "3"):
            self.run_filter("--seed", seed, "--steps", "200")
            self.is_whole("run.jsonl")

    def test_a_late_motion_jacobian_is_found(self):
        self.run_filter("--fault", "late-motion-jacobian", "--steps", "200")
        self.has_a_late_jacobian("run.jsonl")

    def test_needs_no_numpy(self):
        text = (LOGGERS / "slamscope_log.py").read_text()
        imports = [line for line in text.splitlines() if line.startswith(("import ", "from "))]
        self.assertEqual(imports, ["import json", "import sys"])

    def lines(self, file="run.jsonl"):
        return [json.loads(line) for line in (self.folder / file).read_text().splitlines()]

    def test_takes_arrays_of_whatever_kind(self):
        class Array:  # what NumPy's arrays have, and PyTorch's
            def __init__(self, values):
                self.values = values

            def tolist(self):
                return self.values

        class Float32(float):
            pass

        eye = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
        record = Log(self.folder / "run.jsonl", R=Array([[1, 0], [0, 1]]))
        record.predicted(Array([[1.0], [2.0], [3.0]]), Array(eye))
        record.predicted((1.0, 2.0, Float32(3.0)), [Array(row) for row in eye], t=Float32(7.5))
        record.updated([1.0, 2.0, 3.0], sum(eye, []), Array([]))
        record.close()
        header, *records = self.lines()
        self.assertEqual(header["R"], [[1, 0], [0, 1]])
        for line in records:
            self.assertEqual(line["pose"], [1, 2, 3])
        self.assertEqual([line["time_s"] for line in records], [1, 7.5, 7.5])
        self.assertEqual(self.run_here("info", "run.jsonl")[0], 0)

    def test_ids_follow_what_was_said_or_the_place(self):
        def state(n):
            size = 3 + 2 * n
            return [0.0] * size, [[float(i == j) for j in range(size)] for i in range(size)]

        record = Log(self.folder / "run.jsonl")
        record.initialised(*state(2))
        record.initialised(*state(3))
        record.close()
        self.assertEqual([line["ids"] for line in self.lines()[1:]], [[1, 2], [1, 2, 3]])
        record = Log(self.folder / "run.jsonl")
        record.initialised(*state(2), [42, 7])
        record.removed(*state(1), 42)
        record.initialised(*state(2), 9)
        with self.assertRaisesRegex(ValueError, "whose ids are known"):
            record.updated(*state(3))
        record.close()
        self.assertEqual([line["ids"] for line in self.lines()[1:]], [[42, 7], [7], [7, 9]])
        self.assertEqual(self.run_here("info", "run.jsonl")[0], 0)

    def test_a_diverging_filter_is_logged_and_found(self):
        nan, inf = float("nan"), float("inf")
        record = Log(self.folder / "run.jsonl")
        record.predicted([0.0, 0.0, 0.0], [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
        record.predicted([nan, 0.0, 0.0], [[inf, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
        record.close()
        _, laws = self.report("run.jsonl", 1)
        self.assertEqual(laws["finite"]["first_record"], 1)

    def test_lines_leave_at_once_on_standard_output(self):
        code = ("from slamscope_log import Log; Log('-').predicted([0, 0, 0], "
                "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]); import os; os._exit(0)")
        done = subprocess.run([sys.executable, "-c", code], cwd=LOGGERS, capture_output=True, text=True,
                              env={"PYTHONDONTWRITEBYTECODE": "1"}, check=True, timeout=60)
        status, text, errors = self.run_here("audit", "-", stdin=done.stdout)
        self.assertEqual(status, 3, text + errors)


class Octave(Logged):
    """The logger for MATLAB under Octave, and the .mat files that Octave saves."""

    def octave(self, before=""):
        if shutil.which("octave-cli") is None:
            self.skipTest("octave-cli (package octave) is not installed")
        script = SOURCE / "tests" / "octave" / "logged_ekf.m"
        done = subprocess.run(
            ["octave-cli", "--norc", "--quiet", "--eval",
             f"addpath('{LOGGERS}'); {before} try; source('{script}'); "
             "catch e; disp(e.message); exit(1); end"],
            cwd=self.folder, capture_output=True, text=True, timeout=240, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_a_correct_filter_is_whole_and_its_files_are_read(self):
        self.octave()
        self.is_whole("run.jsonl")
        for file, level in (("cells.mat", "L1"), ("stack.mat", "L1"), ("struct.mat", "L1+L4"),
                            ("diagonal.mat", "L0+L4")):
            report, laws = self.report(file, 0)
            self.assertEqual((report["verdict"], report["level"]), ("ok", level), file)
            self.assertEqual(report["records"], 150 if file in ("cells.mat", "stack.mat") else 151)
            self.assertEqual(laws["shrink"]["status"], "ok")
        runs = [self.run_here("convert", file, "-")[1] for file in ("cells.mat", "stack.mat")]
        self.assertEqual(runs[0], runs[1])
        self.assertEqual(len(runs[0].splitlines()), 151)

    def test_a_late_motion_jacobian_is_found(self):
        self.octave("late = true;")
        self.has_a_late_jacobian("run.jsonl")


if __name__ == "__main__":
    program.main()
