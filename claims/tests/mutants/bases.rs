//! True statements of every kind.

use super::tree::Tree::{Letter, Number, One};
use super::tree::{Tree, column, cos, minus, over, product, sin, skew, sum, turn};

/// What a statement is about.
#[derive(Debug, Clone, Copy)]
pub enum Kind {
    /// The error of an observable.
    Error,
    /// The correction of it.
    Correction,
    /// What it shows, to an order.
    Shows(u32),
    /// The matrix of body `fore`, of columns that observables show: to an order, with or without the origin.
    Frame(u32, bool),
    /// The derivatives of the tip by both joints.
    Jacobian,
    /// An image point.
    Image,
    /// That a formula is equal to this other one.
    Equal(fn() -> Tree),
}

/// A true statement.
pub struct Base {
    pub name: &'static str,
    pub chain: &'static str,
    pub kind: Kind,
    pub formula: Tree,
    /// Letters that a mutation may put in place of another.
    pub letters: Vec<&'static str>,
}

/// Letters and the names that they stand for.
pub const NAMES: [(&str, &str); 12] = [
    ("q_1", "q1"),
    ("q_2", "q2"),
    ("l_1", "l1"),
    ("l_2", "l2"),
    (r"\epsilon_1", "e1"),
    (r"\epsilon_2", "e2"),
    (r"\delta_1", "d1"),
    (r"\tau_x", "tx"),
    (r"\tau_y", "ty"),
    ("X", "X"),
    ("Y", "Y"),
    ("Z", "Z"),
];

const ARM: &str = "chain Arm { const l1 = 0.5; const l2 = 0.3;
 body upper on ground { position_error: Rx(tx), Ry(ty); motion: Rz(q1); motion_error: Rz(e1); position: Tx(l1); position_error: Tx(d1); }
 body fore on upper { motion: Ry(q2); motion_error: Ry(e2); position: Tx(l2); }
 observe tip: point(0, 0, 0) of fore; observe ex: direction(1, 0, 0) of fore; observe ey: direction(0, 1, 0) of fore; observe ez: direction(0, 0, 1) of fore; }";

const CAMERA: &str = "chain Cam { input X: length; input Y: length; input Z: length;
 body cam on ground { motion: Tx(q1); motion_error: Tx(d1), Ry(e2); }
 observe tip: point(X, Y, Z) of cam; }";

fn q1() -> Tree {
    Letter("q_1")
}
fn q2() -> Tree {
    Letter("q_2")
}
fn l1() -> Tree {
    Letter("l_1")
}
fn l2() -> Tree {
    Letter("l_2")
}
fn e1() -> Tree {
    Letter(r"\epsilon_1")
}
fn e2() -> Tree {
    Letter(r"\epsilon_2")
}
fn d1() -> Tree {
    Letter(r"\delta_1")
}
fn tx() -> Tree {
    Letter(r"\tau_x")
}
fn ty() -> Tree {
    Letter(r"\tau_y")
}
fn zero() -> Tree {
    Number(0)
}

/// The tip, multiplied out.
fn tip() -> [Tree; 3] {
    let reach = || sum([l1(), product([l2(), cos(q2())])]);
    [product([cos(q1()), reach()]), product([sin(q1()), reach()]), minus(product([l2(), sin(q2())]))]
}

/// The error of the tip.
fn error() -> [Tree; 3] {
    let reach = || sum([l1(), product([l2(), cos(q2())])]);
    [
        sum([
            minus(product([e1(), sin(q1()), reach()])),
            minus(product([e2(), l2(), sin(q2()), cos(q1())])),
            product([d1(), cos(q1())]),
            minus(product([ty(), l2(), sin(q2())])),
        ]),
        sum([
            product([e1(), cos(q1()), reach()]),
            minus(product([e2(), l2(), sin(q2()), sin(q1())])),
            product([d1(), sin(q1())]),
            product([tx(), l2(), sin(q2())]),
        ]),
        sum([
            minus(product([e2(), l2(), cos(q2())])),
            product([tx(), sin(q1()), reach()]),
            minus(product([ty(), cos(q1()), reach()])),
        ]),
    ]
}

