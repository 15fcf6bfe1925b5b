//! Men and women of de Leva 1996.
//!
//! De Leva, "Adjustments to Zatsiorsky-Seluyanov's segment inertia parameters", J Biomech 29:1223-1230, 1996, table 4.
//! Masses, mass centres and radii as transcribed in BMClab/BMC (`data/BSPmale_ZdeLeva.txt`, `BSPfemale_ZdeLeva.txt`),
//! mean lengths as transcribed in R. Gurchiek's `deleva.m`; both were read, and agree where both have a value. The
//! trunk is measured from suprasternale, the head from vertex to mid-gonion; the neck between them closes the stature
//! and has no mass of its own (it is in the head's and the upper trunk's).
//! Head and neck reach from the vertex to the cervicale (C7), from which the same table measures the same segment
//! (unverified): with its 50.02 % (women 48.41 %) the mass centre is where the row of the mid-gonion has it, 121.5 mm
//! (118.0 mm) below the vertex.
//! The foot's longitudinal axis runs from heel to toe; its sagittal axis (of a pointed foot) is then the vertical.

use super::dimensions::{ANKLE_HEIGHT, HEEL_TO_ANKLE};
use super::proportions::{Lengths, Proportions, RigidPart, Row};

/// The rows of one sex. Radii: sagittal, longitudinal, transverse.
#[derive(Debug)]
pub(super) struct Sample {
    /// Mean stature of the sample [m].
    stature: f64,
    head: MeanRow,
    upper_trunk: MeanRow,
    middle_trunk: MeanRow,
    lower_trunk: MeanRow,
    upper_arm: MeanRow,
    forearm: MeanRow,
    hand: MeanRow,
    thigh: MeanRow,
    shank: MeanRow,
    foot: MeanRow,
    /// Midpoint of the shoulders to midpoint of the hips [m].
    shoulder_to_hip: f64,
    /// Wrist to the tip of the middle finger [m].
    hand_to_fingertip: f64,
    /// Vertex to cervicale [m].
    head_and_neck: f64,
}

/// A row as printed: mass [%], length [m], mass centre [% of length], radii of gyration [% of length].
#[derive(Debug)]
struct MeanRow(f64, f64, f64, [f64; 3]);

pub(super) const MALE: Sample = Sample {
    stature: 1.741,
    head: MeanRow(6.94, 0.2033, 59.76, [36.2, 31.2, 37.6]),
    upper_trunk: MeanRow(15.96, 0.1707, 29.99, [71.6, 65.9, 45.4]),
    middle_trunk: MeanRow(16.33, 0.2155, 45.02, [48.2, 46.8, 38.3]),
    lower_trunk: MeanRow(11.17, 0.1457, 61.15, [61.5, 58.7, 55.1]),
    upper_arm: MeanRow(2.71, 0.2817, 57.72, [28.5, 15.8, 26.9]),
    forearm: MeanRow(1.62, 0.2689, 45.74, [27.6, 12.1, 26.5]),
    hand: MeanRow(0.61, 0.0862, 79.00, [62.8, 40.1, 51.3]),
    thigh: MeanRow(14.16, 0.4222, 40.95, [32.9, 14.9, 32.9]),
    shank: MeanRow(4.33, 0.4403, 43.95, [25.1, 10.2, 24.6]),
    foot: MeanRow(1.37, 0.2581, 44.15, [25.7, 12.4, 24.5]),
    shoulder_to_hip: 0.5155,
    hand_to_fingertip: 0.1879,
    head_and_neck: 0.2429,
};

/// The hand's sagittal radius is 53.1 in the transcriptions read, 63.1 in a vendor's copy; it has no effect on planar
/// motion.
pub(super) const FEMALE: Sample = Sample {
    stature: 1.735,
    head: MeanRow(6.68, 0.2002, 58.94, [33.0, 31.8, 35.9]),
    upper_trunk: MeanRow(15.45, 0.1425, 20.77, [74.6, 71.8, 50.2]),
    middle_trunk: MeanRow(14.65, 0.2053, 45.12, [43.3, 41.5, 35.4]),
    lower_trunk: MeanRow(12.47, 0.1815, 49.20, [43.3, 44.4, 40.2]),
    upper_arm: MeanRow(2.55, 0.2751, 57.54, [27.8, 14.8, 26.0]),
    forearm: MeanRow(1.38, 0.2643, 45.59, [26.1, 9.4, 25.7]),
    hand: MeanRow(0.56, 0.0780, 74.74, [53.1, 33.5, 45.4]),
    thigh: MeanRow(14.78, 0.3685, 36.12, [36.9, 16.2, 36.4]),
    shank: MeanRow(4.81, 0.4386, 43.52, [26.7, 9.2, 26.3]),
    foot: MeanRow(1.29, 0.2283, 40.14, [29.9, 13.9, 27.9]),
    shoulder_to_hip: 0.4979,
    hand_to_fingertip: 0.1701,
    head_and_neck: 0.2437,
};

impl Sample {
    fn row(&self, MeanRow(mass, length, center, radii): &MeanRow) -> Row {
        let share = |percent: f64| percent / 100.0;
        Row { mass: share(*mass), length: length / self.stature, center: share(*center), radii: radii.map(share) }
    }

    fn lengths(&self) -> Lengths {
        let share = |length: f64| length / self.stature;
        Lengths {
            thigh: share(self.thigh.1),
            shank: share(self.shank.1),
            ankle_height: ANKLE_HEIGHT,
            foot: share(self.foot.1),
            lumbar: Some(share(self.lower_trunk.1)),
            shoulder: share(self.shoulder_to_hip),
            head: share(self.head.1),
            head_and_neck: share(self.head_and_neck),
            upper_arm: share(self.upper_arm.1),
            forearm: share(self.forearm.1),
            hand: share(self.hand_to_fingertip),
        }
    }
}

pub(super) fn proportions(sample: &Sample) -> Proportions {
    let lengths = sample.lengths();
    let hanging = |row: &MeanRow| sample.row(row).below(0.0);
    let [lower, middle, upper] =
        [&sample.lower_trunk, &sample.middle_trunk, &sample.upper_trunk].map(|r| sample.row(r));
    let omphalion = lower.length;
    let xiphion = omphalion + middle.length;
    let suprasternale = xiphion + upper.length;
    Proportions {
        lengths,
        thigh: hanging(&sample.thigh),
        shank: hanging(&sample.shank),
        foot: foot(&sample.row(&sample.foot)),
        upper_arm: hanging(&sample.upper_arm),
        forearm: hanging(&sample.forearm),
        hand: hanging(&sample.hand),
        pelvis: vec![lower.below(omphalion)],
        torso: vec![
            middle.below(xiphion),
            upper.below(suprasternale),
            sample.row(&sample.head).below(1.0 - lengths.leg()),
        ],
    }
}

/// The foot is horizontal: its longitudinal axis is x. Its mass centre is assumed at half the height of the ankle.
fn foot(row: &Row) -> RigidPart {
    let [sagittal, longitudinal, transverse] = row.radii.map(|r| r * row.length);
    RigidPart {
        mass: row.mass,
        center: [(row.center - HEEL_TO_ANKLE) * row.length, -0.5 * ANKLE_HEIGHT],
        radii: [longitudinal, sagittal, transverse],
    }
}
