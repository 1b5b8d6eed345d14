# SPDX-License-Identifier: Apache-2.0
"""Mutations of a proof's tokens; each takes a Mutant and changes it.

What this does not do: it chooses no mutation (mutate.py).
"""

import corpus
import slow_files
from mutant import NoSuchThing, field, number, some_bytes
from proof_bytes import TokenCode, numbers_of, split_tokens, with_numbers

HALVE = bytes([TokenCode.halve])
DIRECTIONS = (TokenCode.short_direction, TokenCode.direction)


def payload_bytes(m):
    block = m.rng.choice([block for group in m.groups for block in group])
    block[1] = some_bytes(m.rng, block[1])


def tokens_of(m):
    block = m.block(b"TOKS")
    try:
        tokens = split_tokens(block[1])
    except slow_files.Rejected:
        raise NoSuchThing from None
    if not tokens:
        raise NoSuchThing
    return block, tokens, m.rng.randrange(len(tokens))


def random_token(rng, tokens):
    what = rng.randrange(8)
    if what == 0:
        return rng.choice(tokens)
    if what == 1:
        return with_numbers(TokenCode.short_direction, [rng.choice((0, 1, -1, rng.randrange(-512, 512))) for _ in range(3)])
    if what == 2:
        n = [rng.choice((0, 1, -1, rng.randrange(-10**6, 10**6), rng.randrange(-10**40, 10**40))) for _ in range(3)]
        return with_numbers(TokenCode.direction, n)
    if what == 3:
        n = [rng.choice((0, 0, 1, 3, 60))] + [rng.randrange(-3, 4) for _ in range(3)]
        n += [rng.randrange(9), rng.randrange(-2, 3), rng.randrange(9), rng.randrange(-30, 30), rng.randrange(9), rng.randrange(4)]
        return with_numbers(TokenCode.half_space, n)
    if what == 4:
        m = rng.choice((0, 1, 1, 2, 3, 256))
        return with_numbers(TokenCode.ring, [m] + [rng.randrange(6) for _ in range(2 * m + 1)])
    short = (*range(TokenCode.halve, TokenCode.empty + 2), *range(TokenCode.drop, TokenCode.last_drop + 2))  # three are no tokens
    return bytes([rng.choice((*short, rng.randrange(256)))])


def token_deleted(m):
    block, tokens, k = tokens_of(m)
    del tokens[k]
    block[1] = b"".join(tokens)


def token_doubled(m):
    block, tokens, k = tokens_of(m)
    tokens.insert(k, tokens[k])
    block[1] = b"".join(tokens)


def tokens_swapped(m):
    block, tokens, k = tokens_of(m)
    j = (k + 1) % len(tokens) if m.rng.random() < 0.5 else m.rng.randrange(len(tokens))
    tokens[k], tokens[j] = tokens[j], tokens[k]
    block[1] = b"".join(tokens)


def token_replaced(m):
    block, tokens, k = tokens_of(m)
    tokens[k] = random_token(m.rng, tokens)
    block[1] = b"".join(tokens)


def token_inserted(m):
    block, tokens, k = tokens_of(m)
    tokens.insert(m.rng.choice((k, len(tokens))), random_token(m.rng, tokens))
    block[1] = b"".join(tokens)


def split_moved(m):
    """T is moved, or put before a token that is then needed twice, which is good."""
    block, tokens, k = tokens_of(m)
    if HALVE in tokens and m.rng.random() < 0.6:
        tokens.remove(HALVE)
        tokens.insert(m.rng.randrange(len(tokens) + 1), HALVE)
    else:
        tokens[k : k + 1] = [HALVE] * m.rng.choice((1, 1, 1, 2)) + [tokens[k]] * m.rng.choice((2, 2, 2, 3))
    block[1] = b"".join(tokens)


def split_deep(m):
    """T again and again, up to and beyond the greatest denominator; the first obligations after it are S, X or F as before."""
    block, tokens, k = tokens_of(m)
    deep = m.rng.choice((3, 20, 100, 1023, 1024, 1025))
    tokens[k : k + 1] = [HALVE] * deep + [tokens[k]] * (deep + 1)
    block[1] = b"".join(tokens)


