/*
 * Sine and cosine of many angles at once, without branches, tables or libraries: the algorithm of trueaxis' Rust
 * kernel, operation by operation, so that both give the same bits (compile with -ffp-contract=off for that, and never
 * with -ffast-math, which undoes the reduction). C99 and C++17; with GCC or Clang on x86-64 it is compiled for three
 * paths.
 */
#include <stdint.h>

/* Compilers of C++ have it under this name alone. */
#ifdef __cplusplus
#define restrict __restrict
#endif

#ifdef __FAST_MATH__
#error "trueaxis: the sine and cosine rely on the order of operations; compile without -ffast-math"
#endif

#if defined(__GNUC__) || defined(__clang__)
#define TRUEAXIS_INLINE static inline __attribute__((always_inline, unused))
#define TRUEAXIS_COLD static __attribute__((noinline, cold, unused))
#define TRUEAXIS_ALIGNED __attribute__((aligned(64)))
#else
#define TRUEAXIS_INLINE static inline
#define TRUEAXIS_COLD static
#define TRUEAXIS_ALIGNED
#endif

/* Which instructions vector code runs on. */
enum trueaxis_path {
    TRUEAXIS_PORTABLE = 0, /* what every processor of the target has; a*b + c is rounded twice */
    TRUEAXIS_V3 = 1,       /* x86-64-v3: AVX2 and FMA */
    TRUEAXIS_V4 = 2        /* x86-64-v4: AVX-512 F, BW, CD, DQ and VL, and FMA */
};

/* Without optimisation, calls of fma would be left, and -lm be needed. */
#if (defined(__GNUC__) || defined(__clang__)) && defined(__x86_64__) && defined(__OPTIMIZE__)
#define TRUEAXIS_HAS_PATHS 1
#define TRUEAXIS_TARGET_V3 __attribute__((target("avx2,fma")))
#define TRUEAXIS_TARGET_V4 __attribute__((target("avx512f,avx512bw,avx512cd,avx512dq,avx512vl,avx2,fma")))
#endif

/* The best path of this processor. */
TRUEAXIS_INLINE enum trueaxis_path trueaxis_path(void)
{
#ifdef TRUEAXIS_HAS_PATHS
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
        if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
            __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
            __builtin_cpu_supports("avx512vl"))
            return TRUEAXIS_V4;
        return TRUEAXIS_V3;
    }
#endif
    return TRUEAXIS_PORTABLE;
}

/* a*b + c; `fused` is a constant wherever this is inlined. */
TRUEAXIS_INLINE double trueaxis_mul_add(const int fused, double a, double b, double c)
{
#ifdef TRUEAXIS_HAS_PATHS
    if (fused)
        return __builtin_fma(a, b, c);
#else
    (void)fused;
#endif
    return a * b + c;
}

/* The largest angle, rad, that the fast reduction is made for: 20 bits of quadrant number. */
#define TRUEAXIS_WIDEST 1.0e6

/* Rows that are worked on together. */
#define TRUEAXIS_ROWS 64

union trueaxis_word {
    double number;
    uint64_t bits;
};

TRUEAXIS_INLINE uint64_t trueaxis_bits(double number)
{
    union trueaxis_word word;
    word.number = number;
    return word.bits;
}

TRUEAXIS_INLINE double trueaxis_number(uint64_t bits)
{
    union trueaxis_word word;
    word.bits = bits;
    return word.number;
}

