"""Joint moments, powers and ground forces of human walking, from motion alone.

>>> import ambulo
>>> walk = ambulo.walk(speed=1.2)
>>> walk.moments["knee_angle_r_moment"].shape
(330,)

The functions compute what the command ``ambulo`` computes, with the same defaults, checks and messages.
"""

from ambulo._ambulo import Model
from ambulo._ambulo import version as _version
from ambulo._batch import Batch, BatchTable
from ambulo._calls import (
    batch,
    calibrate,
    calibrate_person,
    forces,
    model,
    open,  # noqa: A004
    session,
    simulate,
    sweep,
    validate,
    walk,
)
from ambulo._errors import AmbuloError, AmbuloWarning, Finding, InputError
from ambulo._options import ForcesOptions, MuscleOptions
from ambulo._person import Person
from ambulo._recording import Recording, coordinates, markers, read
from ambulo._result import Result
from ambulo._stream import Stream
from ambulo._table import Table
from ambulo._verbs import compare, convert, demo, events, info, report, reproduce, tune, view

__version__: str = _version()

# Without `open`, which would replace the function of Python after `from ambulo import *`.
__all__ = [
    "AmbuloError",
    "AmbuloWarning",
    "Batch",
    "BatchTable",
    "Finding",
    "ForcesOptions",
    "InputError",
    "Model",
    "MuscleOptions",
    "Person",
    "Recording",
    "Result",
    "Stream",
    "Table",
    "batch",
    "calibrate",
    "calibrate_person",
    "compare",
    "convert",
    "coordinates",
    "demo",
    "events",
    "forces",
    "info",
    "markers",
    "model",
    "read",
    "report",
    "reproduce",
    "session",
    "simulate",
    "sweep",
    "tune",
    "validate",
    "view",
    "walk",
]
