"""Checks and solves the exported problem with CasADi and IPOPT.

usage: optimal_casadi.py PROBLEM.json OUTPUT.json [TOLERANCE]

The transcription is that of the file: the same splines and instants. Dynamics are written here again, as planar Newton-Euler equations.
Unknowns are in rad and m, the objective is a number, constraints are residual forces at the root in body weights and body weights x leg.

`check`: objective, largest constraint and KKT residual at our solution. The KKT residual is the largest entry of
grad f + J^T lambda with the multipliers lambda of least squares. `kkt_scaled` is divided by max(100, mean |lambda|) / 100 (IPOPT's s_d).
`cold`, `warm`: IPOPT (exact derivatives) from the first guess and, with a thousandth of the tolerance, from our solution; CPU time of the solver without building its functions.
"""
import json
import sys
import time

import casadi as ca
import numpy as np
import scipy.sparse as sparse
import scipy.sparse.linalg

from optimal_problem import Problem


def turn(angle, x, y):
    c, s = ca.cos(angle), ca.sin(angle)
    return c * x - s * y, s * x + c * y


def contact_force(law, radius, height, vx, vy):
    """Force on a sphere: `SmoothSphereHalfSpaceForceImpl::calcForce` of Simbody. `height` is that of its lowest point."""
    depth, sinking = -height, -vy
    k = 0.5 * law["stiffness"] ** (2 / 3)
    hertz = 4 / 3 * k * np.sqrt(radius * k) * ca.sqrt(depth**2 + law["depth_offset"]) ** 1.5
    smooth = hertz * (0.5 + 0.5 * ca.tanh(law["depth_slope"] * depth))
    c = law["dissipation"]
    normal = smooth * (1 + 1.5 * c * sinking) * (0.5 + 0.5 * ca.tanh(law["rate_slope"] * (sinking + 2 / (3 * c))))
    speed = ca.sqrt(vx**2 + law["depth_offset"])
    ratio = speed / law["transition_velocity"]
    still, moving = law["static_friction"], law["dynamic_friction"]
    coefficient = ca.fmin(ratio, 1) * (moving + 2 * (still - moving) / (1 + ratio**2)) + law["viscous_friction"] * speed
    return -normal * coefficient * vx / speed, normal


def inverse_dynamics(problem, q, qd, qdd):
    """-> generalised forces, those of the root being residual."""
    links = []
    for body in problem.bodies:
        r = body["rotation"]
        if body["parent"] is None:
            tx, ty = body["translations"]
            base = (0, 0, 0)
            place, velocity, acceleration = (q[tx], q[ty]), (qd[tx], qd[ty]), (qdd[tx], qdd[ty])
        else:
            parent = links[body["parent"]]
            base = parent["turn"]
            dx, dy = turn(base[0], *body["place"][:2])
            place = (parent["place"][0] + dx, parent["place"][1] + dy)
            velocity = (parent["velocity"][0] - base[1] * dy, parent["velocity"][1] + base[1] * dx)
            acceleration = (
                parent["acceleration"][0] - base[2] * dy - base[1] ** 2 * dx,
                parent["acceleration"][1] + base[2] * dx - base[1] ** 2 * dy,
            )
        angle, rate, spin = base[0] + q[r], base[1] + qd[r], base[2] + qdd[r]
        cx, cy = turn(angle, *body["center"][:2])
        fx = body["mass"] * (acceleration[0] - spin * cy - rate**2 * cx)
        fy = body["mass"] * (acceleration[1] + spin * cx - rate**2 * cy + problem.gravity)
        moment = body["inertia"][2] * spin + cx * fy - cy * fx
        links.append(
            {"turn": (angle, rate, spin), "place": place, "velocity": velocity, "acceleration": acceleration,
             "force": [fx, fy], "moment": moment}
        )
    for sole in problem.soles:
        link = links[sole["body"]]
        dx, dy = turn(link["turn"][0], *sole["center"][:2])
        height = link["place"][1] + dy - sole["radius"]
        # The contact point is midway between the surfaces.
        arm_x, arm_y = dx, 0.5 * height - link["place"][1]
        vx = link["velocity"][0] - link["turn"][1] * arm_y
        vy = link["velocity"][1] + link["turn"][1] * arm_x
        fx, fy = contact_force(problem.law, sole["radius"], height, vx, vy)
        link["force"] = [link["force"][0] - fx, link["force"][1] - fy]
        link["moment"] -= arm_x * fy - arm_y * fx
    forces = [0] * problem.width
    for body, link in reversed(list(zip(problem.bodies, links))):
        forces[body["rotation"]] = link["moment"]
        if body["parent"] is None:
            tx, ty = body["translations"]
            forces[tx], forces[ty] = link["force"]
            continue
        parent = links[body["parent"]]
        dx, dy = (a - b for a, b in zip(link["place"], parent["place"]))
        fx, fy = link["force"]
        parent["force"] = [parent["force"][0] + fx, parent["force"][1] + fy]
        parent["moment"] += link["moment"] + dx * fy - dy * fx
    return ca.vertcat(*forces)


