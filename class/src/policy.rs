//! Every number that decides how hard a data set is and when it counts as solvable.

/// One second of arc, rad.
pub const ARCSEC_RAD: f64 = std::f64::consts::PI / 648_000.0;

/// What a level asks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Difficulty {
    /// Rows of the data.
    pub rows: usize,
    /// Standard deviation of the noise in each of two directions, arc seconds.
    pub noise_arcsec: f64,
    /// Effects that the declaration lacks, a change between set-ups not counted.
    pub effects: usize,
    /// Smallest and largest amplitude of an effect, arc seconds.
    pub amplitude_arcsec: [f64; 2],
    /// Whether one effect must have several possible causes; elsewhere none may.
    pub is_confounded: bool,
    /// Whether a column is misread or the two set-ups differ.
    pub is_disturbed: bool,
}

/// Levels 1 to 4.
///
/// Noise of 1″ to 2″ and errors below 40″ are those of a good telescope mount before it is calibrated.
pub const LEVELS: [Difficulty; 4] = [
    Difficulty {
        rows: 160,
        noise_arcsec: 1.0,
        effects: 1,
        amplitude_arcsec: [15.0, 40.0],
        is_confounded: false,
        is_disturbed: false,
    },
    Difficulty {
        rows: 160,
        noise_arcsec: 2.0,
        effects: 2,
        amplitude_arcsec: [12.0, 40.0],
        is_confounded: false,
        is_disturbed: false,
    },
    Difficulty {
        rows: 200,
        noise_arcsec: 2.0,
        effects: 3,
        amplitude_arcsec: [12.0, 40.0],
        is_confounded: true,
        is_disturbed: false,
    },
    Difficulty {
        rows: 200,
        noise_arcsec: 2.0,
        effects: 1,
        amplitude_arcsec: [15.0, 40.0],
        is_confounded: false,
        is_disturbed: true,
    },
];

/// Largest size of a declared error, arc seconds.
pub const DECLARED_ARCSEC: f64 = 40.0;

/// The signature of each effect, beside all else that is fitted, is at least so many standard deviations of the noise long. The
/// best of some hundred candidates on noise alone reaches about four.
pub const LEAST_SIGNATURE: f64 = 20.0;

/// A cause is possible if it leaves at most so much of the true signature, in standard deviations: the difference of the sums of
/// squares is then about as large as chance alone makes it.
pub const POSSIBLE: f64 = 2.0;

/// A cause is excluded if it leaves at least so much: the difference of the sums of squares is then 36 on average, and chance hardly
/// reverses it. Data with a cause in between are drawn anew.
pub const EXCLUDED: f64 = 6.0;

/// The asked size is known to this share of itself at least.
pub const SIZE_KNOWN_TO: f64 = 0.1;

/// The largest effect is so many times as large as the next: nobody doubts which is asked for.
pub const LARGEST_IS: f64 = 1.25;

/// The asked prediction is at least so large, arc seconds: zero would be no answer.
pub const LEAST_PREDICTION_ARCSEC: f64 = 8.0;

/// Data sets that are drawn before it is said that none can be solved.
pub const ATTEMPTS: u32 = 2000;

/// Poses at which a model that was handed in is judged.
pub const UNSEEN_ROWS: usize = 200;
