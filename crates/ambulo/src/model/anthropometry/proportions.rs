//! A body as shares: of its mass and of its stature.

/// A rigid part: mass as a share of body mass, place and radii of gyration as shares of stature.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lump {
    pub(super) mass: f64,
    /// Mass centre, forward and up from the origin of the frame that the field names.
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
    /// Lumbar joint above mid-hip, where the trunk is split.
    pub(super) lumbar: Option<f64>,
    /// Shoulder centres above mid-hip.
    pub(super) shoulder: f64,
    /// Head without neck.
    pub(super) head: f64,
    pub(super) upper_arm: f64,
    pub(super) forearm: f64,
    /// Wrist to the tip of the middle finger.
    pub(super) hand: f64,
}

/// All that a table says.
#[derive(Debug, Clone)]
pub(super) struct Proportions {
    pub(super) lengths: Lengths,
    /// From the hip, knee, ankle.
    pub(super) thigh: Lump,
    pub(super) shank: Lump,
    pub(super) foot: Lump,
    /// From the shoulder, elbow, wrist.
    pub(super) upper_arm: Lump,
    pub(super) forearm: Lump,
    /// No mass where the forearm's row has it.
    pub(super) hand: Lump,
    /// Below the lumbar joint, from mid-hip; empty if the trunk is not split.
    pub(super) pelvis: Vec<Lump>,
    /// Trunk and head, from mid-hip.
    pub(super) torso: Vec<Lump>,
}

impl Lengths {
    /// Mid-hip above the ground.
    pub(super) fn leg(&self) -> f64 {
        self.thigh + self.shank + self.ankle_height
    }
}

impl Row {
    /// The part hanging from its first end point, or standing on it below `top`, where that point is the upper one.
    pub(super) fn below(&self, top: f64) -> Lump {
        let Row { mass, length, center, radii } = *self;
        Lump { mass, center: [0.0, top - center * length], radii: radii.map(|r| r * length) }
    }
}

impl Proportions {
    /// All shares of mass together: one but for the rounding of printed numbers.
    pub(super) fn mass(&self) -> f64 {
        let limb = [self.thigh, self.shank, self.foot, self.upper_arm, self.forearm, self.hand];
        let trunk = self.pelvis.iter().chain(&self.torso);
        2.0 * limb.iter().map(|lump| lump.mass).sum::<f64>() + trunk.map(|lump| lump.mass).sum::<f64>()
    }
}
