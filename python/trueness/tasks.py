"""The tasks: a function for each command of the program.

Written by `generate.py` from the schemas of `docs/schema/`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Literal, Never

from ._progress import Progress
from ._run import Path, Source, Text, limits, run, several, text

if TYPE_CHECKING:
    from ._document import TaskDocument
    from ._run import ProposedPlan
    from .documents.align import AlignDocument
    from .documents.check import CheckDocument
    from .documents.compare import CompareDocument
    from .documents.convert import ConvertDocument
    from .documents.curvature import CurvatureDocument
    from .documents.fit import FitDocument
    from .documents.info import InfoDocument
    from .documents.inspect import InspectDocument
    from .documents.repair import RepairDocument
    from .documents.section import SectionDocument
    from .documents.segment import SegmentDocument
    from .documents.surface import SurfaceDocument
    from .documents.trend import TrendDocument


def align(
    measured: Source,
    reference: Source,
    *,
    units: str | None = None,
    format: str | None = None,
    columns: Text | None = None,
    reference_units: str | None = None,
    reference_format: str | None = None,
    out: Path | None = None,
    method: Literal["best-fit", "chebyshev", "zones", "pairs", "3-2-1", "rps"] = "best-fit",
    points: Path | None = None,
    tolerance: Text | None = None,
    regions: Source | None = None,
    from_here: bool = False,
    lock: Sequence[Literal["tx", "ty", "tz", "rx", "ry", "rz"]] = (),
    scale: bool = False,
    keep_outliers: bool = False,
    seed: int = 0,
    progress: Progress = None,
    **unknown: Never,
) -> AlignDocument:
    """Brings a scan onto its reference.

    Parameters
    ----------
    measured : Source
        The scan: a mesh or points.
    reference : Source
        The nominal: a mesh, which does not move.
    units : str | None
        Unit of a file that does not say its own: `mm`, `cm`, `m`, `in`, `um`; without it `mm`.
    format : str | None
        Format of the file; without it told by its content, then by its ending.
    columns : Text | None
        Columns of a table: where x, y, z are (`2,3,4` or `X,Y,Z`), or what each column is
        (`-,x,y,z`).
    reference_units : str | None
        Unit of the reference; without it that of the measured file.
    reference_format : str | None
        Format of the reference; without it told by its content.
    out : Path | None
        Where to write the scan in the frame of the reference, mm.
    method : Literal["best-fit", "chebyshev", "zones", "pairs", "3-2-1", "rps"]
        What makes a pose the best.
    points : Path | None
        Table of places that belong together, for `pairs`, `3-2-1` and `rps`.
    tolerance : Text | None
        For `zones`: what deviations may be, ±T or -L,+U in mm, where no region says otherwise.
    regions : Source | None
        For `zones`: regions of the reference with tolerances of their own.
    from_here : bool
        Start from the pose in the files instead of looking for one.
    lock : Sequence[Literal["tx", "ty", "tz", "rx", "ry", "rz"]]
        Components of the motion from here that stay zero: of the translation of the middle of the
        scan and of the rotation about it, in the frame of the reference; for `best-fit`.
    scale : bool
        Find a scale, too: how many times as large the scan has to be made; for `best-fit`.
    keep_outliers : bool
        Let all points count, however far off they are.
    seed : int
        Seed of everything random.
    progress : callable or bool, optional
        Called with stage, items done, their number and unit; ``True`` for a bar of tqdm.

    Returns
    -------
    AlignDocument
    """
    from .documents.align import AlignDocument

    given: dict[str, object] = {
        "measured": measured,
        "reference": reference,
        "units": units,
        "format": format,
        "columns": text(columns),
        "reference_units": reference_units,
        "reference_format": reference_format,
        "out": out,
        "method": method,
        "points": points,
        "tolerance": limits(tolerance),
        "regions": regions,
        "from_here": from_here,
        "lock": lock,
        "scale": scale,
        "keep_outliers": keep_outliers,
        "seed": seed,
    }
    return run("align", AlignDocument, given, progress, unknown)


def check(
    mesh: Source,
    *,
    units: str | None = None,
    format: str | None = None,
    gap: float | None = None,
    weld: float | None = None,
    sliver_angle: float = 0.1,
    island: float = 1.0,
    no_self_intersections: bool = False,
    items: int = 1000,
    view: bool = True,
    progress: Progress = None,
    **unknown: Never,
) -> CheckDocument:
    """Finds what is wrong with a mesh.

    Parameters
    ----------
    mesh : Source
        The mesh or the CAD model.
    units : str | None
        Unit of a file that does not say its own: `mm`, `cm`, `m`, `in`, `um`; without it `mm`.
    format : str | None
        Format of the file; without it told by its content, then by its ending.
    gap : float | None
        Distance up to which two places may have been meant as one, mm; without it eight steps of
        single precision.
    weld : float | None
        Join vertices within this distance before looking, mm; without it those at the same place.
    sliver_angle : float
        Facets with a smaller angle than this are slivers, degrees.
    island : float
        Shells with a smaller diagonal than this share of the whole are islands, percent.
    no_self_intersections : bool
        Do not look for self-intersections.
    items : int
        Defects of each kind to list in the document; all are counted.
    view : bool
        Keep what a report draws.
    progress : callable or bool, optional
        Called with stage, items done, their number and unit; ``True`` for a bar of tqdm.

    Returns
    -------
    CheckDocument

    Examples
    --------
    >>> import trueness as t
    >>> found = t.check("corpus/bunny/zipper_res4.ply")
    >>> found.facets, found.sound, found.exit_status
    (948, False, 1)
    >>> found.defects["holes"].count
    3
    """
    from .documents.check import CheckDocument

    given: dict[str, object] = {
        "mesh": mesh,
        "units": units,
        "format": format,
        "gap": gap,
        "weld": weld,
        "sliver_angle": sliver_angle,
        "island": island,
        "no_self_intersections": no_self_intersections,
        "items": items,
        "view": view,
    }
    return run("check", CheckDocument, given, progress, unknown)


def compare(
    measured: Source,
    references: Source | Sequence[Source],
    *,
    units: str | None = None,
    format: str | None = None,
    columns: Text | None = None,
    reference_units: str | None = None,
    reference_format: str | None = None,
    weld: float | None = None,
    out: Path | None = None,
    scale: Source | None = None,
    align: bool = False,
    method: Literal["exact", "paper"] = "exact",
    sign: Literal["auto", "pseudonormal", "winding", "none"] = "auto",
    tolerance: Text | None = None,
    regions: Source | None = None,
    inside: float = 100.0,
    max_distance: float | None = None,
    skip_boundary: bool = False,
    along: Text | None = None,
    facing: float | None = None,
    normals: Text | None = None,
    outliers: str | None = None,
    coverage: Text | None = None,
    min_coverage: float = 90.0,
    worst: int | None = None,
    sample: int | None = None,
    both: bool = False,
    independent: bool = False,
    research: bool = False,
    seed: int = 0,
    view: bool = True,
    progress: Progress = None,
    **unknown: Never,
) -> CompareDocument:
    """Deviations of a scan from one or several references, with statistics and verdict.

    Parameters
    ----------
    measured : Source
        The scan: points, or a mesh, whose vertices are compared.
    references : Source | Sequence[Source]
        The nominals, or the meshes under test: meshes, or B-spline surfaces; several are ranked side
        by side. At least one.
    units : str | None
        Unit of a file that does not say its own: `mm`, `cm`, `m`, `in`, `um`; without it `mm`.
    format : str | None
        Format of the file; without it told by its content, then by its ending.
    columns : Text | None
        Columns of a table: where x, y, z are (`2,3,4` or `X,Y,Z`), or what each column is
        (`-,x,y,z`).
    reference_units : str | None
        Unit of the reference; without it that of the measured file.
    reference_format : str | None
        Format of the reference; without it told by its content.
    weld : float | None
        Join vertices of the references within this distance, mm; without it those at the same place.
    out : Path | None
        Where to write x, y, z and deviation of every point, in input order. Several references have
        one file each: `name.1.csv`, `name.2.csv` …
    scale : Source | None
        Color scale of the report (an object `trueness/scale/1`); without it one that fits the
        tolerance or the deviations.
    align : bool
        Bring the scan to the first reference first, by the best fit from any pose.
    method : Literal["exact", "paper"]
        How distances are computed.
    sign : Literal["auto", "pseudonormal", "winding", "none"]
        How inside and outside are told apart.
    tolerance : Text | None
        Allowed deviation: T for ±T, or -L,+U with both signs, mm; the document then has a verdict.
    regions : Source | None
        Regions of the reference with tolerances of their own: a TOML file of `[[region]]` with id,
        seed or between, tolerance.
    inside : float
        Share of the points that must lie within the tolerance, percent; for a tolerance.
    max_distance : float | None
        Exclude (and count) points farther than this, mm.
    skip_boundary : bool
        Exclude (and count) points whose nearest place is a boundary edge of the reference.
    along : Text | None
        Measure along lines instead of to the nearest place: a direction `X,Y,Z`, or the normals of
        the `reference` or of the `measured`.
    facing : float | None
        Exclude (and count) points whose normals turn away from the reference's by more than this,
        degrees.
    normals : Text | None
        Columns of the normals in a table of points, for `facing` and `along` with `measured`; without
        it `nx,ny,nz`.
    outliers : str | None
        Exclude (and count) outliers: `mad:5` for 5 × 1.4826 MAD from the median, `3sigma` for 3 σ
        from the mean.
    coverage : Text | None
        Tell what part of the reference no point covers within a reach: `auto` (three spacings of the
        points) or mm. A tolerance tells it in any case.
    min_coverage : float
        Share of the reference that the points must cover for a pass, percent; 0: a part of it is
        measured on purpose.
    worst : int | None
        Name at most so many worst places above the reference, and as many below; 1 to 1000, without
        it 3.
    sample : int | None
        Compare so many points spread evenly over the measured mesh's area instead of its vertices; at
        least 1.
    both : bool
        Also from the reference to the measured mesh: Hausdorff and mean distance.
    independent : bool
        Of several references: take the errors of the points as independent, as of points probed one
        by one.
    research : bool
        Add bootstrap intervals, a normality test, the best distribution, Moran's I.
    seed : int
        Seed of everything random.
    view : bool
        Keep what a report draws.
    progress : callable or bool, optional
        Called with stage, items done, their number and unit; ``True`` for a bar of tqdm.

    Returns
    -------
    CompareDocument

    Examples
    --------
    >>> import trueness as t
    >>> scan, nominal = "corpus/bunny/zipper_res3.ply", "corpus/bunny/zipper_res4.ply"
    >>> found = t.compare(scan, nominal, tolerance=5, inside=90)
    >>> found.comparisons[0].deviation.all.count, found.verdict
    (1889, 'pass')
    """
    from .documents.compare import CompareDocument

    given: dict[str, object] = {
        "measured": measured,
        "references": several(references),
        "units": units,
        "format": format,
        "columns": text(columns),
        "reference_units": reference_units,
        "reference_format": reference_format,
        "weld": weld,
        "out": out,
        "scale": scale,
        "align": align,
        "method": method,
        "sign": sign,
        "tolerance": limits(tolerance),
        "regions": regions,
        "inside": inside,
        "max_distance": max_distance,
        "skip_boundary": skip_boundary,
        "along": text(along),
        "facing": facing,
        "normals": text(normals),
        "outliers": outliers,
        "coverage": text(coverage),
        "min_coverage": min_coverage,
        "worst": worst,
        "sample": sample,
        "both": both,
        "independent": independent,
        "research": research,
        "seed": seed,
        "view": view,
    }
    return run("compare", CompareDocument, given, progress, unknown)


def convert(
    input: Source,
    out: Path,
    *,
    units: str | None = None,
    format: str | None = None,
    columns: Text | None = None,
    chord: float | None = None,
    progress: Progress = None,
    **unknown: Never,
) -> ConvertDocument:
    """Writes a file or an object in another format.

    Parameters
    ----------
    input : Source
        A file of any format that is read as a mesh or points.
    out : Path
        Where to write it, in the format of its ending, mm.
    units : str | None
        Unit of a file that does not say its own: `mm`, `cm`, `m`, `in`, `um`; without it `mm`.
    format : str | None
        Format of the file; without it told by its content, then by its ending.
    columns : Text | None
        Columns of a table: where x, y, z are (`2,3,4` or `X,Y,Z`), or what each column is
        (`-,x,y,z`).
    chord : float | None
        How far facets of a CAD model may lie from its faces, mm; without it a twenty-thousandth of
        its diagonal.
    progress : callable or bool, optional
        Called with stage, items done, their number and unit; ``True`` for a bar of tqdm.

    Returns
    -------
    ConvertDocument
    """
    from .documents.convert import ConvertDocument

    given: dict[str, object] = {
        "input": input,
        "out": out,
        "units": units,
        "format": format,
        "columns": text(columns),
        "chord": chord,
    }
    return run("convert", ConvertDocument, given, progress, unknown)


def curvature(
    input: Source,
    *,
    degree: int = 3,
    neighbors: int | None = None,
    radius: float | None = None,
    boundary: bool = False,
    independent: bool = False,
    units: str | None = None,
    format: str | None = None,
    columns: Text | None = None,
    out: Path | None = None,
    color: Literal["mean", "gaussian", "k1", "k2"] = "mean",
    seed: int = 0,
    view: bool = True,
    progress: Progress = None,
    **unknown: Never,
) -> CurvatureDocument:
    """Principal, mean and Gaussian curvatures.

    Parameters
    ----------
    input : Source
        A mesh, or points.
    degree : int
        Degree of the polynomials, from 2 to 6.
    neighbors : int | None
        Fewest neighbors: whole rings of a mesh, the nearest ones of a cloud; without it 3 for each
        unknown, 30 of degree 3.
    radius : float | None
        All neighbors within this distance, mm, in place of a number of them: curvature at a scale of
        one's own.
    boundary : bool
        Places on a boundary have values too, from the one side that there is.
    independent : bool
        Take the errors of the points as independent, as of points probed one by one. Without it what
        neighbors share is found in the data, and uncertainties take it into account.
    units : str | None
        Unit of a file that does not say its own: `mm`, `cm`, `m`, `in`, `um`; without it `mm`.
    format : str | None
        Format of the file; without it told by its content, then by its ending.
    columns : Text | None
        Columns of a table: where x, y, z are (`2,3,4` or `X,Y,Z`), or what each column is
        (`-,x,y,z`).
    out : Path | None
        Where to write the vertices or points with their curvatures.
    color : Literal["mean", "gaussian", "k1", "k2"]
        The curvature that a `.ply` file of `out` is colored by.
    seed : int
        Seed of everything random.
    view : bool
        Keep what a report draws.
    progress : callable or bool, optional
        Called with stage, items done, their number and unit; ``True`` for a bar of tqdm.

    Returns
    -------
    CurvatureDocument
    """
    from .documents.curvature import CurvatureDocument

    given: dict[str, object] = {
        "input": input,
        "degree": degree,
        "neighbors": neighbors,
        "radius": radius,
        "boundary": boundary,
        "independent": independent,
        "units": units,
        "format": format,
        "columns": text(columns),
        "out": out,
        "color": color,
        "seed": seed,
        "view": view,
    }
    return run("curvature", CurvatureDocument, given, progress, unknown)


def fit(
    points: Source,
    *,
    shape: Literal["line", "plane", "circle", "ellipse", "sphere", "cylinder", "cone", "torus"] | None = None,
    method: Literal["gaussian", "minimum-zone", "minimum-circumscribed", "maximum-inscribed", "robust"] = "gaussian",
    units: str | None = None,
    format: str | None = None,
    columns: Text | None = None,
    independent: bool = False,
    seed: int = 0,
    view: bool = True,
    progress: Progress = None,
    **unknown: Never,
) -> FitDocument:
    """Fits an element, such as a plane or a cylinder, to points.

    Parameters
    ----------
    points : Source
        The points, or a mesh, whose vertices are taken.
    shape : Literal["line", "plane", "circle", "ellipse", "sphere", "cylinder", "cone", "torus"] | None
        What is fitted; it has to be given.
    method : Literal["gaussian", "minimum-zone", "minimum-circumscribed", "maximum-inscribed", "robust"]
        What makes an element the best.
    units : str | None
        Unit of a file that does not say its own: `mm`, `cm`, `m`, `in`, `um`; without it `mm`.
    format : str | None
        Format of the file; without it told by its content, then by its ending.
    columns : Text | None
        Columns of a table: where x, y, z are (`2,3,4` or `X,Y,Z`), or what each column is
        (`-,x,y,z`).
    independent : bool
        Take the errors of the points as independent, as of points probed one by one. Without it what
        neighbors share is found in the data, and uncertainties take it into account.
    seed : int
        Seed of everything random.
    view : bool
        Keep what a report draws.
    progress : callable or bool, optional
        Called with stage, items done, their number and unit; ``True`` for a bar of tqdm.

    Returns
    -------
    FitDocument

    Examples
    --------
    >>> import trueness as t
    >>> found = t.fit([[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]], shape="circle")
    >>> round(found.parameters["radius"], 12)
    1.0
    """
    from .documents.fit import FitDocument

    given: dict[str, object] = {
        "points": points,
        "shape": shape,
        "method": method,
        "units": units,
        "format": format,
        "columns": text(columns),
        "independent": independent,
        "seed": seed,
        "view": view,
    }
    return run("fit", FitDocument, given, progress, unknown)


def info(
    file: Source,
    *,
    units: str | None = None,
    format: str | None = None,
    columns: Text | None = None,
    progress: Progress = None,
    **unknown: Never,
) -> InfoDocument:
    """What is in a file.

    Parameters
    ----------
    file : Source
        A file of any format that is read.
    units : str | None
        Unit of a file that does not say its own: `mm`, `cm`, `m`, `in`, `um`; without it `mm`.
    format : str | None
        Format of the file; without it told by its content, then by its ending.
    columns : Text | None
        Columns of a table: where x, y, z are (`2,3,4` or `X,Y,Z`), or what each column is
        (`-,x,y,z`).
    progress : callable or bool, optional
        Called with stage, items done, their number and unit; ``True`` for a bar of tqdm.

    Returns
    -------
    InfoDocument
    """
    from .documents.info import InfoDocument

    given: dict[str, object] = {
        "file": file,
        "units": units,
        "format": format,
        "columns": text(columns),
    }
    return run("info", InfoDocument, given, progress, unknown)


def inspect(
    plan: Source,
    *,
    measured: Source | Sequence[Source] = (),
    places: bool = False,
    csv: Path | None = None,
    junit: Path | None = None,
    qif: Path | None = None,
    seed: int = 0,
    view: bool = True,
    progress: Progress = None,
    **unknown: Never,
) -> InspectDocument:
    """Runs an inspection plan.

    Parameters
    ----------
    plan : Source
        The plan; paths in it are relative to it.
    measured : Source | Sequence[Source]
        Measured meshes or clouds, in place of the plan's own: one part each.
    places : bool
        Keep in the document the deviations at places that are the same for every part: for the maps
        of a trend.
    csv : Path | None
        Where to write the characteristics of all parts as a table, one line each.
    junit : Path | None
        Where to write the verdicts as JUnit XML, for continuous integration.
    qif : Path | None
        Where to write characteristics, features, values and verdicts as QIF 3.0 results (ISO 23952).
    seed : int
        Seed of everything random.
    view : bool
        Keep what a report draws; of one part only.
    progress : callable or bool, optional
        Called with stage, items done, their number and unit; ``True`` for a bar of tqdm.

    Returns
    -------
    InspectDocument
    """
    from .documents.inspect import InspectDocument

    given: dict[str, object] = {
        "plan": plan,
        "measured": several(measured),
        "places": places,
        "csv": csv,
        "junit": junit,
        "qif": qif,
        "seed": seed,
        "view": view,
    }
    return run("inspect", InspectDocument, given, progress, unknown)


def plan_init(
    nominal: Source,
    *,
    units: str | None = None,
    format: str | None = None,
    general: str | None = None,
    out: Path | None = None,
    seed: int = 0,
    progress: Progress = None,
    **unknown: Never,
) -> ProposedPlan:
    """Proposes a plan from the nominal.

    Parameters
    ----------
    nominal : Source
        The nominal: a CAD model with or without tolerances, or a mesh.
    units : str | None
        Unit of a file that does not say its own: `mm`, `cm`, `m`, `in`, `um`; without it `mm`.
    format : str | None
        Format of the file; without it told by its content, then by its ending.
    general : str | None
        General tolerances for what a CAD model states none for, as `ISO2768-mK`.
    out : Path | None
        Where to write the plan: a new file.
    seed : int
        Seed of everything random.
    progress : callable or bool, optional
        Called with stage, items done, their number and unit; ``True`` for a bar of tqdm.

    Returns
    -------
    ProposedPlan
    """
    from ._run import ProposedPlan

    given: dict[str, object] = {
        "nominal": nominal,
        "units": units,
        "format": format,
        "general": general,
        "out": out,
        "seed": seed,
    }
    return run("plan_init", ProposedPlan, given, progress, unknown)


def repair(
    mesh: Source,
    *,
    units: str | None = None,
    format: str | None = None,
    out: Path | None = None,
    in_place: bool = False,
    only: Sequence[str] = (),
    skip: Sequence[str] = (),
    gap: float | None = None,
    holes: float = 25.0,
    all_holes: bool = False,
    stitch: float | None = None,
    remove_islands: float | None = None,
    max_change: float = 0.01,
    items: int = 1000,
    view: bool = True,
    progress: Progress = None,
    **unknown: Never,
) -> RepairDocument:
    """Mends what `check` finds.

    Parameters
    ----------
    mesh : Source
        The mesh.
    units : str | None
        Unit of a file that does not say its own: `mm`, `cm`, `m`, `in`, `um`; without it `mm`.
    format : str | None
        Format of the file; without it told by its content, then by its ending.
    out : Path | None
        Where to write the mended mesh, mm; STL holds single precision only.
    in_place : bool
        Replace the mesh by the mended one, once that is written and read again.
    only : Sequence[str]
        Only these steps, in their own order; none: all. See [`STEPS`](trueness_solid::repair::STEPS).
    skip : Sequence[str]
        All steps but these.
    gap : float | None
        Distance up to which two places may have been meant as one, mm; without it eight steps of
        single precision.
    holes : float
        Fill holes up to this share of the area of their shell, percent; of a shell with a larger one,
        up to 0.5 % only.
    all_holes : bool
        Fill all holes, however large, even the rim of a sheet that is not flat; `holes` does not
        count then.
    stitch : float | None
        Stitch edges up to this distance, mm; without it a ten-thousandth of the diagonal.
    remove_islands : float | None
        Remove shells with a smaller diagonal than this share of the whole, percent; without it none.
    max_change : float
        Share of the diagonal, and of the volume, by which the part may change, percent.
    items : int
        Changes to list in the document; all are counted.
    view : bool
        Keep what a report draws.
    progress : callable or bool, optional
        Called with stage, items done, their number and unit; ``True`` for a bar of tqdm.

    Returns
    -------
    RepairDocument
    """
    from .documents.repair import RepairDocument

    given: dict[str, object] = {
        "mesh": mesh,
        "units": units,
        "format": format,
        "out": out,
        "in_place": in_place,
        "only": only,
        "skip": skip,
        "gap": gap,
        "holes": holes,
        "all_holes": all_holes,
        "stitch": stitch,
        "remove_islands": remove_islands,
        "max_change": max_change,
        "items": items,
        "view": view,
    }
    return run("repair", RepairDocument, given, progress, unknown)


def section(
    input: Source,
    *,
    units: str | None = None,
    format: str | None = None,
    columns: Text | None = None,
    plane: Sequence[Sequence[float]] = (),
    stack: Sequence[Sequence[float]] = (),
    thickness: float | None = None,
    gap: float | None = None,
    noise: float | None = None,
    continuity: Literal["g0", "g1", "g2"] | None = None,
    closed: bool = False,
    open: bool = False,
    level: float = 95.0,
    airfoil: bool = False,
    stacking: Sequence[float] | None = None,
    tidy: bool = False,
    independent: bool = False,
    search: Literal["golden", "stepwise", "improved"] | None = None,
    interval: Literal["profile", "paper"] = "profile",
    nominal: Source | None = None,
    reference_units: str | None = None,
    reference_format: str | None = None,
    fit: Literal["free", "xy", "x", "y", "turn", "none"] | None = None,
    tolerance: Text | None = None,
    inside: float = 100.0,
    min_coverage: float = 90.0,
    max_distance: float | None = None,
    dxf: Path | None = None,
    svg: Path | None = None,
    step: Path | None = None,
    iges: Path | None = None,
    out: Path | None = None,
    seed: int = 0,
    view: bool = True,
    progress: Progress = None,
    **unknown: Never,
) -> SectionDocument:
    """Lines, arcs and curves of a profile, or of a mesh or cloud in planes.

    Parameters
    ----------
    input : Source
        Points in order, of two or three columns, or with planes a mesh or a cloud.
    units : str | None
        Unit of a file that does not say its own: `mm`, `cm`, `m`, `in`, `um`; without it `mm`.
    format : str | None
        Format of the file; without it told by its content, then by its ending.
    columns : Text | None
        Columns of a table: where x, y, z are (`2,3,4` or `X,Y,Z`), or what each column is
        (`-,x,y,z`).
    plane : Sequence[Sequence[float]]
        Planes that cut a mesh or cloud: each at right angles to nx, ny, nz, at the distance d from
        the origin.
    stack : Sequence[Sequence[float]]
        Stacks of parallel planes: normal, first and last distance from the origin, step.
    thickness : float | None
        Thickness of the slab of a cloud whose points count as on the plane, mm.
    gap : float | None
        Contours of a cloud go on over gaps up to this, mm; without it told from how uneven the points
        lie.
    noise : float | None
        Standard deviation of the points across the contour, mm; without it found from the data.
    continuity : Literal["g0", "g1", "g2"] | None
        Continuity of all joins; without it told from the data.
    closed : bool
        The contour is closed; if it is not said to be open either, the gap between its ends tells.
    open : bool
        The contour is open.
    level : float
        Confidence of the intervals, percent.
    airfoil : bool
        Measure each contour as an airfoil or blade: chords, camber line, greatest thickness, radii of
        its edges; with a nominal also twist and offset.
    stacking : Sequence[float] | None
        Stacking point of the airfoils in the nominal's coordinates of the plane, mm; without it the
        centroid of the nominal's profile.
    tidy : bool
        Offer what a drawing would have, where the points allow it; the contour stays as it is found.
    independent : bool
        Take the errors of the points as independent, as of points probed one by one. Without it what
        neighbors share is found in the data, and uncertainties take it into account.
    search : Literal["golden", "stepwise", "improved"] | None
        Find one join, that of a line at an end of the row and one curve, by this method; all stand in
        the document.
    interval : Literal["profile", "paper"]
        Interval of the golden-section search: from the likelihood, or from the paper's 3 σ and
        correlation.
    nominal : Source | None
        Compare the points with the section of this nominal: a mesh, a DXF drawing in the plane's
        coordinates, or points in order.
    reference_units : str | None
        Unit of the reference; without it that of the measured file.
    reference_format : str | None
        Format of the reference; without it told by its content.
    fit : Literal["free", "xy", "x", "y", "turn", "none"] | None
        Bring the section nearest to the nominal first, within its plane, by least squares; without it
        it stays where it is.
    tolerance : Text | None
        Allowed deviation of the profile: ±T or -L,+U in mm.
    inside : float
        Share of the points that must lie within the tolerance, percent.
    min_coverage : float
        Share of the nominal's length that must be measured for a pass, and of the points that must
        have a counterpart on it, percent.
    max_distance : float | None
        Exclude (and count) points farther from the nominal than this, mm; the best fit does not look
        at them either.
    dxf : Path | None
        Where to write a DXF drawing, a layer for each plane.
    svg : Path | None
        Where to write an SVG drawing, 1 to 1.
    step : Path | None
        Where to write the curves in space as STEP (AP214).
    iges : Path | None
        Where to write the curves in space as IGES (entities 100, 110, 126).
    out : Path | None
        Where to write the points with contour, segment, length along the contour and distance, CSV.
    seed : int
        Seed of everything random.
    view : bool
        Keep what a report draws.
    progress : callable or bool, optional
        Called with stage, items done, their number and unit; ``True`` for a bar of tqdm.

    Returns
    -------
    SectionDocument
    """
    from .documents.section import SectionDocument

    given: dict[str, object] = {
        "input": input,
        "units": units,
        "format": format,
        "columns": text(columns),
        "plane": plane,
        "stack": stack,
        "thickness": thickness,
        "gap": gap,
        "noise": noise,
        "continuity": continuity,
        "closed": closed,
        "open": open,
        "level": level,
        "airfoil": airfoil,
        "stacking": stacking,
        "tidy": tidy,
        "independent": independent,
        "search": search,
        "interval": interval,
        "nominal": nominal,
        "reference_units": reference_units,
        "reference_format": reference_format,
        "fit": fit,
        "tolerance": limits(tolerance),
        "inside": inside,
        "min_coverage": min_coverage,
        "max_distance": max_distance,
        "dxf": dxf,
        "svg": svg,
        "step": step,
        "iges": iges,
        "out": out,
        "seed": seed,
        "view": view,
    }
    return run("section", SectionDocument, given, progress, unknown)


def segment(
    input: Source,
    *,
    shapes: Sequence[Literal["plane", "cylinder", "cone", "sphere", "torus"]] = ('plane', 'cylinder', 'cone', 'sphere', 'torus'),
    tolerance: float | None = None,
    crease: float = 32.0,
    min_share: float | None = None,
    min_points: int = 0,
    units: str | None = None,
    format: str | None = None,
    columns: Text | None = None,
    independent: bool = False,
    members: bool = False,
    out: Path | None = None,
    seed: int = 0,
    view: bool = True,
    progress: Progress = None,
    **unknown: Never,
) -> SegmentDocument:
    """Finds planes, cylinders and other elements in a scan.

    Parameters
    ----------
    input : Source
        A mesh, or points.
    shapes : Sequence[Literal["plane", "cylinder", "cone", "sphere", "torus"]]
        What is looked for.
    tolerance : float | None
        Distance up to which a point belongs to an element, mm; without it eight standard deviations
        of the noise found.
    crease : float
        Angle between neighboring facets, or normals of points, from which on there is an edge between
        them, degrees.
    min_share : float | None
        Least share of the area, or of the points of a cloud, that a region must have, percent;
        without it 0.2, of a drawn mesh 0.01.
    min_points : int
        Fewest measured points of a region.
    units : str | None
        Unit of a file that does not say its own: `mm`, `cm`, `m`, `in`, `um`; without it `mm`.
    format : str | None
        Format of the file; without it told by its content, then by its ending.
    columns : Text | None
        Columns of a table: where x, y, z are (`2,3,4` or `X,Y,Z`), or what each column is
        (`-,x,y,z`).
    independent : bool
        Take the errors of the points as independent, as of points probed one by one. Without it what
        neighbors share is found in the data, and uncertainties take it into account.
    members : bool
        List the facets or points of every region in the document.
    out : Path | None
        Where to write the facets or points with the number of their region.
    seed : int
        Seed of everything random.
    view : bool
        Keep what a report draws.
    progress : callable or bool, optional
        Called with stage, items done, their number and unit; ``True`` for a bar of tqdm.

    Returns
    -------
    SegmentDocument
    """
    from .documents.segment import SegmentDocument

    given: dict[str, object] = {
        "input": input,
        "shapes": shapes,
        "tolerance": tolerance,
        "crease": crease,
        "min_share": min_share,
        "min_points": min_points,
        "units": units,
        "format": format,
        "columns": text(columns),
        "independent": independent,
        "members": members,
        "out": out,
        "seed": seed,
        "view": view,
    }
    return run("segment", SegmentDocument, given, progress, unknown)


def surface(
    points: Source,
    *,
    degree: Text | None = None,
    spans: Text | None = None,
    knots: Path | None = None,
    tolerance: float | None = None,
    base: Literal["plane", "xy", "cylinder", "sphere", "mesh"] = "plane",
    fairness: Text | None = None,
    corrections: int = 5,
    robust: bool = False,
    trim: str | None = None,
    units: str | None = None,
    format: str | None = None,
    columns: Text | None = None,
    step: Path | None = None,
    iges: Path | None = None,
    obj: Path | None = None,
    chord: float | None = None,
    view: bool = True,
    progress: Progress = None,
    **unknown: Never,
) -> SurfaceDocument:
    """A B-spline surface through points.

    Parameters
    ----------
    points : Source
        The points, or a mesh, whose vertices are taken.
    degree : Text | None
        Degrees along u and v, `3x3`; without it 3x3, or those that the knots tell.
    spans : Text | None
        Equal spans along u and v, `8x8`; without it 8x8; on a cylinder or sphere one for each 15°,
        where that is more.
    knots : Path | None
        Whole clamped knots: a JSON file `{"u": […], "v": […]}`.
    tolerance : float | None
        Set knots until all points are within this distance, mm, or until noise is all that is left.
    base : Literal["plane", "xy", "cylinder", "sphere", "mesh"]
        What the parameters are taken from.
    fairness : Text | None
        Weight of the thin-plate term, mm²: `auto`, or a number (0 for none); without it `auto`.
    corrections : int
        Corrections of the parameters to the nearest places at most, 50 or fewer; with the base `xy`
        there are none.
    robust : bool
        Leave out points that contradict their neighbors; they are counted.
    trim : str | None
        Cut the surface along the outline of the points; gaps up to twice this length (mm) do not
        count; `auto`: three times the distance of neighbors.
    units : str | None
        Unit of a file that does not say its own: `mm`, `cm`, `m`, `in`, `um`; without it `mm`.
    format : str | None
        Format of the file; without it told by its content, then by its ending.
    columns : Text | None
        Columns of a table: where x, y, z are (`2,3,4` or `X,Y,Z`), or what each column is
        (`-,x,y,z`).
    step : Path | None
        Where to write the surface as STEP (AP214).
    iges : Path | None
        Where to write the surface as IGES (entity 128; with `trim` 144).
    obj : Path | None
        Where to write facets of the surface (.obj).
    chord : float | None
        Distance that the facets keep from the surface, mm; without it a ten thousandth of its size.
    view : bool
        Keep what a report draws.
    progress : callable or bool, optional
        Called with stage, items done, their number and unit; ``True`` for a bar of tqdm.

    Returns
    -------
    SurfaceDocument
    """
    from .documents.surface import SurfaceDocument

    given: dict[str, object] = {
        "points": points,
        "degree": text(degree),
        "spans": text(spans),
        "knots": knots,
        "tolerance": tolerance,
        "base": base,
        "fairness": text(fairness),
        "corrections": corrections,
        "robust": robust,
        "trim": trim,
        "units": units,
        "format": format,
        "columns": text(columns),
        "step": step,
        "iges": iges,
        "obj": obj,
        "chord": chord,
        "view": view,
    }
    return run("surface", SurfaceDocument, given, progress, unknown)


def trend(
    results: Sequence[Source | TaskDocument],
    *,
    csv: Path | None = None,
    progress: Progress = None,
    **unknown: Never,
) -> TrendDocument:
    """One plan over many parts: course, spread, capability.

    Parameters
    ----------
    results : Sequence[Source | TaskDocument]
        Results of inspections by one plan, one part each, in the order in which the parts were made.
    csv : Path | None
        Where to write the characteristics as a table, one line each.
    progress : callable or bool, optional
        Called with stage, items done, their number and unit; ``True`` for a bar of tqdm.

    Returns
    -------
    TrendDocument
    """
    from .documents.trend import TrendDocument

    given: dict[str, object] = {
        "results": several(results),
        "csv": csv,
    }
    return run("trend", TrendDocument, given, progress, unknown)
