"""The problem that `cargo xtask optimal-peers` exports, and its splines, for the programs that solve it with other means."""
import json

import numpy as np

DEGREE = 5


class Problem:
    """Numbers of the exported file as attributes; arrays where the file has lists of numbers."""

    def __init__(self, path):
        with open(path) as file:
            self.__dict__.update(json.load(file))
        self.width = len(self.coordinates)
        self.instants = self.knots * self.per_knot
        for name in ("guess", "solution"):
            setattr(self, name, np.array(getattr(self, name)))
        for name in ("guess_samples", "solution_samples"):
            setattr(self, name, {key: np.array(values) for key, values in getattr(self, name).items()})

    def weights(self, shares):
        """-> three matrices that map the unknowns to all coordinates at shares of the span in [0, 1), instant after instant: values,
        rates and accelerations, without forward motion."""
        n = self.width
        matrices = [np.zeros((len(shares) * n, self.knots * n)) for _ in range(3)]
        for i, share in enumerate(shares):
            place = share * self.knots
            interval = min(int(place), self.knots - 1)
            for part, matrix in enumerate(matrices):
                for j in range(DEGREE + 1):
                    weight = spline(place - interval + DEGREE - j, DEGREE, part) * (self.knots / self.duration) ** part
                    block = interval + j
                    for c in range(n):
                        # Beyond the span, left and right are exchanged.
                        origin = c if block < self.knots else self.mirror[c]
                        matrix[i * n + c, (block % self.knots) * n + origin] += weight
        return matrices

    def travelled(self, shares):
        """-> forward motion at shares of the span, as arrays of positions and of rates, instant after instant."""
        positions, rates = (np.zeros((len(shares), self.width)) for _ in range(2))
        positions[:, self.travel["coordinate"]] = np.array(shares) * self.travel["distance"]
        rates[:, self.travel["coordinate"]] = self.travel["distance"] / self.duration
        return positions.ravel(), rates.ravel()

    def shares(self):
        """-> the instants of the problem, without the end of the span, which is the start of the next one."""
        return np.arange(self.instants) / self.instants

    def targets(self, shares):
        """-> targets of coordinates and rates, one row per share: those of the first guess (translations have no targets)."""
        return [(matrix @ self.guess).reshape(len(shares), self.width) for matrix in self.weights(shares)[:2]]


def spline(x, degree, derivative=0):
    """Cardinal B-spline with the knots 0, 1, .., degree + 1, by the recursion of Cox and de Boor."""
    if derivative:
        return spline(x, degree - 1, derivative - 1) - spline(x - 1, degree - 1, derivative - 1)
    if degree == 0:
        return 1.0 if 0 <= x < 1 else 0.0
    return (x * spline(x, degree - 1) + (degree + 1 - x) * spline(x - 1, degree - 1)) / degree
