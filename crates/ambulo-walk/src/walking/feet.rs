//! Records of the ground reaction on each foot.

use crate::engine::ContactForce;
use crate::model::BodyId;
use crate::motion::ForceRecording;
use crate::spatial::Vec3;

/// Ground reaction on one foot, one entry per row.
#[derive(Debug, Clone, PartialEq)]
pub struct FootRecord {
    /// The body that carries the heel.
    pub body: BodyId,
    /// Force on the foot [N].
    pub force: Vec<Vec3>,
    /// Moment about the world's origin [N.m].
    pub moment: Vec<Vec3>,
    /// Centre of pressure [m]; zero without load.
    pub point: Vec<Vec3>,
    /// Forward velocity of the most loaded point of the sole relative to the ground [m/s]; zero without load.
    pub slip: Vec<f64>,
    /// Whether a loaded point of the sole is at the friction limit of the ground. Not meaningful for Hunt and
    /// Crossley's law, which has its own friction.
    pub at_limit: Vec<bool>,
    /// The part of the reaction that acts on the toes, if they are a separate body.
    pub(crate) toes: Option<ToeRecord>,
    /// Largest load of a point in the row that is being filled, and the sum of all [N].
    heaviest: f64,
    pressing: f64,
}

/// Ground reaction on the toes of one foot, one entry per row.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ToeRecord {
    /// The body of the toes.
    pub body: BodyId,
    /// Force on the toes [N].
    pub force: Vec<Vec3>,
    /// Moment about the world's origin [N.m].
    pub moment: Vec<Vec3>,
}

/// A point is at the friction limit if it uses this share of the available friction.
const LIMIT_SHARE: f64 = 1.0 - 1e-6;

impl FootRecord {
    pub(crate) fn new(body: BodyId, toes: Option<BodyId>, rows: usize) -> FootRecord {
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
            pressing: 0.0,
        }
    }

    /// Begins a row without load.
    pub(crate) fn begin_row(&mut self) {
        self.force.push(Vec3::zeros());
        self.moment.push(Vec3::zeros());
        self.point.push(Vec3::zeros());
        self.slip.push(0.0);
        self.at_limit.push(false);
        (self.heaviest, self.pressing) = (0.0, 0.0);
        if let Some(toes) = &mut self.toes {
            toes.force.push(Vec3::zeros());
            toes.moment.push(Vec3::zeros());
        }
    }

    /// Adds a contact point of a body to the row. The centre of pressure is a weighted sum until the row ends.
    pub(crate) fn add(&mut self, contact: &ContactForce, body: BodyId, friction: f64) {
        let (Some(force), Some(point)) = (self.force.last_mut(), self.point.last_mut()) else { return };
        let pressing = contact.normal_force;
        if pressing <= 0.0 {
            return;
        }
        *force += contact.force;
        *point += contact.point * pressing;
        self.pressing += pressing;
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

    /// Ends a row: turns the sum into the centre of pressure.
    pub(crate) fn end_row(&mut self) {
        if let Some(point) = self.point.last_mut() {
            *point = if self.pressing > 0.0 { *point / self.pressing } else { Vec3::zeros() };
        }
    }

    /// Whether the foot is loaded in a row.
    #[must_use]
    pub fn loaded(&self, row: usize) -> bool {
        self.force[row].y > 0.0
    }

    /// The reaction as a force plate would record it. The free moment is zero because contact points transmit no
    /// moment.
    #[must_use]
    pub(crate) fn as_recording(&self, name: &str, times: Vec<f64>) -> ForceRecording {
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
