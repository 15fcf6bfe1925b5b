"""Writes by_protobuf.b3d with protobuf 7.36.2 and the published schema (keenon/nimblephysics, dart/proto/SubjectOnDisk.proto):

    pip install grpcio-tools
    python -m grpc_tools.protoc -I. --python_out=. SubjectOnDisk.proto
    python by_protobuf.py
"""

import struct

import SubjectOnDisk_pb2 as schema

nan = float("nan")
header = schema.SubjectOnDiskHeader()
header.num_dofs, header.num_joints, header.num_trials, header.version = 3, 1, 2, 4
header.biological_sex, header.height_m, header.mass_kg, header.age_years = "female", 1.7, 68, -1
header.href = "h"
header.marker_name.extend(["HEEL", "TOE"])
header.acc_name.append("imu")
header.emg_name.append("sol")
header.emg_dim = 2
header.ground_contact_body.extend(["calcn_r"])
for kind in (0, 1):
    of_file = header.passes.add()
    of_file.pass_type = kind
    of_file.model_osim_text = f"<osim {kind}>"
frames = []
for name, count, reasons, passes, kind in [("walk", 2, [0, 5], 2, 1), ("stand", 1, [0], 1, 2)]:
    trial = header.trial_header.add()
    trial.name, trial.trial_length, trial.trial_timestep, trial.trial_type = name, count, 0.01, kind
    trial.missing_GRF_reason.extend(reasons)
    trial.num_force_plates = 1
    trial.original_trial_start_time = 1.5
    trial.has_manual_GRF_annotation.extend([False] * count)
    for k in range(passes):
        of_trial = trial.processing_pass_header.add()
        of_trial.type = k
        of_trial.dof_positions_observed.extend([True, True, False])
        of_trial.lowpass_cutoff_frequency = 8
        of_trial.marker_rms.extend([0.01] * count)
    for i in range(count):
        seen = schema.SubjectOnDiskSensorFrame()
        seen.marker_obs.extend([0.1 + i, 0.2, 0.3, nan, nan, nan])
        seen.acc_obs.extend([0, 9.81, 0])
        seen.emg_obs.extend([0, 0])
        for values in (seen.raw_force_plate_cop, seen.raw_force_plate_torque, seen.raw_force_plate_force):
            values.extend([0, 0, 0])
        computed = []
        for k in range(passes):
            frame = schema.SubjectOnDiskProcessingPassFrame()
            frame.pos.extend([i + 10 * k, 0.5, 0.0])
            for values in (frame.vel, frame.acc, frame.tau):
                values.extend([0, 0, 0])
            frame.ground_contact_wrench.extend([0] * 6)
            frame.ground_contact_force.extend([1.0, 700.0 - i, 2.0])
            frame.ground_contact_center_of_pressure.extend([0.1, 0.0, 0.2])
            frame.ground_contact_torque.extend([0, 3.0, 0])
            frame.com_pos.extend([0, 1.0, 0])
            computed.append(frame.SerializeToString())
        frames.append((seen.SerializeToString(), computed))
header.raw_sensor_frame_size, header.processing_pass_frame_size = len(frames[0][0]), len(frames[0][1][0])
message = header.SerializeToString()
with open("by_protobuf.b3d", "wb") as file:
    file.write(struct.pack("<q", len(message)) + message)
    for seen, computed in frames:
        file.write(seen + b"".join(computed))
