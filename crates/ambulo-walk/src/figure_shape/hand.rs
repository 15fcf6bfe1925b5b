//! Forearms with hands, and hands.
//!
//! A hand is a flat palm, four fingers and a thumb. Its length is that of a person of this stature (de Leva's table);
//! everything else is a share of this length, chosen by eye from the outline of a hand whose breadth is 0.44 of its
//! length. It continues the line from the elbow, or from the wrist to its mass centre, with the thumb in front, as arms
//! hang beside the body.

use super::BodySolid;
use super::joint_places::JointPlaces;
use super::limb::{flesh, radius};
use super::part::Part;
use crate::model::anthropometry::Dimensions;
use crate::model::{BodyId, Side};
use crate::spatial::Vec3;

/// Half of the thickness of palm, fingers and thumb.
const PALM: f64 = 0.075;
const FINGER: f64 = 0.048;
const THUMB: f64 = 0.055;
/// Distance of the edges of the palm from its middle, and where it begins and ends.
const EDGE: f64 = 0.135;
const PALM_ENDS: [f64; 2] = [0.08, 0.48];
/// Place of each finger across the palm and its end along the hand, from the forefinger on.
const FINGERS: [[f64; 2]; 4] = [[0.155, 0.88], [0.053, 0.95], [-0.053, 0.9], [-0.155, 0.76]];
/// The ends of the thumb: along the hand and across.
const THUMB_ENDS: [[f64; 2]; 2] = [[0.12, 0.13], [0.5, 0.29]];

/// Shapes of a hand that is a separate body.
pub(super) fn hand(places: &JointPlaces<'_>, body: BodyId, size: &Dimensions) -> Vec<BodySolid> {
    let wrist = places.own(body);
    let along = (places.mass_center(body) - wrist).try_normalize(1e-6).unwrap_or_else(|| -places.up(body));
    palm_and_fingers(places, body, wrist, along * size.hand)
}

/// Shapes of a forearm that includes the hand.
pub(super) fn forearm(places: &JointPlaces<'_>, body: BodyId, stature: f64, size: &Dimensions) -> Vec<BodySolid> {
    let elbow = places.own(body);
    let along = (places.mass_center(body) - elbow).try_normalize(1e-6).unwrap_or_else(|| -places.up(body));
    let wrist = elbow + along * size.forearm;
    let thick = radius(size.forearm + size.hand, places.mass(body));
    let mut shapes = flesh(elbow, wrist, thick, stature);
    shapes.extend(palm_and_fingers(places, body, wrist, along * size.hand));
    shapes
}

/// A hand from the wrist to the tip of the middle finger.
fn palm_and_fingers(places: &JointPlaces<'_>, body: BodyId, wrist: Vec3, hand: Vec3) -> Vec<BodySolid> {
    let length = hand.norm();
    let forward = forward(places, body);
    let across = forward - hand * (forward.dot(&hand) / hand.norm_squared());
    // A hand that points forward is seen from above.
    let across = across.try_normalize(0.1).unwrap_or_else(|| places.up(body)) * length;
    let at = |along: f64, aside: f64| wrist + hand * along + across * aside;
    let [base, knuckles] = PALM_ENDS;
    let bone = |from: Vec3, to: Vec3, thick: f64| BodySolid::capsule(from, to, thick * length);
    let mut shapes: Vec<BodySolid> =
        [EDGE, 0.0, -EDGE].map(|aside| bone(at(base, 0.7 * aside), at(knuckles, aside), PALM)).to_vec();
    shapes.extend(FINGERS.map(|[aside, tip]| bone(at(knuckles, aside), at(tip, aside), FINGER)));
    let [root, tip] = THUMB_ENDS.map(|[along, aside]| at(along, aside));
    shapes.push(bone(root, tip, THUMB));
    shapes
}

/// Unit vector forward in the frame of a body at rest: perpendicular to the line from hip to hip.
fn forward(places: &JointPlaces<'_>, body: BodyId) -> Vec3 {
    let hip = |side| places.find(Part::Thigh, Some(side)).map(|thigh| places.joint_of(thigh, body));
    let right = hip(Side::Right).zip(hip(Side::Left)).map(|(right, left)| right - left);
    let ahead = right.and_then(|right| places.up(body).cross(&right).try_normalize(1e-6));
    ahead.unwrap_or_else(|| places.seen_from(body, Vec3::x()) - places.seen_from(body, Vec3::zeros()))
}
