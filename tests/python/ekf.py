#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""EKF-SLAM in plain Python, watched while it runs:  python3 ekf.py | slamscope monitor --slam -"""
import argparse, json, math, random, socket, sys, time
cli = argparse.ArgumentParser(description=__doc__)
cli.add_argument("--rate", type=float, default=30, help="steps a second; 0: no waiting")
cli.add_argument("--steps", type=int, default=10**9)
cli.add_argument("--tcp", metavar="HOST:PORT", help="send there, not to standard output")
cli.add_argument("--seed", type=int, help="of the simulated world's noise")
args, wrap = cli.parse_args(), lambda angle: math.remainder(angle, math.tau)
MAP = {1: (0.9, -0.1), 2: (1.4, 0.6), 3: (1.2, 1.8), 4: (-0.4, 2.3), 7: (-1.3, 1.2)}  # true, m
DT, V, W, M, R = 1 / 30, 0.25, 0.25, (0.05, 0.1), (0.05, 0.03)  # circle; sigmas of (v, w), (r, b)
random.seed(args.seed)

mul = lambda A, B: [[sum(a * b for a, b in zip(row, col)) for col in zip(*B)] for row in A]
def plus(P, at, sigmas):  # P with variances added on its diagonal from `at` on; grows as needed
    n = max(len(P), at + len(sigmas))
    P = [[*row] + [0] * (n - len(P)) for row in P] + [[0] * n for _ in range(n - len(P))]
    for k, sigma in enumerate(sigmas): P[at + k][at + k] += sigma**2
    return P
def spread(f, x, P):  # f(x), its Jacobian J (by differences) and J P J'
    ends = [(f(x[:k] + [x[k] + 1e-5] + x[k + 1:]), f(x[:k] + [x[k] - 1e-5] + x[k + 1:])) for k in range(len(x))]
    J = [*zip(*[[(a - b) / 2e-5 for a, b in zip(*pair)] for pair in ends])]
    return f(x), J, mul(mul(J, P), [*zip(*J)])
def move(x):  # x ends in v, w, which are used up
    *x, v, w = x
    return [x[0] + v * DT * math.cos(x[2] + w * DT / 2), x[1] + v * DT * math.sin(x[2] + w * DT / 2), x[2] + w * DT, *x[3:]]
def place(x):  # x ends in range and bearing, which become a feature
    return x[:-2] + [x[0] + x[-2] * math.cos(x[2] + x[-1]), x[1] + x[-2] * math.sin(x[2] + x[-1])]
def sense(p, f):
    return math.dist(p[:2], f), wrap(math.atan2(f[1] - p[1], f[0] - p[0]) - p[2])
def update(x, P, k, z):  # with the feature at x[k], x[k + 1]
    h, H, S = spread(lambda y: sense(y, y[k:k + 2]), x, P)
    PHt, ((a, b), (_, d)) = mul(P, [*zip(*H)]), plus(S, 0, R)
    K = mul(PHt, [[d / (a * d - b * b), -b / (a * d - b * b)], [-b / (a * d - b * b), a / (a * d - b * b)]])
    x = [xi + g * (z[0] - h[0]) + q * wrap(z[1] - h[1]) for xi, (g, q) in zip(x, K)]
    return x, [[p - c for p, c in zip(*rows)] for rows in zip(P, mul(K, [*zip(*PHt)]))]
def connect(host, port):
    while True:  # we may start before the viewer
        try: return socket.create_connection((host, int(port))).makefile("w")
        except OSError: time.sleep(0.2)

out = connect(*args.tcp.rsplit(":", 1)) if args.tcp else sys.stdout
print('{"format": "slamscope", "version": 1, "sensor": "range-bearing"}', file=out, flush=True)
true, x, P, ids = [0, 0, 0], [0, 0, 0], [[0] * 3 for _ in range(3)], []
for step in range(1, args.steps + 1):
    true = move(true + [random.gauss(V, M[0]), random.gauss(W, M[1])])
    x, _, P = spread(move, x + [V, W], plus(P, len(P), M))
    for name, feature in MAP.items():
        r, b = sense(true, feature)
        z = [random.gauss(r, R[0]), random.gauss(b, R[1])]
        if r > 1.5 or abs(b) > 1: continue
        if name in ids: x, P = update(x, P, 3 + 2 * ids.index(name), z)
        else: ids, (x, _, P) = ids + [name], spread(place, x + z, plus(P, len(P), R))
    print(json.dumps({"time_s": step * DT, "pose": x[:3], "ids": ids, "features": x[3:], "covariance": P}), file=out, flush=True)
    if args.rate: time.sleep(1 / args.rate)
