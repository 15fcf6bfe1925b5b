//! Scalars, vectors and matrices of several frames at once (one SIMD lane per frame).
//!
//! A [`Lanes<N>`] contains the same scalar of N frames. With N = 1 it is a plain number; with N = 8 each loop below
//! becomes one vector instruction on processors that have it. Lanes never affect each other, and no fused multiply-add
//! is used, so that the result of a frame is identical to the last bit on every lane and processor.

use crate::spatial::{Mat3, Vec3};
use std::array;
use std::ops::{Add, AddAssign, Mul, Sub, SubAssign};

/// One scalar of N frames.
#[derive(Debug, Clone, Copy)]
#[repr(transparent)]
pub struct Lanes<const N: usize>(pub [f64; N]);

/// A 3-vector of N frames.
#[derive(Debug, Clone, Copy)]
#[repr(C)]
pub struct V3<const N: usize>(pub(crate) [Lanes<N>; 3]);

/// A 3 x 3 matrix of N frames, by columns.
#[derive(Debug, Clone, Copy)]
#[repr(C)]
pub(crate) struct M3<const N: usize>(pub(crate) [V3<N>; 3]);

impl<const N: usize> Lanes<N> {
    pub(crate) const ZERO: Lanes<N> = Lanes([0.0; N]);

    #[inline(always)]
    pub(crate) fn splat(x: f64) -> Lanes<N> {
        Lanes([x; N])
    }

    #[inline(always)]
    fn zip(self, other: Lanes<N>, f: impl Fn(f64, f64) -> f64) -> Lanes<N> {
        let mut out = self;
        for i in 0..N {
            out.0[i] = f(self.0[i], other.0[i]);
        }
        out
    }
}

impl<const N: usize> Add for Lanes<N> {
    type Output = Lanes<N>;
    #[inline(always)]
    fn add(self, other: Lanes<N>) -> Lanes<N> {
        self.zip(other, |a, b| a + b)
    }
}

impl<const N: usize> Sub for Lanes<N> {
    type Output = Lanes<N>;
    #[inline(always)]
    fn sub(self, other: Lanes<N>) -> Lanes<N> {
        self.zip(other, |a, b| a - b)
    }
}

impl<const N: usize> Mul for Lanes<N> {
    type Output = Lanes<N>;
    #[inline(always)]
    fn mul(self, other: Lanes<N>) -> Lanes<N> {
        self.zip(other, |a, b| a * b)
    }
}

impl<const N: usize> Mul<f64> for Lanes<N> {
    type Output = Lanes<N>;
    #[inline(always)]
    fn mul(self, factor: f64) -> Lanes<N> {
        self * Lanes::splat(factor)
    }
}

impl<const N: usize> AddAssign for Lanes<N> {
    #[inline(always)]
    fn add_assign(&mut self, other: Lanes<N>) {
        *self = *self + other;
    }
}

impl<const N: usize> V3<N> {
    pub(crate) const ZERO: V3<N> = V3([Lanes::ZERO; 3]);

    #[inline(always)]
    pub(crate) fn splat(v: Vec3) -> V3<N> {
        V3([Lanes::splat(v[0]), Lanes::splat(v[1]), Lanes::splat(v[2])])
    }

    #[inline(always)]
    pub(crate) fn dot(self, other: V3<N>) -> Lanes<N> {
        self.0[0] * other.0[0] + self.0[1] * other.0[1] + self.0[2] * other.0[2]
    }

    #[inline(always)]
    pub(crate) fn cross(self, other: V3<N>) -> V3<N> {
        let (V3([ax, ay, az]), V3([bx, by, bz])) = (self, other);
        V3([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx])
    }

    /// The vector of one frame.
    pub fn lane(&self, i: usize) -> Vec3 {
        Vec3::new(self.0[0].0[i], self.0[1].0[i], self.0[2].0[i])
    }

    /// Replaces the vector of one frame.
    pub(crate) fn set_lane(&mut self, i: usize, v: Vec3) {
        for k in 0..3 {
            self.0[k].0[i] = v[k];
        }
    }
}

