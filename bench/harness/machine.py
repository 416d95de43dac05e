"""Where and with what a run was taken."""
import os
import platform
import re
import subprocess


def describe():
    """Processor, cores, memory, system, compiler, commit of this project."""
    return {
        "processor": _first("/proc/cpuinfo", r"model name\s*:\s*(.*)") or platform.processor() or platform.machine(),
        "vector": [w for w in ("avx2", "avx512f") if w in (_first("/proc/cpuinfo", r"flags\s*:\s*(.*)") or "").split()],
        "threads": os.cpu_count(),
        "memory_gib": round(int(_first("/proc/meminfo", r"MemTotal:\s*(\d+)") or 0) / 2**20, 1),
        "system": platform.platform(),
        "rustc": _said(["rustc", "--version"]),
        "commit": _said(["git", "-C", os.path.dirname(os.path.abspath(__file__)), "rev-parse", "--short=12", "HEAD"]),
    }


def versions(python, packages):
    """Version of each Python package that is installed for `python`."""
    script = (
        "import sys, json, importlib.metadata as m\n"
        "def v(p):\n"
        "    try: return m.version(p)\n"
        "    except m.PackageNotFoundError: return None\n"
        "print(json.dumps({p: v(p) for p in sys.argv[1:]}))"
    )
    import json

    found = json.loads(_said([python, "-c", script, *packages]) or "{}")
    return {name: version for name, version in found.items() if version}


def crate_version(lock, name):
    """Version of a crate in a Cargo.lock."""
    match = re.search(rf'name = "{name}"\nversion = "([^"]+)"', open(lock, encoding="utf-8").read())
    return match and match.group(1)


def _first(path, pattern):
    try:
        match = re.search(pattern, open(path, encoding="utf-8").read())
    except OSError:
        return None
    return match and match.group(1).strip()


def _said(command):
    try:
        return subprocess.run(command, capture_output=True, text=True, timeout=30).stdout.strip() or None
    except (OSError, subprocess.TimeoutExpired):
        return None
