//! An instrument on two axes: its declaration, and where a cause writes what it adds.

/// An instrument that a class can get.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Instrument {
    /// What it is and how its angles run, for the sheet.
    pub words: &'static str,
    /// Its declaration with the declared errors alone.
    pub declaration: &'static str,
    /// The axis that stands upright.
    pub first: Axis,
    /// The axis that the first carries.
    pub second: Axis,
    /// The factor of the levelling, behind which a change of it is written.
    pub levelled: &'static str,
    /// How the second joint is counted.
    pub level: Level,
    /// +1 if a positive turn about the second axis raises the sight, −1 if it lowers it.
    pub raises: f64,
    /// Declared errors that every data set of it determines well.
    pub asked: [&'static str; 2],
}

/// One axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axis {
    /// The joint.
    pub joint: &'static str,
    /// The body that it moves.
    pub body: &'static str,
    /// The rotation about the axis: `Rz`.
    pub turn: &'static str,
    /// The factor of the encoder's zero, behind which effects of the axis are written.
    pub zero: &'static str,
    /// Smallest and largest reading, degrees.
    pub range_deg: [f64; 2],
}

/// How the second joint is counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Level {
    /// From the horizon: level is 0.
    Horizon,
    /// From the zenith: level is a quarter turn.
    Zenith,
}

impl Instrument {
    /// The declaration with more factors, each written behind the factor that stands there.
    #[must_use]
    pub fn with<'a>(&self, additions: impl IntoIterator<Item = (&'a str, String)>) -> String {
        additions.into_iter().fold(self.declaration.to_owned(), |text, (behind, factor)| {
            text.replacen(behind, &format!("{behind}, {factor}"), 1)
        })
    }

    /// The names of its joints.
    #[must_use]
    pub fn joints(&self) -> [&'static str; 2] {
        [self.first.joint, self.second.joint]
    }
}
