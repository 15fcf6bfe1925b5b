"""Forces while the motion arrives."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

from ambulo import _ambulo
from ambulo._table import Table

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from ambulo._errors import Finding
    from ambulo._options import Body, Filter


class Stream:
    """Ground forces and joint moments of a motion that is still being recorded, with a short delay.

    Frames are pushed as they arrive. Every push returns the frames that became final, with the columns of ``grf.mot``, ``grf_sd.mot`` and
    ``moments.sto``.

    Parameters
    ----------
    model : Model, str, path-like or bytes
        The body, with two feet: a model, or an ``.osim`` file.
    rate : float
        Frame rate of the motion [Hz], 20 to 2000.
    delay : float, optional
        Longest time from a frame to its forces [s], at most half of `window`. Forces of a longer delay are closer to those of the complete
        recording.
    window : float, optional
        Duration of the motion that is kept [s], 1 to 60. The time of a push is proportional to it.
    filter : {"butterworth", "spline"}, optional
        How the motion is smoothed.
    cutoff : float or "off", optional
        Low-pass filter of the motion [Hz].
    order : int, optional
        Order of one pass of the Butterworth filter.

    Raises
    ------
    FileNotFoundError, PermissionError
        A file that cannot be read.
    InputError
        A rate, delay, window or filter out of range; a file that is not a model.

    Notes
    -----
    An option that is None has the default of the library's stream. Method, delays, and differences from complete recordings and from force plates:
    docs/STREAMING.md. A stream has memory of the past, so it cannot be pickled; give each process its own.

    Examples
    --------
    >>> import ambulo, numpy
    >>> model = ambulo.walk(cycles=1).model
    >>> stream = ambulo.Stream(model, rate=100)
    >>> upright = numpy.zeros(len(model.coordinates))
    >>> [len(stream.push(upright)) for _ in range(8)]  # the delay is 7 frames
    [0, 0, 0, 0, 0, 0, 0, 1]
    >>> len(stream.finish())
    7
    """

    __slots__ = ("_columns", "_stream")

    def __init__(
        self,
        model: Body,
        rate: float,
        *,
        delay: float | None = None,
        window: float | None = None,
        filter: Filter | None = None,
        cutoff: float | Literal["off"] | None = None,
        order: int | None = None,
    ) -> None:
        from ambulo._calls import model as read_model

        body = model if isinstance(model, _ambulo.Model) else read_model(model)
        self._stream = _ambulo.Stream(body, rate, delay, window, filter, cutoff, order)
        self._columns = self._stream.columns()

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the columns of the tables, without the time."""
        return tuple(name for name, _ in self._columns)

    @property
    def units(self) -> tuple[str, ...]:
        """Unit of each column: ``"N"``, ``"m"``, ``"N.m"``."""
        return tuple(unit for _, unit in self._columns)

    @property
    def rate(self) -> float:
        """Frame rate [Hz]."""
        return self._stream.rate()

    @property
    def delay(self) -> float:
        """Time from a frame to its forces [s], a whole number of frames."""
        return self._stream.delay_frames() / self.rate

    @property
    def findings(self) -> list[Finding]:
        """Warnings and notes about the motion that is kept: ``code``, ``severity``, ``message``, ``count``."""
        return self._stream.findings()

    def push(self, q: ArrayLike) -> Table:
        """Add frames, and return the frames that became final.

        Parameters
        ----------
        q : array_like, shape (coordinates,) or (frames, coordinates)
            The next frame or frames: coordinates [rad, m] in the order of `Model.coordinates`; not a number where a value is missing.

        Returns
        -------
        Table
            A row per final frame, often none: forces on both feet [N], centres of pressure [m], free moments [N.m], their standard deviations,
            and generalised forces [N.m, N]. `Table.time` counts from the first frame of the stream [s]. Forces and moments are those of
            `Result.grf`, `Result.sd` and `Result.moments`, also in axes and signs. Frames in gaps are never returned.

        Raises
        ------
        InputError
            A frame of another length, an infinite number, a model without two feet, a stream that has ended. Frames before the one that is
            refused have been added.

        Notes
        -----
        Other threads run meanwhile. Ctrl-C raises `KeyboardInterrupt`; what a push of many frames has computed until then is lost.
        """
        import numpy as np

        frames = np.asarray(q, dtype=np.float64)
        return self._made(self._stream.push(frames[np.newaxis] if frames.ndim == 1 else frames))

    def finish(self) -> Table:
        """End the stream, and return the frames of the delay.

        Returns
        -------
        Table
            As `push`. These frames are less accurate, because less motion follows them.

        Raises
        ------
        InputError
            A stream that has ended, a model without two feet.
        """
        return self._made(self._stream.finish())

    def _made(self, frames: tuple[NDArray[np.float64], NDArray[np.float64]]) -> Table:
        time, values = frames
        time.flags.writeable = values.flags.writeable = False
        columns = [values[:, i] for i in range(len(self._columns))]
        return Table("Stream", self.names, self.units, columns, time=time, numbers=values)

    def __repr__(self) -> str:
        """Describe the stream in one line."""
        return f"<Stream: {self.rate:g} Hz, delay {self.delay:g} s, {len(self._columns)} columns>"

    def __reduce__(self) -> Any:
        """Refuse to be pickled."""
        raise TypeError("a Stream cannot be pickled, because it has memory of the past; make one in each process")
