# SPDX-License-Identifier: Apache-2.0
"""Mutations of a proof's claim, steps, tree and of its blocks as a whole; each takes a Mutant and changes it.

What this does not do: it chooses no mutation (mutate.py).
"""
import struct

import corpus
import slow_check
import slow_files
from mutant import NoSuchThing, field, other_double
from proof_bytes import put_uint


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


def labels_of_cells(m):
    """A label changed, two swapped; labels where there are none, or none where there are."""
    first, rng = m.groups[0], m.rng
    there = [block for block in first if block[0] == b"LABL"]
    m.fit_cells = rng.random() < 0.8
    if not there:
        if m.taken.run is not None and rng.random() < 0.9:
            raise NoSuchThing
        cells = len(m.taken.cells) if m.taken.frames else 3
        labels = [rng.choice((0, 0, 1, 2, 7)) for _ in range(cells + rng.choice((0, 0, 0, 0, 1, -1)))]
        first.insert(rng.choice((1, 1, 1, 1, 0)), [b"LABL", struct.pack(f"<{len(labels)}I", *labels)])
        return
    block, what = there[0], rng.randrange(6)
    k = 4 * rng.randrange(max(1, len(block[1]) // 4))
    if what <= 2:
        field(block, k, "I", lambda n: rng.choice((0, 1, 2, n + 1, n ^ 1 << rng.randrange(32))))
    elif what == 3:
        block[1] = block[1][4:] + block[1][:4]
    elif what == 4:
        block[1] = rng.choice((bytes(len(block[1])), block[1][:-4], block[1] + b"\1\0\0\0", block[1][:-1]))
    else:
        first.remove(block)


def counts_of_claim(m):
    block, at = m.groups[0][0], 48
    field(block, m.rng.choice((at, len(block[1]) - 4)), "I", lambda n: m.rng.choice((n + 1, n - 1, 1 << 31, 1 << 29, (1 << 32) - 1)))


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
        group[k][0] = rng.choice((b"CLAM", b"LABL", b"STEP", b"TREE", b"TOKS", b"WITN", b"CMIT", b"XXXX", b"toks", b"\0\0\0\0"))
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
