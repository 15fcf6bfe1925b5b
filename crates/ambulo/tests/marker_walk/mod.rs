//! A synthetic walk: feet at rest in stance and in swing on given paths, a pelvis with constant speed.

use ambulo::model::Side;
use ambulo::motion::{Event, EventKind, MarkerPath, MarkerRecording, PlateRecording};
use ambulo::spatial::Vec3;

/// Walking speed [m/s].
pub(crate) const SPEED_M_S: f64 = 1.2;
/// Duration of a stride [s].
pub(crate) const STRIDE_S: f64 = 1.1;
/// Stance as a share of the stride.
pub(crate) const STANCE: f64 = 0.62;
/// Duration of the walk [s].
pub(crate) const DURATION_S: f64 = 4.0;
pub(crate) const RATE_HZ: f64 = 100.0;
/// Heel and toe marker in front of the reference point of the foot [m].
pub(crate) const HEEL: f64 = -0.06;
pub(crate) const TOE: f64 = 0.14;

/// First strike of a side after time zero [s].
fn first_strike(side: Side) -> f64 {
    match side {
        Side::Right => 0.3,
        Side::Left => 0.3 + 0.5 * STRIDE_S,
    }
}

pub(crate) fn lateral(side: Side) -> f64 {
    match side {
        Side::Right => 0.1,
        Side::Left => -0.1,
    }
}

/// The stances of a side: number, strike and off [s]; the first one began before the recording.
pub(crate) fn stances(side: Side) -> Vec<(i32, f64, f64)> {
    let strike = |k: i32| first_strike(side) + f64::from(k) * STRIDE_S;
    (-1..5).map(|k| (k, strike(k), strike(k) + STANCE * STRIDE_S)).collect()
}

/// Position of the foot in its stance number `k` [m].
pub(crate) fn place(side: Side, k: i32) -> Vec3 {
    // Half a stance after the strike the pelvis is above the foot.
    let middle = first_strike(side) + (f64::from(k) + 0.5 * STANCE) * STRIDE_S;
    Vec3::new(SPEED_M_S * middle, 0.0, lateral(side))
}

/// Height of the stair under the foot in its stance number `k`: every step is one stair higher [m].
pub(crate) fn stair(side: Side, k: i32, rise_m: f64) -> f64 {
    rise_m * f64::from(2 * k + i32::from(side == Side::Left))
}

/// Reference point of the foot at a time, on stairs of this rise [m].
fn foot(side: Side, t: f64, rise_m: f64) -> Vec3 {
    let stride = (t - first_strike(side)) / STRIDE_S;
    let (k, phase) = (stride.floor() as i32, stride - stride.floor());
    let on_stair = |k: i32| place(side, k) + Vec3::y() * stair(side, k, rise_m);
    let here = on_stair(k);
    if phase <= STANCE {
        return here;
    }
    let u = (phase - STANCE) / (1.0 - STANCE);
    let share = u * u * u * (10.0 - 15.0 * u + 6.0 * u * u);
    here + (on_stair(k + 1) - here) * share + Vec3::y() * (0.1 * (std::f64::consts::PI * u).sin())
}

/// Markers of the pelvis and both feet on level ground, in world axes.
pub(crate) fn walk() -> MarkerRecording {
    climb(0.0)
}

/// The same walk up stairs of this rise [m].
pub(crate) fn climb(rise_m: f64) -> MarkerRecording {
    let times: Vec<f64> = (0..=(DURATION_S * RATE_HZ) as usize).map(|i| i as f64 / RATE_HZ).collect();
    let path = |name: &str, at: &dyn Fn(f64) -> Vec3| MarkerPath {
        name: name.to_owned(),
        positions: times.iter().map(|&t| at(t)).collect(),
    };
    let pelvis = |offset: Vec3| move |t: f64| Vec3::new(SPEED_M_S * t, 1.0 + 2.0 * rise_m * t / STRIDE_S, 0.0) + offset;
    let on_foot = |side: Side, ahead: f64| move |t: f64| foot(side, t, rise_m) + Vec3::new(ahead, 0.04, 0.0);
    let markers = vec![
        path("RASI", &pelvis(Vec3::new(0.1, 0.0, 0.12))),
        path("LASI", &pelvis(Vec3::new(0.1, 0.0, -0.12))),
        path("SACR", &pelvis(Vec3::new(-0.1, 0.0, 0.0))),
        path("RHEE", &on_foot(Side::Right, HEEL)),
        path("RTOE", &on_foot(Side::Right, TOE)),
        path("LHEE", &on_foot(Side::Left, HEEL)),
        path("LTOE", &on_foot(Side::Left, TOE)),
    ];
    MarkerRecording { name: "made".to_owned(), rate_hz: RATE_HZ, times, markers }
}

/// The true events inside the recording.
pub(crate) fn events() -> Vec<Event> {
    let mut list = Vec::new();
    for side in Side::BOTH {
        for (_, strike, off) in stances(side) {
            list.push(Event { side, kind: EventKind::Strike, time_s: strike });
            list.push(Event { side, kind: EventKind::Off, time_s: off });
        }
    }
    list.retain(|e| e.time_s > 0.15 && e.time_s < DURATION_S - 0.15);
    list
}

/// A load of one foot: side, number of the stance, share of the stance at which it begins and ends, share of the
/// weight.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Load {
    pub(crate) side: Side,
    pub(crate) stance: i32,
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) share: f64,
}

impl Load {
    pub(crate) fn whole(side: Side, stance: i32) -> Load {
        Load { side, stance, from: 0.0, to: 1.0, share: 1.0 }
    }
}

/// A level plate from corner to corner (x and z of two corners, height) [m], under these loads. The centre of pressure
/// goes from heel to toe.
pub(crate) fn plate(from: [f64; 2], to: [f64; 2], height: f64, loads: &[Load]) -> PlateRecording {
    let times: Vec<f64> = (0..=(DURATION_S * 1000.0) as usize).map(|i| i as f64 / 1000.0).collect();
    let wrench = |t: f64| {
        let mut sum = (Vec3::zeros(), Vec3::zeros());
        for load in loads {
            let (_, strike, off) = stances(load.side)[(load.stance + 1) as usize];
            let u = (t - strike) / (off - strike);
            if u > load.from && u < load.to {
                let force = Vec3::new(20.0, load.share * 700.0 * (std::f64::consts::PI * u).sin().sqrt(), 5.0);
                let mut point = place(load.side, load.stance) + Vec3::x() * (HEEL + u * (TOE - HEEL));
                point.y = height;
                sum = (sum.0 + force, sum.1 + point.cross(&force));
            }
        }
        sum
    };
    let (force, moment) = times.iter().map(|&t| wrench(t)).unzip();
    let corner = |x: f64, z: f64| Vec3::new(x, height, z);
    PlateRecording {
        name: "plate".to_owned(),
        kind: 2,
        force,
        moment,
        corners: [corner(to[0], from[1]), corner(from[0], from[1]), corner(from[0], to[1]), corner(to[0], to[1])],
        up: Vec3::y(),
        center_from_sensors: Vec3::zeros(),
        assumed_units: None,
        baseline_n: None,
        clipped: Vec::new(),
        times,
    }
}

/// A plate of half a metre under the foot of one stance.
pub(crate) fn plate_under(side: Side, stance: i32, loads: &[Load]) -> PlateRecording {
    let p = place(side, stance);
    plate([p.x - 0.2, p.z - 0.15], [p.x + 0.3, p.z + 0.15], 0.0, loads)
}
