//! Puts lists in order by numbers, smallest first. Elements with equal numbers keep their order; a NaN with a positive
//! sign is above all numbers.
//!
//! The sort of the standard library is 6 kB of machine code for each kind of element and each rule of order. Here it is
//! compiled for ranks only, and elements then change places.
//!
//! Pinned by: tests/numerics_order.rs

/// Lists that can be put in order by numbers.
pub trait Order<T> {
    /// Puts elements in order of a number of each, smallest first.
    fn sort_by_number(&mut self, number: impl Fn(&T) -> f64);

    /// Puts elements in order of the first of two numbers of each, and those that are equal in it of the second.
    fn sort_by_numbers(&mut self, numbers: impl Fn(&T) -> [f64; 2]);
}

impl<T> Order<T> for [T] {
    fn sort_by_number(&mut self, number: impl Fn(&T) -> f64) {
        for [a, b] in exchanges(ranks(&self.iter().map(number).collect::<Vec<f64>>())) {
            self.swap(a, b);
        }
    }

    fn sort_by_numbers(&mut self, numbers: impl Fn(&T) -> [f64; 2]) {
        self.sort_by_number(|element| numbers(element)[1]);
        self.sort_by_number(|element| numbers(element)[0]);
    }
}

/// At most `most` of `count` indices at equal distances, the first of them 0.
pub fn sampled(count: usize, most: usize) -> impl Iterator<Item = usize> + Clone {
    (0..count).step_by(count.div_ceil(most).max(1))
}

/// Puts numbers in order, smallest first.
pub fn sort_numbers(numbers: &mut [f64]) {
    numbers.sort_by(f64::total_cmp);
}

/// Places of numbers, that of the smallest first.
fn ranks(numbers: &[f64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..numbers.len()).collect();
    order.sort_by(|a, b| numbers[*a].total_cmp(&numbers[*b]));
    order
}

/// Pairs of places whose elements change places, one pair after the other, until each place has the element of the
/// place that `order` names.
fn exchanges(mut order: Vec<usize>) -> Vec<[usize; 2]> {
    let mut pairs = Vec::new();
    for first in 0..order.len() {
        let mut place = first;
        while order[place] != first {
            let from = order[place];
            pairs.push([place, from]);
            order[place] = place;
            place = from;
        }
        order[place] = place;
    }
    pairs
}
