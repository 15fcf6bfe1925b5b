"""Pinocchio's accelerations at the states of a file that `simulate_mujoco.py golden` wrote.

usage: accelerations_pinocchio.py GOLDEN.json human.urdf OUTPUT.json
Writes, for each state, `root_acceleration` and `qdd` with the conventions of that file, and prints one line of JSON: the
largest differences from it [m/s^2, rad/s^2], `relative` to the largest acceleration.
"""
import json
import sys

import numpy as np
import pinocchio as pin

ROOT_SIZE = 6


def accelerations(model, data, joints, state):
    """-> linear acceleration of the root in world axes, angular in its own, joint accelerations; by `aba`."""
    root = state["root"]
    w, x, y, z = root["quaternion"]
    world_from_root = pin.Quaternion(w, x, y, z).toRotationMatrix()
    q, v, tau = pin.neutral(model), np.zeros(model.nv), np.zeros(model.nv)
    q[:7] = root["position"] + [x, y, z, w]
    # Pinocchio takes both velocities of a free joint in its own axes.
    v[:3] = world_from_root.T @ root["velocity"]
    v[3:6] = omega = np.array(root["angular_velocity"])
    for i, joint in enumerate(joints):
        q[joint.idx_q], v[joint.idx_v], tau[joint.idx_v] = state["q"][i], state["qd"][i], state["tau"][i]
    a = pin.aba(model, data, q, v, tau)
    # Its linear part is the change seen in the moving axes.
    linear = world_from_root @ (a[:3] + np.cross(omega, v[:3]))
    return linear, a[3:6], np.array([a[joint.idx_v] for joint in joints])


def main():
    golden_path, urdf, output = sys.argv[1:]
    with open(golden_path) as file:
        golden = json.load(file)
    model = pin.buildModelFromUrdf(urdf, pin.JointModelFreeFlyer())
    model.gravity.linear = np.array(golden["gravity"])
    data = model.createData()
    joints = [model.joints[model.getJointId(joint["name"])] for joint in golden["joints"]]
    assert model.nv == ROOT_SIZE + len(joints), "%s has other joints than %s" % (urdf, golden_path)
    states, differences, largest = [], np.zeros(3), 0.0
    for state in golden["states"]:
        linear, angular, qdd = accelerations(model, data, joints, state)
        expected = (state["root_acceleration"]["linear"], state["root_acceleration"]["angular"], state["qdd"])
        found = (linear, angular, qdd)
        differences = np.maximum(differences, [np.abs(f - np.array(e)).max() for f, e in zip(found, expected)])
        largest = max(largest, float(np.abs(qdd).max()))
        states.append(dict(root_acceleration=dict(linear=linear.tolist(), angular=angular.tolist()), qdd=qdd.tolist()))
    with open(output, "w") as file:
        json.dump(dict(peer="Pinocchio", version=pin.__version__, states=states), file, indent=1)
        file.write("\n")
    names = ("root_linear", "root_angular", "qdd")
    print(json.dumps(dict(peer="Pinocchio", version=pin.__version__, **dict(zip(names, differences.tolist())),
                          relative=float(differences.max()) / largest)))


if __name__ == "__main__":
    main()
