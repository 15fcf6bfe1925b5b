"""Writes by_numpy.npz and by_numpy_deflated.npz with NumPy:

    python by_numpy.py
"""

import numpy

arrays = {
    "poses": numpy.arange(12, dtype=numpy.float64).reshape(2, 6) / 8,
    "trans": numpy.array([[0.5, -1, 2], [3, 4, 5]], dtype=numpy.float32),
    "half": numpy.array([1.5, -0.25, 65504], dtype=numpy.float16),
    "columns": numpy.asfortranarray(numpy.arange(6, dtype=">i4").reshape(2, 3)),
    "mocap_framerate": numpy.array(120.0),
    "flags": numpy.array([True, False]),
    "signed": numpy.array([-3, 7], dtype=numpy.int8),
    "gender": numpy.array("female"),
    "names": numpy.array(["hip", "kneé", "", "ankle"]),
    "names_columns": numpy.asfortranarray([["a", "b", "c"], ["d", "e", "f"]]),
    "gender_bytes": numpy.array(b"male"),
    "object": numpy.array([{"a": 1}], dtype=object),
}
numpy.savez("by_numpy.npz", **arrays)
numpy.savez_compressed("by_numpy_deflated.npz", **arrays)
