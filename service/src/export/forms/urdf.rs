//! A robot's own URDF with calibrated origins: every other byte stays.
//!
//! Joints are found by their names, and must lie where the declaration has them without errors. A link's frame stays where its joint is,
//! so no frame goes far away, however parallel two axes are.

use nalgebra::{Isometry3, Point3, Translation3, Unit, UnitQuaternion, Vector3};
use observe::SiUnit;
use report::words::numbers;
use tables::urdf::{Motion, Robot, declared_name};

use super::{Form, Made, Shown, Subject};
use crate::export::Lost;
use crate::export::links::{Links, constant_errors};
use crate::refusal::Refusal;
use crate::source::Source;

pub const FORM: Form = Form {
    name: "urdf",
    what: "a robot's URDF with calibrated origins; needs --template",
    template: Some("a robot's URDF"),
    write,
    read,
};

/// A joint of the template is where the declaration has it if it is within this, m and rad.
const SAME: f64 = 1e-6;
/// Turns and shifts below this are none.
const NONE: f64 = 1e-15;

/// The template beside the declaration.
struct Fitted {
    robot: Robot,
    /// The places of the chain's joints in the description.
    joints: Vec<usize>,
    /// From the frame of each joint as the chain has it to that of the description.
    own: Vec<Isometry3<f64>>,
    /// The fixed joints of the description before each joint of the chain, as one transform.
    before: Vec<Isometry3<f64>>,
    /// The one fixed joint on what the last joint carries, where there is one.
    tool: Option<usize>,
    /// The links without errors.
    nominal: Links,
}

/// A robot as a text describes it.
fn robot(source: &Source) -> Result<Robot, Refusal> {
    Robot::of(&source.text).map_err(|mistake| source.mistake(mistake))
}

fn template(source: Option<&Source>) -> &Source {
    source.unwrap_or_else(|| unreachable!("a form that changes a file is handed that file"))
}

/// The transform of an origin.
fn origin(robot: &Robot, joint: usize) -> Isometry3<f64> {
    let joint = &robot.joints[joint];
    let [roll, pitch, yaw] = joint.rpy;
    Isometry3::from_parts(
        Translation3::from(Vector3::from(joint.xyz)),
        UnitQuaternion::from_euler_angles(roll, pitch, yaw),
    )
}

impl Fitted {
    fn of(subject: &Subject, source: &Source) -> Result<Self, Refusal> {
        let robot = robot(source)?;
        let nominal = Links::of(subject, &subject.without_errors())?;
        let file = source.path.display();
        let (mut joints, mut own, mut before) = (Vec::new(), Vec::new(), Vec::new());
        let (mut of_chain, mut of_robot) = (Isometry3::identity(), Isometry3::identity());
        let mut last = robot.root.clone();
        for (joint, fixed) in nominal.joints.iter().zip(&nominal.fixed) {
            let name = &subject.chain.symbol(joint.symbol).name;
            let found =
                robot.joints.iter().position(|own| own.name == *name || declared_name(&own.name) == *name);
            let Some(found) = found else {
                let known = || {
                    robot.joints.iter().filter(|own| own.motion != Motion::Fixed).map(|own| own.name.as_str())
                };
                let instead = model_core::names::nearest(name, known()).map_or_else(
                    || format!("it has {}", model_core::names::listed(known())),
                    |near| format!("it has `{near}`"),
                );
                return Err(Refusal::Input(format!(
                    "{file}: there is no joint `{name}` of the declaration; {instead}. Give both the same names"
                )));
            };
            let Some(way) = robot.path(&robot.joints[found].parent) else {
                unreachable!("a description is read as a tree")
            };
            let start = way.iter().position(|at| robot.joints[*at].parent == last);
            let between = if robot.joints[found].parent == last {
                &[][..]
            } else {
                start.map_or(&[][..], |at| &way[at..])
            };
            let leads = robot.joints[found].parent == last || start.is_some();
            if !leads || between.iter().any(|at| robot.joints[*at].motion != Motion::Fixed) {
                return Err(Refusal::Input(format!(
                    "{file}: between `{last}` and joint `{name}` lie other joints than in the declaration: declare them in the same order"
                )));
            }
            let moves = if joint.turns { Motion::Turns } else { Motion::Shifts };
            if robot.joints[found].motion != moves {
                return Err(Refusal::Input(format!(
                    "{file}: joint `{name}` moves in another way than in the declaration"
                )));
            }
            let rigid = between.iter().fold(Isometry3::identity(), |place, at| place * origin(&robot, *at));
            of_chain *= fixed;
            of_robot = of_robot * rigid * origin(&robot, found);
            let apart = of_chain.inverse() * of_robot;
            let axis = Unit::new_normalize(Vector3::from(robot.joints[found].axis));
            let turned = apart.rotation * axis.into_inner() - joint.axis.into_inner();
            let shift = apart.translation.vector;
            let beside = if joint.turns {
                shift - joint.axis.into_inner() * shift.dot(&joint.axis)
            } else {
                Vector3::zeros()
            };
            if turned.norm() > SAME || beside.norm() > SAME {
                return Err(Refusal::Input(format!(
                    "{file}: the axis of joint `{name}` lies {} beside that of the declaration without errors, and is turned by {}: \
                     make the declaration of this file, with `trueaxis init --urdf`",
                    numbers::told(beside.norm(), SiUnit::METRE),
                    numbers::told(turned.norm(), SiUnit::RAD)
                )));
            }
            last = robot.joints[found].child.clone();
            joints.push(found);
            own.push(apart);
            before.push(rigid);
        }
        let mut behind = (0..robot.joints.len()).filter(|at| robot.joints[*at].parent == last);
        let tool = match (behind.next(), behind.next()) {
            (Some(only), None) if robot.joints[only].motion == Motion::Fixed => Some(only),
            _ => None,
        };
        Ok(Self { robot, joints, own, before, tool, nominal })
    }

