# SPDX-License-Identifier: Apache-2.0
"""Small good proofs, for tests/proofs/run_mutants.py to break.

Many are written by `noli` about scenes of a few cells. Others, with all the tokens that it seldom has a use for (W, P, B, wide numbers),
come from a little prover here that tries directions at random and lets slow_check say which hold.

What this does not do: it searches for nothing cleverly, and a scene that it cannot prove is an error.
"""
import json
import os
import random
import struct
import subprocess
from fractions import Fraction

import slow_check
import slow_files
from proof_bytes import TokenCode, put_uint, put_witness, serialise, with_numbers


def ply(positions, cells, binary=False):
    faces = [c for c in cells if len(c) == 3]
    edges = [c for c in cells if len(c) == 2]
    points = [c for c in cells if len(c) == 1]
    form = "binary_little_endian" if binary else "ascii"
    head = f"ply\nformat {form} 1.0\nelement vertex {len(positions)}\nproperty double x\nproperty double y\nproperty double z\n"
    head += f"element face {len(faces) + len(points)}\nproperty list uchar int vertex_indices\n"
    head += f"element edge {len(edges)}\nproperty int vertex1\nproperty int vertex2\nend_header\n"
    if binary:
        body = b"".join(struct.pack("<3d", *p) for p in positions)
        body += b"".join(struct.pack(f"<B{len(c)}i", len(c), *c) for c in faces + points)
        return head.encode() + body + b"".join(struct.pack("<2i", *c) for c in edges)
    lines = [" ".join(map(repr, p)) for p in positions]
    lines += [" ".join(map(str, (len(c), *c))) for c in faces + points] + [" ".join(map(str, c)) for c in edges]
    return (head + "".join(line + "\n" for line in lines)).encode()


def obj(positions, cells):
    lines = ["v " + " ".join(map(repr, p)) for p in positions]
    lines += [{3: "f", 2: "l", 1: "p"}[len(c)] + " " + " ".join(str(v + 1) for v in c) for c in cells]
    return ("\n".join(lines) + "\n").encode()


class Case:
    """A good proof, the files of its trajectory, and the code that every checker should say."""

    def __init__(self, name, proof, files, extension, code):
        self.name, self.proof, self.files, self.extension, self.code = name, proof, files, extension, code


# ---- Scenes ------------------------------------------------------------------------------------------------------------------------

LOW = [(0.0, 0.0, 0.0), (4.0, 0.0, 0.0), (0.0, 4.0, 0.0)]
TWO = [(0, 1, 2), (3, 4, 5)]


def above(z, dx=0.0, dy=0.0):
    return LOW + [(1.0 + dx, 1.0 + dy, z), (1.5 + dx, 1.0 + dy, z), (1.0 + dx, 1.5 + dy, z)]


