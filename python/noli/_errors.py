# SPDX-License-Identifier: Apache-2.0
"""The exceptions of Noli. A verdict is a result, never one of these, unless it is asked for."""

from __future__ import annotations

from typing import Any, Optional


class NoliError(Exception):
    """Base of all exceptions of this package."""


class InputError(NoliError, ValueError):
    """The input is at fault: a file or an array. The text says which, where, and what was expected."""


class UsageError(NoliError, ValueError):
    """The call is at fault: arguments that do not go together, a place that cannot be written to."""


class WriteError(NoliError, OSError):
    """Results could not be written: the disk is full, for example."""


class Stopped(NoliError):
    """Work ended early, because of the time limit."""


class NotProved(NoliError):
    """What ``raise_unless_proved()`` raises. ``result`` is what it was called on; of a Certifier, an Impact."""

    def __init__(self, text: str, result: Any) -> None:
        super().__init__(text)
        self.result = result


class Contact(NotProved):
    """Something touches.

    ``time`` is when first, in [0, 1] of the step, rounded down; None where cells intersect as the step begins.
    ``pairs`` are the listed contacts, as ``Result.contacts``, in no order; of a Certifier with the fields pair and
    vertices alone. ``result.features`` and ``result.point`` of a Certifier are those of the first contact.
    """

    def __init__(self, text: str, result: Any, time: Optional[float], pairs: Any) -> None:
        super().__init__(text, result)
        self.time = time
        self.pairs = pairs
