# SPDX-License-Identifier: MIT
"""The files people have: NumPy's arrays and MRPT's directory, and what can't be read."""
import json
import shutil
import struct
import subprocess

import program
from arrays import NAN, npy, npy_pickled, npy_words, npz

HEADER = '{"format": "slamscope", "version": 1, "sensor": "range-bearing"}\n'
RECORD = ('{"time_s": %s, "pose": [0, 0, 0], "ids": [4], "features": [[1.0, 0.2]], '
          '"covariance": [1,0,1,0,0,1,0,0,0,1,0,0,0,0,1]}\n')


def growing(steps=4, width=7):
    """x and P of a map that gets a feature in step 1 and one in step 2, padded with NaN. P is not
    quite symmetric."""
    xs, Ps = [], []
    for k in range(steps):
        n = 3 + 2 * min(k, 2)
        xs.append([k + 0.25 * i if i < n else NAN for i in range(width)])
        Ps.append([[NAN] * width for _ in range(width)])
        for i in range(n):
            for j in range(n):
                Ps[-1][i][j] = 0.01 if i == j else 0.0
        Ps[-1][2][0], Ps[-1][0][2] = 0.001, 0.002
    return xs, Ps


class InFiles(program.InAFolder):
    def store(self, name, data):
        (self.folder / name).write_bytes(data)

    def records(self, name):
        """The run as JSON, by way of convert, and what was warned of."""
        status, _, errors = self.run_here("convert", name, "out.jsonl")
        self.assertEqual(status, 0, errors)
        lines = (self.folder / "out.jsonl").read_text().splitlines()
        return [json.loads(line) for line in lines[1:]], errors

    def level(self, name):
        status, text, errors = self.run_here("info", name, "--json")
        self.assertEqual(status, 0, errors)
        return json.loads(text)["level"]


