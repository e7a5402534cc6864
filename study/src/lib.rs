//! The study file: which chain, which data, what was observed, what to estimate and what to look for.
//!
//! [`Study`] is the file as written (`written`); with a chain it becomes a [`Plan`] in which every name is
//! resolved (`plan`); with the data files the plan becomes [`Observations`](observe::Observations)
//! (`load`). Whatever is wrong with a study is told at once, each mistake with its place (`mistakes`, `syntax`).

mod amount;
mod asked;
mod cells;
mod column_plan;
mod columns;
mod conversion;
mod correlated;
mod doubts;
mod effects;
mod estimated;
mod format;
mod frozen;
mod headings;
mod hold_out;
mod inputs;
mod kind;
mod labels;
mod load;
mod memory;
mod mistakes;
mod narrower;
mod next;
mod objects;
mod observed;
mod order;
mod orientation;
mod places;
mod plan;
mod ranges;
mod reference;
mod repeated;
mod rows;
mod sample;
mod short;
mod shown;
mod sights;
mod sigma;
mod stated;
mod syntax;
mod terms;
mod timeless;
pub mod toml_mistakes;
mod trajectory;
mod uncertain;
mod uncertain_readings;
mod undeclared;
mod unsought;
mod unstated;
mod written;

pub use asked::Asked;
pub use column_plan::ColumnAt;
pub use conversion::{Conversion, Notation};
pub use frozen::{Frozen, FrozenTerm};
pub use headings::{Headings, Need, ObservedColumn, Sequence};
pub use hold_out::HoldOut;
pub use load::{Loaded, Open, OpenTable};
pub use next::{NextObjects, NextPlaces, NextPoses};
pub use orientation::{Form as OrientationForm, axes_in_turn};
pub use plan::{Plan, Search, SourcePlan};
pub use sample::{Change, Changed, Place, Read, Sample, SampledColumn, WrittenColumn};
pub use timeless::Timeless;
pub use trajectory::{Joining, TrajectoryPlan};
pub use undeclared::{Beside, Undeclared};
pub use unsought::Unsought;
pub use unstated::Unstated;
pub use written::Study;