def scenes():
    """(name, frames as lists of positions, cells, options of noli verify)."""
    yield "two", [above(1.0), above(0.5)], TWO, []
    yield "three", [above(1.0), above(0.25, 0.5), above(2.0)], TWO, []
    yield "static", [above(1.0), above(0.25)], TWO, ["--static"]
    yield "strict", [above(1.0), above(0.25)], TWO, ["--strict"]
    yield "edges", [[(0.0, 0.0, 0.0), (2.0, 0.0, 0.0), (1.0, -1.0, 0.5), (1.0, 1.0, 0.25)],
                    [(0.0, 0.0, 0.0), (2.0, 0.0, 0.125), (1.0, -1.0, 0.25), (1.0, 1.0, 0.75)]], [(0, 1), (2, 3)], []
    yield "points", [[(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.5, 0.5, 0.25)], [(1.0, 0.5, 0.0), (0.0, 0.0, 0.0), (0.5, 0.75, 0.5)]], \
        [(0, 1)], ["--points"]
    # Two that pass each other where no fixed direction does: it needs T.
    yield "near", [[(-1.0, 0.0, 0.0), (-1.0, 1.0, 0.0), (0.0, -0.5, 0.0), (0.0, 1.5, 0.125)],
                   [(1.0, 0.0, 0.5), (1.0, 1.0, 0.5), (0.0, -0.5, 0.125), (0.0, 1.5, 0.0)]], [(0, 1), (2, 3)], []
    turn = [[(2.0, 0.0, 0.0), (-2.0, 0.0, 0.0), (3.0, 1.0, 0.0), (2.0, 4.0, 0.0)],
            [(-0.5, 2.0, 0.0), (0.5, -2.0, 0.0), (-3.0, 3.0, 0.0), (-3.0, -2.0, 0.0)]]
    yield "turn", turn, [(0, 1), (2, 3)], ["--dimension", "2"]
    yield "plane", [[(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (2.0, 2.0, 0.0), (3.0, 2.0, 0.0), (5.0, 5.0, 0.0)],
                    [(0.0, 0.5, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (1.0, 1.0, 0.0), (3.0, 1.0, 0.0), (5.0, 5.0, 0.0)]], \
        [(0, 1, 2), (3, 4), (5,)], ["--dimension", "2"]
    fan = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (-1.0, 0.0, 0.25), (0.0, -1.0, 0.0)]
    fan_cells = [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)]
    yield "fan", [fan, [(x, y + 0.125 * x, z + 0.25 * x * x) for x, y, z in fan]], fan_cells, []
    yield "fan strict", [fan, [(x, y, z + 0.5) for x, y, z in fan]], fan_cells, ["--strict"]
    double = fan + [(0.0, 1.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.5)]
    yield "merged", [double, [(x, y, z + 1.0) for x, y, z in double]], [*fan_cells, (5, 6, 7), (6, 5)], ["--merge-identical"]
    rough = [(0.1, 0.2, 0.3), (1.7, 0.1, 0.2), (0.3, 1.9, 0.1), (0.4, 0.3, 1.1), (1.2, 0.4, 1.3), (0.2, 1.1, 1.7)]
    yield "rough", [rough, [(x * 1.1, y - 0.05, z * 0.9) for x, y, z in rough]], TWO, []
    apart = ["--min-distance", "0.0625", "--min-distance-from-ring"]
    yield "fan apart", [fan, [(x, y + 0.125 * x, z + 0.25 * x * x) for x, y, z in fan]], fan_cells, [*apart, "1"]
    yield "two apart", [above(1.0), above(0.0625 + 2.0**-20)], TWO, [*apart, "2", "--strict"]
    # GROUPS: what one triangle is to the other is not looked at.
    yield "ignored", [above(1.0), above(-1.0)], TWO, ["--ignore", "groups.json"]
    yield "ignored, points", [[*above(1.0), (9.0, 9.0, 5.0), (9.0, 9.0, 6.0)], [*above(-1.0), (9.25, 9.0, 4.0), (9.0, 9.5, 6.0)]], TWO, \
        ["--ignore", "groups.json", "--points"]
    # These touch, or are too near.
    yield "ignored, but not all", [[*above(1.0), (1.0, 1.0, 2.0)], [*above(-1.0), (1.0, 1.0, -1.5)]], TWO, ["--ignore", "groups.json", "--points"]
    yield "two not apart", [above(1.0), above(0.03125)], TWO, [*apart, "2"]
    yield "vertex-face", [above(1.0), above(-1.0)], TWO, []
    yield "vertex-face late", [above(1.0), above(0.5), above(-0.25, 0.25)], TWO, []
    yield "rough contact", [rough, [(x * 1.1, y, z - 1.3 if z > 1 else z) for x, y, z in rough]], TWO, []
    yield "edge-edge", [[(0.0, 0.0, 0.0), (2.0, 0.0, 0.0), (1.0, -1.0, 1.0), (1.0, 1.0, 1.0)],
                        [(0.0, 0.0, 0.0), (2.0, 0.25, 0.0), (1.0, -1.0, -1.0), (0.75, 1.0, -0.5)]], [(0, 1), (2, 3)], []
    deck = [(0.0, 0.0, 0.0), (8.0, 0.0, 0.0), (0.0, 8.0, 0.0), (2.0, 2.0, -1.0), (2.0, 2.0, 1.0), (3.0, 2.0, 2.0)]
    yield "deck", [deck, deck], TWO, []
    yield "deck static", [deck], TWO, ["--static", "--strict"]
    yield "on edge", [above(1.0, -1.0), above(-1.0, -1.0)], TWO, []
    yield "on vertex", [[(0.0, 0.0, 0.0), (1.0, 0.0, 1.0)], [(0.0, 0.0, 0.0), (-1.0, 0.0, -1.0)]], [(0,), (1,)], []
    yield "plane contact", [turn[0], [(x, y, 0.0) for x, y, _ in [(-0.5, 2.0, 0), (0.5, -2.0, 0), (0.0, -3.0, 0), (0.25, 5.0, 0)]]], \
        [(0, 1), (2, 3)], ["--dimension", "2"]


