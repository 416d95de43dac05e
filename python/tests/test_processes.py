"""Threads, processes, signals, progress."""

from __future__ import annotations

import copy
import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from multiprocessing.connection import Connection
from typing import Any

import numpy as np
import pytest
from conftest import ROOT, sphere
from numpy.typing import NDArray

import trueness as t


def test_other_threads_run_meanwhile() -> None:
    mesh, points = sphere(200), np.random.default_rng(1).uniform(-150, 150, (400_000, 3))
    mesh.closest(points[:1])
    counted, over = 0, threading.Event()

    def count() -> None:
        nonlocal counted
        while not over.is_set():
            counted += 1
            time.sleep(0.001)

    counter = threading.Thread(target=count)
    counter.start()
    start = time.perf_counter()
    mesh.closest(points)
    took = time.perf_counter() - start
    over.set()
    counter.join()
    # Were the lock held, nothing would be counted but at the ticks.
    assert counted > 0.1 * took / 0.001, (counted, took)


def test_many_threads_ask_one_mesh(points: NDArray[np.float64]) -> None:
    mesh = sphere(60)
    expected = sphere(60).signed_distance(points)
    with ThreadPoolExecutor(8) as pool:
        found = [pool.submit(mesh.signed_distance, points) for _ in range(32)]
        checks = [pool.submit(t.check, mesh) for _ in range(8)]
    assert all(np.array_equal(one.result(), expected) for one in found)
    assert len({one.result().sound for one in checks}) == 1


def ask(sender: Connection, mesh: t.Mesh, points: NDArray[np.float64]) -> None:
    sender.send(mesh.signed_distance(points))


@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_processes(method: str, bunny: t.Mesh, points: NDArray[np.float64]) -> None:
    if method not in multiprocessing.get_all_start_methods():
        pytest.skip(f"there is no {method} here")
    expected = bunny.signed_distance(points)
    context: Any = multiprocessing.get_context(method)
    receiver, sender = context.Pipe(duplex=False)
    process = context.Process(target=ask, args=(sender, bunny, points))
    process.start()
    assert receiver.poll(60)
    np.testing.assert_array_equal(receiver.recv(), expected)
    process.join()


def test_meshes_and_models_are_copied_and_pickled(bunny: t.Mesh, rod: t.Model, points: NDArray[np.float64]) -> None:
    again: t.Mesh = pickle.loads(pickle.dumps(bunny))
    np.testing.assert_array_equal(again.vertices, bunny.vertices)
    np.testing.assert_array_equal(again.faces, bunny.faces)
    same: t.Model = pickle.loads(pickle.dumps(rod))
    np.testing.assert_array_equal(same.signed_distance(points), rod.signed_distance(points))
    assert copy.copy(bunny) is bunny and copy.deepcopy(rod) is rod
    cloud = pickle.loads(pickle.dumps(t.Cloud(points)))
    np.testing.assert_array_equal(cloud.points, points)
    np.testing.assert_array_equal(copy.deepcopy(cloud).points, points)


INTERRUPTED = """
import sys, time
sys.path.insert(0, "python/tests")
import numpy as np
from conftest import sphere
mesh, points = sphere(300), np.random.default_rng(1).uniform(-150, 150, (20_000_000, 3))
mesh.closest(points[:1])
print("ready", flush=True)
try:
    mesh.signed_distance(points)
except KeyboardInterrupt:
    print("stopped", time.time(), flush=True)
"""


@pytest.mark.skipif(os.name != "posix", reason="signals")
def test_the_interrupt_key_is_heard() -> None:
    with subprocess.Popen([sys.executable, "-c", INTERRUPTED], stdout=subprocess.PIPE, text=True, cwd=ROOT) as process:
        assert process.stdout is not None and process.stdout.readline() == "ready\n"
        time.sleep(0.4)
        sent = time.time()
        process.send_signal(signal.SIGINT)
        words = process.stdout.readline().split()
    assert words[0] == "stopped", words
    # Two tenths of a second where the machine has nothing else to do.
    assert float(words[1]) - sent < 0.2 * max(1.0, os.getloadavg()[0] / (os.cpu_count() or 1))


def test_progress_is_told() -> None:
    mesh, points = sphere(100), np.random.default_rng(1).uniform(-150, 150, (1_500_000, 3))
    told: list[tuple[str, int, int | None, str]] = []

    def hear(stage: str, done: int, total: int | None, unit: str) -> None:
        told.append((stage, done, total, unit))

    mesh.signed_distance(points, progress=hear)
    assert told[-1] == ("measuring", len(points), len(points), "points")
    done = [words[1] for words in told if words[0] == "measuring"]
    assert done == sorted(done)


def test_what_the_callback_raises_ends_the_work() -> None:
    mesh, points = sphere(100), np.random.default_rng(1).uniform(-150, 150, (3_000_000, 3))

    def stop(*_: object) -> None:
        raise ZeroDivisionError("enough")

    start = time.perf_counter()
    with pytest.raises(ZeroDivisionError, match="enough"):
        mesh.signed_distance(points, progress=stop)
    assert time.perf_counter() - start < 5
    assert len(mesh.signed_distance(points[:10])) == 10


def test_a_bar_of_tqdm(capsys: pytest.CaptureFixture[str], cube: t.Mesh) -> None:
    pytest.importorskip("tqdm")
    cube.signed_distance(np.zeros((1000, 3)), progress=True)
    assert "measuring" in capsys.readouterr().err


def test_nothing_heavy_is_imported() -> None:
    heavy = "pandas matplotlib tqdm trimesh open3d pyvista meshio pyarrow polars scipy asyncio json.tool".split()
    words = f"import sys, trueness; print([m for m in {heavy} if m in sys.modules])"
    told = subprocess.run([sys.executable, "-c", words], capture_output=True, check=True, text=True)
    assert told.stdout.strip() == "[]"
