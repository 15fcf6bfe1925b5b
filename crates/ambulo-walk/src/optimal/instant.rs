//! Forces at one instant of a motion: contact forces of the soles on flat ground, inverse dynamics with these, and all
//! derivatives.
//!
//! With the spatial wrench W of the ground on a foot and the axes S of the links that carry it (as in
//! [`crate::dynamics::inverse_derivatives`]), the ground force adds to the generalised forces and their derivatives
//!
//!   τ_j = ... - S_jᵀ W        ∂τ_j/∂q̇_k = ... - S_jᵀ ∂W/∂q̇_k
//!   ∂τ_j/∂q_k = ... - S_jᵀ ∂W/∂q_k - (S_k × S_j)ᵀ W  if k carries j
//!
//! The contact point of a sphere with radius r and centre p is c = (p_x, (p_y - r)/2, p_z), midway between both
//! surfaces as in the simulator (above a surface at height h it is higher by h); its velocity is u = v + ω × c, the
//! velocity of the body. Coordinate q_k of link k moves the centre by ∂p/∂q_k, the velocity of S_k at p, and changes
//! the velocity of the body by ∂V/∂q_k = S_k × (V - V_k). An axis that follows a curve f of its coordinate adds s f''
//! q̇_k to the latter, and -(s f'')ᵀ W to ∂τ_k/∂q_k.

use crate::contact::{ContactSlopes, HuntCrossley};
use crate::dynamics::{CurvedJointError, DerivativeKernel, Spatial};
use crate::model::anthropometry::ContactSphere;
use crate::model::{Coordinate, Drive, Function, Model};
use crate::spatial::Vec3;

/// Instants that are evaluated side by side.
pub(super) const SIDE_BY_SIDE: usize = 8;

/// Value, rate and acceleration of every coordinate.
pub(super) type Posture = [Vec<f64>; 3];

/// Quantities of a contact, or their derivatives by a coordinate or by its rate.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ContactValues {
    /// Force on the foot [N].
    pub force: Vec3,
    /// Height of the sphere above its surface [m].
    pub height: f64,
    /// Slip along x and z [m/s].
    pub slip: [f64; 2],
    /// Position of the centre of the sphere along x [m].
    pub place_x: f64,
    /// Position of the centre of the sphere along z [m].
    pub place_z: f64,
}

impl ContactValues {
    /// Position along x (0) or z (2) [m].
    pub(super) fn place_along(&self, axis: usize) -> f64 {
        if axis == 0 { self.place_x } else { self.place_z }
    }
}

/// Forces of one instant, and their derivatives.
#[derive(Debug, Clone, Default)]
pub struct Instant {
    /// Values, rates and accelerations of all coordinates.
    pub posture: Posture,
    /// Generalised forces [N.m or N].
    pub forces: Vec<f64>,
    /// Their derivatives, one row per force: by all positions, then rates, then accelerations.
    pub slopes: Vec<f64>,
    /// Contacts, one per sphere.
    pub contacts: Vec<Contact>,
}

/// One sphere under a foot.
#[derive(Debug, Clone, Default)]
pub struct Contact {
    /// Position of the contact point [m].
    pub place: Vec3,
    /// The quantities themselves.
    pub values: ContactValues,
    /// Per link that carries the foot: its coordinate, and the derivatives of the values by position and by rate of the
    /// coordinate.
    pub slopes: Vec<(usize, [ContactValues; 2])>,
}

/// Computes forces and derivatives for the postures of instants.
#[derive(Debug)]
pub struct Evaluator {
    kernel: DerivativeKernel<SIDE_BY_SIDE>,
    soles: Vec<ContactSphere>,
    /// Height of the surface under each sphere [m].
    levels: Vec<f64>,
    /// Links that carry each body, the one that moves the body directly first.
    chains: Vec<Vec<usize>>,
    /// Coupled coordinates: their own number, the number of their leader, and the coupler.
    couplers: Vec<(usize, usize, Function)>,
}

