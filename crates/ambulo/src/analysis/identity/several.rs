//! Several people in one file: prefixes of the marker names that each carry the markers of a pelvis and two legs.
//!
//! `Anna:LASI` and `Ben:LASI` are two people; `R_IAS` and `L_IAS`, or `Anna:LASI` and `Rod:tip`, are one.

use super::super::subject::MarkerTrialError;
use crate::model::Side;
use crate::model::marker_set::{Landmark, MarkerSet, RecognisedMarkers};
use crate::motion::MarkerRecording;
use std::collections::BTreeMap;

/// The separator between the name of a person and the name of a marker.
const SEPARATORS: [char; 6] = [':', '|', '.', '_', '-', ' '];
/// The person whose markers have no prefix, if others have one.
const WITHOUT: &str = "without prefix";
/// Fewest markers of a person: a pelvis and two legs.
const FEWEST: usize = 8;

/// Markers of each person, as numbers and names without the prefix.
type People<'a> = BTreeMap<&'a str, Vec<(usize, &'a str)>>;

/// The people whose markers are in a recording, by the prefixes of the names; empty if there are fewer than two.
pub(crate) fn people_in(markers: &MarkerRecording) -> Vec<String> {
    people(markers).map_or_else(Vec::new, |people| people.into_keys().map(str::to_owned).collect())
}

/// The markers of one person, without the prefix, and those without a prefix; the recording as it is if it does not
/// have several people.
///
/// # Errors
/// A name that no person of the recording has.
pub(crate) fn person_in(markers: MarkerRecording, name: &str) -> Result<MarkerRecording, MarkerTrialError> {
    let Some(people) = people(&markers) else { return Ok(markers) };
    let known = || people.keys().map(|person| (*person).to_owned()).collect();
    let is_it = |person: &&&str| person.trim().eq_ignore_ascii_case(name.trim());
    let Some(chosen) = people.keys().find(is_it) else {
        return Err(MarkerTrialError::NoSuchPerson { found: name.to_owned(), people: known() });
    };
    let own: Vec<(usize, String)> =
        people[*chosen].iter().map(|(number, marker)| (*number, (*marker).to_owned())).collect();
    let paths = own.iter().map(|(number, marker)| {
        let mut path = markers.markers[*number].clone();
        path.name.clone_from(marker);
        path
    });
    Ok(MarkerRecording { markers: paths.collect(), ..markers.clone() })
}

/// An error for a recording of several people.
pub(in crate::analysis) fn refuse_several(markers: &MarkerRecording) -> Result<(), MarkerTrialError> {
    match people_in(markers) {
        people if people.len() < 2 => Ok(()),
        people => Err(MarkerTrialError::SeveralPeople { recording: markers.name.clone(), people }),
    }
}

/// The people of a recording, if there are several.
fn people(markers: &MarkerRecording) -> Option<People<'_>> {
    SEPARATORS.into_iter().find_map(|separator| people_by(markers, separator))
}

fn people_by(markers: &MarkerRecording, separator: char) -> Option<People<'_>> {
    let mut people = People::new();
    for (number, path) in markers.markers.iter().enumerate() {
        let (person, marker) = path.name.split_once(separator).unwrap_or((WITHOUT, &path.name));
        people.entry(person).or_default().push((number, marker.trim()));
    }
    people.retain(|_, own| own.len() >= FEWEST);
    if people.len() < 2 {
        return None;
    }
    people.retain(|_, own| is_person(own));
    (people.len() > 1).then_some(people)
}

/// Whether these are the markers of a pelvis and two legs.
fn is_person(own: &[(usize, &str)]) -> bool {
    use Landmark as L;
    let Ok(recognised) = MarkerSet::recognise(own.iter().map(|(_, name)| *name)) else { return false };
    let has = |landmarks: &[Landmark]| has_both(&recognised, landmarks);
    has(&[L::Asis, L::HipCentre])
        && has(&[L::LateralEpicondyle, L::KneeCentre])
        && has(&[L::LateralMalleolus, L::AnkleCentre])
}

fn has_both(recognised: &RecognisedMarkers, landmarks: &[Landmark]) -> bool {
    let has = |side: Side| landmarks.iter().any(|landmark| recognised.on(*landmark, Some(side)).is_some());
    Side::BOTH.into_iter().all(has)
}
