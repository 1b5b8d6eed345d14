# SPDX-License-Identifier: Apache-2.0
"""Names that several modules share, and the progress bar."""

from __future__ import annotations

import contextlib
from typing import NoReturn

import numpy as np

KINDS = np.array(["apart", "touching", "crossing", "persistent"])
PAIRS = np.array(["vertex_face", "edge_edge", "vertex_edge", "vertex_vertex"])
POINTS = {"vertex_face": (1, 3), "edge_edge": (2, 2), "vertex_edge": (1, 2), "vertex_vertex": (1, 1)}


def no_truth(self: object) -> NoReturn:
    """Raises TypeError: `if result:` could mean that something touches, or that nothing does."""
    raise TypeError(f"a {type(self).__name__} is neither true nor false; ask for its verdict or its numbers")


@contextlib.contextmanager
def progress_of(wanted):
    """What the module in C++ calls with the work and the share of it that is done; None: nothing."""
    if wanted is None or wanted is False:
        yield None
    elif wanted is not True:
        yield wanted
    else:
        with _bar() as tell:
            yield tell


@contextlib.contextmanager
def _bar():
    try:
        from tqdm.auto import tqdm
    except ImportError:
        yield _line
        print()
        return
    # It goes at the end: a contact ends the work before the bar is full.
    with tqdm(total=1.0, leave=False, bar_format="{desc} {percentage:3.0f} % |{bar}| {remaining}") as bar:

        def tell(work, share):
            if work != bar.desc:
                bar.reset(total=1.0)
                bar.set_description_str(work)
            bar.update(max(0.0, share - bar.n))

        yield tell


def _line(work, share):
    print(f"\r{work} {share:4.0%}", end="", flush=True)
