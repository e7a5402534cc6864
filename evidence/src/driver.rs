//! What an explanation is a function of.

/// What a family is a function of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Driver {
    /// Nothing: a constant.
    Nothing,
    /// A joint.
    Joint(usize),
    /// Two joints.
    Joints(usize, usize),
    /// An input.
    Input(usize),
    /// Gravity.
    Gravity,
    /// The order of the rows.
    Order,
}
