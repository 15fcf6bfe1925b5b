"""Types of options, for editors and type checkers."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, BinaryIO, Literal, Protocol, TypedDict

if TYPE_CHECKING:
    from typing import TypeAlias

    import numpy as np
    from numpy.typing import NDArray

    from ambulo._ambulo import Model
    from ambulo._person import Person
    from ambulo._recording import Recording
    from ambulo._table import Table


class Frame(Protocol):
    """A data frame of pandas or polars."""

    @property
    def columns(self) -> Any:
        """Names of the columns."""

    def to_numpy(self) -> NDArray[np.generic]:
        """Return all values."""
        ...

    def __getitem__(self, name: Any, /) -> Any:
        """Return a column."""


if TYPE_CHECKING:
    #: A file.
    Path: TypeAlias = str | os.PathLike[str]
    #: A file, or its content.
    File: TypeAlias = Path | bytes | BinaryIO
    #: A recording, or a table of coordinates or forces.
    Recorded: TypeAlias = Recording | Table | Frame | Path | BinaryIO
    #: The body.
    Body: TypeAlias = Model | File

#: Words of options.
Fit = Literal["frames", "trajectory"]
Hip = Literal["harrington", "hara", "bell", "plug-in-gait"]
KneeAxis = Literal["markers", "least-cross-talk"]
Convention = Literal["clinical", "opensim"]
Filter = Literal["butterworth", "spline"]
Consistent = Literal["motion", "body"]
WalkMode = Literal["optimal", "predict", "corrected", "paper", "physical"]
What = Literal["markers", "analog", "forces"]


class MuscleOptions(TypedDict, total=False):
    """Settings of the muscles that differ from the defaults: the argument `muscles` of `forces` (docs/MUSCLES.md)."""

    reserves: str
    emg: str
    wraps: Literal["exact", "opensim"]
    pennation: Literal["opensim", "exact"]
    exponent: float
    weights: Mapping[str, float]
    condyles_m: float


class ForcesOptions(TypedDict, total=False):
    """Options of `forces`, also for every trial of `batch` and `session`, where files are paths."""

    model: Body | None
    setup: Path | Sequence[Path] | None
    mass: float | None
    height: float | None
    static: Recorded | None
    functional: Recorded | None
    grf: Recorded | None
    loads: File | None
    right: str | None
    left: str | None
    plates: Mapping[int, str] | None
    trial: int | str | None
    smpl: File | None
    heading: str | None
    earth: tuple[float, float, float] | None
    person: Person | File | None
    predict: bool
    track: bool
    refit: bool
    ground: bool
    figure: str | None
    subject: str | None
    markers: Path | None
    marker_set: File | None
    fit: Fit | None
    hip: Hip | None
    knee_axis: KneeAxis | None
    max_gap: float | None
    convention: Convention | None
    start: float | None
    end: float | None
    rate: float | None
    filter: Filter | None
    cutoff: float | Literal["off"] | None
    force_cutoff: float | Literal["same", "off"] | None
    force_delay: float | None
    order: int | None
    consistent: bool | Consistent | None
    device: Recorded | None
    add_mass: Sequence[str] | None
    muscles: bool | MuscleOptions
    thresholds: Path | None
    keep: Sequence[str] | None
