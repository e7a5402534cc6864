/*
 * Sine and cosine in single precision, by whole numbers and float alone: the algorithm of trueaxis' Rust kernel,
 * operation by operation, so that both give the same bits (compile with -ffp-contract=off for that, and never with
 * -ffast-math). Every angle takes the same instructions.
 */
#include <stdint.h>

#ifdef __FAST_MATH__
#error "trueaxis: the sine and cosine rely on the order of operations; compile without -ffast-math"
#endif

#if defined(__GNUC__) || defined(__clang__)
#define TRUEAXIS_INLINE static inline __attribute__((always_inline, unused))
#else
#define TRUEAXIS_INLINE static inline
#endif

union trueaxis_word {
    float number;
    uint32_t bits;
};

TRUEAXIS_INLINE uint32_t trueaxis_bits(float number)
{
    union trueaxis_word word;
    word.number = number;
    return word.bits;
}

TRUEAXIS_INLINE float trueaxis_number(uint32_t bits)
{
    union trueaxis_word word;
    word.bits = bits;
    return word.number;
}

/* 2/pi as a binary fraction, after two words of zeros so that no angle starts before the first. */
static const uint32_t trueaxis_two_over_pi[10] = {
    0, 0, 0xa2f9836eu, 0x4e441529u, 0xfc2757d1u, 0xf534ddc0u, 0xdb629599u, 0x3c439041u, 0xfe5163abu, 0xdebbc561u,
};

/* 32 bits of it from some bit on. */
TRUEAXIS_INLINE uint64_t trueaxis_window(uint32_t word, uint32_t bit)
{
    return (uint32_t)(trueaxis_two_over_pi[word] << bit | trueaxis_two_over_pi[word + 1] >> 1 >> (31 - bit));
}

/* What is left of an angle beside quarter turns, as a sum of two numbers, and how many those are. */
TRUEAXIS_INLINE uint32_t trueaxis_reduce(float x, float *r_out, float *low_out)
{
    const uint32_t bits = trueaxis_bits(x);
    uint32_t exponent = bits >> 23 & 0xff;
    /* All ones where the angle is below 0.5, which is left as it is; and where it is no finite number. */
    const uint32_t is_small = 0u - ((exponent - 126u) >> 31);
    const uint32_t is_none = 0u - ((254u - exponent) >> 31);

    /* |x| = mantissa * 2^(exponent - 150). Bits of 2/pi that only add whole turns are passed over. */
    exponent = (exponent & ~is_small & ~is_none) | (126u & (is_small | is_none));
    const uint64_t mantissa = (bits & 0x7fffffu) | 0x800000u;
    const uint32_t start = exponent - 88u;
    const uint32_t word = start / 32, bit = start % 32;
    const uint64_t a = trueaxis_window(word, bit);
    const uint64_t b = trueaxis_window(word + 1, bit);
    const uint64_t c = trueaxis_window(word + 2, bit);
    const uint64_t middle_bits = mantissa * b + ((mantissa * c) >> 32);
    const uint64_t turns = (mantissa * a + (middle_bits >> 32)) << 32 | (middle_bits & 0xffffffffu);

    /* Two bits of quarter turns, rounded to the nearest; what is left is a fraction of one, with its sign. */
    const uint64_t left = turns << 2;
    const uint64_t beyond_half = left >> 63;
    uint32_t quarters = (uint32_t)((turns >> 62) + beyond_half);
    const uint64_t size = (left ^ (0u - beyond_half)) + beyond_half;

    /* Times pi/2: the upper half of the product with pi/4, in units of 2^-63. */
    const uint64_t size_high = size >> 32, size_low = size & 0xffffffffu;
    const uint64_t by_high = 0xc90fdaa2u, by_low = 0x2168c235u;
    const uint64_t carried = ((size_low * by_low) >> 32) + ((size_high * by_low) & 0xffffffffu) +
        ((size_low * by_high) & 0xffffffffu);
    const uint64_t product = size_high * by_high + ((size_high * by_low) >> 32) + ((size_low * by_high) >> 32) +
        (carried >> 32);
    /* In three parts that float holds exactly; what rounding takes from their sums goes to `low`. */
    const float high = (float)(int32_t)(product >> 40) * 1.1920928955078125e-07f;
    const float middle = (float)(int32_t)(product >> 16 & 0xffffffu) * 7.105427357601002e-15f;
    const float last = (float)(int32_t)(product & 0xffffu) * 1.0842021724855044e-19f;
    const float rest = middle + last;
    const float r = high + rest;
    const float low = (rest - (r - high)) + (last - (rest - middle));

    /* The sign of the remainder, and that of the angle, which turns the other way. */
    const uint32_t backwards = bits >> 31;
    const uint32_t sign = ((uint32_t)beyond_half ^ backwards) << 31;
    quarters = (quarters ^ (0u - backwards)) + backwards;
    *r_out = trueaxis_number(((trueaxis_bits(r) ^ sign) & ~is_small) | (bits & is_small) | (is_none & 0x7fc00000u));
    *low_out = trueaxis_number((trueaxis_bits(low) ^ sign) & ~is_small);
    return quarters & ~is_small;
}

/* At most 1 unit in the last place off for any angle; not a number where it is no finite number. */
TRUEAXIS_INLINE void trueaxis_sin_cos(float x, float *sine_out, float *cosine_out)
{
    float r, low;
    const uint32_t quarters = trueaxis_reduce(x, &r, &low);
    const float square = r * r;

    float s = -0.0001951829035533592f;
    s = s * square + 0.008332189172506332f;
    s = s * square - 0.16666655242443085f;
    const float sine = r + ((r * square) * s + low);

    float c = 2.4432327336398885e-05f;
    c = c * square - 0.0013887309469282627f;
    c = c * square + 0.04166664555668831f;
    /* cos(r + low) = 1 - r^2/2 + (r^4 c - r low): the half square keeps what rounding takes from it. */
    const float half = 0.5f * square;
    const float top = 1.0f - half;
    const float cosine = top + (((1.0f - top) - half) + ((square * square) * c - r * low));

    /* Masks, which no compiler turns into jumps. */
    const uint32_t swapped = (trueaxis_bits(sine) ^ trueaxis_bits(cosine)) & (0u - (quarters & 1u));
    const uint32_t sine_sign = (quarters << 30) & 0x80000000u;
    const uint32_t cosine_sign = ((quarters << 30) ^ (quarters << 31)) & 0x80000000u;
    *sine_out = trueaxis_number(trueaxis_bits(sine) ^ swapped ^ sine_sign);
    *cosine_out = trueaxis_number(trueaxis_bits(cosine) ^ swapped ^ cosine_sign);
}

/* `x` between 0 and 1, and the nearer of the two outside; NaN stays NaN. */
TRUEAXIS_INLINE float trueaxis_saturate(float x)
{
    return x <= 0.0f ? 0.0f : x >= 1.0f ? 1.0f : x;
}

/* 1 from 0 on, 0 below; NaN stays NaN. */
TRUEAXIS_INLINE float trueaxis_step(float x)
{
    return x >= 0.0f ? 1.0f : x < 0.0f ? 0.0f : x;
}
