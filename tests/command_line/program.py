# SPDX-License-Identifier: MIT
"""The program as a user runs it. argv[1]: path of slamscope; the rest goes to unittest."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
PROGRAM = None


def slamscope(*words, cwd=None, stdin=None, timeout=240, env=None):
    """Exit status, standard output, standard error."""
    done = subprocess.run([PROGRAM, *map(str, words)], cwd=cwd, input=stdin, timeout=timeout,
                          capture_output=True, text=True, env=env)
    return done.returncode, done.stdout, done.stderr


class InAFolder(unittest.TestCase):
    """Each test in an empty folder of its own."""

    def setUp(self):
        self._folder = tempfile.TemporaryDirectory(prefix="slamscope-")
        self.folder = pathlib.Path(self._folder.name)
        self.addCleanup(self._folder.cleanup)

    def run_here(self, *words, **more):
        return slamscope(*words, cwd=self.folder, **more)

    def refused(self, *words, saying, **more):
        """Exit 2 with one line that says what is wrong."""
        status, _, errors = self.run_here(*words, **more)
        lines = [line for line in errors.splitlines() if "error" in line]
        self.assertEqual(status, 2, errors)
        self.assertEqual(len(lines), 1, errors)
        for word in [saying] if isinstance(saying, str) else saying:
            self.assertIn(word, lines[0])

    def write(self, name, text):
        file = self.folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
        return file

    def load(self, name):
        return json.loads((self.folder / name).read_text())


def main():
    global PROGRAM
    PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main(module="__main__")
