# SPDX-License-Identifier: MIT
"""Logs an EKF-SLAM filter for slamscope: one file, no dependency, three calls (level L2).

    from slamscope_log import Log
    record = Log("run.jsonl", sensor="range-bearing", R=[[0.01, 0], [0, 0.0004]])
    while driving:
        x, P = predict(x, P, u)
        record.predicted(x, P, t)               # after every prediction; t in seconds
        for z, id in sightings:
            if id in known:
                x, P = update(x, P, z, id)
                record.updated(x, P, [id])      # after every update: the ids observed in it
            else:
                x, P = initialise(x, P, z)
                record.initialised(x, P, [id])  # after every new feature: its id

Then: slamscope audit run.jsonl. With Log("-") the lines go to standard output, for a picture while
the filter runs: python3 filter.py | slamscope monitor --slam -

x is the state [x, y, heading, l1x, l1y, l2x, l2y, ...] in m and rad, P its full covariance: NumPy
arrays, or lists of numbers. Without t, predictions are counted; without ids, features are called
1, 2, ... by their place in the state. Where features leave the state: record.removed(x, P, [ids]).
Other fields of a record go in by name: record.updated(x, P, [id], observations=[{"id": id, ...}]).
"""
import json
import sys


def _plain(value):
    """Lists of numbers, from whatever array."""
    value = value.tolist() if hasattr(value, "tolist") else value
    return [_plain(item) for item in value] if isinstance(value, (list, tuple)) else value


def _flat(value):
    value = _plain(value)
    return [number for item in value for number in _flat(item)] if isinstance(value, list) else [value]


class Log:
    def __init__(self, file, sensor="unknown", R=None, Q=None, robot=None):
        """sensor: range-bearing, relative-position or unknown. R (2 x 2) and Q (3 x 3: of the pose,
        a step), where constant, let the audit compare them with what the filter did."""
        self._file = sys.stdout if file == "-" else open(file, "w", encoding="utf-8")
        self._time = 0
        self._ids = []
        self._named = False
        header = {"format": "slamscope", "version": 1, "sensor": sensor}
        for key, value in (("R", R), ("Q", Q), ("robot", robot)):
            if value is not None:
                header[key] = _plain(value)
        self._write(header)

    def predicted(self, x, P, t=None, **fields):
        self._time = self._time + 1 if t is None else t
        self._record("predict", x, P, fields)

    def updated(self, x, P, observed=None, **fields):
        if observed is not None:
            fields["observed"] = [int(id) for id in _flat(observed)]
        self._record("update", x, P, fields)

    def initialised(self, x, P, new_ids=None, **fields):
        if new_ids is not None:
            self._named = True
            self._ids = self._ids + [int(id) for id in _flat(new_ids)]
        self._record("initialise", x, P, fields)

    def removed(self, x, P, old_ids, **fields):
        gone = [int(id) for id in _flat(old_ids)]
        self._named = True
        self._ids = [id for id in self._ids if id not in gone]
        self._record("remove", x, P, fields)

    def close(self):
        if self._file is not sys.stdout:
            self._file.close()

    def _record(self, event, x, P, fields):
        x, P = _flat(x), _plain(P)
        features = (len(x) - 3) // 2
        if not self._named:
            self._ids = list(range(1, features + 1))
        if len(x) != 3 + 2 * len(self._ids):
            raise ValueError(f"slamscope_log: x has {len(x)} numbers, expected {3 + 2 * len(self._ids)} "
                             f"for the {len(self._ids)} features whose ids are known")
        if len(P) != len(x) and len(P) != len(x) ** 2:
            raise ValueError(f"slamscope_log: P has {len(P)} rows, x has {len(x)} numbers")
        self._write({"time_s": float(self._time), "event": event, "pose": x[:3], "ids": self._ids,
                     "features": x[3:], "covariance": P, **fields})

    def _write(self, line):
        self._file.write(json.dumps(line, default=_number) + "\n")
        self._file.flush()


def _number(value):
    """Arrays and numbers that json does not know, in fields given by name."""
    plain = _plain(value)
    return plain if isinstance(plain, list) else float(plain)
