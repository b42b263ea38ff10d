#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Whether a long view of a large map needs more and more memory.

memory.py SLAMSCOPE [--features N] [--minutes M] [--fps F] [--allowed SHARE]

Runs `slamscope monitor` over a simulated map, looks at the process's memory every second, and
compares the second quarter of the frames with the last. Exit status 1 where the last needs more
by over SHARE of the covariance's bytes (2 N x 2 N doubles).
"""
import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time


def resident_bytes(process):
    """Now; None once it has ended."""
    for line in pathlib.Path(f"/proc/{process.pid}/status").read_text().splitlines():
        if line.startswith("VmRSS:"):
            return 1024 * int(line.split()[1])
    return None


def watch(command):
    seen = []
    process = subprocess.Popen([str(word) for word in command],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while process.poll() is None:
        if (now := resident_bytes(process)) is not None:
            seen.append(now)
        time.sleep(1.0)
    if process.returncode != 0:
        sys.exit(f"slamscope ended with {process.returncode}")
    return seen


def main():
    options = argparse.ArgumentParser(description=__doc__,
                                      formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("program")
    options.add_argument("--features", type=int, default=1000)
    options.add_argument("--minutes", type=float, default=10.0, help="of the run and of the film")
    options.add_argument("--fps", type=float, default=5.0)
    options.add_argument("--allowed", type=float, default=0.25)
    asked = options.parse_args()
    frames = round(60.0 * asked.minutes * asked.fps)
    view = [asked.program, "monitor", "--world", "uniform", "--features", asked.features, "--loops",
            1000, "--size", "640x360", "--fps", asked.fps, "--no-labels"]
    with tempfile.TemporaryDirectory(prefix="slamscope-") as folder:
        # A report holds every frame until the end, so that the long run does without.
        seen = watch([*view, "--frames", frames, "--picture", f"{folder}/last.png"])
        report = pathlib.Path(folder) / "report.json"
        watch([*view, "--frames", 60, "--report", report])
        device = json.loads(report.read_text())["summary"]["memory"]["device_bytes"]
    quarter = len(seen) // 4
    early, late = statistics.median(seen[quarter:2 * quarter]), statistics.median(seen[3 * quarter:])
    covariance = 8 * (2 * asked.features) ** 2
    grown = (late - early) / covariance
    print(f"{asked.features} features, {frames} frames in {len(seen)} s: covariance "
          f"{covariance / 1e6:.1f} MB, device {device / 1e6:.1f} MB; process "
          f"{early / 1e6:.1f} MB in the second quarter, {late / 1e6:.1f} MB in the last: "
          f"{100.0 * grown:+.1f} % of the covariance")
    return 1 if grown > asked.allowed else 0


if __name__ == "__main__":
    sys.exit(main())
