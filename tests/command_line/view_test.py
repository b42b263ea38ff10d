# SPDX-License-Identifier: MIT
"""monitor and demo: pictures without a display."""
import json
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import sys
import time
import unittest

import program

EKF = program.HERE.parent / "python" / "ekf.py"
NO_DISPLAY = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
# One grey picture, 8 x 8, as a PGM.
PGM = "P2 8 8 255\n" + "128 " * 64


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Drawing(program.InAFolder):
    def await_picture(self, name, seconds=120.0):
        ends = time.monotonic() + seconds
        while not (self.folder / name).exists():
            self.assertLess(time.monotonic(), ends, f"{name} is never drawn")
            time.sleep(0.1)


class BadInput(program.InAFolder):
    def test_a_verb_within_a_verb_names_itself(self):
        self.refused("calibrate", "tgas", saying=["did you mean tags?", "slamscope calibrate --help"])
        self.refused("calibrate", "tags", "--siez", 3,
                     saying=["did you mean --size?", "slamscope calibrate tags --help"])

    def test_a_missing_camera(self):
        self.refused("monitor", "--camera", "none.mp4", "--picture", "p.png", saying="none.mp4")

    def test_an_empty_directory(self):
        (self.folder / "frames").mkdir()
        self.refused("monitor", "--camera", "frames", "--picture", "p.png", saying="frames")

    def test_camera_info_of_another_size(self):
        self.write("frames/a.pgm", PGM)
        self.write("K.yaml", "image_width: 640\nimage_height: 480\ncamera_name: c\n"
                   "camera_matrix: {rows: 3, cols: 3, data: [600, 0, 320, 0, 600, 240, 0, 0, 1]}\n"
                   "distortion_model: plumb_bob\n"
                   "distortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}\n")
        self.refused("monitor", "--camera", "frames", "--camera-info", "K.yaml", "--picture", "p.png",
                     saying=["640 x 480", "8 x 8"])

    def test_a_finite_input_that_never_shows_a_tag(self):
        for k in range(3):
            self.write(f"frames/{k}.pgm", PGM)
        self.refused("monitor", "--camera", "frames", "--output", "out.mp4", saying="never registered")
        self.assertFalse((self.folder / "out.mp4").exists())

    def test_no_vulkan_device(self):
        # Needs the loader of Debian 12, which reads this variable.
        self.refused("monitor", "--picture", "p.png", "--frames", 1, saying="Vulkan",
                     env={**NO_DISPLAY, "VK_ICD_FILENAMES": "/nonexistent.json",
                          "VK_DRIVER_FILES": "/nonexistent.json"})

    def test_a_device_that_is_not_there(self):
        self.refused("monitor", "--picture", "p.png", "--device", "Voodoo 3", saying="Voodoo 3")

    def test_sizes_that_are_none(self):
        for flag in ("--size", "--capture-size"):
            for text in ("640", "640x", "x480", "640x480a", "9x480", "640x100000"):
                self.refused("monitor", flag, text, "--picture", "p.png", saying=[flag, "1280x720", text])

    def test_output_without_a_number(self):
        for name in ("p.png", "p-%s.png", "p-%d-%d.png", "p-%d.jpg"):
            self.refused("monitor", "--frames", 1, "--output", name, saying=[name, "NAME-%05d.png"])

    def test_a_window_without_a_display(self):
        self.refused("monitor", saying="display", env=NO_DISPLAY)

    def test_alarms_without_an_audit(self):
        self.refused("monitor", "--mode", "alarms", "--no-audit", "--picture", "p.png",
                     saying=["--mode alarms", "--no-audit"])

    def test_an_unknown_word_of_allow_lists_the_known(self):
        self.refused("monitor", "--allow", "magic", "--picture", "p.png",
                     saying=["magic", "robocentric"])

    def test_an_output_of_unknown_ending(self):
        self.refused("monitor", "--output", "out.gif", saying="out.gif")

    def test_an_output_in_a_missing_folder(self):
        self.refused("monitor", "--picture", "none/p.png", "--frames", 2, saying="none")


