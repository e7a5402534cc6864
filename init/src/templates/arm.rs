//! Arms of six joints, by positions of a reflector on the flange: which of the known arms it is, its rows show.

use std::fmt::Write as _;

use fit::fit;
use model_core::Chain;
use study::Study;
use tables::ur::{ARMS, Arm, JOINTS};

use super::{Beside, Template};
use crate::look::{Look, Read};
use crate::words::Part;
use crate::{Draft, Observed};

pub const TEMPLATE: Template = Template {
    name: "arm",
    what: "an arm of six joints of the sizes UR3 to UR16e, with positions of a reflector on its flange",
    looks_for: "q1, q2, q3, q4, q5, q6; x, y, z of the reflector",
    fits: |look| joints(look).is_ok_and(|joints| joints.len() >= 3),
    draft,
};

/// Poses that an arm is recognised by, at most.
const POSES: usize = 60;
/// An arm is recognised where its nominal sizes leave less than this share of its reach.
const RECOGNISED: f64 = 0.02;

/// The readings of joints 1, 2, …, as far as there are such columns.
fn joints(look: &Look) -> Result<Vec<&crate::look::Column>, String> {
    let all = (1..10).map(|number| look.reading(&[Part::Joint(number)]));
    let found: Vec<_> = all.collect::<Result<_, _>>()?;
    Ok(found.into_iter().map_while(|column| column).collect())
}

fn draft(look: &Look) -> Result<Draft, String> {
    let mut remarks = Vec::new();
    let columns = joints(look)?;
    if columns.len() != JOINTS {
        return Err(format!(
            "{}: {} columns of joints, `q1`, `q2`, …: arms of {JOINTS} joints are known; write the chain of another by hand, \
             after examples/ur10/ur10.chain",
            look.file,
            columns.len()
        ));
    }
    let joints = look.angles(&columns, &mut remarks)?;
    let observed = Observed::point(look, &mut remarks)?;
    let Observed::Point(points) = &observed else { unreachable!("a point was asked for") };
    let beside = Beside::of(look);
    let (name, chain, left_m) = recognised(look, &joints, points)?;
    remarks.push(format!("the arm is a {name}: with its nominal sizes {:.2} mm are left", 1e3 * left_m));
    let names = (1..=JOINTS).map(|number| format!("q{number}"));
    Ok(Draft {
        chain: chain.replace("STATEMENTS", &beside.statements),
        observable: "reflector",
        columns: names.zip(joints).chain(beside.columns).collect(),
        observed,
        turned: None,
        estimate: vec!["*", "base_*", "reflector_*"],
        start: Vec::new(),
        tolerance: &[],
        inputs: beside.names,
        is_in_order: false,
        unfollowed: None,
        remarks,
    })
}

/// The arm whose nominal sizes leave least of the measured positions, and how much that is, RMS in m.
fn recognised(
    look: &Look,
    joints: &[Read],
    points: &[Read; 3],
) -> Result<(&'static str, String, f64), String> {
    let table = some_poses(joints, points);
    let mut best: Option<(&str, String, f64, f64)> = None;
    for arm in ARMS {
        let chain = chain(arm);
        let left = left_m(&chain, &table)?;
        if best.as_ref().is_none_or(|(.., least)| left / arm.reach_m() < *least) {
            best = Some((arm.name, chain, left, left / arm.reach_m()));
        }
    }
    match best {
        Some((name, chain, left, share)) if share < RECOGNISED => Ok((name, chain, left)),
        _ => {
            let known: Vec<&str> = ARMS.iter().map(|arm| arm.name).collect();
            Err(format!(
                "{}: the positions are not those of an arm that is known ({}); write the chain of this one by hand, after \
                 examples/ur10/ur10.chain",
                look.file,
                known.join(", ")
            ))
        }
    }
}

