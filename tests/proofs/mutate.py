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
import copy
import os
import random
import struct
import sys
from fractions import Fraction

import corpus
import slow_check
import slow_files
from proof_bytes import get_witness, numbers_of, parse, put_uint, put_witness, serialise, split_tokens, with_numbers


class NoSuchThing(Exception):
    """This mutation finds nothing here that it could change."""


class Taken:
    """A good proof taken apart; mutants are made of copies of it."""

    def __init__(self, case):
        self.case, self.groups = case, parse(case.proof)
        claim = slow_check.Claim(self.groups[0][0][1])
        self.source, self.dimension = claim.source, claim.dimension
        if claim.source == 2:
            self.run, self.frames = parse(case.files[0]), None
        else:
            self.run, self.frames = None, []
            for data in case.files:
                positions, self.cells = slow_files.read_frame(data)
                self.frames.append([list(p) for p in positions])


class Mutant:
    def __init__(self, rng, taken, others):
        self.rng, self.taken, self.others = rng, taken, others
        self.groups = [[list(block) for block in group] for group in taken.groups]
        self.frames = self.run = self.cells = None  # what has been changed of the trajectory
        self.fit_motion = self.fit_cells = False

    def blocks(self, *kinds):
        found = [block for group in self.groups for block in group if block[0] in kinds]
        if not found:
            raise NoSuchThing
        return found

    def block(self, *kinds):
        return self.rng.choice(self.blocks(*kinds))

    def step_group(self):
        if len(self.groups) < 2:
            raise NoSuchThing
        return self.rng.randrange(1, len(self.groups))


def some_bytes(rng, data, low=0):
    """Bits flipped, bytes changed, inserted, deleted; from `low` on."""
    data = bytearray(data)
    for _ in range(rng.choice((1, 1, 1, 2, 4))):
        at, what = rng.randrange(low, max(low + 1, len(data))), rng.randrange(6)
        if what <= 1 and data:
            data[min(at, len(data) - 1)] ^= 1 << rng.randrange(8)
        elif what == 2 and data:
            data[min(at, len(data) - 1)] = rng.choice((0, 1, 2, 127, 128, 255, rng.randrange(256)))
        elif what == 3:
            data[at:at] = bytes(rng.randrange(256) for _ in range(rng.choice((1, 1, 4, 8))))
        elif what == 4:
            del data[at : at + rng.choice((1, 1, 4, 16))]
        elif data:
            begin = rng.randrange(len(data))
            data[at:at] = data[begin : begin + rng.choice((1, 4, 12))]
    return bytes(data)


def field(block, at, form, change):
    """Changes a field of a payload by a function of its value."""
    size = struct.calcsize("<" + form)
    if at + size > len(block[1]):
        raise NoSuchThing
    value = change(struct.unpack("<" + form, block[1][at : at + size])[0])
    bits = 8 * size
    if form in "BHIQ":
        value &= (1 << bits) - 1
    elif form == "i":
        value = (value + (1 << 31)) % (1 << 32) - (1 << 31)
    block[1] = block[1][:at] + struct.pack("<" + form, value) + block[1][at + size :]


def other_double(rng, x):
    what = rng.randrange(9)
    if what == 0:
        bits = struct.unpack("<Q", struct.pack("<d", x))[0] ^ 1 << rng.randrange(64)
        return struct.unpack("<d", struct.pack("<Q", bits))[0]
    return (x + 1, x - 1, -x, 0.0, -0.0, x * 2, x / 2, rng.choice((float("inf"), float("nan"), 5e-324, 1e300, x + 2.0**-20)))[what - 1]


def number(rng, n):
    """Another integer near this one, or far from it."""
    return rng.choice((n + 1, n - 1, n + 1, n - 1, -n, 2 * n, 3 * n, 0, n + rng.randrange(-9, 10), n << rng.randrange(70), n ^ 1 << rng.randrange(40)))


# ---- Mutations: each takes a Mutant and changes it -------------------------------------------------------------------------------------


def payload_bytes(m):
    block = m.rng.choice([block for group in m.groups for block in group])
    block[1] = some_bytes(m.rng, block[1])


def tokens_of(m):
    block = m.block(b"TOKS")
    try:
        tokens = split_tokens(block[1])
    except slow_files.Rejected:
        raise NoSuchThing from None
    if not tokens:
        raise NoSuchThing
    return block, tokens, m.rng.randrange(len(tokens))


