//! The mobile lidar's direction and point error, 30 errors, worked out on paper.
//!
//! Signs and names: the chain in `examples/mobile-lidar`. What depends on errors alone is prepared.

use super::lanes::Lanes;
use super::sine_cosine::sin_cos;
use super::three::{Three, all, matrix_times_plus};
use crate::lidar::Errors;

/// Three columns in, six out; all equally long, a multiple of eight.
pub struct Rows<'a> {
    /// Joints α, β, γ, rad.
    pub joints: [&'a [f64]; 3],
    /// Direction error x, y, z; point error x, y, z in m.
    pub out: [&'a mut [f64]; 6],
}

impl Rows<'_> {
    fn is_sound(&self, rows: usize) -> bool {
        let joints = self.joints.iter().map(|column| column.len());
        let mut lengths = joints.chain(self.out.iter().map(|column| column.len()));
        rows.is_multiple_of(8) && lengths.all(|length| length == rows)
    }
}

/// Coefficients of the first-order error: sums of errors that act alike.
pub struct FirstOrder([f64; 15]);

impl FirstOrder {
    /// Sums them up.
    pub fn prepare(e: &Errors) -> Self {
        Self([
            // Tilt of the device's direction below γ: by y errors along x, by x errors along −y.
            e.db3 + e.db4,
            -(e.da3 + e.da4),
            e.dtheta_y3 + e.db2,
            -(e.dtheta_x3 + e.da1),
            e.dtheta_y2 + e.db1,
            e.dtheta_z2,
            e.dtheta_y1,
            e.dtheta_x1,
            // Shifts below γ, below β and below α.
            e.dx3 + e.dx4,
            e.dy3 + e.dy4,
            e.delta_x2 + e.dx1 + e.dx2,
            e.delta_y3 + e.dy2,
            e.dz2 + e.dz3 + e.dz4,
            e.delta_y2 + e.dy1,
            e.dz1,
        ])
    }

    /// All rows.
    ///
    /// # Safety
    /// The processor has the instructions of `L`.
    #[inline(always)]
    pub unsafe fn run<L: Lanes>(&self, mut rows: Rows<'_>) {
        let count = rows.joints[0].len();
        if !rows.is_sound(count) {
            return;
        }
        // SAFETY: all columns hold `count` rows, of which a register's worth from `row` on is read or written.
        unsafe {
            let k = self.0.map(|value| L::all(value));
            let minus_y1 = L::all(-self.0[6]);
            let mut row = 0;
            while row < count {
                let alpha = L::load(rows.joints[0].as_ptr().add(row));
                let beta = L::load(rows.joints[1].as_ptr().add(row));
                let gamma = L::load(rows.joints[2].as_ptr().add(row));
                let (sa, ca) = sin_cos(alpha);
                let (sb, cb) = sin_cos(beta);
                let (sg, cg) = sin_cos(gamma);
                // Direction: (ux, uy) across the middle frame's z axis, then up through β and α.
                let ux = cg.times_plus(k[0], sg.times_from(k[1], k[2]));
                let uy = sg.times_plus(k[0], cg.times_plus(k[1], k[3]));
                let wx = cb.times_plus(k[4], sb.times_plus(k[5], ux));
                let wy = uy.times(cb);
                let dx = wx.times_plus(ca, wy.times_from(sa, cb.times(k[6])));
                let dy = wx.times_plus(sa, wy.times_minus(ca, cb.times(k[7])));
                let dz = sb.times(ca.times_from(k[7], sa.times_plus(minus_y1, uy)));
                // Point: the sum of shifts, each turned by the joints below it.
                let px = cg.times_plus(k[8], sg.times_from(k[9], k[10]));
                let py = sg.times_plus(k[8], cg.times_plus(k[9], k[11]));
                let qy = py.times_plus(cb, sb.times_from(k[12], k[13]));
                let qz = py.times_plus(sb, cb.times_plus(k[12], k[14]));
                let x = px.times_minus(ca, qy.times(sa));
                let y = px.times_plus(sa, qy.times(ca));
                for (out, value) in rows.out.iter_mut().zip([dx, dy, dz, x, y, qz]) {
                    value.store(out.as_mut_ptr().add(row));
                }
                row += L::ROWS;
            }
        }
    }
}

