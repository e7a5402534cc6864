//! How large a parameter may be that the data do not determine: as large as the study states, else as large as the largest
//! determined error of the same kind.

use model_core::SymbolId;

/// The size of errors where the data show none of the same kind, rad, m or 1.
pub const UNSHOWN: f64 = 1e-4;

/// The size of errors beside unknown objects and stations where the study states none: 5 mm, 5 mrad, 0.005.
pub const BESIDE_OBJECTS: f64 = 5e-3;

/// The size of constants that are estimated, rad, m or 1: they are no errors, and may stand anywhere.
pub(super) const CONSTANT: f64 = 1.0;

/// How large an error may be that these data do not show.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Size {
    /// The error or constant.
    pub parameter: SymbolId,
    /// The standard deviation of its prior, SI.
    pub value: f64,
    /// Where it comes from.
    pub origin: SizeOrigin,
}

/// Where the size of an error comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SizeOrigin {
    /// The caller stated it.
    Stated,
    /// The largest error of the same kind that the data determine.
    LargestShown,
    /// The data determine no error of the same kind.
    Default,
}
