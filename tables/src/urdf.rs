//! URDF: what a robot's description says of its joints, and the same text with other origins.
//!
//! Source: ROS, URDF XML specification, elements `robot`, `link` and `joint`: a joint goes from its parent link by its origin (a shift, then turns
//! about the fixed axes x, y and z by roll, pitch and yaw) to the frame in which its axis is given, 1 0 0 unless it says so, and which is that of
//! its child link. Lengths are metres, angles radians.

use std::ops::Range;

use model_core::mistake::Mistake;
use model_core::validate::is_name;
use roxmltree::{Document, Node};

/// A robot.
#[derive(Debug, Clone, PartialEq)]
pub struct Robot {
    /// Its name.
    pub name: String,
    /// Its joints as they are written.
    pub joints: Vec<Joint>,
    /// The link that no joint leads to.
    pub root: String,
    /// Where the origin of each joint stands in the text, if it came from one.
    places: Vec<Places>,
}

/// A joint.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// Its name.
    pub name: String,
    /// How it moves.
    pub motion: Motion,
    /// The link that it starts from.
    pub parent: String,
    /// The link that it carries.
    pub child: String,
    /// The shift of its origin, m.
    pub xyz: [f64; 3],
    /// Roll, pitch and yaw of its origin, rad.
    pub rpy: [f64; 3],
    /// About or along what it moves; of length one.
    pub axis: [f64; 3],
    /// The smallest and the largest position, rad or m.
    pub limits: Option<[f64; 2]>,
}

/// How a joint moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Motion {
    /// Not at all.
    Fixed,
    /// It turns.
    Turns,
    /// It shifts.
    Shifts,
    /// In several degrees of freedom.
    Free,
}

/// Where an origin stands in the text.
#[derive(Debug, Clone, PartialEq)]
struct Places {
    xyz: Option<Range<usize>>,
    rpy: Option<Range<usize>>,
    /// Where attributes of the origin begin, or where an origin may stand, with whether there is one.
    attributes: usize,
    has_origin: bool,
}

/// Axes are of length one after this; shorter ones say no direction.
const SHORTEST_AXIS: f64 = 1e-9;

impl Robot {
    /// Reads a description.
    ///
    /// # Errors
    /// What is wrong, with its place in the text.
    pub fn of(text: &str) -> Result<Self, Mistake<Range<usize>>> {
        let document = Document::parse(text).map_err(|error| {
            let at = offset(text, error.pos().row, error.pos().col);
            Mistake::new(at..at, format!("this is no XML: {error}"))
                .with_help("name a file in URDF; of xacro, what `xacro` makes of it")
        })?;
        let root = document.root_element();
        let named = root.range();
        if root.tag_name().name() != "robot" {
            let message = format!("the element `{}` is no robot", root.tag_name().name());
            return Err(Mistake::new(named.start..named.start + 1, message)
                .with_help("name a file in URDF, which begins with <robot>"));
        }
        let elements = || root.children().filter(|node| node.is_element());
        let (mut joints, mut places): (Vec<Joint>, Vec<Places>) = (Vec::new(), Vec::new());
        for node in elements().filter(|node| node.has_tag_name("joint")) {
            let (joint, place) = joint(text, node)?;
            let again = |own: &&Joint| own.name == joint.name || own.child == joint.child;
            if let Some(other) = joints.iter().find(again) {
                let message = if other.name == joint.name {
                    format!("two joints are called `{}`", joint.name)
                } else {
                    format!(
                        "joints `{}` and `{}` carry the same link `{}`",
                        other.name, joint.name, joint.child
                    )
                };
                return Err(
                    Mistake::new(start(node), message).with_help("a robot is a tree: leave one of them out")
                );
            }
            joints.push(joint);
            places.push(place);
        }
        let whole = || start(root);
        if joints.is_empty() {
            return Err(Mistake::new(whole(), "the robot has no joint")
                .with_help("name the description of a robot with joints"));
        }
        let mut ends = joints
            .iter()
            .map(|joint| &joint.parent)
            .filter(|link| joints.iter().all(|joint| joint.child != **link));
        let Some(first) = ends.next().cloned() else {
            return Err(Mistake::new(whole(), "every link hangs on another one")
                .with_help("a robot is a tree: one link carries all"));
        };
        if let Some(other) = ends.find(|link| **link != first) {
            let message = format!("neither `{first}` nor `{other}` hangs on another link");
            return Err(Mistake::new(whole(), message).with_help("a robot is one tree: join them"));
        }
        let name = root.attribute("name").unwrap_or("robot").to_owned();
        let robot = Self { name, joints, root: first, places };
        if let Some(joint) = robot.joints.iter().find(|joint| robot.path(&joint.child).is_none()) {
            let message = format!("joint `{}` hangs on itself", joint.name);
            return Err(Mistake::new(whole(), message).with_help("a robot is a tree: one link carries all"));
        }
        Ok(robot)
    }

