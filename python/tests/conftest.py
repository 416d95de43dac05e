"""What the tests share: the corpus, a sphere, a rod, points."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import trueness as t

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(autouse=True)
def in_root(monkeypatch: pytest.MonkeyPatch) -> None:
    """Paths are those of the project, as in the examples."""
    monkeypatch.chdir(ROOT)


@pytest.fixture
def cube() -> t.Mesh:
    mesh = t.read("corpus/shapes/trimesh__unit_cube.STL")
    assert isinstance(mesh, t.Mesh)
    return mesh


@pytest.fixture
def bunny() -> t.Mesh:
    mesh = t.read("corpus/bunny/zipper_res4.ply")
    assert isinstance(mesh, t.Mesh)
    return mesh


@pytest.fixture
def points() -> NDArray[np.float64]:
    """Points around the bunny."""
    return np.random.default_rng(7).uniform(-100, 150, (500, 3))


#: A rod of radius 2 from z = 0 to 3.
ROD = """ISO-10303-21;
HEADER;
ENDSEC;
DATA;
#1=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));
#2=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#3))GLOBAL_UNIT_ASSIGNED_CONTEXT((#1))REPRESENTATION_CONTEXT('',''));
#3=UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-5),#1,'','');
#4=DIRECTION('',(0.,0.,1.));
#5=DIRECTION('',(1.,0.,0.));
#6=CARTESIAN_POINT('',(0.,0.,0.));
#7=CARTESIAN_POINT('',(0.,0.,3.));
#8=AXIS2_PLACEMENT_3D('',#6,#4,#5);
#9=AXIS2_PLACEMENT_3D('',#7,#4,#5);
#10=CARTESIAN_POINT('',(2.,0.,0.));
#11=CARTESIAN_POINT('',(2.,0.,3.));
#12=VERTEX_POINT('',#10);
#13=VERTEX_POINT('',#11);
#14=CIRCLE('',#8,2.);
#15=CIRCLE('',#9,2.);
#16=EDGE_CURVE('',#12,#12,#14,.T.);
#17=EDGE_CURVE('',#13,#13,#15,.T.);
#18=ORIENTED_EDGE('',*,*,#16,.T.);
#19=ORIENTED_EDGE('',*,*,#17,.F.);
#20=ORIENTED_EDGE('',*,*,#16,.F.);
#21=ORIENTED_EDGE('',*,*,#17,.T.);
#22=EDGE_LOOP('',(#18));
#23=EDGE_LOOP('',(#19));
#24=EDGE_LOOP('',(#20));
#25=EDGE_LOOP('',(#21));
#26=FACE_BOUND('',#22,.T.);
#27=FACE_BOUND('',#23,.T.);
#28=FACE_BOUND('',#24,.T.);
#29=FACE_BOUND('',#25,.T.);
#30=CYLINDRICAL_SURFACE('',#8,2.);
#31=PLANE('',#8);
#32=PLANE('',#9);
#33=ADVANCED_FACE('AROUND',(#26,#27),#30,.T.);
#34=ADVANCED_FACE('BELOW',(#28),#31,.F.);
#35=ADVANCED_FACE('ABOVE',(#29),#32,.T.);
#36=CLOSED_SHELL('',(#33,#34,#35));
#37=MANIFOLD_SOLID_BREP('ROD',#36);
#38=ADVANCED_BREP_SHAPE_REPRESENTATION('',(#37),#2);
ENDSEC;
END-ISO-10303-21;
"""


@pytest.fixture
def rod(tmp_path: Path) -> t.Model:
    path = tmp_path / "rod.step"
    path.write_text(ROD)
    model = t.read(path)
    assert isinstance(model, t.Model)
    return model


def rod_distance(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """The signed distance from the rod, in closed form."""
    beside = np.hypot(points[:, 0], points[:, 1]) - 2
    above = np.maximum(-points[:, 2], points[:, 2] - 3)
    outside = np.hypot(np.maximum(beside, 0), np.maximum(above, 0))
    return np.asarray(outside + np.minimum(np.maximum(beside, above), 0))


def sphere(rings: int) -> t.Mesh:
    """A sphere of radius 100 of about 2·rings² facets."""
    polar, turn = np.meshgrid(np.linspace(0, np.pi, rings + 1), np.linspace(0, 2 * np.pi, rings, endpoint=False), indexing="ij")
    vertices = 100 * np.stack([np.sin(polar) * np.cos(turn), np.sin(polar) * np.sin(turn), np.cos(polar)], axis=-1)
    i, j = np.meshgrid(np.arange(rings), np.arange(rings), indexing="ij")
    a, b = i * rings + j, i * rings + (j + 1) % rings
    faces = np.concatenate([np.stack([a, a + rings, b], -1).reshape(-1, 3), np.stack([b, a + rings, b + rings], -1).reshape(-1, 3)])
    return t.Mesh(vertices.reshape(-1, 3), faces)
