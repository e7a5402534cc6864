//! The vector sine and cosine, and the paths that vector code may take: for the interpreter as a library, for the
//! backends as texts that go unchanged into generated files.
//!
//! Accuracy, against 200-bit arithmetic: at most 0.9 units in the last place for |x| ≤ 1e6 rad on every path; NaN for
//! NaN and infinities. The sine of −0 is +0.

mod sine_cosine {
    #![allow(
        unsafe_code,
        clippy::excessive_precision,
        reason = "generated files contain this text; every unsafe block says why it is sound"
    )]

    include!("paths.rs");
    include!("kernel.rs");
    include!("wide.rs");
    include!("blocks.rs");
}

/// Sine and cosine in single precision, as generated files have them.
pub mod single {
    #![allow(clippy::excessive_precision, reason = "generated files contain this text")]

    include!("single.rs");
}

pub use sine_cosine::{
    Arithmetic, Block, Path, Portable, ROWS, Rows, WIDEST, Waves, Work, arc_tangent, path, root, run,
    run_block, run_rows, saturate, sin_cos, sin_cos_rows, sin_cos_with, sin_cos_without_branch, step, whole,
};

/// The parts of the module `sine_cosine` in generated Rust, in order.
pub const RUST: [&str; 4] =
    [include_str!("paths.rs"), include_str!("kernel.rs"), include_str!("wide.rs"), include_str!("blocks.rs")];

/// The module `sine_cosine` of generated Rust in single precision.
pub const RUST_SINGLE: &str = include_str!("single.rs");

/// The same in C99: the start of generated C files in single precision.
pub const C_SINGLE: &str = include_str!("single.c");

/// The same in C99: the start of generated C files.
pub const C: &str = include_str!("kernel.c");