/// Some of the poses as a table in SI.
fn some_poses(joints: &[Read], points: &[Read; 3]) -> String {
    let mut table = "q1,q2,q3,q4,q5,q6,reflector_x,reflector_y,reflector_z\n".to_owned();
    let rows = points[0].si.len();
    for row in (0..rows).step_by(rows.div_ceil(POSES).max(1)) {
        let cells: Vec<String> = joints.iter().chain(points).map(|read| read.si[row].to_string()).collect();
        let _ = writeln!(table, "{}", cells.join(","));
    }
    table
}

/// What the nominal sizes of a chain leave of a table of poses, RMS in m, wherever base and reflector are.
fn left_m(chain: &str, table: &str) -> Result<f64, String> {
    const STUDY: &str = "chain = \"c\"\nobservable = \"reflector\"\ndata = \"t.csv\"\n[observed]\nkind = \"point\"\n[fit]\n\
                         estimate = [\"base_*\", \"reflector_*\"]\n";
    let chain = chain.replace("STATEMENTS", "");
    let chain = Chain::from_text(&chain).map_err(|mistakes| mistakes.to_string())?;
    let plan = Study::from_text(STUDY)
        .and_then(|study| study.plan(&chain))
        .map_err(|mistakes| mistakes.to_string())?;
    let bytes = table.to_owned().into_bytes();
    let loaded = plan.load(&mut |_: &str| Ok(bytes.clone().into()));
    let observations = loaded.map_err(|error| error.to_string())?.observations;
    let found = fit(&plan.chain, &observations, &plan.fit).map_err(|error| error.to_string())?;
    let squares: f64 = found.residuals.raw.iter().map(|raw| raw * raw).sum();
    Ok((squares / observations.rows() as f64).sqrt())
}

fn chain(arm: &Arm) -> String {
    let Arm { name, d, a: [a2, a3] } = arm;
    let twists = ["pi/2", "", "", "pi/2", "-pi/2", ""];
    let mut text = format!(
        "/// An arm of the sizes of a {name}, before something that measures positions.
///
/// Each link in the convention of Denavit and Hartenberg: turn about z by the joint, shift along z by d, along x by a, turn
/// about x by alpha.
chain Arm {{
    /// Where the base stands in the frame of the measurement: not known beforehand.
    const base_x: length = 0;
    const base_y: length = 0;
    const base_z: length = 0;
    const base_rx: angle = 0;
    const base_ry: angle = 0;
    const base_rz: angle = 0;
    /// Where the reflector sits on the flange: not known beforehand.
    const reflector_x: length = 0;
    const reflector_y: length = 0;
    const reflector_z: length = 0;
STATEMENTS
    body base on ground {{
        position: Tx(base_x), Ty(base_y), Tz(base_z), Rx(base_rx), Ry(base_ry), Rz(base_rz);
    }}
"
    );
    let mut lower = "base".to_owned();
    for (at, (d, twist)) in d.iter().zip(twists).enumerate() {
        let number = at + 1;
        let a = [0.0, *a2, *a3, 0.0, 0.0, 0.0][at];
        let shifts = [(*d, "Tz"), (a, "Tx")].into_iter().filter(|(size, _)| *size != 0.0);
        let mut position: Vec<String> = shifts.map(|(size, along)| format!("{along}({size})")).collect();
        position.extend((!twist.is_empty()).then(|| format!("Rx({twist})")));
        let _ = write!(
            text,
            "
    body joint{number} on {lower} {{
        motion: Rz(q{number});
        motion_error:
            /// Index error of joint {number}: true minus reading.
            Rz(dq{number});
    }}
    body link{number} on joint{number} {{
        position: {};
        position_error:
            /// Link {number}: what is added to its d, its a and its alpha.
            Tz(dd{number}), Tx(da{number}), Rx(dalpha{number});
    }}
",
            position.join(", ")
        );
        lower = format!("link{number}");
    }
    text.push_str(
        "
    /// Where the reflector is.
    observe reflector: point(reflector_x, reflector_y, reflector_z) of link6;
}
",
    );
    text
}
