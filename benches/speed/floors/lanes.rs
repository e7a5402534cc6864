//! Vectors of f64 as the processor has them: the words in which the floors are written.

use core::arch::x86_64::*;

/// One register of f64s.
///
/// # Safety
/// Every method may be called only where the processor has the instructions that the implementor names.
pub unsafe trait Lanes: Copy {
    /// Rows in a register.
    const ROWS: usize;

    /// The same number in every row.
    unsafe fn all(value: f64) -> Self;
    /// Rows from memory.
    unsafe fn load(from: *const f64) -> Self;
    /// Rows to memory.
    unsafe fn store(self, to: *mut f64);
    /// Sum.
    unsafe fn plus(self, b: Self) -> Self;
    /// Difference.
    unsafe fn minus(self, b: Self) -> Self;
    /// Product.
    unsafe fn times(self, b: Self) -> Self;
    /// self·b + c, rounded once.
    unsafe fn times_plus(self, b: Self, c: Self) -> Self;
    /// self·b − c, rounded once.
    unsafe fn times_minus(self, b: Self, c: Self) -> Self;
    /// c − self·b, rounded once.
    unsafe fn times_from(self, b: Self, c: Self) -> Self;
    /// Sine and cosine on |r| ≤ π/4 to those of the quadrant whose number stands in the low bits of `quarters`.
    unsafe fn turn(sine: Self, cosine: Self, quarters: Self) -> (Self, Self);
}

/// AVX-512 F and DQ.
#[derive(Clone, Copy)]
pub struct Eight(__m512d);

// SAFETY: the instructions are those of AVX-512 F and DQ.
unsafe impl Lanes for Eight {
    const ROWS: usize = 8;

    #[inline(always)]
    unsafe fn all(value: f64) -> Self {
        Self(unsafe { _mm512_set1_pd(value) })
    }

    #[inline(always)]
    unsafe fn load(from: *const f64) -> Self {
        Self(unsafe { _mm512_loadu_pd(from) })
    }

    #[inline(always)]
    unsafe fn store(self, to: *mut f64) {
        unsafe { _mm512_storeu_pd(to, self.0) }
    }

    #[inline(always)]
    unsafe fn plus(self, b: Self) -> Self {
        Self(unsafe { _mm512_add_pd(self.0, b.0) })
    }

    #[inline(always)]
    unsafe fn minus(self, b: Self) -> Self {
        Self(unsafe { _mm512_sub_pd(self.0, b.0) })
    }

    #[inline(always)]
    unsafe fn times(self, b: Self) -> Self {
        Self(unsafe { _mm512_mul_pd(self.0, b.0) })
    }

    #[inline(always)]
    unsafe fn times_plus(self, b: Self, c: Self) -> Self {
        Self(unsafe { _mm512_fmadd_pd(self.0, b.0, c.0) })
    }

    #[inline(always)]
    unsafe fn times_minus(self, b: Self, c: Self) -> Self {
        Self(unsafe { _mm512_fmsub_pd(self.0, b.0, c.0) })
    }

    #[inline(always)]
    unsafe fn times_from(self, b: Self, c: Self) -> Self {
        Self(unsafe { _mm512_fnmadd_pd(self.0, b.0, c.0) })
    }

    #[inline(always)]
    unsafe fn turn(sine: Self, cosine: Self, quarters: Self) -> (Self, Self) {
        // The ternary table 0x78 is a ^ (b & c): the sign bit of b, put upon a.
        unsafe {
            let bits = _mm512_castpd_si512(quarters.0);
            let swap = _mm512_test_epi64_mask(bits, _mm512_set1_epi64(1));
            let sign = _mm512_set1_epi64(i64::MIN);
            let half_turn = _mm512_slli_epi64::<62>(bits);
            let after = _mm512_slli_epi64::<62>(_mm512_add_epi64(bits, _mm512_set1_epi64(1)));
            let put = |value, turn| {
                let value = _mm512_castpd_si512(value);
                Self(_mm512_castsi512_pd(_mm512_ternarylogic_epi64::<0x78>(value, turn, sign)))
            };
            (
                put(_mm512_mask_blend_pd(swap, sine.0, cosine.0), half_turn),
                put(_mm512_mask_blend_pd(swap, cosine.0, sine.0), after),
            )
        }
    }
}

/// AVX2 and FMA.
#[derive(Clone, Copy)]
pub struct Four(__m256d);

// SAFETY: the instructions are those of AVX2 and FMA.
unsafe impl Lanes for Four {
    const ROWS: usize = 4;

    #[inline(always)]
    unsafe fn all(value: f64) -> Self {
        Self(unsafe { _mm256_set1_pd(value) })
    }

    #[inline(always)]
    unsafe fn load(from: *const f64) -> Self {
        Self(unsafe { _mm256_loadu_pd(from) })
    }

    #[inline(always)]
    unsafe fn store(self, to: *mut f64) {
        unsafe { _mm256_storeu_pd(to, self.0) }
    }

    #[inline(always)]
    unsafe fn plus(self, b: Self) -> Self {
        Self(unsafe { _mm256_add_pd(self.0, b.0) })
    }

    #[inline(always)]
    unsafe fn minus(self, b: Self) -> Self {
        Self(unsafe { _mm256_sub_pd(self.0, b.0) })
    }

    #[inline(always)]
    unsafe fn times(self, b: Self) -> Self {
        Self(unsafe { _mm256_mul_pd(self.0, b.0) })
    }

    #[inline(always)]
    unsafe fn times_plus(self, b: Self, c: Self) -> Self {
        Self(unsafe { _mm256_fmadd_pd(self.0, b.0, c.0) })
    }

    #[inline(always)]
    unsafe fn times_minus(self, b: Self, c: Self) -> Self {
        Self(unsafe { _mm256_fmsub_pd(self.0, b.0, c.0) })
    }

    #[inline(always)]
    unsafe fn times_from(self, b: Self, c: Self) -> Self {
        Self(unsafe { _mm256_fnmadd_pd(self.0, b.0, c.0) })
    }

    #[inline(always)]
    unsafe fn turn(sine: Self, cosine: Self, quarters: Self) -> (Self, Self) {
        // A blend looks at the sign bit, to which the lowest bit of the quadrant is shifted.
        unsafe {
            let bits = _mm256_castpd_si256(quarters.0);
            let odd = _mm256_castsi256_pd(_mm256_slli_epi64::<63>(bits));
            let sign = _mm256_set1_pd(-0.0);
            let half_turn = _mm256_castsi256_pd(_mm256_slli_epi64::<62>(bits));
            let put = |value, turn| _mm256_xor_pd(value, _mm256_and_pd(turn, sign));
            (
                Self(put(_mm256_blendv_pd(sine.0, cosine.0, odd), half_turn)),
                Self(put(_mm256_blendv_pd(cosine.0, sine.0, odd), _mm256_xor_pd(half_turn, odd))),
            )
        }
    }
}
