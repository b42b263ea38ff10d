# SPDX-License-Identifier: MIT
"""simulate, slam, info, convert: what works without camera and device."""
import os
import pathlib
import unittest

import program

RECORD = ('{"time_s": %s, "pose": [0, 0, 0], "ids": [4], "features": [[1.0, 0.2]], '
          '"covariance": [1,0,1,0,0,1,0,0,0,1,0,0,0,0,1]}\n')
HEADER = '{"format": "slamscope", "version": 1, "sensor": "range-bearing"}\n'


class Help(program.InAFolder):
    def test_each_verb_has_an_example(self):
        for verb in ("simulate", "slam", "info", "convert"):
            status, text, _ = self.run_here(verb, "--help")
            self.assertEqual(status, 0)
            self.assertIn("Example", text)

    def test_an_unknown_verb_gets_the_nearest(self):
        self.refused("simulte", saying="did you mean simulate?")

    def test_an_unknown_option_gets_the_nearest(self):
        self.refused("simulate", "--wrold", "uniform", saying="did you mean --world?")

    def test_nothing_asked_is_said(self):
        self.refused(saying="subcommand")

    def test_an_unknown_fault_lists_the_known(self):
        self.refused("simulate", "--fault", "papre", saying="paper")


class Runs(program.InAFolder):
    def test_simulate_convert_info_agree(self):
        self.assertEqual(self.run_here("simulate", "--loops", 1, "-o", "a.jsonl")[0], 0)
        self.assertEqual(self.run_here("convert", "a.jsonl", "b.jsonl.zst")[0], 0)
        self.assertEqual(self.run_here("convert", "b.jsonl.zst", "c.jsonl")[0], 0)
        self.assertEqual((self.folder / "a.jsonl").read_text(), (self.folder / "c.jsonl").read_text())
        status, text, _ = self.run_here("info", "b.jsonl.zst", "--json")
        self.assertEqual(status, 0)
        info = program.json.loads(text)
        self.assertEqual(info["features_at_end"], 15)
        self.assertTrue(info["truth"])

    def test_the_same_seed_gives_the_same_run(self):
        for name in ("a", "b"):
            self.run_here("simulate", "--seed", 7, "--loops", 1, "-o", name + ".jsonl")
        self.run_here("simulate", "--seed", 8, "--loops", 1, "-o", "c.jsonl")
        a, b, c = ((self.folder / (n + ".jsonl")).read_text() for n in "abc")
        self.assertEqual(a, b)
        self.assertNotEqual(a, c)

    def test_a_missing_file(self):
        self.refused("info", "none.jsonl", saying="none.jsonl")

    def test_an_ending_that_is_not_supported(self):
        self.write("run.bag", "x")
        self.refused("info", "run.bag", saying=["run.bag", ".jsonl"])

    def test_an_empty_file(self):
        self.write("run.jsonl", "")
        self.refused("info", "run.jsonl", saying="run.jsonl")

    def test_text_for_a_number(self):
        self.write("run.jsonl", HEADER + (RECORD % '"noon"'))
        self.refused("info", "run.jsonl", saying=["run.jsonl:2", "time_s"])

    def test_time_that_goes_back(self):
        self.write("run.jsonl", HEADER + RECORD % 2.0 + RECORD % 1.0)
        self.refused("info", "run.jsonl", saying=["run.jsonl:3", "time"])

    def test_a_cut_last_line_is_used_up_to_there(self):
        self.write("run.jsonl", HEADER + RECORD % 1.0 + (RECORD % 2.0)[:40])
        status, text, errors = self.run_here("info", "run.jsonl", "--json")
        self.assertEqual(status, 0, errors)
        self.assertEqual(program.json.loads(text)["records"], 1)
        self.assertIn("warning", errors)

    def test_nothing_half_written_is_left(self):
        self.write("run.jsonl", HEADER + RECORD % 2.0 + RECORD % 1.0)
        self.refused("convert", "run.jsonl", "out.jsonl", saying="run.jsonl:3")
        self.assertEqual([f.name for f in self.folder.iterdir()], ["run.jsonl"])