/// A spatial vector of one instant.
#[derive(Debug, Clone, Copy)]
struct One {
    angular: Vec3,
    linear: Vec3,
}

impl One {
    fn of(from: &Spatial<SIDE_BY_SIDE>, lane: usize) -> One {
        One { angular: from.angular.lane(lane), linear: from.linear.lane(lane) }
    }

    fn cross(self, other: One) -> One {
        One {
            angular: self.angular.cross(&other.angular),
            linear: self.angular.cross(&other.linear) + self.linear.cross(&other.angular),
        }
    }

    /// Velocity at the point `place`.
    fn at(self, place: Vec3) -> Vec3 {
        self.linear + self.angular.cross(&place)
    }

    fn dot(self, other: One) -> f64 {
        self.angular.dot(&other.angular) + self.linear.dot(&other.linear)
    }
}

/// A sphere on the ground at one instant: its centre, the contact point, the velocity of the body, and the force on the
/// sphere.
#[derive(Debug, Clone, Copy)]
struct Touch {
    center: Vec3,
    place: Vec3,
    motion: One,
    found: ContactSlopes,
}

const NO_WRENCH: One = One { angular: Vec3::new(0.0, 0.0, 0.0), linear: Vec3::new(0.0, 0.0, 0.0) };

impl Evaluator {
    /// `levels` are heights of surfaces, 0 where there are fewer than spheres [m].
    pub fn new(model: &Model, soles: &[ContactSphere], levels: &[f64]) -> Result<Evaluator, CurvedJointError> {
        let kernel = DerivativeKernel::with_couplers(model)?;
        let chain = |mut last: Option<usize>| {
            let mut chain = Vec::new();
            while let Some(link) = last {
                chain.push(link);
                last = kernel.links[link].before;
            }
            chain
        };
        let chains = kernel.link_of_body.iter().map(|&last| chain(last)).collect();
        let levels = (0..soles.len()).map(|sphere| levels.get(sphere).copied().unwrap_or(0.0)).collect();
        let coupler = |(c, coordinate): (usize, &Coordinate)| match &coordinate.drive {
            Drive::Coupled(leader, function) => Some((c, leader.index(), function.clone())),
            _ => None,
        };
        let couplers = model.coordinates().iter().enumerate().filter_map(coupler).collect();
        Ok(Evaluator { kernel, soles: soles.to_vec(), levels, chains, couplers })
    }

    /// Numbers of the coordinates on which the force of a coordinate depends: coordinates of links that carry its link
    /// or are carried by it. Forces of the ground depend on the links that carry the foot, which all carry each other.
    pub(super) fn related(&self, coordinate: usize) -> Vec<usize> {
        let links = &self.kernel.links;
        let chain = |link: usize| std::iter::successors(Some(link), |&carried| links[carried].before);
        let own: Vec<usize> = (0..links.len()).filter(|&link| links[link].coordinate == coordinate).collect();
        let is_related =
            |link: usize| own.iter().any(|&one| chain(one).any(|l| l == link) || chain(link).any(|l| l == one));
        let mut related: Vec<usize> =
            (0..links.len()).filter(|&link| is_related(link)).map(|link| links[link].coordinate).collect();
        related.sort_unstable();
        related.dedup();
        related
    }

    /// Coupled coordinates take the values that follow from their leaders.
    fn follow_leaders(&self, [q, qd, qdd]: &mut Posture) {
        for (follower, leader, function) in &self.couplers {
            let (rate, acceleration) = (qd[*leader], qdd[*leader]);
            let [value, slope, bend] = function.at(q[*leader]);
            q[*follower] = value;
            qd[*follower] = slope * rate;
            qdd[*follower] = slope * acceleration + bend * rate * rate;
        }
    }

    /// Computes forces, contacts and derivatives of all instants from their postures.
    pub fn evaluate(&mut self, law: &HuntCrossley, instants: &mut [Instant]) {
        self.evaluate_parts(law, instants, true);
    }

