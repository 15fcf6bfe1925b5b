"""Computations on arrays: closed forms, another engine's numbers, and properties that no copy may break."""

from __future__ import annotations

import numpy as np
import pytest

import ambulo

GRAVITY = 9.80665


@pytest.fixture(scope="module")
def model(files):
    return ambulo.model(files / "figure.osim")


@pytest.fixture
def motion(model):
    generator = np.random.default_rng(1997)
    shape = (300, len(model.coordinates))
    return [0.3 * generator.standard_normal(shape) for _ in range(3)]


def test_a_body_at_rest_needs_its_weight_and_one_in_free_fall_nothing(model):
    vertical = model.coordinates.index("pelvis_ty")
    still = np.zeros((3, len(model.coordinates)))
    fall = still.copy()
    fall[:, vertical] = -GRAVITY
    assert model.inverse_dynamics(still, still, still)[:, vertical] == pytest.approx(model.mass * GRAVITY)
    assert np.abs(model.inverse_dynamics(still, still, fall)).max() < 1e-9


def test_the_order_of_memory_changes_no_bit(model, motion):
    rows = model.inverse_dynamics(*motion)
    columns = model.inverse_dynamics(*(np.asfortranarray(array) for array in motion))
    frames = np.vstack([model.inverse_dynamics(*(array[i : i + 1] for array in motion)) for i in range(300)])
    strided = model.inverse_dynamics(*(np.repeat(array, 2, axis=0)[::2] for array in motion))
    assert rows.flags.f_contiguous
    for other in (columns, frames, strided):
        assert np.array_equal(rows, other)


def test_memory_of_the_caller_is_filled_in_any_order(model, motion):
    expected = model.inverse_dynamics(*motion)
    for order in "FC":
        out = np.empty(expected.shape, order=order)
        assert model.inverse_dynamics(*motion, out=out) is out
        assert np.array_equal(out, expected)
    with pytest.raises(ambulo.InputError, match="out: found the shape"):
        model.inverse_dynamics(*motion, out=np.empty((3, 3)))
    with pytest.raises(ambulo.InputError, match="out"):
        model.inverse_dynamics(*motion, out=motion[0])
    read_only = np.empty(expected.shape)
    read_only.flags.writeable = False
    with pytest.raises(ambulo.InputError, match="out"):
        model.inverse_dynamics(*motion, out=read_only)


def test_a_load_that_carries_the_weight_leaves_no_residual_force(model, motion):
    bodies = model.forward_kinematics(motion[0])
    still = np.zeros_like(motion[0])
    pelvis = bodies["bodies"].index("pelvis")
    load = np.zeros((300, 9))
    load[:, 1] = model.mass * GRAVITY
    load[:, 3:6] = bodies["center"][:, pelvis]
    forces = model.inverse_dynamics(motion[0], still, still, {"pelvis": load})
    root = [model.coordinates.index(f"pelvis_t{axis}") for axis in "xyz"]
    assert np.abs(forces[:, root]).max() < 1e-9
    flipped = model.inverse_dynamics(motion[0], still, still, {"pelvis": load * [1, -1, 1, 1, 1, 1, 1, 1, 1]})
    assert np.abs(flipped[:, root]).max() > 1.9 * model.mass * GRAVITY


def test_velocities_are_derivatives_of_places(model, motion):
    # Central differences over 2 h err by h² times a third derivative of about 10 m/s³.
    h = 1e-5
    q, qd, qdd = motion
    at = [model.forward_kinematics(q + t * qd + 0.5 * t * t * qdd, qd + t * qdd) for t in (-h, h)]
    bodies = model.forward_kinematics(q, qd, qdd)
    assert np.allclose((at[1]["center"] - at[0]["center"]) / (2 * h), bodies["velocity"], atol=1e-7)
    assert np.allclose((at[1]["velocity"] - at[0]["velocity"]) / (2 * h), bodies["acceleration"], atol=1e-6)
    rotation = bodies["rotation"]
    assert np.allclose(rotation @ np.swapaxes(rotation, 2, 3), np.eye(3))
    assert np.allclose(np.linalg.det(rotation), 1)


def test_inverse_dynamics_agrees_with_another_engine(data):
    if data is None:
        pytest.skip("no data")
    peers = data / "reference/peers/data"
    model = ambulo.model(peers / "human.osim")
    frames, expected = np.load(peers / "frames.npz"), np.load(peers / "tau_pinocchio.npz")
    columns = [model.coordinates.index(name) for name in frames["names"]]
    motion = []
    for name in ("q", "qd", "qdd"):
        array = np.zeros((len(frames[name]), len(model.coordinates)))
        array[:, columns] = frames[name]
        motion.append(array)
    forces = model.inverse_dynamics(*motion)
    # Torques reach 1e3, and sums have some 1e2 terms, so rounding leaves 1e-11.
    assert np.abs(forces[:, columns] - expected["tau"]).max() < 1e-8


def test_markers_of_a_known_posture_give_it_back(files):
    # The markers of the demo are those of its model, and its coordinates are known.
    recording = ambulo.read(files / "walk.trc")
    model = ambulo.model(files / "figure.osim")
    fit = model.fit_markers(recording.marker_names, recording.markers[:20], recording.rate)
    known = ambulo.read(files / "walk.mot").table
    knee = fit["coordinates"].index("knee_angle_r")
    assert fit["converged"].all()
    assert np.abs(np.degrees(fit["q"][:, knee]) - known["knee_angle_r"][:20]).max() < 0.01
    with pytest.raises(ambulo.InputError, match="no marker in common"):
        model.fit_markers(["x", "y", "z"], np.zeros((2, 3, 3)), 100)


