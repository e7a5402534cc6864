//! The numbers that decide whether a column is called misread, or a value implausible, each with its source.

use std::f64::consts::PI;

use evidence::policy::Threshold;

/// A hypothesis is told when its score is so much better than that of the study's own reading.
pub(super) const MARGIN: f64 = 5.0;
/// And the residual shrinks to this share.
pub(super) const RATIO: f64 = 0.5;
/// Or the errors become plausible, by so much of the prior, while the residual grows by no more than this factor.
pub(super) const CLEARED: f64 = 6.0;
pub(super) const SAME: f64 = 1.2;
/// Rows that are shifted leave a residual that is smaller than this share: what drifts slowly gains a little by any shift.
pub(super) const RATIO_ROWS: f64 = 0.3;
/// Hypotheses within this of the best are told as "one of".
pub(super) const ONE_OF: f64 = 4.0;
/// A column is misread with this prior probability.
pub(super) const RARE: f64 = 1e-3;
/// Nats that a kind of mistake is rarer than a wrong unit or sign.
pub(super) const HEADED_PRICE: f64 = 2.0;
pub(super) const EXCHANGED_PRICE: f64 = 0.5;
pub(super) const ORDER_PRICE: f64 = 0.5;
pub(super) const PACKED_PRICE: f64 = 1.0;
pub(super) const ZENITH_PRICE: f64 = 1.0;
pub(super) const SHIFTED_PRICE: f64 = 1.5;
pub(super) const COUNTS_PRICE: f64 = 2.0;
/// Counts of an encoder span more degrees than that.
pub(super) const COUNTS_DEGREES: f64 = 4.0 * 360.0;
pub(super) const TURNED_PRICE: f64 = 1.0;
pub(super) const FRAME_PRICE: f64 = 2.0;
/// And that it holds of some rows alone.
pub(super) const FROM_ROW_PRICE: f64 = 3.0;
/// Rows are told to be of two kinds where four conditions hold: the score is better by this margin, the residual shrinks to this share, the
/// kinds differ by this many times the spread along the difference, and the smaller kind has this share of the rows.
pub(super) const STATES_PRICE: f64 = 1.0;
pub(super) const STATES_MARGIN: f64 = 10.0;
pub(super) const STATES_RATIO: f64 = 0.6;
pub(super) const STATES_APART: f64 = 6.0;
pub(super) const STATES_FEWEST_SHARE: f64 = 0.1;
/// In fewer rows a wave looks like two kinds by chance: there the residual must shrink to the second share.
pub(super) const STATES_ROWS: f64 = 20.0;
pub(super) const STATES_RATIO_FEW: f64 = 0.1;
/// The kinds follow no order, joint or column: they change at least at this share of the places where they would by chance.
pub(super) const STATES_SCATTERED: f64 = 0.5;
/// An instrument is calibrated over this much of a joint, rad; a unit by which it moved less is rarer by the logarithm of the share.
pub(super) const TRAVEL_RAD: f64 = PI / 3.0;
/// Two mistakes at once are asked where the study's own reading and the best single mistake each leave more than this share of what was
/// measured, or an error beyond its limit.
pub(super) const ROUGH_SHARE: f64 = 0.01;
/// An axis is about so far from where the declaration puts it, rad; lengths and tools, as shares of the reach.
pub(super) const TILT_RAD: f64 = PI / 180.0;
pub(super) const LENGTH_SHARE: f64 = 0.02;
pub(super) const TOOL_SHARE: f64 = 0.1;
/// Beyond these a value is no finding: a tilt, rad; a length, as a share of the reach; a residual, as a share of what was measured.
pub(super) const MOST_TILT_RAD: f64 = PI / 36.0;
pub(super) const MOST_LENGTH_SHARE: f64 = 0.1;
pub(super) const MOST_RESIDUAL_SHARE: f64 = 0.03;