    /// As [`Evaluator::evaluate`], without derivatives, in about half the time. Values are the same to the last bit.
    pub fn evaluate_forces(&mut self, law: &HuntCrossley, instants: &mut [Instant]) {
        self.evaluate_parts(law, instants, false);
    }

    fn evaluate_parts(&mut self, law: &HuntCrossley, instants: &mut [Instant], slopes: bool) {
        for block in instants.chunks_mut(SIDE_BY_SIDE) {
            block.iter_mut().for_each(|instant| self.follow_leaders(&mut instant.posture));
            for lane in 0..SIDE_BY_SIDE {
                let [q, qd, qdd] = &block[lane.min(block.len() - 1)].posture;
                let scratch = &mut self.kernel.scratch;
                for (all, values) in [(&mut scratch.q, q), (&mut scratch.qd, qd), (&mut scratch.qdd, qdd)] {
                    for (lanes, value) in all.iter_mut().zip(values) {
                        lanes[lane] = *value;
                    }
                }
            }
            if slopes {
                self.kernel.evaluate()
            } else {
                self.kernel.evaluate_forces()
            }
            for (lane, instant) in block.iter_mut().enumerate() {
                instant.forces.clear();
                instant.forces.extend(self.kernel.forces.iter().map(|force| force.0[lane]));
                instant.slopes.clear();
                instant.contacts.resize_with(self.soles.len(), Contact::default);
                if slopes {
                    self.take_slopes(lane, instant);
                    self.add_ground(law, lane, instant);
                } else {
                    self.add_ground_forces(law, lane, instant);
                }
            }
        }
    }

    fn take_slopes(&self, lane: usize, instant: &mut Instant) {
        let count = self.kernel.coordinates();
        for row in 0..count {
            for slopes in &self.kernel.slopes {
                instant.slopes.extend(slopes[row * count..(row + 1) * count].iter().map(|slope| slope.0[lane]));
            }
        }
    }

    /// Adds the contacts of all spheres to forces.
    fn add_ground_forces(&self, law: &HuntCrossley, lane: usize, instant: &mut Instant) {
        for (k, sole) in self.soles.iter().enumerate() {
            let touch = self.meet(law, lane, k, &mut instant.contacts[k]);
            if touch.found.force.y.abs() <= 0.0 {
                continue;
            }
            let wrench = touch.wrench();
            for &link in &self.chains[sole.body.index()] {
                let axis = One::of(&self.kernel.axes[link], lane);
                instant.forces[self.kernel.links[link].coordinate] -= axis.dot(wrench);
            }
        }
    }

    /// Adds the contacts of all spheres to forces and derivatives.
    fn add_ground(&self, law: &HuntCrossley, lane: usize, instant: &mut Instant) {
        for k in 0..self.soles.len() {
            let chain = &self.chains[self.soles[k].body.index()];
            let (wrench, slopes) = self.touch(law, lane, k, &mut instant.contacts[k]);
            if instant.contacts[k].values.force.y.abs() <= 0.0 {
                continue;
            }
            let links: Vec<(usize, One)> = chain
                .iter()
                .map(|&link| (self.kernel.links[link].coordinate, One::of(&self.kernel.axes[link], lane)))
                .collect();
            let curved = chain.iter().filter(|&&link| self.kernel.links[link].is_curved());
            for &link in curved {
                let c = self.kernel.links[link].coordinate;
                let bend = One::of(&self.kernel.bends[link], lane);
                instant.slopes[3 * self.kernel.coordinates() * c + c] -= bend.dot(wrench);
            }
            let width = 3 * self.kernel.coordinates();
            for (j, (row, axis)) in links.iter().enumerate() {
                instant.forces[*row] -= axis.dot(wrench);
                let row = &mut instant.slopes[row * width..(row + 1) * width];
                for (i, ((column, carrier), slope)) in links.iter().zip(&slopes).enumerate() {
                    let turned = if i > j { carrier.cross(*axis).dot(wrench) } else { 0.0 };
                    row[*column] -= axis.dot(slope[0]) + turned;
                    row[self.kernel.coordinates() + column] -= axis.dot(slope[1]);
                }
            }
        }
    }

