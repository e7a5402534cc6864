//! Sine and cosine in the fewest known operations that keep below 1 ulp for |x| ≤ 1e6: no test for larger angles.
//!
//! Method and constants are those of the generated code (`codegen/src/vector/kernel.rs`), written out again by hand.

use super::lanes::Lanes;

/// Sine and cosine of angles, rad.
///
/// # Safety
/// The processor has the instructions of `L`.
#[inline(always)]
pub unsafe fn sin_cos<L: Lanes>(x: L) -> (L, L) {
    unsafe {
        let all = |value| L::all(value);
        let rounder = all(6755399441055744.0);
        let rounded = x.times_plus(all(core::f64::consts::FRAC_2_PI), rounder);
        let quarters = rounded.minus(rounder);
        let first = quarters.times_from(all(core::f64::consts::FRAC_PI_2), x);
        let middle = all(6.12323399538461e-17);
        let r = quarters.times_from(middle, first);
        let low = quarters.times_from(middle, first.minus(r));
        let low = quarters.times_from(all(3.5215598651832e-27), low);
        let square = r.times(r);

        let s = square.times_plus(all(1.5895433056632474e-10), all(-2.5050734386448547e-08));
        let s = square.times_plus(s, all(2.755731353850391e-06));
        let s = square.times_plus(s, all(-0.00019841269829358517));
        let s = square.times_plus(s, all(0.00833333333332184));
        let s = square.times_plus(s, all(-0.1666666666666663));
        let sine = r.plus(r.times(square).times_plus(s, low));

        let c = square.times_plus(all(-1.1358749250041842e-11), all(2.087570539641511e-09));
        let c = square.times_plus(c, all(-2.7557314217041915e-07));
        let c = square.times_plus(c, all(2.4801587289002086e-05));
        let c = square.times_plus(c, all(-0.0013888888888873342));
        let c = square.times_plus(c, all(0.041666666666666595));
        let rest = square.times(square).times_minus(c, r.times(low));
        let cosine = r.times(all(-0.5)).times_plus(r, rest).plus(all(1.0));
        L::turn(sine, cosine, rounded)
    }
}
