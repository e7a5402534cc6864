//! The mobile lidar's first-order Jacobian, direction and point by 30 errors, worked out on paper.
//!
//! It has no errors in it. Of the 180 derivatives 24 depend on the pose and differ, half of them by no more than their
//! sign; these are stored, each where its sign is right.

use super::ROWS;
use super::lanes::Lanes;
use super::sine_cosine::sin_cos;

/// The observable (0 direction, 1 point), the component, and the error, by its place in the declaration, of each stored
/// derivative.
pub const DERIVATIVES: [(usize, usize, usize); 24] = [
    (0, 0, 14),
    (0, 1, 14),
    (1, 0, 3),
    (0, 0, 0),
    (0, 1, 1),
    (1, 2, 12),
    (0, 2, 5),
    (0, 0, 5),
    (1, 0, 12),
    (0, 1, 10),
    (0, 2, 0),
    (0, 0, 6),
    (0, 1, 5),
    (0, 0, 10),
    (0, 2, 1),
    (0, 0, 23),
    (0, 0, 22),
    (1, 0, 20),
    (0, 1, 23),
    (0, 1, 22),
    (1, 1, 20),
    (0, 2, 23),
    (1, 2, 20),
    (0, 2, 22),
];

/// Derivatives of a block; longer than a block, so that they do not meet in the cache.
pub type Block = [[f64; ROWS + 8]; DERIVATIVES.len()];

/// What the form knows of the errors: nothing.
pub struct FirstOrderJacobian;

impl FirstOrderJacobian {
    /// One block.
    ///
    /// # Safety
    /// The processor has the instructions of `L`.
    #[inline(always)]
    pub unsafe fn run<L: Lanes>(&self, joints: [&[f64; ROWS]; 3], out: &mut Block) {
        // SAFETY: `row` runs over the rows of a block, which columns and outputs hold.
        unsafe {
            let zero = L::all(0.0);
            for row in (0..ROWS).step_by(L::ROWS) {
                let (sa, ca) = sin_cos(L::load(joints[0].as_ptr().add(row)));
                let (sb, cb) = sin_cos(L::load(joints[1].as_ptr().add(row)));
                let (sg, cg) = sin_cos(L::load(joints[2].as_ptr().add(row)));
                let (sa_cb, sa_sb, ca_cb, ca_sb) = (sa.times(cb), sa.times(sb), ca.times(cb), ca.times(sb));
                // The inner frame's x and y axes in the ground frame.
                let xx = ca.times_minus(cg, sa_cb.times(sg));
                let yx = ca.times_plus(sg, sa_cb.times(cg));
                let xy = sa.times_plus(cg, ca_cb.times(sg));
                let yy = sa.times_minus(sg, ca_cb.times(cg));
                let (xz, yz) = (sb.times(sg), sb.times(cg));
                let minus = |value: L| zero.minus(value);
                let values = [
                    ca,
                    sa,
                    minus(sa),
                    cb,
                    minus(cb),
                    sb,
                    minus(sb),
                    sa_cb,
                    minus(sa_cb),
                    sa_sb,
                    minus(sa_sb),
                    ca_cb,
                    minus(ca_cb),
                    ca_sb,
                    minus(ca_sb),
                    xx,
                    yx,
                    minus(yx),
                    xy,
                    yy,
                    minus(yy),
                    xz,
                    yz,
                    minus(yz),
                ];
                for (column, value) in out.iter_mut().zip(values) {
                    value.store(column.as_mut_ptr().add(row));
                }
            }
        }
    }
}