def test_doubtful_markers_are_warned_of_where_the_function_is_called(files, model):
    recording = ambulo.read(files / "walk.trc")
    positions = recording.markers[:60].copy()
    knees = [recording.marker_names.index(name) for name in ("knee_r", "knee_l")]
    positions[20:40, knees] = positions[20:40, knees[::-1]]
    with pytest.warns(ambulo.AmbuloWarning, match="knee") as issued:
        model.fit_markers(recording.marker_names, positions, recording.rate)
    codes = [str(warning.message).split(":")[0] for warning in issued]
    assert len(codes) == len(set(codes))
    assert all(warning.filename == __file__ for warning in issued)


def test_predicted_ground_forces_carry_the_body(model):
    standing = np.zeros((200, len(model.coordinates)))
    standing[:, model.coordinates.index("pelvis_ty")] = 0.0
    forces = model.predict_ground(standing, 0 * standing, 0 * standing, 100)
    vertical = forces["ground_force_r_vy"] + forces["ground_force_l_vy"]
    assert vertical == pytest.approx(model.mass * GRAVITY, rel=1e-3)
    assert (forces["ground_force_r_vy_sd"] >= 0).all()


def test_the_steps_on_arrays_give_the_tables_of_the_command(files, predicted, model):
    table = ambulo.read(files / "walk.mot").table
    # A coordinate that the file does not have gets the value of the model.
    q = np.full((len(table), len(model.coordinates)), np.nan)
    for column, name in enumerate(model.coordinates):
        if name in table:
            in_degrees = predicted.angles.unit(name) == "deg"
            q[:, column] = np.radians(table[name]) if in_degrees else table[name]
    rate = round(table.rate)
    motion = model.smooth(q, rate)
    ground = model.predict_ground(motion["q"], motion["qd"], motion["qdd"], rate)
    # Files have their angles in degrees, and times are those of their frames: rounding changes the last bits, which the fit of the forces enlarges.
    for name in predicted.grf.names:
        assert np.abs(ground[name] - predicted.grf[name]).max() < 1e-6, name
    for name in predicted.sd.names:
        assert np.abs(ground[name] - predicted.sd[name]).max() < 1e-6, name
    other = model.smooth(q, rate, cutoff=3)
    other = model.predict_ground(other["q"], other["qd"], other["qdd"], rate, cutoff=3)
    assert np.abs(other["ground_force_r_vy"] - predicted.grf["ground_force_r_vy"]).max() > 10
    with pytest.raises(ambulo.InputError, match="expected a number in Hz, or 'off'"):
        model.predict_ground(motion["q"], motion["qd"], motion["qdd"], rate, cutoff="none")


def test_smoothing_returns_derivatives_and_treats_gaps_as_the_command(model):
    rate, omega = 100, 2 * np.pi
    time = np.arange(200) / rate
    q = np.full((200, len(model.coordinates)), np.nan)
    knee = model.coordinates.index("knee_angle_r")
    q[:, knee] = np.sin(omega * time)
    exact = model.smooth(q, rate, cutoff="off")
    assert np.allclose(exact["times"], time, rtol=0, atol=1e-12)
    inner = slice(10, -10)
    # A quintic spline through samples of a sine errs by about (omega h)^4 of its acceleration.
    assert np.abs(exact["qd"][inner, knee] - omega * np.cos(omega * time)[inner]).max() < 1e-4
    assert np.abs(exact["qdd"][inner, knee] + omega**2 * q[inner, knee]).max() < 1e-3
    # A Butterworth filter of order 3 that runs twice has the gain 1/2 at its cut-off.
    half = model.smooth(q, rate, cutoff=1, order=3)
    assert np.abs(half["q"][60:140, knee]).max() == pytest.approx(0.5, abs=0.02)
    gap = q.copy()
    gap[90:95, knee] = np.nan
    assert np.isfinite(model.smooth(gap, rate)["q"]).all()
    for rows in (slice(90, 140), slice(0, 20)):
        longer = q.copy()
        longer[rows, knee] = np.nan
        with pytest.raises(ambulo.InputError, match="`knee_angle_r` has no number from"):
            model.smooth(longer, rate)
    with pytest.raises(ambulo.InputError, match="rate: found 0"):
        model.smooth(q, 0)


def test_bad_arrays_are_refused_with_their_place(model, motion):
    q, qd, qdd = motion
    with pytest.raises(ambulo.InputError, match="qd: found the shape"):
        model.inverse_dynamics(q, qd[:, :3], qdd)
    broken = qdd.copy()
    broken[260, 4] = np.nan
    with pytest.raises(ambulo.InputError, match=rf"qdd: coordinate `{model.coordinates[4]}` .* row 260"):
        model.inverse_dynamics(q, qd, broken)
    with pytest.raises(ambulo.InputError, match="found the body `nobody`"):
        model.inverse_dynamics(q, qd, qdd, {"nobody": np.zeros((300, 9))})
    with pytest.raises(ambulo.InputError, match=r"expected \(300, 9\)"):
        model.inverse_dynamics(q, qd, qdd, {"pelvis": np.zeros((300, 8))})
    with pytest.raises(ambulo.InputError, match="column 4; expected finite numbers"):
        model.inverse_dynamics(q, qd, qdd, {"pelvis": np.where(np.arange(9) == 4, np.inf, np.zeros((300, 9)))})
    for rate in (0, -1, 1e-300, 1e300, np.nan, np.inf):
        with pytest.raises(ambulo.InputError, match="rate: found"):
            model.predict_ground(q, qd, qdd, rate)
    for compute in (model.forward_kinematics, lambda none: model.predict_ground(none, none, none, 100)):
        with pytest.raises(ambulo.InputError, match="no frames"):
            compute(q[:0])
    assert model.inverse_dynamics(q[:0], qd[:0], qdd[:0]).shape == (0, len(model.coordinates))
