//! How a body was turned, where a table says it beside its place: a quaternion, a matrix, or three angles with names that a field gives one
//! meaning.
//!
//! Source: REP 103 of ROS and URDF (roll, pitch, yaw about fixed x, y, z: Rz Ry Rx); KUKA, KSS system software (A, B, C: Rz Ry Rx); FANUC,
//! handling tool operator's manual (W, P, R about fixed x, y, z: Rz Ry Rx).

use super::look::{Column, Look, Read};

/// The columns of an orientation, by the keys of a study.
pub struct Turned {
    /// Key and column.
    pub columns: Vec<(&'static str, Read)>,
    /// About which axes three angles turn.
    pub euler: Option<&'static str>,
    /// The columns of a place, where the same matrix has them.
    pub place: Option<[String; 3]>,
    /// What they are, for people.
    pub what: String,
}

/// Words before a component of a quaternion.
const QUATERNION: &[&str] = &["q", "quat", "quaternion", "rot", "rotation", "ori", "orientation"];
/// Letters before the row and the column of a matrix.
const MATRIX: &[&str] = &["r", "m", "t", "rot", "mat", "matrix", "pose"];
/// Three angles: their names in the order of the turns, and the axes of these.
const ANGLES: &[([&str; 3], &str, &str)] = &[
    (["yaw", "pitch", "roll"], "zyx", "roll, pitch and yaw about fixed x, y and z, as ROS has them"),
    (["a", "b", "c"], "zyx", "A, B and C about z, the new y and the new x, as KUKA has them"),
    (["r", "p", "w"], "zyx", "W, P and R about fixed x, y and z, as FANUC has them"),
];

impl Turned {
    /// The orientation that a table says; none where it says none.
    ///
    /// # Errors
    /// A column that cannot be read.
    pub fn of(look: &Look, remarks: &mut Vec<String>) -> Result<Option<Self>, String> {
        if let Some(found) = quaternion(look) {
            return Ok(Some(found));
        }
        if let Some(found) = matrix(look) {
            return Ok(Some(found));
        }
        for (names, euler, what) in ANGLES {
            let columns: Option<Vec<&Column>> = names.iter().map(|name| alone(look, name)).collect();
            let Some(columns) = columns else { continue };
            let read = look.angles(&columns, remarks)?;
            let columns = ["e1", "e2", "e3"].into_iter().zip(read).collect();
            return Ok(Some(Self { columns, euler: Some(euler), place: None, what: (*what).to_owned() }));
        }
        if ["rx", "ry", "rz"].iter().all(|name| alone(look, name).is_some()) {
            remarks.push(
                "rx, ry and rz may be a rotation vector or three turns, and nothing says which: they are not read; write [[also]] with kind = \
                 \"orientation\" and rx, ry, rz (a vector) or e1, e2, e3 with euler (turns)"
                    .to_owned(),
            );
        }
        Ok(None)
    }
}

/// The one column of numbers whose name is this, in small letters and without its unit.
fn alone<'l>(look: &'l Look, name: &str) -> Option<&'l Column> {
    let of = |column: &&Column| {
        let own: String =
            column.name.stem.to_lowercase().chars().filter(|letter| letter.is_alphanumeric()).collect();
        own == name && !column.values().is_empty()
    };
    let mut found = look.columns.iter().filter(of);
    found.next().filter(|_| found.next().is_none())
}

fn quaternion(look: &Look) -> Option<Turned> {
    QUATERNION.iter().find_map(|before| {
        let columns: Option<Vec<_>> = ["w", "x", "y", "z"]
            .into_iter()
            .map(|part| alone(look, &format!("{before}{part}")).map(|column| (part, column.plain())))
            .collect();
        let what = "a unit quaternion".to_owned();
        columns.map(|columns| Turned { columns, euler: None, place: None, what })
    })
}

/// A matrix whose rows and columns count from 1 or from 0.
fn matrix(look: &Look) -> Option<Turned> {
    const KEYS: [&str; 9] = ["r11", "r12", "r13", "r21", "r22", "r23", "r31", "r32", "r33"];
    let starts = || MATRIX.iter().flat_map(|letter| [(letter, 1), (letter, 0)]);
    starts().find_map(|(letter, first)| {
        let entry =
            |row: usize, column: usize| alone(look, &format!("{letter}{}{}", row + first, column + first));
        let columns: Option<Vec<_>> = KEYS
            .into_iter()
            .enumerate()
            .map(|(at, key)| entry(at / 3, at % 3).map(|column| (key, column.plain())))
            .collect();
        // A matrix from 1 has no entry 00.
        let columns = columns.filter(|_| first == 0 || alone(look, &format!("{letter}00")).is_none())?;
        let place = [0, 1, 2].map(|row| entry(row, 3).map(|column| column.name.full.clone()));
        let place = match place {
            [Some(x), Some(y), Some(z)] => Some([x, y, z]),
            _ => None,
        };
        let what = if place.is_some() { "a matrix of 3 × 4 or 4 × 4 entries" } else { "a rotation matrix" };
        Some(Turned { columns, euler: None, place, what: what.to_owned() })
    })
}
