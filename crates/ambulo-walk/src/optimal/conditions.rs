//! Conditions of a walk that are not in normative curves: slope, load, weak joints, devices, step width.

use super::error::OptimalWalkError;
use crate::model::anthropometry::Human;
use crate::model::{Model, ModelError, Side};
use crate::numerics::elementary::atan;
use crate::spatial::Vec3;
use crate::toml_reader::{Source, Table, TomlError, listed};

const DOCUMENT: &str = "device file";
/// Conditions of a predicted walk. The default is level walking without any of them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct WalkConditions {
    /// Rise of the ground per distance along the horizontal; positive is uphill.
    pub slope: f64,
    /// Something carried.
    pub load: Option<Load>,
    /// Coordinates whose muscles have a share of their strength left.
    pub strengths: Vec<(String, f64)>,
    /// Devices at joints.
    pub devices: Vec<Device>,
    /// Distance between the paths of both feet [m].
    pub step_width_m: Option<f64>,
    /// Whether both sides may move differently even if their conditions are the same.
    pub asymmetric: bool,
    /// Whether cadence and step length are those of the least cost at the speed of the walk, instead of the walk's own.
    pub free_cadence: bool,
}

/// A load that moves with the body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Load {
    /// Mass [kg].
    pub mass: f64,
    /// Place at which the load is carried.
    pub place: LoadPlace,
}

/// Where a load is carried.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LoadPlace {
    /// A backpack: behind the mass centre of trunk and head.
    Back,
    /// Half in each hand.
    Hands,
    /// On a belt: at the mass centre of the pelvis.
    Pelvis,
}

/// A device at a joint, of no mass: a spring, a damper, and a moment that repeats with every cycle. Its moment is
///
///   -k (q - q₀) - d q̇ + u(t)
#[derive(Debug, Clone, PartialEq)]
pub struct Device {
    /// Name of the coordinate of the joint.
    pub coordinate: String,
    /// Stiffness k [N.m/rad].
    pub stiffness: f64,
    /// Angle q₀ without moment of the spring [rad].
    pub rest: f64,
    /// Damping d [N.m.s/rad].
    pub damping: f64,
    /// Moment u at equal shares of the cycle of its leg, which begins with foot strike (of the right leg for joints of
    /// the trunk) [N.m]. Linear in between; none if empty.
    pub moments: Vec<f64>,
}

/// Smallest and largest slope [%].
const STEEPEST: [f64; 2] = [-40.0, 40.0];
/// Distance of the mass centre of a backpack behind the mass centre of trunk and head, as a share of stature: our
/// choice, 0.2 m for a man of 1.75 m.
const BACKPACK: f64 = 0.115;

