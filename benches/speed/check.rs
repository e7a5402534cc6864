//! Floors against generated code: a floor that computes something else is none.

use crate::candidates::Buffers;
use crate::floors::{self, Width};
use crate::lidar;

/// Holds the floors against the generated code on the first rows.
///
/// # Panics
/// If they differ.
#[allow(unsafe_code, reason = "floors are called only where the processor has their instructions")]
pub fn check(buffers: &mut Buffers) {
    use lidar::{
        JointRows, ExactError, ExactJacobian, ExactJacobianBlock, FirstOrderError, FirstOrderJacobian,
        FirstOrderJacobianBlock, Joints, Observed,
    };
    let Some(width) = Width::here() else { return };
    let errors = errors!(v4);
    let pose = |buffers: &Buffers, row: usize| {
        let [alpha, beta, gamma] = buffers.joints.each_ref().map(|column| column[row]);
        Joints { alpha, beta, gamma }
    };
    let agree = |buffers: &Buffers, expected: &dyn Fn(&Joints) -> Observed<[f64; 3]>| {
        for row in 0..1000 {
            let Observed { pointing, position } = expected(&pose(buffers, row));
            for (out, expected) in buffers.out.iter().zip(pointing.into_iter().chain(position)) {
                assert!((out[row] - expected).abs() < 1e-16, "{} is not {expected}", out[row]);
            }
        }
    };
    // SAFETY, here and below: `width` is what the processor has.
    unsafe { floors::first_order(width, &floors::FirstOrder::prepare(&errors), buffers.floor_rows()) };
    let first_order = FirstOrderError::prepare(&errors);
    agree(buffers, &|joints| first_order.eval(joints));
    unsafe { floors::exact(width, &floors::Exact::prepare(&errors), buffers.floor_rows()) };
    let exact = ExactError::prepare(&errors);
    agree(buffers, &|joints| exact.eval(joints));

    let Some(joints) = buffers.blocks().next() else { return };
    let columns = JointRows { alpha: joints[0], beta: joints[1], gamma: joints[2] };
    let mut block = Box::new([[[0.0; floors::ROWS + 8]; 3]; floors::COLUMNS.len()]);
    unsafe { floors::jacobian(width, &floors::Jacobian::prepare(&errors), joints, &mut block) };
    let mut generated = Box::new(ExactJacobianBlock::default());
    assert!(ExactJacobian::prepare(&errors).eval_block(&columns, &mut generated).is_ok());
    let Observed { pointing, position } = generated.observed();
    for (&(observable, error), column) in floors::COLUMNS.iter().zip(block.iter()) {
        for (component, rows) in column.iter().enumerate() {
            rows_agree(rows, [&pointing, &position][observable][component][error]);
        }
    }

    let mut block = Box::new([[0.0; floors::ROWS + 8]; floors::DERIVATIVES.len()]);
    unsafe { floors::first_order_jacobian(width, &floors::FirstOrderJacobian, joints, &mut block) };
    let mut generated = Box::new(FirstOrderJacobianBlock::default());
    assert!(FirstOrderJacobian::prepare(&errors).eval_block(&columns, &mut generated).is_ok());
    let Observed { pointing, position } = generated.observed();
    for (&(observable, component, error), rows) in floors::DERIVATIVES.iter().zip(block.iter()) {
        rows_agree(rows, [&pointing, &position][observable][component][error]);
    }
}

fn rows_agree(rows: &[f64], expected: &[f64]) {
    assert_eq!(expected.len(), floors::ROWS);
    for (value, expected) in rows.iter().zip(expected) {
        assert!((value - expected).abs() < 1e-15, "{value} is not {expected}");
    }
}
