#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A third checker of proof files, for tests: slow, exact, the standard library alone.

    slow_check.py PROOF FRAME...              frames: PLY or OBJ files
    slow_check.py PROOF trajectory.blocks     a run

It was written from proofs/FORMAT.md and trajectory/FORMAT.md and from nothing else, so that a mistake of the other checkers is not
made here too. slow_files.py reads the files. The codes of tokens are TokenCode of proof_bytes.py, which
tests/repository/token_codes_test.cpp compares with FORMAT.md. What a claim asks, and whether a proof answers it, is here. Numbers
are int and Fraction; each rule is spelled out where it is asked for. Exit codes and first words are those of FORMAT.md, section 7.

What this does not do: it holds everything in memory and is no good for anything large. Where those pages leave something
open, there is a comment that begins with OPEN.
"""
import math
import sys
from fractions import Fraction

from proof_bytes import TokenCode
from slow_files import Reader, Rejected, cells_hash, groups, need, trajectory_of


class Claim:
    def __init__(self, payload):
        r = Reader(payload, "CLAM")
        self.source, self.dimension, flags, zero = r.u8(), r.u8(), r.u8(), r.u8()
        need(self.source <= 2 and self.dimension in (2, 3) and flags < 4 and zero == 0, "CLAM")
        self.strict, self.points = bool(flags & 1), bool(flags & 2)
        need(not (self.points and self.source == 2), "CLAM: points of a run")
        self.ring, self.eta = r.u32(), r.f64()
        need(math.copysign(1, self.eta) > 0 and self.ring >= 1 and (self.eta > 0 or self.ring == 1), "CLAM: eta or ring")
        self.cells_hash = r.raw(32)
        merged = [(r.u32(), r.u32()) for _ in range(self.fits(r, r.u32()))]
        self.merged = dict(merged)
        need(all(a[0] < b[0] for a, b in zip(merged, merged[1:])), "CLAM: merged vertices do not ascend")
        need(all(s < v and s not in self.merged for v, s in merged), "CLAM: merged vertices")
        need(not (merged and self.source == 2), "CLAM: merged vertices of a run")
        self.excluded = [(r.u32(), r.u32()) for _ in range(self.fits(r, r.u32()))]
        need(all(a <= b for a, b in self.excluded), "CLAM: excluded pairs")
        need(all(a < b for a, b in zip(self.excluded, self.excluded[1:])), "CLAM: excluded pairs do not ascend")
        r.end()

    @staticmethod
    def fits(r, count):
        need(8 * count <= len(r.data) - r.at, "CLAM is too short")
        return count

    def excludes(self, a, b):
        return (min(a, b), max(a, b)) in self.excluded


class Group:
    def __init__(self, vertices, labels, children=None):
        self.vertices, self.labels, self.children = tuple(sorted(set(vertices))), frozenset(labels), children

    def without(self, v):
        return Group([u for u in self.vertices if u != v], self.labels)


def read_tree(payload, cells, labels):
    r, seen = Reader(payload, "TREE"), set()

    def node(depth):
        value = r.uint()
        if value:
            need(value <= len(cells) and value not in seen, "TREE: a cell")
            seen.add(value)
            return Group(cells[value - 1], [labels[value - 1]])
        need(depth < 255, "TREE: too deep")
        left = node(depth + 1)
        right = node(depth + 1)
        return Group(left.vertices + right.vertices, left.labels | right.labels, (left, right))

    root = node(0)
    need(len(seen) == len(cells), "TREE: a cell is missing")
    r.end()
    return root


def integer(number, power, what):
    numerator, denominator = number.as_integer_ratio()
    numerator, denominator = numerator << max(-power, 0), denominator << max(power, 0)
    need(numerator % denominator == 0, f"{what} is no multiple of its unit")
    return numerator // denominator


class Step:
    """One step in integers, and what is asked of it."""

    def __init__(self, claim, trajectory, payload, behind):
        """behind: steps of the trajectory, of which the one with the number of this is taken: a function of the number."""
        r = Reader(payload, "STEP")
        self.claim, self.cells, self.labels = claim, trajectory.cells, trajectory.labels
        self.number = r.u64()
        t0, t1, p, q, kind, digest = r.f64(), r.f64(), r.i32(), r.i32(), r.u8(), r.raw(32)
        r.end()
        need(abs(p) <= 1200 and abs(q) <= 1200 and kind <= 1, "STEP")
        begin, end, motion_hash, motion = behind(self.number)
        need(t0 == begin and t1 == end, "STEP: other times")  # OPEN: -0; as numbers they are equal
        need(digest == motion_hash, "STEP: another motion")
        self.witness, self.known = kind == 1, {}
        self.t0, self.t1 = integer(t0, q, "a time"), integer(t1, q, "a time")
        self.eta = integer(claim.eta, p, "eta")
        self.motion = [[(integer(time, q, "a time"), tuple(integer(x, p, "a position") for x in place)) for time, place in line]
                       for line in motion]

    def at(self, v, tau):
        if (v, tau) not in self.known:
            self.known[v, tau] = self.position(self.motion[v], tau)
        return self.known[v, tau]

    @staticmethod
    def position(line, tau):
        for (s, a), (t, b) in zip(line, line[1:]):
            if tau == s or tau == t:
                return a if tau == s else b
            if s < tau < t:
                return tuple(Fraction(x * (t - tau) + y * (tau - s), t - s) for x, y in zip(a, b))
        raise AssertionError("a time outside of the step")

    def times(self, vertices, begin, end):
        inner = {t for v in vertices for t, _ in self.motion[v] if begin < t < end}
        return [begin, *sorted(inner), end]

    # Section 3.
    def separated(self, n, x, y, begin, end, eta):
        if not x.vertices or not y.vertices:
            return True
        for tau in self.times(x.vertices + y.vertices, begin, end):
            delta = min(dot(n, self.at(v, tau)) for v in x.vertices) - max(dot(n, self.at(v, tau)) for v in y.vertices)
            if not (delta > 0 and delta * delta > eta * eta * dot(n, n)):
                return False
        return True

    def between_planes(self, n, nt, nd, w, x, y, begin, end, eta):
        if w < 0 or eta * eta * dot(n, n) > w * w:
            return False
        for group, holds in ((x, lambda value: value > 0), (y, lambda value: value < -w)):
            for v in group.vertices:
                for tau in self.times([v], begin, end):
                    if not holds(dot(n, self.at(v, tau)) + nt * tau - nd):
                        return False
        return True

    def prove(self, root, token_blocks):
        # An obligation: at distance?, x, y (None: x with itself), a, b, and the power of two that d is.
        stack = [(self.eta > 0, root, None, self.t0, self.t1, 0)]
        for payload in token_blocks:
            need(len(payload) <= 1 << 20, "TOKS is too long")
            r = Reader(payload, "TOKS")
            while r.more():
                start = r.at
                token = r.u8()
                need(stack, "a token too many")
                stack.extend(reversed(self.replaced(token, r, *stack.pop(), start)))
        need(not stack, "obligations are left")

    def replaced(self, token, r, far, x, y, a, b, k, start):
        def on(condition):
            need(condition, f"byte {start} of TOKS: token {token:02x} may not be used here")

        pair, when = y is not None, (a, b, k)
        d = 1 << k
        eta = self.eta if far else 0
        if token == TokenCode.halve:
            on(k < 1024)
            return [(far, x, y, 2 * a, a + b, k + 1), (far, x, y, a + b, 2 * b, k + 1)]
        if token == TokenCode.left:
            on(pair and x.children)
            return [(far, child, y, *when) for child in x.children]
        if token == TokenCode.right:
            on(pair and y.children)
            return [(far, x, child, *when) for child in y.children]
        if token == TokenCode.parts:
            on(not pair and x.children)
            left, right = x.children
            return [(far, left, None, *when), (far, left, right, *when), (far, right, None, *when)]
        if token == TokenCode.one:
            on(not pair and not x.children and not self.claim.strict)
            return []
        if token == TokenCode.both:
            on(not pair)
            return [(far, x, x, *when)]
        if token == TokenCode.excluded:
            other = y if pair else x
            on(len(x.labels) == 1 and len(other.labels) == 1 and self.claim.excludes(*x.labels, *other.labels))
            return []
        if TokenCode.axis <= token <= TokenCode.empty or token in (TokenCode.short_direction, TokenCode.direction):
            if token <= TokenCode.empty:
                n = ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1), (0, 0, 0))[token - TokenCode.axis]
            elif token == TokenCode.short_direction:
                bits = r.u32()
                need(bits < 1 << 30, "bits 30 and 31 of a direction")
                n = tuple(((bits >> shift & 1023) ^ 512) - 512 for shift in (0, 10, 20))
            else:
                n = (r.sint(), r.sint(), r.sint())
            on(pair and self.separated(n, x, y, Fraction(a, d), Fraction(b, d), eta))
            return []
        if token == TokenCode.half_space:
            shift = r.uint(4097)
            n = tuple(r.sint() << shift for _ in range(3))
            nt, nd, w = r.scaled(), r.scaled(), r.scaled()
            on(pair and self.between_planes(n, nt, nd, w, x, y, Fraction(a, d), Fraction(b, d), eta))
            return []
        if TokenCode.drop <= token <= TokenCode.last_drop:
            on(pair and not x.children and not y.children)
            common = [v for v in x.vertices if v in y.vertices]
            on(token - TokenCode.drop < len(common))
            v = common[token - TokenCode.drop]
            return [(far, x.without(v), y, *when), (far, x, y.without(v), *when)]
        if token == TokenCode.ring:
            m = r.uint(256)
            first = v = r.uint()
            steps = [(r.uint(), r.uint()) for _ in range(m)]
            on(pair and far and m < self.claim.ring and not x.children and not y.children)
            for c, after in steps:
                on(c < len(self.cells) and v in self.cells[c] and after in self.cells[c])
                v = after
            on(first in x.vertices and v in y.vertices)
            return [(True, x.without(first), y, *when), (True, x, y.without(v), *when), (False, x, y, *when)]
        raise Rejected(f"byte {start} of TOKS: there is no token {token:02x}")

    # Section 5.
    def holds(self, payload):
        r = Reader(payload, "WITN")
        i, j = r.u32(), r.u32()
        sets = []
        for _ in range(2):
            count = r.u8()
            need(1 <= count <= 3, "WITN: the number of vertices")
            sets.append([(r.u32(), r.poly()) for _ in range(count)])
        g, e = r.poly(), r.uint(8193)
        l, u = r.sint(), r.sint()
        r.end()
        need(i < len(self.cells) and j < len(self.cells), "WITN: there is no such cell")
        need(i != j or self.claim.strict, "WITN: a cell with itself")
        need(not self.claim.excludes(self.labels[i], self.labels[j]), "WITN: an excluded pair")
        for cell, points in zip((i, j), sets):
            need(all(v in self.cells[cell] for v, _ in points), "WITN: a vertex is not of its cell")
        p, q = ({v for v, _ in points} for points in sets)  # OPEN: a vertex twice in P; here its weights add up
        need(not p & q, "WITN: a vertex of both")
        scale = 1 << e
        need(self.t0 * scale <= l <= u <= self.t1 * scale, "WITN: the time")
        need(g[-1] != 0, "WITN: the last coefficient of g")
        low, high = (sum(c * l_or_u ** k * scale ** (len(g) - 1 - k) for k, c in enumerate(g)) for l_or_u in (l, u))
        need(low <= 0 <= high or low >= 0 >= high, "WITN: g has no change of sign")

        def signs(f):
            return bernstein(f, l, u, scale)

        sums = []  # (sum of weights, sum of weight times position)
        for points in sets:
            total, moment = [], [[], [], []]
            for v, w in points:
                need(divides(g, w) or min(signs(w), default=0) >= 0, "WITN: a negative weight")
                total = add(total, w)
                for axis, position in enumerate(self.polynomials(v, Fraction(l, scale), Fraction(u, scale))):
                    moment[axis] = add(moment[axis], times(w, position))
            need(min(signs(total), default=0) > 0, "WITN: weights without a positive sum")
            sums.append((total, moment))
        (big_w, x), (big_v, y) = sums
        difference = [add(times(big_v, a), times([-1], times(big_w, b))) for a, b in zip(x, y)]
        if all(divides(g, f) for f in difference):
            return
        need(self.eta > 0 and not self.joined(p, q), "WITN: the points do not meet")
        product = times(big_w, big_v)
        gap = times([self.eta * self.eta], times(product, product))
        for f in difference:
            gap = add(gap, times([-1], times(f, f)))
        need(divides(g, gap) or min(signs(gap), default=0) >= 0, "WITN: the points are not near")

    def polynomials(self, v, low, high):
        line = self.motion[v]
        k = max(k for k, (time, _) in enumerate(line) if time <= low)
        s, a = line[k]
        if k + 1 == len(line):
            need(low == high, "WITN: behind the last breakpoint")
            return [[Fraction(x)] for x in a]
        t, b = line[k + 1]
        need(high <= t, "WITN: beyond the segment of a vertex")
        return [[Fraction(x * t - y * s, t - s), Fraction(y - x, t - s)] for x, y in zip(a, b)]

    def joined(self, p, q):
        """Does a path of fewer than K edges join a vertex of p to one of q?"""
        reached, rounds = set(p), min(self.claim.ring - 1, len(self.motion))
        for _ in range(rounds):
            reached |= {v for cell in self.cells if reached.intersection(cell) for v in cell}
        return bool(reached & q)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


# Polynomials are lists of coefficients, the constant term first, without zeros at the end.
def trim(f):
    f = list(f)
    while f and f[-1] == 0:
        f.pop()
    return f


def add(f, g):
    f, g = (f, g) if len(f) >= len(g) else (g, f)
    return trim([a + (g[k] if k < len(g) else 0) for k, a in enumerate(f)])


def times(f, g):
    product = [0] * (len(f) + len(g) - 1) if f and g else []
    for i, a in enumerate(f):
        for j, b in enumerate(g):
            product[i + j] += a * b
    return trim(product)


def divides(g, f):
    rest = [Fraction(c) for c in trim(f)]
    while len(rest) >= len(g):
        factor, shift = rest[-1] / g[-1], len(rest) - len(g)
        for k, c in enumerate(g):
            rest[k + shift] -= factor * c
        rest = trim(rest)
    return not rest


def bernstein(f, l, u, scale):
    """The coefficients of f((l + u z) / (scale + scale z)) (scale + scale z)^n, n the degree of f; none for the polynomial 0."""
    f = trim(f)
    result = []  # Horner's scheme: result (l + u z) + c (scale + scale z)^m, m growing
    power = [1]
    for c in reversed(f):
        previous, result = result, [c * x for x in power]
        for k, x in enumerate(previous):
            result[k] += l * x
            result[k + 1] += u * x
        power = [scale * (a + b) for a, b in zip(power + [0], [0] + power)]
    return result


def check(proof, files):
    """(exit code, message) for the bytes of a proof and of the files of its trajectory."""
    try:
        return examine(proof, files)
    except Rejected as reason:
        return 3, f"rejected: {reason}"


def take_labels(claim, trajectory, payload):
    """Block LABL."""
    need(claim.source != 2, "LABL: of a run")
    need(len(payload) == 4 * len(trajectory.cells), "LABL: another number of cells")
    trajectory.labels = [int.from_bytes(payload[i : i + 4], "little") for i in range(0, len(payload), 4)]
    need(any(trajectory.labels), "LABL: all are 0")


def examine(proof, files):
    parts = groups(proof, b"PROF")
    first, _ = next(parts)
    need([kind for kind, _ in first] in ([b"CLAM"], [b"CLAM", b"LABL"]), "the first group")
    claim = Claim(first[0][1])
    trajectory = trajectory_of(claim, files)
    if len(first) == 2:
        take_labels(claim, trajectory, first[1][1])
    need(trajectory.cells, "a claim about no cells")  # OPEN: no step can have a TREE then; without steps nothing speaks against it
    need(cells_hash(trajectory) == claim.cells_hash, "CLAM: other cells")
    steps, tree, expected, refuted = trajectory.steps(), None, 0, None

    def step_of_trajectory(number):
        # OPEN: whether steps may be missing only directly behind a witness, or anywhere behind one; here anywhere.
        need(number == expected or (refuted is not None and number > expected), "STEP: another number")
        for _ in range(expected, number):
            need(next(steps, None) is not None, "STEP: the trajectory does not have it")
        found = next(steps, None)
        need(found is not None, "STEP: the trajectory does not have it")
        return found

    for blocks, _ in parts:
        need(blocks and blocks[0][0] == b"STEP", "expected STEP")
        step = Step(claim, trajectory, blocks[0][1], step_of_trajectory)
        expected = step.number + 1
        kinds = [kind for kind, _ in blocks[1:]]
        if step.witness:
            need(kinds == [b"WITN"], "expected one WITN")
            step.holds(blocks[1][1])
            refuted = step.number if refuted is None else refuted
        else:
            if kinds[:1] == [b"TREE"]:
                tree = read_tree(blocks[1][1], trajectory.cells, trajectory.labels)
                blocks, kinds = blocks[1:], kinds[1:]
            need(tree is not None, "no TREE")
            need(all(kind == b"TOKS" for kind in kinds), "expected TOKS")
            step.prove(tree, [payload for _, payload in blocks[1:]])
    need(expected > 0, "a claim about no steps")
    if refuted is not None:
        return 1, f"refuted: step {refuted} has a witness"
    need(next(steps, None) is None, "steps are missing")
    return 0, f"accepted: nothing touches in {expected} steps"


def main(arguments):
    try:
        need(len(arguments) >= 2, "the command line: expected a proof, and frames or a trajectory.blocks")
        contents = []
        for name in arguments:
            with open(name, "rb") as file:
                contents.append(file.read())
        code, message = check(contents[0], contents[1:])
    except Exception as error:  # whatever goes wrong is neither 0 nor 1
        code, message = 3, f"rejected: {error}"
    print(message)
    return code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
