// Sine and cosine of many angles at once, without branches, tables or dependencies.
//
// This text is compiled into this crate and goes, with `paths.rs` and `wide.rs`, unchanged into generated Rust files;
// `kernel.c` is the same algorithm in C, bit for bit. Method: take away the nearest multiple of π/2 in parts (Cody and
// Waite), keep what is left as a sum of two numbers, evaluate one polynomial each for sine and cosine on |r| ≤ π/4, and
// swap and negate by the quadrant. Angles beyond `WIDEST` go through `wide.rs`. `minimax.py` derives the constants.

/// The largest angle, rad, that the fast reduction is made for: 20 bits of quadrant number.
pub const WIDEST: f64 = 1.0e6;

/// Rows that are worked on together.
pub const ROWS: usize = 64;

const TWO_OVER_PI: f64 = core::f64::consts::FRAC_2_PI;
const HALF_PI: f64 = core::f64::consts::FRAC_PI_2;
/// Adding 1.5·2^52 rounds to a whole number, which then stands in the low bits.
const ROUNDER: f64 = 6755399441055744.0;

/// Sine and cosine, at most 1 ulp off, for |x| ≤ [`WIDEST`]; NaN for NaN. Anything else for other angles.
#[inline(always)]
pub fn sin_cos_narrow<A: Arithmetic>(arithmetic: A, x: f64) -> (f64, f64) {
    let (r, low, quarters) = reduce_narrow(arithmetic, x);
    sin_cos_reduced(arithmetic, r, low, quarters)
}

/// What is left of an angle with |x| ≤ [`WIDEST`] beside quarter turns, as a sum of two numbers, and in the low bits
/// how many those are.
#[inline(always)]
fn reduce_narrow<A: Arithmetic>(arithmetic: A, x: f64) -> (f64, f64, u64) {
    let rounded = arithmetic.mul_add(x, TWO_OVER_PI, ROUNDER);
    let quarters = rounded - ROUNDER;
    let (r, low) = if A::FUSED {
        // The first difference is exact, and what rounding takes from the second goes to `low`: the product with the
        // 33 bits is exact, so that nothing is lost when both nearly cancel.
        let first = arithmetic.mul_add(-quarters, HALF_PI, x);
        let r = arithmetic.mul_add(-quarters, 6.12323399538461e-17, first);
        let low = arithmetic.mul_add(-quarters, 6.12323399538461e-17, first - r);
        (r, arithmetic.mul_add(-quarters, 3.5215598651832e-27, low))
    } else {
        // π/2 in words of 33 bits: three exact products, and differences that are exact wherever they cancel.
        let first = x - quarters * 1.5707963267341256;
        let second = quarters * 6.077100506303966e-11;
        let third = quarters * 2.0222662487111665e-21;
        let fourth = quarters * 8.4784276603689e-32;
        let middle = first - second;
        let left = ((first - middle) - second) - third;
        let r = middle + left;
        (r, ((middle - r) + left) - fourth)
    };
    (r, low, rounded.to_bits())
}

/// Sine and cosine of r + low + quarters·π/2, where |r| ≤ π/4 and `low` is at most half a unit in r's last place.
#[inline(always)]
fn sin_cos_reduced<A: Arithmetic>(arithmetic: A, r: f64, low: f64, quarters: u64) -> (f64, f64) {
    let (sine, cosine) = sin_cos_near_zero(arithmetic, r, low);
    let swap = quarters & 1 == 1;
    let (sine, cosine) = if swap { (cosine, sine) } else { (sine, cosine) };
    with_signs(sine.to_bits(), cosine.to_bits(), quarters)
}

/// Sine and cosine of r + low, where |r| ≤ π/4.
#[inline(always)]
fn sin_cos_near_zero<A: Arithmetic>(arithmetic: A, r: f64, low: f64) -> (f64, f64) {
    let square = r * r;

    let mut s = 1.5895433056632474e-10;
    s = arithmetic.mul_add(s, square, -2.5050734386448547e-08);
    s = arithmetic.mul_add(s, square, 2.755731353850391e-06);
    s = arithmetic.mul_add(s, square, -0.00019841269829358517);
    s = arithmetic.mul_add(s, square, 0.00833333333332184);
    s = arithmetic.mul_add(s, square, -0.1666666666666663);
    let sine = r + arithmetic.mul_add(r * square, s, low);

    let mut c = -1.1358749250041842e-11;
    c = arithmetic.mul_add(c, square, 2.087570539641511e-09);
    c = arithmetic.mul_add(c, square, -2.7557314217041915e-07);
    c = arithmetic.mul_add(c, square, 2.4801587289002086e-05);
    c = arithmetic.mul_add(c, square, -0.0013888888888873342);
    c = arithmetic.mul_add(c, square, 0.041666666666666595);
    // cos(r + low) = 1 - r²/2 + (r⁴ c - r low): the half square keeps what rounding takes from it.
    let rest = arithmetic.mul_add(square * square, c, -(r * low));
    let cosine = if A::FUSED {
        1.0 + arithmetic.mul_add(-0.5 * r, r, rest)
    } else {
        let half = 0.5 * square;
        let top = 1.0 - half;
        top + (((1.0 - top) - half) + rest)
    };
    (sine, cosine)
}

