//! Generated Rust behind C names, for `driver.cpp`.

#[allow(dead_code)]
mod lidar {
    include!(concat!(env!("LIDAR"), "/lidar.rs"));
}

use lidar::*;
use std::slice::{from_raw_parts, from_raw_parts_mut};
use std::sync::OnceLock;

static PREPARED: OnceLock<(FirstOrderError, ExactError)> = OnceLock::new();

/// # Safety
/// `errors` are thirty, in the order of the declaration.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rust_prepare(errors: *const f64) {
    // SAFETY: the caller's promise.
    let e = unsafe { from_raw_parts(errors, 30) };
    let errors = Errors {
        dtheta_y1: e[0], dtheta_x1: e[1], dx1: e[2], dy1: e[3], dz1: e[4], da1: e[5], db1: e[6], delta_x2: e[7],
        delta_y2: e[8], dtheta_y2: e[9], dtheta_z2: e[10], dx2: e[11], dy2: e[12], dz2: e[13], db2: e[14], dg2: e[15],
        delta_y3: e[16], dtheta_y3: e[17], dtheta_x3: e[18], dx3: e[19], dy3: e[20], dz3: e[21], da3: e[22],
        db3: e[23], dx4: e[24], dy4: e[25], dz4: e[26], da4: e[27], db4: e[28], dg4: e[29],
    };
    PREPARED.get_or_init(|| (FirstOrderError::prepare(&errors), ExactError::prepare(&errors)));
}

unsafe fn columns<'a>(rows: usize, joints: *const *const f64) -> JointRows<'a> {
    // SAFETY: the callers' promise.
    unsafe {
        let column = |i| from_raw_parts(*joints.add(i), rows);
        JointRows { alpha: column(0), beta: column(1), gamma: column(2) }
    }
}

unsafe fn observed<'a>(rows: usize, out: *const *mut f64) -> Observed<[&'a mut [f64]; 3]> {
    // SAFETY: the callers' promise.
    unsafe {
        let column = |i| from_raw_parts_mut(*out.add(i), rows);
        Observed { pointing: [column(0), column(1), column(2)], position: [column(3), column(4), column(5)] }
    }
}

/// # Safety
/// Three columns in and six out hold `rows` rows and do not overlap.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rust_first_order_error(rows: usize, joints: *const *const f64, out: *const *mut f64) {
    let Some((form, _)) = PREPARED.get() else { return };
    // SAFETY: the caller's promise.
    let _ = unsafe { form.eval_rows(&columns(rows, joints), observed(rows, out)) };
}

/// # Safety
/// As above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rust_exact_error(rows: usize, joints: *const *const f64, out: *const *mut f64) {
    let Some((_, form)) = PREPARED.get() else { return };
    // SAFETY: the caller's promise.
    let _ = unsafe { form.eval_rows(&columns(rows, joints), observed(rows, out)) };
}

/// # Safety
/// Three columns hold `rows` rows.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rust_first_order_jacobian(rows: usize, joints: *const *const f64) {
    // SAFETY: the caller's promise.
    let JointRows { alpha, beta, gamma } = unsafe { columns(rows, joints) };
    let form = FirstOrderJacobian::prepare(&Errors::default());
    let mut block = Box::new(FirstOrderJacobianBlock::default());
    for ((alpha, beta), gamma) in alpha.chunks(ROWS).zip(beta.chunks(ROWS)).zip(gamma.chunks(ROWS)) {
        let _ = form.eval_block(&JointRows { alpha, beta, gamma }, &mut block);
        std::hint::black_box(&block);
    }
}
