//! Tables of a simulated scene: one row per output instant and body, joint coordinate, contact or closure.

use crate::files::OutputFile;
use ambulo::simulation::scene::{Outputs, Scene, SceneFrame};
use ambulo::simulation::{ContactForce, Owner, StepForces, TreeJoint, World, WorldState};
use ambulo::spatial::{Mat3, Pose, Twist, Vec3};
use ambulo_formats::Error;
use ambulo_formats::table::Table;
use nalgebra::{Rotation3, UnitQuaternion};
use std::fmt::Write;

/// Collects the rows of a run frame by frame.
#[derive(Debug, Clone)]
pub struct SceneTables {
    kept: Outputs,
    poses: String,
    joints: String,
    reactions: String,
    contacts: String,
    closures: String,
    energy: String,
    /// Instants and generalised forces of the figures, column by column.
    times: Vec<f64>,
    moments: Vec<(String, Vec<f64>)>,
    rows: usize,
}

impl SceneTables {
    /// Tables without rows.
    #[must_use]
    pub fn new(scene: &Scene) -> SceneTables {
        let several = scene.world().figures.len() > 1;
        let names = scene.figure_names().zip(&scene.world().figures).flat_map(|(name, figure)| {
            let plain = figure.model.force_names().into_iter();
            plain.map(move |column| if several { format!("{name}/{column}") } else { column })
        });
        SceneTables {
            kept: scene.outputs().clone(),
            poses: "time,body,px,py,pz,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n".into(),
            joints: "time,joint,coordinate,value,rate,effort,unit\n".into(),
            reactions: "time,joint,body,fx,fy,fz,mx,my,mz,px,py,pz\n".into(),
            contacts: "time,kind,first,second,px,py,pz,nx,ny,nz,fx,fy,fz,normal_force,friction_force,slip_m_s,gap_m\n"
                .into(),
            closures: "time,closure,fx,fy,fz,mx,my,mz,px,py,pz,gap_m\n".into(),
            energy: "time,kinetic,gravity,springs,total,iterations,factorizations,residual,converged\n".into(),
            times: Vec::new(),
            moments: names.map(|name| (name, Vec::new())).collect(),
            rows: 0,
        }
    }

    /// Adds the rows of one instant.
    pub fn add(&mut self, frame: &SceneFrame<'_>) {
        self.rows += 1;
        if self.kept.poses {
            self.add_poses(frame);
        }
        if self.kept.joints {
            self.add_joints(frame);
        }
        if self.kept.contacts {
            self.add_contacts(frame);
        }
        if self.kept.joints {
            self.add_closures(frame);
        }
        if self.kept.energy {
            self.add_energy(frame);
        }
    }

    /// Number of instants added.
    #[must_use]
    pub fn instants(&self) -> usize {
        self.rows
    }

    /// The files; files without content are left out.
    ///
    /// # Errors
    /// Column names that a table cannot store.
    pub fn files(self, scene: &Scene) -> Result<Vec<OutputFile>, Error> {
        let world = scene.world();
        let (kept, jointed) = (&self.kept, !scene.world().joints.is_empty() || self.joints.lines().count() > 1);
        let mut files = Vec::new();
        let mut add = |wanted: bool, name: &str, text: String| {
            if wanted {
                files.push(OutputFile::new(name, text.into_bytes()));
            }
        };
        add(kept.poses, "poses.csv", self.poses);
        add(kept.joints && jointed, "joints.csv", self.joints);
        add(kept.joints && jointed, "reactions.csv", self.reactions);
        add(kept.contacts && !world.surfaces.is_empty(), "contacts.csv", self.contacts);
        add(kept.joints && !world.closures.is_empty(), "closures.csv", self.closures);
        add(kept.energy, "energy.csv", self.energy);
        if kept.joints && !self.moments.is_empty() && !self.times.is_empty() {
            let columns = std::iter::once(("time".to_owned(), self.times)).chain(self.moments).collect();
            let mut table = Table::new("Generalized Forces", columns)?;
            table.in_degrees = Some(false);
            files.push(OutputFile::storage("moments.sto", table));
        }
        Ok(files)
    }

