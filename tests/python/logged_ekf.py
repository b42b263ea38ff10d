#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A small EKF-SLAM in plain Python that logs itself with apps/loggers/slamscope_log.py, and can
plant a fault in itself: logged_ekf.py run.jsonl [--fault late-motion-jacobian]"""
import argparse
import math
import pathlib
import random
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "apps" / "loggers"))
from slamscope_log import Log  # noqa: E402

MAP = {1: (0.9, -0.1), 2: (1.4, 0.6), 3: (1.2, 1.8), 4: (-0.4, 2.3), 7: (-1.3, 1.2)}  # true, m
DT, V, W = 0.1, 0.25, 0.25            # a circle
M = [[0.05**2, 0], [0, 0.1**2]]       # of (v, w)
R = [[0.05**2, 0], [0, 0.03**2]]      # of (range, bearing)


def mul(A, B):
    columns = list(zip(*B))
    return [[sum(a * b for a, b in zip(row, col)) for col in columns] for row in A]


def turned(A):
    return [list(row) for row in zip(*A)]


def plus(A, B, sign=1):
    return [[a + sign * b for a, b in zip(*rows)] for rows in zip(A, B)]


def identity(n):
    return [[float(i == j) for j in range(n)] for i in range(n)]


def inverse2(S):
    (a, b), (c, d) = S
    det = a * d - b * c
    return [[d / det, -b / det], [-c / det, a / det]]


def wrap(angle):
    return math.remainder(angle, math.tau)


def move(pose, v, w):
    x, y, theta = pose
    return [x + v * DT * math.cos(theta), y + v * DT * math.sin(theta), wrap(theta + w * DT)]


def predict(x, P, late):
    after = move(x[:3], V, W)
    theta = after[2] if late else x[2]
    F = identity(len(x))
    F[0][2], F[1][2] = -V * DT * math.sin(theta), V * DT * math.cos(theta)
    G = [[DT * math.cos(x[2]), 0], [DT * math.sin(x[2]), 0], [0, DT]] + [[0, 0] for _ in x[3:]]
    P = plus(mul(mul(F, P), turned(F)), mul(mul(G, M), turned(G)))
    return after + x[3:], P


def sense(pose, feature):
    dx, dy = feature[0] - pose[0], feature[1] - pose[1]
    return [math.hypot(dx, dy), wrap(math.atan2(dy, dx) - pose[2])]


def update(x, P, k, z):
    dx, dy = x[k] - x[0], x[k + 1] - x[1]
    q = dx * dx + dy * dy
    r = math.sqrt(q)
    H = [[0.0] * len(x), [0.0] * len(x)]
    H[0][0], H[0][1], H[0][k], H[0][k + 1] = -dx / r, -dy / r, dx / r, dy / r
    H[1][0], H[1][1], H[1][2], H[1][k], H[1][k + 1] = dy / q, -dx / q, -1.0, -dy / q, dx / q
    PHt = mul(P, turned(H))
    K = mul(PHt, inverse2(plus(mul(H, PHt), R)))
    expected = sense(x, x[k:k + 2])
    nu = [[z[0] - expected[0]], [wrap(z[1] - expected[1])]]
    x = [a + b for a, (b,) in zip(x, mul(K, nu))]
    P = plus(P, mul(K, turned(PHt)), -1)
    return x, [[(P[i][j] + P[j][i]) / 2 for j in range(len(x))] for i in range(len(x))]


def initialise(x, P, z):
    c, s = math.cos(x[2] + z[1]), math.sin(x[2] + z[1])
    G = [[1, 0, -z[0] * s], [0, 1, z[0] * c]]
    N = [[c, -z[0] * s], [s, z[0] * c]]
    cross = mul(G, P[:3])
    own = plus(mul(mul(G, [row[:3] for row in P[:3]]), turned(G)), mul(mul(N, R), turned(N)))
    P = [row + [cross[0][i], cross[1][i]] for i, row in enumerate(P)]
    P += [cross[0] + own[0], cross[1] + own[1]]
    return x + [x[0] + z[0] * c, x[1] + z[0] * s], P


def main():
    cli = argparse.ArgumentParser(description=__doc__)
    cli.add_argument("file")
    cli.add_argument("--fault", choices=["none", "late-motion-jacobian"], default="none")
    cli.add_argument("--steps", type=int, default=400)
    cli.add_argument("--seed", type=int, default=1)
    args = cli.parse_args()
    random.seed(args.seed)
    record = Log(args.file, sensor="range-bearing", R=R)
    true, x, P, ids = [0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [[0.0] * 3 for _ in range(3)], []
    for step in range(1, args.steps + 1):
        true = move(true, random.gauss(V, M[0][0]**0.5), random.gauss(W, M[1][1]**0.5))
        x, P = predict(x, P, args.fault == "late-motion-jacobian")
        record.predicted(x, P, step * DT)
        for name, feature in MAP.items():
            r, b = sense(true, feature)
            z = [random.gauss(r, R[0][0]**0.5), random.gauss(b, R[1][1]**0.5)]
            if r > 1.5 or abs(b) > 1:
                continue
            if name in ids:
                x, P = update(x, P, 3 + 2 * ids.index(name), z)
                record.updated(x, P, [name])
            else:
                ids.append(name)
                x, P = initialise(x, P, z)
                record.initialised(x, P, [name])
    record.close()


if __name__ == "__main__":
    main()
