"""Solves the exported problem with OpenSim Moco (MocoCasADiSolver).

usage: optimal_moco.py PROBLEM.json OUTPUT.json cold|warm MESH LIMIT_S TOLERANCE

The model has the bodies of the file, one planar joint and pins, one `SmoothSphereHalfSpaceForce` per sphere and one `CoordinateActuator`
per joint. The transcription is Moco's own: Hermite-Simpson with explicit dynamics on MESH intervals. The objective is the same
integral, divided by the duration: `MocoStateTrackingGoal` for angles and rates, `MocoControlGoal` for moments. Controls are moments /
`moment_deviation`. `cold` starts from the first guess, `warm` from our solution, both with their moments. One job, no limit on
iterations; the process is ended after LIMIT_S of CPU time, and then writes no output.
"""
import json
import resource
import sys
import time

import numpy as np
import opensim as osim

from optimal_problem import Problem

LIMIT_ANGLE, LIMIT_RATE, LIMIT_CONTROL = 2.0, 30.0, 20.0


def build(problem):
    """-> the model, and the path of each coordinate's value."""
    model = osim.Model()
    model.setName("walker")
    model.setGravity(osim.Vec3(0, -problem.gravity, 0))
    bodies, joints = [], [None] * problem.width
    for data in problem.bodies:
        center, inertia = osim.Vec3(*data["center"]), osim.Inertia(*data["inertia"])
        body = osim.Body(data["name"], data["mass"], center, inertia)
        model.addBody(body)
        place, none = osim.Vec3(*data["place"]), osim.Vec3(0)
        if data["parent"] is None:
            joint = osim.PlanarJoint(data["joint"] + "_joint", model.getGround(), place, none, body, none, none)
            order = [data["rotation"], *data["translations"]]
        else:
            parent = bodies[data["parent"]]
            joint = osim.PinJoint(data["joint"] + "_joint", parent, place, none, body, none, none)
            order = [data["rotation"]]
        for k, c in enumerate(order):
            coordinate = joint.get_coordinates(k)
            coordinate.setName(problem.coordinates[c])
            joints[c] = (data["joint"] + "_joint", coordinate)
        model.addJoint(joint)
        bodies.append(body)
    ground = osim.ContactHalfSpace(osim.Vec3(0), osim.Vec3(0, 0, -np.pi / 2), model.getGround(), "floor")
    model.addContactGeometry(ground)
    law = problem.law
    for sole in problem.soles:
        sphere = osim.ContactSphere(sole["radius"], osim.Vec3(*sole["center"]), bodies[sole["body"]], sole["name"])
        model.addContactGeometry(sphere)
        force = osim.SmoothSphereHalfSpaceForce("contact_" + sole["name"], sphere, ground)
        force.set_stiffness(law["stiffness"])
        force.set_dissipation(law["dissipation"])
        force.set_static_friction(law["static_friction"])
        force.set_dynamic_friction(law["dynamic_friction"])
        force.set_viscous_friction(law["viscous_friction"])
        force.set_transition_velocity(law["transition_velocity"])
        force.set_constant_contact_force(law["depth_offset"])
        force.set_hertz_smoothing(law["depth_slope"])
        force.set_hunt_crossley_smoothing(law["rate_slope"])
        model.addForce(force)
    for c in problem.driven:
        name = problem.coordinates[c]
        actuator = osim.CoordinateActuator(name)
        actuator.setName("moment_" + name)
        actuator.setOptimalForce(problem.moment_deviation)
        actuator.setMinControl(-LIMIT_CONTROL)
        actuator.setMaxControl(LIMIT_CONTROL)
        model.addForce(actuator)
    model.finalizeConnections()
    paths = [f"/jointset/{joint}/{name}" for (joint, _), name in zip(joints, problem.coordinates)]
    return model, paths


def references(problem, paths):
    """-> the targets as a table that Moco interpolates; a little more than the span."""
    shares = np.linspace(0, 1, 401)
    # The end is the start of the next half cycle.
    targets = problem.targets(np.minimum(shares, 1 - 1e-12))
    table = osim.TimeSeriesTable()
    labels = [f"{paths[a]}/{part}" for part in ("value", "speed") for a in problem.angles]
    table.setColumnLabels(labels)
    table.addTableMetaDataString("inDegrees", "no")
    for k, share in enumerate(shares):
        row = [float(targets[part][k, a]) for part in range(2) for a in problem.angles]
        table.appendRow(share * problem.duration, osim.RowVector(row))
    return table


