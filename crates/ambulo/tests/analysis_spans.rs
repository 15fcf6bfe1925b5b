//! Joins frames beyond a limit to time spans.

use ambulo::analysis::feasibility::{Check, CheckedPart, CheckedValue};
use ambulo::internals::Track;

/// The largest of the smallest shares of `lasting` consecutive frames, and the frame of that smallest share.
fn closest_by_definition(shares: &[(usize, f64)], lasting: usize) -> Option<(usize, f64)> {
    let mut closest: Option<(usize, f64)> = None;
    for window in shares.windows(lasting) {
        let consecutive = window[lasting - 1].0 - window[0].0 + 1 == lasting;
        let smallest = window.iter().copied().min_by(|a, b| a.1.total_cmp(&b.1)).filter(|_| consecutive);
        if let Some(found) = smallest.filter(|found| closest.is_none_or(|closest| found.1 > closest.1)) {
            closest = Some(found);
        }
    }
    closest
}

#[test]
fn the_share_that_lasted_is_that_of_the_definition() {
    // Frames with gaps, shares with equal ones among them.
    let shares: Vec<(usize, f64)> =
        (0..400).filter(|k| k % 37 != 0).map(|k| (k, f64::from((k * k % 101) as u8) / 10.0)).collect();
    for lasting in [1, 2, 3, 7, 20, 36, 37] {
        let mut track = Track::default();
        for &(frame, share) in &shares {
            let of = CheckedPart::Body;
            track.add(frame, CheckedValue { check: Check::Support, of, value: share, limit: 1.0, share }, lasting);
        }
        let found = track.closest.map(|(frame, m)| (frame, m.share));
        assert_eq!(found, closest_by_definition(&shares, lasting), "{lasting} frames");
    }
}