def random_token(rng, tokens):
    what = rng.randrange(8)
    if what == 0:
        return rng.choice(tokens)
    if what == 1:
        return with_numbers(0x10, [rng.choice((0, 1, -1, rng.randrange(-512, 512))) for _ in range(3)])
    if what == 2:
        return with_numbers(0x11, [rng.choice((0, 1, -1, rng.randrange(-10**6, 10**6), rng.randrange(-10**40, 10**40))) for _ in range(3)])
    if what == 3:
        n = [rng.choice((0, 0, 1, 3, 60))] + [rng.randrange(-3, 4) for _ in range(3)]
        return with_numbers(0x12, n + [rng.randrange(9), rng.randrange(-2, 3), rng.randrange(9), rng.randrange(-30, 30), rng.randrange(9), rng.randrange(4)])
    if what == 4:
        m = rng.choice((0, 1, 1, 2, 3, 256))
        return with_numbers(0x30, [m] + [rng.randrange(6) for _ in range(2 * m + 1)])
    return bytes([rng.choice((0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 32, 33, 34, 35, rng.randrange(256)))])


def token_deleted(m):
    block, tokens, k = tokens_of(m)
    del tokens[k]
    block[1] = b"".join(tokens)


def token_doubled(m):
    block, tokens, k = tokens_of(m)
    tokens.insert(k, tokens[k])
    block[1] = b"".join(tokens)


def tokens_swapped(m):
    block, tokens, k = tokens_of(m)
    j = (k + 1) % len(tokens) if m.rng.random() < 0.5 else m.rng.randrange(len(tokens))
    tokens[k], tokens[j] = tokens[j], tokens[k]
    block[1] = b"".join(tokens)


def token_replaced(m):
    block, tokens, k = tokens_of(m)
    tokens[k] = random_token(m.rng, tokens)
    block[1] = b"".join(tokens)


def token_inserted(m):
    block, tokens, k = tokens_of(m)
    tokens.insert(m.rng.choice((k, len(tokens))), random_token(m.rng, tokens))
    block[1] = b"".join(tokens)


def split_moved(m):
    """T is moved, or put before a token that is then needed twice, which is good."""
    block, tokens, k = tokens_of(m)
    if b"\0" in tokens and m.rng.random() < 0.6:
        tokens.remove(b"\0")
        tokens.insert(m.rng.randrange(len(tokens) + 1), b"\0")
    else:
        tokens[k : k + 1] = [b"\0"] * m.rng.choice((1, 1, 1, 2)) + [tokens[k]] * m.rng.choice((2, 2, 2, 3))
    block[1] = b"".join(tokens)


def split_deep(m):
    """T again and again, up to and beyond the greatest denominator; the first obligations after it are S, X or F as before."""
    block, tokens, k = tokens_of(m)
    deep = m.rng.choice((3, 20, 100, 1023, 1024, 1025))
    tokens[k : k + 1] = [b"\0"] * deep + [tokens[k]] * (deep + 1)
    block[1] = b"".join(tokens)


def coefficients(m):
    block, tokens, _ = tokens_of(m)
    with_some = [k for k, token in enumerate(tokens) if token[0] in (0x10, 0x11, 0x12, 0x30)]
    if not with_some:
        raise NoSuchThing
    k = m.rng.choice(with_some)
    kind, n = tokens[k][0], numbers_of(tokens[k])
    what = m.rng.randrange(5)
    if what <= 1:
        i = m.rng.randrange(len(n))
        n[i] = number(m.rng, n[i])
    elif what == 2 and kind != 0x30:
        factor = m.rng.choice((-1, 2, 3, -2, 1 << 30, 0))
        n = [c if kind == 0x12 and i in (0, 4, 6, 8) else c * factor for i, c in enumerate(n)]
    elif what == 3 and kind in (0x10, 0x11):  # another form of the same
        kind = 0x21 - kind if all(-512 <= c < 512 for c in n) else 0x11
    else:
        i, j = m.rng.randrange(len(n)), m.rng.randrange(len(n))
        n[i], n[j] = n[j], n[i]
    tokens[k] = with_numbers(kind, n)
    block[1] = b"".join(tokens)


def path_longer(m):
    """W whose path goes to and fro, up to and beyond the greatest length; the ring may be greater."""
    block, tokens, _ = tokens_of(m)
    some = [k for k, token in enumerate(tokens) if token[0] == 0x30]
    if not some:
        raise NoSuchThing
    k = m.rng.choice(some)
    n = numbers_of(tokens[k])
    more = m.rng.choice((1, 2, 255 - n[0], 256 - n[0], 300))
    cells = [c for c, cell in enumerate(m.taken.cells) if n[1] in cell] if m.taken.frames else [0]
    if more < 0 or not cells:
        raise NoSuchThing
    tokens[k] = with_numbers(0x30, [n[0] + more, n[1]] + [m.rng.choice(cells), n[1]] * more + n[2:])
    block[1] = b"".join(tokens)
    field(m.groups[0][0], 4, "I", lambda ring: m.rng.choice((ring, n[0] + more, n[0] + more + 1, 1000)))


