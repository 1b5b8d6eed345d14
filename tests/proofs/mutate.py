#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Mutants of a good proof, or of its trajectory: wrong in one place or a few, and often still right.

    mutate.py PROOF FRAME... --seed S --count N -o FOLDER       writes N mutants, each a proof and where it differs its trajectory
    mutate.py PROOF trajectory.blocks --seed S --count N -o FOLDER

A mutant is made from the taken-apart proof, so that lengths, checksums and hashes fit again (repaired), or from its bytes, or with one
of the checksums and hashes wrong. run_mutants.py uses the function mutant().

What this does not do: it does not know which mutants are still good; the checkers have to agree on that.
"""
import argparse
import os
import random
import struct
import sys

import corpus
import slow_check
import slow_files
from mutant import Mutant, NoSuchThing, Taken, some_bytes
from mutate_blocks import (
    blocks_moved, claim_fields, counts_of_claim, distance, from_another, labels_of_cells, pairs_of_claim, step_fields, steps_moved, tree_elsewhere,
    tree_numbers, tree_shape, units_finer)
from mutate_motion import all_positions, blocks_of_run, cells_of_frames, order_of_frames, positions, scene_of_run, world_lines
from mutate_tokens import (
    blocks_of_tokens, coefficients, numbers_longer, path_longer, payload_bytes, plane, split_deep, split_moved, token_deleted,
    token_doubled, token_inserted, token_replaced, tokens_swapped)
from mutate_witness import witness_places, witness_polynomials, witness_time, witness_weights
from proof_bytes import serialise


STRUCTURED = [  # (weight, mutation)
    (4, payload_bytes), (3, token_deleted), (3, token_doubled), (3, tokens_swapped), (6, token_replaced), (4, token_inserted), (4, split_moved),
    (1, split_deep), (9, coefficients), (6, plane), (1, path_longer), (2, blocks_of_tokens), (1, numbers_longer), (3, step_fields), (2, units_finer), (3, steps_moved),
    (4, tree_numbers), (3, tree_shape), (2, tree_elsewhere), (4, claim_fields), (2, labels_of_cells), (7, distance), (4, pairs_of_claim), (1, counts_of_claim),
    (9, witness_polynomials), (7, witness_weights), (6, witness_time), (7, witness_places), (4, blocks_moved), (3, from_another),
    (14, positions), (3, all_positions), (2, order_of_frames), (5, cells_of_frames), (6, world_lines), (3, scene_of_run), (3, blocks_of_run)]
_MUTATIONS = [mutation for _, mutation in STRUCTURED]
_WEIGHTS = [weight for weight, _ in STRUCTURED]


def fit(m, files):
    """Makes the proof's hashes, and for a run its excluded pairs, those of the changed trajectory and claim."""
    try:
        claim_block = m.groups[0][0]
        claim = slow_check.Claim(claim_block[1])
        if claim.source == 2:
            claim.excluded = None
        trajectory = slow_files.trajectory_of(claim, files)
        if claim.source == 2 and m.fit_cells:
            claim_block[1] = corpus.claim_bytes(2, claim.dimension, claim.strict, claim.ring, claim.eta, claim.cells_hash, (), trajectory.excluded)
        labels = [block for block in m.groups[0][1:] if block[0] == b"LABL"]
        if labels and claim.source != 2:
            slow_check.take_labels(claim, trajectory, labels[0][1])
        if m.fit_cells:
            claim_block[1] = claim_block[1][:16] + slow_files.cells_hash(trajectory) + claim_block[1][48:]
        for k, (_, _, digest, _) in enumerate(trajectory.steps()):
            for group in m.groups[1:]:
                for block in group:
                    if block[0] == b"STEP" and len(block[1]) == 65 and int.from_bytes(block[1][:8], "little") == k:
                        block[1] = block[1][:33] + digest
    except (slow_files.Rejected, struct.error, IndexError, OverflowError):
        pass


def mutant(rng, taken, others):
    """(kinds of its mutations, proof, None or the changed files of the trajectory)."""
    if rng.random() < 0.2:
        data = some_bytes(rng, taken.case.proof)
        if rng.random() < 0.2:
            data = data[: rng.randrange(len(data) + 1)]
        if taken.run is not None and rng.random() < 0.2:
            return "bytes of the run", taken.case.proof, [some_bytes(rng, taken.case.files[0])]
        return "bytes", data, None
    m, kinds = Mutant(rng, taken, others), []
    for _ in range(rng.choice((1, 1, 1, 1, 2, 2, 3))):
        while True:
            mutation = rng.choices(_MUTATIONS, _WEIGHTS)[0]
            try:
                mutation(m)
            except (NoSuchThing, struct.error, OverflowError, IndexError, ValueError):
                continue
            kinds.append(mutation.__name__)
            break
    files = None
    if m.frames is not None:
        try:
            form = taken.case.extension
            write = corpus.obj if form == "obj" else lambda f, c: corpus.ply(f, c, rng.random() < 0.5)
            files = [write(frame, m.cells) for frame in m.frames]
        except (OverflowError, struct.error):
            files = None
    elif m.run is not None:
        files = [serialise(m.run, b"TRAJ", commit=rng.random() < 0.97)]
    if m.fit_motion or m.fit_cells:
        fit(m, files or taken.case.files)
    if rng.random() < 0.15:
        kinds.append("with a hash wrong")
        what = rng.choice(("number", "group", "running", "checksum"))
        if what != "checksum":
            return "+".join(kinds), serialise(m.groups, b"PROF", spoil=(rng.randrange(len(m.groups)), what)), files
        data = bytearray(serialise(m.groups, b"PROF", commit=rng.random() < 0.5))
        data[rng.randrange(16, max(17, len(data)))] ^= 1 << rng.randrange(8)
        return "+".join(kinds), bytes(data), files
    return "+".join(kinds), serialise(m.groups, b"PROF"), files


def main():
    parser = argparse.ArgumentParser(description="Mutants of a proof")
    parser.add_argument("proof")
    parser.add_argument("files", nargs="+")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("-o", "--output", required=True)
    arguments = parser.parse_args()
    files = [corpus.read(path) for path in arguments.files]
    extension = os.path.splitext(arguments.files[0])[1][1:]
    taken = Taken(corpus.Case("given", corpus.read(arguments.proof), files, extension, None))
    os.makedirs(arguments.output, exist_ok=True)
    for k in range(arguments.count):
        kinds, proof, changed = mutant(random.Random(f"{arguments.seed}/{k}"), taken, [taken])
        for name, data in [(f"{k}.noli", proof)] + [(f"{k}-{i}.{extension}", data) for i, data in enumerate(changed or [])]:
            with open(os.path.join(arguments.output, name), "wb") as file:
                file.write(data)
        print(f"{k}: {kinds}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