class LiveFilter(Drawing):
    """A filter that nobody here wrote for: 40 lines of plain Python."""

    def monitor(self, *words):
        return subprocess.Popen([program.PROGRAM, "monitor", *map(str, words)], cwd=self.folder,
                                stdin=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                env=NO_DISPLAY)

    def filter(self, *words, **more):
        return subprocess.Popen([sys.executable, str(EKF), *map(str, words)], **more)

    def shown(self, report):
        return [f for f in self.load(report)["frames"] if f["drawn"]["features"] > 0]

    def test_standard_input(self):
        feeder = self.filter("--rate", 30, "--steps", 300, stdout=subprocess.PIPE)
        done = subprocess.run([program.PROGRAM, "monitor", "--slam", "-", "--report", "r.json"],
                              stdin=feeder.stdout, cwd=self.folder, capture_output=True, text=True,
                              timeout=120, env=NO_DISPLAY)
        feeder.wait()
        self.assertEqual(done.returncode, 0, done.stderr)
        shown = self.shown("r.json")
        self.assertGreater(len(shown), 10)
        # The audit listens to a live filter too, and this one is correct.
        self.assertGreater(shown[-1]["alarms"]["records"], 100)
        self.assertEqual([f["alarms"]["flagged"] for f in shown if f["alarms"]["flagged"]], [])

    def test_tcp_filter_killed_and_restarted_and_a_viewer_that_joins_late(self):
        port = free_port()
        viewer = self.monitor("--slam", f"tcp://127.0.0.1:{port}", "--report", "r.json",
                              "--output", "live-%05d.png", "--size", "320x180", "--frames", 400)
        feeder = None
        for run, picture in enumerate(["live-00250.png", "live-00399.png"]):
            # The filter runs before the viewer listens: it tries until somebody does.
            feeder = self.filter("--rate", 30, "--steps", 100000, "--tcp", f"127.0.0.1:{port}")
            self.await_picture(picture)
            if run == 0:
                feeder.kill()
                feeder.wait()
        _, errors = viewer.communicate(timeout=120)
        feeder.kill()
        feeder.wait()
        self.assertEqual(viewer.returncode, 0, errors)
        times = [f["snapshot_time_s"] for f in self.shown("r.json")]
        self.assertGreater(len(times), 60)
        # The second run of the filter starts its clock again.
        self.assertTrue(any(after < before - 1.0 for before, after in zip(times, times[1:])), times[::20])


