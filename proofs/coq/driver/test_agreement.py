# SPDX-License-Identifier: Apache-2.0
"""Both checkers of proofs, on good proofs and on broken ones. See test.sh.

A broken proof may still be right (a bit of a direction that does not matter): then both have to say so.
Sums and hashes are made right again after most changes, for else nothing behind them is looked at."""
import hashlib, json, pathlib, random, struct, subprocess, sys

bin_dir, scenes, work = map(pathlib.Path, sys.argv[1:4])
rng = random.Random(7)
seen = {}
failures = []

CRC = []
for i in range(256):
    for _ in range(8): i = i >> 1 ^ (0x82F63B78 if i & 1 else 0)
    CRC.append(i)


def crc32c(data):
    c = 0xFFFFFFFF
    for byte in data: c = CRC[(c ^ byte) & 255] ^ c >> 8
    return struct.pack("<I", c ^ 0xFFFFFFFF)


def blocks_of(data):
    """(kind, payload) of each block, commits too."""
    at, found = 16, []
    while at < len(data):
        kind, length = struct.unpack_from("<4sQ", data, at)
        found.append((kind.decode(), data[at + 12:at + 12 + length]))
        at += 16 + length
    return found


def block_file(content, blocks):
    """The file with these blocks; commits are made anew."""
    out = bytearray(b"\x89NOLI\r\n\x1a" + struct.pack("<I", 1) + content)
    group_begin, running, commits = 0, bytes(32), 0
    for kind, payload in blocks:
        if kind == "CMIT":
            group = hashlib.sha256(out[group_begin:]).digest()
            running = hashlib.sha256(running + group).digest()
            payload = struct.pack("<Q", commits) + group + running
            commits += 1
        head = kind.encode() + struct.pack("<Q", len(payload))
        out += head + payload + crc32c(head + payload)
        if kind == "CMIT": group_begin = len(out)
    return bytes(out)


