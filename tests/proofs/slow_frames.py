# SPDX-License-Identifier: Apache-2.0
"""Frames, as slow_check.py reads them: PLY and OBJ files, written from proofs/FORMAT.md, section 8, and from nothing else.

What this does not do: it reads everything at once, and is slow. Where that page leaves something open, there is a comment that
begins with OPEN.
"""
import math
import re
import struct
from fractions import Fraction


class Rejected(Exception):
    pass


def need(condition, reason):
    if not condition:
        raise Rejected(reason)


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
