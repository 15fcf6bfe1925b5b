"""MuJoCo in forward simulation, timed and checked; started by `cargo xtask simulators`.

usage: simulate_mujoco.py human  SETTING --model human_contact.xml
       simulate_mujoco.py chain  SETTING --size N
       simulate_mujoco.py ladder SETTING --size L
       simulate_mujoco.py golden --model human.xml --output FILE
SETTING is one of SETTINGS; all take --duration SECONDS (simulated) and --budget SECONDS (processor time).

The first three print one line of JSON; its keys are listed in xtask/measure/src/simulators.rs. `golden` writes
accelerations and trajectories without contact to a file, for another program to be compared with.
"""
import argparse
import json
import math
import time

import mujoco
import numpy as np

STEP_S = 0.001
GRAVITY = [0.0, 0.0, -9.81]
# Processor times that are taken at least, whatever the budget: one step of the largest ladder takes seconds.
LEAST_SAMPLES = 3
# From this size on each step is timed alone; smaller scenes step in tens, so that Python's own time does not count.
LARGE = 1000
# The human is watched step by step over the last tenth of the duration.
WATCHED = 0.1
# A contact sticks when it carries more than this part of the weight, and friction stays below this part of its limit.
CARRIES, WITHIN_CONE = 1e-3, 0.95

# The stiffest soft constraint that MuJoCo lets through: a time constant of two steps, impedance clamped at 0.9999.
STIFF = dict(solref=(0.002, 1.0), solimp=(0.9999, 0.9999, 0.001, 0.5, 2.0), tolerance=1e-12, iterations=1000)
# What differs from the model's own options. STIFF makes the soles chatter at 1 ms, for the joints' dampers are stiff too;
# not so with the integrator `discrete`, which solves the constraints with the implicit dampers that it steps with.
SETTINGS = {
    "Euler": dict(integrator="EULER"),
    "RK4": dict(integrator="RK4"),
    "implicitfast": dict(integrator="IMPLICITFAST"),
    "discrete": dict(integrator="DISCRETE"),
    "implicitfast tight": dict(integrator="IMPLICITFAST", **STIFF),
    "discrete tight": dict(integrator="DISCRETE", **STIFF),
}


def apply(model, setting):
    """Changes the options of `model`; -> what the solver then works with, as text."""
    chosen, option = SETTINGS[setting], model.opt
    option.timestep = STEP_S
    option.gravity[:] = GRAVITY
    integrator = "mjINT_" + chosen["integrator"]
    if not hasattr(mujoco.mjtIntegrator, integrator):
        raise ValueError("MuJoCo %s has no %s" % (mujoco.__version__, integrator))
    option.integrator = getattr(mujoco.mjtIntegrator, integrator)
    option.tolerance = chosen.get("tolerance", option.tolerance)
    option.iterations = chosen.get("iterations", option.iterations)
    for name in ("solref", "solimp"):
        if name in chosen:
            getattr(model, "geom_" + name)[:] = chosen[name]
            getattr(model, "eq_" + name)[:] = chosen[name]
    soft = (model.geom_solref, model.geom_solimp) if model.ngeom else (model.eq_solref, model.eq_solimp)
    text = "%s, %s solver, at most %d iterations, tolerance %g, %s cone, impratio %g, no-slip iterations %d" % (
        chosen["integrator"].lower(), mujoco.mjtSolver(option.solver).name[6:], option.iterations, option.tolerance,
        mujoco.mjtCone(option.cone).name[7:].lower(), option.impratio, option.noslip_iterations)
    if len(soft[0]):
        text += ", solref %s, solimp %s" % tuple(" ".join("%g" % x for x in row[0]) for row in soft)
    return text


def timed(model, data, steps, batch, budget_s, watch):
    """-> processor time of one step [us], one for each batch, and the steps done; `watch` runs after each batch."""
    samples, done, start = [], 0, time.thread_time()
    while done < steps:
        spent = time.thread_time() - start
        if len(samples) >= LEAST_SAMPLES and spent * (1.0 + 1.0 / len(samples)) > budget_s:
            break
        count = min(batch, steps - done)
        begin = time.thread_time()
        mujoco.mj_step(model, data, nstep=count)
        samples.append((time.thread_time() - begin) / count * 1e6)
        done += count
        watch()
    return samples, done


