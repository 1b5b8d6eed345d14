#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures the tasks of `noli verify --shard` on these frames, and works out what many ranks would make of many more.

    bench/many_ranks.py NOLI FRAMES... [--frames 100000] [--ranks 1,100,1000,10000] [--scale 1]

Each task (16 steps) runs by itself, on one thread, then the shards are merged without the checker. For the forecast, measured times
follow each other in a circle until there are tasks for --frames; --scale multiplies them, for larger meshes. Ranks take tasks from a
counter, as those of mpirun do. Reading is counted as it was measured: a file system that slows down when many read is not in here.
"""
import argparse
import heapq
import itertools
import pathlib
import statistics
import subprocess
import tempfile
import time

STEPS = 16  # of a task: proofs/prover/chain.h


def seconds_of(command):
    began = time.monotonic()
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(f"many_ranks.py: {' '.join(command[:2])} ended with {done.returncode}: {done.stdout}{done.stderr}")
    return time.monotonic() - began


def measure(noli, frames):
    """The seconds of each task, and those of merging."""
    tasks = -(-(len(frames) - 1) // STEPS)
    with tempfile.TemporaryDirectory() as folder:
        shards = str(pathlib.Path(folder) / "shards")
        part = [noli, "verify", *frames, "-o", shards, "--threads", "1", "-q"]
        times = [seconds_of([*part, "--shard", f"{k}/{tasks}"]) for k in range(1, tasks + 1)]
        return times, seconds_of([noli, "merge", shards, "--no-check", "--proof", folder + "/all.noli", "-q"])


def schedule(times, ranks):
    """(when the first rank has nothing to do, when the last one ends, if each takes the next task when it is free)."""
    free = [0.0] * min(ranks, len(times))
    for seconds in times:
        heapq.heappush(free, heapq.heappop(free) + seconds)
    return 0.0 if ranks > len(times) else min(free), max(free)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("noli")
    parser.add_argument("frames_given", nargs="+", metavar="FRAMES")
    parser.add_argument("--frames", type=int, default=100_000)
    parser.add_argument("--ranks", default="1,100,1000,10000")
    parser.add_argument("--scale", type=float, default=1)
    asked = parser.parse_args()
    measured, merging = measure(asked.noli, asked.frames_given)
    # The last task may have fewer steps.
    whole = measured[:-1] if (len(asked.frames_given) - 1) % STEPS and len(measured) > 1 else measured
    errors = [abs(b / a - 1) for a, b in zip(whole, whole[1:])]
    print(f"{len(measured)} tasks of {STEPS} steps: {min(whole):.2f} to {max(whole):.2f} s, mean {statistics.mean(whole):.2f} s")
    if errors:
        print(f"a task takes what the one before it took, within {max(errors):.0%} (mean {statistics.mean(errors):.0%})")
    per_frame = merging / len(asked.frames_given)
    print(f"merging: {per_frame * 1000:.1f} ms a frame, of one process\n")
    count = -(-(asked.frames - 1) // STEPS)
    times = [seconds * asked.scale for seconds in itertools.islice(itertools.cycle(whole), count)]
    merging_all = per_frame * asked.scale * asked.frames
    print(f"{asked.frames} frames, {count} tasks: {sum(times) / 3600:.1f} h of work, then {merging_all / 3600:.2f} h of merging\n")
    print("| ranks | hours | of the ranks' time idle | seconds from the first idle rank to the end | speed-up, with merging |")
    print("|---|---|---|---|---|")
    for ranks in (int(word) for word in asked.ranks.split(",")):
        first_idle, end = schedule(times, ranks)
        idle = 1 - sum(times) / (ranks * end)
        speed_up = (sum(times) + merging_all) / (end + merging_all)
        print(f"| {ranks} | {end / 3600:.4f} | {idle:.1%} | {end - first_idle:.1f} | {speed_up:.1f} |")


main()