class MonteCarlo(program.InAFolder):
    def run_many(self, *words):
        status, text, errors = self.run_here("simulate", "--loops", 1, *words)
        self.assertEqual(status, 0, errors)
        return text

    def test_a_correct_filter_is_consistent_and_writes_no_run(self):
        text = self.run_many("--runs", 30, "--json", "mc.json")
        self.assertEqual(text.count("consistent"), 3, text)
        self.assertEqual([f.name for f in self.folder.iterdir()], ["mc.json"])
        result = self.load("mc.json")
        self.assertEqual((result["runs"], result["first_seed"], result["last_seed"]), (30, 1, 30))
        for what in ("anees_pose", "anees_features", "nis"):
            one = result[what]
            self.assertTrue(one["low"] < one["mean"] < one["high"], one)
            self.assertEqual(len(result["steps"][0]), 4)
        self.assertTrue(all(a["time_s"] < b["time_s"]
                            for a, b in zip(result["steps"], result["steps"][1:])))

    def test_a_noise_nine_times_too_large_is_not(self):
        text = self.run_many("--runs", 10, "--fault", "noise-9x", "--json", "mc.json")
        self.assertIn("underconfident", text)
        nis = self.load("mc.json")["nis"]
        self.assertFalse(nis["inside"])
        self.assertLess(nis["mean"], 0.5)

    def test_the_same_seeds_give_the_same_numbers(self):
        first = self.run_many("--runs", 8, "--seed", 5)
        self.assertEqual(first, self.run_many("--runs", 8, "--seed", 5))
        self.assertNotEqual(first, self.run_many("--runs", 8, "--seed", 6))

    def test_a_run_to_write_is_refused(self):
        self.refused("simulate", "--runs", 3, "-o", "run.jsonl", saying=["--output", "--seed"])
        self.refused("simulate", "--runs", 3, "--record", "all", saying="--record")
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_its_words_need_it(self):
        self.refused("simulate", "--json", "mc.json", saying="--runs")
        self.refused("simulate", "--confidence", 0.9, saying="--runs")

    def test_no_runs_and_a_file_that_cannot_be_written(self):
        self.refused("simulate", "--runs", 0, saying="--runs")
        self.refused("simulate", "--runs", "many", saying="--runs")
        self.refused("simulate", "--runs", 3, "--json", "none/mc.json", saying="none/mc.json")


class Csv(program.InAFolder):
    def data(self, odometry="0,1,0\n1,1,0\n2,1,0\n"):
        self.write("d/odometry.csv", "time_s,forward_mps,turn_radps\n" + odometry)
        self.write("d/range_bearing.csv",
                   "time_s,id,range_m,bearing_rad\n0.5,7,2.0,0.3\n1.5,7,1.2,0.5\n1.5,9,3.0,-0.2\n")

    def test_anybodys_data(self):
        self.data()
        status, _, errors = self.run_here("slam", "--csv", "d", "--score-json", "s.json", "-o", "r.jsonl")
        self.assertEqual(status, 0, errors)
        self.assertEqual(self.load("s.json")["features_found"], 2)

    def test_sightings_without_ids_are_associated(self):
        self.data()
        self.write("d/range_bearing.csv",
                   "time_s,range_m,bearing_rad\n0.5,2.0,0.3\n1.0,1.5,0.4\n1.5,1.05,0.58\n1.5,3.0,-0.2\n")
        for association in ([], ["--association", "nearest"]):
            status, _, errors = self.run_here("slam", "--csv", "d", "--score-json", "s.json", *association)
            self.assertEqual(status, 0, errors)
            self.assertEqual(self.load("s.json")["features"], 2)
        self.refused("slam", "--csv", "d", "--association", "known", saying=["nearest or joint"])

    def test_hypotheses_hide_ids_and_say_what_they_go_with(self):
        self.data()
        status, _, errors = self.run_here("slam", "--csv", "d", "--hypotheses", 5, "--confirm", 1,
                                          "--score-json", "s.json")
        self.assertEqual(status, 0, errors)
        self.assertEqual(self.load("s.json")["born"], 2)
        self.refused("slam", "--csv", "d", "--hypotheses", 5, "--association", "nearest",
                     saying=["hypotheses", "joint"])
        self.refused("slam", "--laser-lab", 1, "--hypotheses", 5, saying=["range and bearing"])
        self.refused("slam", "--csv", "d", "--hypotheses", -1, saying=["--hypotheses"])

    def test_a_car_with_a_laser(self):
        self.write("d/odometry.csv", "time_s,speed_mps,steering_rad\n0,1,0\n1,1,0\n2,1,0\n")
        far = ",".join(["9"] * 50)
        self.write("d/scans.csv", "time_s,angle_min_rad,angle_step_rad\n"
                   f"0.5,-0.5,0.01,{far},3,3,3,{far}\n1.0,-0.5,0.01,{far},2.5,2.5,2.5,{far}\n")
        self.refused("slam", "--csv", "d", saying=["wheelbase"])
        status, _, errors = self.run_here("slam", "--csv", "d", "--vehicle", "ackermann", "--wheelbase", "2",
                                          "--confirm", "2", "--score-json", "s.json", "-o", "r.jsonl")
        self.assertEqual(status, 0, errors)
        self.assertEqual(self.load("s.json")["confirmed"], 1)
        self.assertIn('"tentative": [1]', (self.folder / "r.jsonl").read_text())

    def test_the_laser_lab_is_mapped_and_audited(self):
        status, _, errors = self.run_here("slam", "--laser-lab", 1, "--record", "all", "--score-json", "s.json",
                                          "-o", "r.jsonl")
        self.assertEqual(status, 0, errors)
        self.assertEqual(self.load("s.json")["features"], 5)
        self.assertEqual(self.run_here("audit", "r.jsonl", "--fail-on", "code")[0], 0)
        self.refused("slam", "--laser-lab", 1, "--csv", "d", saying="one of")

    def test_time_that_goes_back_names_file_and_line(self):
        self.data(odometry="0,1,0\n2,1,0\n1,1,0\n")
        self.refused("slam", "--csv", "d", saying=["odometry.csv:4"])

    def test_text_for_a_number_names_the_column(self):
        self.data(odometry="0,fast,0\n")
        self.refused("slam", "--csv", "d", saying=["odometry.csv:2", "forward_mps"])

    def test_a_missing_directory(self):
        self.refused("slam", "--csv", "none", saying="none")

    def test_nothing_to_read(self):
        self.refused("slam", saying="--csv")