class Numpy(InFiles):
    def growing_is_read(self, name):
        records, warned = self.records(name)
        self.assertEqual([record["ids"] for record in records], [[], [1], [1, 2], [1, 2]])
        for k, record in enumerate(records):
            self.assertEqual(record["pose"], [k, k + 0.25, k + 0.5])
            self.assertEqual(len(record["covariance"]), [6, 15, 28, 28][k])
            self.assertEqual(record["covariance"][3], 0.001)  # (2, 0): the lower triangle
            self.assertEqual(record["asymmetry"], 0.001)
        self.assertEqual(records[3]["features"], [[3.75, 4.0], [4.25, 4.5]])
        return records, warned

    def test_stacks_stored_deflated_and_in_any_order_are_the_same_run(self):
        xs, Ps = growing()
        turned_x = [list(row) for row in zip(*xs)]
        last_P = [[[P[i][j] for P in Ps] for j in range(7)] for i in range(7)]
        for number, data in enumerate((
                npz(x=xs, P=Ps), npz(compressed=True, x=xs, P=Ps),
                npz(x=turned_x, P=last_P), npz(mu=xs, Sigma=Ps),
                npz(x=npy(xs, fortran_order=True), P=npy(Ps, fortran_order=True)),
                npz(x=npy(turned_x, fortran_order=True), P=npy(last_P, fortran_order=True)),
                npz(x=npy(xs, ">f8"), P=npy(Ps, ">f8")))):
            with self.subTest(number):
                self.store("run.npz", data)
                self.growing_is_read("run.npz")

    def test_what_is_assumed_is_said(self):
        xs, Ps = growing()
        self.store("run.npz", npz(x=xs, P=Ps))
        records, warned = self.growing_is_read("run.npz")
        self.assertEqual([record["time_s"] for record in records], [0, 1, 2, 3])
        self.assertIn("no times (t)", warned)
        self.assertIn("no ids", warned)

    def test_an_array_a_step_needs_no_padding(self):
        xs, Ps = growing(12)
        arrays = {}
        for k in range(12):
            n = 3 + 2 * min(k, 2)
            arrays[f"x_{k}"] = xs[k][:n]
            arrays[f"P_{k}"] = npy([row[:n] for row in Ps[k][:n]], fortran_order=k % 2 == 1)
        self.store("run.npz", npz(**arrays))
        records, _ = self.records("run.npz")
        self.assertEqual([record["pose"][0] for record in records], list(range(12)))
        self.assertEqual([record["covariance"][3] for record in records], [0.001] * 12)

    def test_what_stands_beside(self):
        xs, Ps = growing()
        ids = [[NAN, NAN], [42, NAN], [42, 7], [42, 7]]
        self.store("run.npz", npz(
            x=xs, P=Ps, t=[0.1, 0.1, 0.2, 0.3], ids=ids, observed=[[-1], [-1], [42], [7]],
            true=[[9, 8, 0.7]] * 4, event=npy_words(["predict", "initialise", "step", "update"])))
        records, warned = self.records("run.npz")
        self.assertEqual(records[2]["ids"], [42, 7])
        self.assertEqual([record["observed"] for record in records], [[], [], [42], [7]])
        self.assertEqual(records[1]["event"], "initialise")
        self.assertEqual(records[1]["stamp_ns"], 100000000)
        self.assertEqual(records[3]["truth"]["pose"], [9, 8, 0.7])
        self.assertNotIn("warning", warned)

    def test_ids_by_place_and_a_mask_of_what_was_observed(self):
        xs, Ps = growing()
        mask = npy([[False, False], [True, False], [False, True], [True, True]], "|b1")
        self.store("run.npz", npz(x=xs, P=Ps, ids=npy([42, 7], "<i8"), observed=mask))
        records, _ = self.records("run.npz")
        self.assertEqual([record["observed"] for record in records], [[], [42], [7], [42, 7]])

    def test_variances_are_level_l0_and_covariances_alone_lc(self):
        xs, Ps = growing()
        self.store("run.npz", npz(x=xs, P=[[P[i][i] for i in range(7)] for P in Ps]))
        self.assertEqual(self.level("run.npz"), "L0")
        self.store("run.npz", npz(P=Ps))
        self.assertEqual(self.level("run.npz"), "LC")
        self.refused("monitor", "--slam", "run.npz", "--picture", "p.png", saying="nothing to draw")

    def test_npy_stands_alone_or_beside_its_x(self):
        xs, Ps = growing()
        self.store("run_P.npy", npy(Ps))
        self.assertEqual(self.level("run_P.npy"), "LC")
        self.store("run_x.npy", npy(xs))
        self.assertEqual(self.level("run_P.npy"), "L1")
        self.growing_is_read("run_P.npy")

    def test_a_nan_in_the_map_is_a_finding(self):
        xs, Ps = growing()
        Ps[3][5][0] = NAN
        self.store("run.npz", npz(x=xs, P=Ps))
        status, text, _ = self.run_here("audit", "run.npz", "--json", "a.json")
        self.assertEqual(status, 1)
        laws = {law["law"]: law for law in self.load("a.json")["laws"]}
        self.assertEqual(laws["finite"]["first_record"], 3)
        self.assertEqual([blame["feature"] for blame in laws["finite"]["blame"]], [2])

    def test_a_filter_that_became_nan_is_a_finding(self):
        xs, Ps = growing()
        xs[3], Ps[3] = [NAN] * 7, [[NAN] * 7] * 7
        self.store("run.npz", npz(x=xs, P=Ps))
        self.assertEqual(self.run_here("audit", "run.npz")[0], 1)

    def test_audit_judges_it(self):
        self.run_here("simulate", "--loops", 1, "--features", 5, "--fault", "paper", "-o", "run.jsonl")
        xs, Ps = [], []
        for line in (self.folder / "run.jsonl").read_text().splitlines()[1:]:
            record = json.loads(line)
            xs.append(record["pose"] + [number for point in record["features"] for number in point])
            packed, n = record["covariance"], len(xs[-1])
            Ps.append([[packed[max(i, j) * (max(i, j) + 1) // 2 + min(i, j)] for j in range(n)]
                       for i in range(n)])
        width = max(map(len, xs))
        for x, P in zip(xs, Ps):
            for row in P:
                row += [NAN] * (width - len(row))
            P += [[NAN] * width] * (width - len(P))
            x += [NAN] * (width - len(x))
        self.store("run.npz", npz(x=xs, P=Ps))
        status, text, _ = self.run_here("audit", "run.npz", "--fail-on", "code")
        self.assertEqual(status, 1, text)
        self.assertIn("shrink", text)
        self.assertIn("record.predicted(x, P, t)", text)


class Unreadable(InFiles):
    """Exit 2 and one line, by each verb that reads runs."""

    def refused_by_all(self, name, saying):
        for verb in ("audit", "info"):
            self.refused(verb, name, saying=saying)

    def npz_refused(self, saying, **arrays):
        self.store("run.npz", npz(**arrays))
        self.refused_by_all("run.npz", ["run.npz"] + saying)

    def test_an_empty_file(self):
        for name in ("run.jsonl", "run.npz", "run.npy", "run.mat"):
            self.write(name, "")
            self.refused_by_all(name, saying=name)

    def test_a_header_alone_is_too_little_to_judge(self):
        self.write("run.jsonl", HEADER)
        self.assertEqual(self.run_here("audit", "run.jsonl")[0], 3)

    def test_wrong_sizes(self):
        self.write("run.jsonl", HEADER + RECORD.replace("0,0,0,0,1]", "0,0,0,1]") % 1)
        self.refused_by_all("run.jsonl", ["run.jsonl:2", "covariance", "5×5"])
        xs, Ps = growing()
        self.npz_refused(["x: expected 4×7", "4×5"], x=[x[:5] for x in xs], P=Ps)
        self.npz_refused(["P: expected steps × N × N", "4×7×5"], x=xs, P=[[r[:5] for r in P] for P in Ps])
        self.npz_refused(["t: expected 4", "3"], x=xs, P=Ps, t=[0, 1, 2])
        self.npz_refused(["N = 6"], x=[x[:6] for x in xs], P=[[r[:6] for r in P[:6]] for P in Ps])
        self.npz_refused(["record 2", "ids"], x=xs, P=Ps, ids=[[NAN], [4], [4], [4]])
        self.npz_refused(["ids", "each id once"], x=xs, P=Ps, ids=[3, 3])

    def test_features_that_change_place(self):
        self.write("run.jsonl", HEADER + RECORD % 1 + RECORD.replace("[4]", "[5]").replace(
            '"time_s"', '"event": "update", "time_s"') % 2)
        self.refused_by_all("run.jsonl", ["run.jsonl:3", "ids", "feature 5"])
        xs, Ps = growing()
        self.npz_refused(["record 3", "feature 4 in another place"], x=xs, P=Ps,
                         ids=[[NAN, NAN], [4, NAN], [4, 5], [5, 4]])

    def test_features_that_vanish_without_ids(self):
        xs, Ps = growing()
        self.npz_refused(["record 3", "save ids too"], x=xs[:3] + [xs[1]], P=Ps[:3] + [Ps[1]])

    def test_time_that_goes_back(self):
        self.write("run.jsonl", HEADER + RECORD % 2 + RECORD % 1)
        self.refused_by_all("run.jsonl", ["run.jsonl:3", "time"])
        xs, Ps = growing()
        self.npz_refused(["record 2", "time"], x=xs, P=Ps, t=[0, 1, 0.5, 2])
        self.npz_refused(["record 1", "t: expected a finite number"], x=xs, P=Ps, t=[0, NAN, 1, 2])

    def test_a_truncated_last_line_is_used_up_to_there(self):
        self.write("run.jsonl", HEADER + RECORD % 1 + (RECORD % 2)[:50])
        status, text, errors = self.run_here("audit", "run.jsonl", "--json", "a.json")
        self.assertIn(status, (0, 3))
        self.assertEqual(self.load("a.json")["records"], 1)
        self.assertIn("cut off", errors)

    def test_a_pickled_object_array(self):
        xs, _ = growing()
        way_out = ["pickled", "np.savez(..., x=..., P=...)", "pad with NaN"]
        self.npz_refused(["P: an object array"] + way_out, x=xs, P=npy_pickled())
        self.store("run.npy", npy_pickled())
        self.refused_by_all("run.npy", ["run.npy"] + way_out)

    def test_arrays_of_other_names_are_listed(self):
        xs, _ = growing()
        self.npz_refused(["expected arrays x and P, found a, z"], z=xs, a=xs)

    def test_other_types(self):
        xs, Ps = growing()
        for descr in ("<c16", "<M8[ns]", "<f2"):
            self.npz_refused(["P: ", descr], x=xs, P=npy(Ps).replace(b"<f8", descr.encode())
                             if len(descr) == 3 else npy(Ps).replace(
                                 b"'<f8'", f"'{descr}'".encode(), 1))
        self.npz_refused(["event: expected words"], x=xs, P=Ps, event=[1, 2, 3, 4])
        self.npz_refused(["event: expected one of", '"jump"'], x=xs, P=Ps,
                         event=npy_words(["predict", "jump", "step", "step"]))

    def test_cut_off_anywhere(self):
        xs, Ps = growing()
        for compressed in (False, True):
            whole = npz(compressed=compressed, x=xs, P=Ps)
            for size in range(4, len(whole) - 1, len(whole) // 7):
                self.store("run.npz", whole[:size])
                self.refused("info", "run.npz", saying=["run.npz", "cut off"])
        whole = npy(Ps)
        for size in (20, 100, 140, len(whole) - 1):
            self.store("run.npy", whole[:size])
            self.refused("info", "run.npy", saying=["run.npy", "cut off"])

    def test_damaged_data(self):
        xs, Ps = growing()
        for compressed in (False, True):
            whole = bytearray(npz(compressed=compressed, x=xs, P=Ps))
            at = whole.rfind(b"PK\x03\x04") + (700 if not compressed else 150)
            whole[at] ^= 0x55
            self.store("run.npz", bytes(whole))
            self.refused("info", "run.npz", saying=["run.npz", "P: ", "damaged"])

    def test_no_archive_and_no_array(self):
        self.write("run.npz", "x = 1\n" * 20)
        self.refused_by_all("run.npz", saying=["run.npz", "zip archive"])
        self.write("run.npy", "x = 1\n" * 20)
        self.refused_by_all("run.npy", saying=["run.npy", "NumPy"])

    def test_a_shape_that_lies(self):
        lie = npy(growing()[1]).replace(b"(4, 7, 7)", b"(9999999999, 7, 7)"[:9])
        self.store("run.npy", lie)
        self.refused_by_all("run.npy", saying="run.npy")
        self.store("run.npy", npy([[[1.0]]]).replace(b"(1, 1, 1), }        ", b"(999999999, 3, 3), }"))
        self.refused_by_all("run.npy", saying=["run.npy", "cut off"])

    def test_a_directory_without_a_run(self):
        (self.folder / "empty").mkdir()
        self.refused_by_all("empty", saying=["empty", "full_cov_"])

    def test_a_run_is_not_written_as_npz(self):
        self.write("run.jsonl", HEADER + RECORD % 1)
        self.refused("convert", "run.jsonl", "out.npz", saying=["out.npz", "written as"])


class Mrpt(InFiles):
    """A run of MRPT's kf-slam, made here by its own simulator."""

    SIMULATION = """[Params]
random_seed = 5
nSteps = 120
circularPath = 0
squarePathLength = 25
odometryNoiseXY_std = 0.04
minSensorDistance = 0
maxSensorDistance = 6
fieldOfView_deg = 180
stdRange = 0.03
stdYaw_deg = 1
stdPitch_deg = 0
outFile = run.rawlog
outDir = simulated
show_in_3d = false
[RANDOMSET_1]
nLandmarks = 30
min_x = -4
max_x = 12
min_y = -3
max_y = 12
min_z = 0
max_z = 0
"""
    FILTER = """[MappingApplication]
kf_implementation = %s
rawlog_file = simulated/run.rawlog
logOutput_dir = log
SAVE_LOG_FREQUENCY = %d
SAVE_3D_SCENES = false
SAVE_MAP_REPRESENTATIONS = true
SHOW_3D_LIVE = false
[RangeBearingKFSLAM_KalmanFilter]
method = 0
verbosity_level = WARN
[RangeBearingKFSLAM]
stdXY_no_odo = 0.1
stdPhi_no_odo_deg = 2
std_sensor_range = 0.03
std_sensor_yaw_deg = 1
std_sensor_pitch_deg = 1
"""

    def mrpt(self, implementation="CRangeBearingKFSLAM2D", frequency=1):
        for tool in ("simul-landmarks", "kf-slam"):
            if shutil.which(tool) is None:
                self.skipTest(f"{tool} (package mrpt-apps) is not installed")
        self.write("simulation.ini", self.SIMULATION)
        self.write("filter.ini", self.FILTER % (implementation, frequency))
        for words in (["simul-landmarks", "simulation.ini"], ["kf-slam", "filter.ini"]):
            done = subprocess.run(words, cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True,
                                  timeout=120, check=False)
            self.assertEqual(done.returncode, 0, done.stdout[-2000:])

    def test_no_code_fault_is_found(self):
        self.mrpt()
        status, text, errors = self.run_here("audit", "log", "--json", "a.json")
        self.assertEqual(status, 0, text + errors)
        report = self.load("a.json")
        self.assertEqual((report["verdict"], report["level"]), ("ok", "LC"))
        self.assertGreater(report["records"], 100)
        laws = {law["law"]: law for law in report["laws"]}
        for law in ("finite", "symmetric", "positive", "shrink"):
            self.assertEqual(laws[law]["status"], "ok")
        self.assertGreater(laws["shrink"]["checked"], 100)

    def test_a_fault_planted_in_its_log_is_found(self):
        self.mrpt()
        for file in sorted((self.folder / "log").glob("full_cov_*.txt"))[60:]:
            rows = [line.split() for line in file.read_text().splitlines()]
            for k in (5, 6):  # the second feature's variances
                rows[k][k] = repr(2 * float(rows[k][k]))
            file.write_text("\n".join(" ".join(row) for row in rows))
        status, text, _ = self.run_here("audit", "log", "--json", "a.json")
        self.assertEqual(status, 1, text)
        laws = {law["law"]: law for law in self.load("a.json")["laws"]}
        self.assertEqual(laws["shrink"]["first_record"], 60)
        self.assertEqual(laws["shrink"]["blame"][0]["feature"], 2)

    def test_logged_now_and_then_keeps_its_steps(self):
        self.mrpt(frequency=10)
        records, _ = self.records("log")
        self.assertEqual([record["time_s"] for record in records][:3], [0, 10, 20])

    def test_the_filter_in_3d_is_refused(self):
        self.mrpt(implementation="CRangeBearingKFSLAM")
        self.refused("audit", "log", saying=["robot_pose_00000.txt", "found 7"])

    def test_nothing_to_draw(self):
        self.write("log/full_cov_00000.txt", "1 0 0\n0 1 0\n0 0 1\n")
        self.refused("monitor", "--slam", "log", "--picture", "p.png", saying=["log", "nothing to draw"])

    def test_a_cut_file_is_named_with_its_line(self):
        self.write("log/full_cov_00000.txt", "1 0 0\n0 1 0\n0 0 1\n")
        self.write("log/full_cov_00001.txt", "1 0 0\n0 1\n")
        self.refused("info", "log", saying=["record 1", "full_cov_00001.txt:2", "expected 3 numbers"])
        self.write("log/full_cov_00001.txt", "1 0 0\n0 1 0\n")
        self.refused("info", "log", saying=["full_cov_00001.txt", "2 rows of 3"])
        self.write("log/full_cov_00001.txt", "1 0 0\n0 x 0\n0 0 1")
        self.refused("info", "log", saying=["full_cov_00001.txt:2", "expected a number", "x"])


if __name__ == "__main__":
    program.main()
