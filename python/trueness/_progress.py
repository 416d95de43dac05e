"""Who is told how far the work is."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol, TypeAlias

#: Called with the name of the stage, the items done, their number where it is known, and what an item is.
Callback: TypeAlias = Callable[[str, int, "int | None", str], object]
#: A callback; ``True`` for a bar of tqdm, where that is installed.
Progress: TypeAlias = "Callback | bool | None"


class _Bar(Protocol):
    n: int

    def refresh(self) -> object: ...
    def close(self) -> object: ...


def callback(progress: Progress) -> Callback | None:
    """The function that is called; nothing for nobody."""
    if progress is None or progress is False:
        return None
    if progress is not True:
        return progress
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return None
    return _Bars(tqdm)


class _Bars:
    """A bar for each stage."""

    def __init__(self, make: Callable[..., _Bar]) -> None:
        self._make = make
        self._bar: _Bar | None = None
        self._stage: str | None = None

    def __call__(self, stage: str, done: int, total: int | None, unit: str) -> None:
        if stage != self._stage or self._bar is None:
            self._end()
            self._stage, self._bar = stage, self._make(total=total, desc=stage, unit=f" {unit}", unit_scale=True)
        self._bar.n = done if total is None else min(done, total)
        self._bar.refresh()
        if total is not None and done >= total:
            self._end()

    def _end(self) -> None:
        if self._bar is not None:
            self._bar.close()
        self._bar = None