impl LoadPlace {
    /// All places, with their names.
    pub const ALL: [(&'static str, LoadPlace); 3] =
        [("back", LoadPlace::Back), ("hands", LoadPlace::Hands), ("pelvis", LoadPlace::Pelvis)];

    /// Name of the place.
    #[must_use]
    pub fn name(self) -> &'static str {
        LoadPlace::ALL.iter().find(|(_, place)| *place == self).map_or("", |(name, _)| name)
    }

    /// The places in the figure as bodies, each with its position and its share of the load.
    fn on(self, human: &Human) -> Vec<(&'static str, Vec3, f64)> {
        let center = |name: &str| {
            let body = human.model.body(name).map(|id| human.model.bodies()[id.index()].inertia.center());
            body.unwrap_or_else(Vec3::zeros)
        };
        match self {
            LoadPlace::Back => {
                let behind = Vec3::new(-BACKPACK * human.build.height, 0.0, 0.0);
                vec![("torso", center("torso") + behind, 1.0)]
            }
            // A hand grips about twice as far from the elbow as the mass centre of forearm and hand.
            LoadPlace::Hands => ["forearm_r", "forearm_l"].map(|name| (name, center(name) * 2.0, 0.5)).to_vec(),
            LoadPlace::Pelvis => vec![("pelvis", center("pelvis"), 1.0)],
        }
    }
}

impl Device {
    /// Reads devices: tables `[[device]]` with the coordinate of a `joint` (without its side: on both sides),
    /// `stiffness` [N.m/rad], `rest_deg` or `rest_rad`, `damping` [N.m.s/rad] and `moments` [N.m].
    ///
    /// # Errors
    /// Anything else, with line and key.
    pub fn from_toml(text: &str) -> Result<Vec<Device>, TomlError> {
        let source = Source::new(text, DOCUMENT);
        let parsed = source.parse()?;
        let root = Table::root(&source, &parsed);
        root.only(&[&["device"]])?;
        let tables = root.tables("device")?;
        if tables.is_empty() {
            return Err(root.missing("device", "a table [[device]] for each device"));
        }
        let mut devices = Vec::new();
        for table in tables {
            table.only(&[&["joint", "stiffness", "rest_deg", "rest_rad", "damping", "moments"]])?;
            let list = table.get("moments");
            let expected = "a list of moments over the gait cycle [N.m]";
            let values = list.map_or(Ok(Vec::new()), |list| list.list(expected))?;
            if ["stiffness", "damping", "moments"].iter().all(|key| table.get(key).is_none()) {
                return Err(table.missing("stiffness", "a stiffness, a damping or moments: a device has one of them"));
            }
            devices.push(Device {
                coordinate: table.need("joint", "the coordinate of the joint")?.filled_text()?,
                stiffness: table.zero_or_more_or("stiffness", 0.0)?,
                rest: table.angle("rest")?.unwrap_or_default(),
                damping: table.zero_or_more_or("damping", 0.0)?,
                moments: values.iter().map(|value| value.number()).collect::<Result<_, _>>()?,
            });
        }
        Ok(devices)
    }

    /// The part of the moment that does not depend on the motion [N.m], at a share of the cycle.
    pub(super) fn given(&self, share: f64) -> f64 {
        let spring = self.stiffness * self.rest;
        if self.moments.is_empty() {
            return spring;
        }
        let place = share.rem_euclid(1.0) * self.moments.len() as f64;
        let (before, between) = ((place as usize) % self.moments.len(), place.fract());
        let after = (before + 1) % self.moments.len();
        spring + (1.0 - between) * self.moments[before] + between * self.moments[after]
    }

    /// Moment of the device [N.m] at a share of the cycle of its leg, an angle [rad] and a rate [rad/s].
    #[must_use]
    pub fn moment(&self, share: f64, angle: f64, rate: f64) -> f64 {
        self.given(share) - self.stiffness * angle - self.damping * rate
    }
}

impl WalkConditions {
    /// Angle of the ground [rad]; positive is uphill.
    #[must_use]
    pub fn incline(&self) -> f64 {
        atan(self.slope)
    }

    /// As [`WalkConditions::of_joints`], with all numbers in their ranges.
    ///
    /// # Errors
    /// A number out of its range; a joint that the model does not have.
    pub(super) fn checked(&self, model: &Model) -> Result<WalkConditions, OptimalWalkError> {
        let ranges = [
            ("a slope [%]", Some(100.0 * self.slope), STEEPEST, "-40 to 40 %, because feet slide on steeper ground"),
            ("a load [kg]", self.load.map(|load| load.mass), [0.0, f64::MAX], "0 or more"),
            ("a step width [m]", self.step_width_m, [0.0, 0.5], "0 to 0.5 m, because legs are not longer"),
        ];
        let strengths = self.strengths.iter().map(|(_, share)| Some(*share));
        let strengths =
            strengths.map(|share| ("a share of strength", share, [0.01, 10.0], "0.01 to 10, because no share is none"));
        for (what, found, [least, most], expected) in ranges.into_iter().chain(strengths) {
            if let Some(found) = found.filter(|found| !(least..=most).contains(found)) {
                return Err(OptimalWalkError::Condition { what, found, expected });
            }
        }
        self.of_joints(model)
    }

