//! Sampled functions of time, periodic or over a span, interpolated with quintics.
//!
//! On each interval of length d, a polynomial of degree five matches value, rate and acceleration at both ends. The
//! result is twice continuously differentiable, and its error falls with d⁶ where the function is smooth. Where the
//! third derivative jumps by J inside an interval, the acceleration is off by less than J d/4 within that interval
//! alone. One evaluation costs about 30 operations, whatever the function costs.

/// Samples of several functions at the same instants.
#[derive(Debug, Clone, PartialEq)]
pub struct Samples {
    step_s: f64,
    columns: usize,
    /// The polynomials, one row per interval.
    rows: Vec<Quintic>,
    periodic: bool,
}

impl Samples {
    /// Samples one period of `functions` from time zero, at most `step_s` apart. `functions` fills one entry (value,
    /// rate, acceleration) per column.
    ///
    /// # Panics
    /// If the period or the step is not above zero.
    #[must_use]
    pub fn new(columns: usize, period_s: f64, step_s: f64, functions: impl FnMut(f64, &mut [[f64; 3]])) -> Samples {
        let (mut instants, step_s) = instants(columns, period_s, step_s, functions);
        // The last instant is the first one of the next period.
        let last = instants.len() - columns;
        instants.copy_within(..columns, last);
        Samples { rows: between(&instants, columns, step_s), step_s, columns, periodic: true }
    }

    /// Samples functions from time zero to `span_s`, at most `step_s` apart. Before and after it they have the values
    /// of its ends.
    ///
    /// # Panics
    /// If the span or the step is not above zero.
    #[must_use]
    pub fn over(columns: usize, span_s: f64, step_s: f64, functions: impl FnMut(f64, &mut [[f64; 3]])) -> Samples {
        let (instants, step_s) = instants(columns, span_s, step_s, functions);
        Samples { rows: between(&instants, columns, step_s), step_s, columns, periodic: false }
    }

    /// Value, first and second derivative of one function.
    #[must_use]
    pub fn at(&self, column: usize, t: f64) -> [f64; 3] {
        self.at_place(column, self.place(t))
    }

    /// Value of one function.
    #[must_use]
    pub fn value(&self, column: usize, t: f64) -> f64 {
        self.value_at_place(column, self.place(t))
    }

    /// [`Samples::at`] at a place on the grid.
    pub(super) fn at_place(&self, column: usize, (first, u): (usize, f64)) -> [f64; 3] {
        self.rows[first + column].at(u, self.step_s)
    }

    /// [`Samples::value`] at a place on the grid.
    #[inline]
    pub(super) fn value_at_place(&self, column: usize, (first, u): (usize, f64)) -> f64 {
        self.rows[first + column].value(u)
    }

    /// The place of an instant on the grid: the first entry at the start of its interval, and the elapsed share of the
    /// interval.
    pub(super) fn place(&self, t: f64) -> (usize, f64) {
        let intervals = self.rows.len() / self.columns;
        let count = intervals as f64;
        let mut place = t / self.step_s;
        if self.periodic {
            // Truncation is one instruction on most processors; a negative remainder is then raised by a period.
            place -= ((place / count) as i64 as f64) * count;
            place = if place < 0.0 { place + count } else { place };
        } else {
            place = place.clamp(0.0, count);
        }
        let interval = (place as usize).min(intervals - 1);
        (interval * self.columns, place - interval as f64)
    }
}

/// Value, rate and acceleration of functions at equal intervals, row by row, and the length of an interval [s].
fn instants(
    columns: usize,
    span_s: f64,
    step_s: f64,
    mut functions: impl FnMut(f64, &mut [[f64; 3]]),
) -> (Vec<[f64; 3]>, f64) {
    assert!(span_s > 0.0 && step_s > 0.0, "a span of {span_s} s in steps of {step_s} s");
    let intervals = (span_s / step_s - 1e-9).ceil().max(1.0);
    let step_s = span_s / intervals;
    let mut rows = vec![[0.0; 3]; columns * (intervals as usize + 1)];
    for (number, row) in rows.chunks_exact_mut(columns).enumerate() {
        functions(step_s * number as f64, row);
    }
    (rows, step_s)
}

/// The polynomials between instants, row by row.
fn between(instants: &[[f64; 3]], columns: usize, step_s: f64) -> Vec<Quintic> {
    instants.iter().zip(&instants[columns..]).map(|(one, next)| Quintic::new(*one, *next, step_s)).collect()
}

/// x(u) = c0 + c1 u + .. + c5 u⁵, u from 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Quintic([f64; 6]);

impl Quintic {
    /// With these values, rates and accelerations at the ends of an interval of d [s].
    fn new([x0, v0, a0]: [f64; 3], [x1, v1, a1]: [f64; 3], d: f64) -> Quintic {
        // Rates and accelerations in units of the interval.
        let (v0, v1, a0, a1) = (v0 * d, v1 * d, a0 * d * d, a1 * d * d);
        let (value, rate, bend) = (x1 - x0 - v0 - 0.5 * a0, v1 - v0 - a0, a1 - a0);
        let c3 = 10.0 * value - 4.0 * rate + 0.5 * bend;
        let c4 = -15.0 * value + 7.0 * rate - bend;
        let c5 = 6.0 * value - 3.0 * rate + 0.5 * bend;
        Quintic([x0, v0, 0.5 * a0, c3, c4, c5])
    }

    fn value(&self, u: f64) -> f64 {
        let [c0, c1, c2, c3, c4, c5] = self.0;
        c0 + u * (c1 + u * (c2 + u * (c3 + u * (c4 + u * c5))))
    }

    fn at(&self, u: f64, d: f64) -> [f64; 3] {
        let [_, c1, c2, c3, c4, c5] = self.0;
        let rate = c1 + u * (2.0 * c2 + u * (3.0 * c3 + u * (4.0 * c4 + u * 5.0 * c5)));
        let acceleration = 2.0 * c2 + u * (6.0 * c3 + u * (12.0 * c4 + u * 20.0 * c5));
        [self.value(u), rate / d, acceleration / (d * d)]
    }
}
