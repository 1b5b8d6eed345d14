# SPDX-License-Identifier: Apache-2.0
"""Options that several functions have: one check and one message for each."""

from __future__ import annotations

import math
import os
from typing import Any, Dict, List, Optional, Sequence, Tuple

from ._errors import UsageError

ORDERS = ("checked", "natural", "given")
MOST_THREADS = 1024
LONGEST = 1e9  # seconds; more is no limit that anybody waits for


def whole(value: Any, name: str, least: int, greatest: int = 2**31 - 1) -> int:
    """Raises UsageError."""
    try:
        number = int(value)
    except (TypeError, ValueError, OverflowError):
        number = least - 1
    if number != value or not least <= number <= greatest:
        raise UsageError(f"{name}: expected a whole number from {least} to {greatest}, found {value!r}")
    return number


def dimension_of(value: Optional[int]) -> Dict[str, int]:
    """As an option; nothing for None."""
    if value not in (None, 2, 3):
        raise UsageError(f"dimension: expected 2 or 3, found {value!r}")
    return {} if value is None else {"dimension": int(value)}


def time_limit_of(value: Optional[float]) -> Dict[str, float]:
    """As an option; nothing for None."""
    if value is None:
        return {}
    seconds = _float(value, "time_limit")
    if not seconds > 0:
        raise UsageError(f"time_limit: expected a positive number of seconds, found {value!r}")
    return {"time_limit": min(seconds, LONGEST)}


def _float(value: Any, name: str) -> float:
    """Raises UsageError."""
    try:
        return float(value)
    except (TypeError, ValueError):
        raise UsageError(f"{name}: expected a number, found {value!r}") from None


def distance(value: float, name: str) -> float:
    """Finite and not negative. Raises UsageError."""
    number = _float(value, name)
    if not math.isfinite(number) or number < 0:
        raise UsageError(f"{name}: expected a finite number that is not negative, found {value!r}")
    return number


def choice(value: str, name: str, choices: Sequence[str]) -> str:
    """Raises UsageError."""
    if value not in choices:
        raise UsageError(f"{name}: expected one of {', '.join(choices)}; found {value!r}")
    return value


def words(value: Any) -> List[str]:
    """A list of texts; one text is a list of itself."""
    return [value] if isinstance(value, str) else [str(word) for word in value]


def refuse_options_of_files(options: Dict[str, Any]) -> None:
    """Raises UsageError unless they are as they are by default: frames are in memory."""
    defaults = {"order": "checked", "polygons": "fan"}
    for name, value in options.items():
        if value not in (None, [], defaults.get(name)):
            raise UsageError(f"{name}: is for frames in files; expected none with arrays")


def require_new(file: Any, force: bool, inputs: Sequence[Any] = ()) -> None:
    """Raises UsageError if something is there that may not be replaced: without ``force``, no file, or an input."""
    if not os.path.lexists(file):
        return
    if not force:
        raise UsageError(f"{os.fspath(file)} exists already; choose another name, or pass force=True")
    if os.path.islink(file) or not os.path.isfile(file):
        raise UsageError(f"{os.fspath(file)}: is not a plain file; choose another name")
    if any(os.path.exists(name) and os.path.samefile(file, name) for name in inputs):
        raise UsageError(f"{os.fspath(file)}: is read; choose another name")


def require_ending(file: Any, ending: str) -> None:
    """Raises UsageError."""
    if not os.fspath(file).endswith(ending):
        raise UsageError(f"{os.fspath(file)}: expected a name that ends in {ending}")


def stem(file: Any) -> str:
    """The file's name without folder and ending."""
    return os.path.splitext(os.path.basename(os.fspath(file)))[0]


def threads_of(value: int) -> int:
    """0: all. Raises UsageError."""
    return whole(value, "threads", 0, MOST_THREADS)


def view_options(
    view: Optional[Tuple[float, float, float]], size: Optional[Tuple[int, int]], zoom: Optional[str]
) -> Dict[str, Any]:
    """Of pictures. Raises UsageError."""
    options: Dict[str, Any] = {}
    if view is not None:
        options["view"] = [float(x) for x in view]
        if len(options["view"]) != 3 or not any(options["view"]):
            raise UsageError(f"view: expected three numbers that are not all 0, found {view!r}")
    if size is not None:
        if len(size) != 2:
            raise UsageError(f"size: expected width and height, found {size!r}")
        options["size"] = [whole(pixels, "size", 16, 8192) for pixels in size]
    if zoom is not None:
        options["zoom"] = str(zoom)
    return options
