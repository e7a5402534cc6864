//! Generated C behind `shim.c`.

#![allow(unsafe_code, reason = "calls into C, whose arguments are made here")]

use std::hint::black_box;

use crate::candidates::Buffers;
use crate::floors;
use crate::rounds::Candidate;

#[repr(C)]
pub struct JointsRows([*const f64; 3]);

#[repr(C)]
pub struct ObservedRows([*mut f64; 6]);

/// The functions of one path.
#[derive(Clone, Copy)]
pub struct Code {
    prepare: unsafe extern "C" fn(&[f64; 30]),
    first_order_error: unsafe extern "C" fn(usize, &JointsRows, &ObservedRows),
    exact_error: unsafe extern "C" fn(usize, &JointsRows, &ObservedRows),
    exact_jacobian: unsafe extern "C" fn(usize, &JointsRows),
    first_order_jacobian: unsafe extern "C" fn(usize, &JointsRows),
}

macro_rules! path {
    ($constant:ident, $prepare:ident, $foe:ident, $ee:ident, $ej:ident, $foj:ident) => {
        unsafe extern "C" {
            fn $prepare(errors: &[f64; 30]);
            fn $foe(rows: usize, joints: &JointsRows, out: &ObservedRows);
            fn $ee(rows: usize, joints: &JointsRows, out: &ObservedRows);
            fn $ej(rows: usize, joints: &JointsRows);
            fn $foj(rows: usize, joints: &JointsRows);
        }
        /// One path.
        pub const $constant: Code = Code {
            prepare: $prepare,
            first_order_error: $foe,
            exact_error: $ee,
            exact_jacobian: $ej,
            first_order_jacobian: $foj,
        };
    };
}

path!(
    PORTABLE,
    speed_portable_prepare,
    speed_portable_first_order_error,
    speed_portable_exact_error,
    speed_portable_exact_jacobian,
    speed_portable_first_order_jacobian
);
path!(
    V3,
    speed_v3_prepare,
    speed_v3_first_order_error,
    speed_v3_exact_error,
    speed_v3_exact_jacobian,
    speed_v3_first_order_jacobian
);
path!(
    V4,
    speed_v4_prepare,
    speed_v4_first_order_error,
    speed_v4_exact_error,
    speed_v4_exact_jacobian,
    speed_v4_first_order_jacobian
);

fn columns(buffers: &Buffers, first: usize) -> JointsRows {
    JointsRows(buffers.joints.each_ref().map(|column| column[first..].as_ptr()))
}

fn outs(buffers: &mut Buffers) -> ObservedRows {
    ObservedRows(buffers.out.each_mut().map(|column| column.as_mut_ptr()))
}

/// Adds the candidates of one path.
pub fn add(code: Code, name: &str, errors: [f64; 30], list: &mut Vec<Candidate>) {
    // SAFETY, here and below: columns and outputs hold as many rows as are said, and errors are thirty.
    unsafe { (code.prepare)(&errors) };
    let mut add = |form, run| list.push(Candidate { form, name: format!("C {name}"), run });
    add(
        "first-order error",
        Box::new(move |buffers: &mut Buffers| unsafe {
            let out = outs(buffers);
            (code.first_order_error)(buffers.joints[0].len(), &columns(buffers, 0), &out);
        }) as Box<dyn FnMut(&mut Buffers)>,
    );
    add(
        "exact error",
        Box::new(move |buffers: &mut Buffers| unsafe {
            let out = outs(buffers);
            (code.exact_error)(buffers.joints[0].len(), &columns(buffers, 0), &out);
        }),
    );
    for (form, jacobian) in
        [("exact Jacobian", code.exact_jacobian), ("first-order Jacobian", code.first_order_jacobian)]
    {
        add(
            form,
            Box::new(move |buffers: &mut Buffers| {
                for first in (0..buffers.joints[0].len()).step_by(floors::ROWS) {
                    unsafe { jacobian(floors::ROWS, &columns(buffers, first)) };
                    black_box(&buffers.out);
                }
            }),
        );
    }
}
