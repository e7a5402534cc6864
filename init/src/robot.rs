//! The declaration of a robot out of a description of it, and a study of it where there are data.
//!
//! Each joint of the way to the tip is a body. Its axis may be tilted and shifted across itself by errors: what a robot whose joints are out of
//! place shows of each axis. A wrong zero of a joint is a tilt or a shift of the next axis. Links that do not move follow as they are.

use std::collections::BTreeSet;
use std::f64::consts::FRAC_PI_2;
use std::fmt::Write as _;

use model_core::escape::comments;
use model_core::names::listed;
use model_core::validate::is_name;
use tables::urdf::{Joint, Motion, Robot, declared_name};

use super::look::Look;
use super::placed;
use super::turned::Turned;
use super::{Draft, NotBegun, Observed};

/// An angle of a file is a quarter turn, or several, if it is within this: files write them to so many digits, rad.
const QUARTER: f64 = 1e-9;
/// A shift below this is what rounding leaves of none, m.
const NONE_M: f64 = 1e-12;
/// A part of an axis below this is none.
const ALONG: f64 = 1e-9;

/// What describes a robot.
pub struct Description {
    /// The robot.
    pub robot: Robot,
    /// What of it was read: `its URDF`.
    pub what: &'static str,
    /// Whether positions are measured in the frame of its root; else where that stands is estimated too.
    pub is_seen_from_root: bool,
    /// What was read and assumed beside its joints.
    pub remarks: Vec<String>,
}

impl Description {
    /// By a URDF.
    #[must_use]
    pub fn urdf(robot: Robot) -> Self {
        let read = "origins, axes and limits are read; masses and inertia are not".to_owned();
        Self { robot, what: "its URDF", is_seen_from_root: true, remarks: vec![read] }
    }
}

/// What is written without data: the declaration and what to know of it.
pub struct Described {
    /// The declaration.
    pub chain: String,
    /// What was read and assumed.
    pub remarks: Vec<String>,
    /// The link that is measured.
    tip: String,
}

/// The declaration of a robot, to the link that is named or to the one behind the most joints that move.
///
/// # Errors
/// No such link, several that could be meant, or a joint of several degrees of freedom.
pub fn described(description: &Description, tip: Option<&str>) -> Result<Described, NotBegun> {
    declared(description, tip, false)
}

/// The same, where how the tip is turned is measured too.
fn declared(description: &Description, tip: Option<&str>, is_turned: bool) -> Result<Described, NotBegun> {
    let robot = &description.robot;
    let tip = tip.map_or_else(|| farthest(robot), |tip| Ok(tip.to_owned()))?;
    let Some(path) = robot.path(&tip) else {
        let links = || robot.joints.iter().map(|joint| joint.child.as_str());
        let instead = model_core::names::nearest(&tip, links())
            .map_or_else(|| format!("it has {}", listed(links())), |near| format!("did you mean `{near}`?"));
        return Err(format!("the robot has no link `{tip}`; {instead}").into());
    };
    let joints: Vec<&Joint> = path.iter().map(|at| &robot.joints[*at]).collect();
    if let Some(free) = joints.iter().find(|joint| joint.motion == Motion::Free) {
        return Err(format!(
            "joint `{}` moves in several degrees of freedom: name a tip before it with --tip, or describe it as joints of one",
            free.name
        )
        .into());
    }
    let mut names = BTreeSet::new();
    if let Some(again) = joints.iter().find(|joint| !names.insert(declared_name(&joint.name))) {
        let name = declared_name(&again.name);
        return Err(format!(
            "two joints would both be called `{name}` in the declaration: rename joint `{}`",
            again.name
        )
        .into());
    }
    let moving = joints.iter().filter(|joint| joint.motion != Motion::Fixed).count();
    if moving == 0 {
        return Err(format!("no joint on the way to `{tip}` moves: name another link with --tip").into());
    }
    let mut remarks = vec![format!(
        "read from {}: {moving} joints that move, from `{}` to `{tip}`",
        description.what, robot.root
    )];
    remarks.extend(description.remarks.iter().cloned());
    remarks.push(
        if description.is_seen_from_root {
            "assumed: each axis may be tilted and shifted across itself, and the point on the tip is not known; positions are measured in the \
             frame of the root"
        } else {
            "assumed: each axis but the first may be tilted and shifted across itself; where the root stands in the frame of the measurement, \
             and the point on the tip, are not known"
        }
        .to_owned(),
    );
    Ok(Described { chain: chain(description, &joints, &tip, is_turned), remarks, tip })
}