def plane(m):
    """S is written as P with a plane at rest, or nearly; bounds are met exactly, or missed by one."""
    block, tokens, _ = tokens_of(m)
    axes = {bytes([8 + i]): n for i, n in enumerate(corpus.AXES[:6])}
    some = [k for k, token in enumerate(tokens) if token in axes or token[0] in (0x10, 0x11)]
    if not some:
        raise NoSuchThing
    k = m.rng.choice(some)
    n = axes.get(tokens[k]) or numbers_of(tokens[k])
    shift = m.rng.choice((0, 0, 1, 4))
    n = [c << shift for c in n]
    long_shift = m.rng.choice((0, 1, 4095, 4096, 4097)) if m.rng.random() < 0.2 else 0
    nd = m.rng.randrange(-6, 7) << m.rng.choice((0, 1, 2, 3, 4, 8)) << shift
    nt, w = m.rng.choice((0, 0, 0, 1, -1)), m.rng.choice((0, 0, 1, -1, 4 << shift))
    tokens[k] = with_numbers(0x12, [0, *n, long_shift, nt, 0, nd, 0, w])
    block[1] = b"".join(tokens)


def blocks_of_tokens(m):
    """TOKS is cut in two (between tokens or within one), joined, or an empty one is added."""
    group = m.groups[m.step_group()]
    some = [i for i, block in enumerate(group) if block[0] == b"TOKS"]
    if not some:
        raise NoSuchThing
    i = m.rng.choice(some)
    payload, what = group[i][1], m.rng.randrange(4)
    if what == 0:
        group.insert(i, [b"TOKS", b""])
    elif what == 1 and i + 1 < len(group):
        group[i : i + 2] = [[b"TOKS", payload + group[i + 1][1]]]
    else:
        cut = m.rng.randrange(len(payload) + 1)
        if what == 2:
            try:
                tokens = split_tokens(payload)
            except slow_files.Rejected:
                raise NoSuchThing from None
            cut = len(b"".join(tokens[: m.rng.randrange(len(tokens) + 1)]))
        group[i : i + 1] = [[b"TOKS", payload[:cut]], [b"TOKS", payload[cut:]]]


def numbers_longer(m):
    """A number with a byte more than needed, or more than its place allows."""
    block = m.block(b"TOKS", b"TREE", b"WITN")
    payload = block[1]
    k = m.rng.randrange(len(payload)) if payload else 0
    block[1] = payload[:k] + bytes([payload[k] | 0x80 if payload else 0x80]) + b"\x80" * m.rng.choice((0, 0, 8, 9, 1199)) + \
        bytes([m.rng.randrange(2)]) + payload[k + 1 :]


def step_fields(m):
    block, rng = m.block(b"STEP"), m.rng
    what = rng.randrange(9)
    if what == 0:
        field(block, 0, "Q", lambda n: n + rng.choice((1, -1, 2)))
    elif what <= 2:
        field(block, 8 * what, "d", lambda x: other_double(rng, x))
    elif what <= 6:
        field(block, 24 + 4 * (what & 1), "i", lambda n: n + rng.choice((1, -1, -2, -10, 5, -1100, 1100, -1200 - n, 1200 - n, -1201 - n)))
    elif what == 7:
        field(block, 32, "B", lambda n: rng.choice((1 - n, n ^ 2, 255)))
    else:
        field(block, 33 + rng.randrange(32), "B", lambda n: n ^ 1 << rng.randrange(8))


def units_finer(m):
    """p or q is lowered: all integers grow, and tokens S stay what they are."""
    for block in m.blocks(b"STEP"):
        if m.rng.random() < 0.8:
            field(block, m.rng.choice((24, 28)), "i", lambda n: max(-1200, n - m.rng.choice((1, 2, 7, 60, 900, 1200))))


def steps_moved(m):
    what, i = m.rng.randrange(6), m.step_group()
    groups = m.groups
    if what == 0:
        del groups[i]
    elif what == 1:
        groups.insert(i, [list(block) for block in groups[i]])
    elif what == 2:
        groups.append([list(block) for block in groups[i]])
        field(groups[-1][0], 0, "Q", lambda n: len(groups) - 2)
    elif what == 3:
        j = m.step_group()
        groups[i], groups[j] = groups[j], groups[i]
    elif what == 4:
        groups[i:] = []
    else:
        for number_of_step, group in enumerate(groups[1:]):
            if group and group[0][0] == b"STEP" and len(group[0][1]) == 65:
                field(group[0], 0, "Q", lambda n, k=number_of_step: k)
        del groups[m.step_group()]


def tree_of(m):
    block = m.block(b"TREE")
    reader, values = slow_files.Reader(block[1], "TREE"), []
    try:
        while reader.more():
            values.append(reader.uint())
    except slow_files.Rejected:
        raise NoSuchThing from None
    if not values:
        raise NoSuchThing
    return block, values