/// The signs of sine and cosine after some quarter turns.
#[inline(always)]
fn with_signs(sine: u64, cosine: u64, quarters: u64) -> (f64, f64) {
    let sine_sign = (quarters << 62) & (1 << 63);
    let cosine_sign = ((quarters << 62) ^ (quarters << 63)) & (1 << 63);
    (f64::from_bits(sine ^ sine_sign), f64::from_bits(cosine ^ cosine_sign))
}

/// Sine and cosine of one angle, rad, by the same instructions for every angle: as [`sin_cos`] for |x| ≤ [`WIDEST`], NaN
/// for all others. Choices are made by masks, which no compiler turns into jumps.
#[must_use]
#[inline]
pub fn sin_cos_without_branch(x: f64) -> (f64, f64) {
    // Bits of positive numbers are ordered as the numbers: all ones where the difference is negative, all zeros elsewhere.
    let beyond = x.abs().to_bits().wrapping_sub(WIDEST.to_bits() + 1);
    let in_reach = 0_u64.wrapping_sub(beyond >> 63);
    let x = f64::from_bits(x.to_bits() & in_reach | f64::NAN.to_bits() & !in_reach);
    let (r, low, quarters) = reduce_narrow(Portable, x);
    let (sine, cosine) = sin_cos_near_zero(Portable, r, low);
    let (sine, cosine) = (sine.to_bits(), cosine.to_bits());
    let swapped = (sine ^ cosine) & 0_u64.wrapping_sub(quarters & 1);
    with_signs(sine ^ swapped, cosine ^ swapped, quarters)
}

/// Sine and cosine of any angle, rad: at most 1 ulp off for |x| ≤ [`WIDEST`], and for all others; NaN where
/// the angle is no finite number.
#[inline(always)]
pub fn sin_cos_with<A: Arithmetic>(arithmetic: A, x: f64) -> (f64, f64) {
    if x.abs() <= WIDEST { sin_cos_narrow(arithmetic, x) } else { sin_cos_wide(arithmetic, x) }
}

/// Sine and cosine of one angle, rad, the same on every processor: see [`sin_cos_with`].
#[must_use]
pub fn sin_cos(x: f64) -> (f64, f64) {
    sin_cos_with(Portable, x)
}

/// Where sines and cosines of a block of angles go, not yet written: a block is too small to be written twice. It starts
/// a cache line, so that no register of 64 bytes is stored across two; and since that aligns the frame it lies in, nothing
/// is that the compiler keeps there for want of registers (without it, such code takes twice the time in every other call).
#[repr(align(64))]
pub struct Waves([[core::mem::MaybeUninit<f64>; ROWS]; 2]);

impl Waves {
    /// Nothing yet.
    pub const NEW: Self = Self([[core::mem::MaybeUninit::uninit(); ROWS]; 2]);
}

/// A column of at most a block as a whole block: itself, or if it is shorter, in `space` with zeros after it.
#[inline(always)]
pub fn whole<'a>(column: &'a [f64], space: &'a mut Option<[f64; ROWS]>) -> &'a [f64; ROWS] {
    if let Ok(column) = column.try_into() {
        return column;
    }
    let space = space.insert([0.0; ROWS]);
    for (space, &value) in space.iter_mut().zip(column) {
        *space = value;
    }
    space
}

/// Whether all angles of some blocks are within [`WIDEST`]: one answer for all rows, so that the loops over them have no
/// branches. Blocks that hold another angle, or what is no number, are done right too, only slower.
#[inline(always)]
pub fn are_narrow<const COLUMNS: usize>(columns: [&[f64; ROWS]; COLUMNS]) -> bool {
    // Bits of positive numbers are ordered as the numbers: a difference below zero sets the highest bit.
    let mut differences = 0;
    for column in columns {
        for x in column {
            differences |= WIDEST.to_bits().wrapping_sub(x.abs().to_bits());
        }
    }
    differences >> 63 == 0
}

