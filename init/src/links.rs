//! Robots out of tables of links: by Denavit and Hartenberg, and what Universal Robots add to an arm's nominal sizes.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use tables::dh::{Convention, Dh, Link};
use tables::ur::{ARMS, Arm, Deltas, JOINTS};
use tables::urdf::{Motion, Robot};

use super::NotBegun;
use super::robot::Description;

/// A robot of a table of Denavit and Hartenberg.
#[must_use]
pub fn dh(name: &str, table: &Dh) -> Description {
    // What stands between the joints, one more than these are.
    let mut between = vec![Isometry3::identity()];
    for link in &table.links {
        let along = about_z(link.theta) * Translation3::new(0.0, 0.0, link.d);
        let across = Translation3::new(link.a, 0.0, 0.0) * about_x(link.alpha);
        let behind = match table.convention {
            Convention::Standard => along * across,
            Convention::Modified => {
                if let Some(before) = between.last_mut() {
                    *before *= across * along;
                }
                Isometry3::identity()
            }
        };
        between.push(behind);
    }
    let joints = table.links.iter().map(|link: &Link| (link.name.clone(), link.motion));
    let robot = in_line(name, joints, &between);
    let convention = match table.convention {
        Convention::Standard => "standard: Rz(theta) Tz(d) Tx(a) Rx(alpha)",
        Convention::Modified => "modified: Rx(alpha) Tx(a) Rz(theta) Tz(d)",
    };
    Description {
        robot,
        what: "its table of Denavit and Hartenberg",
        is_seen_from_root: false,
        remarks: vec![format!("the convention of the table is {convention}")],
    }
}

/// An arm of Universal Robots with its own deltas. Frames stand on the calibrated axes where these come nearest to the nominal frames, and not
/// hundreds of metres away, where the deltas of nearly parallel axes have them.
///
/// # Errors
/// No such arm is known.
pub fn ur(name: &str, deltas: &Deltas, arm: Option<&str>) -> Result<Description, NotBegun> {
    let known = ARMS.iter().map(|arm| arm.name);
    let Some(named) = arm else {
        let names: Vec<&str> = known.collect();
        return Err(format!(
            "a calibration.conf says what is added to the sizes of an arm, and not which arm it is: say --arm, one of {}",
            names.join(", ")
        )
        .into());
    };
    let Some(arm) = ARMS.iter().find(|own| own.name.eq_ignore_ascii_case(named)) else {
        let near = model_core::names::nearest(named, known.clone());
        let known: Vec<&str> = known.collect();
        let help = near.map_or_else(
            || format!("known are {}", known.join(", ")),
            |near| format!("did you mean `{near}`?"),
        );
        return Err(format!("no arm `{named}` is known; {help}").into());
    };
    let nominal = frames(arm, &Deltas::default());
    let own = frames(arm, deltas);
    let placed: Vec<Isometry3<f64>> =
        own.iter().take(JOINTS).zip(&nominal).map(|(own, nominal)| on_axis(own, nominal)).collect();
    let mut between = Vec::new();
    let mut before = Isometry3::identity();
    for frame in placed.iter().chain(own.last()) {
        between.push(before.inverse() * frame);
        before = *frame;
    }
    let joints = (1..=JOINTS).map(|number| (format!("q{number}"), Motion::Turns));
    Ok(Description {
        robot: in_line(name, joints, &between),
        what: "its calibration.conf",
        is_seen_from_root: false,
        remarks: vec![format!(
            "the nominal sizes are those of a {}; frames stand on the calibrated axes beside the nominal ones",
            arm.name
        )],
    })
}

/// The frame of each joint of an arm at zero, z along its axis, and that of the flange.
fn frames(arm: &Arm, deltas: &Deltas) -> Vec<Isometry3<f64>> {
    let mut frames = vec![Isometry3::identity()];
    for (joint, [theta, d, a, alpha]) in arm.links().into_iter().enumerate() {
        let link = about_z(theta + deltas.theta[joint])
            * Translation3::new(a + deltas.a[joint], 0.0, d + deltas.d[joint])
            * about_x(alpha + deltas.alpha[joint]);
        let before = frames.last().copied().unwrap_or_default();
        frames.push(before * link);
    }
    frames
}

/// The frame on the axis of one where the origin of another comes nearest, with x nearest to that of the other.
fn on_axis(own: &Isometry3<f64>, near: &Isometry3<f64>) -> Isometry3<f64> {
    let axis = own.rotation * Vector3::z();
    let [origin, wanted] = [own, near].map(|frame| frame.translation.vector);
    let origin = origin + axis * axis.dot(&(wanted - origin));
    let x = near.rotation * Vector3::x();
    let across = x - axis * axis.dot(&x);
    // Calibrated axes are near the nominal ones; where one is not, its own x does.
    let x = across.try_normalize(1e-6).unwrap_or_else(|| own.rotation * Vector3::x());
    let turned = UnitQuaternion::from_basis_unchecked(&[x, axis.cross(&x), axis]);
    Isometry3::from_parts(Translation3::from(origin), turned)
}

fn in_line(name: &str, joints: impl Iterator<Item = (String, Motion)>, between: &[Isometry3<f64>]) -> Robot {
    let placed = |(name, motion), place: &Isometry3<f64>| {
        let (roll, pitch, yaw) = place.rotation.euler_angles();
        (name, motion, place.translation.vector.into(), [roll, pitch, yaw])
    };
    let all = joints.chain(std::iter::once(("flange".to_owned(), Motion::Fixed)));
    Robot::in_line(name, all.zip(between).map(|(joint, place)| placed(joint, place)))
}

fn about_z(angle: f64) -> UnitQuaternion<f64> {
    UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle)
}

fn about_x(angle: f64) -> UnitQuaternion<f64> {
    UnitQuaternion::from_axis_angle(&Vector3::x_axis(), angle)
}
