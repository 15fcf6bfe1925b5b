from collections.abc import Sequence
from os import PathLike
from typing import Any, TypedDict, final, type_check_only

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ambulo._errors import Finding

__all__ = [
    "Model",
    "Results",
    "Stream",
    "arrow_stream",
    "calibrate",
    "clinical_wording",
    "command",
    "forces",
    "open",
    "printed",
    "read",
    "read_markers",
    "read_table",
    "run",
    "version",
    "write_markers",
    "write_table",
]

_Path = str | PathLike[str]
_Files = Sequence[tuple[_Path, bytes]]
_Options = dict[str, Any]
_Parts = tuple[str, bool | None, list[str], NDArray[np.float64]]

@type_check_only
class BodyMotions(TypedDict):
    """Motion of the bodies in world axes; n frames, b bodies."""

    bodies: list[str]
    rotation: NDArray[np.float64]
    origin: NDArray[np.float64]
    center: NDArray[np.float64]
    velocity: NDArray[np.float64]
    angular_velocity: NDArray[np.float64]
    acceleration: NDArray[np.float64]
    angular_acceleration: NDArray[np.float64]

@type_check_only
class MusclePaths(TypedDict):
    """Paths of the muscles; n frames, m muscles."""

    muscles: list[str]
    length: NDArray[np.float64]
    speed: NDArray[np.float64]
    arm: NDArray[np.float64]

@type_check_only
class MuscleForces(TypedDict):
    """Muscle forces; n frames, m muscles."""

    muscles: list[str]
    activation: NDArray[np.float64]
    force: NDArray[np.float64]
    reserve: NDArray[np.float64]

@type_check_only
class MarkerFit(TypedDict):
    """Coordinates that follow markers."""

    coordinates: list[str]
    q: NDArray[np.float64]
    rms: NDArray[np.float64]
    converged: NDArray[np.bool_]

@type_check_only
class SmoothMotion(TypedDict):
    """Smoothed coordinates with two derivatives."""

    times: NDArray[np.float64]
    q: NDArray[np.float64]
    qd: NDArray[np.float64]
    qdd: NDArray[np.float64]

@final
class Model:
    def __new__(cls, data: bytes, name: _Path) -> Model: ...
    def __reduce__(self) -> tuple[Any, ...]: ...
    @property
    def data(self) -> bytes: ...
    @property
    def file(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def mass(self) -> float: ...
    @property
    def bodies(self) -> list[str]: ...
    @property
    def coordinates(self) -> list[str]: ...
    @property
    def force_names(self) -> list[str]: ...
    @property
    def markers(self) -> list[str]: ...
    @property
    def findings(self) -> list[Finding]: ...
    def inverse_dynamics(
        self,
        q: ArrayLike,
        qd: ArrayLike,
        qdd: ArrayLike,
        loads: dict[str, ArrayLike] | None = None,
        out: NDArray[np.float64] | None = None,
    ) -> NDArray[np.float64]: ...
    def forward_kinematics(
        self, q: ArrayLike, qd: ArrayLike | None = None, qdd: ArrayLike | None = None
    ) -> BodyMotions: ...
    @property
    def muscles(self) -> list[str]: ...
    def muscle_paths(self, q: ArrayLike, qd: ArrayLike | None = None, wraps: str = "exact") -> MusclePaths: ...
    def static_optimization(
        self,
        q: ArrayLike,
        qd: ArrayLike,
        moments: ArrayLike,
        exponent: float | None = None,
        wraps: str = "exact",
    ) -> MuscleForces: ...
    def fit_markers(self, names: Sequence[str], positions: ArrayLike, rate: float) -> MarkerFit: ...
    def smooth(
        self,
        q: ArrayLike,
        rate: float,
        filter: str | None = None,
        cutoff: float | str | None = None,
        order: int | None = None,
    ) -> SmoothMotion: ...
    def _time_of_batch(self, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike, repeats: int) -> float: ...
    def predict_ground(
        self,
        q: ArrayLike,
        qd: ArrayLike,
        qdd: ArrayLike,
        rate: float,
        filter: str | None = None,
        cutoff: float | str | None = None,
        order: int | None = None,
    ) -> dict[str, NDArray[np.float64]]: ...

@final
class Stream:
    def __new__(
        cls,
        model: Model,
        rate: float,
        delay: float | None = None,
        window: float | None = None,
        filter: str | None = None,
        cutoff: float | str | None = None,
        order: int | None = None,
    ) -> Stream: ...
    def columns(self) -> list[tuple[str, str]]: ...
    def delay_frames(self) -> int: ...
    def rate(self) -> float: ...
    def findings(self) -> list[Finding]: ...
    def push(self, q: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...
    def finish(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...

@final
class Results:
    def names(self) -> list[str]: ...
    def content(self, name: str) -> bytes | None: ...
    def table(self, name: str) -> _Parts | None: ...
    def units(self, table: str, columns: Sequence[str]) -> list[str]: ...
    def summary(self) -> bytes: ...
    def timings(self) -> dict[str, float]: ...
    def page(self) -> bytes: ...
    def save(self, folder: _Path, force: bool) -> None: ...

def version() -> str: ...
def clinical_wording(column: str) -> tuple[str, list[str]] | None: ...
def command(words: Sequence[str]) -> int: ...
def printed(words: Sequence[_Path]) -> str: ...
def forces(options: _Options, files: _Files) -> Results: ...
def calibrate(
    trials: Sequence[_Path], measured: Sequence[Sequence[_Path]], options: _Options, files: _Files
) -> tuple[bytes, list[Finding]]: ...
def run(request: _Options, files: _Files = ..., of_all: _Options | None = None, force: bool = False) -> Any: ...
def open(folder: _Path) -> Results: ...
def read(path: _Path) -> bytes: ...
def read_table(data: bytes, name: _Path) -> _Parts: ...
def write_table(
    title: str, in_degrees: bool | None, names: Sequence[str], values: NDArray[np.float64]
) -> bytes: ...
def read_markers(data: bytes, name: _Path) -> dict[str, Any]: ...
def write_markers(names: Sequence[str], positions: NDArray[np.float64], rate: float) -> bytes: ...
def arrow_stream(columns: Sequence[tuple[str, str, NDArray[Any] | list[str]]]) -> object: ...
