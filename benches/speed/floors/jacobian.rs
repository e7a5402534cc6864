//! The mobile lidar's exact Jacobian, direction and point by 30 errors, worked out on paper.
//!
//! A turn about the axis w through the point o moves the direction d by w × d and the point p by w × (p − o); a shift
//! along w moves the point by w. So the columns are ground axes of the frames between the errors, and cross products
//! with them. Of the 180 derivatives 117 depend on the pose and differ; these are stored, three for a column.

use super::ROWS;
use super::lanes::Lanes;
use super::sine_cosine::sin_cos;
use super::three::{Three, across, all, along, cross, times_plus, turned};
use crate::lidar::Errors;

/// The observable (0 direction, 1 point) and the error, by its place in the declaration, of each stored column.
pub const COLUMNS: [(usize, usize); 39] = [
    (0, 0),
    (0, 1),
    (0, 5),
    (0, 6),
    (0, 10),
    (0, 14),
    (0, 15),
    (0, 17),
    (0, 18),
    (0, 22),
    (0, 23),
    (0, 27),
    (0, 28),
    (1, 0),
    (1, 1),
    (1, 5),
    (1, 6),
    (1, 9),
    (1, 10),
    (1, 14),
    (1, 15),
    (1, 17),
    (1, 18),
    (1, 22),
    (1, 23),
    (1, 2),
    (1, 3),
    (1, 7),
    (1, 8),
    (1, 11),
    (1, 12),
    (1, 13),
    (1, 16),
    (1, 19),
    (1, 20),
    (1, 21),
    (1, 24),
    (1, 25),
    (1, 26),
];

/// Columns of a block, x, y and z after each other; longer than a block, so that they do not meet in the cache.
pub type Block = [[[f64; ROWS + 8]; 3]; COLUMNS.len()];

type Vector = [f64; 3];

fn turned_x(angle: f64, [x, y, z]: Vector) -> Vector {
    let (s, c) = angle.sin_cos();
    [x, c * y - s * z, s * y + c * z]
}

fn turned_y(angle: f64, [x, y, z]: Vector) -> Vector {
    let (s, c) = angle.sin_cos();
    [c * x + s * z, y, c * z - s * x]
}

fn turned_z(angle: f64, [x, y, z]: Vector) -> Vector {
    let (s, c) = angle.sin_cos();
    [c * x - s * y, s * x + c * y, z]
}

const X: Vector = [1.0, 0.0, 0.0];
const Y: Vector = [0.0, 1.0, 0.0];
const Z: Vector = [0.0, 0.0, 1.0];

/// Constants of the errors: axes and shifts in the coordinates of the joint's frame that they hang on.
pub struct Jacobian {
    /// The second axis below α, and the ground's axes there.
    x1: Vector,
    ground: [Vector; 3],
    /// In the frame after α: axes of the shifts δx2 and δy2; what β turns; the shift after α.
    shift_x2: Vector,
    shift_y2: Vector,
    middle: [Vector; 3],
    outer_shift: Vector,
    intersection: [f64; 2],
    /// In the frame after β.
    g2: Vector,
    shift_y3: Vector,
    inner: [Vector; 3],
    middle_shift: Vector,
    delta_y3: f64,
    /// In the frame after γ.
    shift_4: [Vector; 3],
    b4: Vector,
    direction: Vector,
    above_3: Vector,
    above_4: Vector,
}

impl Jacobian {
    /// Turns axes and shifts down to their joints.
    pub fn prepare(e: &Errors) -> Self {
        let ground = |v| turned_y(e.dtheta_y1, turned_x(e.dtheta_x1, v));
        let outer = |v| turned_x(e.da1, turned_y(e.db1, v));
        let middle = |v| outer(turned_y(e.dtheta_y2, turned_z(e.dtheta_z2, v)));
        let hung = |v| turned_y(e.db2, turned_z(e.dg2, v));
        let inner = |v| hung(turned_y(e.dtheta_y3, turned_x(e.dtheta_x3, v)));
        let device = |v| turned_x(e.da3, turned_y(e.db3, v));
        let shift_4 = device([e.dx4, e.dy4, e.dz4]);
        Self {
            x1: turned_y(e.dtheta_y1, X),
            ground: [X, Y, Z].map(ground),
            shift_x2: outer(X),
            shift_y2: outer(Y),
            middle: [X, Y, Z].map(middle),
            outer_shift: [e.dx1, e.dy1, e.dz1],
            intersection: [e.delta_x2, e.delta_y2],
            g2: turned_y(e.db2, Z),
            shift_y3: hung(Y),
            inner: [X, Y, Z].map(inner),
            middle_shift: [e.dx2, e.dy2, e.dz2],
            delta_y3: e.delta_y3,
            shift_4: [X, Y, Z].map(device),
            b4: device(turned_x(e.da4, Y)),
            direction: device(turned_x(e.da4, turned_y(e.db4, Z))),
            above_3: [e.dx3 + shift_4[0], e.dy3 + shift_4[1], e.dz3 + shift_4[2]],
            above_4: shift_4,
        }
    }