    /// What the last joint carries, seen in its own frame of the description: displaced by the errors.
    fn displaced(&self, found: &Links) -> Isometry3<f64> {
        let (Some(own), Some(last), Some(nominal)) =
            (self.own.last(), found.fixed.last(), self.nominal.fixed.last())
        else {
            unreachable!("links have a joint")
        };
        own.inverse() * last * nominal.inverse() * own
    }
}

fn write(subject: &Subject, source: Option<&Source>) -> Result<Made, Refusal> {
    let source = template(source);
    let fitted = Fitted::of(subject, source)?;
    let (values, others) = constant_errors(subject);
    let found = Links::of(subject, &values)?;
    let mut edits = Vec::new();
    let mut said = format!("Origins that changed in `{}`.\n", source.path.display());
    let mut edit = |joint: usize, place: Isometry3<f64>| {
        let moved = origin(&fitted.robot, joint).inverse() * place;
        let (turn, shift) = (moved.rotation.angle(), moved.translation.vector.norm());
        if turn < NONE && shift < NONE {
            return;
        }
        let (roll, pitch, yaw) = place.rotation.euler_angles();
        edits.push((joint, place.translation.vector.into(), [roll, pitch, yaw]));
        said.push_str(&format!(
            "  {}: turned by {}, shifted by {}\n",
            fitted.robot.joints[joint].name,
            numbers::told(turn, SiUnit::RAD),
            numbers::told(shift, SiUnit::METRE)
        ));
    };
    for (at, joint) in fitted.joints.iter().enumerate() {
        let lower = if at == 0 { Isometry3::identity() } else { fitted.own[at - 1].inverse() };
        edit(*joint, fitted.before[at].inverse() * lower * found.fixed[at] * fitted.own[at]);
    }
    let displaced = fitted.displaced(&found);
    let mut lost: Vec<Lost> = Vec::new();
    match fitted.tool {
        Some(tool) => edit(tool, displaced * origin(&fitted.robot, tool)),
        None => {
            let mut without = found.clone();
            if let (Some(own), Some(nominal)) = (without.fixed.last_mut(), fitted.nominal.fixed.last()) {
                *own = *nominal;
            }
            let rms = subject.apart(&found.shown(subject), &without.shown(subject)).rms;
            if rms > 0.0 {
                lost.push(Lost {
                    what: "errors behind the last joint, which has not one fixed joint behind it".to_owned(),
                    rms,
                });
            }
        }
    }
    if edits.is_empty() {
        said.push_str("  none\n");
    }
    lost.extend(subject.lost(&others)?);
    Ok(Made { text: fitted.robot.with_origins(&source.text, &edits), said, lost: Some(lost) })
}

fn read(subject: &Subject, text: &str, source: Option<&Source>) -> Result<Shown, Refusal> {
    let fitted = Fitted::of(subject, template(source))?;
    let written = robot(&Source::of_text("the file that was written", text))?;
    let observable = subject.chain.observable(subject.observable);
    let is_point = observable.kind == model_core::ObservableKind::Point;
    let displaced = fitted.tool.map_or_else(Isometry3::identity, |tool| {
        origin(&written, tool) * origin(&fitted.robot, tool).inverse()
    });
    let without = subject.without_errors();
    let (Some(own), Some(last)) = (fitted.own.last(), fitted.nominal.fixed.last()) else {
        unreachable!("links have a joint")
    };
    let shown = (0..subject.poses.count).map(|pose| {
        let at = subject.at(pose, &without);
        let mut place = Isometry3::identity();
        for ((declared, joint), rigid) in fitted.nominal.joints.iter().zip(&fitted.joints).zip(&fitted.before)
        {
            let axis = Unit::new_normalize(Vector3::from(written.joints[*joint].axis));
            let moved = crate::export::links::Joint { axis, ..*declared }.moved(at[declared.symbol.index()]);
            place = place * rigid * origin(&written, *joint) * moved;
        }
        place = place * displaced * own.inverse() * last;
        let seen = observable.components.each_ref().map(|component| component.eval(&at));
        if is_point {
            (place * Point3::from(seen)).coords.into()
        } else {
            (place * Vector3::from(seen)).into()
        }
    });
    Ok(shown.collect())
}
