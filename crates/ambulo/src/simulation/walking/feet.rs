//! What a foot and the ground do to each other.

use crate::model::BodyId;
use crate::motion::ForceRecording;
use crate::simulation::ContactForce;
use crate::spatial::Vec3;

/// What the ground does to one foot, one entry a row.
#[derive(Debug, Clone, PartialEq)]
pub struct FootRecord {
    /// The body that carries the heel.
    pub body: BodyId,
    /// Force on the foot [N].
    pub force: Vec<Vec3>,
    /// Its moment about the world's origin [N.m].
    pub moment: Vec<Vec3>,
    /// Centre of pressure [m]; zero where nothing presses.
    pub point: Vec<Vec3>,
    /// Forward velocity of the most loaded point of the sole against the ground [m/s]; zero where nothing presses.
    pub slip: Vec<f64>,
    /// Whether a loaded point of the sole is at the limit of the ground's friction; of no meaning under Hunt and Crossley's shoes,
    /// whose friction is a law of its own.
    pub at_limit: Vec<bool>,
    /// The part of it that another body of the foot feels, the toes.
    pub toes: Option<ToeRecord>,
    /// Most loaded point in a row, while it is filled [N].
    heaviest: f64,
}

/// What the ground does to the toes of one foot, one entry a row.
#[derive(Debug, Clone, PartialEq)]
pub struct ToeRecord {
    /// The toes.
    pub body: BodyId,
    /// Force on them [N].
    pub force: Vec<Vec3>,
    /// Its moment about the world's origin [N.m].
    pub moment: Vec<Vec3>,
}

/// A point rubs at the limit of friction where this share of it is used.
const LIMIT_SHARE: f64 = 1.0 - 1e-6;

impl FootRecord {
    pub(in crate::simulation) fn new(body: BodyId, toes: Option<BodyId>, rows: usize) -> FootRecord {
        FootRecord {
            body,
            force: Vec::with_capacity(rows),
            moment: Vec::with_capacity(rows),
            point: Vec::with_capacity(rows),
            slip: Vec::with_capacity(rows),
            at_limit: Vec::with_capacity(rows),
            toes: toes.map(|body| ToeRecord {
                body,
                force: Vec::with_capacity(rows),
                moment: Vec::with_capacity(rows),
            }),
            heaviest: 0.0,
        }
    }

    /// Begins a row in which nothing presses yet.
    pub(in crate::simulation) fn begin_row(&mut self) {
        self.force.push(Vec3::zeros());
        self.moment.push(Vec3::zeros());
        self.point.push(Vec3::zeros());
        self.slip.push(0.0);
        self.at_limit.push(false);
        self.heaviest = 0.0;
        if let Some(toes) = &mut self.toes {
            toes.force.push(Vec3::zeros());
            toes.moment.push(Vec3::zeros());
        }
    }

    /// Adds a point of contact of a body to the row; the centre of pressure is a sum until the row ends.
    pub(in crate::simulation) fn add(&mut self, contact: &ContactForce, body: BodyId, friction: f64) {
        let (Some(force), Some(point)) = (self.force.last_mut(), self.point.last_mut()) else { return };
        let pressing = contact.normal_force;
        if pressing <= 0.0 {
            return;
        }
        *force += contact.force;
        *point += contact.point * pressing;
        let about_origin = contact.point.cross(&contact.force);
        if let Some(moment) = self.moment.last_mut() {
            *moment += about_origin;
        }
        if let Some(toes) = self.toes.as_mut().filter(|toes| toes.body == body)
            && let (Some(force), Some(moment)) = (toes.force.last_mut(), toes.moment.last_mut())
        {
            *force += contact.force;
            *moment += about_origin;
        }
        let across = (contact.force - contact.normal * pressing).norm();
        if let Some(at_limit) = self.at_limit.last_mut() {
            *at_limit |= across >= LIMIT_SHARE * friction * pressing;
        }
        if let (Some(slip), true) = (self.slip.last_mut(), pressing > self.heaviest) {
            (*slip, self.heaviest) = (contact.slip.x, pressing);
        }
    }

    pub(in crate::simulation) fn end_row(&mut self) {
        if let (Some(force), Some(point)) = (self.force.last(), self.point.last_mut()) {
            *point = if force.y > 0.0 { *point / force.y } else { Vec3::zeros() };
        }
    }

    /// Whether the ground presses in a row.
    #[must_use]
    pub fn loaded(&self, row: usize) -> bool {
        self.force[row].y > 0.0
    }

    /// The same as a force plate would have it; the moment about the centre of pressure is zero, since points do not twist.
    #[must_use]
    pub fn as_recording(&self, name: &str, times: Vec<f64>) -> ForceRecording {
        let rows = self.force.len();
        let nowhere = Vec3::repeat(f64::NAN);
        let point = (0..rows).map(|row| if self.loaded(row) { self.point[row] } else { nowhere });
        ForceRecording {
            name: name.to_owned(),
            body: self.body,
            force_frame: None,
            point_frame: None,
            times,
            force: self.force.clone(),
            point: point.collect(),
            moment: vec![Vec3::zeros(); rows],
        }
    }
}
