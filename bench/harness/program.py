"""Runs one program once and says what it took."""
import json
import os
import subprocess
import time


class Failed(Exception):
    """The program ended badly; the message is the end of what it said."""


def run(command, timeout=600, accept=(0,)):
    """Dictionary: the JSON line that the program printed last, if it did, plus `wall_s`, `all_cpu_s`, `peak_mb` of the
    whole process, its exit `status`, and `noise`: how many processors were busy with something else meanwhile.
    An exit status not in `accept` is a failure."""
    idle_before, began = _busy(), time.perf_counter()
    child = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
    try:
        said, _ = _communicate(child, timeout)
    except subprocess.TimeoutExpired:
        child.kill()
        os.wait4(child.pid, 0)
        raise Failed(f"not done after {timeout} s")
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    wall, own = time.perf_counter() - began, usage.ru_utime + usage.ru_stime
    result = {"wall_s": wall, "all_cpu_s": own, "peak_mb": usage.ru_maxrss / 1024, "status": child.returncode}
    result["noise"] = max(0.0, (_busy() - idle_before - own) / wall)
    lines = [line for line in said.splitlines() if line.startswith("{")]
    if child.returncode not in accept:
        raise Failed(said.strip()[-400:].replace("\n", " | "))
    try:
        result.update(json.loads(lines[-1]) if lines else {})
    except json.JSONDecodeError:
        pass  # a program that prints a document of its own, not a measurement
    return result


def _communicate(child, timeout):
    """Output up to the end; the process is left to wait4, which alone tells its peak memory."""
    import threading

    parts = []
    reader = threading.Thread(target=lambda: parts.append(child.stdout.read()))
    reader.start()
    reader.join(timeout)
    if reader.is_alive():
        raise subprocess.TimeoutExpired(child.args, timeout)
    return parts[0], None


def _busy():
    """Seconds that all processors together have worked since the machine started; 0 where that cannot be known."""
    try:
        with open("/proc/stat", encoding="ascii") as file:
            ticks = [int(x) for x in file.readline().split()[1:9]]
    except OSError:
        return 0.0
    return (sum(ticks) - ticks[3] - ticks[4]) / os.sysconf("SC_CLK_TCK")
