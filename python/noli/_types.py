# SPDX-License-Identifier: Apache-2.0
"""Types that signatures share."""

from __future__ import annotations

import os
from typing import Any, Callable, Dict, Iterable, List, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._mesh import CollisionMesh

Path = Union[str, "os.PathLike[str]"]
Bodies = Dict[str, Union[Path, Sequence[Path]]]
Frames = Union[ArrayLike, Sequence[ArrayLike], Iterable[ArrayLike], Path, Sequence[Path], Bodies]
Mesh = Union[CollisionMesh, ArrayLike]
Json = Dict[str, Any]
Floats = NDArray[np.floating[Any]]
Integers = NDArray[np.int64]
Progress = Union[bool, Callable[[str, float], object], None]
Features = Tuple[Tuple[int, ...], Tuple[int, ...]]
CcdFunction = Callable[[str, NDArray[np.float64], NDArray[np.float64]], Any]
Claim = Union[Path, Json, None]
Names = List[str]
