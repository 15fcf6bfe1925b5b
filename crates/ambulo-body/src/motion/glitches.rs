//! Finds what no load does to the channels of a sensor, and draws straight lines instead.
//!
//! A foot loads a plate by at most about 0.2 body weights in a millisecond, and takes more than 50 ms to load and
//! unload it. A jump is a change from one sample to the next by more than a quarter of the range of the channel and
//! three times its hundredth largest change, so that noise is none. Below 500 Hz a strike may be as fast.
//!
//! | fault     | what the samples show                                                           | replaced in      |
//! |-----------|---------------------------------------------------------------------------------|------------------|
//! | excursion | a jump, and within 50 ms one back to the course (a spike, a loose plug)         | all channels     |
//! | level     | a jump, one level for up to 0.3 s, and a jump (a plug that is out)              | those at a level |
//! | hold      | all channels keep their values for 25 ms or longer under a load (lost packets)  | all channels     |
//! | step      | a jump to or from one level that lasts for 50 ms or longer                       | nothing          |
//!
//! Pinned by: tests/force_plate.rs, tests/force_tables.rs

use crate::findings::{Code, Findings, and_more_times};
use crate::numerics::{counted, extremes, quantiles};
use std::ops::Range;

/// A plate whose force varies by less than this was not stepped on [N].
pub(super) const STEP_N: f64 = 50.0;
/// A jump of a force is larger than this share of the load: a stiff plate rings after a hard strike ...
pub(super) const RINGING: f64 = 0.2;
/// ... but not at one level, next to which a jump is larger than this share of that one.
const RINGING_AT_LEVEL: f64 = 0.1;
/// Slowest rate at which jumps are judged [Hz].
const SLOWEST_HZ: f64 = 500.0;
/// Longest excursion [s].
const LONGEST_S: f64 = 0.05;
/// Longest level between jumps that is replaced [s].
const LONGEST_LEVEL_S: f64 = 0.3;
/// Shortest hold [s].
const SHORTEST_HOLD_S: f64 = 0.025;
/// Shortest level between jumps [s]: the top of a ringing is shorter.
const SHORTEST_LEVEL_S: f64 = 0.01;
/// The samples of a level differ by at most this share of the jump, or of the range of the channel.
const LEVEL_SHARE: f64 = 0.1;
/// Smallest jump, as a share of the range of the channel without its rarest values.
const JUMP_SHARE: f64 = 0.25;
/// Smallest jump, as a multiple of a change that one in a hundred samples exceeds.
const JUMP_RATIO: f64 = 3.0;
/// Share of the samples above, and below, the range of a channel.
const RARE: f64 = 0.005;
/// A plate that holds its values for a larger share of the time was recorded at a slower rate.
const MOST_HELD: f64 = 0.5;

/// The channels of one sensor.
pub(super) struct Sensor<'a> {
    /// `plate 1`.
    pub(super) name: &'a str,
    /// Names of the channels that are judged.
    pub(super) names: Vec<String>,
    /// Smallest jumps of excursions in these channels; 0 where a load does not bound them.
    pub(super) least: Vec<f64>,
    pub(super) times: &'a [f64],
    pub(super) rate_hz: f64,
}

/// How a channel fails.
#[derive(Clone, Copy, PartialEq)]
enum Fault {
    Excursion,
    Level,
    Step,
}