class Mrclam(program.InAFolder):
    """Recorded real data: the five robots of data set 6."""

    def setUp(self):
        super().setUp()
        source = program.HERE.parent.parent
        data = pathlib.Path(os.environ.get("SLAMSCOPE_DATA", source.parent / "shared" / "data"))
        self.mrclam = data / "mrclam"
        if not self.mrclam.is_dir():
            self.skipTest(f"recorded data is absent: {self.mrclam}")

    def test_every_robot_maps_its_fifteen_landmarks(self):
        for robot in range(1, 6):
            status, _, errors = self.run_here("slam", "--mrclam", self.mrclam, "--robot", robot,
                                              "--score-json", "s.json")
            self.assertEqual(status, 0, errors)
            score = self.load("s.json")
            self.assertEqual(score["features_found"], 15)
            self.assertLessEqual(score["features_rms_aligned_m"], 0.15)
            self.assertLessEqual(score["path_rms_aligned_m"], 0.5)

    def test_hypotheses_find_each_landmark_once_without_ids(self):
        status, _, errors = self.run_here("slam", "--mrclam", self.mrclam, "--robot", 4,
                                          "--hypotheses", 50, "--score-json", "s.json")
        self.assertEqual(status, 0, errors)
        score = self.load("s.json")
        self.assertEqual((score["features"], score["features_found"], score["duplicates"]), (15, 15, 0))

    def test_the_audit_finds_no_code_fault_and_says_that_the_noise_is_assumed_too_large(self):
        for robot in range(1, 6):
            status, _, errors = self.run_here("slam", "--mrclam", self.mrclam, "--robot", robot,
                                              "--record", "all", "-o", "run.jsonl.zst")
            self.assertEqual(status, 0, errors)
            status, text, errors = self.run_here("audit", "run.jsonl.zst", "--fail-on", "code",
                                                 "--json", "audit.json")
            self.assertEqual(status, 0, errors + text)
            audit = self.load("audit.json")
            self.assertFalse(audit["classes"]["code_fault"], text)
            laws = {law["law"]: law for law in audit["laws"]}
            for exact in ("positive", "shrink", "support", "range", "map-still", "motion",
                          "initialise"):
                self.assertEqual(laws[exact]["status"], "ok", f"robot {robot}: {exact}")
                self.assertGreater(laws[exact]["checked"], 10)
            # The defaults are careful: real innovations are well inside of what is declared.
            self.assertEqual(laws["nis"]["status"], "violated")
            self.assertLess(laws["nis"]["evidence"][0]["given"], 0.5)


if __name__ == "__main__":
    program.main()
