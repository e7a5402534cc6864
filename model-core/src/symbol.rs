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
    /// The angle between an observed direction and up: see [`SightAngle`](crate::chain::sight::SightAngle).
    SightAngle,
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

/// What an input is, as its statement says; nothing is guessed from names.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Meaning {
    /// `angle`: any angle, in radians.
    Angle,
    /// `length`: any length, in metres.
    Length,
    /// `range`: a measured distance to what is observed, in metres.
    Range,
    /// `temperature`: kelvin, or degrees Celsius, which differ by a constant only.
    Temperature,
    /// `time`: seconds from any origin.
    Time,
    /// `rate of beta`: how fast a joint moves, in radians (or metres) per second.
    Rate,
    /// `direction of beta`: which way a joint moves: 1 upwards, −1 downwards, 0 at rest.
    Direction,
    /// `turns of beta`: how many times a joint has passed its index.
    Turns,
    /// `phase of range`: the phase of a modulation over a measured length, in radians.
    Phase,
    /// `inverse of range`: one over a measured length, in 1/m.
    Inverse,
    /// `rotator`: the angle of a rotator behind the instrument, in radians.
    Rotator,
    /// `session`: 1 in the rows of one session, 0 in the others.
    Session,
    /// `side`: which of two sides or faces the instrument is on: 1 or −1.
    Side,
    /// `pressure`: pascal.
    Pressure,
    /// `humidity`: relative, from 0 to 1.
    Humidity,
}

impl Meaning {
    /// What it measures, as far as amounts care: angles can stand in sines, the rest are lengths and numbers.
    #[must_use]
    pub fn quantity(self) -> Quantity {
        match self {
            Self::Angle | Self::Phase | Self::Rotator => Quantity::Angle,
            Self::Length | Self::Range => Quantity::Length,
            Self::Temperature
            | Self::Time
            | Self::Rate
            | Self::Direction
            | Self::Turns
            | Self::Inverse
            | Self::Session
            | Self::Side
            | Self::Pressure
            | Self::Humidity => Quantity::Number,
        }
    }

    /// The unit as printed. The rate of a joint that shifts is in `m/s`, which the joint says and not the input.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            Self::Angle | Self::Phase | Self::Rotator => "rad",
            Self::Length | Self::Range => "m",
            Self::Temperature => "K",
            Self::Time => "s",
            Self::Rate => "rad/s",
            Self::Direction | Self::Side | Self::Humidity | Self::Turns | Self::Session => "1",
            Self::Inverse => "1/m",
            Self::Pressure => "Pa",
        }
    }
}

/// What the meaning of an input may be of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Subject {
    /// A joint: `direction of beta`.
    Joint,
    /// A length that is measured, a joint or an input: `phase of range`.
    Length,
}

impl Subject {
    /// Whether a name of this kind and quantity is such a thing.
    #[must_use]
    pub fn is_met_by(self, kind: SymbolKind, quantity: Option<Quantity>) -> bool {
        match self {
            Self::Joint => kind == SymbolKind::Joint,
            Self::Length => {
                matches!(kind, SymbolKind::Joint | SymbolKind::Input) && quantity == Some(Quantity::Length)
            }
        }
    }
}

impl Meaning {
    /// What it is of; `None` for what stands by itself.
    #[must_use]
    pub fn subject(self) -> Option<Subject> {
        match self {
            Self::Direction | Self::Rate | Self::Turns => Some(Subject::Joint),
            Self::Phase | Self::Inverse => Some(Subject::Length),
            Self::Angle
            | Self::Length
            | Self::Range
            | Self::Temperature
            | Self::Time
            | Self::Side
            | Self::Pressure
            | Self::Humidity
            | Self::Rotator
            | Self::Session => None,
        }
    }

    /// The meaning that a word of declarations stands for.
    #[must_use]
    pub fn of_word(word: &str) -> Option<Self> {
        Self::WORDS.iter().find(|(known, _)| *known == word).map(|(_, meaning)| *meaning)
    }

    /// As declarations write it.
    #[must_use]
    pub fn word(self) -> &'static str {
        let own = Self::WORDS.iter().find(|(_, meaning)| *meaning == self);
        own.map_or_else(|| unreachable!("every meaning has a word"), |(word, _)| word)
    }

    /// Every meaning, with its word.
    pub const WORDS: [(&'static str, Self); 15] = [
        ("angle", Self::Angle),
        ("length", Self::Length),
        ("range", Self::Range),
        ("temperature", Self::Temperature),
        ("time", Self::Time),
        ("rate", Self::Rate),
        ("direction", Self::Direction),
        ("turns", Self::Turns),
        ("phase", Self::Phase),
        ("inverse", Self::Inverse),
        ("side", Self::Side),
        ("rotator", Self::Rotator),
        ("session", Self::Session),
        ("pressure", Self::Pressure),
        ("humidity", Self::Humidity),
    ];
}

impl Symbol {
    /// The unit as printed: that of its declared meaning, else that of its quantity.
    #[must_use]
    pub fn unit(&self) -> &'static str {
        self.meaning.map_or_else(|| self.quantity.unit(), Meaning::unit)
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
    /// What it is, for inputs whose statement says so.
    pub meaning: Option<Meaning>,
    /// The joint or length that its meaning is of: `beta` of `direction of beta`.
    pub of: Option<SymbolId>,
    /// Documentation from the declaration's `///` lines; empty if there is none.
    pub documentation: String,
    /// The printed form, declared by `symbol` or derived from the name: `\Delta\theta_{y1}^0`.
    pub latex: String,
    /// The nominal value in SI, for constants only.
    pub value: Option<f64>,
}
