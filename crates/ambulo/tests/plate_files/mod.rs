//! C3D files with force plates, created in memory.

use ambulo_formats::c3d::{C3d, Channel, Encoding, Group, Parameter, Parameters, Point, Values};

/// A plate as described in a file, in mm.
#[derive(Debug, Clone)]
pub(crate) struct File {
    pub(crate) kind: i16,
    pub(crate) corners_mm: [[f64; 3]; 4],
    pub(crate) origin_mm: [f64; 3],
    /// Rows.
    pub(crate) matrix: Vec<Vec<f64>>,
    /// Samples by channel.
    pub(crate) channels: Vec<Vec<f64>>,
    pub(crate) units: Vec<&'static str>,
    pub(crate) zero: [i16; 2],
    /// Positions of markers in every frame [mm].
    pub(crate) markers_mm: Vec<[f64; 3]>,
}

pub(crate) const RATE_HZ: f64 = 200.0;

/// Corners of a plate of 400 x 600 mm in the floor of a laboratory with z up: x of the plate along x of the
/// laboratory, its y opposite to y of the laboratory, its z down.
pub(crate) const CORNERS_MM: [[f64; 3]; 4] =
    [[400.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 600.0, 0.0], [400.0, 600.0, 0.0]];

impl File {
    /// Forty samples without load, then forty with about these values, and exactly these in sample 60: the first three
    /// channels grow by a thousandth from sample to sample, the others decrease, because no person stands perfectly
    /// still.
    pub(crate) fn step(kind: i16, origin_mm: [f64; 3], values: &[f64]) -> File {
        let channel = |(i, v): (usize, &f64)| {
            let growth = if i < 3 { 1e-3 } else { -1e-3 };
            let loaded = (40..80).map(|k| v * (1.0 + growth * (f64::from(k) - 60.0)));
            vec![0.0; 40].into_iter().chain(loaded).collect()
        };
        File {
            kind,
            corners_mm: CORNERS_MM,
            origin_mm,
            matrix: Vec::new(),
            channels: values.iter().enumerate().map(channel).collect(),
            units: vec!["N", "N", "N", "Nmm", "Nmm", "Nmm"],
            zero: [0, 0],
            markers_mm: Vec::new(),
        }
    }

    pub(crate) fn record(&self) -> C3d {
        record(std::slice::from_ref(self))
    }
}

/// One recording with several plates.
pub(crate) fn record(plates: &[File]) -> C3d {
    let mut channels = Vec::new();
    let rows = plates.iter().map(|p| p.channels.len()).max().unwrap();
    let mut numbers = Vec::new();
    for plate in plates {
        let first = channels.len();
        for (i, samples) in plate.channels.iter().enumerate() {
            let unit = plate.units.get(i).copied().unwrap_or("N");
            channels.push(Channel::new(&format!("C{}", channels.len() + 1), unit, samples.clone()));
        }
        let number = |i: usize| if i < plate.channels.len() { (first + i + 1) as i16 } else { 0 };
        numbers.extend((0..rows).map(number));
    }
    let frames = plates[0].channels[0].len();
    let points = plates[0].markers_mm.iter().enumerate();
    let reals = |name: &str, dimensions: Vec<usize>, values: Vec<f64>| {
        let values = Values::Reals(values.into_iter().map(|x| x as f32).collect());
        Parameter { dimensions, ..Parameter::list(name, values) }
    };
    let count = plates.len();
    let (matrix_rows, columns) = (plates[0].matrix.len(), plates[0].matrix.first().map_or(0, Vec::len));
    let by_columns = |p: &File| -> Vec<f64> {
        (0..columns).flat_map(|c| (0..matrix_rows).map(move |r| (r, c))).map(|(r, c)| p.matrix[r][c]).collect()
    };
    let mut parameters = vec![
        Parameter::single("USED", Values::Integers(vec![count as i16])),
        Parameter::list("TYPE", Values::Integers(plates.iter().map(|p| p.kind).collect())),
        reals("CORNERS", vec![3, 4, count], plates.iter().flat_map(|p| p.corners_mm.into_iter().flatten()).collect()),
        reals("ORIGIN", vec![3, count], plates.iter().flat_map(|p| p.origin_mm).collect()),
        Parameter { dimensions: vec![rows, count], ..Parameter::list("CHANNEL", Values::Integers(numbers)) },
        Parameter::list("ZERO", Values::Integers(plates[0].zero.to_vec())),
    ];
    if matrix_rows > 0 {
        let values = plates.iter().flat_map(by_columns).collect();
        parameters.push(reals("CAL_MATRIX", vec![matrix_rows, columns, count], values));
    }
    let group =
        |name: &str, parameters| Group { name: name.to_owned(), description: String::new(), locked: false, parameters };
    C3d {
        encoding: Encoding::default(),
        point_rate_hz: RATE_HZ,
        point_unit: "mm".to_owned(),
        first_frame: 1,
        longest_gap: 0,
        points: points.map(|(i, p)| Point::new(&format!("M{i}"), vec![*p; frames])).collect(),
        analog_rate_hz: RATE_HZ,
        channels,
        rotation_rate_hz: 0.0,
        rotations: Vec::new(),
        events: Vec::new(),
        parameters: Parameters { groups: vec![group("FORCE_PLATFORM", parameters)] },
    }
}
