//! Some of the rows of a problem, as if no others had been measured.

use crate::problem::{Declared, Input, Joint, Load, Place, Problem, Rows};

impl Problem {
    /// The problem of some of its rows: those whose number `keeps` lets stay.
    #[must_use]
    pub fn of_rows(&self, keeps: impl Fn(usize) -> bool) -> Self {
        let kept: Vec<bool> = (0..self.rows.count).map(keeps).collect();
        let some = |values: &[f64]| -> Vec<f64> {
            // As many values a row as the list has.
            let a_row = values.len() / kept.len().max(1);
            let own = values.chunks(a_row.max(1)).zip(&kept).filter(|(_, kept)| **kept);
            own.flat_map(|(own, _)| own.iter().copied()).collect()
        };
        let all = |lists: &[Vec<f64>]| lists.iter().map(|list| some(list)).collect();
        let load = |load: &Load| Load { torque: some(&load.torque), ..load.clone() };
        let place = |place: &Place| Place {
            column: some(&place.column),
            nominal: place.nominal.as_deref().map(some),
            gravity: place.gravity.as_ref().map(|down| down.each_ref().map(|list| some(list))),
            loads: place.loads.iter().map(load).collect(),
            ..place.clone()
        };
        let joint = |joint: &Joint| Joint {
            values: some(&joint.values),
            direction: joint.direction.as_deref().map(some),
            ..joint.clone()
        };
        let labels = |labels: &Vec<usize>| {
            labels.iter().zip(&kept).filter(|(_, kept)| **kept).map(|(label, _)| *label).collect()
        };
        Self {
            rows: Rows {
                count: kept.iter().filter(|kept| **kept).count(),
                joints: self.rows.joints.iter().map(joint).collect(),
                inputs: (self.rows.inputs.iter())
                    .map(|input| Input { values: some(&input.values), ..input.clone() })
                    .collect(),
                labels: self.rows.labels.as_ref().map(labels),
                in_order: self.rows.in_order,
                given: all(&self.rows.given),
            },
            components: self.components,
            residual: some(&self.residual),
            sigma: self.sigma.as_deref().map(some),
            declared: (self.declared.iter())
                .map(|error| Declared { column: some(&error.column), ..error.clone() })
                .collect(),
            frames: self.frames.clone(),
            places: self.places.iter().map(place).collect(),
            offered: self.offered.clone(),
        }
    }
}
