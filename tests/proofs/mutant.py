# SPDX-License-Identifier: Apache-2.0
"""A good proof taken apart, a mutant that is made of it, and the small changes that all mutations use.

What this does not do: it chooses no mutation (mutate.py).
"""
import struct

import slow_check
import slow_files
from proof_bytes import parse


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
