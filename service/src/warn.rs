//! What the user should know although the work goes on.

/// Hears of what is doubtful, in the order in which it is seen.
pub type Warn<'w> = &'w dyn Fn(String);
