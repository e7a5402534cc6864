//! How far a vector reaches: a bound on its length, and one along each axis of the frame that it is seen in.
//!
//! A turn by an angle that is known to lie in a range mixes two axes by so much at most, and leaves the third alone; lengths it
//! keeps. Signs do not count, so that quarter turns only exchange axes.

use super::interval::Interval;
use super::upper::Upper;

/// Bounds on a vector.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Reach {
    pub(super) axes: [Upper; 3],
    pub(super) length: Upper,
}

/// The rotation from the frame of one cluster to that of the next.
#[derive(Debug, Clone, Copy)]
pub(super) struct Turn {
    /// Along which axis of the outer frame each axis lies that is turned.
    pub(super) frame: [usize; 3],
    /// Which of these it goes about.
    pub(super) about: usize,
    /// The largest cosine and sine.
    cosine: Upper,
    sine: Upper,
}

impl Turn {
    pub(super) fn new(frame: [usize; 3], about: usize, angle: Interval) -> Self {
        let [cosine, sine] = [angle.cos(), angle.sin()].map(|wave| Upper::exact(wave.magnitude()));
        Self { frame, about, cosine, sine }
    }

    /// A vector of the inner frame as the outer one sees it.
    pub(super) fn outward(&self, inner: Reach) -> Reach {
        let turned = self.mixed(inner);
        let mut axes = [Upper::ZERO; 3];
        for (axis, outer) in self.frame.into_iter().enumerate() {
            axes[outer] = turned.axes[axis];
        }
        Reach { axes, ..turned }
    }

    /// A vector of the outer frame as the inner one sees it.
    pub(super) fn inward(&self, outer: Reach) -> Reach {
        self.mixed(Reach { axes: self.frame.map(|axis| outer.axes[axis]), ..outer })
    }

    fn mixed(&self, reach: Reach) -> Reach {
        let (a, b) = ((self.about + 1) % 3, (self.about + 2) % 3);
        let (x, y) = (reach.axes[a], reach.axes[b]);
        let across = (x * x + y * y).root();
        let mut axes = reach.axes;
        axes[a] = (self.cosine * x + self.sine * y).min(across);
        axes[b] = (self.sine * x + self.cosine * y).min(across);
        Reach { axes, ..reach }.tight()
    }
}

impl Reach {
    pub(super) fn of(axes: [Upper; 3]) -> Self {
        Self { axes, length: Upper::norm(axes) }
    }

    /// The sum of two vectors.
    pub(super) fn plus(self, other: Self) -> Self {
        let axes = std::array::from_fn(|axis| self.axes[axis] + other.axes[axis]);
        Self { axes, length: self.length + other.length }.tight()
    }

    /// The cross product of two vectors.
    pub(super) fn cross(self, other: Self) -> Upper {
        let axes = std::array::from_fn(|axis| {
            let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
            self.axes[a] * other.axes[b] + self.axes[b] * other.axes[a]
        });
        Upper::norm(axes).min(self.length * other.length)
    }

    /// No axis has more than the length, which is no more than that of the axes.
    fn tight(self) -> Self {
        let length = self.length.min(Upper::norm(self.axes));
        Self { axes: self.axes.map(|axis| axis.min(length)), length }
    }
}