def tree_numbers(m):
    block, values = tree_of(m)
    what, k, rng = m.rng.randrange(6), m.rng.randrange(len(values)), m.rng
    leaves = [i for i, value in enumerate(values) if value]
    if what <= 1 and len(leaves) > 1:
        i, j = rng.sample(leaves, 2)
        values[i], values[j] = values[j], values[i]
    elif what == 2:
        values[k] = rng.choice((0, 1, values[k] + 1, len(leaves) + 1, 1 << 32, (1 << 64) - 1, (1 << 64) + values[k], (1 << 32) + values[k]))
    elif what == 3:
        del values[k]
    elif what == 4:
        values.insert(k, rng.choice(values))
    else:
        values = [0] * rng.choice((1, 254, 255, 256)) + values
    block[1] = b"".join(map(put_uint, values))


def tree_shape(m):
    """Another tree over the same cells; chains at the limit of its depth."""
    block, values = tree_of(m)
    cells = [value - 1 for value in values if value]
    m.rng.shuffle(cells)
    block[1] = corpus.random_tree(m.rng, cells)


def tree_elsewhere(m):
    group = m.groups[m.step_group()]
    tree = m.block(b"TREE")
    what = m.rng.randrange(3)
    if what == 0:
        group.insert(m.rng.randrange(len(group) + 1), list(tree))
    elif what == 1:
        group[:] = [block for block in group if block[0] != b"TREE"]
    elif len(group) > 0:
        group.insert(1, list(tree))


def claim_fields(m):
    block, rng = m.groups[0][0], m.rng
    if block[0] != b"CLAM":
        raise NoSuchThing
    what = rng.randrange(10)
    if what == 0:
        field(block, 0, "B", lambda n: rng.choice((0, 1, 2, 3, 255)))
    elif what == 1:
        field(block, 1, "B", lambda n: rng.choice((2, 3, 5 - n, 0, 4)))
    elif what <= 3:
        field(block, 2, "B", lambda n: n ^ rng.choice((1, 1, 2, 3, 4, 128)))
    elif what == 4:
        field(block, 3, "B", lambda n: rng.randrange(256))
    elif what <= 6:
        field(block, 4, "I", lambda n: rng.choice((n + 1, n - 1, 0, 1, 2, 3, (1 << 32) - 1)))
    elif what <= 8:
        field(block, 8, "d", lambda x: other_double(rng, x))
    else:
        field(block, 16 + rng.randrange(32), "B", lambda n: n ^ 1 << rng.randrange(8))
    m.fit_cells = m.fit_motion = rng.random() < 0.7


def distance(m):
    """A distance, a ring: what was proved without may not hold with it."""
    block, rng = m.groups[0][0], m.rng
    steps = m.blocks(b"STEP")
    if len(steps[0][1]) != 65 or block[0] != b"CLAM":
        raise NoSuchThing
    p = struct.unpack("<i", steps[0][1][24:28])[0]
    eta = rng.choice((1, 1, 2, 3, 4, 5, 7, 8, 12, 16, 17, 0, rng.randrange(1, 300))) * 2.0 ** max(-1000, min(900, p + rng.choice((0, 0, 0, 1, 2, 4))))
    if rng.random() < 0.3:
        eta = 2.0 ** rng.randrange(-12, 2)
    field(block, 8, "d", lambda x: eta if rng.random() < 0.9 else 0.0)
    field(block, 4, "I", lambda n: rng.choice((n, 1, 1, 1, 2, 3, 4, 1000, (1 << 32) - 1)))
    if rng.random() < 0.5:
        for step in steps:
            field(step, 24, "i", lambda n: max(n - 6, -1200))


def pairs_of_claim(m):
    """Merged vertices, excluded pairs: added, taken away, changed; the hash of the cells fits."""
    block, rng = m.groups[0][0], m.rng
    try:
        claim = slow_check.Claim(block[1])
    except slow_files.Rejected:
        raise NoSuchThing from None
    merged, excluded = sorted(claim.merged.items()), list(claim.excluded)
    vertices = len(m.taken.frames[0]) if m.taken.frames else 4
    if rng.random() < 0.5:
        what = rng.randrange(3)
        if what == 0 and merged:
            merged.pop(rng.randrange(len(merged)))
        elif what == 1 and merged:
            k = rng.randrange(len(merged))
            merged[k] = (merged[k][0] + rng.choice((0, 0, 1, -1)), max(merged[k][1] + rng.choice((1, -1)), 0))
        else:
            merged.append((rng.randrange(max(vertices, 1)), rng.randrange(max(vertices, 1))))
            merged.sort()
    else:
        what = rng.randrange(3)
        if what == 0 and excluded:
            excluded.pop(rng.randrange(len(excluded)))
        elif what == 1 and excluded:
            k = rng.randrange(len(excluded))
            excluded[k] = (excluded[k][0], excluded[k][1] + rng.choice((1, -1)) & 0xFFFFFFFF)
        else:
            excluded.append(rng.choice(((0, 0), (0, 1), (1, 1), (1, 0), (0, 2), (2, 3), (7, 9))))
            if rng.random() < 0.8:
                excluded.sort()
    digest = block[1][16:48]
    block[1] = corpus.claim_bytes(claim.source, claim.dimension, claim.strict + 2 * claim.points, claim.ring, claim.eta, digest, merged, excluded)
    m.fit_cells = m.fit_motion = True