impl Sensor<'_> {
    /// Reports and mends the faults. Of the channels the first are judged, the others follow from them. Returns the
    /// longest times that were replaced: more than an excursion takes.
    pub(super) fn mend(&self, channels: &mut [Vec<f64>], findings: &mut Findings) -> Vec<Range<usize>> {
        let judged = self.least.len();
        let (mut through_all, mut levels, mut steps) = (self.holds(channels), Vec::new(), Vec::new());
        let mut lost: Vec<Range<usize>> = through_all.clone();
        for (i, least) in self.least.iter().enumerate() {
            let found = faults(&channels[i], self.rate_hz, *least);
            let of = |fault| found.iter().filter(move |(_, own)| *own == fault).map(|(span, _)| span.clone());
            let is_short = |span: &Range<usize>| span.len() <= count(LONGEST_S, self.rate_hz);
            let jumped: Vec<Range<usize>> = of(Fault::Excursion).chain(of(Fault::Level).filter(is_short)).collect();
            self.report_excursions(i, &jumped, findings);
            through_all.extend(of(Fault::Excursion));
            levels.extend(of(Fault::Level).map(|span| (i, span)));
            lost.extend(of(Fault::Level).filter(|span| !is_short(span)));
            steps.extend(of(Fault::Step).map(|span| span.start));
        }
        let is_replaced =
            |span: &Range<usize>| through_all.iter().any(|own| own.start < span.end && span.start < own.end);
        levels.retain(|(_, span)| !is_replaced(span));
        let ranges: Vec<f64> = channels.iter().map(|channel| range(channel).unwrap_or(0.0)).collect();
        // Of several forces the largest decides where those that follow are lost.
        let largest = (0..judged).filter(|i| self.least[*i] > 0.0).max_by(|a, b| ranges[*a].total_cmp(&ranges[*b]));
        for (own, span) in &levels {
            let at_level = |i: usize| i == *own || is_level(&channels[i][span.clone()], LEVEL_SHARE * ranges[i]);
            let with_force = largest.is_none_or(at_level);
            let out: Vec<usize> =
                (0..channels.len()).filter(|i| if *i < judged { at_level(*i) } else { with_force }).collect();
            out.into_iter().for_each(|i| bridge(&mut channels[i], span));
        }
        for channel in channels.iter_mut() {
            through_all.iter().for_each(|span| bridge(channel, span));
        }
        self.report_lost(&mut lost, findings);
        steps.retain(|at| !lost.iter().any(|span| (span.start..span.end + 2).contains(at)));
        self.report_steps(&mut steps, findings);
        lost
    }

    /// Times in which a loaded sensor keeps all its values.
    fn holds(&self, channels: &[Vec<f64>]) -> Vec<Range<usize>> {
        let samples = self.times.len();
        let repeats = |i: usize| channels.iter().all(|channel| channel[i].total_cmp(&channel[i - 1]).is_eq());
        let is_loaded = |i: usize| {
            channels.iter().zip(&self.least).any(|(channel, least)| *least > 0.0 && channel[i].abs() > *least)
        };
        let shortest = count(SHORTEST_HOLD_S, self.rate_hz);
        let (mut spans, mut start, mut held) = (Vec::new(), 1, 0);
        while start < samples {
            let run = (start..samples).take_while(|i| repeats(*i)).count();
            if is_loaded(start) {
                held += run;
                if run >= shortest && start + run < samples {
                    spans.push(start..start + run);
                }
            }
            start += run + 1;
        }
        if held as f64 > MOST_HELD * samples as f64 || self.rate_hz < SLOWEST_HZ { Vec::new() } else { spans }
    }

    fn report_excursions(&self, channel: usize, spans: &[Range<usize>], findings: &mut Findings) {
        let (Some(first), Some(longest)) = (spans.first(), spans.iter().map(Range::len).max()) else { return };
        let message = format!(
            "{} jumps away and back, first at {:.3} s, {} in all, for {:.1} ms at most: no load comes and goes within \
             {:.0} ms; straight lines were drawn instead, also where others fail with it. hint: look for a loose cable",
            self.names[channel],
            self.times[first.start],
            counted(spans.len(), "time"),
            1e3 * longest as f64 / self.rate_hz,
            1e3 * LONGEST_S
        );
        findings.report(Code::PlatesExcursion, message);
    }

    fn report_lost(&self, lost: &mut Vec<Range<usize>>, findings: &mut Findings) {
        lost.sort_by_key(|span| span.start);
        lost.dedup_by(|next, first| next.start < first.end);
        let Some(first) = lost.first() else { return };
        let message = format!(
            "{} lost its signal from {:.3} to {:.3} s{}: it stayed at one value or one level, with a jump at the end, \
             as under no load; straight lines were drawn instead, and the force there is not known. hint: look for a \
             loose cable or lost packets",
            self.name,
            self.times[first.start],
            self.times[first.end],
            and_more_times(lost.len())
        );
        findings.report(Code::PlatesLost, message);
    }

    fn report_steps(&self, steps: &mut [usize], findings: &mut Findings) {
        steps.sort_unstable();
        let Some(first) = steps.first() else { return };
        let message = format!(
            "{} jumps to or from one level at {:.3} s, as no load does: the force before or after it is not known, and \
             nothing was drawn instead. hint: look for a loose cable",
            self.name, self.times[*first]
        );
        findings.report(Code::PlatesLost, message);
    }
}

/// Samples in a time.
fn count(time_s: f64, rate_hz: f64) -> usize {
    (time_s * rate_hz).round() as usize
}

