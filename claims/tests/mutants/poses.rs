//! Mutants of poses: tables of Denavit and Hartenberg against products of matrices, and products of exponentials. What is true is
//! computed here with matrices of numbers.

use std::fmt::Write as _;

use super::support;
use super::tree::Random;

/// Mutants of each kind.
const MADE: usize = 120;

type Pose = [[f64; 4]; 4];

fn product(a: &Pose, b: &Pose) -> Pose {
    std::array::from_fn(|row| {
        std::array::from_fn(|column| (0..4).map(|inner| a[row][inner] * b[inner][column]).sum())
    })
}

/// A turn about an axis through the origin, and a shift along it.
fn moved(axis: usize, angle: f64, along: f64) -> Pose {
    let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut pose = [[0.0; 4]; 4];
    (pose[axis][axis], pose[3][3], pose[axis][3]) = (1.0, 1.0, along);
    (pose[j][j], pose[k][k]) = (angle.cos(), angle.cos());
    (pose[j][k], pose[k][j]) = (-angle.sin(), angle.sin());
    pose
}

fn is_same(a: &Pose, b: &Pose) -> bool {
    a.iter().flatten().zip(b.iter().flatten()).all(|(a, b)| (a - b).abs() < 1e-9)
}

/// Angles of no meaning.
const POSES: [[f64; 3]; 3] = [[0.3, -0.9, 1.7], [2.1, 0.4, -0.6], [-1.3, 1.1, 0.8]];

/// A row of a table: length and offset in eighths, twist in quarter turns, and the joint that turns it.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Row {
    a: usize,
    d: usize,
    twist: usize,
    joint: usize,
    /// An entry of its matrix whose sign is wrong.
    slip: Option<[usize; 2]>,
}

impl Row {
    fn random(joint: usize, random: &mut Random) -> Self {
        Self { a: random.below(3), d: random.below(3), twist: random.below(4), joint, slip: None }
    }

    /// As Denavit and Hartenberg have it, or as Craig does.
    fn pose(&self, angles: &[f64; 3], is_standard: bool) -> Pose {
        let twist = moved(0, self.twist as f64 * std::f64::consts::FRAC_PI_2, self.a as f64 / 8.0);
        let turn = moved(2, angles[self.joint], self.d as f64 / 8.0);
        let mut pose = if is_standard { product(&turn, &twist) } else { product(&twist, &turn) };
        if let Some([row, column]) = self.slip {
            pose[row][column] = -pose[row][column];
        }
        pose
    }

    /// The matrix as a paper prints it.
    fn printed(&self, is_standard: bool) -> String {
        let (cosine, sine) = ([1, 0, -1, 0][self.twist], [0, 1, 0, -1][self.twist]);
        let j = self.joint + 1;
        let (c, s) = (format!("c_{j}"), format!("s_{j}"));
        let times = |factor: i32, what: &str| match factor {
            0 => "0".to_owned(),
            1 => what.to_owned(),
            _ => format!("-{what}"),
        };
        let length = |eighths: usize, what: &str| format!("{} {what}", eighths as f64 / 8.0);
        let number = |eighths: f64| (eighths / 8.0).to_string();
        let (a, d) = (self.a as f64, self.d as f64);
        let mut entries: [[String; 4]; 3] = if is_standard {
            [
                [c.clone(), times(-cosine, &s), times(sine, &s), length(self.a, &c)],
                [s.clone(), times(cosine, &c), times(-sine, &c), length(self.a, &s)],
                ["0".to_owned(), sine.to_string(), cosine.to_string(), number(d)],
            ]
        } else {
            let (along_y, along_z) = (number(-f64::from(sine) * d), number(f64::from(cosine) * d));
            [
                [c.clone(), format!("-{s}"), "0".to_owned(), number(a)],
                [times(cosine, &s), times(cosine, &c), (-sine).to_string(), along_y],
                [times(sine, &s), times(sine, &c), cosine.to_string(), along_z],
            ]
        };
        if let Some([row, column]) = self.slip {
            entries[row][column] = format!("-({})", entries[row][column]);
        }
        let rows: Vec<String> = entries.iter().map(|row| row.join(" & ")).collect();
        format!(r"\begin{{bmatrix}} {} \\ 0 & 0 & 0 & 1 \end{{bmatrix}}", rows.join(r" \\ "))
    }
}

