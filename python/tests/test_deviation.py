"""Deviations with their documents."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import trueness as t


@pytest.fixture
def scan() -> t.Mesh:
    scan = t.read("corpus/bunny/zipper_res3.ply")
    assert isinstance(scan, t.Mesh)
    return scan


def test_document_and_values_are_one(bunny: t.Mesh, scan: t.Mesh) -> None:
    found = bunny.deviation(scan, tolerance=5)
    assert len(found) == len(scan.vertices) and not found.values.flags.writeable
    own = found.document.comparisons[0]
    assert own.deviation.to_dict() == found.statistics.to_dict()
    assert own.sign.method == found.sign_method
    assert own.tolerance is not None and own.tolerance.inside == pytest.approx(found.within(5), abs=1e-15)
    all_values = found.statistics.all
    assert all_values.mean is not None and all_values.mean == pytest.approx(found.values.mean(), rel=1e-12)
    assert all_values.max == found.values.max() and all_values.count == len(found)
    own_bins = found.histogram
    assert own_bins is not None and sum(own_bins.counts) + own_bins.below + own_bins.above == len(found)
    assert found.verdict == "fail" and found.document.exit_status == 1 and not found.document.conforms
    assert bunny.deviation(scan, tolerance=50).verdict in ("pass", "undecided")
    assert bunny.deviation(scan).verdict is None


def test_tolerances(cube: t.Mesh) -> None:
    points = [[0, 0, 0.55], [0, 0, 0.45], [0, 0, 0.8]]
    found = cube.deviation(points, tolerance=(-0.01, 0.1))
    assert found.tolerance == (-0.01, 0.1)
    assert found.within(0.1) == pytest.approx(2 / 3) and found.within(-0.01, 0.1) == pytest.approx(1 / 3)
    shares = found.document.comparisons[0].tolerance
    assert shares is not None and (shares.lower, shares.upper) == (-0.01, 0.1)
    assert cube.deviation(points, tolerance="-0.01,+0.1").tolerance == (-0.01, 0.1)
    assert np.isnan(cube.deviation(np.empty((0, 3))).within(1))
    for wrong in (0, -1, (0.2, 0.1), (1, 2, 3)):
        with pytest.raises(ValueError, match="tolerance: "):
            cube.deviation(points, tolerance=wrong)


def test_files(bunny: t.Mesh, scan: t.Mesh, tmp_path: Path) -> None:
    found = bunny.deviation(scan, tolerance=5)
    for ending in ("html", "json", "csv", "ply", "npz"):
        found.save(tmp_path / f"map.{ending}")
    assert sorted(p.name for p in tmp_path.iterdir()) == [f"map.{e}" for e in ("csv", "html", "json", "npz", "ply")]
    page = (tmp_path / "map.html").read_text()
    assert page.startswith("<!doctype html>")
    document = json.loads((tmp_path / "map.json").read_text())
    assert document["schema"] == "trueness/compare/1" and document["inputs"][0]["path"] == "<measured>"
    written = np.load(tmp_path / "map.npz")
    np.testing.assert_array_equal(written["deviation"], found.values)
    with pytest.raises(ValueError, match="the ending must be"):
        found.save(tmp_path / "map.docx")


def test_changed_points_are_told(cube: t.Mesh) -> None:
    points = np.array([[0, 0, 0.55], [0, 0, 0.45]])
    found = cube.deviation(points)
    points[0, 2] = 9
    with pytest.raises(ValueError, match="they have changed since"):
        found.document  # noqa: B018  # pyright: ignore[reportUnusedExpression]


def test_a_model(rod: t.Model) -> None:
    angle = np.linspace(0, 6, 200)
    points = np.stack([2.01 * np.cos(angle), 2.01 * np.sin(angle), np.full(200, 1.5)], axis=1)
    found = rod.deviation(points, tolerance=0.05)
    np.testing.assert_allclose(found.values, 0.01, atol=1e-12)
    own = found.document.comparisons[0]
    assert own.deviation.to_dict() == found.statistics.to_dict()
    assert found.sign_method == own.sign.method == "normal"
    assert found.document.inputs[1].format.startswith("step")


def test_tables(cube: t.Mesh, points: NDArray[np.float64]) -> None:
    found = cube.deviation(points)
    pandas = pytest.importorskip("pandas")
    table = found.to_pandas()
    assert list(table.columns) == ["x", "y", "z", "deviation"]
    assert isinstance(table, pandas.DataFrame)
    np.testing.assert_array_equal(np.asarray(table)[:, 3], found.values)
    arrow = pytest.importorskip("pyarrow")
    batch = arrow.record_batch(found)
    assert batch.schema.names == ["x", "y", "z", "deviation"]
    np.testing.assert_array_equal(batch.column("z").to_numpy(), points[:, 2])
    column = batch.column("deviation")
    del batch, found
    np.testing.assert_array_equal(column.to_numpy(), cube.signed_distance(points))
    polars = pytest.importorskip("polars")
    frame = polars.DataFrame(cube.deviation(points))
    np.testing.assert_array_equal(frame["deviation"].to_numpy(), cube.signed_distance(points))


def test_what_is_shown(bunny: t.Mesh, scan: t.Mesh) -> None:
    found = bunny.deviation(scan)
    assert repr(found) == "Deviation(1887 of 1887 points, rms 1.376 mm)"
    text = found._repr_html_()
    assert len(text) < 2000 and "1887 of 1887" in text and "bytes" in text
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    from matplotlib.figure import Figure

    axes = bunny.deviation(scan, tolerance=2).plot(Figure().subplots())
    assert axes.get_xlabel() == "deviation, mm" and len(axes.lines) == 2


def test_as_an_array(cube: t.Mesh) -> None:
    found = cube.deviation([[0, 0, 2], [0, 0, 0]])
    np.testing.assert_array_equal(np.asarray(found), [1.5, -0.5])
    assert np.asarray(found).ctypes.data == found.values.ctypes.data
