//! Medians.

/// The median; with an even count the mean of the two middle values. Values that are not finite are ignored; `None` if no value remains.
#[must_use]
pub fn median(values: impl IntoIterator<Item = f64>) -> Option<f64> {
    let mut list: Vec<f64> = values.into_iter().filter(|value| value.is_finite()).collect();
    list.sort_by(f64::total_cmp);
    let count = list.len();
    let upper = *list.get(count / 2)?;
    let lower = *list.get(count.saturating_sub(1) / 2)?;
    Some(0.5 * (lower + upper))
}

#[cfg(test)]
mod tests {
    use super::median;

    #[test]
    fn medians_pass_over_what_is_no_number() {
        assert_eq!(median([3.0, f64::NAN, 1.0, 2.0]), Some(2.0));
        assert_eq!(median([3.0, 1.0]), Some(2.0));
        assert_eq!(median([f64::NAN]), None);
    }
}