    fn add_poses(&mut self, frame: &SceneFrame<'_>) {
        let (world, state) = (frame.scene.world(), frame.scene.state());
        for ((body, pose), twist) in world.bodies.iter().zip(&state.poses).zip(&state.twists) {
            self.add_pose(state.time_s, &body.name, pose, twist);
        }
        for obstacle in world.obstacles.iter().filter(|obstacle| obstacle.path.is_some()) {
            let (pose, twist) = obstacle.at(state.time_s);
            self.add_pose(state.time_s, &obstacle.name, &pose, &twist);
        }
    }

    fn add_pose(&mut self, time_s: f64, name: &str, pose: &Pose, twist: &Twist) {
        let text = &mut self.poses;
        begin(text, time_s, &[name]);
        append(text, pose.translation.as_slice());
        append(text, &quaternion(&pose.rotation));
        append(text, twist.linear.as_slice());
        append(text, twist.angular.as_slice());
        text.push('\n');
    }

    fn add_joints(&mut self, frame: &SceneFrame<'_>) {
        let (world, state) = (frame.scene.world(), frame.scene.state());
        for (number, joint) in world.joints.iter().enumerate() {
            let rates = state.rates(joint);
            for (k, name) in joint.kind.coordinate_names().iter().enumerate() {
                let effort = frame.forces.as_ref().and_then(|f| f.efforts[number].get(k).copied());
                let of = Coordinate { value: state.coordinates[number][k], rate: rates[k], effort };
                self.add_coordinate(state.time_s, &joint.name, name, of, joint.kind.turns(k));
            }
        }
        if let Some(forces) = &frame.forces {
            for joint in &world.joints {
                self.add_reaction(state, joint, world, forces);
            }
        }
        self.add_figures(frame);
    }

    fn add_coordinate(&mut self, time_s: f64, joint: &str, name: &str, of: Coordinate, turns: bool) {
        let text = &mut self.joints;
        begin(text, time_s, &[joint, name]);
        append(text, &[of.value, of.rate]);
        match of.effort {
            Some(effort) => append(text, &[effort]),
            None => text.push(','),
        }
        text.push_str(if turns { ",N.m\n" } else { ",N\n" });
    }

    /// Coordinates of joints that follow a recording, and `moments.sto`.
    fn add_figures(&mut self, frame: &SceneFrame<'_>) {
        let Some(forces) = &frame.forces else { return };
        let scene = frame.scene;
        let figures = scene.generalized_forces(forces);
        if figures.is_empty() {
            return;
        }
        let time_s = scene.state().time_s;
        self.times.push(time_s);
        let flat = figures.iter().flatten().map(|[_, _, force]| *force);
        for ((_, column), force) in self.moments.iter_mut().zip(flat) {
            column.push(force);
        }
        for joint in &scene.world().joints {
            let Some(follows) = joint.follows else { continue };
            let model = &scene.world().figures[follows.figure].model;
            for id in model.bodies()[follows.body].joint.coordinates() {
                let [value, rate, force] = figures[follows.figure][id.index()];
                let coordinate = &model.coordinates()[id.index()];
                let turns = coordinate.kind.force_suffix() == "moment";
                let of = Coordinate { value, rate, effort: Some(force) };
                self.add_coordinate(time_s, &joint.name, &coordinate.name, of, turns);
            }
        }
    }

    fn add_reaction(&mut self, state: &WorldState, joint: &TreeJoint, world: &World, forces: &StepForces) {
        let pose = state.poses[joint.child];
        let center = pose.place(joint.child_from_joint.translation);
        let wrench = forces.joints[joint.child].about(pose.translation - center);
        let text = &mut self.reactions;
        begin(text, state.time_s, &[&joint.name, &world.bodies[joint.child].name]);
        append(text, wrench.force.as_slice());
        append(text, wrench.moment.as_slice());
        append(text, center.as_slice());
        text.push('\n');
    }