/// The file of a table, with the product of other rows as its claim.
fn table(rows: &[Row; 3], printed: &[Row; 3], conventions: [bool; 2]) -> String {
    let name = |is_standard: bool| if is_standard { "standard" } else { "modified" };
    let mut file = format!("[dh]\nconvention = \"{}\"\nrows = [\n", name(conventions[0]));
    for (at, row) in rows.iter().enumerate() {
        let (a, d) = (row.a as f64 / 8.0, row.d as f64 / 8.0);
        let _ = writeln!(
            file,
            "    {{ theta = \"q{}\", a = \"{a}\", d = \"{d}\", alpha = \"{}*pi/2\" }},",
            at + 1,
            row.twist
        );
    }
    let product: Vec<String> = printed.iter().map(|row| row.printed(conventions[1])).collect();
    let _ = write!(file, "]\n[[claim]]\nname = \"a\"\nbody = \"link3\"\nframe = '{}'\n", product.concat());
    file
}

#[test]
fn no_table_gets_a_wrong_verdict() {
    let mut random = Random(19);
    let (mut holding, mut differing) = (0, 0);
    for _ in 0..MADE {
        let rows: [Row; 3] = std::array::from_fn(|joint| Row::random(joint, &mut random));
        let is_standard = random.below(2) == 0;
        let (mut printed, mut prints_standard) = (rows, is_standard);
        let at = random.below(3);
        match random.below(8) {
            0 => printed[at].slip = Some([random.below(3), random.below(4)]),
            1 => printed[at].twist = (printed[at].twist + 2) % 4,
            2 => printed.swap(at, (at + 1) % 3),
            3 => printed[at].joint = (at + 1) % 3,
            4 => printed[at].d += 1,
            5 => prints_standard = !is_standard,
            _ => {}
        }
        let pose = |rows: &[Row; 3], is_standard: bool, angles: &[f64; 3]| {
            let [first, second, third] = rows.map(|row| row.pose(angles, is_standard));
            product(&product(&first, &second), &third)
        };
        let truth = POSES.iter().all(|angles| {
            is_same(&pose(&rows, is_standard, angles), &pose(&printed, prints_standard, angles))
        });
        judged(&table(&rows, &printed, [is_standard, prints_standard]), "", truth);
        if truth { holding += 1 } else { differing += 1 }
    }
    assert!(holding > MADE / 5 && differing > MADE / 3, "{holding} {differing}");
}

/// That every entry holds where the statement is true, and one differs where it is not.
fn judged(file: &str, chain: &str, truth: bool) {
    let found = support::verdicts(chain, file);
    assert!(found.iter().all(|(_, said)| said == "holds" || said == "differs"), "{file}\n{found:?}");
    assert_eq!(found.iter().all(|(_, said)| said == "holds"), truth, "{file}\n{found:?}");
}

const ARM: &str = "chain Arm { body base on ground { motion: Rz(q1); position: Tz(0.25); }
 body upper on base { motion: Ry(q2); position: Tx(0.5); }
 body fore on upper { motion: Ry(q3); position: Tx(0.375); }
 observe tip: point(0, 0, 0) of fore; }";

/// Angular and linear velocity of each screw of the arm, in eighths.
const SCREWS: [[i32; 6]; 3] = [[0, 0, 8, 0, 0, 0], [0, 8, 0, -2, 0, 0], [0, 8, 0, -2, 0, 4]];