type Matrix = [[f64; 3]; 3];

fn product(a: Matrix, b: Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
}

fn turn_x(angle: f64) -> Matrix {
    let (s, c) = angle.sin_cos();
    [[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]]
}

fn turn_y(angle: f64) -> Matrix {
    let (s, c) = angle.sin_cos();
    [[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]]
}

fn turn_z(angle: f64) -> Matrix {
    let (s, c) = angle.sin_cos();
    [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]
}

fn applied(a: Matrix, v: [f64; 3]) -> [f64; 3] {
    a.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

fn sum(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| a[i] + b[i])
}

/// Constants of the exact error: the turns and shifts of the errors between the joints.
pub struct Exact {
    /// Below α: turn of the outer frame.
    ground: Matrix,
    /// Between α and β: turn and shift.
    outer: (Matrix, [f64; 3]),
    /// Between β and γ: turn; what it adds to the direction (0, 0, 1).
    middle: (Matrix, [f64; 3]),
    /// What turns above γ add to the direction (0, 0, 1).
    direction: [f64; 3],
    /// Shifts above γ, x and y.
    shift: [f64; 2],
    /// Shifts between β and γ, with the z shift above γ turned.
    middle_shift: [f64; 3],
}

impl Exact {
    /// Multiplies them out.
    pub fn prepare(e: &Errors) -> Self {
        let tilt = product(turn_x(e.da1), turn_y(e.db1));
        let middle_tilt = product(turn_y(e.db2), turn_z(e.dg2));
        let middle = product(middle_tilt, product(turn_y(e.dtheta_y3), turn_x(e.dtheta_x3)));
        let tilt3 = product(turn_x(e.da3), turn_y(e.db3));
        let above = product(tilt3, product(turn_x(e.da4), turn_y(e.db4)));
        // The third column less (0, 0, 1); floors are about time, so that cancellation in the last is let be.
        let third = |m: Matrix| [m[0][2], m[1][2], m[2][2] - 1.0];
        let shift = sum([e.dx3, e.dy3, e.dz3], applied(tilt3, [e.dx4, e.dy4, e.dz4]));
        let hung = sum([e.dx2, e.dy2, e.dz2], applied(middle_tilt, [0.0, e.delta_y3, 0.0]));
        Self {
            ground: product(turn_y(e.dtheta_y1), turn_x(e.dtheta_x1)),
            outer: (
                product(tilt, product(turn_y(e.dtheta_y2), turn_z(e.dtheta_z2))),
                sum([e.dx1, e.dy1, e.dz1], applied(tilt, [e.delta_x2, e.delta_y2, 0.0])),
            ),
            middle: (middle, third(middle)),
            direction: third(above),
            shift: [shift[0], shift[1]],
            middle_shift: sum(hung, applied(middle, [0.0, 0.0, shift[2]])),
        }
    }

