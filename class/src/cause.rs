//! What an instrument may do that its declaration lacks: the list that a sheet prints, and the factor that each cause adds.

use std::fmt::Write as _;

use crate::instrument::{Axis, Instrument, Level};
use crate::readings::Pose;

/// A physical cause.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Cause {
    /// The disc of the first encoder is off centre.
    FirstOffCentre,
    /// The disc of the first encoder is oval.
    FirstOval,
    /// The disc of the second encoder is off centre.
    SecondOffCentre,
    /// The disc of the second encoder is oval.
    SecondOval,
    /// The bearing of the first axis has two lobes.
    Wobble,
    /// Gravity bends what the second axis carries.
    Gravity,
    /// The temperature turns the second axis.
    Temperature,
    /// The first axis was levelled anew between the set-ups.
    LevelledAnew,
    /// The zero of the first encoder changed between the set-ups.
    ZeroedAnew,
}

/// A function of the readings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Function {
    /// The cosine of so many times a joint.
    Cos(Joint, u8),
    /// The sine of so many times a joint.
    Sin(Joint, u8),
    /// The temperature.
    Temperature,
    /// 1 in the second set-up, 0 in the first.
    Second,
}

/// The first or the second joint of an instrument.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Joint {
    /// Of the upright axis.
    First,
    /// Of the axis that the first carries.
    Second,
}

/// One factor that a cause adds to a declaration.
#[derive(Debug, Clone, PartialEq)]
pub struct Addition {
    /// The factor behind which it is written.
    pub behind: &'static str,
    /// The body that it belongs to.
    pub body: &'static str,
    /// The transform: `Rx`.
    pub moves: &'static str,
    /// Its amount: each new error times a function.
    pub terms: Vec<(&'static str, Function)>,
}

impl Cause {
    /// Every cause, in the order of a sheet.
    pub const ALL: [Self; 9] = [
        Self::FirstOffCentre,
        Self::FirstOval,
        Self::SecondOffCentre,
        Self::SecondOval,
        Self::Wobble,
        Self::Gravity,
        Self::Temperature,
        Self::LevelledAnew,
        Self::ZeroedAnew,
    ];

    /// The word that an answer names it by.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::FirstOffCentre => "first_off_centre",
            Self::FirstOval => "first_oval",
            Self::SecondOffCentre => "second_off_centre",
            Self::SecondOval => "second_oval",
            Self::Wobble => "wobble",
            Self::Gravity => "gravity",
            Self::Temperature => "temperature",
            Self::LevelledAnew => "levelled_anew",
            Self::ZeroedAnew => "zeroed_anew",
        }
    }

    /// The cause of a word.
    #[must_use]
    pub fn of_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|cause| cause.word() == word)
    }

    /// What it is, and what its error follows.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::FirstOffCentre => {
                "the disc of the first encoder is off centre: an error once a turn, about the first axis"
            }
            Self::FirstOval => {
                "the disc of the first encoder is oval: an error twice a turn, about the first axis"
            }
            Self::SecondOffCentre => {
                "the disc of the second encoder is off centre: an error once a turn, about the second axis"
            }
            Self::SecondOval => {
                "the disc of the second encoder is oval: an error twice a turn, about the second axis"
            }
            Self::Wobble => {
                "the bearing of the first axis has two lobes: the axis tilts about x, twice a turn"
            }
            Self::Gravity => {
                "gravity bends what the second axis carries, about that axis, most where the sight is level"
            }
            Self::Temperature => "warmth turns the second axis, in proportion to the temperature",
            Self::LevelledAnew => "the first axis was levelled anew between the two set-ups",
            Self::ZeroedAnew => "the zero of the first encoder changed between the two set-ups",
        }
    }

    /// Whether its error follows one of the joints.
    #[must_use]
    pub fn follows_a_joint(self) -> bool {
        self != Self::Temperature && !self.is_of_set_ups()
    }

    /// Whether it makes the set-ups differ.
    #[must_use]
    pub fn is_of_set_ups(self) -> bool {
        matches!(self, Self::LevelledAnew | Self::ZeroedAnew)
    }

    /// What it adds to the declaration of an instrument.
    #[must_use]
    pub fn additions(self, instrument: &Instrument) -> Vec<Addition> {
        use Function::{Cos, Sin};
        use Joint::{First, Second};
        let about = |axis: &Axis, moves, terms: &[_]| {
            vec![Addition { behind: axis.zero, body: axis.body, moves, terms: terms.to_vec() }]
        };
        let (first, second) = (&instrument.first, &instrument.second);
        match self {
            Self::FirstOffCentre => {
                about(first, first.turn, &[("first_cos", Cos(First, 1)), ("first_sin", Sin(First, 1))])
            }
            Self::FirstOval => {
                about(first, first.turn, &[("first_cos_2", Cos(First, 2)), ("first_sin_2", Sin(First, 2))])
            }
            Self::SecondOffCentre => {
                about(second, second.turn, &[("second_cos", Cos(Second, 1)), ("second_sin", Sin(Second, 1))])
            }
            Self::SecondOval => about(
                second,
                second.turn,
                &[("second_cos_2", Cos(Second, 2)), ("second_sin_2", Sin(Second, 2))],
            ),
            Self::Wobble => {
                about(first, "Rx", &[("wobble_cos", Cos(First, 2)), ("wobble_sin", Sin(First, 2))])
            }
            Self::Gravity => {
                let level = match instrument.level {
                    Level::Horizon => Cos(Second, 1),
                    Level::Zenith => Sin(Second, 1),
                };
                about(second, second.turn, &[("sag", level)])
            }
            Self::Temperature => about(second, second.turn, &[("per_kelvin", Function::Temperature)]),
            Self::LevelledAnew => [("Rx", "tilt_x_second"), ("Ry", "tilt_y_second")]
                .map(|(moves, name)| Addition {
                    behind: instrument.levelled,
                    body: first.body,
                    moves,
                    terms: vec![(name, Function::Second)],
                })
                .into(),
            Self::ZeroedAnew => about(first, first.turn, &[("index_second", Function::Second)]),
        }
    }
}

impl Addition {
    /// The factor as a declaration writes it.
    #[must_use]
    pub fn factor(&self, instrument: &Instrument) -> String {
        let mut amount = String::new();
        for (at, (name, function)) in self.terms.iter().enumerate() {
            let plus = if at == 0 { "" } else { " + " };
            let _ = write!(amount, "{plus}{name}*{}", function.text(instrument));
        }
        format!("{}({amount})", self.moves)
    }
}

impl Function {
    fn text(self, instrument: &Instrument) -> String {
        let of = |name: &str, joint: Joint, times: u8| {
            let joint = instrument.joints()[joint as usize];
            if times == 1 { format!("{name}({joint})") } else { format!("{name}({times}*{joint})") }
        };
        match self {
            Self::Cos(joint, times) => of("cos", joint, times),
            Self::Sin(joint, times) => of("sin", joint, times),
            Self::Temperature => "temperature".to_owned(),
            Self::Second => "second".to_owned(),
        }
    }

    /// Its value at a pose.
    #[must_use]
    pub fn value(self, pose: &Pose) -> f64 {
        let angle = |joint: Joint, times: u8| f64::from(times) * pose.joints_deg[joint as usize].to_radians();
        match self {
            Self::Cos(joint, times) => angle(joint, times).cos(),
            Self::Sin(joint, times) => angle(joint, times).sin(),
            Self::Temperature => pose.temperature,
            Self::Second => pose.second(),
        }
    }
}
