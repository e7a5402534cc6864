//! Sizes of the thirty errors, for every module of generated code a structure of its own.

use crate::lidar;

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

/// The errors in the order of the declaration.
pub fn in_order(e: lidar::Errors) -> [f64; 30] {
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
