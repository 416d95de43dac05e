"""The documents of the tasks, with types.

Written by `generate.py` from the schemas of `docs/schema/`."""

from __future__ import annotations

from .align import AlignDocument as AlignDocument
from .check import CheckDocument as CheckDocument
from .compare import CompareDocument as CompareDocument
from .convert import ConvertDocument as ConvertDocument
from .curvature import CurvatureDocument as CurvatureDocument
from .fit import FitDocument as FitDocument
from .info import InfoDocument as InfoDocument
from .inspect import InspectDocument as InspectDocument
from .repair import RepairDocument as RepairDocument
from .section import SectionDocument as SectionDocument
from .segment import SegmentDocument as SegmentDocument
from .surface import SurfaceDocument as SurfaceDocument
from .trend import TrendDocument as TrendDocument
