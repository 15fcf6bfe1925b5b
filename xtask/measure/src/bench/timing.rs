//! Repeated measurements and their spread.

use cpu_time::ThreadTime;

/// Measurements of each quantity; one more runs first, unmeasured.
const BATCHES: usize = 41;

/// Median and spread of repeated measurements, in the unit of its row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Timing {
    pub(crate) median: f64,
    /// Tenth and ninetieth percentile; `None` if it was measured once or by another program.
    pub(crate) spread: Option<[f64; 3]>,
}

impl Timing {
    /// A value without spread.
    pub(crate) fn single(value: f64) -> Timing {
        Timing { median: value, spread: None }
    }

    /// Median and spread by rank, as the peers' programs take them.
    pub(crate) fn of(mut samples: Vec<f64>) -> Timing {
        samples.sort_by(f64::total_cmp);
        let n = samples.len();
        let rank = |numerator: usize, denominator: usize| samples[n * numerator / denominator];
        Timing { median: rank(1, 2), spread: Some([rank(1, 10), rank(9, 10), samples[0]]) }
    }
}

/// CPU time of this thread for one of `calls` that `batch` makes, in microseconds.
pub(crate) fn cpu_us(calls: usize, mut batch: impl FnMut()) -> Timing {
    let sample = |batch: &mut dyn FnMut()| {
        let start = ThreadTime::now();
        batch();
        start.elapsed().as_secs_f64() * 1e6 / calls as f64
    };
    batch();
    Timing::of((0..BATCHES).map(|_| sample(&mut batch)).collect())
}

/// CPU times of a job and its parts.
pub(crate) struct JobTiming {
    /// By name, in the order in which the job passes them.
    pub(crate) stages: Vec<(&'static str, Timing)>,
    pub(crate) whole: Timing,
}

/// CPU time of this thread, in microseconds, for `job` and for the stages whose ends it reports.
pub(crate) fn job_us<E>(mut job: impl FnMut(&mut dyn FnMut(&'static str)) -> Result<(), E>) -> Result<JobTiming, E> {
    let mut stages: Vec<(&'static str, Vec<f64>)> = Vec::new();
    let mut whole = Vec::new();
    for batch in 0..=BATCHES {
        let start = ThreadTime::now();
        let mut ends = Vec::new();
        job(&mut |name| ends.push((name, start.elapsed().as_secs_f64() * 1e6)))?;
        let total = start.elapsed().as_secs_f64() * 1e6;
        if batch == 0 {
            stages = ends.iter().map(|&(name, _)| (name, Vec::new())).collect();
            continue;
        }
        whole.push(total);
        let mut before = 0.0;
        for ((_, samples), (_, end)) in stages.iter_mut().zip(ends) {
            samples.push(end - before);
            before = end;
        }
    }
    let stages = stages.into_iter().map(|(name, samples)| (name, Timing::of(samples))).collect();
    Ok(JobTiming { stages, whole: Timing::of(whole) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn median_and_spread_are_taken_by_rank() {
        let samples: Vec<f64> = (0..41_u8).rev().map(f64::from).collect();
        assert_eq!(Timing::of(samples), Timing { median: 20.0, spread: Some([4.0, 36.0, 0.0]) });
    }

    #[test]
    fn stages_add_up_to_no_more_than_the_whole() {
        let spin = || std::hint::black_box((0..20_000_u32).fold(0, u32::wrapping_add));
        let JobTiming { stages, whole } = job_us::<()>(|stage| {
            spin();
            stage("first");
            spin();
            stage("second");
            Ok(())
        })
        .unwrap();
        assert_eq!(stages.iter().map(|s| s.0).collect::<Vec<_>>(), ["first", "second"]);
        let least = |timing: &Timing| timing.spread.unwrap()[2];
        assert!(least(&stages[0].1) + least(&stages[1].1) <= least(&whole));
    }
}