def coefficients(m):
    block, tokens, _ = tokens_of(m)
    with_some = [k for k, token in enumerate(tokens) if token[0] in (*DIRECTIONS, TokenCode.half_space, TokenCode.ring)]
    if not with_some:
        raise NoSuchThing
    k = m.rng.choice(with_some)
    kind, n = tokens[k][0], numbers_of(tokens[k])
    what = m.rng.randrange(5)
    if what <= 1:
        i = m.rng.randrange(len(n))
        n[i] = number(m.rng, n[i])
    elif what == 2 and kind != TokenCode.ring:
        factor = m.rng.choice((-1, 2, 3, -2, 1 << 30, 0))
        n = [c if kind == TokenCode.half_space and i in (0, 4, 6, 8) else c * factor for i, c in enumerate(n)]
    elif what == 3 and kind in DIRECTIONS:  # another form of the same
        short = kind == TokenCode.direction and all(-512 <= c < 512 for c in n)
        kind = TokenCode.short_direction if short else TokenCode.direction
    else:
        i, j = m.rng.randrange(len(n)), m.rng.randrange(len(n))
        n[i], n[j] = n[j], n[i]
    tokens[k] = with_numbers(kind, n)
    block[1] = b"".join(tokens)


def path_longer(m):
    """W whose path goes to and fro, up to and beyond the greatest length; the ring may be greater."""
    block, tokens, _ = tokens_of(m)
    some = [k for k, token in enumerate(tokens) if token[0] == TokenCode.ring]
    if not some:
        raise NoSuchThing
    k = m.rng.choice(some)
    n = numbers_of(tokens[k])
    more = m.rng.choice((1, 2, 255 - n[0], 256 - n[0], 300))
    cells = [c for c, cell in enumerate(m.taken.cells) if n[1] in cell] if m.taken.frames else [0]
    if more < 0 or not cells:
        raise NoSuchThing
    tokens[k] = with_numbers(TokenCode.ring, [n[0] + more, n[1]] + [m.rng.choice(cells), n[1]] * more + n[2:])
    block[1] = b"".join(tokens)
    field(m.groups[0][0], 4, "I", lambda ring: m.rng.choice((ring, n[0] + more, n[0] + more + 1, 1000)))


def plane(m):
    """S is written as P with a plane at rest, or nearly; bounds are met exactly, or missed by one."""
    block, tokens, _ = tokens_of(m)
    axes = {bytes([TokenCode.axis + i]): n for i, n in enumerate(corpus.AXES[:6])}
    some = [k for k, token in enumerate(tokens) if token in axes or token[0] in DIRECTIONS]
    if not some:
        raise NoSuchThing
    k = m.rng.choice(some)
    n = axes.get(tokens[k]) or numbers_of(tokens[k])
    shift = m.rng.choice((0, 0, 1, 4))
    n = [c << shift for c in n]
    long_shift = m.rng.choice((0, 1, 4095, 4096, 4097)) if m.rng.random() < 0.2 else 0
    nd = m.rng.randrange(-6, 7) << m.rng.choice((0, 1, 2, 3, 4, 8)) << shift
    nt, w = m.rng.choice((0, 0, 0, 1, -1)), m.rng.choice((0, 0, 1, -1, 4 << shift))
    tokens[k] = with_numbers(TokenCode.half_space, [0, *n, long_shift, nt, 0, nd, 0, w])
    block[1] = b"".join(tokens)


def blocks_of_tokens(m):
    """TOKS is cut in two (between tokens or within one), joined, or an empty one is added."""
    group = m.groups[m.step_group()]
    some = [i for i, block in enumerate(group) if block[0] == b"TOKS"]
    if not some:
        raise NoSuchThing
    i = m.rng.choice(some)
    payload, what = group[i][1], m.rng.randrange(4)
    if what == 0:
        group.insert(i, [b"TOKS", b""])
    elif what == 1 and i + 1 < len(group):
        group[i : i + 2] = [[b"TOKS", payload + group[i + 1][1]]]
    else:
        cut = m.rng.randrange(len(payload) + 1)
        if what == 2:
            try:
                tokens = split_tokens(payload)
            except slow_files.Rejected:
                raise NoSuchThing from None
            cut = len(b"".join(tokens[: m.rng.randrange(len(tokens) + 1)]))
        group[i : i + 1] = [[b"TOKS", payload[:cut]], [b"TOKS", payload[cut:]]]


def numbers_longer(m):
    """A number with a byte more than needed, or more than its place allows."""
    block = m.block(b"TOKS", b"TREE", b"WITN")
    payload = block[1]
    k = m.rng.randrange(len(payload)) if payload else 0
    block[1] = payload[:k] + bytes([payload[k] | 0x80 if payload else 0x80]) + b"\x80" * m.rng.choice((0, 0, 8, 9, 1199)) + \
        bytes([m.rng.randrange(2)]) + payload[k + 1 :]