def counts_of_claim(m):
    block, at = m.groups[0][0], 48
    field(block, m.rng.choice((at, len(block[1]) - 4)), "I", lambda n: m.rng.choice((n + 1, n - 1, 1 << 31, 1 << 29, (1 << 32) - 1)))


def witness_of(m):
    block = m.block(b"WITN")
    try:
        return block, get_witness(block[1])
    except slow_files.Rejected:
        raise NoSuchThing from None


def scaled_poly(f, factor):
    return [int(c) for c in slow_check.times(f, factor)] or [0]


def witness_polynomials(m):
    block, w = witness_of(m)
    rng = m.rng
    lists = [f for side in "PQ" for _, f in w[side]]
    f = rng.choice(lists + [w["g"]] * 2)
    what = rng.randrange(8)
    k = rng.randrange(len(f)) if f else 0
    if what <= 2 and f:
        f[k] = number(rng, f[k])
    elif what == 3:
        f.append(rng.choice((0, 0, 1, -1)))
    elif what == 4 and len(f) > 1:
        f.pop()
    elif what == 5:
        f[:] = [c * rng.choice((-1, 2, 3)) for c in f]
    elif what == 6:
        f[:] = scaled_poly(f, rng.choice(([1, 1], [-1, 1], [0, 1], [-1, 2], [3, -2, 1], [1, -1], [2, -3, 1], [5], [-1])))
    else:
        f[:] = [rng.randrange(-3, 4) for _ in range(rng.choice((1, 2, 3, 32, 33)))]
    block[1] = put_witness(w)


def witness_weights(m):
    """All weights times a polynomial, or one side's: still good where it is positive. A root g more: good where it divides, and has a sign."""
    block, w = witness_of(m)
    rng = m.rng
    factor = rng.choice(([2], [1, 1], [3, -1, 1], [1, 0, 1], [-1], [0, 1], [4, -4, 1], [1, -2, 1], [0], [2, -1], [1, -1], w["g"]))
    if rng.random() < 0.3:
        factor = [*scaled_poly(factor, w["g"])]
        factor[0] += rng.choice((0, 0, 1, 5))
    for side in rng.choice(("P", "Q", "PQ")):
        w[side] = [(v, scaled_poly(f, factor) + [0] * (rng.random() < 0.2)) for v, f in w[side]]
    if rng.random() < 0.3:
        w["g"] = scaled_poly(w["g"], rng.choice(([2], [-1], [1, 1], [-1, 1], [0, 1], [-5, 3], [1, 0, 1])))
    if any(len(f) > 40 for side in "PQ" for _, f in w[side]):
        raise NoSuchThing
    block[1] = put_witness(w)


def witness_time(m):
    block, w = witness_of(m)
    what, rng = m.rng.randrange(9), m.rng
    if what <= 1:
        w["l"] = number(rng, w["l"])
    elif what == 2:
        w["u"] = number(rng, w["u"])
    elif what == 3:
        more = rng.choice((1, 2, 30, 1024 - w["e"], 1025 - w["e"]))
        if more < 0:
            raise NoSuchThing
        w["e"], w["l"], w["u"] = w["e"] + more, w["l"] << more, w["u"] << more
        if rng.random() < 0.5:
            w["l"], w["u"] = w["l"] + rng.choice((-1, 0, 1)), w["u"] + rng.choice((-1, 0, 1))
    elif what == 4:
        w["e"] = max(0, number(rng, w["e"]))
    elif what == 5:
        w["l"], w["u"] = w["u"], w["l"]
    elif what == 6:
        w["u"] = w["l"] = rng.choice((w["u"], w["l"]))
    elif what == 7:
        step = m.blocks(b"STEP")[0][1]
        if len(step) != 65:
            raise NoSuchThing
        t0, t1, _, q = struct.unpack("<ddii", step[8:32])
        try:
            w["l"], w["u"] = (int(Fraction(t) / Fraction(2) ** q * (1 << w["e"])) for t in (t0, t1))
        except (ValueError, OverflowError):
            raise NoSuchThing from None
    else:
        w["l"], w["u"] = w["l"] - rng.randrange(3), w["u"] + rng.randrange(3)
    block[1] = put_witness(w)