/* Sine and cosine of r + low, where |r| <= pi/4 and low is about half a unit in r's last place. */
TRUEAXIS_INLINE void trueaxis_sin_cos_near_zero(const int fused, double r, double low, double *sine, double *cosine)
{
    const double square = r * r;
    double s, c, rest;

    s = 0x1.5d8b553ebac9bp-33;
    s = trueaxis_mul_add(fused, s, square, -0x1.ae5e4b83152adp-26);
    s = trueaxis_mul_add(fused, s, square, 0x1.71de35552aba6p-19);
    s = trueaxis_mul_add(fused, s, square, -0x1.a01a019be9213p-13);
    s = trueaxis_mul_add(fused, s, square, 0x1.111111110f730p-7);
    s = trueaxis_mul_add(fused, s, square, -0x1.5555555555548p-3);
    *sine = r + trueaxis_mul_add(fused, r * square, s, low);

    c = -0x1.8fa6848d36fc7p-37;
    c = trueaxis_mul_add(fused, c, square, 0x1.1ee9dbcf12a57p-29);
    c = trueaxis_mul_add(fused, c, square, -0x1.27e4f7f1916ccp-22);
    c = trueaxis_mul_add(fused, c, square, 0x1.a01a019c8f256p-16);
    c = trueaxis_mul_add(fused, c, square, -0x1.6c16c16c15015p-10);
    c = trueaxis_mul_add(fused, c, square, 0x1.555555555554bp-5);
    /* cos(r + low) = 1 - r^2/2 + (r^4 c - r low): the half square keeps what rounding takes from it. */
    rest = trueaxis_mul_add(fused, square * square, c, -(r * low));
    if (fused) {
        *cosine = 1.0 + trueaxis_mul_add(fused, -0.5 * r, r, rest);
    } else {
        const double half = 0.5 * square;
        const double top = 1.0 - half;
        *cosine = top + (((1.0 - top) - half) + rest);
    }
}

/* The signs of sine and cosine after some quarter turns. */
TRUEAXIS_INLINE void trueaxis_with_signs(uint64_t sine_bits, uint64_t cosine_bits, uint64_t quarters, double *sine,
                                         double *cosine)
{
    const uint64_t sine_sign = (quarters << 62) & 0x8000000000000000ULL;
    const uint64_t cosine_sign = ((quarters << 62) ^ (quarters << 63)) & 0x8000000000000000ULL;
    *sine = trueaxis_number(sine_bits ^ sine_sign);
    *cosine = trueaxis_number(cosine_bits ^ cosine_sign);
}

/* Sine and cosine of r + low + quarters*pi/2. */
TRUEAXIS_INLINE void trueaxis_sin_cos_reduced(const int fused, double r, double low, uint64_t quarters, double *sine,
                                              double *cosine)
{
    const int swap = (quarters & 1) != 0;
    double plain_sine, plain_cosine;
    trueaxis_sin_cos_near_zero(fused, r, low, &plain_sine, &plain_cosine);
    trueaxis_with_signs(trueaxis_bits(swap ? plain_cosine : plain_sine),
                        trueaxis_bits(swap ? plain_sine : plain_cosine), quarters, sine, cosine);
}

/* What is left of an angle with |x| <= TRUEAXIS_WIDEST beside quarter turns, as a sum of two numbers; in the low bits of
 * what is returned, how many those are. */
TRUEAXIS_INLINE uint64_t trueaxis_reduce_narrow(const int fused, double x, double *rest, double *rest_low)
{
    /* Adding 1.5*2^52 rounds to a whole number, which then stands in the low bits. */
    const double rounder = 0x1.8p52;
    const double rounded = trueaxis_mul_add(fused, x, 0x1.45f306dc9c883p-1, rounder);
    const double quarters = rounded - rounder;
    double r, low;
    if (fused) {
        /* The first difference is exact, and what rounding takes from the second goes to low: the product with
         * the 33 bits is exact, so that nothing is lost when both nearly cancel. */
        const double first = trueaxis_mul_add(fused, -quarters, 0x1.921fb54442d18p+0, x);
        r = trueaxis_mul_add(fused, -quarters, 0x1.1a62633100000p-54, first);
        low = trueaxis_mul_add(fused, -quarters, 0x1.1a62633100000p-54, first - r);
        low = trueaxis_mul_add(fused, -quarters, 0x1.1701b839a2520p-88, low);
    } else {
        /* pi/2 in words of 33 bits: three exact products, and differences that are exact wherever they cancel. */
        const double first = x - quarters * 0x1.921fb54400000p+0;
        const double second = quarters * 0x1.0b4611a600000p-34;
        const double third = quarters * 0x1.3198a2e000000p-69;
        const double fourth = quarters * 0x1.b839a252049c1p-104;
        const double middle = first - second;
        const double left = ((first - middle) - second) - third;
        r = middle + left;
        low = ((middle - r) + left) - fourth;
    }
    *rest = r;
    *rest_low = low;
    return trueaxis_bits(rounded);
}