/// Sine and cosine of an angle, rad, inside a loop over rows: see [`sin_cos_with`]. `NARROW` is what [`are_narrow`] says.
#[inline(always)]
pub fn sin_cos_in_loop<A: Arithmetic, const NARROW: bool>(arithmetic: A, x: f64) -> (f64, f64) {
    if NARROW { sin_cos_narrow(arithmetic, x) } else { sin_cos_with(arithmetic, x) }
}

/// Sines and cosines of a block of angles, rad: see [`sin_cos_with`].
#[inline(always)]
pub fn sin_cos_rows<'a, A: Arithmetic>(
    arithmetic: A,
    x: &[f64; ROWS],
    waves: &'a mut Waves,
) -> (&'a [f64; ROWS], &'a [f64; ROWS]) {
    let Waves([sine, cosine]) = waves;
    if are_narrow([x]) {
        for row in 0..ROWS {
            let (s, c) = sin_cos_in_loop::<A, true>(arithmetic, x[row]);
            sine[row].write(s);
            cosine[row].write(c);
        }
    } else {
        for row in 0..ROWS {
            let (s, c) = sin_cos_in_loop::<A, false>(arithmetic, x[row]);
            sine[row].write(s);
            cosine[row].write(c);
        }
    }
    // SAFETY: either loop has written every row of both, and a `MaybeUninit<f64>` is laid out as an f64.
    unsafe { (&*core::ptr::from_ref(sine).cast(), &*core::ptr::from_ref(cosine).cast()) }
}

/// `x` between 0 and 1, and the nearer of the two outside; NaN stays NaN.
#[inline(always)]
pub fn saturate(x: f64) -> f64 {
    x.clamp(0.0, 1.0)
}

/// 1 from 0 on, 0 below; NaN stays NaN.
#[inline(always)]
pub fn step(x: f64) -> f64 {
    if x >= 0.0 {
        1.0
    } else if x < 0.0 {
        0.0
    } else {
        x
    }
}

/// The square root, at most a unit in the last place off; NaN below zero.
#[inline(always)]
pub fn root(x: f64) -> f64 {
    // Far below, powers of two keep the steps from losing digits.
    let (scaled, back) =
        if x < 1e-280 { (x * 1.6069380442589903e60, 7.888609052210118e-31) } else { (x, 1.0) };
    // Half the exponent is a root that is right to four per cent; each step of Newton's squares what is missing.
    let mut y = f64::from_bits((scaled.to_bits() >> 1) + 0x1ff7_a3be_a91d_9b1b);
    y = 0.5 * (y + scaled / y);
    y = 0.5 * (y + scaled / y);
    y = 0.5 * (y + scaled / y);
    y = 0.5 * (y + scaled / y);
    if x > 0.0 {
        y * back
    } else if x == 0.0 {
        0.0
    } else {
        f64::NAN
    }
}

/// The angle of the point (x, y), in (−π, π], at most two units in the last place off; 0 at the origin, NaN where a
/// coordinate is no finite number.
///
/// The smaller coordinate over the larger one, counted from the diagonal where it is nearer to that, leaves |r| ≤ tan π/8.
/// Source: S. Moshier, Cephes Mathematical Library (1989), `atan.c`, for the rational function.
#[inline(always)]
pub fn arc_tangent(y: f64, x: f64) -> f64 {
    const SIGN: u64 = 1 << 63;
    let (height, width) = (f64::from_bits(y.to_bits() & !SIGN), f64::from_bits(x.to_bits() & !SIGN));
    let is_steep = height > width;
    let (small, large) = if is_steep { (width, height) } else { (height, width) };
    let large = if large == 0.0 { 1.0 } else { large };
    let ratio = small / large;
    let is_diagonal = ratio > 0.41421356237309503;
    let r = if is_diagonal { (small - large) / (small + large) } else { ratio };
    let z = r * r;
    let mut above = -8.750608600031904122785e-1;
    above = above * z - 1.615753718733365076637e1;
    above = above * z - 7.500855792314704667340e1;
    above = above * z - 1.228866684490136173410e2;
    above = above * z - 6.485021904942025371773e1;
    let mut below = z + 2.485846490142306297962e1;
    below = below * z + 1.650270098316988542046e2;
    below = below * z + 4.328810604912902668951e2;
    below = below * z + 4.853903996359136964868e2;
    below = below * z + 1.945506571482613964425e2;
    let near = r * (z * above / below) + r;
    let octant = if is_diagonal { core::f64::consts::FRAC_PI_4 + (near + 3.061616997868383e-17) } else { near };
    let quarter = if is_steep { (core::f64::consts::FRAC_PI_2 - octant) + 6.123233995736766e-17 } else { octant };
    let half = if x < 0.0 { (core::f64::consts::PI - quarter) + 1.2246467991473532e-16 } else { quarter };
    f64::from_bits(half.to_bits() | y.to_bits() & SIGN)
}
