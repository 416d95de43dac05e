"""The program ``trueness``: ``python -m trueness`` is the same."""

from __future__ import annotations

import signal
import sys

from . import _trueness


def main() -> int:
    """Runs the program with the words of the command line; its exit status."""
    # The program hears signals itself.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    sys.stdout.flush()
    return _trueness.main(["trueness", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
