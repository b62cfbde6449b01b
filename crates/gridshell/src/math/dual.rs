//! Dual numbers in two variables: a value with its exact derivatives by x and y (forward mode).

use super::trig;
use std::ops::{Add, Div, Mul, Sub};

/// A value and its derivatives by x and y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual {
    /// The value itself.
    pub value: f64,
    /// Derivative by x.
    pub dx: f64,
    /// Derivative by y.
    pub dy: f64,
}

impl Dual {
    /// The variable x at this value.
    pub fn x(value: f64) -> Dual {
        Dual { value, dx: 1.0, dy: 0.0 }
    }

    /// The variable y at this value.
    pub fn y(value: f64) -> Dual {
        Dual { value, dx: 0.0, dy: 1.0 }
    }

    /// Square root. At 0, where the derivative is unbounded, the derivatives are set to 0.
    #[must_use]
    pub fn sqrt(self) -> Dual {
        let root = self.value.sqrt();
        if root == 0.0 {
            return Dual::from(0.0);
        }
        self.chain(root, 0.5 / root)
    }

    /// e to this power.
    #[must_use]
    pub fn exp(self) -> Dual {
        let e = trig::exp(self.value);
        self.chain(e, e)
    }

    /// This number times itself.
    #[must_use]
    pub fn squared(self) -> Dual {
        self * self
    }

    /// The chain rule: a function with this `value` and `slope` here.
    fn chain(self, value: f64, slope: f64) -> Dual {
        Dual { value, dx: self.dx * slope, dy: self.dy * slope }
    }
}

impl From<f64> for Dual {
    fn from(value: f64) -> Dual {
        Dual { value, dx: 0.0, dy: 0.0 }
    }
}

impl From<Dual> for [f64; 3] {
    fn from(d: Dual) -> [f64; 3] {
        [d.value, d.dx, d.dy]
    }
}

impl<T: Into<Dual>> Add<T> for Dual {
    type Output = Dual;
    fn add(self, other: T) -> Dual {
        let o = other.into();
        Dual { value: self.value + o.value, dx: self.dx + o.dx, dy: self.dy + o.dy }
    }
}

impl<T: Into<Dual>> Sub<T> for Dual {
    type Output = Dual;
    fn sub(self, other: T) -> Dual {
        let o = other.into();
        Dual { value: self.value - o.value, dx: self.dx - o.dx, dy: self.dy - o.dy }
    }
}

impl<T: Into<Dual>> Mul<T> for Dual {
    type Output = Dual;
    fn mul(self, other: T) -> Dual {
        let o = other.into();
        Dual {
            value: self.value * o.value,
            dx: self.dx * o.value + self.value * o.dx,
            dy: self.dy * o.value + self.value * o.dy,
        }
    }
}

impl<T: Into<Dual>> Div<T> for Dual {
    type Output = Dual;
    fn div(self, other: T) -> Dual {
        let o = other.into();
        let value = self.value / o.value;
        Dual {
            value,
            dx: (self.dx - value * o.dx) / o.value,
            dy: (self.dy - value * o.dy) / o.value,
        }
    }
}

impl Add<Dual> for f64 {
    type Output = Dual;
    fn add(self, other: Dual) -> Dual {
        other + self
    }
}

impl Sub<Dual> for f64 {
    type Output = Dual;
    fn sub(self, other: Dual) -> Dual {
        Dual::from(self) - other
    }
}

impl Mul<Dual> for f64 {
    type Output = Dual;
    fn mul(self, other: Dual) -> Dual {
        other * self
    }
}

impl Div<Dual> for f64 {
    type Output = Dual;
    fn div(self, other: Dual) -> Dual {
        Dual::from(self) / other
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_follow_the_product_quotient_and_chain_rules() {
        let (x, y) = (Dual::x(3.0), Dual::y(4.0));
        // f = sqrt(x^2 + y^2): gradient (x, y) / f.
        let f = (x * x + y * y).sqrt();
        assert!(f.value == 5.0 && (f.dx - 0.6).abs() < 1e-15 && (f.dy - 0.8).abs() < 1e-15);
        // g = x / y - 2: gradient (1 / y, -x / y^2).
        let g = x / y - 2.0;
        assert_eq!(<[f64; 3]>::from(g), [-1.25, 0.25, -0.1875]);
        // h = exp(x - 3) y: gradient (h, 1) at x = 3.
        let h = (x - 3.0).exp() * y;
        assert_eq!(<[f64; 3]>::from(h), [4.0, 4.0, 1.0]);
        // k = 12 / x - y: gradient (-12 / x^2, -1).
        let k = 12.0 / x - y;
        assert!((k.dx + 12.0 / 9.0).abs() < 1e-15 && k.dy == -1.0 && k.value == 0.0);
    }

    #[test]
    fn the_root_of_zero_keeps_finite_derivatives() {
        assert_eq!(Dual::x(0.0).sqrt(), Dual::from(0.0));
    }
}