    fn add_contacts(&mut self, frame: &SceneFrame<'_>) {
        let world = frame.scene.world();
        for (time_s, contact) in &frame.impacts {
            self.add_contact(world, *time_s, "impact", contact);
        }
        let contacts = frame.forces.as_ref().map_or(&[][..], |forces| &forces.contacts);
        for contact in contacts.iter().filter(|contact| contact.normal_force > 0.0) {
            self.add_contact(world, frame.scene.state().time_s, "contact", contact);
        }
    }

    fn add_contact(&mut self, world: &World, time_s: f64, kind: &str, contact: &ContactForce) {
        let (a, b) = (world.surfaces[contact.surfaces.0].owner, world.surfaces[contact.surfaces.1].owner);
        // The body comes first; the force is the one on it.
        let (first, second, sign) = if matches!(a, Owner::Obstacle(_)) { (b, a, -1.0) } else { (a, b, 1.0) };
        let friction = contact.force - contact.normal * contact.normal_force;
        let text = &mut self.contacts;
        begin(text, time_s, &[kind, world.owner_name(first), world.owner_name(second)]);
        append(text, contact.point.as_slice());
        append(text, (contact.normal * sign).as_slice());
        append(text, (contact.force * sign).as_slice());
        append(text, &[contact.normal_force, friction.norm(), contact.slip.norm(), contact.gap]);
        text.push('\n');
    }

    fn add_closures(&mut self, frame: &SceneFrame<'_>) {
        let Some(forces) = &frame.forces else { return };
        let (world, state) = (frame.scene.world(), frame.scene.state());
        for (number, wrench) in &forces.closing {
            let closure = &world.closures[*number];
            let pose = state.poses[closure.first];
            let point = pose.place(closure.first_from_joint.translation);
            let wrench = wrench.about(pose.translation - point);
            let text = &mut self.closures;
            begin(text, state.time_s, &[&closure.name]);
            append(text, wrench.force.as_slice());
            append(text, wrench.moment.as_slice());
            append(text, point.as_slice());
            append(text, &[frame.scene.closure_gap(*number)]);
            text.push('\n');
        }
    }

    fn add_energy(&mut self, frame: &SceneFrame<'_>) {
        let energy = &frame.energy;
        let text = &mut self.energy;
        begin(text, frame.scene.state().time_s, &[]);
        append(text, &[energy.kinetic, energy.gravity, energy.springs, energy.total()]);
        match frame.forces.as_ref().map(|forces| forces.convergence) {
            Some(c) => {
                let _ = writeln!(text, ",{},{},{},{}", c.iterations, c.factorizations, c.residual, c.converged);
            }
            None => text.push_str(",,,,\n"),
        }
    }
}

/// A row of a coordinate.
struct Coordinate {
    value: f64,
    rate: f64,
    effort: Option<f64>,
}

fn begin(text: &mut String, time_s: f64, names: &[&str]) {
    // 350 steps of 1 ms are 0.35000000000000003 s: the last digits are rounding errors.
    let _ = write!(text, "{}", (time_s * 1e12).round() / 1e12);
    for name in names {
        if name.contains([',', '"']) {
            let _ = write!(text, ",\"{}\"", name.replace('"', "\"\""));
        } else {
            let _ = write!(text, ",{name}");
        }
    }
}

fn append(text: &mut String, numbers: &[f64]) {
    for number in numbers {
        let _ = write!(text, ",{number}");
    }
}

/// w, x, y, z with w not negative.
fn quaternion(rotation: &Mat3) -> [f64; 4] {
    let q = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*rotation));
    let sign = if q.w < 0.0 { -1.0 } else { 1.0 };
    let v: Vec3 = q.imag() * sign;
    [q.w * sign, v.x, v.y, v.z]
}