def witness_places(m):
    block, w = witness_of(m)
    what, rng = m.rng.randrange(10), m.rng
    side = rng.choice("PQ")
    if what == 9:  # a vertex that two cells share, on both sides or on one
        v = rng.randrange(6)
        cells = [c for c, cell in enumerate(m.taken.cells) if v in cell] if m.taken.frames else [0, 1]
        w["i"], w["j"] = rng.choice(cells or [0]), rng.choice(cells or [0])
        w[side] = [(v, [1])]
        if rng.random() < 0.7:
            w["P"] = w["Q"] = [(v, [1])]
    elif what == 0:
        w["P"], w["Q"] = w["Q"], w["P"]
        if rng.random() < 0.7:
            w["i"], w["j"] = w["j"], w["i"]
    elif what == 1:
        cell = rng.choice("ij")
        w[cell] += rng.choice((1, -1, 1 << 31, 7))
    elif what == 2:
        w[rng.choice("ij")] = w[rng.choice("ij")]
    elif what == 3 and w[side]:
        k = rng.randrange(len(w[side]))
        w[side][k] = (rng.choice((w[side][k][0] + 1, w[side][k][0] - 1, rng.randrange(8), 1 << 31)), w[side][k][1])
    elif what == 4 and w[side]:
        k, j = rng.randrange(len(w[side])), rng.randrange(len(w[side]))
        w[side][k], w[side][j] = (w[side][j][0], w[side][k][1]), (w[side][k][0], w[side][j][1])
    elif what == 5 and w[side]:
        w[side].pop(rng.randrange(len(w[side])))
    elif what == 6:
        w[side].append((rng.randrange(6), rng.choice(([0], [1], [0, 0], w["g"]))))
    elif what == 7 and w[side]:  # the same vertex twice, with half of the weight each
        v, f = w[side].pop(rng.randrange(len(w[side])))
        w[side] = [(u, [2 * c for c in h]) for u, h in w[side]] + [(v, f), (v, list(f))]
    else:
        rng.shuffle(w[side])
    block[1] = put_witness(w)


def blocks_moved(m):
    what, rng = m.rng.randrange(8), m.rng
    group = rng.choice(m.groups)
    k = rng.randrange(len(group)) if group else 0
    if not group or what == 0:
        m.groups.insert(rng.randrange(len(m.groups) + 1), [])
    elif what == 1:
        del group[k]
    elif what == 2:
        group.insert(k, list(group[k]))
    elif what == 3:
        j = rng.randrange(len(group))
        group[k], group[j] = group[j], group[k]
    elif what == 4:
        group[k][0] = rng.choice((b"CLAM", b"STEP", b"TREE", b"TOKS", b"WITN", b"CMIT", b"XXXX", b"toks", b"\0\0\0\0"))
    elif what == 5:
        rng.choice(m.groups).append(group.pop(k))
    elif what == 6:
        group[k][1] += bytes(rng.choice((1, 4, 1)))
    elif len(m.groups) > 1:
        i = rng.randrange(1, len(m.groups))
        m.groups[i - 1 : i + 1] = [m.groups[i - 1] + m.groups[i]]


def from_another(m):
    """A block or a group of another proof."""
    other = m.rng.choice(m.others)
    if m.rng.random() < 0.5:
        block = m.rng.choice([block for group in other.groups for block in group])
        mine = [b for group in m.groups for b in group if b[0] == block[0]]
        if not mine:
            raise NoSuchThing
        target = m.rng.choice(mine)
        if block[0] == b"STEP" and len(target[1]) == 65 and m.rng.random() < 0.7:
            target[1] = block[1][:33] + target[1][33:]
        elif block[0] == b"CLAM":
            target[1] = block[1]
            m.fit_cells = m.fit_motion = m.rng.random() < 0.7
        else:
            target[1] = block[1]
    else:
        group = [list(block) for block in m.rng.choice(other.groups)]
        m.groups[m.rng.randrange(len(m.groups))] = group
        m.fit_motion = True


# ---- Mutations of the trajectory -----------------------------------------------------------------------------------------------------


def frames_of(m):
    if m.taken.frames is None:
        raise NoSuchThing
    if m.frames is None:
        m.frames, m.cells = copy.deepcopy(m.taken.frames), list(m.taken.cells)
    m.fit_motion = m.fit_motion or m.rng.random() < 0.95
    return m.frames


def unit_of(m):
    try:
        p = struct.unpack("<i", m.blocks(b"STEP")[0][1][24:28])[0]
    except (struct.error, NoSuchThing):
        p = -4
    return 2.0 ** max(-60, min(p, 0))