impl<const N: usize> Add for V3<N> {
    type Output = V3<N>;
    #[inline(always)]
    fn add(self, other: V3<N>) -> V3<N> {
        V3([self.0[0] + other.0[0], self.0[1] + other.0[1], self.0[2] + other.0[2]])
    }
}

impl<const N: usize> Sub for V3<N> {
    type Output = V3<N>;
    #[inline(always)]
    fn sub(self, other: V3<N>) -> V3<N> {
        V3([self.0[0] - other.0[0], self.0[1] - other.0[1], self.0[2] - other.0[2]])
    }
}

impl<const N: usize> Mul<Lanes<N>> for V3<N> {
    type Output = V3<N>;
    #[inline(always)]
    fn mul(self, factor: Lanes<N>) -> V3<N> {
        V3([self.0[0] * factor, self.0[1] * factor, self.0[2] * factor])
    }
}

impl<const N: usize> AddAssign for V3<N> {
    #[inline(always)]
    fn add_assign(&mut self, other: V3<N>) {
        *self = *self + other;
    }
}

impl<const N: usize> SubAssign for V3<N> {
    #[inline(always)]
    fn sub_assign(&mut self, other: V3<N>) {
        *self = *self - other;
    }
}

impl<const N: usize> M3<N> {
    #[inline(always)]
    pub(crate) fn splat(m: &Mat3) -> M3<N> {
        M3(array::from_fn(|j| V3::splat(m.column(j).into_owned())))
    }

    /// Column j; written out for the same reason as `turn_about`.
    #[inline(always)]
    pub(crate) fn col(&self, j: usize) -> V3<N> {
        match j {
            0 => self.0[0],
            1 => self.0[1],
            _ => self.0[2],
        }
    }

    /// R v.
    #[inline(always)]
    pub(crate) fn turn(&self, v: V3<N>) -> V3<N> {
        self.0[0] * v.0[0] + self.0[1] * v.0[1] + self.0[2] * v.0[2]
    }

    /// R v for a vector that is the same in all frames.
    #[inline(always)]
    pub(crate) fn turn_fixed(&self, v: &Vec3) -> V3<N> {
        self.turn(V3::splat(*v))
    }

    /// Rᵀ v.
    #[inline(always)]
    pub(crate) fn turn_back(&self, v: V3<N>) -> V3<N> {
        V3([self.0[0].dot(v), self.0[1].dot(v), self.0[2].dot(v)])
    }

    /// R S for a matrix that is the same in all frames.
    #[inline(always)]
    pub(crate) fn times_fixed(&self, s: &Mat3) -> M3<N> {
        M3(array::from_fn(|j| self.turn_fixed(&s.column(j).into_owned())))
    }

    /// Multiplies R by a rotation about its axis k (0 = x) and returns that axis, column k of R.
    ///
    /// Columns are selected by constants: a running index would force the matrix out of the registers.
    #[inline(always)]
    pub(crate) fn turn_about(&mut self, k: usize, sin: Lanes<N>, cos: Lanes<N>) -> V3<N> {
        match k {
            0 => self.turn_columns::<0, 1, 2>(sin, cos),
            1 => self.turn_columns::<1, 2, 0>(sin, cos),
            _ => self.turn_columns::<2, 0, 1>(sin, cos),
        }
    }

    #[inline(always)]
    fn turn_columns<const K: usize, const I: usize, const J: usize>(&mut self, sin: Lanes<N>, cos: Lanes<N>) -> V3<N> {
        let (u, v) = (self.0[I], self.0[J]);
        self.0[I] = u * cos + v * sin;
        self.0[J] = v * cos - u * sin;
        self.0[K]
    }

    /// The matrix of one frame.
    pub(crate) fn lane(&self, i: usize) -> Mat3 {
        Mat3::from_columns(&[self.0[0].lane(i), self.0[1].lane(i), self.0[2].lane(i)])
    }
}
