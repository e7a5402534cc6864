//! Generated code and floors behind one face.

use std::hint::black_box;

use crate::c_code;
use crate::floors::{self, Width};
use crate::lidar::{self, Path};
use crate::rounds::{Candidate, has};

/// Columns in and out.
pub struct Buffers {
    /// α, β, γ.
    pub joints: [Vec<f64>; 3],
    /// Six components.
    pub out: [Vec<f64>; 6],
}

impl Buffers {
    fn floor_rows(&mut self) -> floors::Rows<'_> {
        floors::Rows {
            joints: self.joints.each_ref().map(Vec::as_slice),
            out: self.out.each_mut().map(Vec::as_mut_slice),
        }
    }
}

macro_rules! errors {
    ($module:ident) => {
        crate::$module::Errors {
            dtheta_y1: 1.1e-4,
            dtheta_x1: -2.3e-4,
            dx1: 1e-4,
            dy1: -2e-4,
            dz1: 3e-4,
            da1: 5e-5,
            db1: -7e-5,
            delta_x2: 4e-4,
            delta_y2: -5e-4,
            dtheta_y2: 2e-5,
            dtheta_z2: -3e-5,
            dx2: 6e-4,
            dy2: 7e-4,
            dz2: -8e-4,
            db2: 9e-5,
            dg2: -1e-5,
            delta_y3: 2e-4,
            dtheta_y3: 3e-5,
            dtheta_x3: -4e-5,
            dx3: 5e-4,
            dy3: -6e-4,
            dz3: 7e-4,
            da3: 8e-5,
            db3: -9e-5,
            dx4: 1e-4,
            dy4: -1.5e-4,
            dz4: 2.5e-4,
            da4: -3.5e-5,
            db4: 4.5e-5,
            dg4: 5.5e-5,
        }
    };
}

/// The generated functions of one path.
macro_rules! generated {
    ($module:ident, $name:expr, $list:ident) => {{
        use crate::$module::{
            Columns, ExactError, ExactJacobian, ExactJacobianBlock, FirstOrderError, FirstOrderJacobian,
            FirstOrderJacobianBlock, Observed, ROWS,
        };
        let first_order = FirstOrderError::prepare(&errors!($module));
        let exact = ExactError::prepare(&errors!($module));
        let jacobian = ExactJacobian::prepare(&errors!($module));
        let first_order_jacobian = FirstOrderJacobian::prepare(&errors!($module));
        fn rows<T>(
            buffers: &mut Buffers,
            run: impl FnOnce(&Columns<'_>, Observed<[&mut [f64]; 3]>) -> T,
        ) -> T {
            let [alpha, beta, gamma] = &buffers.joints;
            let [a, b, c, d, e, f] = buffers.out.each_mut().map(Vec::as_mut_slice);
            run(&Columns { alpha, beta, gamma }, Observed { pointing: [a, b, c], position: [d, e, f] })
        }
        fn blocks(buffers: &Buffers, mut run: impl FnMut(&Columns<'_>)) {
            let [alpha, beta, gamma] = &buffers.joints;
            for ((alpha, beta), gamma) in alpha.chunks(ROWS).zip(beta.chunks(ROWS)).zip(gamma.chunks(ROWS)) {
                run(&Columns { alpha, beta, gamma });
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

/// The errors in the order of the declaration.
fn in_order(e: lidar::Errors) -> [f64; 30] {
    [
        e.dtheta_y1,
        e.dtheta_x1,
        e.dx1,
        e.dy1,
        e.dz1,
        e.da1,
        e.db1,
        e.delta_x2,
        e.delta_y2,
        e.dtheta_y2,
        e.dtheta_z2,
        e.dx2,
        e.dy2,
        e.dz2,
        e.db2,
        e.dg2,
        e.delta_y3,
        e.dtheta_y3,
        e.dtheta_x3,
        e.dx3,
        e.dy3,
        e.dz3,
        e.da3,
        e.db3,
        e.dx4,
        e.dy4,
        e.dz4,
        e.da4,
        e.db4,
        e.dg4,
    ]
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
    let mut block = Box::new([[[0.0; floors::ROWS + 8]; 3]; floors::COLUMNS.len()]);
    add(
        "exact Jacobian",
        Box::new(move |buffers: &mut Buffers| {
            let [alpha, beta, gamma] = buffers.joints.each_ref().map(|column| column.as_chunks().0);
            for ((alpha, beta), gamma) in alpha.iter().zip(beta).zip(gamma) {
                unsafe { floors::jacobian(width, &jacobian, [alpha, beta, gamma], &mut block) };
                black_box(&block);
            }
        }),
    );
}

/// Holds the floors against the generated code on the first rows: a floor that computes something else is none.
///
/// # Panics
/// If they differ.
#[allow(unsafe_code, reason = "floors are called only where the processor has their instructions")]
pub fn check(buffers: &mut Buffers) {
    use lidar::{Columns, ExactError, ExactJacobian, ExactJacobianBlock, FirstOrderError, Joints, Observed};
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

    let mut block = Box::new([[[0.0; floors::ROWS + 8]; 3]; floors::COLUMNS.len()]);
    let [alpha, beta, gamma] = buffers.joints.each_ref().map(|column| column.as_slice());
    let (Some(a), Some(b), Some(g)) = (alpha.first_chunk(), beta.first_chunk(), gamma.first_chunk()) else {
        return;
    };
    unsafe { floors::jacobian(width, &floors::Jacobian::prepare(&errors), [a, b, g], &mut block) };
    let mut generated = Box::new(ExactJacobianBlock::default());
    let jacobian = ExactJacobian::prepare(&errors);
    assert!(jacobian.eval_block(&Columns { alpha: a, beta: b, gamma: g }, &mut generated).is_ok());
    let Observed { pointing, position } = generated.observed();
    let mut held = 0;
    for (&(observable, error), column) in floors::COLUMNS.iter().zip(block.iter()) {
        for (component, rows) in column.iter().enumerate() {
            let expected = [&pointing, &position][observable][component][error];
            for (value, expected) in rows.iter().zip(expected) {
                assert!(
                    (value - expected).abs() < 1e-15,
                    "{observable} {component} {error}: {value} is not {expected}"
                );
                held += 1;
            }
        }
    }
    assert_eq!(held, floors::COLUMNS.len() * 3 * floors::ROWS);
}
