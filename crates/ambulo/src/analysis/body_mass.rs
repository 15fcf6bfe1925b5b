//! Which body mass is believed: the one that was stated, or what plates carried while the person stood.

use crate::findings::{Code, Findings};

/// Masses that differ by less, as a share, are one person's: clothes and shoes, a scale at home, a plate's calibration.
const SAME_PERSON: f64 = 0.05;

/// Body mass [kg]. A standing trial on plates weighs the person as recorded, with clothes and shoes, and on the scale that the ground
/// forces are held against: it is believed before a stated mass, unless they differ too much for one person. Then somebody stood beside
/// the plates or the statement is of another day, and what was stated is used. `None` if neither is known.
#[must_use]
pub fn body_mass(stated_kg: Option<f64>, standing_kg: Option<f64>, findings: &mut Findings) -> Option<f64> {
    match (stated_kg, standing_kg) {
        (Some(stated), Some(standing)) if (standing / stated - 1.0).abs() <= SAME_PERSON => {
            let message = format!(
                "{standing:.2} kg stand on the plates in the standing trial and were used; {stated:.2} kg are stated"
            );
            findings.report(Code::MassStanding, message);
            Some(standing)
        }
        (Some(stated), Some(standing)) => {
            let message = format!(
                "the stated mass is {stated:.1} kg, force plates measured {standing:.1} kg in the standing trial; the stated mass was used"
            );
            findings.report(Code::MassStandingMismatch, message);
            Some(stated)
        }
        (Some(stated), None) => Some(stated),
        (None, Some(standing)) => {
            let message = format!("no mass is stated; {standing:.1} kg stand on the plates in the standing trial");
            findings.report(Code::MassStanding, message);
            Some(standing)
        }
        (None, None) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn believed(stated: Option<f64>, standing: Option<f64>) -> (Option<f64>, Findings) {
        let mut findings = Findings::default();
        (body_mass(stated, standing, &mut findings), findings)
    }

    #[test]
    fn the_plates_are_believed_where_they_weigh_the_same_person() {
        let (mass, findings) = believed(Some(32.1), Some(31.07));
        assert!(mass == Some(31.07) && findings.has(Code::MassStanding));
        assert_eq!(believed(None, Some(60.0)).0, Some(60.0));
    }

    #[test]
    fn a_person_beside_the_plates_is_not_weighed_by_them() {
        let (mass, findings) = believed(Some(60.0), Some(41.0));
        assert!(mass == Some(60.0) && findings.has(Code::MassStandingMismatch));
        assert!(believed(Some(60.0), None).1.as_slice().is_empty());
        assert_eq!(believed(None, None).0, None);
    }
}
