//! Simulated instruments: each a declaration in words, and the same mechanism as steps of its own, multiplied by hand.

use std::f64::consts::FRAC_PI_2;

use testkit::{Random, turned};

/// One step from the ground to what is observed.
#[derive(Clone, Copy)]
pub enum Step {
    /// A turn about an axis by a joint times a factor.
    Joint(usize, f64, usize),
    /// A turn about an axis by an error times a factor.
    Error(usize, f64, usize),
    /// A turn about an axis by a fixed angle, rad.
    Turn(usize, f64),
    /// A shift along an axis by an error, m.
    Length(usize, usize),
    /// A shift along an axis by a fixed length, m.
    Shift(usize, f64),
    /// A shift along an axis by a joint, m.
    Slide(usize, usize),
}

/// How an instrument is observed.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Observed {
    /// An azimuth from y through x, and an elevation; two columns of angles.
    Spherical,
    /// A direction; three columns without a unit.
    Direction,
    /// A point; three columns of lengths.
    Point,
    /// How the last body is turned: a quaternion w, x, y, z; four columns without a unit.
    Quaternion,
}

pub struct Instrument {
    pub name: &'static str,
    pub chain: &'static str,
    /// Name, lower and upper end of each joint, deg or m.
    pub joints: &'static [(&'static str, f64, f64)],
    /// Whether each joint's zero is a declared error.
    pub indexed: bool,
    pub steps: &'static [Step],
    /// What is looked along, or the point in the last frame, m.
    pub last: [f64; 3],
    pub observed: Observed,
    pub observed_names: &'static [&'static str],
    /// Standard deviation of the noise, rad or m.
    pub noise: f64,
}

use Step::{Error, Joint, Length, Shift, Slide, Turn};

const MOUNT: &[Step] = &[
    Error(0, 1.0, 0),
    Error(1, 1.0, 1),
    Joint(2, -1.0, 0),
    Error(2, -1.0, 2),
    Error(1, 1.0, 3),
    Joint(0, 1.0, 1),
    Error(0, 1.0, 4),
    Error(2, 1.0, 5),
];

