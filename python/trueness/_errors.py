"""Why there is no answer, with the words of the program."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Self


class TruenessError(Exception):
    """There is no answer.

    Attributes
    ----------
    causes : list of str
        What is wrong and what to do, then what led to it, as the program prints them.
    """

    causes: list[str]

    def __init__(self, *args: object) -> None:
        super().__init__(*args)
        self.causes = [str(argument) for argument in args[:1]]

    @classmethod
    def _made(cls, causes: Sequence[str], errno: int | None = None) -> Self:
        error = cls("\n  because: ".join(causes))
        error.causes = list(causes)
        if errno is not None and isinstance(error, OSError):
            error.errno = errno
        return error


class UsageError(TruenessError, ValueError):
    """The question is wrong: an argument, named with its row, or arguments that do not go together (exit status 2)."""


class UnanswerableError(TruenessError):
    """The question cannot be answered: what was read does not allow it (exit status 3)."""


class FileError(UnanswerableError, OSError):
    """A file cannot be read or written."""


class MissingFileError(FileError, FileNotFoundError):
    """A file is not there."""


class CancelledError(TruenessError):
    """The work was stopped."""


class InternalError(TruenessError):
    """A fault of the package itself: please report it with what caused it (exit status 4)."""


# Their name is that by which users know them.
for _error in (TruenessError, UsageError, UnanswerableError, FileError, MissingFileError, CancelledError, InternalError):
    _error.__module__ = "trueness"
