//! Motions with exact derivatives, and the files in which they are written.

use ambulo::findings::Findings;
use ambulo::model::{Model, to_osim};
use ambulo::numerics::elementary::{cos, sin};
use ambulo_formats::table::Table;
use std::f64::consts::TAU;

/// offset + amplitude sin(2π f t + phase).
#[derive(Debug, Clone, Copy)]
pub(super) struct Wave {
    pub(super) offset: f64,
    pub(super) amplitude: f64,
    pub(super) frequency_hz: f64,
    pub(super) phase: f64,
}

impl Wave {
    /// Value, rate and acceleration.
    pub(super) fn at(self, t: f64) -> [f64; 3] {
        let omega = TAU * self.frequency_hz;
        let (s, c) = (sin(omega * t + self.phase), cos(omega * t + self.phase));
        [self.offset + self.amplitude * s, self.amplitude * omega * c, -self.amplitude * omega * omega * s]
    }
}

/// A function of time with its derivatives.
#[derive(Debug, Clone)]
pub(super) enum Signal {
    Wave(Wave),
    /// A steady part and waves.
    Sum {
        speed: f64,
        waves: Vec<Wave>,
    },
}

impl Signal {
    /// Value, rate and acceleration.
    pub(super) fn at(&self, t: f64) -> [f64; 3] {
        match self {
            Signal::Wave(wave) => wave.at(t),
            Signal::Sum { speed, waves } => waves.iter().fold([speed * t, *speed, 0.0], |sum, wave| {
                let one = wave.at(t);
                [0, 1, 2].map(|i| sum[i] + one[i])
            }),
        }
    }
}

/// Instants of a table [s], without the rounding of sums.
pub(super) fn seconds(from: f64, step: f64, rows: usize) -> Vec<f64> {
    (0..rows).map(|row| rounded(from + step * row as f64, 1e-9)).collect()
}

pub(super) fn rounded(value: f64, unit: f64) -> f64 {
    // Adding zero turns -0 to 0.
    (value / unit).round() / (1.0 / unit).round() + 0.0
}

pub(super) fn column(name: &str, times: &[f64], value: impl Fn(f64) -> f64) -> (String, Vec<f64>) {
    (name.to_owned(), times.iter().map(|t| value(*t)).collect())
}

fn table(name: &str, times: &[f64], columns: Vec<(String, Vec<f64>)>, unit: f64) -> Table {
    let round = |(name, values): (String, Vec<f64>)| (name, values.into_iter().map(|x| rounded(x, unit)).collect());
    let time = ("time".to_owned(), times.to_vec());
    Table::new(name, std::iter::once(time).chain(columns.into_iter().map(round)).collect()).unwrap()
}

pub(super) fn storage(name: &str, times: &[f64], columns: Vec<(String, Vec<f64>)>, unit: f64) -> Vec<u8> {
    table(name, times, columns, unit).write_storage()
}

pub(super) fn csv(times: &[f64], columns: Vec<(String, Vec<f64>)>) -> Vec<u8> {
    table("", times, columns, 1e-8).write_csv()
}

/// 0.8 s at 200 Hz, in radians and metres.
pub(super) fn motion_file(motion: &[(&str, Signal)]) -> Vec<u8> {
    let times = seconds(0.0, 0.005, 161);
    let columns = motion.iter().map(|(name, signal)| column(name, &times, |t| signal.at(t)[0])).collect();
    let mut table = table("Coordinates", &times, columns, 1e-11);
    table.in_degrees = Some(false);
    table.write_storage()
}

/// A model as Ambulo writes it.
pub(super) fn model_file(name: &str, bodies: &str, joints: &str) -> Vec<u8> {
    let text = format!(
        "<OpenSimDocument Version=\"40000\"><Model name=\"{name}\"><gravity>0 -9.80665 0</gravity>\
         <BodySet><objects>{bodies}</objects></BodySet><JointSet><objects>{joints}</objects></JointSet>\
         </Model></OpenSimDocument>"
    );
    let model = Model::from_osim(text.as_bytes(), &mut Findings::default()).unwrap();
    to_osim(&model).unwrap().write().unwrap()
}