/// The link behind the most joints that move, the nearest of several on one way.
fn farthest(robot: &Robot) -> Result<String, NotBegun> {
    let moving = |joint: &Joint| {
        let path = robot.path(&joint.child).unwrap_or_default();
        path.iter().filter(|at| robot.joints[**at].motion != Motion::Fixed).count()
    };
    let most = robot.joints.iter().map(moving).max().unwrap_or(0);
    let last: Vec<&Joint> =
        robot.joints.iter().filter(|joint| joint.motion != Motion::Fixed && moving(joint) == most).collect();
    match last.as_slice() {
        [] => Err("no joint of the robot moves: give the description of one that does".to_owned().into()),
        [one] => {
            // One fixed link behind it is its flange.
            let mut behind = robot.joints.iter().filter(|joint| joint.parent == one.child);
            match (behind.next(), behind.next()) {
                (Some(flange), None) if flange.motion == Motion::Fixed => Ok(flange.child.clone()),
                _ => Ok(one.child.clone()),
            }
        }
        several => {
            let links = listed(several.iter().map(|joint| joint.child.as_str()));
            Err(format!("the robot has several ends: say which of {links} is measured, with --tip LINK")
                .into())
        }
    }
}

/// The declaration.
fn chain(description: &Description, joints: &[&Joint], tip: &str, is_turned: bool) -> String {
    let robot = &description.robot;
    let mut taken: BTreeSet<String> = joints.iter().map(|joint| declared_name(&joint.name)).collect();
    let mut constants = String::new();
    let mut bodies = String::new();
    let mut lower = "ground".to_owned();
    if !description.is_seen_from_root {
        let names = ["x", "y", "z", "rx", "ry", "rz"].map(|axis| free(&mut taken, &format!("base_{axis}")));
        constants.push_str(
            "    /// Where the root stands in the frame of the measurement: not known beforehand.\n",
        );
        for (at, name) in names.iter().enumerate() {
            let _ = writeln!(constants, "    const {name}: {} = 0;", if at < 3 { "length" } else { "angle" });
        }
        let [x, y, z, rx, ry, rz] = names;
        lower = free(&mut taken, "base_stand");
        let place = format!("Tx({x}), Ty({y}), Tz({z}), Rx({rx}), Ry({ry}), Rz({rz})");
        let _ = writeln!(bodies, "    body {lower} on ground {{\n        position: {place};\n    }}");
    }
    let mut is_placed = !description.is_seen_from_root;
    // Where an axis lies along none of its frame's, what turned the frame to it is turned back behind the joint.
    let mut back: Vec<String> = Vec::new();
    for joint in joints {
        let own = declared_name(&joint.name);
        let mut angle = |what: &str, value: f64| {
            let quarters = value / FRAC_PI_2;
            if (value - quarters.round() * FRAC_PI_2).abs() < QUARTER {
                let count = quarters.round() as i64;
                return (count != 0)
                    .then(|| if count == 1 { "pi/2".to_owned() } else { format!("{count}*pi/2") });
            }
            let name = free(&mut taken, &format!("{own}_{what}"));
            let _ = writeln!(constants, "    const {name}: angle = {value};");
            Some(name)
        };
        let mut position = std::mem::take(&mut back);
        let shifts = ["Tx", "Ty", "Tz"].iter().zip(joint.xyz).filter(|(_, size)| size.abs() > NONE_M);
        position.extend(shifts.map(|(along, size)| format!("{along}({size})")));
        let [roll, pitch, yaw] = joint.rpy;
        for (axis, what, value) in [("Rz", "yaw", yaw), ("Ry", "pitch", pitch), ("Rx", "roll", roll)] {
            position.extend(angle(what, value).map(|amount| format!("{axis}({amount})")));
        }
        let (mut axis, mut sign) = ('z', "");
        if joint.motion != Motion::Fixed {
            let along = (0..3).find(|at| (0..3).all(|other| other == *at || joint.axis[other].abs() < ALONG));
            if let Some(at) = along {
                (axis, sign) = (['x', 'y', 'z'][at], if joint.axis[at] < 0.0 { "-" } else { "" });
            } else {
                let [x, y, z] = joint.axis;
                let (around, from_z) = (y.atan2(x), x.hypot(y).atan2(z));
                let turns = [("Rz", angle("axis_around", around)), ("Ry", angle("axis_from_z", from_z))];
                for (about, amount) in turns.into_iter().filter_map(|(about, amount)| Some((about, amount?)))
                {
                    position.push(format!("{about}({amount})"));
                    back.insert(0, format!("{about}(-{amount})"));
                }
            }
        }
        let limits = joint.limits.map_or_else(String::new, |[low, high]| format!(", from {low} to {high}"));
        let kind = match joint.motion {
            Motion::Fixed => "stands still",
            Motion::Turns => "turns",
            Motion::Shifts | Motion::Free => "shifts",
        };
        let _ = writeln!(bodies, "    /// Joint `{}` {kind}{limits}.", comments::line(&joint.name));
        let body = free(&mut taken, &format!("{}_link", declared_name(&joint.child)));
        let _ = writeln!(bodies, "    body {body} on {lower} {{");
        if !position.is_empty() {
            let _ = writeln!(bodies, "        position: {};", position.join(", "));
        }
        if joint.motion != Motion::Fixed {
            let across: Vec<char> = ['x', 'y', 'z'].into_iter().filter(|own| *own != axis).collect();
            let mut errors: Vec<String> = Vec::new();
            // A slide has no place across: its axis is a direction.
            if joint.motion == Motion::Turns {
                for own_axis in &across {
                    errors.push(format!(
                        "T{own_axis}({})",
                        free(&mut taken, &format!("{own}_shift_{own_axis}"))
                    ));
                }
            }
            for own_axis in &across {
                errors.push(format!("R{own_axis}({})", free(&mut taken, &format!("{own}_tilt_{own_axis}"))));
            }
            // Where the first axis is, the place of the base says.
            if !std::mem::take(&mut is_placed) {
                let _ = writeln!(bodies, "        position_error: {};", errors.join(", "));
            }
            let letter = if joint.motion == Motion::Turns { 'R' } else { 'T' };
            let _ = writeln!(bodies, "        motion: {letter}{axis}({sign}{own});");
        }
        bodies.push_str("    }\n");
        lower = body;
    }
    if !back.is_empty() {
        let body = free(&mut taken, "turned_back");
        let _ =
            writeln!(bodies, "    body {body} on {lower} {{\n        position: {};\n    }}", back.join(", "));
        lower = body;
    }
    let point = ["x", "y", "z"].map(|axis| free(&mut taken, &format!("point_{axis}")));
    let mut turned = String::new();
    if is_turned {
        let angles = ["rx", "ry", "rz"].map(|axis| free(&mut taken, &format!("tool_{axis}")));
        constants
            .push_str("    /// How what is measured is turned against that link: not known beforehand.\n");
        angles.iter().for_each(|name| {
            let _ = writeln!(constants, "    const {name}: angle = 0;");
        });
        let [rx, ry, rz] = angles;
        let body = free(&mut taken, "tool");
        let _ = writeln!(
            bodies,
            "    body {body} on {lower} {{\n        position: Rx({rx}), Ry({ry}), Rz({rz});\n    }}"
        );
        turned = format!("    /// How it is turned.\n    observe turned: orientation of {body};\n");
    }
    let places: String = point.iter().map(|name| format!("    const {name}: length = 0;\n")).collect();
    let name =
        Some(declared_name(&robot.name)).filter(|name| is_name(name)).unwrap_or_else(|| "Robot".to_owned());
    format!(
        "/// The robot `{}`, as {} describes it, to the link `{}`.\nchain {name} {{\n    /// Where the measured point sits on that link: not \
         known beforehand.\n{places}{constants}{bodies}    /// Where the measured point is.\n    observe \
         reflector: point({}) of {lower};\n{turned}}}\n",
        comments::line(&robot.name),
        description.what,
        comments::line(tip),
        point.join(", ")
    )
}

