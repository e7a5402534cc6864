//! `calibration.conf` of Universal Robots: what is added to the nominal sizes of an arm, as its controller reads it.
//!
//! The form has Denavit-Hartenberg links and nothing else: between nearly parallel axes d goes far away and comes back on the next joint. Where the
//! base stands, and the tool, are no part of it.

use nalgebra::Isometry3;
use tables::ur::{ARMS, Arm, Deltas, JOINTS};

use super::dh::link::{Aligned, Link};
use super::{Form, Made, Shown, Subject};
use crate::export::links::{Joint, Links, constant_errors};
use crate::refusal::Refusal;
use crate::source::Source;

pub const FORM: Form = Form {
    name: "calibration.conf",
    what: "what is added to the nominal sizes of an arm of Universal Robots",
    template: None,
    write,
    read,
};

/// An arm is one of those whose sizes are known within this, m: what a calibration changes is millimetres.
const SAME_ARM_M: f64 = 0.02;

/// The links of an arm.
fn nominal(arm: &Arm) -> Vec<Link> {
    let link = |[theta, d, a, alpha]: [f64; 4]| Link { theta, d, a, alpha, beta: None };
    arm.links().into_iter().map(link).collect()
}

/// The arm that a chain declares: by the distances of its axes, which no choice of frames changes.
fn arm_of(subject: &Subject) -> Result<&'static Arm, Refusal> {
    let links = Links::of(subject, &subject.without_errors())?;
    if links.joints.len() != JOINTS || links.joints.iter().any(|joint| !joint.turns) {
        return Err(Refusal::Input(format!(
            "a calibration.conf is of an arm with {JOINTS} joints that turn, and this chain has {} joints: export it as dh",
            links.joints.len()
        )));
    }
    // Where axes are nearly parallel these links stand beside the declared frames, whose sizes a calibration hardly changes.
    let own = Link::nominal(&links).unwrap_or_default();
    let of = |at: usize| own.get(at).map_or([f64::INFINITY; 2], |link| [link.d, link.a]);
    // The second to fourth axis are parallel: only the sum of their d is one number.
    let between = of(1)[0] + of(2)[0] + of(3)[0];
    let off = |arm: &&Arm| {
        let pairs = [
            (of(0)[0], arm.d[0]),
            (between, arm.d[1] + arm.d[2] + arm.d[3]),
            (of(4)[0], arm.d[4]),
            (of(1)[1], arm.a[0]),
            (of(2)[1], arm.a[1]),
        ];
        pairs.iter().map(|(own, arm)| (own - arm).abs()).fold(0.0, f64::max)
    };
    let nearest = ARMS.iter().min_by(|one, other| off(one).total_cmp(&off(other)));
    nearest.filter(|arm| off(arm) < SAME_ARM_M).ok_or_else(|| {
        let names: Vec<&str> = ARMS.iter().map(|arm| arm.name).collect();
        Refusal::Input(format!(
            "the sizes of this chain are those of no arm that is known ({}): export it as dh",
            names.join(", ")
        ))
    })
}

fn write(subject: &Subject, _: Option<&Source>) -> Result<Made, Refusal> {
    let arm = arm_of(subject)?;
    let (values, others) = constant_errors(subject);
    let links = Links::of(subject, &values)?;
    let nominal = nominal(arm);
    let Aligned { between, tool, .. } = Aligned::of(&links, &nominal);
    let mut deltas = Deltas::default();
    for (joint, (own, nominal)) in between.iter().zip(&nominal).enumerate().take(JOINTS - 1) {
        deltas.theta[joint] = own.theta - nominal.theta;
        deltas.d[joint] = own.d - nominal.d;
        deltas.a[joint] = own.a - nominal.a;
        deltas.alpha[joint] = own.alpha - nominal.alpha;
    }
    // Behind the last joint a controller has a turn about its axis and a shift along it.
    let (_, _, turn) = tool.rotation.euler_angles();
    deltas.theta[JOINTS - 1] = turn;
    deltas.d[JOINTS - 1] = tool.translation.z - arm.d[JOINTS - 1];
    let farthest = deltas.d.iter().fold(0.0, |most: f64, d| most.max(d.abs()));
    let mut said = format!(
        "Added to the nominal sizes of a {}. The base and the tool are no part of the file.\n",
        arm.name
    );
    if farthest > 1.0 {
        said.push_str(&format!(
            "Nearly parallel axes meet far away: delta_d reaches {farthest:.0} m and comes back on the next joint, as in the files of the \
             manufacturer.\n"
        ));
    }
    said.push_str(
        "Keep joint_checksum and joint_raw_offset of your own file: copy the four lists into it.\n",
    );
    Ok(Made { text: deltas.text(), said, lost: Some(subject.lost(&others)?) })
}

fn read(subject: &Subject, text: &str, _: Option<&Source>) -> Result<Shown, Refusal> {
    let arm = arm_of(subject)?;
    let deltas = Deltas::of(text)
        .map_err(|error| Refusal::Input(format!("the file that was written cannot be read back: {error}")))?;
    let (values, _) = constant_errors(subject);
    let links = Links::of(subject, &values)?;
    let Aligned { base, tool, .. } = Aligned::of(&links, &nominal(arm));
    let mut fixed = vec![base];
    for (joint, nominal) in nominal(arm).iter().enumerate() {
        let link = Link {
            theta: nominal.theta + deltas.theta[joint],
            d: nominal.d + deltas.d[joint],
            a: nominal.a + deltas.a[joint],
            alpha: nominal.alpha + deltas.alpha[joint],
            beta: None,
        };
        fixed.push(link.transform());
    }
    // The tool is what stands behind the flange, as the instrument has it.
    let flange =
        Link { theta: deltas.theta[JOINTS - 1], d: arm.d[JOINTS - 1] + deltas.d[JOINTS - 1], ..Link::NONE };
    let behind: Isometry3<f64> = flange.transform().inverse() * tool;
    if let Some(last) = fixed.last_mut() {
        *last *= behind;
    }
    let joints = links.joints.iter().map(|joint| Joint { axis: nalgebra::Vector3::z_axis(), ..*joint });
    Ok(Links { joints: joints.collect(), fixed }.shown(subject))
}