    /// A robot that is one chain, out of its joints from the root on: each with its name, how it moves about or along z, its shift, m, and its
    /// roll, pitch and yaw, rad, behind the joint before.
    #[must_use]
    pub fn in_line(
        name: &str,
        joints: impl IntoIterator<Item = (String, Motion, [f64; 3], [f64; 3])>,
    ) -> Self {
        let root = "base".to_owned();
        let mut parent = root.clone();
        let joint = |(name, motion, xyz, rpy): (String, Motion, [f64; 3], [f64; 3])| {
            let child = format!("{name}_carried");
            let parent = std::mem::replace(&mut parent, child.clone());
            Joint { name, motion, parent, child, xyz, rpy, axis: [0.0, 0.0, 1.0], limits: None }
        };
        let joints = joints.into_iter().map(joint).collect();
        Self { name: name.to_owned(), joints, root, places: Vec::new() }
    }

    /// The joints from the root to a link, by their places; `None` if no way leads there.
    #[must_use]
    pub fn path(&self, link: &str) -> Option<Vec<usize>> {
        let (mut path, mut at) = (Vec::new(), link);
        while at != self.root {
            let joint = self.joints.iter().position(|joint| joint.child == at)?;
            if path.contains(&joint) {
                return None;
            }
            path.push(joint);
            at = &self.joints[joint].parent;
        }
        path.reverse();
        Some(path)
    }

    /// The text with other origins of some joints: shift, m, and roll, pitch and yaw, rad. Every other byte stays.
    #[must_use]
    pub fn with_origins(&self, text: &str, origins: &[(usize, [f64; 3], [f64; 3])]) -> String {
        let mut edits: Vec<(Range<usize>, String)> = Vec::new();
        for (joint, xyz, rpy) in origins {
            let Some(places) = self.places.get(*joint) else { continue };
            let numbers = |numbers: &[f64; 3]| numbers.map(|number| number.to_string()).join(" ");
            let mut missing = String::new();
            for (name, place, value) in [("xyz", &places.xyz, xyz), ("rpy", &places.rpy, rpy)] {
                match place {
                    Some(place) => edits.push((place.clone(), numbers(value))),
                    None => missing.push_str(&format!(" {name}=\"{}\"", numbers(value))),
                }
            }
            if !missing.is_empty() {
                let inserted = if places.has_origin { missing } else { format!("<origin{missing}/>") };
                edits.push((places.attributes..places.attributes, inserted));
            }
        }
        edits.sort_by_key(|(place, _)| place.start);
        let (mut written, mut done) = (String::with_capacity(text.len()), 0);
        for (place, new) in edits {
            written.push_str(&text[done..place.start]);
            written.push_str(&new);
            done = place.end;
        }
        written + &text[done..]
    }
}

/// The name that a declaration has for one of a description: letters, digits and underscores.
#[must_use]
pub fn declared_name(name: &str) -> String {
    let mut own: String =
        name.chars().map(|letter| if letter.is_ascii_alphanumeric() { letter } else { '_' }).collect();
    if own.starts_with(|first: char| first.is_ascii_digit()) || own.is_empty() {
        own.insert(0, 'j');
    }
    if is_name(&own) { own } else { format!("{own}_") }
}