def run(*command):
    result = subprocess.run([str(c) for c in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=300)
    return result.returncode, result.stdout.decode(errors="replace")


def own_claim(proof):
    """The words that ask for what a proof claims; none where it has no claim."""
    try:
        kind, c = blocks_of(proof.read_bytes())[0]
        source, dimension, flags, _, ring, eta = struct.unpack_from("<4BId", c)
        merged, = struct.unpack_from("<I", c, 48)
        pairs = struct.iter_unpack("<II", c[56 + 8 * merged:])
    except (OSError, IndexError, ValueError, struct.error):
        return []
    words = [f"dimension={dimension}", f"strict={flags & 1}", f"points={flags >> 1 & 1}", f"distance={eta!r}",
             f"ring={ring}", f"merged={merged}", "empty"]
    if source < 2: words.append("motion=" + ("linear", "rest")[source])
    excluded = ",".join(f"{a}-{b}" for a, b in pairs)
    if excluded and source < 2: words.append("excluded=" + excluded)
    if (excluded and source < 2) or merged: words.append("cells=" + c[16:48].hex())
    return words


def agree(name, proof, files, expected=None, asked=None):
    """Both checkers, asked for what the proof claims, or for something else."""
    words = [w for field in (own_claim(proof) if asked is None else asked) for w in ("--require", field)]
    one, other = (run(bin_dir / c, *words, proof, *files) for c in ("noli_check", "noli_check_verified"))
    seen[one[0]] = seen.get(one[0], 0) + 1
    same = one[0] == other[0] and one[1].split(":")[0] == other[1].split(":")[0]
    about_what_was_asked = one[1].startswith(("rejected: the claim: ", "rejected: the command line, --require"))
    if one[0] != 3 or about_what_was_asked: same = same and one[1] == other[1]
    if not same or one[0] not in (0, 1, 3) or (expected is not None and one[0] != expected):
        failures.append(name)
        print(f"{name}: {asked}: expected {expected}\n  {one}\n  {other}")


def noli(*arguments):
    code, text = run(bin_dir / "noli", *arguments)
    if code not in (0, 1): sys.exit(f"noli {arguments}: {code}\n{text}")


def write(name, data):
    path = work / name
    path.write_bytes(data if isinstance(data, bytes) else data.encode())
    return path


# Meshes in all the forms that a file may have

CELLS = [(0, 1, 2), (2, 1, 3), (4, 5, 6), (4, 6, 7)]
FLOATS = ["1.00000005960464477539062500001", "1.000000059604644775390625", "1.00000017881393432617187499999",
          "7.1e-46", "7.0064923216240853546186479164495806564013097093825788587854e-46", 
          "1.17549432e-38", "-0", "+3.25", ".5", "5.",
          "1e+2", "0e999", "0.0000000000000000000000000000000000000000000000001e10", "16777217", "-16777217.000001"]


def positions(step):
    """Two pairs of triangles, one above the other; the lower one rises."""
    flat = [(0, 0), (2, 0), (0, 2), (2.5, 2.125), (0, 0), (2, 0), (2, 2), (0, 2)]
    return [(x + 0.1 * v, y, (1.5 if v < 4 else step / 3) + v / 64) for v, (x, y) in enumerate(flat)]


def ply(kind, xs, real="double", end="\n", cells=CELLS, texts=None):
    code = {"double": "d", "float": "f"}[real]
    head = ["ply", f"format {kind} 1.0", "comment a b", f"element vertex {len(xs)}"]
    head += [f"property {real} {a}" for a in "xyz"] + ["property uchar more", f"element face {len(cells)}"]
    head += ["property list uchar int vertex_indices", "end_header", ""]
    out = end.join(head).encode()
    if kind == "ascii":
        rows = [" ".join(map(repr, x)) + " 9" for x in xs] if texts is None else [" ".join(t) + " x" for t in texts]
        return out + end.join(rows + [f"{len(c)}\t" + "  ".join(map(str, c)) for c in cells] + [""]).encode()
    order = ">" if kind.endswith("big_endian") else "<"
    for x in xs: out += struct.pack(order + "3" + code + "B", *x, 9)
    for c in cells: out += struct.pack(f"{order}B{len(c)}i", len(c), *c)
    return out


def obj(xs, style=0):
    n, out = len(xs), []
    for k, x in enumerate(xs):
        numbers = [("+" if style and i >= 0 else "") + format(i, ".17e" if style else ".17g") for i in x]
        more = " 1" if style and k % 2 else ""
        out.append("v " + " ".join(numbers[:2]) + (" \\\n " if style else " ") + numbers[2] + more)
    for c in CELLS:
        out.append("f " + " ".join(f"{i - n}//1" if style else str(i + 1) for i in c) + (" # x" if style else ""))
    return ("\r\n" if style else "\n").join((["# made", "g a", "vt 1 2"] if style else []) + out) + "\n"


def frames(name, ending, make):
    return [write(f"{name}{k}.{ending}", make(positions(k))) for k in range(3)]


good = []  # name, proof, files, exit code


def prove(name, files, code, *options):
    proof = work / f"{name}.noli"
    noli("verify", *files, "--proof", proof, "--no-check", *options)
    good.append((name, proof, files, code))


same = {"a": frames("a", "ply", lambda x: ply("ascii", x)),
        "b": frames("b", "ply", lambda x: ply("binary_little_endian", x)),
        "c": frames("c", "PLY", lambda x: ply("binary_big_endian", x, end="\r\n")),
        "d": frames("d", "obj", obj), "e": frames("e", "obj", lambda x: obj(x, 1))}
for name, files in same.items():
    prove(name, files, 0)
    agree(name + ", the proof of a", work / "a.noli", files, 0)
noli("verify", *same["a"], "--trajectory", work / "a.frames", "--no-check")
prove("frames", [work / "a.frames"], 0)
agree("frames, the proof of a", work / "a.noli", [work / "a.frames"], 0)
if (work / "a.noli").read_bytes() != (work / "frames.noli").read_bytes(): failures.append("frames: another proof than a")
prove("frames at rest", [work / "a.frames"], 0, "--static")
prove("strict", same["a"], 0, "--strict")
prove("rest", same["b"], 0, "--static")
two = range(2)
doubled = [(0, 1, 2), (6, 5, 3), (8, 9, 10, 11)]
prove("merged", [write(f"m{k}.ply", ply("ascii", positions(k)[:4] + positions(k), cells=doubled)) for k in two], 0,
      "--merge-identical")
mixed = CELLS[:3] + [(0, 1), (3,)]
prove("points", [write(f"p{k}.ply", ply("ascii", positions(k), cells=mixed)) for k in two], 0, "--points")
flat = [[(x, y + (k if v > 3 else 0), 0) for v, (x, y, z) in enumerate(positions(0))] for k in two]
prove("plane", [write(f"q{k}.ply", ply("ascii", flat[k], cells=[(0, 1), (1, 3), (4, 5)])) for k in two], 1)
through = [(x, y, z - (4 if v < 4 else 0)) for v, (x, y, z) in enumerate(positions(1))]
prove("near", same["a"], 1, "--min-distance", "1.2")
prove("contact", [same["a"][0], write("z.ply", ply("ascii", through))], 1)
texts = [[FLOATS[(3 * v + k) % len(FLOATS)] for k in range(3)] for v in range(8)]
rounded = ply("ascii", positions(0), real="float", texts=texts, cells=[(0, 1)])
prove("rounding", [write("r.ply", rounded)], 0, "--static")
for scene, until in (("bounce", "0.5"), ("plane_curtain", "0.02"), ("swinging_cloth", "0.1"), ("ring_in_box", "0.1")):
    text = json.loads((scenes / f"{scene}.json").read_text())
    text["record"] = "full"
    folder = work / scene
    noli("simulate", write(f"{scene}.json", json.dumps(text)), "--short", "--until", until, "-o", folder)
    good.append((scene, folder / "proof.blocks", [folder / "trajectory.blocks"], 0))


def by_hand():
    """At a distance: two edges with a common end, and W."""
    files = [write(f"w{k}.obj", f"v 0 0\nv 1 {k}\nv 2 0\nl 1 2 3\n") for k in range(2)]
    claim = b"\0\2\0\0" + struct.pack("<Id", 2, 0.5)
    cells = b"".join(struct.pack("<BIII", 2, a, a + 1, 0) for a in (0, 1))
    claim += hashlib.sha256(struct.pack("<QQ", 3, 2) + cells).digest()
    motion = b""
    for x, y in ((0, (0, 0)), (1, (0, 1)), (2, (0, 0))):
        motion += struct.pack("<Q8d", 2, 0, x, y[0], 0, 1, x, y[1], 0)
    step = struct.pack("<QddiiB", 0, 0, 1, -1, 0, 0) + hashlib.sha256(motion).digest()
    apart = b"\x09"                        # the first edge is to the left
    left = b"\x30\1\0\0\1" + b"\x0e" + apart + apart       # {0}, {1 2}: less 0; {0}, {2}; disjoint
    right = b"\x30\1\1\1\2" + apart + b"\x0e" + apart      # {0 1}, {2}: {0}, {2}; less 2; disjoint
    meets = b"\x20" + apart + apart                        # disjoint, but for their common end
    tokens = b"\x03\x04" + b"\x30\0\1" + left + right + meets + b"\x04"
    blocks = [("CLAM", claim + bytes(8)), ("CMIT", b""),
              ("STEP", step), ("TREE", b"\0\1\2"), ("TOKS", tokens), ("CMIT", b"")]
    good.append(("ring", write("ring.noli", block_file(b"PROF", blocks)), files, 0))


by_hand()
for name, proof, files, code in good: agree(name, proof, files, code)

# What is asked: the default, one field after another, several at once, and impossible fields

FIELDS = ["motion=linear", "motion=rest", "motion=run", "dimension=2", "dimension=3", "steps=1", "steps=2", "steps=3",
          "steps=4", "steps=1..1", "steps=1..2", "steps=2..2", "steps=2..", "steps=1..", "steps=2..9", "steps=9..",
          "strict", "strict=0", "points", "points=1", "distance=0", "distance=1e-9", "distance=0.5",
          "distance=1.2", "distance=1.25", "ring=1", "ring=2", "ring=3", "merged=0", "merged=1", "merged=4", "merged=9",
          "excluded=", "excluded=0-0", "excluded=0-1,1-1", "cells=" + "0" * 64, "empty", "empty=0"]
IMPOSSIBLE = ["", "=", "motion", "motion=", "motion=Rest", "dimension", "dimension=1", "dimension=4", "dimension=+2",
              "steps=0", "steps=-1", "steps=1.0", "steps=99999999999",
              "steps=0..1", "steps=2..1", "steps=..2", "steps=1..2..", "steps=1.2", "steps=1...2", "steps=1..99999999999",
              "steps=1.", "steps=.", "steps=..", "strict=", "strict=2", "strict=yes", "points=2",
              "distance", "distance=-1", "distance=-0", "distance=nan", "distance=inf", "distance=1e999", "distance=.5",
              "distance=1e-999", "distance=0x1", "distance=1 ", "ring=0", "ring=4294967296", "merged=", "merged=-1",
              "excluded", "excluded=1", "excluded=1-", "excluded=-1", "excluded=2-1", "excluded=1-2,", "excluded=,1-2",
              "excluded=1-2,1-2", "excluded=1-2,0-1", "excluded=1-2-3", "excluded=1-2", "cells=", "cells=" + "A" * 64,
              "cells=" + "0" * 63, "empty=", "from=0", "all"]
asking = random.Random(8)
for name, proof, files, code in good:
    agree(f"{name}, by default", proof, files, None, [])
    for field in FIELDS:
        other = [o for o in own_claim(proof) if o.split("=")[0] != field.split("=")[0]]
        if not field.startswith(("ring", "excluded=0", "merged")): agree(f"{name}, asked", proof, files, None, [field])
        agree(f"{name}, asked", proof, files, None, other + [field])
    for _ in range(10):
        some = {field.split("=")[0]: field for field in asking.sample(FIELDS, 4)}
        agree(f"{name}, asked", proof, files, None, list(some.values()))
for field in IMPOSSIBLE: agree("impossible", good[0][1], good[0][2], 3, [field])
agree("twice", good[0][1], good[0][2], 3, ["strict=0", "strict=0"])
cells = [field for field in own_claim(good[0][1]) if field.startswith("cells=")]
agree("in two words", good[0][1], good[0][2], None, ["excluded=1-2", "excluded=1-3,2-2"] + cells)
agree("in two words that descend", good[0][1], good[0][2], 3, ["excluded=1-3", "excluded=1-2"])

# Broken ones


def broken(name, data, files, expected=None): agree(name, write("broken", data), files, expected)


def flipped(data):
    at = rng.randrange(len(data))
    return data[:at] + bytes([data[at] ^ 1 << rng.randrange(8)]) + data[at + 1:]


def changed(payload):
    """Some bytes of a payload are others."""
    how = rng.randrange(5)
    at = rng.randrange(len(payload))
    if how == 0: return payload + bytes([rng.randrange(256)])
    if how == 1: return payload[:-1]
    telling = [0, 1, 3, 4, 6, 8, 0x0e, 0x12, 0x20, 0x30, 0x7f, 0x80, 0xff]
    if how == 2: return payload[:at] + bytes([rng.choice(telling)]) + payload[at + 1:]
    if how == 3: return payload[:at] + payload[at + 1:]
    return flipped(payload)


def field(payload, at, value): return payload[:at] + value + payload[at + len(value):]


STEP_FIELDS = {
    "T0 = T1": (8, struct.pack("<dd", 1, 1)), "T0 > T1": (8, struct.pack("<dd", 1, 0)), "nan": (8, b"\xff" * 8),
    "p": (24, struct.pack("<i", 1201)), "coarse p": (24, struct.pack("<i", 60)), "q": (28, struct.pack("<i", 7)),
    "kind": (32, b"\2"), "number": (0, b"\1"), "large number": (0, b"\xff" * 8)}
CLAIM_FIELDS = {
    "source": (0, b"\3"), "other source": (0, b"\1"), "dimension": (1, b"\4"), "strict": (2, b"\1"),
    "flags": (2, b"\4"), "points": (2, b"\2"), "zero": (3, b"\1"), "ring": (4, b"\0"),
    "ring without distance": (4, b"\2"), "-0": (15, b"\x80"), "distance": (8, struct.pack("<d", 1e-9)),
    "far": (8, struct.pack("<d", 64)), "nan": (14, b"\xf8\x7f")}

for name, proof, files, code in good:
    data = proof.read_bytes()
    blocks = blocks_of(data)
    small = len(data) < 100000
    for n in [0, 1, 15, 16, 40, len(data) - 1] + [rng.randrange(len(data)) for _ in range(3)]:
        broken(f"{name}, the first {n} bytes", data[:n], files, 3)
    for tail in (b"\0", b"x", bytes(16), data[16:]): broken(f"{name}, {len(tail)} bytes behind", data + tail, files, 3)
    for k in range(5): broken(f"{name}, flipped {k}", flipped(data), files, 3)
    broken(f"{name}, version", data[:8] + b"\2" + data[9:], files, 3)
    broken(f"{name}, content", data[:12] + b"TRAJ" + data[16:], files, 3)
    others = {"swapped": files[::-1] if len(files) > 1 else [], "one less": files[:-1], "one more": files + files[-1:],
              "others": [work / "d0.obj", work / "r.ply"], "missing": [work / "nothing.ply"], "a folder": [work]}
    for what, changed_files in others.items():
        agree(f"{name}, {what}", proof, changed_files, None if what.startswith("one ") and code == 1 else 3)
    if not small: continue
    if block_file(b"PROF", blocks) != data: sys.exit(f"{name}: not the same again")
    for i in sorted(rng.sample(range(len(blocks)), min(8, len(blocks)))):
        kind, payload = blocks[i]
        ways = {"without": [], "twice": [blocks[i]] * 2, "kind": [("TOKZ", payload)],
                "trailing": [(kind, payload + b"\0")]}
        for what, now in ways.items():
            if kind == "CMIT": continue
            broken(f"{name}, {what} {i} {kind}", block_file(b"PROF", blocks[:i] + now + blocks[i + 1:]), files)
    for i, table in ((2, STEP_FIELDS), (0, CLAIM_FIELDS)):
        for what, (at, value) in table.items():
            now = blocks[:i] + [(blocks[i][0], field(blocks[i][1], at, value))] + blocks[i + 1:]
            broken(f"{name}, {blocks[i][0]} {what}", block_file(b"PROF", now), files)
    inside = [i for i, (kind, payload) in enumerate(blocks) if kind in ("TOKS", "TREE", "WITN", "CLAM") and payload]
    for k in range(40):
        i = rng.choice(inside)
        now = blocks[:i] + [(blocks[i][0], changed(blocks[i][1]))] + blocks[i + 1:]
        broken(f"{name}, changed {k} {blocks[i][0]}", block_file(b"PROF", now), files)
        for part in ("steps=1..1", "steps=2.."):
            agree(f"{name}, changed {k} {blocks[i][0]}, {part}", work / "broken", files, None,
                  own_claim(work / "broken") + [part])

# Numbers of steps behind a witness, where some may be missing: ascending, and below 2^53
for name, proof, files, code in good:
    groups = [[]]
    for block in blocks_of(proof.read_bytes()):
        groups[-1].append(block)
        if block[0] == "CMIT": groups.append([])
    witness = [i for i, group in enumerate(groups) if len(group) > 1 and group[1][0] == "WITN"]
    if not witness: continue
    for number in (1, 2, 2**31, 2**53 - 1, 2**53, 2**62 - 1, 2**62, 2**63, 2**64 - 1):
        group = groups[witness[0]]
        later = [("STEP", field(group[0][1], 0, struct.pack("<Q", number)))] + group[1:]
        made = [block for g in groups[:witness[0] + 1] + [later, group] for block in g]
        for part in ([], ["steps=1..1"], ["steps=2.."], ["steps=2..2"], ["steps=3.."]):
            path = write("broken", block_file(b"PROF", made))
            agree(f"{name}, step {number}, {part}", path, files, None, own_claim(path) + part)
            last_only = [block for g in groups[:witness[0] + 1] + [later] for block in g]
            path = write("broken", block_file(b"PROF", last_only))
            agree(f"{name}, last step {number}, {part}", path, files, None, own_claim(path) + part)

# Runs that are not what the proof is about, or no runs
for name in ("bounce", "plane_curtain"):
    path = work / name / "trajectory.blocks"
    blocks = blocks_of(path.read_bytes())[:20]
    for k in range(12):
        i = rng.randrange(len(blocks))
        if blocks[i][0] == "CMIT" or not blocks[i][1]: continue
        now = blocks[:i] + [(blocks[i][0], changed(blocks[i][1]))] + blocks[i + 1:]
        agree(f"{name}, run {k}", work / name / "proof.blocks", [write("run.blocks", block_file(b"TRAJ", now))], 3)

# Block files of frames that are not what the proof is about, or no such files
blocks = blocks_of((work / "a.frames").read_bytes())
for k in range(40):
    i = rng.randrange(len(blocks))
    if blocks[i][0] == "CMIT": continue
    now = rng.choice([[(blocks[i][0], changed(blocks[i][1]))], [], [blocks[i]] * 2, [("FRAZ", blocks[i][1])]])
    made = block_file(b"FRMS", blocks[:i] + now + blocks[i + 1:])
    agree(f"frames, file {k}", work / "frames.noli", [write("other.frames", made)], 3)

# Texts that are no meshes, and such that are, against the proof of a
for k in range(150):
    kind = rng.choice("ade")
    path = same[kind][0]
    text = path.read_bytes()
    at = rng.randrange(len(text))
    by = rng.choice([b"", b"\0", b" ", b"\n", b"\r", b"0", b"-", b"+", b"_", b"x", b"nan", b"0x", b"e", b"#", b"\\",
                     b"/", b"1e999", b"1e-999", b"\t"])
    agree(f"text {k} {kind} {at} {by}", work / "a.noli",
          [write("text" + path.suffix, text[:at] + by + text[at + rng.randrange(2):])] + same[kind][1:])

# A window, and its step, that end when they begin: all sums and hashes are right.
for end in (0, -1):
    path = work / "bounce" / "trajectory.blocks"
    blocks = [list(b) for b in blocks_of(path.read_bytes())]
    first = next(i for i, b in enumerate(blocks) if b[0] == "WIND")
    begin, = struct.unpack_from("<d", blocks[first][1], 8)
    after = begin + end
    blocks[first][1] = field(blocks[first][1], 16, struct.pack("<d", after))
    made = block_file(b"TRAJ", blocks[:first + 5])
    proof = [list(b) for b in blocks_of((work / "bounce" / "proof.blocks").read_bytes())]
    number = next(i for i, b in enumerate(proof) if b[0] == "STEP")
    group_hash = blocks_of(made)[-1][1][8:40]
    proof[number][1] = field(field(proof[number][1], 16, struct.pack("<d", after)), 33, group_hash)
    stop = next(i for i in range(number, len(proof)) if proof[i][0] == "CMIT")
    broken(f"a window that ends at {end}", block_file(b"PROF", proof[:stop + 1]), [write("short.blocks", made)], 3)

print(f"exit codes: {dict(sorted(seen.items()))}; {len(failures)} disagreements")
sys.exit(1 if failures or set(seen) != {0, 1, 3} else 0)