    /// The conditions with the names of coordinates of a model for all joints: `ankle` stands for `ankle_angle_r` and
    /// `ankle_angle_l`.
    ///
    /// # Errors
    /// A joint that the model does not have.
    fn of_joints(&self, model: &Model) -> Result<WalkConditions, OptimalWalkError> {
        let (mut strengths, mut devices) = (Vec::new(), Vec::new());
        for (joint, share) in &self.strengths {
            strengths.extend(coordinates_of(model, joint)?.into_iter().map(|name| (name, *share)));
        }
        for device in &self.devices {
            let names = coordinates_of(model, &device.coordinate)?;
            devices.extend(names.into_iter().map(|coordinate| Device { coordinate, ..device.clone() }));
        }
        Ok(WalkConditions { strengths, devices, ..self.clone() })
    }

    /// Whether both sides of the body have the same strengths and devices.
    #[must_use]
    pub fn is_symmetric(&self) -> bool {
        let other = |name: &str| match Side::split_name(name) {
            Some((side, joint)) => format!("{joint}_{}", side.other().letter()),
            None => name.to_owned(),
        };
        let strong = self
            .strengths
            .iter()
            .all(|(name, _)| (self.strength(name) - self.strength(&other(name))).abs() < f64::EPSILON);
        let count = |device: &Device| self.devices.iter().filter(|other| *other == device).count();
        let mirrored = |device: &Device| Device { coordinate: other(&device.coordinate), ..device.clone() };
        strong && self.devices.iter().all(|device| count(device) == count(&mirrored(device)))
    }

    /// Share of its strength that a coordinate has left.
    pub(super) fn strength(&self, coordinate: &str) -> f64 {
        self.strengths.iter().filter(|(name, _)| name == coordinate).map(|(_, share)| share).product()
    }

    /// The figure with its load, on a ground that is the plane y = 0 of its frame: x points along the slope and gravity
    /// is inclined.
    ///
    /// # Errors
    /// A load that is too heavy, or a mass below zero.
    pub fn figure(&self, human: &Human) -> Result<Human, ModelError> {
        let mut figure = human.clone();
        if let Some(load) = self.load {
            for (body, place, share) in load.place.on(human) {
                if let Some(id) = figure.model.body(body) {
                    figure.model = figure.model.with_point_mass(id, share * load.mass, place)?;
                }
            }
        }
        figure.model = figure.model.on_slope(self.incline());
        Ok(figure)
    }
}

/// Coordinates of the joint with a name: the coordinate itself, or, with a shorter name, flexion, on both sides if the
/// name has none.
fn coordinates_of(model: &Model, joint: &str) -> Result<Vec<String>, OptimalWalkError> {
    let known = || {
        let moving = model.bodies().iter().filter(|body| body.joint.parent.is_some());
        moving.flat_map(|body| body.joint.coordinates()).map(|id| model.coordinates()[id.index()].name.as_str())
    };
    let (side, base) = Side::split_name(joint).map_or((None, joint.to_owned()), |(side, base)| (Some(side), base));
    for ending in ["", "_angle", "_flexion"] {
        let wanted = format!("{base}{ending}");
        let is_it = |name: &&str| match Side::split_name(name) {
            Some((of, base)) => base == wanted && side.is_none_or(|side| side == of),
            None => **name == wanted && side.is_none(),
        };
        let found: Vec<String> = known().filter(is_it).map(str::to_owned).collect();
        if !found.is_empty() {
            return Ok(found);
        }
    }
    let mut names: Vec<String> =
        known().map(|name| Side::split_name(name).map_or(name.to_owned(), |(_, base)| base)).collect();
    names.dedup();
    names.sort();
    names.dedup();
    let expected = format!("one of {}, with _r or _l for one side", listed(names.iter().map(String::as_str)));
    Err(OptimalWalkError::UnknownJoint { found: joint.to_owned(), expected })
}