pub const INSTRUMENTS: &[Instrument] = &[
    Instrument {
        name: "alt-azimuth",
        chain: "chain Mount {
    body fork on ground { position_error: Rx(tilt_east), Ry(tilt_north); motion: Rz(-azimuth); motion_error: Rz(-azimuth_index); }
    body tube on fork { position_error: Ry(skew); motion: Rx(elevation); motion_error: Rx(elevation_index), Rz(collimation); }
    observe sight: direction(0, 1, 0) of tube;
}
",
        joints: &[("azimuth", -180.0, 180.0), ("elevation", 12.0, 82.0)],
        indexed: true,
        steps: MOUNT,
        last: [0.0, 1.0, 0.0],
        observed: Observed::Spherical,
        observed_names: &["azimuth", "elevation"],
        noise: 1e-5,
    },
    Instrument {
        name: "equatorial",
        chain: "chain Mount {
    body fork on ground { position_error: Rx(polar_up), Ry(polar_side); motion: Rz(-ha); motion_error: Rz(-ha_index); }
    body tube on fork { position_error: Ry(skew); motion: Rx(dec); motion_error: Rx(dec_index), Rz(collimation); }
    observe sight: direction(0, 1, 0) of tube;
}
",
        joints: &[("ha", -80.0, 80.0), ("dec", -25.0, 80.0)],
        indexed: true,
        steps: MOUNT,
        last: [0.0, 1.0, 0.0],
        observed: Observed::Spherical,
        observed_names: &["ha", "dec"],
        noise: 2e-5,
    },
    Instrument {
        name: "scanner",
        chain: "chain Scanner {
    body outer on ground { position_error: Rx(tilt_x), Ry(tilt_y); motion: Rz(alpha); motion_error: Rx(wobble_x); }
    body middle on outer { position_error: Ry(skew_y), Rz(skew_z); motion: Rx(beta); motion_error: Rx(index_b); }
    body inner on middle { position_error: Rx(skew_x); motion: Rz(gamma); motion_error: Rz(index_c); }
    observe beam: direction(0, 1, 0) of inner;
}
",
        joints: &[("alpha", 0.0, 360.0), ("beta", -60.0, 60.0), ("gamma", -40.0, 40.0)],
        indexed: false,
        steps: &[
            Error(0, 1.0, 0),
            Error(1, 1.0, 1),
            Joint(2, 1.0, 0),
            Error(0, 1.0, 2),
            Error(1, 1.0, 3),
            Error(2, 1.0, 4),
            Joint(0, 1.0, 1),
            Error(0, 1.0, 5),
            Error(0, 1.0, 6),
            Joint(2, 1.0, 2),
            Error(2, 1.0, 7),
        ],
        last: [0.0, 1.0, 0.0],
        observed: Observed::Direction,
        observed_names: &["x", "y", "z"],
        noise: 1e-5,
    },
    Instrument {
        name: "arm",
        chain: "chain Arm {
    body shoulder on ground { motion: Rz(q1); motion_error: Rz(zero1), Rx(tilt1); }
    body arm on shoulder { position: Rx(pi/2); motion: Rz(q2); motion_error: Rz(zero2), Ry(skew2); }
    body hand on arm { position: Tx(0.612); position_error: Tx(length2); motion: Rz(q3); motion_error: Rz(zero3), Tx(length3); }
    observe tip: point(0.572, 0, 0) of hand;
}
",
        joints: &[("q1", -160.0, 160.0), ("q2", -80.0, 80.0), ("q3", -140.0, 140.0)],
        indexed: true,
        steps: &[
            Joint(2, 1.0, 0),
            Error(2, 1.0, 0),
            Error(0, 1.0, 1),
            Turn(0, FRAC_PI_2),
            Joint(2, 1.0, 1),
            Error(2, 1.0, 2),
            Error(1, 1.0, 3),
            Shift(0, 0.612),
            Length(0, 4),
            Joint(2, 1.0, 2),
            Error(2, 1.0, 5),
            Length(0, 6),
        ],
        last: [0.572, 0.0, 0.0],
        observed: Observed::Point,
        observed_names: &["x", "y", "z"],
        noise: 5e-5,
    },
    Instrument {
        name: "total station",
        chain: "chain Station {
    body head on ground { position_error: Rx(tilt_x), Ry(tilt_y); motion: Rz(-pan); motion_error: Rz(-pan_index); }
    body scope on head { position_error: Ry(skew); motion: Rx(tilt); motion_error: Rx(tilt_index), Rz(collimation); }
    body beam on scope { motion: Ty(range); motion_error: Ty(zero); }
    observe mark: point(0, 0, 0) of beam;
}
",
        joints: &[("pan", -180.0, 180.0), ("tilt", -40.0, 50.0), ("range", 3.0, 60.0)],
        indexed: true,
        steps: &[
            Error(0, 1.0, 0),
            Error(1, 1.0, 1),
            Joint(2, -1.0, 0),
            Error(2, -1.0, 2),
            Error(1, 1.0, 3),
            Joint(0, 1.0, 1),
            Error(0, 1.0, 4),
            Error(2, 1.0, 5),
            Slide(1, 2),
            Length(1, 6),
        ],
        last: [0.0, 0.0, 0.0],
        observed: Observed::Point,
        observed_names: &["x", "y", "z"],
        noise: 3e-4,
    },
    Instrument {
        name: "wrist",
        chain: "chain Wrist {
    body fore on ground { motion: Rz(q4); motion_error: Rz(zero4), Rx(tilt4); }
    body bend on fore { motion: Ry(q5); motion_error: Ry(zero5), Rz(skew5); }
    body hand on bend { motion: Rz(q6); motion_error: Rz(zero6), Rx(lean6); }
    observe pose: orientation of hand;
}
",
        joints: &[("q4", -170.0, 170.0), ("q5", -100.0, 100.0), ("q6", -170.0, 170.0)],
        indexed: true,
        steps: &[
            Joint(2, 1.0, 0),
            Error(2, 1.0, 0),
            Error(0, 1.0, 1),
            Joint(1, 1.0, 1),
            Error(1, 1.0, 2),
            Error(2, 1.0, 3),
            Joint(2, 1.0, 2),
            Error(2, 1.0, 4),
            Error(0, 1.0, 5),
        ],
        last: [0.0, 0.0, 0.0],
        observed: Observed::Quaternion,
        observed_names: &["w", "x", "y", "z"],
        noise: 5e-5,
    },
    Instrument {
        name: "turntable",
        chain: "chain Turntable {
    body table on ground { position_error: Rx(tilt_x), Ry(tilt_y); motion: Rz(angle); motion_error: Rz(index); }
    observe pointer: direction(1, 0, 0) of table;
}
",
        joints: &[("angle", 0.0, 360.0)],
        indexed: true,
        steps: &[Error(0, 1.0, 0), Error(1, 1.0, 1), Joint(2, 1.0, 0), Error(2, 1.0, 2)],
        last: [1.0, 0.0, 0.0],
        observed: Observed::Direction,
        observed_names: &["x", "y", "z"],
        noise: 5e-6,
    },
];

