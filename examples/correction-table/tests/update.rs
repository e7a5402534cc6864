//! The table corrects to first order: what is left is at most half the square of the sum of all tilts.

use correction_table::CorrectionTable;
use correction_table::scanner::{Errors, Joints, exact_error};

const POSITIONS: usize = 360;

#[test]
fn a_table_leaves_only_what_is_of_second_order() {
    let errors = Errors {
        dtheta_y1: 2e-4,
        da1: -1e-4,
        dtheta_z2: 5e-5,
        db2: 1e-4,
        da3: 3e-4,
        db4: -2e-4,
        ..Errors::default()
    };
    let sum = 2e-4 + 1e-4 + 5e-5 + 1e-4 + 3e-4 + 2e-4;
    let (alpha, beta) = (0.7, -0.4);
    let mut table = CorrectionTable::<POSITIONS>::new();
    assert_eq!(table.at(17), [0.0; 3]);
    table.update(&errors, alpha, beta);
    for position in 0..POSITIONS {
        let joints = Joints { alpha, beta, gamma: CorrectionTable::<POSITIONS>::gamma_rad(position) };
        let error = exact_error(&errors, &joints).pointing;
        let correction = table.at(position);
        let square = |vector: [f64; 3]| vector.iter().map(|x| x * x).sum::<f64>();
        let left = square([0, 1, 2].map(|axis| error[axis] + correction[axis])).sqrt();
        assert!(left <= sum * sum / 2.0, "position {position}: {left}");
        assert!(square(error).sqrt() > 1e-4, "there is something to correct");
    }
}

#[test]
fn an_update_forgets_what_was_before() {
    let mut table = CorrectionTable::<POSITIONS>::new();
    table.update(&Errors { da3: 1e-3, ..Errors::default() }, 0.0, 0.0);
    table.update(&Errors::default(), 0.0, 0.0);
    assert_eq!(table, CorrectionTable::new());
}