class Films(program.InAFolder):
    def test_a_recorded_run_of_whole_steps_shows_its_alarms(self):
        self.run_here("simulate", "--fault", "paper", "--fault-features", 8, "--loops", 1,
                      "-o", "run.jsonl")
        status, _, errors = self.run_here("monitor", "--slam", "run.jsonl", "--mode", "alarms",
                                          "--slam-rate", 8, "--report", "r.json")
        self.assertEqual(status, 0, errors)
        last = self.load("r.json")["frames"][-1]
        self.assertEqual(last["alarms"]["flagged"], [8])
        self.assertEqual(last["drawn"], {"ellipsoids": 14, "features": 1})

    def test_without_an_audit_nothing_is_flagged(self):
        self.run_here("monitor", "--fault", "paper", "--no-audit", "--frames", 60,
                      "--slam-rate", 4, "--report", "r.json")
        last = self.load("r.json")["frames"][-1]
        self.assertIsNone(last["alarms"])
        self.assertGreater(last["drawn"]["ellipsoids"], 0)

    def test_the_laser_lab_shows_a_spurious_feature_for_a_while(self):
        drawn = {}
        for until, rate in ((2.4, 2), (9, 8), (16, 8)):  # the first 30 frames are for registration
            status, _, errors = self.run_here("monitor", "--slam", "laser-lab", "--loops", 2, "--slam-rate", rate,
                                              "--until", until, "--report", "r.json")
            self.assertEqual(status, 0, errors)
            last = self.load("r.json")["frames"][-1]
            self.assertEqual(last["alarms"]["flagged"], [])
            drawn[until] = last["drawn"]["features"]
        self.assertEqual(drawn, {2.4: 3, 9: 6, 16: 5})

    def test_a_picture_of_the_end_alone_is_made_without_what_lies_between(self):
        status, _, errors = self.run_here("monitor", "--slam", "laser-lab", "--picture", "p.png")
        self.assertEqual(status, 0, errors)
        self.assertIn(" 32 frames", errors)

    def test_numbered_pictures_and_a_picture_of_the_last(self):
        status, _, errors = self.run_here("monitor", "--frames", 4, "--output", "o-%03d.png",
                                          "--picture", "last.png", "--size", "640x360")
        self.assertEqual(status, 0, errors)
        names = sorted(f.name for f in self.folder.iterdir())
        self.assertEqual(names, ["last.png", "o-000.png", "o-001.png", "o-002.png", "o-003.png"])

    def test_a_video_is_whole_or_not_there(self):
        status, _, errors = self.run_here("monitor", "--frames", 6, "--output", "o.mp4")
        self.assertEqual(status, 0, errors)
        self.assertGreater((self.folder / "o.mp4").stat().st_size, 1000)
        self.assertEqual([f.name for f in self.folder.iterdir()], ["o.mp4"])


@unittest.skipUnless(shutil.which("Xvfb"), "needs Xvfb")
class Window(Drawing):
    """On a display of its own, without a screen."""

    def setUp(self):
        super().setUp()
        ours, theirs = os.pipe()
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(theirs), "-screen", "0", "1280x800x24"],
                                       pass_fds=[theirs], stderr=subprocess.DEVNULL)
        os.close(theirs)
        with os.fdopen(ours) as number:
            self.display = {**NO_DISPLAY, "DISPLAY": ":" + number.readline().strip()}

    def tearDown(self):
        self.server.terminate()
        self.server.wait()
        super().tearDown()

    def test_an_interrupt_closes_it_and_leaves_whole_outputs(self):
        for verb in ("monitor", "hmd"):
            with self.subTest(verb):
                run = subprocess.Popen([program.PROGRAM, verb, "--window", "--report", verb + ".json",
                                        "--output", verb + "-%d.png"],
                                       cwd=self.folder, env=self.display, stderr=subprocess.PIPE, text=True)
                self.await_picture(verb + "-3.png")
                self.assertIsNone(run.poll(), "ended by itself")
                run.send_signal(signal.SIGINT)
                _, said = run.communicate(timeout=60)
                self.assertEqual(run.returncode, 0, said)
                report = json.loads((self.folder / (verb + ".json")).read_text())
                self.assertGreater(len(report["frames"]), 3)


