//! Cautions: what casts doubt on a calibration, or on the data that it was made from.

use serde::Serialize;

use super::ladder::{Ladder, RungName};
use super::noise::NoiseFound;
use super::uneven::Uneven;
use crate::misread::{ByTheClock, Implausible, Misread, Strayed};
use fit::FitResult;
use observe::SiUnit;

/// Noise that is so many times what was stated is larger than stated, or smaller, if chance does not explain it.
const LARGER: f64 = 1.3;
const SMALLER: f64 = 0.6;

/// The share of the variance of what is left beyond which it is mostly what rows remember.
const MOSTLY: f64 = 0.5;

/// Standard deviations of the found noise beyond which chance does not explain it.
const SURE: f64 = 3.0;

/// Degrees of freedom below which a fit runs through its rows, whatever their noise.
pub(super) const SOME_FREEDOM: f64 = 1.0;

/// Something to be careful about.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "kind")]
pub enum Caution {
    /// Effects make it worse on rows that no stage saw.
    #[serde(rename = "worse on held-out data")]
    WorseHeldOut {
        /// RMS before, SI.
        before: f64,
        /// RMS after, SI.
        after: f64,
        /// Their unit.
        unit: SiUnit,
    },
    /// Hardly more numbers than what is estimated from them: nothing is left over to judge the noise by.
    #[serde(rename = "hardly more numbers than unknowns")]
    HardlyMoreNumbers {
        /// Numbers that were measured and count.
        numbers: usize,
        /// What is estimated from them: combinations of errors, and what is observed.
        unknowns: usize,
    },
    /// Rows that nobody fitted are far from what the fit of the others foretells, with effects or without.
    #[serde(rename = "held-out data foretold badly")]
    ForetoldBadly {
        /// RMS on the data that were fitted, SI.
        fitted: f64,
        /// RMS on those that were not, SI.
        held_out: f64,
        /// Their unit.
        unit: SiUnit,
    },
    /// A simpler model predicts held-out rows better than all declared errors do.
    #[serde(rename = "simpler model predicts better")]
    SimplerPredictsBetter {
        /// Which.
        model: RungName,
        /// RMS on held-out rows by it, SI.
        simpler: f64,
        /// RMS on held-out rows by all declared errors, SI.
        declared: f64,
        /// Their unit.
        unit: SiUnit,
        /// The errors that it does without.
        spared: Vec<String>,
        /// Whether it is the model that is written.
        written: bool,
    },
    /// Effects passed the test, but made it worse on rows that their search did not see: they were left out again.
    #[serde(rename = "not confirmed on held-out data")]
    NotConfirmed {
        /// Their names.
        effects: Vec<String>,
        /// The smallest familywise p among them.
        p_value: f64,
        /// RMS without them, SI.
        before: f64,
        /// RMS with them, SI.
        after: f64,
        /// Their unit.
        unit: SiUnit,
    },
    /// Effects passed the test of a search, but what hangs together along the rows explains the data as well: they were left out.
    #[serde(rename = "follows the order of the rows")]
    FollowsOrder {
        /// Their names.
        effects: Vec<String>,
        /// Whether rows remember the row before, or wander.
        remembers: bool,
        /// Set-ups that the rows fall into; one where they show no more.
        setups: usize,
        /// A column that the study does not name, whose values say which rows belong together.
        #[serde(skip_serializing_if = "Option::is_none")]
        column: Option<String>,
    },
    /// Effects make it worse in regions of the joints that no stage saw.
    #[serde(rename = "worse elsewhere")]
    WorseElsewhere {
        /// RMS before, SI.
        before: f64,
        /// RMS after, SI.
        after: f64,
        /// Their unit.
        unit: SiUnit,
    },
    /// An effect passed the test, but hangs on fewer than six observations: it was left out again.
    #[serde(rename = "few observations behind an effect")]
    FewBehindAnEffect {
        /// Its name.
        effect: String,
        /// How many, as an effective number.
        observations: f64,
    },
    /// An effect passed the test, but what is stated of one station alone shows it: it was left out again.
    #[serde(rename = "one station behind an effect")]
    StationBehindAnEffect {
        /// Its name.
        effect: String,
        /// The station's label.
        station: String,
    },
    /// As many effects were accepted as a search may accept.
    #[serde(rename = "limit of effects reached")]
    LimitOfEffects {
        /// How many.
        effects: usize,
    },
    /// Rows of one place share an error there: a place counts as a group.
    #[serde(rename = "rows of one place share something")]
    OfOnePlace {
        /// Rows.
        rows: usize,
        /// Places that they stand at.
        places: usize,
        /// Whether groups were declared, which the places cross.
        beside_groups: bool,
    },
    /// Rows beside unknown objects that follow each other are off alike: a stretch of them counts as a group.
    #[serde(rename = "rows that follow each other are off alike")]
    OffAlike {
        /// Rows.
        rows: usize,
        /// Rows of a stretch.
        of_stretch: usize,
        /// Stretches.
        stretches: usize,
    },
    /// Most of what is left is what rows remember of those before: something that drifts, in the noise or not.
    #[serde(rename = "what is left drifts")]
    Drifts {
        /// The share of the variance that the rows before explain.
        share: f64,
    },
    /// Readings are not as uncertain as the study states: so many times.
    #[serde(rename = "readings not as uncertain as stated")]
    ReadingsNotAsStated {
        /// What was found over what is stated.
        ratio: f64,
    },
    /// What was found hangs on readings, and noise in them would look like that.
    #[serde(rename = "noise in readings looks like it")]
    NoisyReadings {
        /// The joint or input.
        reading: String,
        /// The standard deviation of that noise, SI.
        sigma: f64,
        /// `rad`, `m`, or `1`.
        unit: SiUnit,
    },
    /// Rows that were set aside have something in common.
    #[serde(rename = "rows set aside share something")]
    SetAsideShare {
        /// The joint, input, side or group.
        reading: String,
        /// From where, SI.
        from: f64,
        /// To where, SI.
        to: f64,
        /// Its unit.
        unit: SiUnit,
        /// Rows set aside there, of how many there.
        rows: [usize; 2],
    },
    /// The rows of an object or a station scatter more than the others'.
    #[serde(rename = "rows scatter more")]
    Scatters {
        /// What it is.
        what: Uneven,
        /// Its label.
        label: String,
        /// So many times as much.
        times: f64,
    },
    /// Stations come out far from where the study states them, and a scale of the ranges that nobody declared would bring them home.
    #[serde(rename = "a scale, or stations stated wrongly")]
    ScaleOrPlaces {
        /// The range.
        range: String,
        /// The body along whose axis it is measured.
        body: String,
        /// That axis.
        axis: String,
        /// What it would be.
        scale: f64,
        /// Its standard uncertainty.
        uncertainty: f64,
    },
    /// An object or a station comes out far from where the study states it.
    #[serde(rename = "not where it is stated")]
    NotWhereStated {
        /// What it is.
        what: Uneven,
        /// Its label.
        label: String,
        /// By so many of its stated standard uncertainties; absent where its rows were set aside together and say so.
        #[serde(skip_serializing_if = "Option::is_none")]
        sigmas: Option<f64>,
        /// How far, m.
        away_m: f64,
        /// How far along x, y and z, m.
        shift_m: [f64; 3],
        /// How far a station is turned, rad.
        turn_rad: f64,
    },
    /// Rows of one file share an error: the ± count files.
    #[serde(rename = "rows of one file share something")]
    FilesShareErrors {
        /// Files.
        files: usize,
        /// The variance of what they say of the estimates, over what their rows explain.
        ratio: f64,
    },
    /// Effects that the search found in some of the rows, and that every row does not bear out.
    #[serde(rename = "not borne out by every row")]
    NotBorneOut {
        /// Their names.
        effects: Vec<String>,
    },
    /// The fit of every row did not converge.
    #[serde(rename = "every row not fitted")]
    EveryRowNotFitted,
    /// What to measure next was asked for and cannot be computed.
    #[serde(rename = "nothing proposed")]
    NothingProposed {
        /// What prevents it.
        why: String,
    },
    /// The declaration as it was could not be fitted: the figures before mean little.
    #[serde(rename = "declaration not fitted")]
    DeclarationNotFitted {
        /// Steps taken.
        steps: usize,
    },
    /// The noise is larger than the study or the data state.
    #[serde(rename = "noise exceeds stated")]
    NoiseExceedsStated {
        /// So many times.
        ratio: f64,
    },
    /// The noise is much smaller than the study or the data state.
    #[serde(rename = "stated uncertainties too large")]
    StatedTooLarge {
        /// What was found over what is stated.
        ratio: f64,
    },
    /// The residual is no small part of what was measured: a sign, an axis or a unit.
    #[serde(rename = "residual out of place")]
    OutOfPlace {
        /// The file.
        source: String,
        /// RMS of the residual, SI.
        rms: f64,
        /// Its unit.
        unit: SiUnit,
        /// The usual distance that was measured, m; none for directions.
        measured_m: Option<f64>,
        /// Rows that were set aside, of how many, where the residual of the others is small; absent where it is not.
        #[serde(skip_serializing_if = "Option::is_none")]
        but_for: Option<[usize; 2]>,
    },
    /// Columns are not what the study says.
    #[serde(rename = "column misread")]
    ColumnMisread(Misread),
    /// Values that no small error has: the model or a column is wrong.
    #[serde(rename = "implausible")]
    Implausible {
        /// Which.
        values: Vec<Implausible>,
    },
    /// A wrong clock explains a zero as well.
    #[serde(rename = "a clock, or a zero")]
    ByTheClock(ByTheClock),
    /// Rows of an object lie at two places.
    #[serde(rename = "rows at two places")]
    TwoPlaces(super::two_places::TwoPlaces),
    /// Lengths seem to be told from another zero.
    #[serde(rename = "lengths from another zero")]
    LengthsOff(super::lengths::LengthsOff),
    /// Stations seem to have moved while they measured.
    #[serde(rename = "stations moved while measuring")]
    Moved(super::moved::Moved),
    /// Stations come out nowhere near where the study roughly puts them.
    #[serde(rename = "stations far from their rough places")]
    StationsStrayed(Strayed),
    /// What is left is the rounding of the numbers: nothing can be searched in it.
    #[serde(rename = "residual is rounding")]
    ResidualIsRounding {
        /// RMS of the residual, SI.
        rms: f64,
        /// Its unit.
        unit: SiUnit,
    },
    /// An angle that is no small error.
    #[serde(rename = "error not small")]
    ErrorNotSmall {
        /// Its name.
        error: String,
        /// Its estimate, rad.
        value_rad: f64,
    },
}