/// The error of the tip as a product of matrices that nobody multiplied out, less the tip.
fn small_product() -> Tree {
    let tilt = column([tx(), ty(), zero()]);
    let first = column([zero(), zero(), e1()]);
    let second = column([zero(), e2(), zero()]);
    let inner = sum([
        column([sum([l1(), d1()]), zero(), zero()]),
        product([turn(1, q2()), sum([One, skew(second)]), column([l2(), zero(), zero()])]),
    ]);
    sum([
        product([sum([One, skew(tilt)]), turn(2, q1()), sum([One, skew(first)]), inner]),
        minus(column(tip())),
    ])
}

fn rotation() -> Tree {
    product([turn(2, q1()), turn(1, q2())])
}

fn homogeneous() -> Tree {
    let [x, y, z] = tip();
    Tree::Matrix(
        4,
        vec![
            product([cos(q1()), cos(q2())]),
            minus(sin(q1())),
            product([cos(q1()), sin(q2())]),
            x,
            product([sin(q1()), cos(q2())]),
            cos(q1()),
            product([sin(q1()), sin(q2())]),
            y,
            minus(sin(q2())),
            zero(),
            cos(q2()),
            z,
            zero(),
            zero(),
            zero(),
            Number(1),
        ],
    )
}

fn jacobian() -> Tree {
    let reach = || sum([l1(), product([l2(), cos(q2())])]);
    Tree::Matrix(
        2,
        vec![
            minus(product([sin(q1()), reach()])),
            minus(product([l2(), cos(q1()), sin(q2())])),
            product([cos(q1()), reach()]),
            minus(product([l2(), sin(q1()), sin(q2())])),
            zero(),
            minus(product([l2(), cos(q2())])),
        ],
    )
}

fn image() -> Tree {
    column([
        over(product([l1(), sum([Letter("X"), q1()])]), Letter("Z")),
        over(product([l1(), Letter("Y")]), Letter("Z")),
    ])
}

fn double_angle() -> Tree {
    sum([product([cos(q1()), cos(q2())]), minus(product([sin(q1()), sin(q2())]))])
}

/// Every true statement.
pub fn bases() -> Vec<Base> {
    let letters = vec!["q_1", "q_2", "l_1", "l_2", r"\epsilon_1", r"\epsilon_2", r"\delta_1"];
    let joints = vec!["q_1", "q_2", "l_1", "l_2"];
    let base = |name, chain, kind, formula, letters: &Vec<&'static str>| Base {
        name,
        chain,
        kind,
        formula,
        letters: letters.clone(),
    };
    let [x, y, z] = error();
    let corrected = column([x.clone(), y.clone(), z.clone()].map(minus));
    vec![
        base("error", ARM, Kind::Error, column([x.clone(), y.clone(), z.clone()]), &letters),
        base("product of small matrices", ARM, Kind::Error, small_product(), &letters),
        base("correction", ARM, Kind::Correction, corrected, &letters),
        base("tip", ARM, Kind::Shows(0), column(tip()), &joints),
        base(
            "tip by rotations",
            ARM,
            Kind::Shows(0),
            product([
                turn(2, q1()),
                sum([
                    column([l1(), zero(), zero()]),
                    product([turn(1, q2()), column([l2(), zero(), zero()])]),
                ]),
            ]),
            &joints,
        ),
        base("tip with errors", ARM, Kind::Shows(1), sum([column(tip()), column([x, y, z])]), &letters),
        base("orientation", ARM, Kind::Frame(0, false), rotation(), &joints),
        base(
            "orientation with errors",
            ARM,
            Kind::Frame(1, false),
            product([
                sum([One, skew(column([tx(), ty(), zero()]))]),
                turn(2, sum([q1(), zero()])),
                sum([One, skew(column([zero(), zero(), e1()]))]),
                turn(1, q2()),
                sum([One, skew(column([zero(), e2(), zero()]))]),
            ]),
            &letters,
        ),
        base("pose", ARM, Kind::Frame(0, true), homogeneous(), &joints),
        base("jacobian", ARM, Kind::Jacobian, jacobian(), &joints),
        base("image", CAMERA, Kind::Image, image(), &vec!["q_1", "X", "Y", "Z", "l_1"]),
        base(
            "sum of angles",
            "",
            Kind::Equal(|| cos(sum([q1(), q2()]))),
            double_angle(),
            &vec!["q_1", "q_2", "l_1"],
        ),
        base(
            "quotient",
            "",
            Kind::Equal(|| over(product([l1(), sin(q1())]), cos(q1()))),
            over(product([l1(), sin(q1()), cos(q1())]), product([cos(q1()), cos(q1())])),
            &vec!["q_1", "q_2", "l_1"],
        ),
    ]
}
