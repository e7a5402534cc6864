//! Generated code and floors behind one face.

use std::hint::black_box;

use crate::c_code;
use crate::floors::{self, Width};
use crate::lidar::Path;
use crate::rounds::{Candidate, has};
use crate::thirty::in_order;

/// Columns in and out.
pub struct Buffers {
    /// α, β, γ.
    pub joints: [Vec<f64>; 3],
    /// Six components.
    pub out: [Vec<f64>; 6],
}

impl Buffers {
    /// For floors.
    pub fn floor_rows(&mut self) -> floors::Rows<'_> {
        floors::Rows {
            joints: self.joints.each_ref().map(Vec::as_slice),
            out: self.out.each_mut().map(Vec::as_mut_slice),
        }
    }

    /// The joints by blocks.
    pub fn blocks(&self) -> impl Iterator<Item = [&[f64; floors::ROWS]; 3]> {
        let [alpha, beta, gamma] = self.joints.each_ref().map(|column| column.as_chunks().0);
        alpha.iter().zip(beta).zip(gamma).map(|((alpha, beta), gamma)| [alpha, beta, gamma])
    }
}

/// The generated functions of one path.
macro_rules! generated {
    ($module:ident, $name:expr, $list:ident) => {{
        use crate::$module::{
            JointRows, ExactError, ExactJacobian, ExactJacobianBlock, FirstOrderError, FirstOrderJacobian,
            FirstOrderJacobianBlock, Observed, ROWS,
        };
        let first_order = FirstOrderError::prepare(&errors!($module));
        let exact = ExactError::prepare(&errors!($module));
        let jacobian = ExactJacobian::prepare(&errors!($module));
        let first_order_jacobian = FirstOrderJacobian::prepare(&errors!($module));
        fn rows<T>(
            buffers: &mut Buffers,
            run: impl FnOnce(&JointRows<'_>, Observed<[&mut [f64]; 3]>) -> T,
        ) -> T {
            let [alpha, beta, gamma] = &buffers.joints;
            let [a, b, c, d, e, f] = buffers.out.each_mut().map(Vec::as_mut_slice);
            run(&JointRows { alpha, beta, gamma }, Observed { pointing: [a, b, c], position: [d, e, f] })
        }
        fn blocks(buffers: &Buffers, mut run: impl FnMut(&JointRows<'_>)) {
            let [alpha, beta, gamma] = &buffers.joints;
            for ((alpha, beta), gamma) in alpha.chunks(ROWS).zip(beta.chunks(ROWS)).zip(gamma.chunks(ROWS)) {
                run(&JointRows { alpha, beta, gamma });
            }
        }
        let mut add = |form, run| $list.push(Candidate { form, name: format!("Rust {}", $name), run });
        add(
            "first-order error",
            Box::new(move |buffers: &mut Buffers| {
                black_box(rows(buffers, |columns, out| first_order.eval_rows(columns, out).is_ok()));
            }) as Box<dyn FnMut(&mut Buffers)>,
        );
        add(
            "exact error",
            Box::new(move |buffers: &mut Buffers| {
                black_box(rows(buffers, |columns, out| exact.eval_rows(columns, out).is_ok()));
            }),
        );
        let mut block = Box::new(ExactJacobianBlock::default());
        add(
            "exact Jacobian",
            Box::new(move |buffers: &mut Buffers| {
                blocks(buffers, |columns| {
                    black_box(jacobian.eval_block(columns, &mut block).is_ok());
                    black_box(&block);
                });
            }),
        );
        let mut block = Box::new(FirstOrderJacobianBlock::default());
        add(
            "first-order Jacobian",
            Box::new(move |buffers: &mut Buffers| {
                blocks(buffers, |columns| {
                    black_box(first_order_jacobian.eval_block(columns, &mut block).is_ok());
                    black_box(&block);
                });
            }),
        );
    }};
}

/// Every candidate that this processor can run.
pub fn all() -> Vec<Candidate> {
    let mut list = Vec::new();
    for (path, width, name) in
        [(Path::V4, Width::Eight, "floor AVX-512"), (Path::V3, Width::Four, "floor AVX2")]
    {
        if has(path) {
            floors(width, name, &mut list);
        }
    }
    let errors = in_order(errors!(v4));
    if has(Path::V4) {
        generated!(v4, "v4", list);
        c_code::add(c_code::V4, "v4", errors, &mut list);
    }
    if has(Path::V3) {
        generated!(v3, "v3", list);
        c_code::add(c_code::V3, "v3", errors, &mut list);
    }
    generated!(portable, "portable", list);
    c_code::add(c_code::PORTABLE, "portable", errors, &mut list);
    list
}

#[allow(unsafe_code, reason = "floors are called only where the processor has their instructions")]
fn floors(width: Width, name: &str, list: &mut Vec<Candidate>) {
    let errors = errors!(v4);
    let mut add = |form, run| list.push(Candidate { form, name: name.to_owned(), run });
    let first_order = floors::FirstOrder::prepare(&errors);
    // SAFETY, here and below: `all` has asked for the instructions of `width`.
    add(
        "first-order error",
        Box::new(move |buffers: &mut Buffers| unsafe {
            floors::first_order(width, &first_order, buffers.floor_rows());
        }) as Box<dyn FnMut(&mut Buffers)>,
    );
    let exact = floors::Exact::prepare(&errors);
    add(
        "exact error",
        Box::new(move |buffers: &mut Buffers| unsafe {
            floors::exact(width, &exact, buffers.floor_rows());
        }),
    );
    let jacobian = floors::Jacobian::prepare(&errors);
    let mut block = Box::new(floors::Aligned([[[0.0; floors::ROWS + 8]; 3]; floors::COLUMNS.len()]));
    add(
        "exact Jacobian",
        Box::new(move |buffers: &mut Buffers| {
            for joints in buffers.blocks() {
                unsafe { floors::jacobian(width, &jacobian, joints, &mut block.0) };
                black_box(&block.0);
            }
        }),
    );
    let mut block = Box::new(floors::Aligned([[0.0; floors::ROWS + 8]; floors::DERIVATIVES.len()]));
    add(
        "first-order Jacobian",
        Box::new(move |buffers: &mut Buffers| {
            for joints in buffers.blocks() {
                let form = floors::FirstOrderJacobian;
                unsafe { floors::first_order_jacobian(width, &form, joints, &mut block.0) };
                black_box(&block.0);
            }
        }),
    );
}