class Transcription:
    """The exported problem as functions of its unknowns, with exact sparse derivatives."""

    def __init__(self, problem):
        n, count = problem.width, problem.instants
        shares = problem.shares()
        parts = [matrix.reshape(count, n, -1) for matrix in problem.weights(shares)]
        travelled = [part.reshape(count, n) for part in problem.travelled(shares)]
        # Rows instant after instant: all positions, then rates, then accelerations.
        weights = np.concatenate(parts, axis=1).reshape(count * 3 * n, -1)
        self.offsets = np.concatenate([*travelled, np.zeros((count, n))], axis=1).ravel()
        targets, rates = (part.T for part in problem.targets(shares))
        anchored = np.zeros((1, count))
        anchored[0, 0] = 1

        z, target, rate, first = ca.SX.sym("z", 3 * n), ca.SX.sym("target", n), ca.SX.sym("rate", n), ca.SX.sym("first")
        q = z[:n]
        self.forces = ca.Function("forces", [z], [inverse_dynamics(problem, q, z[n : 2 * n], z[2 * n :])])
        forces = self.forces(z)
        cost = first * (q[problem.travel["coordinate"]] / problem.place_deviation) ** 2
        cost += sum(((q[a] - target[a]) / problem.angle_deviation) ** 2 for a in problem.angles)
        cost += sum((forces[d] / problem.moment_deviation) ** 2 for d in problem.driven)
        cost += sum(((z[n + a] - rate[a]) / problem.rate_deviation) ** 2 for a in problem.angles)
        cost /= count
        root = ca.vertcat(*[forces[r] / scale for r, scale in zip(problem.root, problem.root_scales)])
        multipliers, factor = ca.SX.sym("multipliers", len(problem.root)), ca.SX.sym("factor")
        lagrangian = factor * cost + ca.dot(multipliers, root)
        given = [z, target, rate, first]
        value = ca.Function("value", given, [cost, root]).map(count)
        slope = ca.Function("slope", given, [cost, ca.gradient(cost, z)]).map(count)
        root_slope = ca.Function("root_slope", given, [root, ca.densify(ca.jacobian(root, z))]).map(count)
        hessian, _ = ca.hessian(lagrangian, z)
        curvature = ca.Function("curvature", [*given, factor, multipliers], [ca.densify(hessian)]).map(count)

        x, p = ca.MX.sym("x", weights.shape[1]), ca.MX.sym("p", 0)
        w = ca.DM(sparse.csc_matrix(weights))
        zs = ca.reshape(ca.mtimes(w, x) + ca.DM(self.offsets), 3 * n, count)
        at = [zs, ca.DM(targets), ca.DM(rates), ca.DM(anchored)]
        costs, roots = value(*at)
        f, g = ca.sum2(costs), ca.vec(roots)
        costs, slopes = slope(*at)
        gradient = ca.mtimes(w.T, ca.vec(slopes))
        _, root_slopes = root_slope(*at)
        jacobian = ca.mtimes(ca.diagcat(*ca.horzsplit(root_slopes, 3 * n)), w)
        lam_f, lam_g = ca.MX.sym("lam_f"), ca.MX.sym("lam_g", g.shape[0])
        blocks = curvature(*at, lam_f, ca.reshape(lam_g, len(problem.root), count))
        whole = ca.mtimes(w.T, ca.mtimes(ca.diagcat(*ca.horzsplit(blocks, 3 * n)), w))
        self.nlp = {"x": x, "f": f, "g": g}
        self.options = {
            "grad_f": ca.Function("nlp_grad_f", [x, p], [f, gradient], ["x", "p"], ["f", "grad_f_x"]),
            "jac_g": ca.Function("nlp_jac_g", [x, p], [g, jacobian], ["x", "p"], ["g", "jac_g_x"]),
            "hess_lag": ca.Function("nlp_hess_l", [x, p, lam_f, lam_g], [ca.triu(whole)],
                                    ["x", "p", "lam_f", "lam_g"], ["triu_hess_gamma_x_x"]),
        }

    def check(self, unknowns):
        """-> objective, largest constraint and KKT residuals at given unknowns."""
        objective, gradient = (np.array(out).ravel() for out in self.options["grad_f"](unknowns, []))
        root, jacobian = self.options["jac_g"](unknowns, [])
        jacobian = jacobian.sparse()
        multipliers = np.linalg.lstsq(jacobian.toarray().T, -gradient, rcond=None)[0]
        residual = np.abs(gradient + jacobian.T @ multipliers).max()
        return {
            "objective": float(objective[0]),
            "root": float(np.abs(np.array(root)).max()),
            "kkt": float(residual),
            "kkt_scaled": float(residual / (max(100.0, np.abs(multipliers).mean()) / 100)),
            "gradient": float(np.abs(gradient).max()),
            "largest_multiplier": float(np.abs(multipliers).max()),
        }

    def solve(self, start, tolerance):
        """-> result of IPOPT."""
        ipopt = {"print_level": 0, "sb": "yes", "tol": tolerance, "max_iter": 3000, "max_cpu_time": 600.0}
        solver = ca.nlpsol("solver", "ipopt", self.nlp, {**self.options, "ipopt": ipopt, "print_time": False})
        before = time.process_time()
        found = solver(x0=start, lbg=0, ubg=0)
        seconds = time.process_time() - before
        stats = solver.stats()
        unknowns = np.array(found["x"]).ravel()
        return {
            "seconds": seconds,
            "iterations": stats["iter_count"],
            "status": stats["return_status"],
            "change": float(np.abs(unknowns - start).max()),
            **self.check(unknowns),
        }


def main():
    path, output = sys.argv[1:3]
    tolerance = float(sys.argv[3]) if len(sys.argv) > 3 else 1e-8
    problem = Problem(path)
    before = time.process_time()
    transcription = Transcription(problem)
    result = {
        "peer": "CasADi and IPOPT",
        "version": f"CasADi {ca.__version__}, its IPOPT with MUMPS",
        "building_seconds": time.process_time() - before,
        "tolerance": tolerance,
        "check": transcription.check(problem.solution),
    }
    # Our solution meets the tolerance already.
    for name, start, share in [("cold", problem.guess, 1), ("warm", problem.solution, 1e-3)]:
        result[name] = transcription.solve(start, share * tolerance)
    with open(output, "w") as file:
        json.dump(result, file, indent=1)
    print(json.dumps(result))


if __name__ == "__main__":
    main()