def scene_of_run(plane):
    """Two windows of a sheet (in the plane: a chain) that flies, a post that stands and a rod that a script moves; sheet and rod are excluded."""
    curve = {"material": {"edge_stiffness": 0, "mass_per_length": 1}}
    sheet = {"chain": {"points": [[0, 1], [1, 1.5]], "segments": 2}} if plane else {"grid": {"size": [1, 1], "cells": [1, 1]}}
    material = {"edge_stiffness": 10, "mass_per_length": 1} if plane else {"young": 100, "density": 300, "thickness": 0.001}
    end = [] if plane else [0]
    post = [[0.25, 0.25, -2][: 3 - plane], [0.75, 0.25, -1][: 3 - plane]]
    rod = [[0.25, -3, -2][: 3 - plane], [0.75, -3, 2][: 3 - plane]]
    bodies = [{"name": "sheet", "mesh": sheet, "material": material, "velocity": [0.5, 0.25] + ([] if plane else [-1])},
              {"name": "post", "mesh": {"chain": {"points": post, "segments": 1}}, **curve, "pin": ["all"]},
              {"name": "rod", "mesh": {"chain": {"points": rod, "segments": 1}}, **curve}]
    return {"noli_scene": 1, "dimension": 2 if plane else 3, "duration": 0.02, "window": 0.01, "record": "full", "bodies": bodies,
            "scripts": [{"body": "rod", "path": [{"t": 0, "move": [0, 0, *end]}, {"t": 0.015, "move": [0.01, 0.5, *end]}, {"t": 0.1, "move": [0, 0, *end]}]}],
            "contact": {"exclude": [["sheet", "rod"]]}}


def run_noli(noli, folder, *arguments):
    result = subprocess.run([noli, *arguments], cwd=folder, capture_output=True, text=True, check=False)
    if result.returncode not in (0, 1):
        raise RuntimeError(f"noli {' '.join(arguments)}: exit code {result.returncode}\n{result.stdout[:2000]}{result.stderr[:2000]}")
    return result.returncode


def read(path):
    with open(path, "rb") as file:
        return file.read()


GROUPS = {"groups": {"low": [[0, 2]], "high": [[3, 5]]}, "ignore": [["low", "high"]]}


def written_by_noli(noli, folder):
    with open(os.path.join(folder, "groups.json"), "w", encoding="utf-8") as file:
        json.dump(GROUPS, file)
    for number, (name, frames, cells, options) in enumerate(scenes()):
        form = number % 3  # ASCII PLY, binary PLY, OBJ
        extension = "obj" if form == 2 else "ply"
        files = [obj(f, cells) if form == 2 else ply(f, cells, form == 1) for f in frames]
        paths = []
        for k, data in enumerate(files):
            paths.append(f"{number}-{k}.{extension}")
            with open(os.path.join(folder, paths[-1]), "wb") as file:
                file.write(data)
        code = run_noli(noli, folder, "verify", "--force", "--proof", "p.noli", "--threads", "1", "--no-check", *options, *paths)
        yield Case(name, read(os.path.join(folder, "p.noli")), files, extension, code)
    for name, plane in (("run", False), ("run in the plane", True)):
        with open(os.path.join(folder, "scene.json"), "w", encoding="utf-8") as file:
            json.dump(scene_of_run(plane), file)
        code = run_noli(noli, folder, "simulate", "scene.json", "--force", "--threads", "1", "-o", name)
        yield Case(name, read(os.path.join(folder, name, "proof.blocks")), [read(os.path.join(folder, name, "trajectory.blocks"))],
                   "blocks", code)


