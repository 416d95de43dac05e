"""Reads what `trueness` writes with other programs and compares it.

readback.py PROGRAM CORPUS

Every comparison is of 64-bit numbers bit for bit, but for files of single precision (STL), where the input is rounded first,
and for distances, where NumPy sums in another order.
"""

import csv
import json
import re
import tempfile
from pathlib import Path
from xml.etree import ElementTree

import meshio
import numpy as np
import pyarrow.parquet
import trimesh
import vtk
from OCP.BRep import BRep_Tool
from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
from OCP.BRepCheck import BRepCheck_Analyzer
from OCP.BRepGProp import BRepGProp
from OCP.GProp import GProp_GProps
from OCP.Geom import Geom_BSplineSurface, Geom_RectangularTrimmedSurface, Geom_SphericalSurface, Geom_ToroidalSurface
from OCP.GeomAbs import GeomAbs_BSplineCurve, GeomAbs_Circle, GeomAbs_Line
from OCP.GeomConvert import GeomConvert
from OCP.GeomLProp import GeomLProp_SLProps
from OCP.IFSelect import IFSelect_RetDone
from OCP.IGESControl import IGESControl_Reader, IGESControl_Writer
from OCP.Interface import Interface_Static
from OCP.STEPControl import STEPControl_AsIs, STEPControl_Reader, STEPControl_Writer
from OCP.TopAbs import TopAbs_EDGE, TopAbs_FACE
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS
from OCP.gp import gp_Ax3, gp_Dir, gp_Pnt
from vtk.util.numpy_support import vtk_to_numpy

from common import CORPUS, along, basis, mixed_row, run
from drawings import drawings

MEASURED = CORPUS / "bunny" / "zipper_res4.ply"
REFERENCE = CORPUS / "bunny" / "zipper_res3.ply"


def same(name, ours, theirs):
    """Equal in shape and, bit for bit, in every value; NaN equals NaN."""
    ours, theirs = np.asarray(ours), np.asarray(theirs)
    assert ours.shape == theirs.shape, (name, ours.shape, theirs.shape)
    assert np.array_equal(ours, theirs, equal_nan=ours.dtype.kind == "f"), name


def vtk_read(reader, path):
    """The data that a reader of VTK finds."""
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def vtk_triangles(data):
    return vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def ply_columns(path):
    """The columns of the vertices of a binary PLY file, read as its header says."""
    data = path.read_bytes()
    head, end = data.split(b"end_header\n", 1)[0].decode(), data.index(b"end_header\n") + 11
    kinds = {"double": "<f8", "float": "<f4", "uchar": "u1", "int": "<i4"}
    count = int(re.search(r"element vertex (\d+)", head)[1])
    vertex = head.split("element vertex", 1)[1].split("element", 1)[0]
    row = [(name, kinds[kind]) for kind, name in re.findall(r"property (\w+) (\w+)\n", vertex)]
    return np.frombuffer(data, np.dtype(row), count, end)


def brute_force(points, corners):
    """Distance of each point to the nearest of all triangles (3 corners each); Ericson, Real-Time Collision Detection, 5.1.5."""
    a, b, c = (corners[:, i] for i in range(3))
    nearest = np.full(len(points), np.inf)

    def to_edge(p, start, end):
        along = end - start
        t = np.clip(np.einsum("ij,ij->i", p - start, along) / np.einsum("ij,ij->i", along, along), 0, 1)
        return np.linalg.norm(p - (start + t[:, None] * along), axis=1)

    normal = np.cross(b - a, c - a)
    for i, p in enumerate(points):
        distance = np.minimum.reduce([to_edge(p, a, b), to_edge(p, b, c), to_edge(p, c, a)])
        sides = [np.einsum("ij,ij->i", np.cross(v - u, p - u), normal) for u, v in ((a, b), (b, c), (c, a))]
        above = np.all(np.array(sides) >= 0, axis=0)
        height = np.abs(np.einsum("ij,ij->i", p - a, normal)) / np.linalg.norm(normal, axis=1)
        nearest[i] = np.min(np.where(above, np.minimum(distance, height), distance))
    return nearest


