// Sine and cosine in single precision, by whole numbers and f32 alone, for processors that have no f64.
//
// This text goes unchanged into generated Rust files of single precision; `single.c` is the same in C, bit for bit. Every
// angle takes the same instructions: one product with 96 bits of 2/π gives quarter turns and what is left of one.
//
// Source: M. Payne, R. Hanek, Radian reduction for trigonometric functions, SIGNUM Newsletter 18 (1983) 19-24.
// `minimax.py` derives the polynomials.

/// 2/π as a binary fraction, after two words of zeros so that no angle starts before the first.
const TWO_OVER_PI_WORDS: [u32; 10] = [
    0,
    0,
    0xa2f9_836e,
    0x4e44_1529,
    0xfc27_57d1,
    0xf534_ddc0,
    0xdb62_9599,
    0x3c43_9041,
    0xfe51_63ab,
    0xdebb_c561,
];

/// π/4 as a fraction of 2^64.
const QUARTER_PI: u64 = 0xc90f_daa2_2168_c235;

/// Sine and cosine of an angle, rad: at most 1 unit in the last place off for any angle; NaN where it is no finite number.
#[must_use]
#[inline]
pub fn sin_cos(x: f32) -> (f32, f32) {
    let (r, low, quarters) = reduce(x);
    let square = r * r;

    let mut s = -0.0001951829035533592_f32;
    s = s * square + 0.008332189172506332;
    s = s * square - 0.16666655242443085;
    let sine = r + ((r * square) * s + low);

    let mut c = 2.4432327336398885e-05_f32;
    c = c * square - 0.0013887309469282627;
    c = c * square + 0.04166664555668831;
    // cos(r + low) = 1 - r²/2 + (r⁴ c - r low): the half square keeps what rounding takes from it.
    let half = 0.5 * square;
    let top = 1.0 - half;
    let cosine = top + (((1.0 - top) - half) + ((square * square) * c - r * low));

    // Masks, which no compiler turns into jumps.
    let (sine, cosine) = (sine.to_bits(), cosine.to_bits());
    let swapped = (sine ^ cosine) & 0_u32.wrapping_sub(quarters & 1);
    let sine_sign = (quarters << 30) & (1 << 31);
    let cosine_sign = ((quarters << 30) ^ (quarters << 31)) & (1 << 31);
    (f32::from_bits(sine ^ swapped ^ sine_sign), f32::from_bits(cosine ^ swapped ^ cosine_sign))
}

/// What is left of an angle beside quarter turns, as a sum of two numbers, and how many those are.
#[inline]
fn reduce(x: f32) -> (f32, f32, u32) {
    let bits = x.to_bits();
    let exponent = bits >> 23 & 0xff;
    // All ones where the angle is below 0.5, which is left as it is; and where it is no finite number.
    let is_small = 0_u32.wrapping_sub(exponent.wrapping_sub(126) >> 31);
    let is_none = 0_u32.wrapping_sub(254_u32.wrapping_sub(exponent) >> 31);

    // |x| = mantissa · 2^(exponent - 150). Bits of 2/π that only add whole turns are passed over.
    let exponent = (exponent & !is_small & !is_none) | (126 & (is_small | is_none));
    let mantissa = u64::from(bits & 0x7f_ffff | 0x80_0000);
    let start = exponent - 88;
    let (word, bit) = ((start / 32) as usize, start % 32);
    let window = |word: usize| {
        let (first, second) = (TWO_OVER_PI_WORDS[word], TWO_OVER_PI_WORDS[word + 1]);
        u64::from(first << bit | second >> 1 >> (31 - bit))
    };
    let (a, b, c) = (window(word), window(word + 1), window(word + 2));
    let middle = mantissa * b + ((mantissa * c) >> 32);
    let turns = (mantissa * a + (middle >> 32)) << 32 | middle & 0xffff_ffff;

    // Two bits of quarter turns, rounded to the nearest; what is left is a fraction of one, with its sign.
    let left = turns << 2;
    let beyond_half = left >> 63;
    let quarters = ((turns >> 62) + beyond_half) as u32;
    let size = (left ^ 0_u64.wrapping_sub(beyond_half)).wrapping_add(beyond_half);

    // Times π/2: the upper half of the product with π/4, in units of 2^-63.
    let (high, low) = (size >> 32, size & 0xffff_ffff);
    let (by_high, by_low) = (QUARTER_PI >> 32, QUARTER_PI & 0xffff_ffff);
    let carried = ((low * by_low) >> 32) + ((high * by_low) & 0xffff_ffff) + ((low * by_high) & 0xffff_ffff);
    let product = high * by_high + ((high * by_low) >> 32) + ((low * by_high) >> 32) + (carried >> 32);
    // In three parts that f32 holds exactly; what rounding takes from their sums goes to `low`.
    let high = (product >> 40) as i32 as f32 * 1.1920928955078125e-07;
    let middle = (product >> 16 & 0xff_ffff) as i32 as f32 * 7.105427357601002e-15;
    let last = (product & 0xffff) as i32 as f32 * 1.0842021724855044e-19;
    let rest = middle + last;
    let r = high + rest;
    let low = (rest - (r - high)) + (last - (rest - middle));

    // The sign of the remainder, and that of the angle, which turns the other way.
    let backwards = bits >> 31;
    let sign = (beyond_half as u32 ^ backwards) << 31;
    let quarters = (quarters ^ 0_u32.wrapping_sub(backwards)).wrapping_add(backwards);
    let r = (r.to_bits() ^ sign) & !is_small | bits & is_small | is_none & 0x7fc0_0000;
    let low = (low.to_bits() ^ sign) & !is_small;
    (f32::from_bits(r), f32::from_bits(low), quarters & !is_small)
}

/// `x` between 0 and 1, and the nearer of the two outside; NaN stays NaN.
#[inline(always)]
pub fn saturate(x: f32) -> f32 {
    x.clamp(0.0, 1.0)
}

/// 1 from 0 on, 0 below; NaN stays NaN.
#[inline(always)]
pub fn step(x: f32) -> f32 {
    if x >= 0.0 {
        1.0
    } else if x < 0.0 {
        0.0
    } else {
        x
    }
}