/// The faults of a channel, each with the samples between its jumps; `least` is the smallest jump of an excursion.
fn faults(samples: &[f64], rate_hz: f64, least: f64) -> Vec<(Range<usize>, Fault)> {
    let mut found = Vec::new();
    let changes: Vec<f64> = samples.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let Some([jump, noise]) = jumps(samples, &changes).filter(|_| rate_hz >= SLOWEST_HZ) else { return found };
    let (away, at_level) = (jump.max(least), jump.max(RINGING_AT_LEVEL * least));
    let long = |time_s: f64| count(time_s, rate_hz);
    let mut at = 0;
    while at < changes.len() {
        let is_back = |end: &usize| {
            changes[*end].abs() > away
                && changes[*end] * changes[at] < 0.0
                && (samples[end + 1] - samples[at]).abs() < away
        };
        let jumps_away = changes[at].abs() > away;
        let excursion = || (at + 1..changes.len().min(at + long(LONGEST_S) + 1)).find(is_back);
        let fault = match jumps_away.then(excursion).flatten() {
            Some(end) => Some((at + 1..end + 1, Fault::Excursion)),
            None if changes[at].abs() > at_level => level(samples, at, noise, long),
            None => None,
        };
        at = fault.as_ref().map_or(at, |(span, _)| span.end - 1) + 1;
        found.extend(fault);
    }
    found
}

/// The level after the jump that follows sample `at`, or before it.
fn level(samples: &[f64], at: usize, noise: f64, long: impl Fn(f64) -> usize) -> Option<(Range<usize>, Fault)> {
    let jump = samples[at + 1] - samples[at];
    let (before, after) = samples.split_at(at + 1);
    let near = |level: Option<&f64>| {
        let level = level.copied();
        move |x: &&f64| level.is_some_and(|level| (**x - level).abs() <= LEVEL_SHARE * jump.abs())
    };
    // The first sample after a jump may lie on the way.
    let length = 1 + after.iter().skip(1).take_while(near(after.get(1))).count();
    let next = after.get(length);
    let is_back = next.is_some_and(|next| {
        let back = next - after[length - 1];
        back.abs() > noise.max(LEVEL_SHARE * jump.abs()) && back * jump < 0.0
    });
    if (long(SHORTEST_LEVEL_S)..=long(LONGEST_LEVEL_S)).contains(&length) && is_back {
        // A jump may take two samples.
        let end = (at + 1 + length + 1).min(samples.len() - 1);
        return Some((at.max(1)..end, Fault::Level));
    }
    let earlier = before.iter().rev().take_while(near(before.last())).count();
    // A channel that is clipped keeps its largest value, a lost one its smallest.
    let [from, to] = [before.last(), after.get(1)].map(|x| x.map_or(0.0, |x| x.abs()));
    let is_step = (length > long(LONGEST_S) && to < from) || (earlier > long(LONGEST_S) && from < to);
    is_step.then(|| (at + 1..at + 2, Fault::Step))
}

/// The smallest jump, and three times a change that one in a hundred samples exceeds. `None` for a channel that does
/// not change, or without samples.
fn jumps(samples: &[f64], changes: &[f64]) -> Option<[f64; 2]> {
    let [change] = quantiles(changes.iter().map(|change| change.abs()), [0.99])?;
    let noise = JUMP_RATIO * change;
    Some([(JUMP_SHARE * range(samples)?).max(noise), noise]).filter(|[jump, _]| *jump > 0.0)
}

fn is_level(samples: &[f64], most: f64) -> bool {
    // Without both ends, which may lie on the way.
    let inner = samples.get(1..samples.len().saturating_sub(1)).unwrap_or_default();
    let (low, high) = extremes(inner);
    high - low <= most
}

/// Range of a channel without its rarest values; `None` without samples.
pub(super) fn range(samples: &[f64]) -> Option<f64> {
    let [low, high] = quantiles(samples.iter().copied(), [RARE, 1.0 - RARE])?;
    Some(high - low)
}

/// Whether all samples of a channel are the same.
pub(super) fn is_still(samples: &[f64]) -> bool {
    samples.windows(2).all(|pair| pair[0].total_cmp(&pair[1]).is_eq())
}

/// Draws a straight line through some samples, from the one before to the one after.
fn bridge(samples: &mut [f64], span: &Range<usize>) {
    let (before, after) = (samples[span.start - 1], samples[span.end]);
    let steps = (span.len() + 1) as f64;
    for (k, sample) in samples[span.clone()].iter_mut().enumerate() {
        *sample = before + (after - before) * ((k + 1) as f64 / steps);
    }
}