def deviations(folder):
    """The files of `compare --out` agree with one another, with the input, and with brute force."""
    for ending in ("csv", "ply", "parquet", "npz", "vtp"):
        options = ("--tolerance", "0.1", "--max-distance", "0.3")
        run("compare", MEASURED, REFERENCE, *options, "--out", folder / f"d.{ending}")

    held = np.load(folder / "d.npz")
    points, deviation, colors = held["points"], held["deviation"], held["colour"]
    same("excluded of NPZ", held["excluded"], np.isnan(deviation))
    assert 0 < np.isnan(deviation).sum() < len(deviation), "some points are excluded, not all"
    measured = meshio.read(MEASURED).points.astype(np.float64)
    scale = points[0, 0] / measured[0, 0]
    assert scale == 1.0, "millimetres in, millimetres out"
    same("points of NPZ", points, measured)

    table = pyarrow.parquet.read_table(folder / "d.parquet")
    same("points of Parquet", points, np.stack([table[k].to_numpy() for k in "xyz"], axis=1))
    assert table["deviation"].null_count == np.isnan(deviation).sum(), "excluded points are null"
    same("deviation of Parquet", deviation, table["deviation"].to_numpy())
    same("colors of Parquet", colors, np.stack([table[k].to_numpy() for k in ("red", "green", "blue")], axis=1))

    with open(folder / "d.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    same("points of CSV", points, [[float(r[k]) for k in "xyz"] for r in rows])
    same("deviation of CSV", deviation, [float(r["deviation"] or "nan") for r in rows])

    columns = ply_columns(folder / "d.ply")
    same("points of PLY", points, np.stack([columns[k] for k in "xyz"], axis=1))
    same("deviation of PLY", deviation, columns["deviation"])
    same("excluded of PLY", np.isnan(deviation), columns["excluded"] == 1)
    same("points of PLY in meshio", points, meshio.read(folder / "d.ply").points)
    seen = vtk_read(vtk.vtkPLYReader(), folder / "d.ply")
    same("points of PLY in VTK", points.astype(np.float32), vtk_to_numpy(seen.GetPoints().GetData()))
    same("colors of PLY in VTK", colors, vtk_to_numpy(seen.GetPointData().GetArray("RGB")))

    seen = vtk_read(vtk.vtkXMLPolyDataReader(), folder / "d.vtp")
    same("points of VTP", points, vtk_to_numpy(seen.GetPoints().GetData()))
    same("deviation of VTP", deviation, vtk_to_numpy(seen.GetPointData().GetArray("deviation")))
    same("colors of VTP", colors, vtk_to_numpy(seen.GetPointData().GetArray("colour")))
    assert seen.GetNumberOfVerts() >= 1, "points are drawn"

    reference = meshio.read(REFERENCE)
    corners = reference.points.astype(np.float64)[reference.cells_dict["triangle"]]
    distance = brute_force(points, corners)
    kept = ~np.isnan(deviation)
    same("excluded points", kept, distance <= 0.3)
    largest = np.abs(np.abs(deviation[kept]) - distance[kept]).max()
    assert largest < 1e-12, f"distance off by {largest}"


def reasons(folder):
    """The reasons of `compare --facing --outliers --max-distance --out` agree with the document, and the rule with NumPy."""
    options = ("--facing", "40", "--outliers", "mad:4", "--max-distance", "3")
    for ending in ("csv", "tsv", "ply", "parquet", "npz", "vtp"):
        run("compare", REFERENCE, MEASURED, *options, "--out", folder / f"r.{ending}", "--json", folder / "r.json")
    held = np.load(folder / "r.npz")
    deviation, excluded = held["deviation"], held["excluded"]
    document = json.loads((folder / "r.json").read_text())["comparisons"][0]
    names = ("max_distance", "free_edge", "facing", "outlier", "no_crossing", "no_direction")
    counts = [document["excluded"].get(name, 0) for name in names]
    assert counts == [int((excluded == code).sum()) for code in range(1, 7)], counts
    assert counts[0] > 0 and counts[2] > 0 and counts[3] > 0, "every reason that was asked for is there"
    same("points without a deviation", np.isnan(deviation), np.isin(excluded, (1, 2, 3)))

    # The rule belongs to what the other reasons leave.
    left = deviation[~np.isnan(deviation)]
    median = np.median(left)
    reach = 4 * 1.482602218505602 * np.median(np.abs(left - median))
    limits = document["outliers"]
    assert max(abs(limits["lower"] - (median - reach)), abs(limits["upper"] - (median + reach))) < 1e-12, limits
    same("outliers", excluded == 4, (deviation < limits["lower"]) | (deviation > limits["upper"]))

    for ending, separator in (("csv", ","), ("tsv", "\t")):
        with open(folder / f"r.{ending}", newline="") as file:
            rows = list(csv.DictReader(file, delimiter=separator))
        same(f"reasons of {ending}", excluded, np.array([int(r["excluded"]) for r in rows], np.uint8))
        same(f"deviation of {ending}", deviation, [float(r["deviation"] or "nan") for r in rows])
    columns = ply_columns(folder / "r.ply")
    same("reasons of PLY", excluded, columns["excluded"])
    same("deviation of PLY", deviation, columns["deviation"])
    table = pyarrow.parquet.read_table(folder / "r.parquet")
    same("reasons of Parquet", excluded, table["excluded"].to_numpy().astype(np.uint8))
    same("deviation of Parquet", deviation, table["deviation"].to_numpy())
    seen = vtk_read(vtk.vtkXMLPolyDataReader(), folder / "r.vtp").GetPointData()
    same("reasons of VTP", excluded, vtk_to_numpy(seen.GetArray("excluded")))
    same("deviation of VTP", deviation, vtk_to_numpy(seen.GetArray("deviation")))


def meshes(folder):
    """Files of `repair --out` hold the triangles of the input, in its order; their places to the last bit."""
    given = meshio.read(REFERENCE)
    corners = given.points.astype(np.float64)[given.cells_dict["triangle"]]
    for ending in ("stl", "ply", "obj", "off"):
        path = folder / f"m.{ending}"
        run("repair", REFERENCE, "--only", "degenerate", "--out", path)
        expected = corners.astype(np.float32) if ending == "stl" else corners
        read = trimesh.load(path, process=False, maintain_order=True)
        same(f"{ending} in trimesh", expected, read.vertices[read.faces].astype(expected.dtype))
        if ending != "off":  # its reader of OFF wants the counts on a line of their own
            read = meshio.read(path)
            theirs = read.points.astype(np.float64)[read.cells_dict["triangle"]]
            same(f"{ending} in meshio", expected.astype(np.float64), theirs)
        readers = {"stl": vtk.vtkSTLReader, "ply": vtk.vtkPLYReader, "obj": vtk.vtkOBJReader}
        if ending in readers:
            read = vtk_read(readers[ending](), path)
            places = vtk_to_numpy(read.GetPoints().GetData())
            same(f"{ending} in VTK", corners.astype(np.float32), places[vtk_triangles(read)].astype(np.float32))


def regions(folder):
    """Files of `segment --out`: the number of its region for each facet and for each point."""
    cylinder = CORPUS / "broken" / "ok_cylinder.stl"
    run("segment", cylinder, "--out", folder / "s.ply", "--json", folder / "s.json")
    # meshio reads lists of facets alone, so trimesh reads this one.
    read = trimesh.load(folder / "s.ply", process=False, maintain_order=True)
    numbers = read.metadata["_ply_raw"]["face"]["data"]["region"].ravel()
    given = trimesh.load(cylinder, process=False)
    same("facets of a segmented mesh", given.triangles, read.triangles)
    # The axis of the cylinder is z: the ends are the facets whose corners have one height.
    heights = np.ptp(given.triangles[:, :, 2], axis=1)
    ends = {int(n) for n in numbers[heights == 0]}
    sides = {int(n) for n in numbers[heights > 0]}
    assert len(ends) == 2 and len(sides) == 1 and not ends & sides, (ends, sides)


def surfaces(folder):
    """STEP and IGES files of `surface` are a valid face of the same surface in millimetres for Open CASCADE."""
    random = np.random.default_rng(4)
    x, y = 80 * random.random(3000) + 500, 50 * random.random(3000) - 20
    points = np.stack([x, y, 4 * np.sin(x / 15) * np.cos(y / 12)], axis=1)
    np.savetxt(folder / "s.asc", points, fmt="%.17g")
    # A step aslant: the rectangle of the parameters is turned along it.
    x, y = (a.ravel() for a in np.meshgrid(np.linspace(500, 580, 71), np.linspace(-20, 30, 71)))
    step = np.tanh((0.6 * (x - 540) + 0.8 * (y - 5)) / 2)
    np.savetxt(folder / "step.asc", np.stack([x, y, step], axis=1), fmt="%.17g")
    # An L with a hole.
    inside = ((points[:, 0] < 540) | (points[:, 1] < 5)) & (np.hypot(points[:, 0] - 525, points[:, 1] + 2) > 9)
    np.savetxt(folder / "l.asc", points[inside], fmt="%.17g")
    for data, *options in (
        ("s.asc", "--spans", "9x6"),
        ("s.asc", "--degree", "2x4", "--spans", "3x7", "--base", "xy"),
        ("s.asc", "--tolerance", "0.02"),
        ("step.asc", "--tolerance", "0.005"),
        ("l.asc", "--spans", "9x6", "--trim"),
    ):
        files = {"step": folder / "s.stp", "iges": folder / "s.igs"}
        run("surface", folder / data, *options, "--json", folder / "s.json", "--step", files["step"], "--iges", files["iges"], "--obj", folder / "s.obj")
        answer = json.loads((folder / "s.json").read_text())
        assert (answer["base"]["turned"] != 0) == (data == "step.asc"), f"{data}: {answer['base']}"
        control = np.array(answer["control_points"])
        (p, q), knots = answer["degree"], answer["knots"]
        places = [(knots[k][0], knots[k][-1]) for k in "uv"]
        parameters = [[a + (b - a) * t for (a, b), t in zip(places, row)] for row in random.random((10000, 2))]
        parameters += [[a, b] for a in places[0] for b in places[1]]
        us, vs = ([basis(knots[k], d, row[i]) for row in parameters] for i, (k, d) in enumerate((("u", p), ("v", q))))
        ours = np.einsum("ni,nj,ijd->nd", np.array(us), np.array(vs), control)
        for name, reader in (("step", STEPControl_Reader()), ("iges", IGESControl_Reader())):
            reader.ReadFile(str(files[name]))
            reader.TransferRoots()
            shape = reader.OneShape()
            assert BRepCheck_Analyzer(shape).IsValid(), f"{name}: valid"
            explorer = TopExp_Explorer(shape, TopAbs_FACE)
            face = TopoDS.Face(explorer.Current())
            explorer.Next()
            assert not explorer.More(), f"{name}: one face"
            area = GProp_GProps()
            BRepGProp.SurfaceProperties_s(face, area) if hasattr(BRepGProp, "SurfaceProperties_s") else BRepGProp.SurfaceProperties(face, area)
            of_facets = trimesh.load(folder / "s.obj", process=False).area
            assert abs(area.Mass() / of_facets - 1) < 1e-3, f"{name}: {area.Mass()} mm² and {of_facets}"
            rims = TopExp_Explorer(shape, TopAbs_EDGE)
            edges = 0
            while rims.More():
                edges, _ = edges + 1, rims.Next()
            loops = [loop for r in answer.get("trim", {"regions": []})["regions"] for loop in [r["outer"], *r["holes"]]]
            assert edges == (sum(map(len, loops)) if loops else 4) and (len(loops) == 2) == (data == "l.asc"), f"{name}: {edges} edges"
            tool = BRep_Tool.Surface_s if hasattr(BRep_Tool, "Surface_s") else BRep_Tool.Surface
            found = tool(face)
            assert isinstance(found, Geom_BSplineSurface), f"{name}: {found}"
            assert [found.UDegree(), found.VDegree()] == [p, q], f"{name}: degrees"
            assert [found.NbUPoles(), found.NbVPoles()] == list(control.shape[:2]), f"{name}: poles"
            seen = [found.Value(u, v) for u, v in parameters]
            theirs = np.array([[c.X(), c.Y(), c.Z()] for c in seen])
            worst = np.abs(ours - theirs).max()
            assert worst < 1e-9, f"{name} {data} {options}: {worst} mm"
            print(f"      {name} {data} {' '.join(options)}: {worst:.1e} mm at {len(parameters)} places")


def foreign_surfaces(folder):
    """Surfaces that Open CASCADE writes as STEP and IGES are read as what they are: points lifted off them have that deviation."""
    torus = Geom_RectangularTrimmedSurface(Geom_ToroidalSurface(gp_Ax3(), 20.0, 5.0), 0.0, 2.0, 0.5, 3.0)
    sphere = Geom_SphericalSurface(gp_Ax3(gp_Pnt(3, 4, 5), gp_Dir(1, 2, 3)), 7.0)
    for name, shape in (("torus", torus), ("sphere", sphere)):
        surface = GeomConvert.SurfaceToBSplineSurface_s(shape)
        face = BRepBuilderAPI_MakeFace(surface, 1e-7).Face()
        for sense in ("forward", "reversed"):
            files = []
            for unit in ("MM", "INCH"):
                Interface_Static.SetCVal_s("write.step.unit", unit)
                writer = STEPControl_Writer()
                writer.Transfer(face, STEPControl_AsIs)
                files.append(folder / f"{name}-{sense}-{unit}.step")
                assert writer.Write(str(files[-1])) == IFSelect_RetDone
            for unit in ("MM", "IN") if sense == "forward" else ():
                writer = IGESControl_Writer(unit, 0)
                writer.AddShape(face)
                writer.ComputeModel()
                files.append(folder / f"{name}-{unit}.iges")
                assert writer.Write(str(files[-1]))
            u0, u1, v0, v1 = surface.Bounds()
            rng = np.random.default_rng(5)
            lift = rng.uniform(-0.5, 0.5, 500)
            rows = []
            for u, v, by in zip(rng.uniform(u0, u1, 500), rng.uniform(v0, v1, 500), lift):
                at = GeomLProp_SLProps(surface, u, v, 1, 1e-9)
                p, n = at.Value(), at.Normal()
                side = 1.0 if sense == "forward" else -1.0
                rows.append([getattr(p, k)() + side * by * getattr(n, k)() for k in "XYZ"])
            points = folder / f"{name}.npy"
            np.save(points, np.array(rows))
            for file in files:
                run("compare", points, file, "--out", folder / "lifted.npz", "--json", folder / "lifted.json")
                found = np.load(folder / "lifted.npz")["deviation"]
                assert np.abs(found - lift).max() < 1e-7, (file.name, np.abs(found - lift).max())
                reference = json.loads((folder / "lifted.json").read_text())["inputs"][1]
                assert "warnings" not in reference, (file.name, reference)
            face = TopoDS.Face(face.Reversed())


def qif(folder):
    """The characteristics of `inspect --qif` by Python's XML reader: what refers to what, values and verdicts as in the document."""
    plan = CORPUS / "examples" / "plate" / "plate.toml"
    run("inspect", plan, "--qif", folder / "r.qif", "--json", folder / "r.json")
    document = json.loads((folder / "r.json").read_text())
    root = ElementTree.parse(folder / "r.qif").getroot()
    space = "{http://qifstandards.org/xsd/qif3}"
    named = {e.get("id"): e for e in root.iter() if e.get("id")}
    assert len(named) == sum(1 for e in root.iter() if e.get("id")), "every number stands once"
    assert max(map(int, named)) == int(root.get("idMax"))
    for e in root.iter():
        if e.get("n"):
            # Attributes and lists count what they hold.
            assert int(e.get("n")) == len(e), e.tag
    text = lambda e, name: e.findtext(space + name)
    found = [e for e in root.iter() if e.tag.endswith("CharacteristicMeasurement")]
    status = {"pass": "PASS", "fail": "FAIL", "undecided": "INDETERMINATE", "not_measured": "NOT_ANALYZED"}
    for c, e in zip(document["characteristics"], found):
        item = named[text(e, "CharacteristicItemId")]
        nominal = named[text(item, "CharacteristicNominalId")]
        definition = named[text(nominal, "CharacteristicDefinitionId")]
        kinds = {x.tag.removeprefix(space).split("Characteristic")[0] for x in (e, item, nominal, definition)}
        assert len(kinds) == 1 and text(item, "Name") == c["id"], (c["id"], kinds)
        value = text(e, "Value")
        assert (None if value is None else float(value)) == c["value"], c["id"]
        assert e.findtext(f"{space}Status/{space}CharacteristicStatusEnum") == status[c["verdict"]], c["id"]
        limit = definition.find(f"{space}Tolerance")
        if limit is not None:
            bounds = [text(limit, k) for k in ("MaxValue", "MinValue")]
            assert [x and float(x) for x in bounds] == [c["upper"], c["lower"]], c["id"]
        elif kinds != {"UserDefinedAttribute"}:
            assert float(text(definition, "ToleranceValue")) == (c["tolerance"] or c["upper"]), c["id"]
        features = [text(named[i.text], "FeatureName") for i in e.find(f"{space}FeatureMeasurementIds")]
        assert features[0] in c["feature"], (c["id"], features)
    held = [e for e in root.iter() if e.tag.endswith("FeatureMeasurement")]
    assert [text(e, "FeatureName") for e in held] == [f["id"] for f in document["features"]]
    for f, e in zip(document["features"], held):
        radius = (f["parameters"] or {}).get("radius")
        if radius is not None:
            assert float(text(e, "Diameter")) == 2 * radius, f["id"]
    files = [e.text for e in root.iter(space + "Description") if "SHA-256" in (e.text or "")]
    assert document["plan"]["sha256"] in files[0], files
    print(f"QIF: {len(document['characteristics'])} characteristics, {len(held)} features")


def sections(folder):
    """STEP and IGES files of `section` are the same lines, arcs and B-splines at the same places in space for Open CASCADE."""
    random = np.random.default_rng(8)
    row = mixed_row()
    np.savetxt(folder / "row.txt", row + 0.002 * random.standard_normal(row.shape), fmt="%.17g")
    circle = np.linspace(0, 2 * np.pi, 200, endpoint=False)
    # A whole circle in a plane of its own.
    ring = np.outer(np.cos(circle), [3, 0, 4]) + np.outer(np.sin(circle), [0, 5, 0]) + [100, 200, 300]
    np.savetxt(folder / "ring.txt", ring + 0.001 * random.standard_normal(ring.shape), fmt="%.17g")
    cylinder = CORPUS / "broken" / "ok_cylinder.stl"
    types = {"line": GeomAbs_Line, "arc": GeomAbs_Circle, "spline": GeomAbs_BSplineCurve}
    shares = np.linspace(0, 1, 101)
    kinds = set()
    for words in (("row.txt",), ("ring.txt",), (cylinder, "--plane", "1,0,0.2,0.1", "--plane", "0,0,1,0.3")):
        files = {"step": folder / "c.stp", "iges": folder / "c.igs"}
        run("section", folder / words[0], *words[1:], "--json", folder / "c.json", "--step", files["step"], "--iges", files["iges"])
        answer = json.loads((folder / "c.json").read_text())
        for name, reader in (("step", STEPControl_Reader()), ("iges", IGESControl_Reader())):
            reader.ReadFile(str(files[name]))
            reader.TransferRoots()
            explorer = TopExp_Explorer(reader.OneShape(), TopAbs_EDGE)
            worst, count = 0, 0
            for contour in answer["contours"]:
                frame = answer["frame"] if contour["plane"] is None else answer["planes"][contour["plane"]]["frame"]
                for segment in contour["segments"]:
                    assert explorer.More(), f"{name}: too few edges"
                    curve = BRepAdaptor_Curve(TopoDS.Edge(explorer.Current()))
                    explorer.Next()
                    kinds.add(segment["kind"])
                    count += 1
                    assert curve.GetType() == types[segment["kind"]], f"{name}: {segment['kind']}"
                    if segment["kind"] == "spline":
                        assert [curve.Degree(), curve.NbPoles()] == [segment["degree"], len(segment["control_points"])], name
                    flat = along(segment, shares)
                    ours = frame["origin"] + np.outer(flat[:, 0], frame["x"]) + np.outer(flat[:, 1], frame["y"])
                    first, last = curve.FirstParameter(), curve.LastParameter()
                    seen = [curve.Value(first + t * (last - first)) for t in shares]
                    theirs = np.array([[p.X(), p.Y(), p.Z()] for p in seen])
                    # An arc of negative sweep is run through from its end in IGES.
                    if name == "iges" and segment["kind"] == "arc" and segment["sweep"] < 0:
                        theirs = theirs[::-1]
                    worst = max(worst, np.abs(ours - theirs).max())
            assert not explorer.More(), f"{name}: too many edges"
            assert worst < 1e-9, f"{name} {words}: {worst} mm"
            print(f"      {name} of {Path(words[0]).name}: {count} curves, {worst:.1e} mm at {101 * count} places")
    assert kinds == set(types), kinds


with tempfile.TemporaryDirectory() as scratch:
    for check in (deviations, reasons, meshes, regions, surfaces, foreign_surfaces, sections, drawings, qif):
        check(Path(scratch))
        print(f"ok    {check.__name__}: {check.__doc__}")
