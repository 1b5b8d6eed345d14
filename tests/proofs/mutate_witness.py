# SPDX-License-Identifier: Apache-2.0
"""Mutations of witnesses; each takes a Mutant and changes it.

What this does not do: it chooses no mutation (mutate.py).
"""
import struct
from fractions import Fraction

import slow_check
import slow_files
from mutant import NoSuchThing, number
from proof_bytes import get_witness, put_witness


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
        more = rng.choice((1, 2, 30, 8192 - w["e"], 8193 - w["e"]))
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
