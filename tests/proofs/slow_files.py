# SPDX-License-Identifier: Apache-2.0
"""The files that slow_check.py is about: block files, frames, runs; written from proofs/FORMAT.md and trajectory/FORMAT.md alone.

What this does not do: it reads everything at once, and is slow. Where those pages leave something open, there is a comment that
begins with OPEN.
"""
import functools
import hashlib
import math
import re
import struct
from fractions import Fraction

MAGIC = b"\x89NOLI\r\n\x1a"


class Rejected(Exception):
    pass


def need(condition, reason):
    if not condition:
        raise Rejected(reason)


# ---- Bytes -------------------------------------------------------------------------------------------------------------------------


def _table():
    table = []
    for n in range(256):
        for _ in range(8):
            n = (n >> 1) ^ (0x82F63B78 if n & 1 else 0)
        table.append(n)
    return table


_CRC = _table()


@functools.lru_cache(maxsize=1000)
def crc32c(data):
    crc, table = 0xFFFFFFFF, _CRC
    for byte in data:
        crc = (crc >> 8) ^ table[(crc ^ byte) & 0xFF]
    return crc ^ 0xFFFFFFFF


class Reader:
    """Reads a payload from its beginning to its end."""

    def __init__(self, data, what):
        self.data, self.at, self.what = data, 0, what

    def raw(self, size):
        need(size <= len(self.data) - self.at, f"{self.what} is too short")
        self.at += size
        return self.data[self.at - size : self.at]

    def u8(self):
        return self.raw(1)[0]

    def u16(self):
        return int.from_bytes(self.raw(2), "little")

    def u32(self):
        return int.from_bytes(self.raw(4), "little")

    def u64(self):
        return int.from_bytes(self.raw(8), "little")

    def i32(self):
        return int.from_bytes(self.raw(4), "little", signed=True)

    def f64(self):
        value = struct.unpack("<d", self.raw(8))[0]
        need(math.isfinite(value), f"{self.what}: a number is not finite")
        return value

    def many(self, count, letter):
        size = struct.calcsize("<" + letter)
        values = struct.unpack(f"<{count}{letter}", self.raw(count * size))
        need(letter != "d" or all(map(math.isfinite, values)), f"{self.what}: a number is not finite")
        return values

    def groups_of_seven(self, most):
        value = length = 0
        while True:
            need(length < most, f"{self.what}: a number is too long")
            byte = self.u8()
            value |= (byte & 0x7F) << 7 * length
            length += 1
            if byte < 0x80:
                need(byte != 0 or length == 1, f"{self.what}: a number has more bytes than needed")
                return value

    def uint(self, below=1 << 64):
        value = self.groups_of_seven(10)
        need(value < below, f"{self.what}: a number is out of range")
        return value

    def sint(self):
        value = self.groups_of_seven(1200)
        return -(value + 1) // 2 if value & 1 else value // 2

    def scaled(self):
        shift = self.uint(4097)
        return self.sint() << shift

    def poly(self):
        count = self.u8()
        need(1 <= count <= 32, f"{self.what}: a polynomial of {count} coefficients")
        return [self.sint() for _ in range(count)]

    def more(self):
        return self.at < len(self.data)

    def end(self):
        need(not self.more(), f"{self.what}: bytes behind its end")


def block_at(data, at):
    """(kind, payload, end), or None where the bytes are no block."""
    if len(data) - at < 12:
        return None
    length = int.from_bytes(data[at + 4 : at + 12], "little")
    if length > len(data) - at - 16:
        return None
    end = at + 12 + length
    if crc32c(data[at:end]) != int.from_bytes(data[end : end + 4], "little"):
        return None
    return data[at : at + 4], data[at + 12 : end], end + 4