/* Sine and cosine, at most 1 ulp off, for |x| <= TRUEAXIS_WIDEST; NaN for NaN. Anything else for other angles. */
TRUEAXIS_INLINE void trueaxis_sin_cos_narrow(const int fused, double x, double *sine, double *cosine)
{
    double r, low;
    const uint64_t quarters = trueaxis_reduce_narrow(fused, x, &r, &low);
    trueaxis_sin_cos_reduced(fused, r, low, quarters, sine, cosine);
}

/* The same by the same instructions for every angle, and NaN beyond TRUEAXIS_WIDEST: choices are made by masks, which no
 * compiler turns into jumps. */
TRUEAXIS_INLINE void trueaxis_sin_cos_without_branch(double x, double *sine, double *cosine)
{
    const uint64_t magnitude = trueaxis_bits(x) & 0x7fffffffffffffffULL;
    /* Bits of positive numbers are ordered as the numbers: all ones where the difference is negative, else zeros. */
    const uint64_t in_reach = 0 - ((magnitude - (trueaxis_bits(TRUEAXIS_WIDEST) + 1)) >> 63);
    const double angle = trueaxis_number((trueaxis_bits(x) & in_reach) | (0x7ff8000000000000ULL & ~in_reach));
    double r, low, plain_sine, plain_cosine;
    uint64_t quarters, sine_bits, cosine_bits, swapped;
    quarters = trueaxis_reduce_narrow(0, angle, &r, &low);
    trueaxis_sin_cos_near_zero(0, r, low, &plain_sine, &plain_cosine);
    sine_bits = trueaxis_bits(plain_sine);
    cosine_bits = trueaxis_bits(plain_cosine);
    swapped = (sine_bits ^ cosine_bits) & (0 - (quarters & 1));
    trueaxis_with_signs(sine_bits ^ swapped, cosine_bits ^ swapped, quarters, sine, cosine);
}

/* `x` between 0 and 1, and the nearer of the two outside; NaN stays NaN. */
TRUEAXIS_INLINE double trueaxis_saturate(double x)
{
    return x < 0.0 ? 0.0 : x > 1.0 ? 1.0 : x;
}

/* 1 from 0 on, 0 below; NaN stays NaN. */
TRUEAXIS_INLINE double trueaxis_step(double x)
{
    return x >= 0.0 ? 1.0 : x < 0.0 ? 0.0 : x;
}

/* The square root, at most a unit in the last place off; NaN below zero. */
TRUEAXIS_INLINE double trueaxis_root(double x)
{
    const double scaled = x < 1e-280 ? x * 1.6069380442589903e60 : x;
    const double back = x < 1e-280 ? 7.888609052210118e-31 : 1.0;
    double y = trueaxis_number((trueaxis_bits(scaled) >> 1) + 0x1ff7a3bea91d9b1bULL);
    y = 0.5 * (y + scaled / y);
    y = 0.5 * (y + scaled / y);
    y = 0.5 * (y + scaled / y);
    y = 0.5 * (y + scaled / y);
    return x > 0.0 ? y * back : x == 0.0 ? 0.0 : trueaxis_number(0x7ff8000000000000ULL);
}

/* The angle of the point (x, y); see `kernel.rs`. */
TRUEAXIS_INLINE double trueaxis_arc_tangent(double y, double x)
{
    const uint64_t sign = 0x8000000000000000ULL;
    const double height = trueaxis_number(trueaxis_bits(y) & ~sign);
    const double width = trueaxis_number(trueaxis_bits(x) & ~sign);
    const int is_steep = height > width;
    const double small = is_steep ? width : height, larger = is_steep ? height : width;
    const double large = larger == 0.0 ? 1.0 : larger, ratio = small / large;
    const int is_diagonal = ratio > 0.41421356237309503;
    const double r = is_diagonal ? (small - large) / (small + large) : ratio;
    const double z = r * r;
    double above = -8.750608600031904122785e-1, below = z + 2.485846490142306297962e1;
    double near, octant, quarter, half;
    above = above * z - 1.615753718733365076637e1;
    above = above * z - 7.500855792314704667340e1;
    above = above * z - 1.228866684490136173410e2;
    above = above * z - 6.485021904942025371773e1;
    below = below * z + 1.650270098316988542046e2;
    below = below * z + 4.328810604912902668951e2;
    below = below * z + 4.853903996359136964868e2;
    below = below * z + 1.945506571482613964425e2;
    near = r * (z * above / below) + r;
    octant = is_diagonal ? 0.7853981633974483 + (near + 3.061616997868383e-17) : near;
    quarter = is_steep ? (1.5707963267948966 - octant) + 6.123233995736766e-17 : octant;
    half = x < 0.0 ? (3.141592653589793 - quarter) + 1.2246467991473532e-16 : quarter;
    return trueaxis_number(trueaxis_bits(half) | (trueaxis_bits(y) & sign));
}