/// A name that nothing has yet.
fn free(taken: &mut BTreeSet<String>, wanted: &str) -> String {
    let mut name = wanted.to_owned();
    let mut number = 2;
    while !taken.insert(name.clone()) {
        name = format!("{wanted}_{number}");
        number += 1;
    }
    name
}

/// A draft of a robot with data: its joints by their names, and the point that was measured.
///
/// # Errors
/// As [`described`]; and a joint that has no column, or no column of what was measured.
pub fn draft(description: &Description, tip: Option<&str>, look: &Look) -> Result<Draft, NotBegun> {
    let robot = &description.robot;
    let mut seen = Vec::new();
    let turned = Turned::of(look, &mut seen)?;
    let Described { chain, mut remarks, tip: declared_tip } = declared(description, tip, turned.is_some())?;
    remarks.append(&mut seen);
    let mut columns = Vec::new();
    for joint in robot.joints.iter().filter(|joint| joint.motion != Motion::Fixed) {
        let name = declared_name(&joint.name);
        // Only those on the way.
        if !chain.contains(&format!("({name});")) && !chain.contains(&format!("(-{name});")) {
            continue;
        }
        let column = look.named(&[&joint.name, &name]).ok_or_else(|| {
            NotBegun::from(format!(
                "{}: there is no column for joint `{}`: name one like it",
                look.file, joint.name
            ))
        })?;
        let read = if joint.motion == Motion::Turns {
            look.angles(&[column], &mut remarks)?
        } else {
            look.lengths(&[column], &mut remarks)?
        };
        columns.extend(read.into_iter().map(|read| (name.clone(), read)));
    }
    let observed = match turned.as_ref().and_then(|turned| turned.place.as_ref()) {
        Some(place) => Observed::point_in(look, place, &mut remarks)?,
        None => Observed::point(look, &mut remarks)?,
    };
    if let Some(turned) = &turned {
        remarks.push(format!(
            "how the tip is turned is read as {}, and is calibrated with its place; `apply` corrects the place, and the orientation leaves as it came",
            turned.what
        ));
    }
    remarks.splice(0..0, look.remarks.iter().cloned());
    let path: Vec<&Joint> =
        robot.path(&declared_tip).unwrap_or_default().into_iter().map(|at| &robot.joints[at]).collect();
    let start = match &observed {
        Observed::Point(points) if !description.is_seen_from_root => placed::base(&path, &columns, points),
        _ => Vec::new(),
    };
    let mut estimate = vec!["*", "point_*"];
    estimate.extend((!description.is_seen_from_root).then_some("base_*"));
    estimate.extend(turned.is_some().then_some("tool_*"));
    Ok(Draft {
        chain,
        observable: "reflector",
        columns,
        observed,
        turned: turned.map(|turned| ("turned", turned)),
        estimate,
        start,
        tolerance: &[],
        inputs: Vec::new(),
        is_in_order: false,
        unfollowed: None,
        remarks,
    })
}
