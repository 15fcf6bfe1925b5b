"""Forces while the motion arrives: closed forms, the prediction of the complete motion, and the same bits however frames are pushed."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import ambulo

GRAVITY = 9.80665
#: Frames before this time are left out: the rhythm of the steps is not known yet [s].
SETTLED = 0.8
TRANSLATIONS = ("pelvis_tx", "pelvis_ty", "pelvis_tz")


@pytest.fixture(scope="module")
def model(files):
    return ambulo.model(files / "figure.osim")


@pytest.fixture(scope="module")
def q(files, model):
    table = ambulo.read(files / "walk.mot").table
    columns = [table[name] if name in TRANSLATIONS else np.radians(table[name]) for name in model.coordinates]
    return np.column_stack(columns)


def streamed(model, frames, **options):
    stream = ambulo.Stream(model, 100, **options)
    parts = [stream.push(part) for part in frames] + [stream.finish()]
    return np.concatenate([part.time for part in parts]), np.vstack([part.to_numpy() for part in parts]), stream


def test_frames_and_arrays_of_frames_give_the_same_bits(model, q):
    one = streamed(model, q[:60])
    many = streamed(model, [q[:7], q[7:8], q[8:8], q[8:60]])
    assert np.allclose(one[0], np.arange(60) / 100, rtol=0, atol=1e-12)
    assert np.array_equal(one[0], many[0])
    assert np.array_equal(one[1], many[1])


def test_an_upright_body_is_carried_and_its_moments_are_those_of_inverse_dynamics(model):
    still = np.zeros((60, len(model.coordinates)))
    stream = ambulo.Stream(model, 100)
    table = stream.push(still)
    assert len(table) == 60 - 7
    assert stream.delay == pytest.approx(0.07)
    loads = {}
    for side in "rl":
        loads[f"calcn_{side}"] = np.column_stack(
            [
                *(table[f"ground_force_{side}_{part}{axis}"] for part in "vp" for axis in "xyz"),
                *(table[f"ground_torque_{side}_{axis}"] for axis in "xyz"),
            ]
        )
    vertical = sum(load[:, 1] for load in loads.values())
    assert vertical == pytest.approx(model.mass * GRAVITY, rel=1e-3)
    moments = table.select(model.force_names).to_numpy()
    rest = still[: len(table)]
    assert np.abs(moments - model.inverse_dynamics(rest, rest, rest, loads)).max() < 1e-6
    flipped = {body: load * [1, -1, 1, 1, 1, 1, 1, 1, 1] for body, load in loads.items()}
    assert np.abs(moments - model.inverse_dynamics(rest, rest, rest, flipped)).max() > model.mass * GRAVITY


def test_a_walk_is_streamed_nearly_as_it_is_predicted_whole(model, q):
    q = q[:220]
    motion = model.smooth(q, 100)
    whole = model.predict_ground(motion["q"], motion["qd"], motion["qdd"], 100)
    time, values, stream = streamed(model, [q])
    weight = model.mass * GRAVITY
    late = time >= SETTLED
    # Limits of crates/ambulo/tests/ground_stream.rs, forward, up and right [% of body weight].
    for axis, limit in zip("xyz", (3, 8, 3), strict=True):
        differences = []
        for side in "rl":
            name = f"ground_force_{side}_v"
            of_stream = values[:, stream.names.index(name + axis)]
            loaded = late & ((values[:, stream.names.index(name + "y")] > 20) | (whole[name + "y"] > 20))
            differences.append((of_stream - whole[name + axis])[loaded])
        assert 0 < np.sqrt(np.mean(np.concatenate(differences) ** 2)) / weight * 100 < limit, axis


def test_names_and_units_are_those_of_the_tables_of_a_run(model, predicted):
    stream = ambulo.Stream(model, 100)
    assert stream.names == (*predicted.grf.names, *predicted.sd.names, *predicted.moments.names)
    assert stream.units == (*predicted.grf.units, *predicted.sd.units, *predicted.moments.units)
    table = stream.push(np.zeros((20, len(model.coordinates))))
    assert table.to_pandas().shape == (13, 1 + len(stream.names))
    assert table.rate == pytest.approx(100)
    with pytest.raises(ValueError, match="read-only"):
        table.to_numpy()[0, 0] = 1


def test_a_gap_returns_no_frames_and_a_longer_delay_more_of_them_later(model, q):
    gap = q[:100].copy()
    gap[40:50, 3] = np.nan
    time, _, _ = streamed(model, [gap])
    # The frames that were due in the gap are dropped; those inside it are bridged.
    assert [round(100 * t) for t in time] == [*range(33), *range(43, 100)]
    assert len(ambulo.Stream(model, 100, delay=0.2).push(q[:100])) == 80
    assert len(ambulo.Stream(model, 100, delay=0).push(q[:100])) == 95


def test_options_and_frames_out_of_range_are_refused(model, q, files):
    for options, message in (
        ({"rate": 5}, "20 to 2000 Hz"),
        ({"delay": 9}, "delay of 9 s"),
        ({"window": 0.1}, "window of 0.1 s"),
        ({"filter": "kalman"}, "expected 'butterworth' or 'spline'"),
        ({"cutoff": "none"}, "expected a number in Hz, or 'off'"),
        ({"filter": "spline", "cutoff": 6}, "one of them alone"),
    ):
        with pytest.raises(ambulo.InputError, match=message):
            ambulo.Stream(model, **{"rate": 100, **options})
    stream = ambulo.Stream(files / "figure.osim", 100)
    with pytest.raises(ambulo.InputError, match="frame 0 has 3 coordinates"):
        stream.push([0, 0, 0])
    with pytest.raises(ambulo.InputError, match="hint: a missing coordinate is passed as not-a-number"):
        ambulo.Stream(model, 100).push(np.full(q.shape[1], np.inf))
    with pytest.raises(ambulo.InputError, match=r"shape \(1, 1, 1\); expected \(frames, columns\)"):
        stream.push(np.zeros((1, 1, 1)))
    stream.finish()
    for call in (stream.finish, lambda: stream.push(q)):
        with pytest.raises(ambulo.InputError, match="has ended"):
            call()
    with pytest.raises(TypeError, match="cannot be pickled"):
        pickle.dumps(stream)
    assert stream.findings == []