def groups(data, content):
    """One group after another, each a list of (kind, payload), and its group hash.

    OPEN: proofs/FORMAT.md has "a checker refuses a file that ends in an open group", which may be the proof alone, since for trajectories
    such an end is no error in trajectory/FORMAT.md. Here it is any file, so whether its end is open or damaged makes no difference.
    """
    need(len(data) >= 16, "the file is too short")
    need(data[:8] == MAGIC, "no block file")
    need(data[8:12] == b"\1\0\0\0", "another version")
    need(data[12:16] == content, "another content")
    begin, at, running, number, blocks = 0, 16, bytes(32), 0, []
    while at < len(data):
        block = block_at(data, at)
        need(block is not None, f"byte {at}: no block; {number} groups were committed")
        kind, payload, end = block
        if kind == b"CMIT":
            reader = Reader(payload, "CMIT")
            need(reader.u64() == number, f"byte {at}: a commit with another number")
            group = hashlib.sha256(data[begin:at]).digest()
            running = hashlib.sha256(running + group).digest()
            need(reader.raw(32) == group and reader.raw(32) == running, f"byte {at}: a commit with another hash")
            reader.end()
            yield blocks, group
            begin, blocks, number = end, [], number + 1
        else:
            blocks.append((kind, payload))
        at = end
    need(begin == at and number > 0, f"an open group; {number} were committed")


# ---- Frames: proofs/FORMAT.md, section 9 -------------------------------------------------------------------------------------------

INTEGERS = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I", "int8": "b", "uint8": "B",
            "int16": "h", "uint16": "H", "int32": "i", "uint32": "I", "int64": "q", "uint64": "Q"}
TYPES = {**INTEGERS, "float": "f", "float32": "f", "double": "d", "float64": "d"}
# OPEN: which spellings are a decimal number.
DECIMAL = re.compile(rb"[+-]?(\d+(\.\d*)?|\.\d+)([eE][+-]?\d+)?\Z")


def decimal(word, letter="d"):
    """A decimal number, rounded once to the type of this letter."""
    need(DECIMAL.match(word), "no number")
    if letter not in "fd":
        need(re.match(rb"[+-]?\d+\Z", word), "no integer")
        value, bits = int(word), 8 * struct.calcsize(letter)
        low = 0 if letter.isupper() else -(1 << bits - 1)
        need(low <= value < low + (1 << bits), "out of range")
        return value
    value = float(word)
    need(math.isfinite(value), "infinite")
    zero = not re.search(rb"[1-9]", re.split(rb"[eE]", word)[0])
    if letter == "f" and not zero:
        need(len(word) < 400 and abs(math.log10(abs(value)) if value else -999) < 60, "out of range")
        exact = abs(Fraction(word.decode()))
        exponent = max(math.frexp(exact.numerator / exact.denominator)[1] - 24, -149)
        while exact >= Fraction(2) ** (exponent + 24):
            exponent += 1
        while exponent > -149 and exact < Fraction(2) ** (exponent + 23):
            exponent -= 1
        rounded = round(exact / Fraction(2) ** exponent) * Fraction(2) ** exponent  # round() goes to even
        need(rounded < Fraction(2) ** 128, "infinite")
        value = math.copysign(float(rounded), -1 if word.startswith(b"-") else 1)
    need(zero or value != 0, "rounded to 0")
    return value


def add_polygon(polygon, faces, edges, points):
    need(polygon, "a polygon without vertices")  # OPEN
    if len(polygon) == 1:
        points.append(tuple(polygon))
    elif len(polygon) == 2:
        edges.append(tuple(polygon))
    for second, third in zip(polygon[1:], polygon[2:]):
        faces.append((polygon[0], second, third))