impl Caution {
    /// What a ladder says of the declaration, where a simpler model predicts better.
    pub(super) fn of_ladder(ladder: &Ladder) -> Option<Self> {
        let [simpler, declared] = ladder.simpler()?;
        Some(Self::SimplerPredictsBetter {
            model: simpler.name,
            simpler: simpler.held_out_rms_kept?,
            declared: declared.held_out_rms_kept.unwrap_or(f64::INFINITY),
            unit: ladder.unit,
            spared: ladder.above(simpler.name).into_iter().map(str::to_owned).collect(),
            written: false,
        })
    }

    /// The same where the simpler model is what is written.
    pub(crate) fn of_what_is_written(mut self) -> Self {
        if let Self::SimplerPredictsBetter { written, .. } = &mut self {
            *written = true;
        }
        self
    }
}

/// What the noise says about what was stated of it.
///
/// Source: E. B. Wilson and M. M. Hilferty, "The distribution of chi-square", PNAS 17 (1931) 684: its cube root is nearly normal, of so
/// few degrees of freedom too that no ratio, however small, is beyond chance.
pub(super) fn of_noise(noise: &NoiseFound, degrees_of_freedom: f64) -> Option<Caution> {
    let ratio = noise.over_stated?;
    if degrees_of_freedom < SOME_FREEDOM {
        return None;
    }
    let variance = 2.0 / (9.0 * degrees_of_freedom);
    let deviations = ((ratio * ratio).cbrt() - (1.0 - variance)) / variance.sqrt();
    if ratio > LARGER && deviations > SURE {
        Some(Caution::NoiseExceedsStated { ratio })
    } else if ratio < SMALLER && deviations < -SURE {
        Some(Caution::StatedTooLarge { ratio })
    } else {
        None
    }
}

/// What rows remember, if that is most of what is left.
pub(super) fn of_memory(fit: &FitResult) -> Option<Caution> {
    let share = 1.0 - fit.noise.serial?.gain().powi(-2);
    (share > MOSTLY).then_some(Caution::Drifts { share })
}

/// What the residuals say of how uncertain readings are stated to be.
pub(super) fn of_readings(noise: &NoiseFound) -> Option<Caution> {
    let ratio = noise.readings_over_stated?;
    // Of a component of the noise that others hide it takes more than of the whole.
    let is_far = !(SMALLER.powi(2)..=LARGER.powi(2)).contains(&ratio);
    is_far.then_some(Caution::ReadingsNotAsStated { ratio })
}