def study(problem, mesh, tolerance):
    model, paths = build(problem)
    moco = osim.MocoStudy()
    moco.setName("walker")
    goal_problem = moco.updProblem()
    goal_problem.setModel(model)
    goal_problem.setTimeBounds(0, problem.duration)
    travel = problem.travel["coordinate"]
    for c, path in enumerate(paths):
        if c == travel:
            distance = problem.travel["distance"]
            ends = osim.MocoInitialBounds(0.0), osim.MocoFinalBounds(distance)
            goal_problem.setStateInfo(path + "/value", osim.MocoBounds(-0.5, distance + 0.5), *ends)
        elif c in problem.angles:
            goal_problem.setStateInfo(path + "/value", osim.MocoBounds(-LIMIT_ANGLE, LIMIT_ANGLE))
        else:
            goal_problem.setStateInfo(path + "/value", osim.MocoBounds(0.5, 1.5))
        goal_problem.setStateInfo(path + "/speed", osim.MocoBounds(-LIMIT_RATE, LIMIT_RATE))

    tracking = osim.MocoStateTrackingGoal("tracking", 1.0 / problem.duration)
    tracking.setReference(osim.TableProcessor(references(problem, paths)))
    for a in problem.angles:
        tracking.setWeightForState(paths[a] + "/value", 1.0 / problem.angle_deviation**2)
        tracking.setWeightForState(paths[a] + "/speed", 1.0 / problem.rate_deviation**2)
    goal_problem.addGoal(tracking)
    goal_problem.addGoal(osim.MocoControlGoal("moments", 1.0 / problem.duration))

    periodic = osim.MocoPeriodicityGoal("mirrored")
    for c, path in enumerate(paths):
        other = paths[problem.mirror[c]]
        if c != travel:
            periodic.addStatePair(osim.MocoPeriodicityGoalPair(path + "/value", other + "/value"))
        periodic.addStatePair(osim.MocoPeriodicityGoalPair(path + "/speed", other + "/speed"))
    for c in problem.driven:
        name, other = (problem.coordinates[k] for k in (c, problem.mirror[c]))
        pair = osim.MocoPeriodicityGoalPair(f"/forceset/moment_{name}", f"/forceset/moment_{other}")
        periodic.addControlPair(pair)
    goal_problem.addGoal(periodic)

    solver = moco.initCasADiSolver()
    solver.set_num_mesh_intervals(mesh)
    solver.set_transcription_scheme("hermite-simpson")
    solver.set_multibody_dynamics_mode("explicit")
    solver.set_optim_convergence_tolerance(tolerance)
    solver.set_optim_constraint_tolerance(tolerance)
    solver.set_optim_max_iterations(100000)
    solver.set_parallel(0)
    solver.set_verbosity(1)
    return moco, solver, paths


def guess(problem, solver, paths, samples):
    """The trajectory of samples as Moco's guess."""
    trajectory = solver.createGuess("bounds")
    times = samples["times"]
    trajectory.setNumTimes(len(times))
    trajectory.setTime(times.tolist())
    for c, path in enumerate(paths):
        trajectory.setState(path + "/value", samples["positions"][:, c].tolist())
        trajectory.setState(path + "/speed", samples["rates"][:, c].tolist())
    for c in problem.driven:
        moments = np.clip(samples["forces"][:, c] / problem.moment_deviation, -LIMIT_CONTROL, LIMIT_CONTROL)
        trajectory.setControl(f"/forceset/moment_{problem.coordinates[c]}", moments.tolist())
    solver.setGuess(trajectory)


def difference(problem, paths, solution, samples):
    """-> largest difference of an angle from given samples [rad]."""
    times = np.array([solution.getTime()[k] for k in range(solution.getNumTimes())])
    worst = 0.0
    for a in problem.angles:
        values = np.array([solution.getState(paths[a] + "/value")[k] for k in range(len(times))])
        worst = max(worst, np.abs(values - np.interp(times, samples["times"], samples["positions"][:, a])).max())
    return float(worst)


def main():
    path, output, start = sys.argv[1:4]
    mesh, limit, tolerance = int(sys.argv[4]), int(sys.argv[5]), float(sys.argv[6])
    problem = Problem(path)
    samples = problem.guess_samples if start == "cold" else problem.solution_samples
    moco, solver, paths = study(problem, mesh, tolerance)
    guess(problem, solver, paths, samples)
    resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 5))
    before = time.process_time()
    solution = moco.solve()
    seconds = time.process_time() - before
    succeeded = solution.success()
    solution.unseal()
    result = {
        "version": f"OpenSim {osim.GetVersion()}", "start": start, "mesh": mesh, "tolerance": tolerance, "seconds": seconds,
        "status": solution.getStatus(), "succeeded": succeeded, "iterations": solution.getNumIterations(),
        "objective": solution.getObjective(), "difference": difference(problem, paths, solution, problem.solution_samples),
    }
    with open(output, "w") as file:
        json.dump(result, file, indent=1)
    print(json.dumps(result))


if __name__ == "__main__":
    main()
