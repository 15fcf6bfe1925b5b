//! Tables of a simulated scene: one row per output instant and body, joint coordinate, contact or closure.

use crate::files::OutputFile;
use crate::state_table::csv_cell;
use crate::{CLOSURES, CONTACTS, ENERGY, JOINTS, MOMENTS, POSES, SCENE_REACTIONS};
use ambulo::simulation::scene::{Outputs, Scene, SceneFrame};
use ambulo::simulation::{ContactForce, Owner, StepForces, TreeJoint, World, WorldState};
use ambulo::spatial::{Mat3, Pose, Twist, Vec3};
use ambulo_formats::Error;
use ambulo_formats::number::NumberText;
use ambulo_formats::table::Table;
use nalgebra::{Rotation3, UnitQuaternion};

/// Collects the rows of a run frame by frame.
#[derive(Debug, Clone)]
pub struct SceneTables {
    kept: Outputs,
    poses: RowTable,
    joints: RowTable,
    reactions: RowTable,
    contacts: RowTable,
    closures: RowTable,
    energy: RowTable,
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
            poses: RowTable::new(POSES, "time,body,px,py,pz,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz"),
            joints: RowTable::new(JOINTS, "time,joint,coordinate,value,rate,effort,unit"),
            reactions: RowTable::new(SCENE_REACTIONS, "time,joint,body,fx,fy,fz,mx,my,mz,px,py,pz"),
            contacts: RowTable::new(
                CONTACTS,
                "time,kind,first,second,px,py,pz,nx,ny,nz,fx,fy,fz,normal_force,friction_force,slip_m_s,gap_m",
            ),
            closures: RowTable::new(CLOSURES, "time,closure,fx,fy,fz,mx,my,mz,px,py,pz,gap_m"),
            energy: RowTable::new(
                ENERGY,
                "time,kinetic,gravity,springs,total,iterations,factorizations,residual,converged",
            ),
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
    /// Column names that a table cannot store, numbers that are not finite.
    pub fn files(self, scene: &Scene) -> Result<Vec<OutputFile<'static>>, Error> {
        let world = scene.world();
        let (kept, jointed) = (&self.kept, !scene.world().joints.is_empty() || self.joints.rows > 0);
        let mut files = Vec::new();
        let wanted = [
            (kept.poses, self.poses),
            (kept.joints && jointed, self.joints),
            (kept.joints && jointed, self.reactions),
            (kept.contacts && !world.surfaces.is_empty(), self.contacts),
            (kept.joints && !world.closures.is_empty(), self.closures),
            (kept.energy, self.energy),
        ];
        for (_, table) in wanted.into_iter().filter(|(wanted, _)| *wanted) {
            files.push(table.file()?);
        }
        if kept.joints && !self.moments.is_empty() && !self.times.is_empty() {
            let columns = std::iter::once(("time".to_owned(), self.times)).chain(self.moments).collect();
            let mut table = Table::new("Generalized Forces", columns)?;
            table.in_degrees = Some(false);
            files.push(OutputFile::storage(MOMENTS, table)?);
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
        let table = &mut self.poses;
        table.begin(time_s, &[name]);
        table.append(pose.translation.as_slice());
        table.append(&quaternion(&pose.rotation));
        table.append(twist.linear.as_slice());
        table.append(twist.angular.as_slice());
        table.end();
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
        let table = &mut self.joints;
        table.begin(time_s, &[joint, name]);
        table.append(&[of.value, of.rate]);
        match of.effort {
            Some(effort) => table.append(&[effort]),
            None => table.word(""),
        }
        table.word(if turns { "N.m" } else { "N" });
        table.end();
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
        let table = &mut self.reactions;
        table.begin(state.time_s, &[&joint.name, &world.bodies[joint.child].name]);
        table.append(wrench.force.as_slice());
        table.append(wrench.moment.as_slice());
        table.append(center.as_slice());
        table.end();
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
        let table = &mut self.contacts;
        table.begin(time_s, &[kind, world.owner_name(first), world.owner_name(second)]);
        table.append(contact.point.as_slice());
        table.append((contact.normal * sign).as_slice());
        table.append((contact.force * sign).as_slice());
        table.append(&[contact.normal_force, friction.norm(), contact.slip.norm(), contact.gap]);
        table.end();
    }

