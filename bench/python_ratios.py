#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares the package for Python with the command, as ratios of times in one run, on the real data of NOLI_DATA.

    PYTHONPATH=build/release/python bench/python_ratios.py build/release/app/noli

  queries          noli.contacts of a million queries over `noli ccd`, one thread, contact or not
  time of impact   noli.time_of_impact over the time that `noli verify --no-check` takes to decide, one thread
Each figure is the median of five.
"""

import json
import os
import pathlib
import statistics
import subprocess
import sys
import time

import noli
import numpy as np

TIMES = 5
MILLION = 1_000_000
DATA = pathlib.Path(os.environ.get("NOLI_DATA", pathlib.Path(__file__).resolve().parents[2] / "shared" / "data"))


def median_of(work):
    return statistics.median(work() for _ in range(TIMES))


def seconds(work):
    begin = time.perf_counter()
    work()
    return time.perf_counter() - begin


def command(program, *arguments):
    done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, check=False)
    return json.loads(done.stdout)


def queries_of(file):
    """x_t0 and x_t1, (m, 4, 3), of a file of fractions, whose numbers are doubles."""
    rows = [line.split(",")[:6] for line in file.read_text().splitlines() if line and not line.startswith("#")]
    x = np.array([[int(row[k]) / int(row[k + 1]) for k in (0, 2, 4)] for row in rows]).reshape(-1, 8, 3)
    return x[:, :4], x[:, 4:]


def compare_queries(program):
    for name, pair in (("cloth-funnel-edge-edge", "edge_edge"), ("armadillo-rollers-vertex-face", "vertex_face")):
        file = DATA / "queries" / f"{name}.csv"
        x_t0, x_t1 = queries_of(file)
        times = -(-MILLION // len(x_t0))
        many = [np.ascontiguousarray(np.tile(x, (times, 1, 1))[:MILLION]) for x in (x_t0, x_t1)]
        own = median_of(lambda: seconds(lambda: noli.contacts(pair, *many, times=False, threads=1))) / MILLION * 1e9
        theirs = median_of(lambda: command(program, "ccd", file, "--json", "-")["timing"]["ns_per_query"])
        print(f"{name}: {own:.0f} ns a query in Python, {theirs:.0f} ns by noli ccd: {own / theirs:.2f}")


def compare_steps(program):
    for folder in sorted((DATA / "frames").iterdir()):
        files = sorted(folder.iterdir())[:2]
        V, mesh = noli.read_frames(files)
        own = median_of(lambda: seconds(lambda: noli.time_of_impact(V[0], V[1], mesh, threads=1)))
        words = ["verify", *files, "--order", "natural", "--no-check", "--threads", "1", "--json", "-"]
        theirs = median_of(lambda: command(program, *words)["timing"]["seconds"])
        print(f"{folder.name}: {own:.3f} s in Python, {theirs:.3f} s by noli verify: {own / theirs:.2f}")


if __name__ == "__main__":
    if len(sys.argv) != 2 or not DATA.is_dir():
        sys.exit(f"{__doc__}\nexpected the program noli, and data in {DATA}")
    compare_queries(sys.argv[1])
    compare_steps(sys.argv[1])
