//! A column of lengths holds twice what it is taken for: diameters for radii.

use observe::kinds::MeasuredLengths;

use super::{Hypothesis, Reading, Tried};
use study::{Change, Changed, SampledColumn};

pub(super) fn tried(tried: &Tried<'_>) -> Vec<Hypothesis> {
    let may_be = |column: &&&SampledColumn| {
        let lengths = tried.plan.sources.get(column.place.source).and_then(|own| own.measure.kind().lengths);
        lengths.is_some_and(|lengths| lengths != MeasuredLengths::Wires)
    };
    let of_column = |column: &&SampledColumn| {
        let changes = vec![Changed::all(column.place, Change::Factor(0.5 * column.factor))];
        Hypothesis::new(Reading::Doubled { column: column.name.clone() }, changes, Vec::new(), 0.0)
    };
    tried.observed.iter().filter(may_be).map(of_column).collect()
}
