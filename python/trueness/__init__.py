"""3D inspection: how far is every measured point from the model?

Lengths are millimeters, angles radians, deviations positive outside of the material. Answers are exact, and the same for any number
of threads.

>>> import trueness as t
>>> nominal = t.read("corpus/bunny/zipper_res4.ply")
>>> scan = t.read("corpus/bunny/zipper_res3.ply")
>>> found = nominal.deviation(scan, tolerance=5)
>>> found
Deviation(1887 of 1887 points, rms 1.376 mm)
>>> round(found.within(5), 3)
0.998
"""

# What packages that are not installed have for types is unknown.
# pyright: reportUnknownMemberType=false, reportUnknownVariableType=false, reportUnknownArgumentType=false
from __future__ import annotations

from ._deviation import Deviation as Deviation
from ._document import Record as Record
from ._document import TaskDocument as TaskDocument
from ._errors import CancelledError as CancelledError
from ._errors import FileError as FileError
from ._errors import InternalError as InternalError
from ._errors import MissingFileError as MissingFileError
from ._errors import TruenessError as TruenessError
from ._errors import UnanswerableError as UnanswerableError
from ._errors import UsageError as UsageError
from ._geometry import Closest as Closest
from ._geometry import ClosestOnModel as ClosestOnModel
from ._geometry import Cloud as Cloud
from ._geometry import Mesh as Mesh
from ._geometry import Model as Model
from ._geometry import read as read
from ._run import ProposedPlan as ProposedPlan
from ._trueness import __version__ as __version__
from .interop import from_meshio as from_meshio
from .interop import from_open3d as from_open3d
from .interop import from_pyvista as from_pyvista
from .interop import from_trimesh as from_trimesh
from .interop import to_meshio as to_meshio
from .interop import to_open3d as to_open3d
from .interop import to_pyvista as to_pyvista
from .interop import to_trimesh as to_trimesh
from .tasks import align as align
from .tasks import check as check
from .tasks import compare as compare
from .tasks import convert as convert
from .tasks import curvature as curvature
from .tasks import fit as fit
from .tasks import info as info
from .tasks import inspect as inspect
from .tasks import plan_init as plan_init
from .tasks import repair as repair
from .tasks import section as section
from .tasks import segment as segment
from .tasks import surface as surface
from .tasks import trend as trend
