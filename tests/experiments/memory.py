#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Whether a long view of a large map needs more and more memory.

memory.py SLAMSCOPE [--features N] [--minutes M] [--fps F] [--allowed SHARE]
memory.py --self-test

Runs `slamscope monitor` over a simulated map, looks at the process's memory every second or so, and
compares the third quarter of the time with the last: until then the map grows, and the heap warms.
Exit status 1 where the last needs more by over SHARE of the covariance's bytes (2 N x 2 N doubles).
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


def watch(command, seconds=1.0):
    """The process's memory, every so many seconds until it ends."""
    seen = []
    process = subprocess.Popen([str(word) for word in command],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while process.poll() is None:
        if (now := resident_bytes(process)) is not None:
            seen.append(now)
        time.sleep(seconds)
    if process.returncode != 0:
        sys.exit(f"slamscope ended with {process.returncode}")
    return seen


def quarters(seen):
    """Medians of the third quarter and of the last."""
    if len(seen) < 8:
        sys.exit("too short a run to say anything")
    quarter = len(seen) // 4
    return statistics.median(seen[2 * quarter:3 * quarter]), statistics.median(seen[-quarter:])


def measure(asked):
    frames = round(60.0 * asked.minutes * asked.fps)
    view = [asked.program, "monitor", "--world", "uniform", "--features", asked.features, "--loops",
            1000, "--size", "640x360", "--fps", asked.fps, "--no-labels"]
    with tempfile.TemporaryDirectory(prefix="slamscope-") as folder:
        # A report holds every frame until the end, so that the long run does without.
        seen = watch([*view, "--frames", frames, "--picture", f"{folder}/last.png"],
                     seconds=min(1.0, 0.2 * asked.minutes))
        report = pathlib.Path(folder) / "report.json"
        watch([*view, "--frames", min(frames, 60), "--report", report])
        device = json.loads(report.read_text())["summary"]["memory"]["device_bytes"]
    early, late = quarters(seen)
    covariance = 8 * (2 * asked.features) ** 2
    grown = (late - early) / covariance
    print(f"{asked.features} features, {frames} frames: covariance {covariance / 1e6:.1f} MB, "
          f"device {device / 1e6:.1f} MB; process {early / 1e6:.1f} MB in the third quarter, "
          f"{late / 1e6:.1f} MB in the last: {100.0 * grown:+.1f} % of the covariance")
    return 1 if grown > asked.allowed else 0


def self_test():
    early, late = quarters([100, 200, 200, 199, 200, 201, 200, 200])
    assert abs(late - early) < 1.0, "a steady process is taken for one that grows"
    early, late = quarters([100, 200, 220, 240, 260, 280, 300, 320])
    assert late - early > 30.0, "a process that grows is not seen"


def main():
    options = argparse.ArgumentParser(description=__doc__,
                                      formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("program", nargs="?")
    options.add_argument("--features", type=int, default=1000)
    options.add_argument("--minutes", type=float, default=10.0, help="of the run and of the film")
    options.add_argument("--fps", type=float, default=5.0)
    options.add_argument("--allowed", type=float, default=0.25)
    options.add_argument("--self-test", action="store_true")
    asked = options.parse_args()
    if asked.self_test:
        return self_test()
    if asked.program is None:
        options.error("which slamscope?")
    return measure(asked)


if __name__ == "__main__":
    sys.exit(main())