/// The motion of a screw about an axis of the frame: the turn, and what the point where the axis is nearest to the origin is shifted by.
///
/// Source: Murray, Li, Sastry, A Mathematical Introduction to Robotic Manipulation (1994), section 2.3.
fn exponential(screw: &[i32; 6], angle: f64) -> Pose {
    let parts = screw.map(|part| f64::from(part) / 8.0);
    let axis = parts.iter().take(3).position(|part| *part != 0.0).unwrap();
    let sign = parts[axis];
    let mut pose = moved(axis, sign * angle, 0.0);
    // The velocity, summed up on the way: twice as fine as the tolerance wants.
    let steps = 2000;
    for step in 0..steps {
        let turned = moved(axis, sign * angle * (f64::from(step) + 0.5) / f64::from(steps), 0.0);
        let width = angle / f64::from(steps);
        for row in 0..3 {
            pose[row][3] += width * (0..3).map(|at| turned[row][at] * parts[3 + at]).sum::<f64>();
        }
    }
    pose
}

#[test]
fn no_product_of_exponentials_gets_a_wrong_verdict() {
    let mut random = Random(37);
    let (mut holding, mut differing) = (0, 0);
    for _ in 0..MADE / 2 {
        let (mut screws, mut order, mut start) = (SCREWS, [0, 1, 2], [7, 0, 2]);
        let at = random.below(3);
        match random.below(7) {
            0 => screws[at] = screws[at].map(|part| -part),
            1 => screws[at][3 + random.below(3)] += 2,
            2 => order.swap(at, (at + 1) % 3),
            3 => start[at] += 1,
            4 => screws[at].rotate_left(1),
            _ => {}
        }
        // The axis has to have the length 1.
        if screws.iter().any(|screw| screw[..3].iter().map(|part| part * part).sum::<i32>() != 64) {
            continue;
        }
        let truth = POSES.iter().all(|angles| {
            let arm = [moved(2, angles[0], 0.25), moved(1, angles[1], 0.0), moved(0, 0.0, 0.5)]
                .into_iter()
                .chain([moved(1, angles[2], 0.0), moved(0, 0.0, 0.375)]);
            let right = arm.reduce(|a, b| product(&a, &b)).unwrap();
            let mut last = moved(0, 0.0, 0.0);
            for (row, eighths) in start.iter().enumerate() {
                last[row][3] = f64::from(*eighths) / 8.0;
            }
            let printed = order.iter().map(|&joint| exponential(&screws[joint], angles[joint]));
            let said = printed.chain([last]).reduce(|a, b| product(&a, &b)).unwrap();
            right.iter().flatten().zip(said.iter().flatten()).all(|(a, b)| (a - b).abs() < 1e-5)
        });
        let text = |parts: &[i32]| {
            let parts: Vec<String> = parts.iter().map(|part| (f64::from(*part) / 8.0).to_string()).collect();
            format!("[{}]", parts.join(", "))
        };
        let mut file = "chain = \"a\"\n[symbols]\n".to_owned();
        for (at, screw) in screws.iter().enumerate() {
            let (omega, v) = (text(&screw[..3]), text(&screw[3..]));
            let _ = writeln!(file, "'\\xi_{}' = {{ omega = \"{omega}\", v = \"{v}\" }}", at + 1);
        }
        let factors: String =
            order.iter().map(|joint| format!(r"e^{{\hat\xi_{0} q_{0}}}", joint + 1)).collect();
        let _ = writeln!(
            file,
            "'\\mathbf{{p}}_0' = \"{}\"\n[[claim]]\nname = \"a\"\nbody = \"fore\"\nframe = '{factors}\\begin{{bmatrix}} I & \\mathbf{{p}}_0 \\\\ 0 & 1 \\end{{bmatrix}}'",
            text(&start)
        );
        judged(&file, ARM, truth);
        if truth { holding += 1 } else { differing += 1 }
    }
    assert!(holding >= 5 && differing >= 15, "{holding} {differing}");
}
