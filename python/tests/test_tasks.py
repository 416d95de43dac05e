"""The tasks: as the program answers."""

from __future__ import annotations

import copy
import json
import pickle
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from conftest import sphere
from numpy.typing import NDArray

import trueness as t
from trueness.documents import InspectDocument

SCAN, NOMINAL = "corpus/bunny/zipper_res3.ply", "corpus/bunny/zipper_res4.ply"
CIRCLE = "corpus/reference_fits/circle3d_01_full_lobed.xyz"


def program(*words: str) -> subprocess.CompletedProcess[bytes]:
    """The program of this package."""
    return subprocess.run([sys.executable, "-m", "trueness", *words], capture_output=True, check=False)


def test_the_document_is_that_of_the_program(tmp_path: Path) -> None:
    page = str(tmp_path / "page.html")
    cases = [
        (t.check(NOMINAL), ["check", NOMINAL, "--html", page]),
        (t.compare(SCAN, NOMINAL, tolerance=5, inside=90), ["compare", SCAN, NOMINAL, "--tolerance", "5", "--inside", "90", "--html", page]),
        (t.compare(SCAN, [NOMINAL], view=False), ["compare", SCAN, NOMINAL]),
        (t.fit(CIRCLE, shape="circle"), ["fit", CIRCLE, "--shape", "circle", "--html", page]),
        (t.info(NOMINAL), ["info", NOMINAL]),
    ]
    for found, words in cases:
        told = program(*words, "--json", "-")
        assert told.stdout.decode() == found.json, words
        assert told.returncode == found.exit_status, words


def test_objects_in_memory_are_answered_as_files(bunny: t.Mesh, tmp_path: Path) -> None:
    path = tmp_path / "bunny.ply"
    bunny.save(path)
    of_file, of_object = t.check(path), t.check(bunny)
    for key in of_file:
        if key != "inputs":
            assert of_file[key] == of_object[key], key
    assert of_object.inputs[0].path == "<mesh>"
    points = np.loadtxt(CIRCLE)
    found = t.fit(points, shape="circle")
    assert found.parameters == t.fit(CIRCLE, shape="circle").parameters
    assert t.fit(t.Cloud(points), shape="circle") == found
    assert t.fit(points.tolist(), shape="circle") == found


def test_every_task(tmp_path: Path, bunny: t.Mesh, rod: t.Model, cube: t.Mesh) -> None:
    moved = bunny.vertices + [0.5, 0.1, 0.0]
    aligned = t.align(t.Mesh(moved, bunny.faces), bunny, out=tmp_path / "aligned.ply")
    transform = np.array(aligned.transform)
    np.testing.assert_allclose(transform[:3, 3], [-0.5, -0.1, 0.0], atol=1e-6)
    assert isinstance(t.read(tmp_path / "aligned.ply"), t.Mesh)
    doubled = t.Mesh(cube.vertices, [*cube.faces, cube.faces[3]])
    repaired = t.repair(doubled, out=tmp_path / "repaired.stl")
    mended = t.read(tmp_path / "repaired.stl")
    assert not t.check(doubled).sound and repaired.sound and isinstance(mended, t.Mesh) and len(mended) == 12
    assert sorted(region.shape for region in t.segment(rod.mesh).regions) == ["cylinder", "plane", "plane"]
    sections = t.section(cube, plane=[(0, 0, 1, 0.1)])
    assert len(sections.contours) == 1 and len(sections.contours[0].segments) == 4
    x, y = np.meshgrid(np.linspace(0, 4, 12), np.linspace(0, 4, 12))
    patch = np.stack([x.ravel(), y.ravel(), 0.1 * x.ravel() ** 2], axis=1)
    fitted = t.surface(patch, degree="2x2", spans="2x2", fairness=0, base="xy")
    assert fitted.deviation.rms is not None and fitted.deviation.rms < 1e-9
    # Towards the outward normal a sphere of radius 100 bends by -1/100, but for what facets leave out.
    curved = t.curvature(sphere(48), degree=2)
    assert curved.mean.statistics.median == pytest.approx(-0.01, rel=0.02)
    converted = t.convert(rod, tmp_path / "rod.stl")
    assert converted.exit_status == 0 and isinstance(t.read(tmp_path / "rod.stl"), t.Mesh)
    assert t.info(rod).schema == "trueness/info/1"