/// A joint's scale may be off by this much: an effect that competes with misread columns.
pub(super) const MOST_SCALE: f64 = 0.03;
/// A turn by so much less or more than whole hours may be a clock's, rad: what the errors of an instrument add.
pub(super) const CLOCK_RAD: f64 = PI / 360.0;
/// Stations are not where a study roughly puts them where most are off by more than this, as a share of how far away objects are and in rad
/// together.
pub(super) const FAR: f64 = 0.5;

/// What an error beyond its limit costs, nats: nobody makes an instrument like that.
pub(super) const BEYOND: f64 = 20.0;

/// Hypotheses that are fitted to the end, hypotheses of some rows that are fitted at all, and the steps that all others are fitted by.
/// They bound work.
pub(super) const FITTED: usize = 9;
pub(super) const PARTS: usize = 3;
pub(super) const SCREENED_STEPS: usize = 2;
/// Steps of a fit beside unknown objects: a right reading is there by then, a wrong one need not be.
pub(super) const OBJECT_STEPS: usize = 30;
/// Single mistakes of each stage, the best first, beside which a second one is tried.
pub(super) const PAIRED: usize = 3;

const TRIALS: &str =
    "402 clean and 190 misread simulated studies of eight instruments, thresholds moved once between halves";
const PRICED: &str =
    "specification: prices of kinds of mistake, measured there on five to seven files a kind";
const FRAMED: &str = "judgement: rarer than a wrong unit, as exchanged places on Earth and wrong clocks are";
const ASKED: &str = "specification: beyond this a value is no small error";