class Hmd(program.InAFolder):
    """Two eyes on a head that walks around the lab's robot."""

    def test_two_seconds_of_the_walk_stand_where_they_belong(self):
        status, _, errors = self.run_here("hmd", "--fps", 10, "--frames", 20, "--slam-rate", 4, "--output", "o.mp4",
                                          "--picture", "p.png", "--report", "r.json",
                                          "--latency", "l.csv", "--validation", env=NO_DISPLAY)
        self.assertEqual(status, 0, errors)
        report = self.load("r.json")
        frames = report["frames"]
        self.assertEqual(len(frames), 20)
        self.assertEqual({f["head"]["state"] for f in frames}, {"tracking"})
        self.assertGreaterEqual(min(f["head"]["tags_used"] for f in frames), 3)
        self.assertLess(max(f["head"]["residual_px"] for f in frames), 0.3)
        shown = [f for f in frames if f["drawn"]["features"] > 0]
        self.assertGreaterEqual(len(shown), 10)
        self.assertGreater(shown[-1]["drawn"]["ellipsoids"], 0)
        self.assertLess(shown[-1]["robot"]["position_error_m"], 0.001)
        for eye in ("left", "right"):
            self.assertLess(max(f[eye]["position_error_m"] for f in frames[3:]), 0.005)
            self.assertLess(max(f[eye]["rotation_error_deg"] for f in frames[3:]), 0.05)
            self.assertLess(max(f[eye]["overlay_error_px"] for f in shown
                                if f[eye]["overlay_error_px"] is not None), 1.0)
        self.assertLess(report["summary"]["overlay_error_px"]["p95"], 0.5)
        # Two eyes: the same feature stands further left in the right one.
        left, right = ({tip[0]: tip for tip in shown[-1][eye]["tips_px"]} for eye in ("left", "right"))
        both = left.keys() & right.keys()
        self.assertTrue(both)
        self.assertTrue(all(left[k][1] > right[k][1] + 3 for k in both), (left, right))
        stamps = [line.split(",") for line in (self.folder / "l.csv").read_text().splitlines()]
        self.assertEqual(stamps[0], ["frame", "mid_exposure_s", "dequeue_s", "pose_s", "present_s"])
        self.assertEqual(len(stamps), 21)
        for row in stamps[1:]:
            self.assertLess(float(row[2]), float(row[3]))
            self.assertLess(float(row[3]), float(row[4]))

    def test_a_rig_that_is_wrong_is_named(self):
        camera = ("{{image_width: 640, image_height: 480, camera_name: c, camera_matrix: {{rows: 3, cols: 3, "
                  "data: [{f}, 0, 320, 0, {f}, 240, 0, 0, 1]}}, distortion_model: plumb_bob, "
                  "distortion_coefficients: {{rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}}}}").format(f=500)
        self.write("rig.yaml", "T_right_left: {position_m: [-0.064, 0, 0]}\n"
                   f"left: {{camera_info: {camera}}}\nright: {{camera_info: {camera}}}\n")
        # The twin of the walk: a head that is known so badly registers no robot.
        status, _, errors = self.run_here("hmd", "--fps", 8, "--frames", 20, "--rig", "rig.yaml",
                                          "--report", "r.json")
        self.assertEqual(status, 2, errors)
        self.assertIn("never found", errors)
        self.assertGreater(float(re.search(r"residual ([0-9.]+) px", errors)[1]), 1.0)
        self.assertRegex(errors, "(focal length|principal point|corners in the picture) of the left camera")
        self.assertTrue(any("of the left camera" in p for p in self.load("r.json")["frames"][-1]["problems"]))

    def test_layouts_have_their_sizes(self):
        from_png = lambda data: tuple(int.from_bytes(data[at:at + 4], "big") for at in (16, 20))
        for layout, size in (("half-side-by-side", (320, 240)), ("top-bottom", (320, 480)),
                             ("anaglyph", (320, 240))):
            status, _, errors = self.run_here("hmd", "--frames", 2, "--layout", layout, "--size",
                                              "320x240", "--picture", "p.png", "--swap-eyes")
            self.assertEqual(status, 0, errors)
            self.assertEqual(from_png((self.folder / "p.png").read_bytes()), size)

    def test_pictures_without_a_tag(self):
        for k in range(3):
            self.write(f"frames/{k}.pgm", PGM)
        status, _, errors = self.run_here("hmd", "--cameras", "frames", "--output", "out.mp4")
        self.assertEqual(status, 2)
        self.assertIn("never found", errors)
        self.assertIn("one camera", errors)
        self.assertIn("uncalibrated", errors)

    def test_a_window_without_a_display(self):
        self.refused("hmd", saying="display", env=NO_DISPLAY)
        self.refused("hmd", "--display", "1", saying="display", env=NO_DISPLAY)
        self.refused("displays", saying="display", env=NO_DISPLAY)

    def test_an_unknown_layout(self):
        self.refused("hmd", "--layout", "cross-eyed", "--picture", "p.png", saying="cross-eyed")


if __name__ == "__main__":
    program.main()
