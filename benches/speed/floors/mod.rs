//! Floors: the mobile lidar by hand, in the processor's own vector instructions, fewest known operations.
//!
//! They do less than the generated code: no test for angles beyond 1e6, no rest of rows, no check of the processor.

#![allow(unsafe_code, reason = "processor instructions; each block says why it is sound")]

mod errors;
mod first_order_jacobian;
mod jacobian;
mod lanes;
mod sine_cosine;
mod three;

pub use errors::{Exact, FirstOrder, Rows};
pub use first_order_jacobian::{DERIVATIVES, FirstOrderJacobian};
pub use jacobian::{COLUMNS, Jacobian};
use lanes::{Eight, Four};

/// Rows of a block.
pub const ROWS: usize = 64;

/// Blocks start at a cache line, as generated ones do.
#[repr(align(64))]
pub struct Aligned<T>(pub T);

/// The path on which a floor runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Width {
    /// AVX2 and FMA.
    Four,
    /// AVX-512.
    Eight,
}

impl Width {
    /// The widest that this processor has.
    pub fn here() -> Option<Self> {
        if is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq") {
            Some(Self::Eight)
        } else if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
            Some(Self::Four)
        } else {
            None
        }
    }
}

macro_rules! floor {
    ($name:ident, $form:ty, ($($argument:ident: $type:ty),+), $about:literal) => {
        #[doc = $about]
        ///
        /// # Safety
        /// The processor has the instructions of `width`.
        pub unsafe fn $name(width: Width, form: &$form, $($argument: $type),+) {
            #[target_feature(enable = "avx512f,avx512dq")]
            #[inline(never)]
            fn eight(form: &$form, $($argument: $type),+) {
                // SAFETY: the instructions of `Eight` are enabled here.
                unsafe { form.run::<Eight>($($argument),+) }
            }
            #[target_feature(enable = "avx2,fma")]
            #[inline(never)]
            fn four(form: &$form, $($argument: $type),+) {
                // SAFETY: the instructions of `Four` are enabled here.
                unsafe { form.run::<Four>($($argument),+) }
            }
            // SAFETY: the caller's promise.
            unsafe {
                match width {
                    Width::Eight => eight(form, $($argument),+),
                    Width::Four => four(form, $($argument),+),
                }
            }
        }
    };
}

floor!(first_order, FirstOrder, (rows: Rows<'_>), "First-order error.");
floor!(exact, Exact, (rows: Rows<'_>), "Exact error.");
floor!(
    jacobian,
    Jacobian,
    (joints: [&[f64; ROWS]; 3], out: &mut jacobian::Block),
    "Exact Jacobian, one block."
);
floor!(
    first_order_jacobian,
    FirstOrderJacobian,
    (joints: [&[f64; ROWS]; 3], out: &mut first_order_jacobian::Block),
    "First-order Jacobian, one block."
);
