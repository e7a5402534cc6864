//! Some of the rows of a problem, as if no others had been measured.

use crate::problem::{Declared, Input, Joint, Load, Place, Problem, Rows};

impl Problem {
    /// The problem of those of its rows that stay, one of these a row.
    #[must_use]
    pub fn of_rows(&self, kept: &[bool]) -> Self {
        let some = |values: &[f64]| -> Vec<f64> {
            // As many values a row as the list has.
            let a_row = values.len() / kept.len().max(1);
            let own = values.chunks(a_row.max(1)).zip(kept).filter(|(_, kept)| **kept);
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
            labels.iter().zip(kept).filter(|(_, kept)| **kept).map(|(label, _)| *label).collect()
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

#[cfg(test)]
mod tests {
    use crate::driver::Driver;
    use crate::problem::{Declared, Frame, Freedom, Input, Joint, Load, Offered, Place, Problem, Rows};

    /// Rows whose values say which row and component they are.
    fn counted(rows: &[usize]) -> Problem {
        let of_row = |from: f64| rows.iter().map(|&row| from + row as f64).collect::<Vec<_>>();
        let of_values = |from: f64| -> Vec<f64> {
            rows.iter().flat_map(|&row| [from + row as f64, from + row as f64 + 0.5]).collect()
        };
        Problem {
            rows: Rows {
                count: rows.len(),
                joints: vec![Joint {
                    name: "turn".into(),
                    values: of_row(10.0),
                    direction: Some(of_row(20.0)),
                    from_horizon: true,
                }],
                inputs: vec![Input { name: "air".into(), values: of_row(30.0), is_time: false }],
                labels: Some(rows.to_vec()),
                in_order: true,
                given: vec![of_row(40.0)],
            },
            components: 2,
            residual: of_values(50.0),
            sigma: Some(of_values(60.0)),
            declared: vec![Declared { name: "index".into(), estimate: 1.0, column: of_values(70.0) }],
            frames: vec![Frame { name: "base".into(), tilts: None, whirl: None }],
            places: vec![Place {
                name: "base.Rz".into(),
                frame: 0,
                freedom: Freedom::Rotation(2),
                own: Some(0),
                beside: vec![0],
                column: of_values(80.0),
                nominal: Some(of_values(90.0)),
                gravity: Some([of_row(100.0), of_row(110.0), of_row(120.0)]),
                loads: vec![Load { body: "arm".into(), torque: of_row(130.0) }],
            }],
            offered: vec![Offered {
                name: "own".into(),
                place: 0,
                driver: Driver::Joint(0),
                order: None,
                columns: vec![vec![(0, 0)]],
            }],
        }
    }

    #[test]
    fn some_rows_are_the_problem_of_these_rows_alone() {
        let all = counted(&[0, 1, 2, 3, 4]);
        assert_eq!(all.of_rows(&[true, false, true, true, false]), counted(&[0, 2, 3]));
        assert_eq!(all.of_rows(&[true; 5]), all);
        assert!(all.of_rows(&[false; 5]).check().is_err());
    }
}