def spread(samples):
    """Median, tenth and ninetieth percentile by rank, as the other harnesses take them."""
    ordered = sorted(samples)
    rank = lambda part, whole: ordered[len(ordered) * part // whole]
    return dict(median_us=rank(1, 2), p10_us=rank(1, 10), p90_us=rank(9, 10))


def energy(model, data):
    """Kinetic and potential energy [J] of the state that is in `data`."""
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    mujoco.mj_makeM(model, data)
    mujoco.mj_energyPos(model, data)
    mujoco.mj_energyVel(model, data)
    return float(data.energy.sum())


def diverged(data):
    """MuJoCo starts anew when a state is not finite or too large; it counts that."""
    kinds = (mujoco.mjtWarning.mjWARN_BADQPOS, mujoco.mjtWarning.mjWARN_BADQVEL, mujoco.mjtWarning.mjWARN_BADQACC)
    return any(data.warning[kind].number > 0 for kind in kinds)


def report(scene, setting, size, settings, **values):
    """Prints one line; a number that is not finite becomes null, which JSON can say."""
    line = dict(peer="MuJoCo", version=mujoco.__version__, scene=scene, size=size, setting=setting,
                solver_settings=settings, **values)
    finite = lambda x: None if isinstance(x, float) and not math.isfinite(x) else x
    print(json.dumps({key: finite(value) for key, value in line.items()}), flush=True)


# ---- the human ----


def sole_penetration(model, data):
    """How far the lowest sphere of the soles is below the floor [m]; 0 above it."""
    spheres = model.geom_type == mujoco.mjtGeom.mjGEOM_SPHERE
    return max(0.0, float((model.geom_size[spheres, 0] - data.geom_xpos[spheres, 2]).max()))


def contacts(model, data, weight_n):
    """-> (sphere, upward force [N], tangential velocity [m/s] of the touching point, whether it sticks) of each."""
    found, force, velocity = [], np.zeros(6), np.zeros(6)
    for i in range(data.ncon):
        contact = data.contact[i]
        sphere = contact.geom[1]
        mujoco.mj_contactForce(model, data, i, force)
        frame = contact.frame.reshape(3, 3)
        body = model.geom_bodyid[sphere]
        mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_XBODY, body, velocity, 0)
        at_point = velocity[3:] + np.cross(velocity[:3], contact.pos - data.xpos[body])
        tangential = at_point - frame[0] * (frame[0] @ at_point)
        friction = math.hypot(force[1], force[2])
        sticks = force[0] > CARRIES * weight_n and friction < WITHIN_CONE * contact.friction[0] * force[0]
        found.append((sphere, float(frame[:, 2] @ force[:3]), tangential, sticks))
    return found


def human(arguments):
    model = mujoco.MjModel.from_xml_path(arguments.model)
    settings = apply(model, arguments.setting)
    data = mujoco.MjData(model)
    weight_n = float(-model.body_mass.sum() * GRAVITY[2])
    worst = [0.0]

    def watch():
        mujoco.mj_kinematics(model, data)
        worst[0] = max(worst[0], sole_penetration(model, data))

    steps = round(arguments.duration / STEP_S)
    watched = max(1, round(WATCHED * steps))
    samples, done = timed(model, data, steps - watched, 10, arguments.budget, watch)
    forces, slips, creep, penetrations, iterations = [], [], {}, [], []
    for _ in range(watched):
        mujoco.mj_step(model, data)
        mujoco.mj_forward(model, data)  # forces and velocities of the state after the step
        touching = contacts(model, data, weight_n)
        forces.append(sum(up for _, up, _, _ in touching))
        for sphere, _, tangential, sticks in touching:
            if sticks:
                slips.append(float(np.linalg.norm(tangential)))
                creep[sphere] = creep.get(sphere, np.zeros(3)) + tangential * STEP_S
        penetrations.append(sole_penetration(model, data))
        iterations.append(int(data.solver_niter[0]))
    report("human", arguments.setting, model.nv, settings, **spread(samples), steps=done + watched,
           # Joints are coordinates here and cannot come apart.
           constraint_error_worst_m=0.0, constraint_error_last_m=0.0, diverged=diverged(data),
           contact_force_n=float(np.mean(forces)), weight_n=weight_n, pelvis_height_m=float(data.body("pelvis").xpos[2]),
           contacts=int(data.ncon), penetration_worst_m=max(worst[0], max(penetrations)),
           penetration_last_m=max(penetrations), slip_m_per_s=max(slips, default=None),
           creep_m=max([float(np.linalg.norm(way)) for way in creep.values()], default=None),
           solver_iterations=float(np.mean(iterations)))


