//! Axes and vectors of three components, a register each.

use super::lanes::Lanes;

/// Three components.
pub type Three<L> = [L; 3];

/// The same vector in every row.
#[inline(always)]
pub unsafe fn all<L: Lanes>(v: [f64; 3]) -> Three<L> {
    unsafe { [L::all(v[0]), L::all(v[1]), L::all(v[2])] }
}

/// a·s + b.
#[inline(always)]
pub unsafe fn times_plus<L: Lanes>(a: Three<L>, s: L, b: Three<L>) -> Three<L> {
    unsafe { [a[0].times_plus(s, b[0]), a[1].times_plus(s, b[1]), a[2].times_plus(s, b[2])] }
}

/// a·s.
#[inline(always)]
pub unsafe fn times<L: Lanes>(a: Three<L>, s: L) -> Three<L> {
    unsafe { [a[0].times(s), a[1].times(s), a[2].times(s)] }
}

/// The vector with coordinates `v` along axes `m`.
#[inline(always)]
pub unsafe fn along<L: Lanes>(m: &[Three<L>; 3], v: [f64; 3]) -> Three<L> {
    unsafe {
        let v = all::<L>(v);
        times_plus(m[0], v[0], times_plus(m[1], v[1], times(m[2], v[2])))
    }
}

/// The same for a vector across one of the axes: a·s + b·t.
#[inline(always)]
pub unsafe fn across<L: Lanes>(a: Three<L>, s: f64, b: Three<L>, t: f64) -> Three<L> {
    unsafe { times_plus(a, L::all(s), times(b, L::all(t))) }
}

/// Vector product.
#[inline(always)]
pub unsafe fn cross<L: Lanes>(a: Three<L>, b: Three<L>) -> Three<L> {
    unsafe {
        [
            a[1].times_minus(b[2], a[2].times(b[1])),
            a[2].times_minus(b[0], a[0].times(b[2])),
            a[0].times_minus(b[1], a[1].times(b[0])),
        ]
    }
}

/// Two axes turned about the third.
#[inline(always)]
pub unsafe fn turned<L: Lanes>(a: Three<L>, b: Three<L>, s: L, c: L) -> (Three<L>, Three<L>) {
    unsafe {
        let (a_s, b_s) = (times(a, s), times(b, s));
        (
            times_plus(a, c, b_s),
            [b[0].times_minus(c, a_s[0]), b[1].times_minus(c, a_s[1]), b[2].times_minus(c, a_s[2])],
        )
    }
}

/// Rows of a matrix times a vector, plus another.
#[inline(always)]
pub unsafe fn matrix_times_plus<L: Lanes>(m: &[Three<L>; 3], v: Three<L>, plus: Three<L>) -> Three<L> {
    unsafe {
        [
            v[0].times_plus(m[0][0], v[1].times_plus(m[0][1], v[2].times_plus(m[0][2], plus[0]))),
            v[0].times_plus(m[1][0], v[1].times_plus(m[1][1], v[2].times_plus(m[1][2], plus[1]))),
            v[0].times_plus(m[2][0], v[1].times_plus(m[2][1], v[2].times_plus(m[2][2], plus[2]))),
        ]
    }
}