def test_a_plan_from_its_proposal_to_the_trend(rod: t.Model, tmp_path: Path) -> None:
    plan = t.plan_init(rod)
    assert 'schema = "trueness/plan/1"' in str(plan)
    angle = np.random.default_rng(5).uniform(0, 2 * np.pi, 4000)
    height = np.random.default_rng(6).uniform(0, 3, 4000)
    around = np.stack([2 * np.cos(angle), 2 * np.sin(angle), height], axis=1)
    reach = 2 * np.sqrt(np.random.default_rng(8).uniform(0, 1, 2000))
    ends = np.stack([reach * np.cos(angle[:2000]), reach * np.sin(angle[:2000]), np.where(np.arange(2000) % 2, 3.0, 0.0)], axis=1)
    scan = np.concatenate([around, ends])
    text = """schema = "trueness/plan/1"
measured = "scan.xyz"
[[feature]]
id = "A"
shape = "cylinder"
points = "around.xyz"
[[characteristic]]
id = "1"
kind = "cylindricity"
feature = "A"
tolerance = 0.01
"""
    (tmp_path / "plan.toml").write_text(text)
    np.savetxt(tmp_path / "scan.xyz", scan)
    parts: list[InspectDocument] = []
    for seed in range(3):
        np.savetxt(tmp_path / "around.xyz", around + np.random.default_rng(seed).normal(0, 1e-4, around.shape))
        parts.append(t.inspect(tmp_path / "plan.toml"))
    assert all(part.characteristics[0].verdict == part.verdict == "pass" for part in parts)
    course = t.trend(parts)
    assert course.schema == "trueness/trend/1" and len(course.inputs) == 3


def test_reports(tmp_path: Path) -> None:
    found = t.check(NOMINAL)
    found.save(tmp_path / "check.html")
    found.save(tmp_path / "check.json")
    assert (tmp_path / "check.html").read_bytes().startswith(b"<!doctype html>")
    assert (tmp_path / "check.json").read_text() == found.json
    assert b'lang="de"' in found.report(language="de", title="Hase")
    with pytest.raises(ValueError, match="the ending must be .json or .html"):
        found.save(tmp_path / "check.csv")
    with pytest.raises(ValueError, match="no report"):
        t.info(NOMINAL).report()


def test_attributes() -> None:
    found = t.check(NOMINAL)
    assert found.facets == found["facets"] == 948 and "facets" in found and "facets" in dir(found)
    assert found.defects["holes"].count == json.loads(found.json)["defects"]["holes"]["count"]
    with pytest.raises(AttributeError, match="CheckDocument has no 'facet'; did you mean 'facets'"):
        found.facet  # type: ignore[attr-defined] # noqa: B018 # pyright: ignore
    text = found._repr_html_()
    assert "948" in text and "kB" in text and len(text) < 5000


def test_documents_are_copied_and_pickled() -> None:
    found = t.check(NOMINAL)
    for other in (pickle.loads(pickle.dumps(found)), copy.copy(found), copy.deepcopy(found)):
        assert other == found and other.exit_status == found.exit_status and type(other) is type(found)
        with pytest.raises(ValueError, match="has no report"):
            other.report()


def test_errors_have_the_words_of_the_program(tmp_path: Path) -> None:
    with pytest.raises(TypeError, match=r"check\(\) has no argument 'unit'; did you mean 'units'"):
        t.check(NOMINAL, unit="mm")  # type: ignore[arg-type] # pyright: ignore[reportArgumentType]
    with pytest.raises(FileNotFoundError) as missing:
        t.check("no/such.stl")
    told = program("check", "no/such.stl")
    assert told.stderr.decode() == f"trueness: {missing.value}\n" and told.returncode == 3
    assert isinstance(missing.value, t.TruenessError) and isinstance(missing.value, OSError)
    broken = tmp_path / "broken.ply"
    broken.write_text("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nend_header\n1\n")
    with pytest.raises(t.TruenessError) as unread:
        t.read(broken)
    assert program("check", str(broken)).stderr.decode() == f"trueness: {unread.value}\n"
    with pytest.raises(ValueError, match="tolerance: ‘a’ is not a number"):
        t.compare(SCAN, NOMINAL, tolerance="a")
    with pytest.raises(ValueError, match="tolerance: "):
        t.compare(SCAN, NOMINAL, tolerance=(0.2, 0.1))
    with pytest.raises(ValueError, match="shape: "):
        t.fit(CIRCLE, shape="blob")  # type: ignore[arg-type] # pyright: ignore[reportArgumentType]
    with pytest.raises(ValueError, match="measured: "):
        t.compare(object(), NOMINAL)  # type: ignore[arg-type] # pyright: ignore[reportArgumentType]


def test_outputs_are_never_inputs(tmp_path: Path) -> None:
    path = tmp_path / "bunny.ply"
    path.write_bytes(Path(NOMINAL).read_bytes())
    with pytest.raises(ValueError, match="would overwrite the input"):
        t.convert(path, path)


def test_points_with_normals(points: NDArray[np.float64], tmp_path: Path) -> None:
    normals = points / np.linalg.norm(points, axis=1, keepdims=True)
    cloud = t.Cloud(points, normals)
    path = tmp_path / "cloud.ply"
    cloud.save(path)
    again = t.read(path)
    assert isinstance(again, t.Cloud)
    np.testing.assert_array_equal(again.points, points)
    with pytest.raises(ValueError, match="normals: there are 2 for 500 points"):
        t.Cloud(points, normals[:2])


def test_the_program() -> None:
    told = program("--version")
    assert told.returncode == 0 and told.stdout.decode().split() == ["trueness", t.__version__]
    assert program("check").returncode == 2