# ---- chains and ladders ----

RAIL = dict(mass=1.0, ipos=[0.1, 0, 0], inertia=[0.002, 0.004, 0.004], explicitinertial=True)
RUNG = dict(mass=0.5, ipos=[0, 0, 0.15], inertia=[0.004, 0.004, 0.001], explicitinertial=True)
LENGTH, WIDTH = 0.2, 0.3
# Bodies that MuJoCo 4.0 lets hang on one another.
DEPTH_LIMIT = 1024
Y_AXIS, Z_AXIS = [0, 1, 0], [0, 0, 1]


def hinged(parent, position, axis, inertial):
    body = parent.add_body(pos=position, **inertial)
    body.add_joint(type=mujoco.mjtJoint.mjJNT_HINGE, axis=axis)
    return body


def chain_spec(links):
    """Links along x, hinged to each other and to the world about y and z by turns."""
    spec = mujoco.MjSpec()
    tip = spec.worldbody
    for i in range(links):
        tip = hinged(tip, [LENGTH if i else 0, 0, 0], Z_AXIS if i % 2 else Y_AXIS, RAIL)
    return spec


def ladder_spec(loops):
    """Two rails, one above the other, a rung at the end of each pair of links; a point constraint closes each loop."""
    spec = mujoco.MjSpec()
    lower = upper = spec.worldbody
    for i in range(loops):
        lower = hinged(lower, [LENGTH if i else 0, 0, 0], Y_AXIS, RAIL)
        upper = hinged(upper, [LENGTH, 0, 0] if i else [0, 0, WIDTH], Y_AXIS, RAIL)
        rung = hinged(lower, [LENGTH, 0, 0], Y_AXIS, RUNG)
        rung.add_site(name="rung%d" % i, pos=[0, 0, WIDTH])
        upper.add_site(name="rail%d" % i, pos=[LENGTH, 0, 0])
        spec.add_equality(type=mujoco.mjtEq.mjEQ_CONNECT, objtype=mujoco.mjtObj.mjOBJ_SITE,
                          name1="rung%d" % i, name2="rail%d" % i)
    return spec


def compiled(build, size):
    """The model of that size. A tree too deep for MuJoCo is refused after minutes, so the limit is tried first."""
    if size > DEPTH_LIMIT:
        build(DEPTH_LIMIT + 1).compile()
    return build(size).compile()


def bodies(arguments, build, loops):
    """Times a scene of hinged bodies with that many closed loops."""
    model = compiled(build, arguments.size)
    settings = apply(model, arguments.setting)
    data = mujoco.MjData(model)
    sites = lambda side: [model.site("%s%d" % (side, i)).id for i in range(loops)]
    rungs, rails = sites("rung"), sites("rail")
    errors = [0.0]

    def watch():
        if loops:
            mujoco.mj_kinematics(model, data)  # a step leaves the positions of its beginning
            errors.append(float(np.linalg.norm(data.site_xpos[rungs] - data.site_xpos[rails], axis=1).max()))

    before = energy(model, data)
    batch = 1 if arguments.size >= LARGE else 10
    samples, done = timed(model, data, round(arguments.duration / STEP_S), batch, arguments.budget, watch)
    report(arguments.scene, arguments.setting, arguments.size, settings, **spread(samples), steps=done,
           constraint_error_worst_m=max(errors), constraint_error_last_m=errors[-1], diverged=diverged(data),
           energy_change_j=energy(model, data) - before)


# ---- golden numbers, without contact ----

# Of the free pelvis; velocity in the world's axes, angular velocity in the pelvis' own.
ROOT = dict(position=[0.1, -0.2, 1.1], quaternion=[0.9, 0.1, -0.3, 0.2], velocity=[0.3, -0.1, 0.2],
            angular_velocity=[0.5, -0.4, 0.6])