impl Instrument {
    /// Whether the numbers of a joint are lengths.
    pub fn slides(&self, joint: usize) -> bool {
        self.steps.iter().any(|step| matches!(step, Slide(_, own) if *own == joint))
    }

    /// How many errors it has, and which of them are lengths.
    pub fn errors(&self) -> Vec<bool> {
        let mut all: Vec<(usize, bool)> = Vec::new();
        for step in self.steps {
            match step {
                Error(_, _, error) => all.push((*error, false)),
                Length(_, error) => all.push((*error, true)),
                _ => {}
            }
        }
        all.sort_unstable();
        all.into_iter().map(|(_, is_length)| is_length).collect()
    }

    /// What is observed, rad, m or 1, at joints, rad or m, with errors, rad or m.
    pub fn observed_at(&self, joints: &[f64], errors: &[f64], random: &mut Random) -> Vec<f64> {
        if self.observed == Observed::Quaternion {
            return self.quaternion_at(joints, errors, random);
        }
        let mut vector = self.carried(self.last, joints, errors);
        vector.iter_mut().for_each(|value| *value += self.noise * random.normal());
        match self.observed {
            Observed::Spherical => {
                let [x, y, z] = vector;
                vec![x.atan2(y), z.atan2(x.hypot(y))]
            }
            Observed::Direction => {
                let size = vector.iter().map(|value| value * value).sum::<f64>().sqrt();
                vector.iter().map(|value| value / size).collect()
            }
            Observed::Point | Observed::Quaternion => vector.to_vec(),
        }
    }

    /// How the last body is turned, with noise about each axis.
    fn quaternion_at(&self, joints: &[f64], errors: &[f64], random: &mut Random) -> Vec<f64> {
        let noise = [0; 3].map(|_| self.noise * random.normal());
        let column = |axis: usize| {
            let mut unit = [0.0; 3];
            unit[axis] = 1.0;
            let turned_by_noise = (0..3).fold(unit, |vector, axis| turned(axis, noise[axis], vector));
            self.carried(turned_by_noise, joints, errors)
        };
        // Entry [column][row] of the matrix.
        let m = [column(0), column(1), column(2)];
        let four = [
            1.0 + m[0][0] + m[1][1] + m[2][2],
            1.0 + m[0][0] - m[1][1] - m[2][2],
            1.0 - m[0][0] + m[1][1] - m[2][2],
            1.0 - m[0][0] - m[1][1] + m[2][2],
        ];
        let [xy, xz, yz] = [m[0][1] + m[1][0], m[0][2] + m[2][0], m[1][2] + m[2][1]];
        let [wx, wy, wz] = [m[1][2] - m[2][1], m[2][0] - m[0][2], m[0][1] - m[1][0]];
        // The row of products with the largest component is the most exact.
        let rows =
            [[four[0], wx, wy, wz], [wx, four[1], xy, xz], [wy, xy, four[2], yz], [wz, xz, yz, four[3]]];
        let largest = (1..4).fold(0, |best, at| if four[at] > four[best] { at } else { best });
        rows[largest].iter().map(|value| value / (2.0 * four[largest].sqrt())).collect()
    }

    /// A vector of the last frame in the ground's.
    fn carried(&self, mut vector: [f64; 3], joints: &[f64], errors: &[f64]) -> [f64; 3] {
        let is_point = self.observed == Observed::Point;
        for step in self.steps.iter().rev() {
            match *step {
                Joint(axis, factor, joint) => vector = turned(axis, factor * joints[joint], vector),
                Error(axis, factor, error) => vector = turned(axis, factor * errors[error], vector),
                Turn(axis, angle_rad) => vector = turned(axis, angle_rad, vector),
                Length(axis, error) if is_point => vector[axis] += errors[error],
                Shift(axis, length_m) if is_point => vector[axis] += length_m,
                Slide(axis, joint) if is_point => vector[axis] += joints[joint],
                Length(..) | Shift(..) | Slide(..) => {}
            }
        }
        vector
    }
}