def positions(m):
    """A position moves by units, to the place or a coordinate of another, or by the distance."""
    rng, frames = m.rng, frames_of(m)
    for _ in range(rng.choice((1, 1, 2, 3))):
        frame = rng.choice(frames)
        v, u, axis = rng.randrange(len(frame)), rng.randrange(len(frame)), rng.randrange(3)
        what, unit = rng.randrange(9), unit_of(m)
        if what <= 2:
            frame[v][axis] += unit * rng.choice((1, -1, 2, -2, 3, 4, 8, -8, 16, rng.randrange(-200, 200)))
        elif what == 3:
            frame[v][axis] = frame[u][axis]
        elif what == 4:
            eta = struct.unpack("<d", m.groups[0][0][1][8:16])[0] if len(m.groups[0][0][1]) > 16 else 0.0
            if not 0 <= eta < 1e100:
                raise NoSuchThing
            frame[v][axis] = frame[u][axis] + rng.choice((1, -1)) * (eta + unit * rng.choice((0, 0, 1, -1)))
        elif what == 5:
            frame[v][:] = frame[u]
        elif what == 6:
            frame[v][axis] = -frame[v][axis]  # 0 becomes -0
        elif what == 7:
            frame[v], frame[u] = frame[u], frame[v]
        else:
            frame[v][axis] = rng.choice((frame[v][axis] + unit / 2, 1e300, 5e-324, 1e-300, 2.0**60 * unit + frame[v][axis], frame[v][axis] / 3))


def all_positions(m):
    """All frames are scaled by a power of two or moved; where p follows, the proof holds as before."""
    rng, frames = m.rng, frames_of(m)
    power = rng.choice((1, -1, 3, 10, -20))
    if rng.random() < 0.5:
        m.frames = [[[x * 2.0**power for x in p] for p in frame] for frame in frames]
        for block in m.blocks(b"STEP"):
            field(block, 24, "i", lambda n: n + power * (rng.random() < 0.9))
    else:
        axis, by = rng.randrange(3), unit_of(m) * rng.randrange(-99, 99)
        for frame in frames[rng.randrange(2) :]:
            for p in frame:
                p[axis] += by


def order_of_frames(m):
    rng, frames = m.rng, frames_of(m)
    what, k = rng.randrange(4), rng.randrange(len(frames))
    if what == 0 and len(frames) > 1:
        del frames[k]
    elif what == 1:
        frames.insert(k, copy.deepcopy(frames[k]))
    elif what == 2:
        j = rng.randrange(len(frames))
        frames[k], frames[j] = frames[j], frames[k]
    else:
        frames.append(copy.deepcopy(frames[-1]))


def cells_of_frames(m):
    """Another mesh; the hash of the cells may fit."""
    frames_of(m)
    rng, cells, count = m.rng, m.cells, len(m.frames[0])
    what, k = rng.randrange(5), rng.randrange(max(1, len(cells)))
    if what == 0 and cells:
        cell = list(cells[k])
        cell[rng.randrange(len(cell))] = rng.randrange(count)
        cells[k] = tuple(cell)
    elif what == 1 and cells:
        cells.pop(k)
    elif what == 2:
        size = rng.randrange(1, 4)
        cells.append(tuple(rng.randrange(count) for _ in range(size)))
        cells.sort(key=lambda cell: -len(cell))
    elif what == 3 and cells:
        cell = list(cells[k])
        rng.shuffle(cell)
        cells[k] = tuple(cell)
    else:
        for frame in m.frames:
            frame.append([float(rng.randrange(5)) for _ in range(3)])
    m.fit_cells = rng.random() < 0.95
    if not m.fit_cells:
        m.fit_motion = rng.random() < 0.5


def run_of(m):
    if m.taken.run is None:
        raise NoSuchThing
    if m.run is None:
        m.run = [[list(block) for block in group] for group in m.taken.run]
    m.fit_motion = m.fit_motion or m.rng.random() < 0.95
    return m.run


def counts_of_run(run):
    dimension = struct.unpack("<I", run[0][0][1][:4])[0]
    vertices = struct.unpack("<Q", run[0][1][1][:8])[0]
    return dimension, vertices


def line_of(m):
    run = run_of(m)
    try:
        dimension, vertices = counts_of_run(run)
        lines = [block for group in run for block in group if block[0] == b"LINE"]
        if dimension not in (2, 3) or vertices > 1000 or not lines:
            raise NoSuchThing
        k = m.rng.randrange(len(lines))
        counts = struct.unpack(f"<{vertices}I", lines[k][1][: 4 * vertices])
        total = sum(counts)
        if len(lines[k][1]) != 4 * vertices + 8 * total * (1 + dimension):
            raise NoSuchThing
    except (struct.error, IndexError):
        raise NoSuchThing from None
    return run, lines, k, dimension, vertices, counts, total