    /// All rows.
    ///
    /// # Safety
    /// The processor has the instructions of `L`.
    #[inline(always)]
    pub unsafe fn run<L: Lanes>(&self, mut rows: Rows<'_>) {
        let count = rows.joints[0].len();
        if !rows.is_sound(count) {
            return;
        }
        // SAFETY: all columns hold `count` rows, of which a register's worth from `row` on is read or written.
        unsafe {
            let less_one = |mut matrix: Matrix| {
                (0..3).for_each(|i| matrix[i][i] -= 1.0);
                matrix
            };
            let (ground, ground_less) = (matrix::<L>(self.ground), matrix::<L>(less_one(self.ground)));
            let (outer, outer_less) = (matrix::<L>(self.outer.0), matrix::<L>(less_one(self.outer.0)));
            let outer_shift = all::<L>(self.outer.1);
            let (middle, middle_adds) = (matrix::<L>(self.middle.0), all::<L>(self.middle.1));
            let (direction, middle_shift) = (all::<L>(self.direction), all::<L>(self.middle_shift));
            let shift = self.shift.map(|value| L::all(value));
            let mut row = 0;
            while row < count {
                let alpha = L::load(rows.joints[0].as_ptr().add(row));
                let beta = L::load(rows.joints[1].as_ptr().add(row));
                let gamma = L::load(rows.joints[2].as_ptr().add(row));
                let (sa, ca) = sin_cos(alpha);
                let (sb, cb) = sin_cos(beta);
                let (sg, cg) = sin_cos(gamma);

                // What the errors add to the direction, frame by frame to the ground.
                let (x, y) = turned_pair(direction[0], direction[1], sg, cg);
                let added = matrix_times_plus(&middle, [x, y, direction[2]], middle_adds);
                let (y, z) = turned_pair(added[1], added[2], sb, cb);
                let (x, y_whole, z_whole) = (added[0], y.minus(sb), z.plus(cb));
                let added = matrix_times_plus(&outer_less, [x, y_whole, z_whole], [x, y, z]);
                let (x, y) = turned_pair(added[0], added[1], sa, ca);
                let z = added[2];
                let whole = [sa.times_plus(sb, x), ca.times_from(sb, y), z.plus(cb)];
                // Ry·Rx − 1 has no second row's first element.
                let dx = whole[0].times_plus(
                    ground_less[0][0],
                    whole[1].times_plus(ground_less[0][1], whole[2].times_plus(ground_less[0][2], x)),
                );
                let dy = whole[1].times_plus(ground_less[1][1], whole[2].times_plus(ground_less[1][2], y));
                let dz = whole[0].times_plus(
                    ground_less[2][0],
                    whole[1].times_plus(ground_less[2][1], whole[2].times_plus(ground_less[2][2], z)),
                );

                // The point: shifts, turned with errors.
                let (x, y) = turned_pair(shift[0], shift[1], sg, cg);
                let point = [
                    x.times_plus(middle[0][0], y.times_plus(middle[0][1], middle_shift[0])),
                    x.times_plus(middle[1][0], y.times_plus(middle[1][1], middle_shift[1])),
                    x.times_plus(middle[2][0], y.times_plus(middle[2][1], middle_shift[2])),
                ];
                let (y, z) = turned_pair(point[1], point[2], sb, cb);
                let point = matrix_times_plus(&outer, [point[0], y, z], outer_shift);
                let (x, y) = turned_pair(point[0], point[1], sa, ca);
                let z = point[2];
                let px = x.times_plus(ground[0][0], y.times_plus(ground[0][1], z.times(ground[0][2])));
                let py = y.times_plus(ground[1][1], z.times(ground[1][2]));
                let pz = x.times_plus(ground[2][0], y.times_plus(ground[2][1], z.times(ground[2][2])));
                for (out, value) in rows.out.iter_mut().zip([dx, dy, dz, px, py, pz]) {
                    value.store(out.as_mut_ptr().add(row));
                }
                row += L::ROWS;
            }
        }
    }
}

#[inline(always)]
unsafe fn matrix<L: Lanes>(m: Matrix) -> [Three<L>; 3] {
    // SAFETY: the caller's promise.
    unsafe { [all(m[0]), all(m[1]), all(m[2])] }
}

/// Two components turned by an angle of sine `s` and cosine `c`.
#[inline(always)]
unsafe fn turned_pair<L: Lanes>(a: L, b: L, s: L, c: L) -> (L, L) {
    // SAFETY: the caller's promise.
    unsafe { (a.times_minus(c, b.times(s)), a.times_plus(s, b.times(c))) }
}
