//! The numbers that decide what held-out rows are said to show, each with its source.

use evidence::policy::Threshold;

/// A simpler model is written where it leaves no more than this share of what the declared errors leave of held-out rows.
pub(crate) const WORTH_WRITING: f64 = 0.95;
/// Rows or units of rows below which held-out figures separate no models.
pub(crate) const FEWEST: usize = 10;
/// Below this share of the largest singular value of scaled columns a combination is not shown: a fit without a fold leaves it alone.
pub(crate) const UNSEEN: f64 = 1e-4;
/// What the rows that stay say of a combination, as a share of what all say, below which they do not show it.
pub(crate) const NOT_LEFT: f64 = 1e-6;
/// A step to the fit without a fold is short where the chain itself misses what the step foretells by no more than this share of the
/// sum of squares; where it is not, the rows that stay are fitted anew.
pub(crate) const SHORT: f64 = 1e-4;
/// Numbers of a matrix of derivatives at most, for which a fit without each fold is made: of more rows one step says the same.
pub(crate) const REFITTED: usize = 1 << 22;
/// Directions that miss by a radian point anywhere.
pub(crate) const ANYWHERE_RAD: f64 = 1.0;
/// Points that were measured close together may miss by this share of how far away they are.
pub(crate) const OF_DISTANCE: f64 = 0.2;

const ASKED: &str = "specification: a larger error is no size of an error";
const RULE: &str = "specification: figures of a few rows scatter by as much";
const NUMERICS: &str = "numerics: first-order columns by differences hold six digits";

/// Every number that decides here.
pub const THRESHOLDS: &[Threshold] = &[
    Threshold::new(
        "ladder.worth_writing",
        WORTH_WRITING,
        "largest share of the held-out error of all declared errors that a simpler model may leave to be written",
        RULE,
    ),
    Threshold::new(
        "ladder.fewest",
        FEWEST as f64,
        "rows, or groups of rows, that separate models at least",
        RULE,
    ),
    Threshold::new(
        "fold.unseen",
        UNSEEN,
        "singular value over the largest, below which a fit without a fold leaves a combination alone",
        NUMERICS,
    ),
    Threshold::new(
        "fold.not_left",
        NOT_LEFT,
        "share of what all rows show of a combination, below which the rows outside a fold do not show it",
        NUMERICS,
    ),
    Threshold::new(
        "fold.short",
        SHORT,
        "share of the sum of squares that one step may miss, else the rows outside a fold are fitted anew",
        "specification: changes an RMS by less than one percent",
    ),
    Threshold::new(
        "fold.refitted",
        REFITTED as f64,
        "derivatives (rows times errors) up to which each fold has a fit of its own",
        "specification: of more rows one step says the same",
    ),
    Threshold::new(
        "figure.anywhere_rad",
        ANYWHERE_RAD,
        "largest error of a direction that is printed",
        ASKED,
    ),
    Threshold::new(
        "figure.of_distance",
        OF_DISTANCE,
        "largest error of a point that is printed, over its distance, if the measured region is smaller",
        ASKED,
    ),
];
