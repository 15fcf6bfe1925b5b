//! Ends of the soles that touch the ground, against the centres of pressure that force plates measured.
//!
//! | claim                                                                      | tolerance       |
//! |----------------------------------------------------------------------------|-----------------|
//! | a foot touches with at least one end while it is loaded, and at no other time | exact         |
//! | while the heel touches alone, the centre of pressure is in the rear 60 % of the foot  | 99 % of frames |
//! | while the toes touch alone, it is in the front 60 %                        | 99 % of frames  |
//! | with the ends of the sole exchanged it is not                              | below 20 %      |

use crate::plug_in_gait::PEOPLE;
use crate::shared_data::data;
use ambulo::analysis::{FootContact, foot_contact};
use ambulo::ground::feet;
use ambulo::kinematics::each_body_motion;
use ambulo::model::anatomy::{Sole, SolePoint};
use ambulo::model::{BySide, Side};
use ambulo::study::Outcome;

/// Vertical force above which a centre of pressure is known to some millimetres [N].
const LOADED_N: f64 = 100.0;
/// Share of the foot in which the centre of pressure is expected.
const PART: f64 = 0.6;

/// Place of the centre of pressure along the foot in each frame: 0 at the heel, 1 at the tip; `None` without a load.
fn places(outcome: &Outcome) -> BySide<Vec<Option<f64>>> {
    let mut found = BySide::from_fn(|_| Vec::new());
    let (model, analysis) = (&outcome.body, outcome.complete());
    let feet = feet(model, &analysis.ground);
    each_body_motion(model, &analysis.trajectory, |frame, bodies| {
        for (side, foot) in &feet {
            let Some(Sole { points: [heel, _, tip], .. }) = outcome.person.soles[*side] else { continue };
            let place = |point: SolePoint| bodies[point.body.index()].pose.place(point.place);
            let along = place(tip) - place(heel);
            let share = (foot.center_of_pressure[frame] - place(heel)).dot(&along) / along.norm_squared();
            found[*side].push((foot.force[frame].y > LOADED_N).then_some(share));
        }
    });
    found
}

/// Shares of the frames with only the heel, and with only the toes on the ground, in which the centre of pressure is
/// under this end; and the number of these frames.
fn agreement(contact: &BySide<Vec<FootContact>>, places: &BySide<Vec<Option<f64>>>) -> [(usize, usize); 2] {
    let mut found = [(0, 0); 2];
    for side in Side::BOTH {
        for (contact, place) in contact[side].iter().zip(&places[side]) {
            let (which, is_under) = match (contact, place) {
                (FootContact { heel: true, toes: false }, Some(place)) => (0, *place < PART),
                (FootContact { heel: false, toes: true }, Some(place)) => (1, *place > 1.0 - PART),
                _ => continue,
            };
            found[which].0 += usize::from(is_under);
            found[which].1 += 1;
        }
    }
    found
}

#[test]
fn the_end_that_touches_alone_is_where_the_plates_measured_the_pressure() {
    let Some(data) = data() else { return };
    let mut all = [[(0, 0); 2]; 2];
    for person in &PEOPLE {
        let (outcome, _) = person.computed(&data);
        let contact = foot_contact(&outcome.body, outcome.complete(), &outcome.person.soles);
        for (side, foot) in feet(&outcome.body, &outcome.complete().ground) {
            for (frame, contact) in contact[side].iter().enumerate() {
                let touches = contact.heel || contact.toes;
                assert_eq!(touches, foot.center_of_pressure[frame].x.is_finite(), "{side}, frame {frame}");
            }
        }
        let places = places(outcome);
        let exchanged = BySide::from_fn(|side| {
            contact[side].iter().map(|own| FootContact { heel: own.toes, toes: own.heel }).collect::<Vec<_>>()
        });
        for (sum, found) in all.iter_mut().zip([agreement(&contact, &places), agreement(&exchanged, &places)]) {
            for (sum, found) in sum.iter_mut().zip(found) {
                *sum = (sum.0 + found.0, sum.1 + found.1);
            }
        }
        println!("{}: heel and toes alone, under this end of all: {:?}", person.name, agreement(&contact, &places));
    }
    let [right, wrong] = all.map(|ends| ends.map(|(under, of)| under as f64 / of as f64));
    println!("shares {right:?}; with the ends exchanged {wrong:?}; frames {all:?}");
    assert!(all[0].iter().all(|(_, of)| *of > 40), "{all:?}");
    assert!(right.iter().all(|share| *share > 0.99), "{right:?}");
    assert!(wrong.iter().all(|share| *share < 0.2), "{wrong:?}");
}