    /// Computes the contact of one sphere and sets its values.
    fn meet(&self, law: &HuntCrossley, lane: usize, sphere: usize, contact: &mut Contact) -> Touch {
        let sole = &self.soles[sphere];
        let body = sole.body.index();
        let pose = self.kernel.pose(body, lane);
        let center = pose.rotation * sole.center + pose.translation;
        let height = center.y - sole.radius - self.levels[sphere];
        let place = Vec3::new(center.x, self.levels[sphere] + 0.5 * height, center.z);
        let motion = self.chains[body].first().map_or(NO_WRENCH, |&link| One::of(&self.kernel.velocities[link], lane));
        let velocity = motion.at(place);
        let found = law.force_with_slopes(sole.radius, -height, -velocity.y, velocity);
        contact.place = place;
        let slip = [velocity.x, velocity.z];
        contact.values = ContactValues { force: found.force, height, slip, place_x: center.x, place_z: center.z };
        contact.slopes.clear();
        Touch { center, place, motion, found }
    }

    /// Computes the contact of one sphere. Returns its wrench at the origin of the world, with its derivatives by
    /// position and rate of each link of the chain.
    fn touch(&self, law: &HuntCrossley, lane: usize, sphere: usize, contact: &mut Contact) -> (One, Vec<[One; 2]>) {
        let touch = self.meet(law, lane, sphere, contact);
        let Touch { center, place, motion, found } = touch;
        let force = found.force;
        let chain = &self.chains[self.soles[sphere].body.index()];
        let mut wrenches = Vec::with_capacity(chain.len());
        for &link in chain {
            let axis = One::of(&self.kernel.axes[link], lane);
            let moved = axis.at(center);
            let shifted = Vec3::new(moved.x, 0.5 * moved.y, moved.z);
            let mut turned = axis.cross(motion.minus(One::of(&self.kernel.velocities[link], lane)));
            if self.kernel.links[link].is_curved() {
                let rate = self.kernel.scratch.qd[self.kernel.links[link].coordinate][lane];
                turned = turned.plus(One::of(&self.kernel.bends[link], lane), rate);
            }
            let velocity_slopes = [turned.at(place) + motion.angular.cross(&shifted), axis.at(place)];
            let depth_slopes = [-moved.y, 0.0];
            let place_slopes = [[moved.x, moved.z], [0.0; 2]];
            let mut slopes = [ContactValues::default(); 2];
            let mut wrench = [NO_WRENCH; 2];
            for part in 0..2 {
                let v = velocity_slopes[part];
                let f = found.by_depth * depth_slopes[part] - found.by_rate * v.y
                    + found.by_slip[0] * v.x
                    + found.by_slip[1] * v.z;
                let [place_x, place_z] = place_slopes[part];
                let (height, slip) = (-depth_slopes[part], [v.x, v.z]);
                slopes[part] = ContactValues { force: f, height, slip, place_x, place_z };
                let arm = if part == 0 { shifted.cross(&force) } else { Vec3::zeros() };
                wrench[part] = One { angular: arm + place.cross(&f), linear: f };
            }
            contact.slopes.push((self.kernel.links[link].coordinate, slopes));
            wrenches.push(wrench);
        }
        (touch.wrench(), wrenches)
    }
}

impl Touch {
    /// The wrench of the ground at the origin of the world.
    fn wrench(&self) -> One {
        One { angular: self.place.cross(&self.found.force), linear: self.found.force }
    }
}

impl One {
    fn plus(self, other: One, factor: f64) -> One {
        One { angular: self.angular + other.angular * factor, linear: self.linear + other.linear * factor }
    }

    fn minus(self, other: One) -> One {
        One { angular: self.angular - other.angular, linear: self.linear - other.linear }
    }
}
