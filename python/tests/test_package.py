"""The package itself: examples, types, what is written from the schemas."""

from __future__ import annotations

import doctest
import importlib
import pkgutil
import re
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import ROOT

import trueness

MODULES = [info.name for info in pkgutil.walk_packages(trueness.__path__, "trueness.") if not info.name.endswith(("__main__", "_trueness"))]


@pytest.mark.parametrize("name", ["trueness", *MODULES])
def test_examples_run(name: str) -> None:
    result = doctest.testmod(importlib.import_module(name), optionflags=doctest.NORMALIZE_WHITESPACE)
    assert result.failed == 0


def test_there_are_examples() -> None:
    finder = doctest.DocTestFinder()
    examples = [e for name in ["trueness", *MODULES] for e in finder.find(importlib.import_module(name)) if e.examples]
    assert len(examples) >= 10


def test_pages_run() -> None:
    for page in (ROOT / "docs/python.md", ROOT / "python/README.md"):
        result = doctest.testfile(str(page), module_relative=False, optionflags=doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS)
        assert result.failed == 0 and result.attempted > 3, page


def test_what_is_written_from_the_schemas() -> None:
    told = subprocess.run([sys.executable, "python/generate.py", "--check"], capture_output=True, text=True, check=False)
    assert told.returncode == 0, told.stdout


def test_no_signature_says_any() -> None:
    for path in Path(trueness.__file__).parent.rglob("*.py*"):
        if path.suffix in (".py", ".pyi"):
            assert not re.search(r"\bAny\b", path.read_text()), path


@pytest.mark.parametrize("checker", ["mypy", "pyright"])
def test_types(checker: str) -> None:
    pytest.importorskip(checker)
    words = [sys.executable, "-m", checker, *(["--python-executable", sys.executable] if checker == "mypy" else [])]
    if checker == "pyright":
        words += ["--pythonpath", sys.executable]
    told = subprocess.run(words, cwd=ROOT / "python", capture_output=True, text=True, check=False)
    assert told.returncode == 0, told.stdout + told.stderr