/// A joint.
fn joint(text: &str, node: Node<'_, '_>) -> Result<(Joint, Places), Mistake<Range<usize>>> {
    let wrong = |message: String, help: &str| Mistake::new(start(node), message).with_help(help);
    let needed = |key: &str| {
        node.attribute(key)
            .ok_or_else(|| wrong(format!("a joint has no {key}"), "write <joint name=\"…\" type=\"…\">"))
    };
    let name = needed("name")?.to_owned();
    let motion = match needed("type")? {
        "fixed" => Motion::Fixed,
        "revolute" | "continuous" => Motion::Turns,
        "prismatic" => Motion::Shifts,
        "floating" | "planar" => Motion::Free,
        other => {
            let help = "write revolute, continuous, prismatic or fixed";
            return Err(wrong(format!("joint `{name}` is of the unknown type `{other}`"), help));
        }
    };
    let element = |tag: &str| node.children().find(|child| child.has_tag_name(tag));
    let link = |tag: &str| {
        element(tag).and_then(|child| child.attribute("link")).map(str::to_owned).ok_or_else(|| {
            wrong(
                format!("joint `{name}` names no {tag} link"),
                "write <parent link=\"…\"/> and <child link=\"…\"/>",
            )
        })
    };
    let (parent, child) = (link("parent")?, link("child")?);
    let origin = element("origin");
    let vector = |key: &str, usual: [f64; 3]| origin.map_or(Ok(usual), |origin| numbers(origin, key, usual));
    let (xyz, rpy) = (vector("xyz", [0.0; 3])?, vector("rpy", [0.0; 3])?);
    let axis = element("axis").map_or(Ok([1.0, 0.0, 0.0]), |axis| numbers(axis, "xyz", [1.0, 0.0, 0.0]))?;
    let length = axis.iter().map(|part| part * part).sum::<f64>().sqrt();
    if !matches!(motion, Motion::Fixed | Motion::Free) && length < SHORTEST_AXIS {
        return Err(wrong(
            format!("the axis of joint `{name}` has no direction"),
            "write <axis xyz=\"0 0 1\"/>",
        ));
    }
    let limit = element("limit").filter(|_| !matches!(node.attribute("type"), Some("continuous")));
    let limits = limit
        .map(|limit| Ok([number(limit, "lower")?.unwrap_or(0.0), number(limit, "upper")?.unwrap_or(0.0)]))
        .transpose()?
        .filter(|[low, high]| low < high);
    let place = |key: &str| {
        origin.and_then(|origin| origin.attribute_node(key)).map(|attribute| attribute.range_value())
    };
    let opened = |node: Node<'_, '_>| {
        let begin = node.range().start + 1;
        let tag = &text[begin..];
        begin + tag.find(|letter: char| letter.is_whitespace() || letter == '>' || letter == '/').unwrap_or(0)
    };
    // Behind the start of the joint, where it has no origin: it has children, so its start does not end it.
    let behind_start = || node.first_child().map_or(node.range().end, |child| child.range().start);
    let places = Places {
        xyz: place("xyz"),
        rpy: place("rpy"),
        attributes: origin.map_or_else(behind_start, opened),
        has_origin: origin.is_some(),
    };
    let axis = if length < SHORTEST_AXIS { axis } else { axis.map(|part| part / length) };
    Ok((Joint { name, motion, parent, child, xyz, rpy, axis, limits }, places))
}

/// Three numbers of an attribute.
fn numbers(node: Node<'_, '_>, key: &str, usual: [f64; 3]) -> Result<[f64; 3], Mistake<Range<usize>>> {
    let Some(attribute) = node.attribute_node(key) else { return Ok(usual) };
    let read: Vec<f64> = attribute.value().split_whitespace().filter_map(finite).collect();
    let words = attribute.value().split_whitespace().count();
    match (read.as_slice(), words) {
        (&[x, y, z], 3) => Ok([x, y, z]),
        _ => {
            let message = format!("`{}` is no three numbers", attribute.value());
            Err(Mistake::new(attribute.range_value(), message).with_help(format!("write {key}=\"0 0 0\"")))
        }
    }
}

/// One number of an attribute.
fn number(node: Node<'_, '_>, key: &str) -> Result<Option<f64>, Mistake<Range<usize>>> {
    let Some(attribute) = node.attribute_node(key) else { return Ok(None) };
    let wrong = || {
        let message = format!("`{}` is no number", attribute.value());
        Mistake::new(attribute.range_value(), message).with_help(format!("write {key}=\"1.57\""))
    };
    finite(attribute.value().trim()).map(Some).ok_or_else(wrong)
}

fn finite(word: &str) -> Option<f64> {
    word.parse().ok().filter(|number: &f64| number.is_finite())
}

/// Where an element begins.
fn start(node: Node<'_, '_>) -> Range<usize> {
    let begin = node.range().start;
    begin..begin + 1
}