/* Upper half of the product. */
TRUEAXIS_INLINE uint64_t trueaxis_product_high(uint64_t a, uint64_t b)
{
    const uint64_t mask = 0xffffffffULL;
    const uint64_t middle = (a >> 32) * (b & mask) + (((a & mask) * (b & mask)) >> 32);
    const uint64_t other = (a & mask) * (b >> 32) + (middle & mask);
    return (a >> 32) * (b >> 32) + (middle >> 32) + (other >> 32);
}

/* The remainder of an angle with |x| > TRUEAXIS_WIDEST by as many bits of 2/pi as it needs. Source: M. Payne, R. Hanek,
 * Radian reduction for trigonometric functions, SIGNUM Newsletter 18 (1983) 19-24. */
TRUEAXIS_COLD uint64_t trueaxis_reduce_wide(double x, double *r, double *low_part)
{
    /* 2/pi as a binary fraction, after one word of zeros so that no angle starts before the first. */
    static const uint64_t words[20] = {
        0,
    0xa2f9836e4e441529ULL, 0xfc2757d1f534ddc0ULL, 0xdb6295993c439041ULL, 0xfe5163abdebbc561ULL,
    0xb7246e3a424dd2e0ULL, 0x06492eea09d1921cULL, 0xfe1deb1cb129a73eULL, 0xe88235f52ebb4484ULL,
    0xe99c7026b45f7e41ULL, 0x3991d639835339f4ULL, 0x9c845f8bbdf9283bULL, 0x1ff897ffde05980fULL,
    0xef2f118b5a0a6d1fULL, 0x6d367ecf27cb09b7ULL, 0x4f463f669e5fea2dULL, 0x7527bac7ebe5f17bULL,
    0x3d0739f78a5292eaULL, 0x6bfb5fb11f8d5d08ULL, 0x56033046fc7b6babULL,
    };
    /* |x| = mantissa * 2^(exponent - 1075). Bits of 2/pi that only add whole turns are passed over. */
    const unsigned exponent = (unsigned)(trueaxis_bits(x) >> 52) & 0x7ff;
    const uint64_t mantissa = (trueaxis_bits(x) & 0xfffffffffffffULL) | 0x10000000000000ULL;
    const unsigned start = exponent - 1013;
    uint64_t part[3], last, middle, first, quarters, high, low;
    unsigned k, zeros;
    int beyond_half, backwards;
    double scale, big, small, big_head, big_tail, product, error, rest, sign;
    for (k = 0; k < 3; k++) {
        const uint64_t *word = words + start / 64 + k;
        part[k] = start % 64 == 0 ? word[0] : word[0] << start % 64 | word[1] >> (64 - start % 64);
    }

    /* The product as a fraction of a turn: 192 bits, of which the last 53 are not all right. */
    last = mantissa * part[2];
    middle = mantissa * part[1] + trueaxis_product_high(mantissa, part[2]);
    first = mantissa * part[0] + trueaxis_product_high(mantissa, part[1]) + (middle < mantissa * part[1]);

    /* Two bits of quarter turns, rounded to the nearest; what is left is a fraction of one, with its sign. */
    quarters = first >> 62;
    high = first << 2 | middle >> 62;
    low = middle << 2 | last >> 62;
    beyond_half = (int)(high >> 63);
    if (beyond_half) {
        quarters += 1;
        low = ~low + 1;
        high = ~high + (low == 0);
    }
    for (zeros = 0; zeros < 63 && high >> 63 == 0; zeros++) {
        high = high << 1 | low >> 63;
        low <<= 1;
    }
    scale = trueaxis_number((uint64_t)(1023 - 64 - zeros) << 52);
    big = (double)(high >> 11) * 2048.0 * scale;
    small = (double)((high & 0x7ff) << 53 | low >> 11) * (scale / 9007199254740992.0);

    /* Times pi/2, in halves of 26 bits so that the products are exact. */
    big_head = trueaxis_number(trueaxis_bits(big) & ~0x7ffffffULL);
    big_tail = big - big_head;
    product = big * 0x1.921fb54442d18p+0;
    error = big_tail * 0x1.110b460000000p-26 -
            (((product - big_head * 0x1.921fb50000000p+0) - big_tail * 0x1.921fb50000000p+0) -
             big_head * 0x1.110b460000000p-26);
    rest = error + (big * 0x1.1a62633145c07p-54 + small * 0x1.921fb54442d18p+0);
    *r = product + rest;
    *low_part = (product - *r) + rest;

    /* The sign of the remainder, and that of the angle, which turns the other way. */
    backwards = x < 0.0;
    sign = beyond_half == backwards ? 1.0 : -1.0;
    *r *= sign;
    *low_part *= sign;
    return backwards ? 0 - quarters : quarters;
}

