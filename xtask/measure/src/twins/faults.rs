//! The faults of laboratories, and what names them.

use super::changes::{
    Way, along_limb, clock, corners, corners_of_one, cross_talk, delayed, drawn, exchanged, frozen, held, left_handed,
    mirrored_force, moved, one_scaled, other_stands, pair, plate_silent, plates_moved, plates_turned, scaled,
    shear_scaled, two_people, without,
};
use super::spoiled::Trial;

/// A way to spoil a recording; `None` if it does not apply to it.
pub(super) struct Fault {
    pub(super) name: &'static str,
    /// Any of these names it: codes of findings, or words of the error that refuses the file.
    pub(super) codes: &'static [&'static str],
    pub(super) spoil: fn(&mut Trial) -> Option<()>,
}

/// All kinds of faults.
pub(super) const FAULTS: &[Fault] = &[
    Fault { name: "a plate measured nothing", codes: &["plates.silent"], spoil: |t| plate_silent(t) },
    Fault { name: "cross-talk of 4 %", codes: &["plates.cross_talk"], spoil: |t| cross_talk(t, 0.04) },
    Fault { name: "cross-talk of 8 %", codes: &["plates.cross_talk"], spoil: |t| cross_talk(t, 0.08) },
    Fault { name: "plates 30 ms late", codes: &["forces.delayed"], spoil: |t| delayed(t, 0.030) },
    Fault { name: "plates 30 ms early", codes: &["forces.delayed"], spoil: |t| delayed(t, -0.030) },
    Fault { name: "plates 60 ms late", codes: &["forces.delayed"], spoil: |t| delayed(t, 0.060) },
    Fault { name: "plates 100 ms early", codes: &["forces.delayed"], spoil: |t| delayed(t, -0.100) },
    Fault { name: "every second frame held", codes: HELD, spoil: |t| held(t, |frame| frame - frame % 2) },
    Fault { name: "20 Hz held as 100 Hz", codes: HELD, spoil: |t| held(t, |frame| frame - frame % 5) },
    Fault {
        name: "every third frame held",
        codes: HELD,
        spoil: |t| held(t, |frame| frame - usize::from(frame % 3 == 1)),
    },
    Fault { name: "second half frozen", codes: HELD, spoil: |t| frozen(t) },
    Fault { name: "clock 1.6 times as fast", codes: CLOCK, spoil: |t| clock(t, 1.6) },
    Fault { name: "clock 0.6 times as fast", codes: CLOCK, spoil: |t| clock(t, 0.6) },
    Fault { name: "clock 1.25 times as fast", codes: CLOCK, spoil: |t| clock(t, 1.25) },
    Fault { name: "clock 0.8 times as fast", codes: CLOCK, spoil: |t| clock(t, 0.8) },
    Fault { name: "corners begin one further", codes: CORNERS, spoil: |t| corners(t, |[a, b, c, d]| [b, c, d, a]) },
    Fault { name: "corners begin two further", codes: CORNERS, spoil: |t| corners(t, |[a, b, c, d]| [c, d, a, b]) },
    Fault { name: "corners the other way round", codes: CORNERS, spoil: |t| corners(t, |[a, b, c, d]| [d, c, b, a]) },
    Fault { name: "corners begin three further", codes: CORNERS, spoil: |t| corners(t, |[a, b, c, d]| [d, a, b, c]) },
    Fault { name: "corners round the other way", codes: CORNERS, spoil: |t| corners(t, |[a, b, c, d]| [a, d, c, b]) },
    Fault {
        name: "corners of one begin two further",
        codes: CORNERS,
        spoil: |t| corners_of_one(t, |[a, b, c, d]| [c, d, a, b]),
    },
    Fault { name: "plates 60 mm sideways", codes: &["plates.misplaced"], spoil: |t| plates_moved(t, false, 60.0) },
    Fault { name: "plates 100 mm forward", codes: NOT_GOOD, spoil: |t| plates_moved(t, true, 100.0) },
    Fault { name: "forces in kilonewton", codes: UNIT, spoil: |t| scaled(t, 1e-3) },
    Fault { name: "forces in body weights of 70 kg", codes: UNIT, spoil: |t| scaled(t, 1.0 / 686.5) },
    Fault { name: "forces with the other sign", codes: &["plates.force_on_plate"], spoil: |t| scaled(t, -1.0) },
    Fault { name: "lateral forces mirrored", codes: MIRRORED, spoil: |t| mirrored_force(t, false) },
    Fault { name: "fore-aft forces mirrored", codes: MIRRORED, spoil: |t| mirrored_force(t, true) },
    Fault { name: "horizontal forces doubled", codes: SHEAR, spoil: |t| shear_scaled(t, 2.0) },
    Fault { name: "horizontal forces halved", codes: SHEAR, spoil: |t| shear_scaled(t, 0.5) },
    Fault { name: "a plate 1.25 times as strong", codes: &["plates.unequal"], spoil: |t| one_scaled(t, 1.25) },
    Fault { name: "a plate 0.8 times as strong", codes: &["plates.unequal"], spoil: |t| one_scaled(t, 0.8) },
    Fault { name: "plates turned by 20 deg", codes: SKEWED, spoil: |t| plates_turned(t, 20.0) },
    Fault { name: "plates turned by -30 deg", codes: SKEWED, spoil: |t| plates_turned(t, -30.0) },
    Fault { name: "left and right exchanged", codes: SIDES, spoil: |t| exchanged(&mut t.moving) },
    Fault { name: "standing trial exchanged", codes: SIDES, spoil: |t| exchanged(t.standing.as_mut()?) },
    Fault {
        name: "both exchanged",
        codes: SIDES,
        spoil: |t| {
            exchanged(&mut t.moving)?;
            exchanged(t.standing.as_mut()?)
        },
    },
    Fault { name: "an axis mirrored", codes: SIDES, spoil: |t| left_handed(t) },
    Fault { name: "knee and thigh exchanged", codes: PAIR, spoil: |t| along_limb(&mut t.moving, &KNEE_AND_THIGH) },
    Fault {
        name: "standing trial's knee and thigh exchanged",
        codes: PAIR,
        spoil: |t| along_limb(t.standing.as_mut()?, &KNEE_AND_THIGH),
    },
    Fault {
        name: "standing trial's ankle and shank exchanged",
        codes: PAIR,
        spoil: |t| along_limb(t.standing.as_mut()?, &ANKLE_AND_SHANK),
    },
    Fault { name: "knees exchanged", codes: PAIR, spoil: |t| pair(t, &["LKNE", "L_FLE"]) },
    Fault { name: "wrists exchanged", codes: PAIR, spoil: |t| pair(t, &["LWRA", "L_RSP"]) },
    Fault { name: "ankles exchanged", codes: PAIR, spoil: |t| pair(t, &["LANK", "L_FAL"]) },
    Fault { name: "heels exchanged", codes: PAIR, spoil: |t| pair(t, &["LHEE", "L_FCC"]) },
    Fault { name: "toes exchanged", codes: PAIR, spoil: |t| pair(t, &["LTOE", "L_FM2", "LMT2"]) },
    Fault { name: "fronts of pelvis exchanged", codes: PAIR, spoil: |t| pair(t, &["LASI", "L_IAS"]) },
    Fault { name: "backs of pelvis exchanged", codes: PAIR, spoil: |t| pair(t, &["LPSI", "L_IPS"]) },
    Fault { name: "elbows exchanged", codes: PAIR, spoil: |t| pair(t, &["LELB", "L_HLE"]) },
    Fault { name: "shoulders exchanged", codes: PAIR, spoil: |t| pair(t, &["LSHO", "L_SAE", "L_SIA"]) },
    Fault { name: "knee 40 mm higher", codes: MOVED, spoil: |t| moved(t, KNEES, Way::AwayFrom(ANKLES), 40.0) },
    Fault { name: "knee 40 mm lower", codes: MOVED, spoil: |t| moved(t, KNEES, Way::AwayFrom(ANKLES), -40.0) },
    Fault { name: "knee 40 mm forward", codes: MOVED, spoil: |t| moved(t, KNEES, Way::Forward, 40.0) },
    Fault { name: "knee 40 mm backward", codes: MOVED, spoil: |t| moved(t, KNEES, Way::Backward, 40.0) },
    Fault { name: "ankle 40 mm higher", codes: MOVED, spoil: |t| moved(t, ANKLES, Way::AwayFrom(KNEES), -40.0) },
    Fault { name: "ankle 40 mm forward", codes: MOVED, spoil: |t| moved(t, ANKLES, Way::Forward, 40.0) },
    Fault { name: "toe 40 mm backward", codes: MOVED, spoil: |t| moved(t, TOES, Way::Backward, 40.0) },
    Fault { name: "front of pelvis 50 mm up", codes: MOVED, spoil: |t| moved(t, FRONTS, Way::AwayFrom(KNEES), 50.0) },
    Fault { name: "a knee on a line", codes: DRAWN, spoil: |t| drawn(&mut t.moving, KNEES) },
    Fault { name: "an ankle on a line", codes: DRAWN, spoil: |t| drawn(&mut t.moving, ANKLES) },
    Fault { name: "another person stands", codes: OTHER, spoil: |t| other_stands(t) },
    Fault { name: "two people in the file", codes: SEVERAL, spoil: |t| two_people(t) },
    Fault { name: "standing without a toe", codes: UNSEEN, spoil: |t| without(t.standing.as_mut()?, TOES) },
    Fault { name: "standing without a heel", codes: UNSEEN, spoil: |t| without(t.standing.as_mut()?, HEELS) },
    Fault { name: "standing without a knee", codes: UNSEEN, spoil: |t| without(t.standing.as_mut()?, KNEES) },
    Fault { name: "standing without an ankle", codes: UNSEEN, spoil: |t| without(t.standing.as_mut()?, ANKLES) },
    Fault { name: "standing without a front", codes: UNSEEN, spoil: |t| without(t.standing.as_mut()?, FRONTS) },
];