STATES, ROOT_SIZE = 3, 6
TRAJECTORY_S, SAMPLE_S, RK4_STEPS_S = 1.0, 0.1, (0.001, 0.0005, 0.00025)
# Torques along a trajectory: those that would accelerate each joint alone this much [rad/s^2]. The ten newton metres
# of the accelerations would turn a toe of 1e-4 kg m^2 some thousand times in a second; with 1 rad/s^2 here, steps of
# 1 ms and 0.25 ms still differ by 30 micrometres, with 0.2 by 1 nanometre.
TRAJECTORY_ACCELERATION = 0.2
CONVENTIONS = {
    "units": "kg, m, s, rad, N m; z up",
    "joints": "order of `joints`: q, qd, qdd, tau; each about `axis` in the frame of its body; joints of one body in "
              "the order in which they stand, the first next to the parent",
    "quaternion": "w, x, y, z; turns body axes into world axes",
    "root": "pelvis: position and velocity of its origin in world axes, angular velocity and acceleration in its own",
    "root_acceleration": "time derivatives of the root's velocity and angular velocity as given",
    "bodies": "order of `bodies`: centre of mass and angular quantities in world axes, true accelerations (free fall is "
              "-9.81), no torque on the root",
    "state": "q_i = 0.3 sin(1.1 i + 0.2 + k), qd_i = 0.8 cos(0.9 i + k), tau_i = 10 sin(1.3 i + 0.7 + k), i from 0, "
             "k the number of the state from 0",
}


def golden_model(path):
    """The model, refused if anything but gravity and inertia would act."""
    model = mujoco.MjModel.from_xml_path(path)
    for name in ("jnt_stiffness", "dof_damping", "dof_armature", "dof_frictionloss"):
        if np.any(getattr(model, name)):
            raise SystemExit("%s: %s is not zero" % (path, name))
    if model.ngeom or model.neq or model.ntendon or model.nu or np.any(model.jnt_limited):
        raise SystemExit("%s: has shapes, loops, tendons, actuators or limits" % path)
    if model.jnt_type[0] != mujoco.mjtJoint.mjJNT_FREE or np.any(model.jnt_type[1:] != mujoco.mjtJoint.mjJNT_HINGE):
        raise SystemExit("%s: expected a free joint, then hinges" % path)
    if np.any(model.body_iquat != [1, 0, 0, 0]):
        raise SystemExit("%s: inertia is not along the axes of its body" % path)
    model.opt.gravity[:] = GRAVITY
    return model


def indexed(model, formula):
    return np.array([formula(i) for i in range(model.nv - ROOT_SIZE)])


def set_state(model, data, k):
    mujoco.mj_resetData(model, data)
    quaternion = np.array(ROOT["quaternion"])
    data.qpos[:] = np.concatenate([ROOT["position"], quaternion / np.linalg.norm(quaternion),
                                   indexed(model, lambda i: 0.3 * math.sin(1.1 * i + 0.2 + k))])
    data.qvel[:] = np.concatenate([ROOT["velocity"], ROOT["angular_velocity"],
                                   indexed(model, lambda i: 0.8 * math.cos(0.9 * i + k))])


def of_bodies(model, data):
    """Pose, velocity and acceleration of each body, from a `data` that mj_forward has just filled."""
    mujoco.mj_rnePostConstraint(model, data)
    velocity, acceleration, rows = np.zeros(6), np.zeros(6), []
    for body in range(1, model.nbody):
        mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_BODY, body, velocity, 0)
        mujoco.mj_objectAcceleration(model, data, mujoco.mjtObj.mjOBJ_BODY, body, acceleration, 0)
        rows.append((data.xipos[body].copy(), data.xquat[body].copy(), velocity[3:].copy(), velocity[:3].copy(),
                     acceleration[3:] + GRAVITY, acceleration[:3].copy()))
    names = ("com", "quaternion", "com_velocity", "angular_velocity", "com_acceleration", "angular_acceleration")
    return {name: [row[i].tolist() for row in rows] for i, name in enumerate(names)}


def golden_state(model, data, k):
    set_state(model, data, k)
    tau = indexed(model, lambda i: 10.0 * math.sin(1.3 * i + 0.7 + k))
    data.qfrc_applied[ROOT_SIZE:] = tau
    mujoco.mj_forward(model, data)
    return dict(
        root=dict(position=data.qpos[:3].tolist(), quaternion=data.qpos[3:7].tolist(), velocity=data.qvel[:3].tolist(),
                  angular_velocity=data.qvel[3:6].tolist()),
        q=data.qpos[7:].tolist(), qd=data.qvel[6:].tolist(), tau=tau.tolist(),
        root_acceleration=dict(linear=data.qacc[:3].tolist(), angular=data.qacc[3:6].tolist()),
        qdd=data.qacc[6:].tolist(), bodies=of_bodies(model, data))