/// Every number that decides here.
pub const THRESHOLDS: &[Threshold] = &[
    Threshold::new("misread.margin", MARGIN, "nats by which another reading must win", TRIALS),
    Threshold::new("misread.ratio", RATIO, "share of the residual that another reading may leave", TRIALS),
    Threshold::new(
        "misread.cleared",
        CLEARED,
        "nats of the prior on errors that another reading must save, else",
        TRIALS,
    ),
    Threshold::new("misread.same", SAME, "factor by which the residual may grow then", TRIALS),
    Threshold::new(
        "misread.ratio_rows",
        RATIO_ROWS,
        "share of the residual that shifted rows may leave",
        TRIALS,
    ),
    Threshold::new("misread.one_of", ONE_OF, "nats within which readings are told together", TRIALS),
    Threshold::new("misread.rare", RARE, "prior probability that a column is misread", TRIALS),
    Threshold::new(
        "misread.exchanged",
        EXCHANGED_PRICE,
        "nats that exchanged columns are rarer than a wrong unit",
        TRIALS,
    ),
    Threshold::new(
        "misread.headed",
        HEADED_PRICE,
        "nats that a unit which a heading states is rarer wrong",
        "judgement: a heading is written beside its numbers, a study is not",
    ),
    Threshold::new(
        "misread.order",
        ORDER_PRICE,
        "nats that a quaternion in another order is rarer than a wrong unit",
        PRICED,
    ),
    Threshold::new(
        "misread.states",
        STATES_PRICE,
        "nats that rows of two kinds are rarer than a wrong unit",
        PRICED,
    ),
    Threshold::new(
        "misread.states_margin",
        STATES_MARGIN,
        "nats by which rows of two kinds must win",
        PRICED,
    ),
    Threshold::new(
        "misread.states_ratio",
        STATES_RATIO,
        "share of the residual that rows of two kinds may leave",
        PRICED,
    ),
    Threshold::new(
        "misread.states_apart",
        STATES_APART,
        "how far the kinds are apart, over what is left along the difference",
        PRICED,
    ),
    Threshold::new(
        "misread.states_rows",
        STATES_ROWS,
        "rows below which two kinds may leave no more than `misread.states_ratio_few`",
        "105 clean simulated studies: without it, a wave in 12 rows was taken for two kinds",
    ),
    Threshold::new(
        "misread.states_ratio_few",
        STATES_RATIO_FEW,
        "share of the residual that two kinds of few rows may leave",
        "judgement: a play leaves a hundredth, a wave a third",
    ),
    Threshold::new(
        "misread.states_fewest",
        STATES_FEWEST_SHARE,
        "least share of the rows in the smaller kind",
        PRICED,
    ),
    Threshold::new(
        "misread.states_scattered",
        STATES_SCATTERED,
        "changes of kind along rows, a joint or a column, over those by chance",
        PRICED,
    ),
    Threshold::new(
        "misread.travel_rad",
        TRAVEL_RAD,
        "travel of a joint below which a unit is rarer",
        "judgement: an instrument is calibrated over most of its travel",
    ),
    Threshold::new(
        "misread.rough",
        ROUGH_SHARE,
        "share of what was measured that is left where two mistakes are asked",
        PRICED,
    ),
    Threshold::new(
        "misread.packed",
        PACKED_PRICE,
        "nats that packed digits are rarer than a wrong unit",
        TRIALS,
    ),
    Threshold::new(
        "misread.zenith",
        ZENITH_PRICE,
        "nats that an angle from the zenith is rarer than a wrong unit",
        TRIALS,
    ),
    Threshold::new(
        "misread.shifted",
        SHIFTED_PRICE,
        "nats that slipped rows are rarer than a wrong unit",
        TRIALS,
    ),
    Threshold::new(
        "misread.counts",
        COUNTS_PRICE,
        "nats that counts of an encoder are rarer than a wrong unit",
        PRICED,
    ),
    Threshold::new(
        "misread.counts_degrees",
        COUNTS_DEGREES,
        "degrees that counts of an encoder span at least",
        PRICED,
    ),
    Threshold::new(
        "misread.turned",
        TURNED_PRICE,
        "nats that a zero a quarter turn off is rarer than a wrong unit",
        PRICED,
    ),
    Threshold::new(
        "misread.from_row",
        FROM_ROW_PRICE,
        "nats that a mistake of some rows alone is rarer",
        PRICED,
    ),
    Threshold::new(
        "misread.frame",
        FRAME_PRICE,
        "nats that a frame which is turned is rarer than a wrong unit",
        FRAMED,
    ),
    Threshold::new("prior.tilt_rad", TILT_RAD, "size of a tilt, scale of its prior", TRIALS),
    Threshold::new(
        "prior.length_share",
        LENGTH_SHARE,
        "size of a length error over the reach, scale of its prior",
        TRIALS,
    ),
    Threshold::new(
        "prior.tool_share",
        TOOL_SHARE,
        "size of an error of a tool over the reach, scale of its prior",
        TRIALS,
    ),
    Threshold::new("prior.beyond", BEYOND, "nats that an error beyond its limit costs a reading", FRAMED),
    Threshold::new(
        "misread.scale",
        MOST_SCALE,
        "how far off a joint's scale may be that explains what a misread column would",
        "specification: a true scale of 2 % is no misread column; without it 1 of 70 clean files was called misread",
    ),
    Threshold::new(
        "misread.clock_rad",
        CLOCK_RAD,
        "how far from whole hours a turn may be that is said to be a clock's",
        "judgement: errors of a mount, a third of a degree at most, are added to it",
    ),
    Threshold::new(
        "plausible.far",
        FAR,
        "how far most stations may be from their rough places, over the distance of objects and in rad",
        "judgement: rough places are good to a tenth, those of a mirrored room are off by one and more",
    ),
    Threshold::new("plausible.tilt_rad", MOST_TILT_RAD, "largest tilt that is a finding", ASKED),
    Threshold::new(
        "plausible.length_share",
        MOST_LENGTH_SHARE,
        "largest length error over the reach that is a finding",
        ASKED,
    ),
    Threshold::new(
        "plausible.residual_share",
        MOST_RESIDUAL_SHARE,
        "largest residual over what was measured",
        ASKED,
    ),
];