def read_ply(data):
    lines, at = [], 0
    while not lines or lines[-1] != [b"end_header"]:
        end = data.find(b"\n", at)
        need(end >= 0, "a header without end")
        line, at = data[at:end], end + 1
        lines.append((line[:-1] if line.endswith(b"\r") else line).replace(b"\t", b" ").split(b" "))
        lines[-1] = [word for word in lines[-1] if word]
    need(lines[0] == [b"ply"], "no PLY file")
    form, elements = None, []
    for words in lines[1:-1]:
        text = [word.decode("latin-1") for word in words]
        need(text, "an empty line in the header")
        if text[0] == "format":
            need(form is None and len(text) == 3 and text[2] == "1.0", "format")
            form = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}.get(text[1])
            need(form is not None, "format")
        elif text[0] == "element":
            need(len(text) == 3 and text[2].isdigit() and text[1] != "tristrips", "element")
            elements.append((text[1], int(text[2]), []))
        elif text[0] == "property":
            need(elements, "a property before the first element")
            listed = len(text) == 5 and text[1] == "list"
            need(listed or len(text) == 3, "property")
            need(all(name in TYPES for name in text[2 if listed else 1 : -1]), "a type")
            need(not listed or text[2] in INTEGERS, "a length that is no integer")
            elements[-1][2].append((text[-1], TYPES[text[-2]], TYPES[text[2]] if listed else None))
        else:
            need(text[0] in ("comment", "obj_info"), "an unknown line in the header")
    need(form is not None, "no format")
    words, positions, faces, edges, points = [], [], [], [], []
    ascii_lines = iter([line for line in data[at:].replace(b"\r\n", b"\n").split(b"\n")]) if form == "" else None

    def number(letter):
        nonlocal at
        if form == "":
            need(words, "an entry is too short")
            return decimal(words.pop(), letter)
        size = struct.calcsize(form + letter)
        need(size <= len(data) - at, "the file is too short")
        at += size
        value = struct.unpack(form + letter, data[at - size : at])[0]
        need(math.isfinite(value), "a number is not finite")
        return value

    def length(letter):
        value = number(letter)
        need(0 <= value <= len(data), "the length of a list")
        return value

    for name, count, properties in elements:
        for _ in range(count):
            if form == "":
                words = []
                while not words:
                    line = next(ascii_lines, None)
                    need(line is not None, "the file is too short")
                    words = [word for word in line.replace(b"\t", b" ").split(b" ") if word][::-1]
            entry = {}
            for key, letter, count_letter in properties:
                entry[key] = number(letter) if count_letter is None else \
                    [number(letter) for _ in range(length(count_letter))]
            need(not words, "an entry is too long")
            if name == "vertex":
                need("x" in entry and "y" in entry, "a vertex without x or y")
                positions.append(tuple(float(entry.get(key, 0)) for key in "xyz"))
            elif name == "face":
                polygon = entry.get("vertex_indices", entry.get("vertex_index"))
                need(isinstance(polygon, list), "a face without vertices")
                add_polygon(polygon, faces, edges, points)
            elif name == "edge":
                need("vertex1" in entry and "vertex2" in entry, "an edge without vertices")
                edges.append((entry["vertex1"], entry["vertex2"]))
    if form == "":
        need(not any(line.strip(b" \t") for line in ascii_lines), "something behind the last entry")
    else:
        need(at == len(data), "something behind the last entry")
    return positions, faces, edges, points


SKIPPED = set(b"vt vn vp g o s mg usemtl mtllib usemap maplib lod bevel c_interp d_interp shadow_obj trace_obj".split())


def read_obj(data):
    positions, faces, edges, points, before = [], [], [], [], b""
    for line in data.replace(b"\r\n", b"\n").split(b"\n"):
        line = before + re.split(rb"(?:^|(?<=[ \t]))#", line)[0].rstrip(b" \t")
        before = b""
        if line.endswith(b"\\"):
            before = line[:-1] + b" "
            continue
        words = line.replace(b"\t", b" ").split()
        if not words or words[0] in SKIPPED:
            continue
        kind, words = words[0], words[1:]
        if kind == b"v":
            need(len(words) in (2, 3, 4, 6, 7), "a vertex")
            numbers = [decimal(word) for word in words]
            flat = len(words) == 2 if not positions else flat
            need((len(words) == 2) == flat, "a vertex without z among others")
            positions.append(tuple((numbers + [0.0])[:3]))
            continue
        need(kind in (b"f", b"l", b"p"), "an unknown statement")
        polygon = []
        for word in words:
            index = decimal(word.split(b"/")[0], "q")
            need(index != 0, "a vertex 0")
            polygon.append(index - 1 if index > 0 else len(positions) + index)
        need(len(polygon) >= {b"f": 3, b"l": 2, b"p": 1}[kind], "too few vertices")
        if kind == b"f":
            add_polygon(polygon, faces, edges, points)
        elif kind == b"l":
            edges.extend(zip(polygon, polygon[1:]))
        else:
            points.extend((index,) for index in polygon)
    need(before == b"", "the last line goes on")
    return positions, faces, edges, points