    /// One block.
    ///
    /// # Safety
    /// The processor has the instructions of `L`.
    #[inline(always)]
    pub unsafe fn run<L: Lanes>(&self, joints: [&[f64; ROWS]; 3], out: &mut Block) {
        // SAFETY: `row` runs over the rows of a block, which columns and outputs hold.
        unsafe {
            let x1 = all::<L>(self.x1);
            let ground = [all::<L>(self.ground[0]), all(self.ground[1]), all(self.ground[2])];
            let zero = L::all(0.0);
            for row in (0..ROWS).step_by(L::ROWS) {
                let (sa, ca) = sin_cos(L::load(joints[0].as_ptr().add(row)));
                let (sb, cb) = sin_cos(L::load(joints[1].as_ptr().add(row)));
                let (sg, cg) = sin_cos(L::load(joints[2].as_ptr().add(row)));
                // Each column is stored as soon as it is known, so that few values wait.
                // Axes after α (Ry·Rx has no y in its first column), after β, after γ.
                let ax = [
                    ground[0][0].times_plus(ca, ground[1][0].times(sa)),
                    ground[1][1].times(sa),
                    ground[0][2].times_plus(ca, ground[1][2].times(sa)),
                ];
                let ay = [
                    ground[1][0].times_minus(ca, ground[0][0].times(sa)),
                    ground[1][1].times(ca),
                    ground[1][2].times_minus(ca, ground[0][2].times(sa)),
                ];
                let a = [ax, ay, ground[2]];
                put(out, 25, row, ax);
                put(out, 26, row, ay);
                let shift_x2 = along(&a, self.shift_x2);
                put(out, 27, row, shift_x2);
                let shift_y2 = across(a[1], self.shift_y2[1], a[2], self.shift_y2[2]);
                put(out, 28, row, shift_y2);
                let bx = along(&a, self.middle[0]);
                let my = along(&a, self.middle[1]);
                let z2 = along(&a, self.middle[2]);
                let (by, bz) = turned(my, z2, sb, cb);
                let b = [bx, by, bz];
                put(out, 29, row, bx);
                put(out, 30, row, by);
                put(out, 31, row, bz);
                let g2 = across(b[0], self.g2[0], b[2], self.g2[2]);
                let shift_y3 = along(&b, self.shift_y3);
                put(out, 32, row, shift_y3);
                let x3 = along(&b, self.inner[0]);
                let iy = along(&b, self.inner[1]);
                let cz = along(&b, self.inner[2]);
                let (cx, cy) = turned(x3, iy, sg, cg);
                let c = [cx, cy, cz];
                put(out, 33, row, cx);
                put(out, 34, row, cy);
                put(out, 35, row, cz);
                let x4 = along(&c, self.shift_4[0]);
                put(out, 36, row, x4);
                let y4 = across(c[1], self.shift_4[1][1], c[2], self.shift_4[1][2]);
                put(out, 37, row, y4);
                let z4 = along(&c, self.shift_4[2]);
                put(out, 38, row, z4);
                let b4 = along(&c, self.b4);

                let d = along(&c, self.direction);
                put(out, 0, row, [d[2], zero, zero.minus(d[0])]);
                put(
                    out,
                    1,
                    row,
                    [
                        x1[2].times_from(d[1], zero),
                        x1[2].times_minus(d[0], x1[0].times(d[2])),
                        x1[0].times(d[1]),
                    ],
                );
                put(out, 2, row, cross(ax, d));
                put(out, 3, row, cross(shift_y2, d));
                put(out, 4, row, cross(z2, d));
                put(out, 5, row, cross(by, d));
                put(out, 6, row, cross(g2, d));
                put(out, 7, row, cross(shift_y3, d));
                put(out, 8, row, cross(x3, d));
                put(out, 9, row, cross(cx, d));
                put(out, 10, row, cross(y4, d));
                put(out, 11, row, cross(x4, d));
                put(out, 12, row, cross(b4, d));

                // The point as seen from each origin.
                let from_3 = along(&c, self.above_4);
                put(out, 23, row, cross(cx, from_3));
                put(out, 24, row, cross(y4, from_3));
                let from_y3 = along(&c, self.above_3);
                put(out, 21, row, cross(shift_y3, from_y3));
                put(out, 22, row, cross(x3, from_y3));
                let from_b2 = times_plus(shift_y3, L::all(self.delta_y3), from_y3);
                put(out, 19, row, cross(by, from_b2));
                put(out, 20, row, cross(g2, from_b2));
                let [x, y, z] = all::<L>(self.middle_shift);
                let from_y2 = times_plus(b[0], x, times_plus(b[1], y, times_plus(b[2], z, from_b2)));
                put(out, 17, row, cross(shift_y2, from_y2));
                put(out, 18, row, cross(z2, from_y2));
                let [x2, y2] = self.intersection;
                let from_1 = times_plus(shift_x2, L::all(x2), times_plus(shift_y2, L::all(y2), from_y2));
                put(out, 15, row, cross(ax, from_1));
                put(out, 16, row, cross(shift_y2, from_1));
                let [x, y, z] = all::<L>(self.outer_shift);
                let p = times_plus(a[0], x, times_plus(a[1], y, times_plus(a[2], z, from_1)));
                put(out, 13, row, [p[2], zero, zero.minus(p[0])]);
                put(
                    out,
                    14,
                    row,
                    [
                        x1[2].times_from(p[1], zero),
                        x1[2].times_minus(p[0], x1[0].times(p[2])),
                        x1[0].times(p[1]),
                    ],
                );
            }
        }
    }
}

/// Stores one column's rows.
#[inline(always)]
unsafe fn put<L: Lanes>(out: &mut Block, column: usize, row: usize, value: Three<L>) {
    // SAFETY: the caller's `row` is that of a whole register within the block.
    unsafe {
        value[0].store(out[column][0].as_mut_ptr().add(row));
        value[1].store(out[column][1].as_mut_ptr().add(row));
        value[2].store(out[column][2].as_mut_ptr().add(row));
    }
}
