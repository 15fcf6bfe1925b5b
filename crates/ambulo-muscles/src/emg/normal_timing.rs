//! Normal timing of muscles in walking: the share of persons in whom a muscle is on at each percent of the cycle.
//!
//! The table `data/emg_timing.csv` has its source and the command that makes it in its header.
//!
//! Pinned by: tests/emg_normal_timing.rs

use super::AnatomicalMuscle;
use ambulo_formats::table::Table;
use std::sync::LazyLock;

const TABLE: &str = include_str!("../../data/emg_timing.csv");

/// When a muscle is usually on in walking.
#[derive(Debug, Clone, PartialEq)]
pub struct NormalTiming {
    /// The muscle.
    pub muscle: AnatomicalMuscle,
    /// Share of persons in whom it is on, 0 to 1, in each percent of the cycle from the strike of its own foot: 0 to
    /// 1 %, 1 to 2 % ...
    pub share_on: Vec<f64>,
}

impl NormalTiming {
    /// Whether it is on in at least this share of persons, in each percent of the cycle.
    #[must_use]
    pub fn is_on(&self, share: f64) -> Vec<bool> {
        self.share_on.iter().map(|on| *on >= share).collect()
    }
}

/// The timing of a muscle in ten adults at their own speed; `None` for muscles that were not measured.
#[must_use]
pub fn normal_timing(muscle: AnatomicalMuscle) -> Option<&'static NormalTiming> {
    static ALL: LazyLock<Vec<NormalTiming>> = LazyLock::new(all);
    ALL.iter().find(|timing| timing.muscle == muscle)
}

fn all() -> Vec<NormalTiming> {
    let rows: Vec<&str> = TABLE.lines().filter(|line| !line.starts_with('#')).collect();
    let Ok((table, _)) = Table::read_csv(rows.join("\n").as_bytes()) else { return Vec::new() };
    table
        .columns()
        .filter_map(|(name, values)| {
            let (muscle, _) = AnatomicalMuscle::of_name(name)?;
            Some(NormalTiming { muscle, share_on: values.to_vec() })
        })
        .collect()
}
