//! Symbols: the names that amounts are made of, what each is for and what it measures.

/// A symbol of one chain: an index into [`Chain::symbols`](crate::Chain::symbols).
///
/// The first symbol of every chain is π, so that the algebra can treat it as one more variable.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SymbolId(pub u16);

impl SymbolId {
    /// π, present in every chain.
    pub const PI: Self = Self(0);

    /// Position in [`Chain::symbols`](crate::Chain::symbols).
    #[must_use]
    pub fn index(self) -> usize {
        usize::from(self.0)
    }
}

/// What a symbol is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum SymbolKind {
    /// The number π.
    Pi,
    /// A variable that a `motion` factor moves by, measured by an encoder.
    Joint,
    /// A small parameter: zero in the instrument as designed.
    Error,
    /// A known size of the geometry.
    Constant,
    /// A measured side quantity: range, temperature, time, rate, direction of motion.
    Input,
    /// A ramp of a joint or input: see [`Ramp`](crate::ramp::Ramp).
    Ramp,
}

/// What a symbol measures; it fixes the SI unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Quantity {
    /// An angle, in radians.
    Angle,
    /// A length, in metres.
    Length,
    /// Anything else, in the unit of the data: a scale, a temperature, a direction of motion.
    Number,
}

impl Quantity {
    /// The SI unit as printed: `rad`, `m` or `1`.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            Self::Angle => "rad",
            Self::Length => "m",
            Self::Number => "1",
        }
    }
}

/// One named quantity of a chain.
#[derive(Debug, Clone, PartialEq)]
pub struct Symbol {
    /// The declared name: `dtheta_y1`.
    pub name: String,
    /// What it is for.
    pub kind: SymbolKind,
    /// What it measures.
    pub quantity: Quantity,
    /// Documentation from the declaration's `///` lines; empty if there is none.
    pub documentation: String,
    /// The printed form, declared by `symbol` or derived from the name: `\Delta\theta_{y1}^0`.
    pub latex: String,
    /// The nominal value in SI, for constants only.
    pub value: Option<f64>,
}