def read_frame(data):
    """Positions and cells. OPEN: how PLY and OBJ are told apart; here by the first line."""
    ply = data.startswith((b"ply\n", b"ply\r\n", b"ply ", b"ply\t"))
    positions, faces, edges, points = read_ply(data) if ply else read_obj(data)
    for cell in faces + edges + points:
        need(all(0 <= v < len(positions) for v in cell), "a vertex that is not there")
    return positions, not_redundant(faces + edges + points)


def not_redundant(cells):
    covered, kept = set(), []
    for cell in cells:
        if len(cell) == 3:
            kept.append(cell)
            covered.update(frozenset((cell[a], cell[b])) for a, b in ((0, 1), (1, 2), (0, 2)))
    for cell in cells:
        if len(cell) == 2 and frozenset(cell) not in covered:
            kept.append(cell)
            covered.add(frozenset(cell))
    used = {v for cell in kept for v in cell}
    for cell in cells:
        if len(cell) == 1 and cell[0] not in used:
            kept.append(cell)
            used.add(cell[0])
    return kept


# ---- The two kinds of trajectories ----------------------------------------------------------------------------------------------
# Each has vertices, cells and labels of the claim; and steps(), which yields (T0, T1, hash of the motion, breakpoints of each vertex).
# OPEN: whether what comes behind the last step of a proof with a witness has to be read, and so be in order. Here it is not read.


class Frames:
    def __init__(self, claim, files):
        self.claim, self.files, self.rest = claim, files, claim.source == 1
        need(len(files) >= (1 if self.rest else 2), "more frames are needed")  # OPEN: one frame has n - 1 = 0 steps, and a vacuous proof
        first, self.listed = read_frame(files[0])
        self.vertices, listed = len(first), self.listed
        if claim.points:
            used = {v for cell in listed for v in cell}
            listed = listed + [(v,) for v in range(self.vertices) if v not in used]
        need(all(v < self.vertices for v in claim.merged), "a merged vertex that is not there")
        self.cells = not_redundant([tuple(claim.merged.get(v, v) for v in cell) for cell in listed])
        self.labels = [0] * len(self.cells)

    def positions(self, k):
        positions, cells = read_frame(self.files[k])
        need(len(positions) == self.vertices and cells == self.listed, "frames that differ")
        return [(x, y, z if self.claim.dimension == 3 else 0.0) for x, y, z in positions]

    def steps(self):
        for k in range(len(self.files) - (not self.rest)):
            begin, end = (0.0, 1.0) if self.rest else (float(k), float(k + 1))
            motion = [((begin, a), (end, b)) for a, b in zip(self.positions(k), self.positions(k + (not self.rest)))]
            digest = hashlib.sha256()
            for line in motion:
                digest.update(struct.pack("<Q", len(line)))
                for time, position in line:
                    digest.update(struct.pack("<4d", *(number + 0.0 for number in (time, *position))))  # -0.0 + 0.0 is 0.0
            # OPEN: nothing says that merged vertices have to be at the same place; a checker that does not ask proves a claim about others.
            need(all(motion[v] == motion[s] for v, s in self.claim.merged.items()), "merged vertices that are not at the same place")
            yield begin, end, digest.digest(), motion


