//! Numbers that carry their derivative, so that what depends on the pose is written once and differentiated exactly.

use std::ops::{Add, Mul, Neg, Sub};

use glam::DVec3;

/// A value and its derivative by time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Dual {
    /// The value.
    pub value: f64,
    /// Its derivative.
    pub rate: f64,
}

impl Dual {
    pub(super) const ONE: Self = Self::constant(1.0);
    pub(super) const ZERO: Self = Self::constant(0.0);

    pub(super) const fn constant(value: f64) -> Self {
        Self { value, rate: 0.0 }
    }

    /// `value` with the derivative of a function of this: `slope` times this one's.
    fn chain(self, value: f64, slope: f64) -> Self {
        Self { value, rate: slope * self.rate }
    }

    /// The square root; of 0, with derivative 0.
    pub(super) fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, if root > 0.0 { 0.5 / root } else { 0.0 })
    }

    pub(super) fn recip(self) -> Self {
        let reciprocal = self.value.recip();
        self.chain(reciprocal, -reciprocal * reciprocal)
    }

    pub(super) fn abs(self) -> Self {
        if self.value < 0.0 { -self } else { self }
    }

    pub(super) fn min(self, other: Self) -> Self {
        if other.value < self.value { other } else { self }
    }

    /// 0 below 0, 1 above 1, and between them x³(6x² − 15x + 10), whose first and second derivatives have no jumps.
    pub(super) fn step(self) -> Self {
        let x = self.value.clamp(0.0, 1.0);
        self.chain(x * x * x * (x * (6.0 * x - 15.0) + 10.0), 30.0 * (x * (1.0 - x)).powi(2))
    }
}

impl Add for Dual {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, rate: self.rate + other.rate }
    }
}

impl Sub for Dual {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { value: self.value - other.value, rate: self.rate - other.rate }
    }
}

impl Mul for Dual {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self { value: self.value * other.value, rate: self.rate * other.value + self.value * other.rate }
    }
}

impl Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, rate: -self.rate }
    }
}

/// A vector with its derivative.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct DualVec {
    /// The value.
    pub value: DVec3,
    /// Its derivative.
    pub rate: DVec3,
}

impl DualVec {
    pub(super) const ZERO: Self = Self::constant(DVec3::ZERO);

    pub(super) const fn constant(value: DVec3) -> Self {
        Self { value, rate: DVec3::ZERO }
    }

    pub(super) fn dot(self, other: Self) -> Dual {
        Dual { value: self.value.dot(other.value), rate: self.rate.dot(other.value) + self.value.dot(other.rate) }
    }

    pub(super) fn cross(self, other: Self) -> Self {
        Self { value: self.value.cross(other.value), rate: self.rate.cross(other.value) + self.value.cross(other.rate) }
    }

    pub(super) fn length(self) -> Dual {
        self.dot(self).sqrt()
    }

    /// Each component times a constant.
    pub(super) fn scaled(self, scale: DVec3) -> Self {
        Self { value: self.value * scale, rate: self.rate * scale }
    }
}

impl Add for DualVec {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, rate: self.rate + other.rate }
    }
}

impl Sub for DualVec {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { value: self.value - other.value, rate: self.rate - other.rate }
    }
}

impl Mul<Dual> for DualVec {
    type Output = Self;
    fn mul(self, factor: Dual) -> Self {
        Self { value: self.value * factor.value, rate: self.rate * factor.value + self.value * factor.rate }
    }
}
