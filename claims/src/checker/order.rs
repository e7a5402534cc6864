//! The order of a form: which products of errors it has.

/// Which products of errors a form has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Order {
    /// Those of up to this many errors, 1 to 3.
    UpTo(u32),
    /// All of them: sines and cosines of errors, nothing dropped.
    Exact,
}
