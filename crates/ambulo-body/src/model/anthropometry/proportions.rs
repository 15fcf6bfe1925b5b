//! Proportions of a body: segment masses as shares of body mass, lengths as shares of stature.

/// A rigid part: mass as a share of body mass, position and radii of gyration as shares of stature.
#[derive(Debug, Clone, Copy)]
pub(super) struct RigidPart {
    pub(super) mass: f64,
    /// Mass centre: forward and up, relative to the proximal joint (trunk: mid-hip).
    pub(super) center: [f64; 2],
    /// Radii of gyration about the mass centre: about x, y, z.
    pub(super) radii: [f64; 3],
}

/// A row of a table: shares of body mass and of the segment's own length.
#[derive(Debug, Clone, Copy)]
pub(super) struct Row {
    /// Share of body mass.
    pub(super) mass: f64,
    /// Length as a share of stature.
    pub(super) length: f64,
    /// Mass centre from the first end point, share of the length.
    pub(super) center: f64,
    /// Radii of gyration about the sagittal (x), longitudinal (y) and transverse (z) axis of the upright body, shares
    /// of the length.
    pub(super) radii: [f64; 3],
}

/// Lengths as shares of stature.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lengths {
    pub(super) thigh: f64,
    pub(super) shank: f64,
    pub(super) ankle_height: f64,
    pub(super) foot: f64,
    /// Lumbar joint above mid-hip; `None` for an undivided trunk.
    pub(super) lumbar: Option<f64>,
    /// Shoulder centres above mid-hip.
    pub(super) shoulder: f64,
    /// Head without neck.
    pub(super) head: f64,
    /// Head and neck: vertex to the joint between neck and trunk.
    pub(super) head_and_neck: f64,
    pub(super) upper_arm: f64,
    pub(super) forearm: f64,
    /// Wrist to the tip of the middle finger.
    pub(super) hand: f64,
}

/// The proportions of a segment table.
#[derive(Debug, Clone)]
pub(super) struct Proportions {
    pub(super) lengths: Lengths,
    /// Relative to hip, knee and ankle.
    pub(super) thigh: RigidPart,
    pub(super) shank: RigidPart,
    pub(super) foot: RigidPart,
    /// Relative to shoulder, elbow and wrist.
    pub(super) upper_arm: RigidPart,
    pub(super) forearm: RigidPart,
    /// Without mass if it is included in the forearm.
    pub(super) hand: RigidPart,
    /// Parts below the lumbar joint, relative to mid-hip; empty for an undivided trunk.
    pub(super) pelvis: Vec<RigidPart>,
    /// Trunk, and last the head, relative to mid-hip.
    pub(super) torso: Vec<RigidPart>,
}

impl Lengths {
    /// Mid-hip above the ground.
    pub(super) fn leg(&self) -> f64 {
        self.thigh + self.shank + self.ankle_height
    }
}

impl Row {
    /// The segment with its upper end point at `top`.
    pub(super) fn below(&self, top: f64) -> RigidPart {
        let Row { mass, length, center, radii } = *self;
        RigidPart { mass, center: [0.0, top - center * length], radii: radii.map(|r| r * length) }
    }
}

impl Proportions {
    /// Sum of all shares of mass: one, up to the rounding of printed numbers.
    pub(super) fn mass(&self) -> f64 {
        let limb = [self.thigh, self.shank, self.foot, self.upper_arm, self.forearm, self.hand];
        let trunk = self.pelvis.iter().chain(&self.torso);
        2.0 * limb.iter().map(|part| part.mass).sum::<f64>() + trunk.map(|part| part.mass).sum::<f64>()
    }
}
