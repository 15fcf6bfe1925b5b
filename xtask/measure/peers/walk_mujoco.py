"""A figure in MuJoCo that a controller outside drives step by step; started by `cargo xtask physical-peers`.

usage: walk_mujoco.py MODEL.xml CONTACT
CONTACT is `shoes`, as the model has it, or `default`, MuJoCo's own, with the same friction coefficient.

The model names its coordinates in the text `coordinates`, and has one motor for each coordinate that is driven. All numbers
on the pipes are little-endian f64; vectors have one entry per coordinate, in that order.

| pipe            | what                                                                                            |
|-----------------|-------------------------------------------------------------------------------------------------|
| standard output | one line of JSON: version, and settings of solver and contact                                   |
| standard input  | values, rates at the start                                                                      |
| standard output | their mass matrix by columns, and the forces that keep the rates constant without contact       |
| standard input  | for each step: kp, kd, target and largest torque; torque = clamp(kp (target - q) - kd rate)     |
| standard output | after each step: time, values, rates, vertical force of the step on the right and the left foot |
| standard output | after the end of the input, one line of JSON: time of a step, and whether the state was finite  |

Damping is part of the motors, so MuJoCo's implicit integrators take it implicitly, except where a torque is at its limit.
"""
import json
import math
import sys
import time

import mujoco
import numpy as np

# States of the walk are simulated again for the time of a step, this many steps from each, with the motors of the state.
BATCH, PASSES = 10, 5
EMPTY = '<mujoco><worldbody><geom type="plane" size="1 1 1"/></worldbody></mujoco>'


class Figure:
    def __init__(self, path, contact):
        self.model = model = mujoco.MjModel.from_xml_path(path)
        self.data = mujoco.MjData(model)
        self.names = bytes(model.text_data).decode().strip("\0").split()  # the only text of the model
        joints = [model.joint(name) for name in self.names]
        self.places = np.array([joint.qposadr[0] for joint in joints])
        self.rates = np.array([joint.dofadr[0] for joint in joints])
        self.driven = np.array([self.names.index(model.actuator(i).name) for i in range(model.nu)])
        self.spheres = np.flatnonzero(model.geom_type == mujoco.mjtGeom.mjGEOM_SPHERE)
        self.foot = {int(sphere): int(model.geom_user[sphere, 2]) for sphere in self.spheres}
        if contact == "default":
            model.geom_solimp[self.spheres] = mujoco.MjModel.from_xml_string(EMPTY).geom_solimp[0]
            model.opt.impratio = 1.0
        else:
            self.soften()
        self.history = []

    def soften(self):
        """MuJoCo multiplies `solref` by the mass of a contact, so ours is divided by it."""
        for sphere in self.spheres:
            inverse_mass = self.model.body_invweight0[self.model.geom_bodyid[sphere], 0]
            self.model.geom_solref[sphere] = -self.model.geom_user[sphere, :2] * inverse_mass

    def start(self, values, rates):
        self.data.qpos[self.places] = values
        self.data.qvel[self.rates] = rates

    def inertia_and_bias(self):
        """Of the state at the start, for a comparison with the model that was exported."""
        mujoco.mj_forward(self.model, self.data)
        full = np.zeros((self.model.nv, self.model.nv))
        mujoco.mj_fullM(self.model, self.data, full)
        return np.concatenate([full[np.ix_(self.rates, self.rates)].ravel(), self.data.qfrc_bias[self.rates]])

    def drive(self, motors):
        model = self.model
        kp, kd, target, most = motors[:, self.driven]
        model.actuator_gainprm[:, 0] = kp
        model.actuator_biasprm[:, 1] = -kp
        model.actuator_biasprm[:, 2] = -kd
        model.actuator_forcerange[:, 0] = -most
        model.actuator_forcerange[:, 1] = most
        self.data.ctrl[:] = target

    def step(self, motors):
        self.history.append((self.data.qpos.copy(), self.data.qvel.copy(), self.data.qacc_warmstart.copy(), motors))
        self.drive(motors)
        mujoco.mj_step(self.model, self.data)

    def loads(self):
        """Vertical force on the right and the left foot in the last step [N]."""
        loads, force = [0.0, 0.0], np.zeros(6)
        for i in range(self.data.ncon):
            mujoco.mj_contactForce(self.model, self.data, i, force)
            loads[self.foot[int(self.data.contact[i].geom[1])]] += force[0]  # the plane is the first one, and level
        return loads

    def state(self):
        values, rates = self.data.qpos[self.places], self.data.qvel[self.rates]
        return np.concatenate([[self.data.time], values, rates, self.loads()])

    def step_us(self):
        """Processor time of mj_step [us], mean over the walk; median of passes."""
        means = []
        for _ in range(PASSES):
            spent, steps = 0.0, 0
            for qpos, qvel, warmstart, motors in self.history[::BATCH]:
                self.data.qpos[:], self.data.qvel[:], self.data.qacc_warmstart[:] = qpos, qvel, warmstart
                self.drive(motors)
                begin = time.thread_time()
                mujoco.mj_step(self.model, self.data, nstep=BATCH)
                spent += time.thread_time() - begin
                steps += BATCH
            means.append(spent / max(steps, 1) * 1e6)
        return sorted(means)[PASSES // 2]

    def settings(self):
        option, model = self.model.opt, self.model
        return dict(
            integrator=mujoco.mjtIntegrator(option.integrator).name[6:].lower(),
            solver=mujoco.mjtSolver(option.solver).name[6:], iterations=option.iterations, tolerance=option.tolerance,
            impratio=option.impratio, solimp=model.geom_solimp[self.spheres[0]].tolist(),
            solref={model.geom(s).name: model.geom_solref[s].tolist() for s in self.spheres})


def say(**values):
    sys.stdout.buffer.write((json.dumps(values) + "\n").encode())
    sys.stdout.buffer.flush()


def send(values):
    sys.stdout.buffer.write(values.astype("<f8").tobytes())
    sys.stdout.buffer.flush()


def numbers(count):
    """Numbers from standard input; None at its end."""
    read = sys.stdin.buffer.read(8 * count)
    return np.frombuffer(read, "<f8") if len(read) == 8 * count else None


def main():
    figure = Figure(*sys.argv[1:3])
    say(version=mujoco.__version__, **figure.settings())
    size = len(figure.names)
    start = numbers(2 * size)
    if start is None:
        return
    figure.start(start[:size], start[size:])
    send(figure.inertia_and_bias())
    finite = True
    while (motors := numbers(4 * size)) is not None:
        figure.step(motors.reshape(4, size))
        state = figure.state()
        finite = finite and math.isfinite(state.sum())
        send(state)
    say(step_us=figure.step_us() if finite else None, finite=finite)


if __name__ == "__main__":
    main()
