//! A family of effects: what an observer should know of it, and its members for one chain.

use super::{Effect, Setting};

/// One family of the catalogue: its name, what an observer should know of it, and how it follows from a chain.
pub struct Family {
    /// `encoder`
    pub name: &'static str,
    /// What it is, in a sentence or two.
    pub what: &'static str,
    /// Physical causes.
    pub causes: &'static str,
    /// What it looks like in residuals.
    pub looks: &'static str,
    /// What to check on the instrument.
    pub check: &'static str,
    /// Its members for one chain.
    pub effects: fn(&Setting<'_>) -> Vec<Effect>,
}