# ---- A little prover -------------------------------------------------------------------------------------------------------------

AXES = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1), (0, 0, 0)]


def separation(rng, step, n, x, y, begin, end, eta):
    """The bytes of S, in one of its forms, or of P where a plane at rest does."""
    kinds = [with_numbers(TokenCode.direction, n)]
    if all(-512 <= c < 512 for c in n):
        kinds.append(with_numbers(TokenCode.short_direction, n))
    if n in AXES:
        kinds.append(bytes([TokenCode.axis + AXES.index(n)]))
    w = 0
    while w * w < eta * eta * slow_check.dot(n, n):
        w += max(1, w // 2)
    if x.vertices and y.vertices:
        when = step.times(x.vertices + y.vertices, begin, end)
        low = min(slow_check.dot(n, step.at(v, t)) for v in x.vertices for t in when)
        high = max(slow_check.dot(n, step.at(v, t)) for v in y.vertices for t in when)
        nd = -((-(high + w)) // 1) + rng.randrange(3)
        if high + w < nd < low:
            s = rng.choice([0, 1, 5])  # all of it times 2^(s + 1), with shifts of their own
            kinds.append(with_numbers(TokenCode.half_space, [s + 1, *n, 0, 0, s, int(nd) << 1, 0, w << s + 1]))
    return rng.choice(kinds)


def path_of_edges(step, x, y, ring):
    """v0, then (c, v)...: fewer edges than the ring from a vertex of x to one of y, if there is such a path."""
    reached = {v: [v] for v in x.vertices}
    for m in range(min(ring, 256)):
        for v in sorted(reached):
            if v in y.vertices:
                return reached[v]
        if m + 1 == ring:
            break
        for c, cell in enumerate(step.cells):
            for v in [v for v in cell if v in reached and len(reached[v]) <= 2 * m + 1]:
                for after in cell:
                    reached.setdefault(after, reached[v] + [c, after])
    return None


def prove(rng, step, root, depth=14):
    tokens, stack = [], [(step.eta > 0, root, None, step.t0, step.t1, 0)]
    while stack:
        far, x, y, a, b, k = stack.pop()
        token, eta = None, step.eta if far else 0
        begin, end = Fraction(a, 1 << k), Fraction(b, 1 << k)
        other = x if y is None else y
        if len(x.labels) == 1 and len(other.labels) == 1 and step.claim.excludes(*x.labels, *other.labels):
            token = bytes([TokenCode.excluded])
        elif y is None:
            if x.children:
                token = bytes([TokenCode.parts if not step.claim.strict or rng.random() < 0.8 else TokenCode.both])
            else:
                token = bytes([TokenCode.both if step.claim.strict else TokenCode.one])
        else:
            directions = AXES[:6] + [tuple(rng.randrange(-9, 10) for _ in range(3)) for _ in range(200)]
            if not x.vertices or not y.vertices:
                directions = [(0, 0, 0), *directions[:8]]
            common = set(x.vertices) & set(y.vertices)
            if not common:
                rng.shuffle(directions)
                for n in directions[: 6 if x.children or y.children else 206]:
                    if step.separated(n, x, y, begin, end, eta):
                        token = separation(rng, step, n, x, y, begin, end, eta)
                        break
            if token is None and (x.children or y.children):
                token = bytes([TokenCode.left if x.children and (not y.children or rng.random() < 0.5) else TokenCode.right])
            if token is None and far:
                path = path_of_edges(step, x, y, step.claim.ring)
                if path and (len(path) > 1 or rng.random() < 0.3 or not common):
                    token = with_numbers(TokenCode.ring, [len(path) // 2, *path])
            if token is None and common:
                token = bytes([TokenCode.drop + rng.randrange(len(common))])
            if token is None:
                if k >= depth:
                    raise RuntimeError("the little prover has no proof")
                token = bytes([TokenCode.halve])
        tokens.append(token)
        reader = slow_files.Reader(token, "token")
        reader.u8()
        stack.extend(reversed(step.replaced(token[0], reader, far, x, y, a, b, k, 0)))
    return b"".join(tokens)


def claim_bytes(source, dimension, flags, ring, eta, digest, merged=(), excluded=()):
    result = struct.pack("<BBBBId", source, dimension, flags, 0, ring, eta) + digest
    for pairs in (merged, excluded):
        result += struct.pack("<I", len(pairs)) + b"".join(struct.pack("<2I", *pair) for pair in pairs)
    return result


def random_tree(rng, cells):
    if len(cells) == 1:
        return put_uint(cells[0] + 1)
    cut = rng.randrange(1, len(cells))
    return b"\0" + random_tree(rng, cells[:cut]) + random_tree(rng, cells[cut:])


def run_bytes(dimension, vertices, cells, scripted, pairs, groups, windows):
    """A trajectory.blocks; windows: (begin, end, for each vertex its breakpoints, (time, position))."""
    counts = [sum(len(c) == size for c in cells) for size in (3, 2, 1)]
    first = [[b"HEAD", struct.pack("<IId", dimension, 0, 1.0)],
             [b"MESH", struct.pack("<4Q", vertices, *counts) + b"".join(struct.pack(f"<{len(c)}I", *c) for c in cells)],
             [b"LABL", bytes(scripted)]]
    if pairs:
        first.append([b"EXCL", struct.pack("<I", len(pairs)) + b"".join(struct.pack("<2H", *pair) for pair in pairs) +
                      struct.pack(f"<{vertices}H", *groups)])
    parts = [first]
    for k, (begin, end, lines) in enumerate(windows):
        line = struct.pack(f"<{vertices}I", *map(len, lines)) + b"".join(struct.pack("<d", t) for mine in lines for t, _ in mine)
        line += b"".join(struct.pack(f"<{dimension}d", *place[:dimension]) for mine in lines for _, place in mine)
        parts.append([[b"WIND", struct.pack("<Qdd", k, begin, end)], [b"LINE", line], [b"VELO", bytes(8 * dimension * vertices)], [b"STAT", b"x"]])
    return serialise(parts, b"TRAJ")


def written_here(rng, files, source, dimension, flags, ring, eta, p, merged=(), excluded=(), witness=None, q=-1, witness_step=0):
    """A proof of these files; with a witness for one of the steps, which ends it."""
    claim = slow_check.Claim(claim_bytes(source, dimension, flags, ring, eta, bytes(32), merged, excluded))
    if source == 2:
        claim.excluded = None
    trajectory = slow_files.trajectory_of(claim, files)
    if source == 2:
        claim.excluded = excluded = trajectory.excluded
    hashed = slow_files.cells_hash(trajectory)
    parts = [[[b"CLAM", claim_bytes(source, dimension, flags, ring, eta, hashed, merged, excluded)]]]
    order = list(range(len(trajectory.cells)))
    rng.shuffle(order)
    tree = random_tree(rng, order)
    for k, (t0, t1, digest, motion) in enumerate(trajectory.steps()):
        refuted = witness is not None and k == witness_step
        payload = struct.pack("<Qddiib", k, t0, t1, p, q, refuted) + digest
        step = slow_check.Step(claim, trajectory, payload, lambda _, found=(t0, t1, digest, motion): found)
        if refuted:
            parts.append([[b"STEP", payload], [b"WITN", put_witness(witness)]])
            break
        tokens = prove(rng, step, slow_check.read_tree(tree, trajectory.cells, trajectory.labels))
        parts.append([[b"STEP", payload], *([[b"TREE", tree]] if k == 0 else []), [b"TOKS", tokens]])
    return serialise(parts, b"PROF")


def made_run(dimension, dip):
    """Two windows of an edge that goes up and down over a triangle (in the plane: an edge) with breakpoints of their own; a third cell is scripted."""
    base = [(0.0, 0.0, 0.0), (4.0, 0.0, 0.0), (0.0, 4.0, 0.0)] if dimension == 3 else [(0.0, 0.0, 0.0), (4.0, 0.0, 0.0), (2.0, -1.0, 0.0)]
    cells = [(0, 1, 2), (3, 4), (5,)] if dimension == 3 else [(0, 1), (2, 0), (3, 4), (5,)]

    def lifted(x, y, height):
        return (x, y, height) if dimension == 3 else (x, 1.0 + height, 0.0)

    def line(begin, end, inner):
        return [(begin, inner[0]), *zip([begin + 0.125 * k for k in range(1, len(inner) - 1)], inner[1:-1]), (end, inner[-1])]

    windows = []
    more = [(2.0, 2.25, (1.0, 1.0))] if dip < 0 else []
    for begin, end, heights in [(0.5, 1.25, (1.0, 0.5, 0.75, 0.625)), (1.25, 2.0, (0.625, dip, 1.0)), *more]:
        lines = [[(begin, place), (end, place)] for place in base]
        lines.append(line(begin, end, [lifted(1.0, 1.0, h) for h in heights]))
        lines.append(line(begin, end, [lifted(1.5, 1.0, h) for h in (heights[0], heights[-1])]))
        lines.append(line(begin, end, [(9.0, 9.0, 0.0), (9.0, 9.5, 0.0), (9.0, 9.0, 0.0)]))
        windows.append((begin, end, lines))
    return run_bytes(dimension, 6, cells, [0, 0, 0, 0, 0, 1], [(1, 2)], [0, 0, 0, 1, 1, 2], windows)


def from_here(seed):
    rng = random.Random(seed)
    strip = [(float(x), float(y), 0.25 * x * y) for x in range(4) for y in range(2)]
    strip_cells = [c for x in range(3) for c in ((2 * x, 2 * x + 1, 2 * x + 2), (2 * x + 1, 2 * x + 3, 2 * x + 2))]
    bent = [(x, y, z + 0.125 * x * x) for x, y, z in strip]
    for name, arguments in {
            "far": ([above(1.0), above(0.5)], TWO, 0, 3, 0, 1, 0.25, -4),
            "far, just": ([above(1.0), above(0.5)], TWO, 0, 3, 0, 1, 0.5 - 2.0**-6, -6),
            "ring 1": ([strip, bent], strip_cells, 0, 3, 0, 1, 2.0**-4, -8),
            "ring 2": ([strip, bent], strip_cells, 0, 3, 0, 2, 2.0**-2, -8),
            "ring 3": ([strip, bent], strip_cells, 0, 3, 1, 3, 2.0**-1, -8),
            "ring, static": ([strip, bent], strip_cells, 1, 3, 1, 2, 2.0**-3, -8),
            "by hand": ([strip, bent, strip], strip_cells, 0, 3, 1, 1, 0.0, -5),
            "near, far": ([[(-1.0, 1.0, 0.0), (-1.0, 2.0, 0.0), (0.0, -0.5, 0.0), (0.0, 1.5, 0.0)],
                           [(1.0, 3.0, 0.0), (1.0, 4.0, 0.0), (0.0, -0.5, 0.0), (0.0, 1.5, 0.0)]], [(0, 1), (2, 3)], 0, 2, 0, 1, 0.125, -4),
            "loose, far": ([[(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 2.0, 1.0), (3.0, 3.0, 3.0)],
                            [(1.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 2.0, 2.0), (3.0, 3.0, 1.0)]], [(0, 1), (2,)], 0, 3, 2, 1, 0.5, -2),
            "all excluded": ([above(1.0), above(-1.0)], TWO, 0, 3, 0, 1, 0.0, -2, (), ((0, 0),)),
            "merged, far": ([strip + [strip[0], (9.0, 9.0, 9.0)], bent + [bent[0], (9.0, 9.0, 8.0)]], [*strip_cells, (8, 9), (9, 8), (8,)],
                            0, 3, 0, 1, 2.0**-6, -9, ((8, 0),)),
    }.items():
        files = [ply(frame, arguments[1]) for frame in arguments[0]]
        yield Case(name, written_here(rng, files, *arguments[2:]), files, "ply", 0)
    for name, dimension, dip, flags, ring, eta in (("a made run", 3, 0.25, 1, 1, 0.0), ("a made run, far", 3, 0.5, 0, 1, 0.25),
                                                   ("a made run in the plane, far", 2, -0.5, 0, 2, 0.125)):
        files = [made_run(dimension, dip)]
        yield Case(name, written_here(rng, files, 2, dimension, flags, ring, eta, -6, q=-5), files, "blocks", 0)
    # In the second window vertex 3 falls from 0.625 at 1.25 s to -0.125 at 1.375 s: at the height 0 when 5/6 of that are over. Times are in 1/32 s.
    meets = {"i": 1, "j": 0, "P": [(3, [1])], "Q": [(0, [2]), (1, [1]), (2, [1])], "g": [-130, 3], "e": 2, "l": 161, "u": 175}
    files = [made_run(3, -0.125)]
    yield Case("a made run that meets", written_here(rng, files, 2, 3, 0, 1, 0.0, -6, (), (), meets, -5, 1), files, "blocks", 1)
    nears = {"i": 0, "j": 1, "P": [(0, [2]), (1, [1]), (2, [1])], "Q": [(3, [1])], "g": [-44, 1], "e": 0, "l": 44, "u": 44}
    files = [made_run(3, 0.25)]
    yield Case("a made run that nears", written_here(rng, files, 2, 3, 0, 1, 0.375, -6, (), (), nears, -5, 1), files, "blocks", 1)

    for name, arguments, witness in (
            # One point over the middle of a triangle, nearer than the distance at the end.
            ("too near", ([above(1.0), above(0.25)], TWO, 0, 3, 0, 1, 0.5, -4),
             {"i": 1, "j": 0, "P": [(3, [1])], "Q": [(0, [2]), (1, [1]), (2, [1])], "g": [-2, 1], "e": 0, "l": 2, "u": 2}),
            ("too near for a while", ([above(1.0), above(0.125)], TWO, 0, 3, 0, 1, 0.75, -4),
             {"i": 1, "j": 0, "P": [(3, [1])], "Q": [(0, [2]), (1, [1]), (2, [1])], "g": [-3, 2], "e": 1, "l": 2, "u": 4}),
            ("near by ring 2", ([strip, bent], strip_cells, 0, 3, 0, 2, 2.25, -8),
             {"i": 0, "j": 4, "P": [(1, [1])], "Q": [(4, [1]), (5, [1])], "g": [0, 1], "e": 0, "l": 0, "u": 0}),
            ("wide interval", ([above(1.0), above(-1.0)], TWO, 0, 3, 0, 1, 0.0, -2),
             {"i": 1, "j": 0, "P": [(3, [3, 0, 1])], "Q": [(0, [2]), (1, [1]), (2, [1])], "g": [-1, 1], "e": 3, "l": 3, "u": 11}),
    ):
        files = [ply(frame, arguments[1]) for frame in arguments[0]]
        yield Case(name, written_here(rng, files, *arguments[2:], witness=witness), files, "ply", 1)


def corpus(noli, folder, seed=1):
    cases = [*written_by_noli(noli, folder), *from_here(seed)]
    for case in cases:
        code, words = slow_check.check(case.proof, case.files)
        if code != case.code:
            raise RuntimeError(f"the good proof {case.name}: expected {case.code}, found {code}: {words}")
    return cases