/* Sine and cosine of any angle, rad, at most 1 ulp off; NaN where the angle is no finite number. */
TRUEAXIS_INLINE void trueaxis_sin_cos_with(const int fused, double x, double *sine, double *cosine)
{
    if (x >= -TRUEAXIS_WIDEST && x <= TRUEAXIS_WIDEST) {
        trueaxis_sin_cos_narrow(fused, x, sine, cosine);
    } else if (x - x != 0.0) {
        *sine = *cosine = x - x;
    } else {
        double r, low;
        const uint64_t quarters = trueaxis_reduce_wide(x, &r, &low);
        trueaxis_sin_cos_reduced(fused, r, low, quarters, sine, cosine);
    }
}

/* Whether all angles of a block are within TRUEAXIS_WIDEST, so that loops over them need no branches: one sum of squares
 * tells, for if it is small enough, so is every angle. A block that fails is done right too, only slower. */
TRUEAXIS_INLINE int trueaxis_is_narrow(const int fused, const double *restrict x)
{
    double squares[8] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    double sum;
    int row, lane;
    for (row = 0; row < TRUEAXIS_ROWS; row += 8)
        for (lane = 0; lane < 8; lane++)
            squares[lane] = trueaxis_mul_add(fused, x[row + lane], x[row + lane], squares[lane]);
    for (lane = 0; lane < 4; lane++)
        squares[lane] += squares[lane + 4];
    sum = (squares[0] + squares[2]) + (squares[1] + squares[3]);
    return sum <= TRUEAXIS_WIDEST * TRUEAXIS_WIDEST;
}

/* Sine and cosine of an angle, rad, inside a loop over rows; `narrow` is what trueaxis_is_narrow says, and a constant
 * wherever this is inlined. */
TRUEAXIS_INLINE void trueaxis_sin_cos_in_loop(const int fused, const int narrow, double x, double *sine, double *cosine)
{
    if (narrow)
        trueaxis_sin_cos_narrow(fused, x, sine, cosine);
    else
        trueaxis_sin_cos_with(fused, x, sine, cosine);
}

/* Sines and cosines of a block of angles, rad. */
TRUEAXIS_INLINE void trueaxis_sin_cos_rows(const int fused, const double *restrict x, double *restrict sine,
                                           double *restrict cosine)
{
    int row;
    if (trueaxis_is_narrow(fused, x)) {
        for (row = 0; row < TRUEAXIS_ROWS; row++)
            trueaxis_sin_cos_in_loop(fused, 1, x[row], sine + row, cosine + row);
    } else {
        for (row = 0; row < TRUEAXIS_ROWS; row++)
            trueaxis_sin_cos_in_loop(fused, 0, x[row], sine + row, cosine + row);
    }
}