def world_lines(m):
    """A position or a time of a run; at the end of a window also the next one's first, or not."""
    rng = m.rng
    _, lines, k, dimension, vertices, counts, total = line_of(m)
    v = rng.randrange(vertices)
    b = rng.randrange(counts[v])
    at_time = 4 * vertices + 8 * (sum(counts[:v]) + b)
    at_place = 4 * vertices + 8 * total + 8 * dimension * (sum(counts[:v]) + b) + 8 * rng.randrange(dimension)
    if rng.random() < 0.3:
        field(lines[k], at_time, "d", lambda x: rng.choice((x + 2.0**-20, x - 2.0**-20, other_double(rng, x), x * (1 + 2.0**-50))))
        return
    unit = unit_of(m)
    if rng.random() < 0.4:  # beside the same coordinate of another breakpoint: S holds just so, or just not
        places = 4 * vertices + 8 * total
        other = places + 8 * dimension * rng.randrange(total) + (at_place - places) % (8 * dimension)
        x = struct.unpack("<d", lines[k][1][other : other + 8])[0]
        field(lines[k], at_place, "d", lambda _: x + unit * rng.choice((0, 0, 1, -1, 2, -2)))
        return
    change = rng.choice((unit, -unit, unit * rng.randrange(-2**30, 2**30), 0.25, -0.125, 1.0, None, None))
    before = lines[k][1][at_place : at_place + 8]
    field(lines[k], at_place, "d", lambda x: other_double(rng, x) if change is None else x + change)
    after = lines[k][1][at_place : at_place + 8]
    if rng.random() < 0.8:
        for line in lines:
            if line is not lines[k]:
                line[1] = line[1].replace(before, after)


def scene_of_run(m):
    """HEAD, MESH, LABL, EXCL; the proof's hashes and excluded pairs may fit."""
    rng, run = m.rng, run_of(m)
    block = rng.choice(run[0])
    if block[0] == b"HEAD":
        rng.choice((lambda: field(block, 0, "I", lambda n: 5 - n), lambda: field(block, 4, "I", lambda n: rng.randrange(3)),
                    lambda: field(block, 8, "d", lambda x: other_double(rng, x))))()
    elif block[0] == b"LABL" and block[1]:
        field(block, rng.randrange(len(block[1])), "B", lambda n: rng.choice((1 - n, 1 - n, 2)) & 255)
    elif block[0] == b"EXCL":
        rng.choice((lambda: field(block, 2 * rng.randrange(len(block[1]) // 2), "H", lambda n: n + rng.choice((1, -1))),
                    lambda: run[0].remove(block)))()
    elif block[0] == b"MESH" and len(block[1]) > 36:
        rng.choice((lambda: field(block, 32 + 4 * rng.randrange((len(block[1]) - 32) // 4), "I", lambda n: rng.randrange(8)),
                    lambda: field(block, 8 * rng.randrange(4), "Q", lambda n: n + rng.choice((1, -1, 1 << 62)))))()
    m.fit_cells = rng.random() < 0.9


def blocks_of_run(m):
    rng, run = m.rng, run_of(m)
    what = rng.randrange(6)
    k = rng.randrange(len(run))
    if what == 0:
        block = rng.choice([block for group in run for block in group])
        block[1] = some_bytes(rng, block[1])
    elif what == 1:
        del run[k:]
    elif what == 2:
        run.insert(k, [list(block) for block in run[k]])
    elif what == 3:
        group = run[k]
        if group:
            j = rng.randrange(len(group))
            rng.choice((lambda: group.pop(j), lambda: group.insert(j, group[j]), lambda: group.reverse()))()
    elif what == 4:
        winds = [block for group in run for block in group if block[0] == b"WIND"]
        if not winds:
            raise NoSuchThing
        block = rng.choice(winds)
        rng.choice((lambda: field(block, 0, "Q", lambda n: n + 1), lambda: field(block, 8, "d", lambda x: other_double(rng, x)),
                    lambda: field(block, 16, "d", lambda x: other_double(rng, x))))()
    else:
        some = [block for group in run for block in group if block[0] in (b"VELO", b"STAT")]
        if not some:
            raise NoSuchThing
        block = rng.choice(some)
        block[1] = some_bytes(rng, block[1])


STRUCTURED = [  # (weight, mutation)
    (4, payload_bytes), (3, token_deleted), (3, token_doubled), (3, tokens_swapped), (6, token_replaced), (4, token_inserted), (4, split_moved),
    (1, split_deep), (9, coefficients), (6, plane), (1, path_longer), (2, blocks_of_tokens), (1, numbers_longer), (3, step_fields), (2, units_finer), (3, steps_moved),
    (4, tree_numbers), (3, tree_shape), (2, tree_elsewhere), (4, claim_fields), (7, distance), (4, pairs_of_claim), (1, counts_of_claim),
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
