# SPDX-License-Identifier: Apache-2.0
"""Mutations of the trajectory that a proof is about; each takes a Mutant and changes it.

What this does not do: it chooses no mutation (mutate.py).
"""
import copy
import struct

from mutant import NoSuchThing, field, other_double, some_bytes


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