/// The quality of the data is doubtful or bad, for whichever reason.
pub(super) const NOT_GOOD: &[&str] = &["not good"];
/// The file is refused with these words.
const SEVERAL: &[&str] = &["has the markers of 2 people"];
const HELD: &[&str] = &["motion.held_frames"];
const CLOCK: &[&str] = &["motion.clock"];
const CORNERS: &[&str] = &["plates.corners_ordered", "plates.corners_unclear"];
const UNIT: &[&str] = &["plates.unit_by_weight"];
const MIRRORED: &[&str] = &["plates.mirrored"];
const SHEAR: &[&str] = &["plates.shear_gain"];
const SKEWED: &[&str] = &["plates.skewed"];
const SIDES: &[&str] = &["markers.sides_exchanged"];
const PAIR: &[&str] = &["markers.swap"];
const DRAWN: &[&str] = &["markers.drawn"];
const MOVED: &[&str] = &["markers.moved"];
const OTHER: &[&str] = &["calibration.other_person", "calibration.other_limbs"];
const UNSEEN: &[&str] = &["calibration.placed", "markers.not_measured"];
pub(super) const TOES: &[&str] = &["RTOE", "R_FM2", "RMT2", "R_FM1"];
const KNEES: &[&str] = &["RKNE", "R_FLE"];
const ANKLES: &[&str] = &["RANK", "R_FAL"];
const KNEE_AND_THIGH: [[&str; 2]; 2] = [["LKNE", "LTHI"], ["L_FLE", "L_FTC"]];
const ANKLE_AND_SHANK: [[&str; 2]; 2] = [["LANK", "LTIB"], ["L_FAL", "L_FAX"]];
const FRONTS: &[&str] = &["RASI", "R_IAS"];
pub(super) const HEELS: &[&str] = &["RHEE", "R_FCC", "RHEEL"];