class Run:
    def __init__(self, claim, data):
        self.parts = groups(data, b"TRAJ")
        blocks = list(next(self.parts)[0])
        head = self.block(blocks, b"HEAD")
        self.dimension = head.u32()
        mode, length = head.u32(), head.f64()
        head.end()
        need(self.dimension in (2, 3) and mode in (0, 1) and length > 0, "HEAD")
        need(mode == 0, "the run does not have its motion")
        need(self.dimension == claim.dimension, "the run has another dimension")  # OPEN: follows, but is not said
        mesh = self.block(blocks, b"MESH")
        self.vertices, faces, edges, points = (mesh.u64() for _ in range(4))
        need(1 <= self.vertices <= 1 << 32, "MESH")
        self.cells = []  # OPEN: redundant ones are left out only when they have become so, by merging, of which a run has none
        for size, count in ((3, faces), (2, edges), (1, points)):
            self.cells += list(zip(*[iter(mesh.many(size * count, "I"))] * size))
        mesh.end()
        need(all(v < self.vertices for cell in self.cells for v in cell), "a vertex that is not there")
        labl = self.block(blocks, b"LABL")
        scripted = labl.raw(self.vertices)
        labl.end()
        need(max(scripted) <= 1, "LABL")
        group, pairs = [0] * self.vertices, set()
        if blocks:
            excl = self.block(blocks, b"EXCL")
            flat = excl.many(2 * excl.u32(), "H")
            listed = list(zip(flat[::2], flat[1::2]))
            need(listed and all(a <= b for a, b in listed), "EXCL")
            need(all(a < b for a, b in zip(listed, listed[1:])), "EXCL: pairs do not ascend")
            group, pairs = excl.many(self.vertices, "H"), set(listed)
            excl.end()
            need(all(group[v] == group[cell[0]] for cell in self.cells for v in cell), "a cell of two groups")
        need(not blocks, "a block that is not expected")
        self.labels = [2 * group[cell[0]] + all(scripted[v] for v in cell) for cell in self.cells]
        found = sorted(set(self.labels))
        self.excluded = [(a, b) for a in found for b in found
                         if a <= b and (a & b & 1 or (min(a // 2, b // 2), max(a // 2, b // 2)) in pairs)]
        need(claim.excluded in (None, self.excluded), "the excluded pairs are not those of the run")

    def steps(self):
        last = None
        for index, (blocks, group_hash) in enumerate(self.parts):
            blocks = list(blocks)
            wind = self.block(blocks, b"WIND")
            need(wind.u64() == index, "WIND: another index")
            begin, end = wind.raw(8), wind.raw(8)
            wind.end()
            t0, t1 = Reader(begin, "WIND").f64(), Reader(end, "WIND").f64()
            need(t0 < t1, "WIND: begin and end")
            line = self.block(blocks, b"LINE")
            counts = line.many(self.vertices, "I")
            need(min(counts) >= 2, "LINE: fewer than two breakpoints")
            motion, first = [], []
            for mine in [line.many(count, "d") for count in counts]:
                need(all(a < b for a, b in zip(mine, mine[1:])), "LINE: the times do not ascend")
                need(struct.pack("<d", mine[0]) == begin and struct.pack("<d", mine[-1]) == end, "LINE: begin or end")
                motion.append(mine)
            for v, mine in enumerate(motion):
                flat = line.many(len(mine) * self.dimension, "d")
                places = [flat[i : i + self.dimension] for i in range(0, len(flat), self.dimension)]
                motion[v] = [(t, place if self.dimension == 3 else (*place, 0.0)) for t, place in zip(mine, places)]
                first.append((begin, struct.pack("<3d", *motion[v][0][1])))
            line.end()
            need(last is None or first == last, "a window that does not go on where the one before ended")
            last = [(end, struct.pack("<3d", *mine[-1][1])) for mine in motion]
            velo = self.block(blocks, b"VELO")
            velo.many(self.vertices * self.dimension, "d")
            velo.end()
            self.block(blocks, b"STAT")
            need(not blocks, "a block that is not expected")
            yield t0, t1, group_hash, motion

    @staticmethod
    def block(blocks, kind):
        need(blocks and blocks[0][0] == kind, f"expected {kind.decode()}")
        return Reader(blocks.pop(0)[1], kind.decode())


def trajectory_of(claim, files):
    need(claim.source != 2 or len(files) == 1, "a run is one file")
    return Run(claim, files[0]) if claim.source == 2 else Frames(claim, files)


def cells_hash(trajectory):
    digest = hashlib.sha256(struct.pack("<QQ", trajectory.vertices, len(trajectory.cells)))
    for cell, label in zip(trajectory.cells, trajectory.labels):
        digest.update(struct.pack(f"<B{len(cell)}II", len(cell), *cell, label))
    return digest.digest()