/// The byte of a row and a column that count from 1, columns in letters.
fn offset(text: &str, row: u32, column: u32) -> usize {
    let before: usize = text.split_inclusive('\n').take(row.saturating_sub(1) as usize).map(str::len).sum();
    let line = text[before..].lines().next().unwrap_or_default();
    before + line.char_indices().nth(column.saturating_sub(1) as usize).map_or(line.len(), |(at, _)| at)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROBOT: &str = "<?xml version=\"1.0\"?>\n<!-- made by hand: <joint> -->\n<robot name='r'>\n  <link name=\"a\"/>\n\
         <joint type=\"revolute\" name=\"q1\"><origin  rpy='0 0 1.5' /><parent link=\"a\"/><child link=\"b\"/><axis xyz=\"0 0 2\"/>\
         <limit lower=\"-1\" upper=\"2\" effort=\"1\" velocity=\"1\"/></joint>\n\
         <joint name=\"q2\" type=\"prismatic\">\n<parent link=\"b\"/><child link=\"c\"/></joint>\n</robot>\n";

    #[test]
    fn joints_are_read_with_what_is_left_out() {
        let Ok(robot) = Robot::of(ROBOT) else { panic!("it is a robot") };
        assert_eq!((robot.name.as_str(), robot.root.as_str()), ("r", "a"));
        let [one, two] = robot.joints.as_slice() else { panic!("{robot:?}") };
        assert_eq!((one.xyz, one.rpy, one.axis), ([0.0; 3], [0.0, 0.0, 1.5], [0.0, 0.0, 1.0]));
        assert_eq!((one.limits, two.limits), (Some([-1.0, 2.0]), None));
        assert_eq!((two.motion, two.axis), (Motion::Shifts, [1.0, 0.0, 0.0]));
        assert_eq!(robot.path("c"), Some(vec![0, 1]));
        assert_eq!(robot.path("d"), None);
    }

    #[test]
    fn other_origins_change_no_other_byte() {
        let Ok(robot) = Robot::of(ROBOT) else { panic!("it is a robot") };
        let text = robot
            .with_origins(ROBOT, &[(0, [1.0, 2.0, 3.0], [0.25, 0.0, 0.5]), (1, [0.0, 0.0, 1e-7], [0.0; 3])]);
        let expected = ROBOT
            .replace("<origin  rpy='0 0 1.5' />", "<origin xyz=\"1 2 3\"  rpy='0.25 0 0.5' />")
            .replace("\"prismatic\">", "\"prismatic\"><origin xyz=\"0 0 0.0000001\" rpy=\"0 0 0\"/>");
        assert_eq!(text, expected);
        let again = Robot::of(&text).map(|robot| robot.joints[1].xyz);
        assert_eq!(again, Ok([0.0, 0.0, 1e-7]));
    }

    #[test]
    fn what_is_wrong_has_a_place_and_a_help() {
        for (from, to, why) in [
            ("<robot name='r'>", "<robot name='r'", "this is no XML"),
            ("robot", "sdf", "the element `sdf` is no robot"),
            ("type=\"revolute\"", "type=\"hinge\"", "unknown type `hinge`"),
            ("'0 0 1.5'", "'0 0'", "`0 0` is no three numbers"),
            ("'0 0 1.5'", "'0 nan 0'", "is no three numbers"),
            ("0 0 2", "0 0 0", "has no direction"),
            ("<parent link=\"a\"/>", "", "names no parent link"),
            ("name=\"q2\"", "name=\"q1\"", "two joints are called `q1`"),
            ("<child link=\"c\"/>", "<child link=\"b\"/>", "carry the same link `b`"),
            ("<parent link=\"a\"/>", "<parent link=\"c\"/>", "every link hangs on another one"),
            ("<parent link=\"b\"/>", "<parent link=\"x\"/>", "neither `a` nor `x` hangs on another link"),
            ("lower=\"-1\"", "lower=\"low\"", "`low` is no number"),
        ] {
            let text = ROBOT.replace(from, to);
            let Err(mistake) = Robot::of(&text) else { panic!("{why}") };
            assert!(mistake.message.contains(why), "{why}: {mistake:?}");
            assert!(mistake.help.is_some() && text.is_char_boundary(mistake.place.start), "{mistake:?}");
        }
        for text in ["", "<robot/>", "\u{feff}", "<robot><joint/></robot>", "chain A { }"] {
            assert!(Robot::of(text).is_err(), "{text}");
        }
    }
}
