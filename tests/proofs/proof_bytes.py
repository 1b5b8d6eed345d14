# SPDX-License-Identifier: Apache-2.0
"""Block files, tokens and witnesses taken apart and put together again, for the tests that break proofs.

What this does not do: it checks nothing; what it is given to take apart is well-formed, or ValueError, IndexError or
slow_files.Rejected comes of it.
"""
import enum
import functools
import hashlib
import struct

import slow_files


class TokenCode(enum.IntEnum):
    # As in FORMAT.md, section 4; tests/repository/token_codes_test.cpp compares them.
    halve = 0x00
    left = 0x01
    right = 0x02
    parts = 0x03
    one = 0x04
    both = 0x05
    excluded = 0x06
    axis = 0x08
    last_axis = 0x0D
    empty = 0x0E
    short_direction = 0x10
    direction = 0x11
    half_space = 0x12
    drop = 0x20
    last_drop = 0x22
    ring = 0x30


@functools.lru_cache(maxsize=20000)
def checksum(data):
    return struct.pack("<I", slow_files.crc32c(data))


def block(kind, payload):
    head = kind + struct.pack("<Q", len(payload)) + payload
    return head + (checksum(head) if len(head) < 10000 else struct.pack("<I", slow_files.crc32c(head)))


def serialise(groups, content, spoil=None, commit=True):
    """spoil: None, or (which group, what of its commit: "number", "group", "running") to write wrong; commit: whether the last group has one."""
    pieces, running = [slow_files.MAGIC + b"\1\0\0\0" + content], bytes(32)
    whole = []
    for number, blocks in enumerate(groups):
        pieces += [block(kind, payload) for kind, payload in blocks]
        data = b"".join(pieces)
        whole.append(data)
        if not commit and number + 1 == len(groups):
            break
        group = hashlib.sha256(data).digest()
        wrong = spoil[1] if spoil and spoil[0] == number else None
        if wrong == "group":
            group = bytes([group[0] ^ 1]) + group[1:]
        running = hashlib.sha256(running + group).digest()
        if wrong == "running":
            running = bytes([running[0] ^ 1]) + running[1:]
        whole.append(block(b"CMIT", struct.pack("<Q", number + (wrong == "number")) + group + running))
        pieces = []
    return b"".join(whole)


def parse(data):
    """The groups of a good file, as lists of [kind, payload]."""
    groups, at, blocks = [], 16, []
    while at < len(data):
        kind, length = data[at : at + 4], int.from_bytes(data[at + 4 : at + 12], "little")
        if kind == b"CMIT":
            groups.append(blocks)
            blocks = []
        else:
            blocks.append([kind, data[at + 12 : at + 12 + length]])
        at += length + 16
    return groups


def put_uint(value):
    result = bytearray()
    while value >= 0x80:
        result.append(value & 0x7F | 0x80)
        value >>= 7
    result.append(value)
    return bytes(result)


def put_sint(value):
    return put_uint(2 * value if value >= 0 else -2 * value - 1)


def put_poly(f):
    return bytes([len(f) & 255]) + b"".join(map(put_sint, f))


def split_tokens(payload):
    reader, tokens = slow_files.Reader(payload, "TOKS"), []
    while reader.more():
        start, token = reader.at, reader.u8()
        if token == TokenCode.short_direction:
            reader.raw(4)
        elif token in (TokenCode.direction, TokenCode.half_space):
            for _ in range(3 if token == TokenCode.direction else 10):
                reader.groups_of_seven(1200)
        elif token == TokenCode.ring:
            for _ in range(2 * reader.uint() + 1):
                reader.uint()
        tokens.append(payload[start : reader.at])
    return tokens


def numbers_of(token):
    """The numbers of S, P and W."""
    reader, kind = slow_files.Reader(token, "token"), token[0]
    reader.u8()
    if kind == TokenCode.short_direction:
        bits = reader.u32()
        return [((bits >> shift & 1023) ^ 512) - 512 for shift in (0, 10, 20)]
    if kind == TokenCode.direction:
        return [reader.sint() for _ in range(3)]
    if kind == TokenCode.half_space:
        return [reader.uint(), *(reader.sint() for _ in range(3))] + [f() for _ in range(3) for f in (reader.uint, reader.sint)]
    if kind == TokenCode.ring:
        m = reader.uint()
        return [m, *(reader.uint() for _ in range(2 * m + 1))]
    return []


def with_numbers(kind, n):
    first = bytes([kind])
    if kind == TokenCode.short_direction:
        return first + struct.pack("<I", sum((c & 1023) << 10 * k for k, c in enumerate(n)))
    if kind == TokenCode.direction:
        return first + b"".join(map(put_sint, n))
    if kind == TokenCode.half_space:
        unsigned = (0, 4, 6, 8)
        return first + b"".join(put_uint(max(c, 0)) if k in unsigned else put_sint(c) for k, c in enumerate(n))
    return first + b"".join(put_uint(max(c, 0)) for c in n)


def get_witness(payload):
    r, w = slow_files.Reader(payload, "WITN"), {}
    w["i"], w["j"] = r.u32(), r.u32()
    for side in "PQ":
        w[side] = [(r.u32(), r.poly()) for _ in range(r.u8())]
    w["g"], w["e"], w["l"], w["u"] = r.poly(), r.uint(), r.sint(), r.sint()
    return w


def put_witness(w):
    result = struct.pack("<2I", w["i"] & 0xFFFFFFFF, w["j"] & 0xFFFFFFFF)
    for side in "PQ":
        result += bytes([len(w[side])]) + b"".join(struct.pack("<I", v & 0xFFFFFFFF) + put_poly(f) for v, f in w[side])
    return result + put_poly(w["g"]) + put_uint(max(w["e"], 0)) + put_sint(w["l"]) + put_sint(w["u"])