    fn add_closures(&mut self, frame: &SceneFrame<'_>) {
        let Some(forces) = &frame.forces else { return };
        let (world, state) = (frame.scene.world(), frame.scene.state());
        for (number, wrench) in &forces.closing {
            let closure = &world.closures[*number];
            let pose = state.poses[closure.first];
            let point = pose.place(closure.first_from_joint.translation);
            let wrench = wrench.about(pose.translation - point);
            let table = &mut self.closures;
            table.begin(state.time_s, &[&closure.name]);
            table.append(wrench.force.as_slice());
            table.append(wrench.moment.as_slice());
            table.append(point.as_slice());
            table.append(&[frame.scene.closure_gap(*number)]);
            table.end();
        }
    }

    fn add_energy(&mut self, frame: &SceneFrame<'_>) {
        let energy = &frame.energy;
        let table = &mut self.energy;
        table.begin(frame.scene.state().time_s, &[]);
        table.append(&[energy.kinetic, energy.gravity, energy.springs, energy.total()]);
        match frame.forces.as_ref().map(|forces| forces.convergence) {
            Some(c) => {
                table.append(&[c.iterations as f64, c.factorizations as f64, c.residual]);
                table.word(if c.converged { "true" } else { "false" });
            }
            None => (0..4).for_each(|_| table.word("")),
        }
        table.end();
    }
}

/// A row of a coordinate.
struct Coordinate {
    value: f64,
    rate: f64,
    effort: Option<f64>,
}

/// The text of a table, written row by row; remembers the first number that is not finite.
#[derive(Debug, Clone)]
pub struct RowTable {
    name: &'static str,
    head: &'static str,
    text: String,
    /// Complete rows.
    rows: usize,
    /// Cells of the present row.
    cells: usize,
    broken: Option<Error>,
}

impl RowTable {
    /// A table without rows.
    #[must_use]
    pub fn new(name: &'static str, head: &'static str) -> RowTable {
        RowTable { name, head, text: format!("{head}\n"), rows: 0, cells: 0, broken: None }
    }

    /// The instant and the names that a row begins with.
    pub fn begin(&mut self, time_s: f64, names: &[&str]) {
        // 350 steps of 1 ms are 0.35000000000000003 s: the last digits are rounding errors.
        self.text.push_str(NumberText::default().plain((time_s * 1e12).round() / 1e12));
        self.cells = 1;
        names.iter().for_each(|name| self.word(name));
    }

    fn word(&mut self, word: &str) {
        self.cells += 1;
        self.text.push(',');
        self.text.push_str(&csv_cell(word));
    }

    /// The next numbers of the row.
    pub fn append(&mut self, numbers: &[f64]) {
        let mut text = NumberText::default();
        for &found in numbers {
            if !found.is_finite() && self.broken.is_none() {
                let column = self.head.split(',').nth(self.cells).unwrap_or_default().to_owned();
                self.broken = Some(Error::NotFinite { table: self.name.to_owned(), column, row: self.rows + 1, found });
            }
            self.cells += 1;
            self.text.push(',');
            self.text.push_str(text.plain(found));
        }
    }

    /// Ends the row.
    pub fn end(&mut self) {
        self.rows += 1;
        self.text.push('\n');
    }

    /// The text written so far.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The file.
    ///
    /// # Errors
    /// The first number that is not finite.
    pub fn file(self) -> Result<OutputFile<'static>, Error> {
        self.broken.map_or_else(|| Ok(OutputFile::new(self.name, self.text.into_bytes())), Err)
    }
}

/// w, x, y, z with w not negative.
fn quaternion(rotation: &Mat3) -> [f64; 4] {
    let q = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*rotation));
    let sign = if q.w < 0.0 { -1.0 } else { 1.0 };
    let v: Vec3 = q.imag() * sign;
    [q.w * sign, v.x, v.y, v.z]
}
