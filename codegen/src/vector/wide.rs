// Angles beyond the reach of the fast reduction: Payne and Hanek's, with as many bits of 2/π as the angle needs.
//
// Source: M. Payne, R. Hanek, Radian reduction for trigonometric functions, SIGNUM Newsletter 18 (1983) 19-24.
// Whole numbers do the work, so that every path and `kernel.c` find the same remainder.

/// 2/π as a binary fraction, after one word of zeros so that no angle starts before the first.
const TWO_OVER_PI_WORDS: [u64; 20] = [
    0,
    0xa2f9_836e_4e44_1529,
    0xfc27_57d1_f534_ddc0,
    0xdb62_9599_3c43_9041,
    0xfe51_63ab_debb_c561,
    0xb724_6e3a_424d_d2e0,
    0x0649_2eea_09d1_921c,
    0xfe1d_eb1c_b129_a73e,
    0xe882_35f5_2ebb_4484,
    0xe99c_7026_b45f_7e41,
    0x3991_d639_8353_39f4,
    0x9c84_5f8b_bdf9_283b,
    0x1ff8_97ff_de05_980f,
    0xef2f_118b_5a0a_6d1f,
    0x6d36_7ecf_27cb_09b7,
    0x4f46_3f66_9e5f_ea2d,
    0x7527_bac7_ebe5_f17b,
    0x3d07_39f7_8a52_92ea,
    0x6bfb_5fb1_1f8d_5d08,
    0x5603_3046_fc7b_6bab,
];

/// Upper half of the product.
#[inline]
fn product_high(a: u64, b: u64) -> u64 {
    const LOW: u64 = 0xffff_ffff;
    let middle = (a >> 32) * (b & LOW) + (((a & LOW) * (b & LOW)) >> 32);
    let other = (a & LOW) * (b >> 32) + (middle & LOW);
    (a >> 32) * (b >> 32) + (middle >> 32) + (other >> 32)
}

/// Sine and cosine of an angle with |x| > 1; NaN where it is no finite number.
#[cold]
fn sin_cos_wide<A: Arithmetic>(arithmetic: A, x: f64) -> (f64, f64) {
    if !x.is_finite() {
        return (f64::NAN, f64::NAN);
    }
    // |x| = mantissa · 2^(exponent - 1075). Bits of 2/π that only add whole turns are passed over.
    let exponent = (x.to_bits() >> 52) as usize & 0x7ff;
    let mantissa = x.to_bits() & ((1 << 52) - 1) | 1 << 52;
    let start = exponent - 1013;
    let (word, bit) = (start / 64, start % 64);
    let bits = |word: usize| {
        let next = if bit == 0 { 0 } else { TWO_OVER_PI_WORDS[word + 1] >> (64 - bit) };
        TWO_OVER_PI_WORDS[word] << bit | next
    };
    let (a, b, c) = (bits(word), bits(word + 1), bits(word + 2));

    // The product as a fraction of a turn: 192 bits, of which the last 53 are not all right.
    let last = mantissa.wrapping_mul(c);
    let (middle, carry) = mantissa.wrapping_mul(b).overflowing_add(product_high(mantissa, c));
    let first =
        mantissa.wrapping_mul(a).wrapping_add(product_high(mantissa, b)).wrapping_add(u64::from(carry));

    // Two bits of quarter turns, rounded to the nearest; what is left is a fraction of one, with its sign.
    let mut quarters = first >> 62;
    let mut high = first << 2 | middle >> 62;
    let mut low = middle << 2 | last >> 62;
    let beyond_half = high >> 63 == 1;
    if beyond_half {
        quarters += 1;
        low = (!low).wrapping_add(1);
        high = (!high).wrapping_add(u64::from(low == 0));
    }
    // No f64 is so near to a multiple of π/2 that `high` is all zeros.
    let zeros = high.leading_zeros().min(63);
    if zeros > 0 {
        high = high << zeros | low >> (64 - zeros);
        low <<= zeros;
    }
    let scale = f64::from_bits(u64::from(1023 - 64 - zeros) << 52);
    let big = (high >> 11) as f64 * 2048.0 * scale;
    let small = ((high & 0x7ff) << 53 | low >> 11) as f64 * (scale / 9007199254740992.0);

    // Times π/2, in halves of 26 bits so that the products are exact.
    let big_head = f64::from_bits(big.to_bits() & !0x7ff_ffff);
    let big_tail = big - big_head;
    let product = big * HALF_PI;
    let error = big_tail * 1.5893254712295857e-8
        - (((product - big_head * 1.5707963109016418) - big_tail * 1.5707963109016418)
            - big_head * 1.5893254712295857e-8);
    let rest = error + (big * 6.123233995736766e-17 + small * HALF_PI);
    let r = product + rest;
    let left = (product - r) + rest;

    // The sign of the remainder, and that of the angle, which turns the other way.
    let backwards = x < 0.0;
    let sign = if beyond_half == backwards { 1.0 } else { -1.0 };
    let quarters = if backwards { quarters.wrapping_neg() } else { quarters };
    sin_cos_reduced(arithmetic, sign * r, sign * left, quarters)
}
