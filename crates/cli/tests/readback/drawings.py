"""Drawings of `section` by programs that read DXF and SVG."""

import json
from pathlib import Path
from xml.etree import ElementTree

import ezdxf
import numpy as np
import svgelements

from common import CORPUS, along, mixed_row, run


def drawings(folder):
    """DXF and SVG files of `section` are sound and hold the same lines, arcs and B-splines, in millimeters, for ezdxf and svgelements."""
    random = np.random.default_rng(9)
    # Also from the other end: the arc turns the other way.
    for name, step in (("row.txt", 1), ("back.txt", -1)):
        row = mixed_row()[::step]
        np.savetxt(folder / name, row + 0.002 * random.standard_normal(row.shape), fmt="%.17g")
    circle = np.linspace(0, 2 * np.pi, 200, endpoint=False)
    np.savetxt(folder / "ring.txt", 5 * np.stack([np.cos(circle), np.sin(circle)], axis=1) + 0.001 * random.standard_normal((200, 2)), fmt="%.17g")
    cylinder = CORPUS / "broken" / "ok_cylinder.stl"
    shares = np.linspace(0, 1, 101)
    kinds = set()
    for words in (("row.txt",), ("back.txt",), ("ring.txt",), (cylinder, "--plane", "1,0,0.2,0.1", "--plane", "0,0,1,0.3")):
        files = [folder / "c.dxf", folder / "c.svg"]
        run("section", folder / words[0], *words[1:], "--json", folder / "c.json", "--dxf", files[0], "--svg", files[1])
        answer = json.loads((folder / "c.json").read_text())
        ours = [
            (f"section-{1 + (c['plane'] or 0)}", segment) for c in answer["contours"] for segment in c["segments"]
        ]
        kinds |= {segment["kind"] for _, segment in ours}
        for name, theirs in (("dxf", dxf_places(files[0], shares)), ("svg", svg_places(files[1], [s for _, s in ours], shares))):
            assert len(theirs) == len(ours), f"{name}: {len(theirs)} entities of {len(ours)}"
            worst = 0
            for (layer, segment), (kind, on, places) in zip(ours, theirs):
                assert (kind, on) == (segment["kind"], layer), f"{name}: {kind} on {on}, not {segment['kind']} on {layer}"
                flat = along(segment, shares)
                # DXF knows no clockwise arcs; and a whole circle has no start.
                ways = [places, places[::-1]] if name == "dxf" and kind == "arc" else [places]
                if kind == "arc" and abs(segment["sweep"]) > 6.283:
                    radii = np.linalg.norm(places - segment["center"], axis=1)
                    worst = max(worst, np.abs(radii - segment["radius"]).max())
                else:
                    worst = max(worst, min(np.abs(flat - way).max() for way in ways))
            assert worst < 1e-9, f"{name} {words}: {worst} mm"
            print(f"      {name} of {Path(words[0]).name}: {len(ours)} entities, {worst:.1e} mm at {101 * len(ours)} places")
    assert kinds == {"line", "arc", "spline"}, kinds


def dxf_places(path, shares):
    """Kind, layer and places of each entity for ezdxf, which has nothing to say against the file."""
    document = ezdxf.readfile(path)
    audit = document.audit()
    assert not audit.errors and not audit.fixes, (audit.errors, audit.fixes)
    assert document.header["$INSUNITS"] == ezdxf.units.MM
    found = []
    for e in document.modelspace():
        if e.dxftype() == "LINE":
            start, end = np.array(e.dxf.start)[:2], np.array(e.dxf.end)[:2]
            kind, places = "line", np.outer(1 - shares, start) + np.outer(shares, end)
        elif e.dxftype() == "SPLINE":
            spline = e.construction_tool()
            kind, places = "spline", np.array([list(p)[:2] for p in spline.points(shares * spline.max_t)])
        else:
            whole = e.dxftype() == "CIRCLE"
            start, end = (0, 360) if whole else (e.dxf.start_angle, e.dxf.end_angle)
            angles = np.radians(start + shares * (360 if whole else (end - start) % 360))
            kind = "arc"
            places = np.array(e.dxf.center)[:2] + e.dxf.radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)
        found.append((kind, e.dxf.layer, places))
    return found


def svg_places(path, segments, shares):
    """Kind, group and places, in millimeters on paper, of each path and circle for svgelements."""
    root = ElementTree.parse(path).getroot()
    groups = [g.get("id") for g in root for _ in g]
    low = [float(x) for x in root.get("viewBox").split()[:2]]
    paths = [abs(svgelements.Path(e)) for e in svgelements.SVG.parse(path).elements() if isinstance(e, svgelements.Shape)]
    found = []
    for group, path, segment in zip(groups, paths, segments, strict=True):
        pieces = [p for p in path if not isinstance(p, (svgelements.Move, svgelements.Close))]
        kind = {svgelements.Line: "line", svgelements.Arc: "arc", svgelements.CubicBezier: "spline"}[type(pieces[0])]
        if kind == "spline":
            # A curve of its own for each span of knots.
            knots = np.unique(segment["knots"])
            assert len(pieces) == len(knots) - 1, "one Bezier curve for each span"
            at = knots[0] + shares * (knots[-1] - knots[0])
            span = np.clip(np.searchsorted(knots, at, side="right") - 1, 0, len(pieces) - 1)
            places = [pieces[k].point((t - knots[k]) / (knots[k + 1] - knots[k])) for k, t in zip(span, at)]
        else:
            per = len(pieces)
            places = [pieces[min(int(t * per), per - 1)].point(t * per - min(int(t * per), per - 1)) for t in shares]
        # The screen counts in its own millimeters; y runs downwards there.
        found.append((kind, group, (np.array([[p.x, p.y] for p in places]) / svgelements.Length("1mm").value(ppi=96) + low) * [1, -1]))
    return found