def rolled_out(model, tau, step_s):
    """-> centres of mass and quaternions at each sample, change of energy [J]; fourth-order Runge-Kutta from state 0."""
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_RK4
    model.opt.timestep = step_s
    data = mujoco.MjData(model)
    set_state(model, data, 0)
    data.qfrc_applied[ROOT_SIZE:] = tau
    before, com, quaternion = energy(model, data), [], []
    for sample in range(round(TRAJECTORY_S / SAMPLE_S) + 1):
        if sample:
            mujoco.mj_step(model, data, nstep=round(SAMPLE_S / step_s))
        mujoco.mj_kinematics(model, data)
        com.append(data.xipos[1:].copy())
        quaternion.append(data.xquat[1:].copy())
    return np.array(com), np.array(quaternion), energy(model, data) - before


def golden_trajectory(model, name, tau):
    runs = [rolled_out(model, tau, step_s) for step_s in RK4_STEPS_S]
    com, quaternion, _ = runs[-1]
    same_sign = lambda q: q * np.sign((q * quaternion).sum(axis=2, keepdims=True))
    convergence = [dict(step_s=step_s, com_m=float(np.abs(c - com).max()),
                        quaternion=float(np.abs(same_sign(q) - quaternion).max()), energy_change_j=e)
                   for step_s, (c, q, e) in zip(RK4_STEPS_S, runs)]
    return dict(name=name, start_state=0, tau=tau.tolist(), integrator="fourth-order Runge-Kutta",
                times_s=[round(i * SAMPLE_S, 9) for i in range(len(com))], difference_from_smallest_step=convergence,
                com=com.tolist(), quaternion=quaternion.tolist())


def golden(arguments):
    model = golden_model(arguments.model)
    data = mujoco.MjData(model)
    body_name = lambda i: model.body(i).name
    joints = [dict(name=model.joint(j).name, body=body_name(model.jnt_bodyid[j]), axis=model.jnt_axis[j].tolist())
              for j in range(1, model.njnt)]
    bodies_ = [dict(name=body_name(b), parent=body_name(model.body_parentid[b]), position=model.body_pos[b].tolist(),
                    mass=float(model.body_mass[b]), com=model.body_ipos[b].tolist(),
                    inertia=model.body_inertia[b].tolist()) for b in range(1, model.nbody)]
    states = [golden_state(model, data, k) for k in range(STATES)]
    inertia = np.zeros((model.nv, model.nv))
    set_state(model, data, 0)
    mujoco.mj_forward(model, data)
    mujoco.mj_fullM(model, data, inertia)
    alone = np.round(TRAJECTORY_ACCELERATION * np.diag(inertia)[ROOT_SIZE:], 6)
    driven = alone * indexed(model, lambda i: math.sin(1.3 * i + 0.7))
    trajectories = [golden_trajectory(model, "falling", np.zeros(model.nv - ROOT_SIZE)),
                    golden_trajectory(model, "driven", driven)]
    result = dict(peer="MuJoCo", version=mujoco.__version__, gravity=GRAVITY, conventions=CONVENTIONS, joints=joints,
                  bodies=bodies_, states=states, trajectories=trajectories)
    with open(arguments.output, "w") as file:
        json.dump(result, file, indent=1)
        file.write("\n")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("scene", choices=["human", "chain", "ladder", "golden"])
    parser.add_argument("setting", nargs="?", default="Euler", choices=list(SETTINGS))
    parser.add_argument("--model")
    parser.add_argument("--size", type=int, default=0)
    parser.add_argument("--output")
    parser.add_argument("--duration", type=float, default=10.0)
    parser.add_argument("--budget", type=float, default=20.0)
    arguments = parser.parse_args()
    if arguments.scene == "golden":
        return golden(arguments)
    try:
        if arguments.scene == "human":
            human(arguments)
        elif arguments.scene == "chain":
            bodies(arguments, chain_spec, 0)
        else:
            bodies(arguments, ladder_spec, arguments.size)
    except ValueError as refusal:  # how MuJoCo says that it does not take a model
        report(arguments.scene, arguments.setting, arguments.size, "", error=" ".join(str(refusal).split()))


if __name__ == "__main__":
    main()
