//! Which way the axes of a pointing instrument turn, and from where its angles count, as its rows show it.
//!
//! The first axis is z, the second lies across it and raises what looks forward. Senses are told apart by how well true
//! angles follow the readings, whatever constant lies between them; the constant says which way is forward.

use std::f64::consts::{FRAC_PI_2, PI};

use super::look::Read;

/// Angles that follow each other scatter less than this: the mean resultant length of what is between them, of 20 degrees.
const FOLLOWS: f64 = 0.94;
/// What is between true angles and readings, and is worth starting the fit from, in rad.
const WORTH_STARTING: f64 = 0.01;
/// What is more than this is where a scale begins, and no small error, in rad.
const NO_ERROR: f64 = 0.1;

/// Senses of both axes and what looks forward.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Sense of the first axis about z.
    first: f64,
    /// Sense of the second: positive raises.
    second: f64,
    /// Quarter turns from x to what looks forward, 0 to 3.
    forward: u8,
    /// What is left between the true angles and the readings, in rad.
    pub left: [f64; 2],
}

impl Frame {
    /// Azimuth from y through x, elevation upwards: where the rows do not tell, the usual frame.
    pub const USUAL: Self = Self { first: -1.0, second: 1.0, forward: 1, left: [0.0; 2] };

    /// As true directions follow the readings of the two joints.
    pub fn seen(first: &Read, second: &Read, vectors: &[[f64; 3]]) -> Option<Self> {
        let azimuth: Vec<f64> = vectors.iter().map(|v| v[1].atan2(v[0])).collect();
        let elevation: Vec<f64> = vectors.iter().map(|v| v[2].asin()).collect();
        // Near the pole of the first axis its angle is lost in the noise.
        let weight: Vec<f64> = vectors.iter().map(|v| v[0].hypot(v[1])).collect();
        let (one, turned) = followed(&first.si, &azimuth, &weight)?;
        let (two, raised) = followed(&second.si, &elevation, &vec![1.0; vectors.len()])?;
        Some(Self::facing(one, two, turned, raised))
    }

    /// As true directions follow the readings of one joint, at a constant elevation.
    pub fn turning(joint: &Read, vectors: &[[f64; 3]]) -> Option<Self> {
        let azimuth: Vec<f64> = vectors.iter().map(|v| v[1].atan2(v[0])).collect();
        let (one, turned) = followed(&joint.si, &azimuth, &vec![1.0; vectors.len()])?;
        let raised = vectors.iter().map(|v| v[2].asin()).sum::<f64>() / vectors.len() as f64;
        Some(Self::facing(one, 1.0, turned, raised))
    }

    /// As a true azimuth, from y through x, follows the reading of one joint.
    pub fn following(joint: &Read, azimuth: &Read) -> Option<Self> {
        let from_x: Vec<f64> = azimuth.si.iter().map(|azimuth| FRAC_PI_2 - azimuth).collect();
        let (one, turned) = followed(&joint.si, &from_x, &vec![1.0; from_x.len()])?;
        let left = wrapped(turned - FRAC_PI_2);
        Some(Self { first: one, second: 1.0, forward: 1, left: [left, 0.0] })
    }

    fn facing(first: f64, second: f64, turned: f64, raised: f64) -> Self {
        let quarters = (turned / FRAC_PI_2).round();
        let left = [wrapped(turned - quarters * FRAC_PI_2), wrapped(raised)];
        Self { first, second, forward: (quarters.rem_euclid(4.0)) as u8 % 4, left }
    }

    /// How the first joint moves, from where its scale begins.
    pub fn turns(&self, joint: &str) -> String {
        format!("Rz({}{joint}{})", sign(self.first), beginning(joint, self.left[0]))
    }

    /// How the second joint moves, from where its scale begins.
    pub fn tilts(&self, joint: &str) -> String {
        let (axis, sense) = self.raising();
        format!("R{axis}({}{joint}{})", sign(sense * self.second), beginning(joint, self.left[1]))
    }

    /// The constants of a declaration with these joints: where the scale of each begins, if that is no small error.
    pub fn scales(&self, joints: &[&str]) -> String {
        let (_, sense) = self.raising();
        let lines =
            joints.iter().zip([self.left[0], sense * self.left[1]]).filter(|(_, left)| begins(*left) != 0.0);
        lines
            .map(|(joint, left)| {
                let degrees = f64::from(tenths(left)) / 10.0;
                let begins = begins(left);
                format!(
                    "    /// Where the scale of {joint} begins: {degrees} deg, here in rad.\n    const {joint}_begins: angle = \
                     {begins};\n"
                )
            })
            .collect()
    }

    /// A turn about the first axis, by an amount in the sense of its joint.
    pub fn turn(&self, amount: &str) -> String {
        format!("Rz({}{amount})", sign(self.first))
    }

    /// A turn about the second axis, by an amount in the sense of its joint.
    pub fn tilt(&self, amount: &str) -> String {
        let (axis, sense) = self.raising();
        format!("R{axis}({}{amount})", sign(sense * self.second))
    }

    /// A turn about the second axis that raises what looks forward.
    pub fn raise(&self, amount: &str) -> String {
        let (axis, sense) = self.raising();
        format!("R{axis}({}{amount})", sign(sense))
    }

    /// A turn about what looks forward.
    pub fn roll(&self, amount: &str) -> String {
        let (axis, sense) = [("x", 1.0), ("y", 1.0), ("x", -1.0), ("y", -1.0)][usize::from(self.forward)];
        format!("R{axis}({}{amount})", sign(sense))
    }

    /// What looks forward, as an observable's components.
    pub fn sight(&self) -> &'static str {
        ["1, 0, 0", "0, 1, 0", "-1, 0, 0", "0, -1, 0"][usize::from(self.forward)]
    }

    /// Where down is, for an instrument whose first axis points to the pole: the meridian lies in the forward direction.
    pub fn down(&self) -> &'static str {
        [
            "-cos(latitude), 0, -sin(latitude)",
            "0, -cos(latitude), -sin(latitude)",
            "cos(latitude), 0, -sin(latitude)",
            "0, cos(latitude), -sin(latitude)",
        ][usize::from(self.forward)]
    }

    fn raising(&self) -> (&'static str, f64) {
        [("y", -1.0), ("x", 1.0), ("y", 1.0), ("x", -1.0)][usize::from(self.forward)]
    }

    /// Where the fit of the two indices starts, in the senses of their joints; nothing where that is near zero.
    pub fn starts(&self, names: [&'static str; 2]) -> Vec<(&'static str, String)> {
        let [turned, raised] = self.left.map(|left| left - begins(left));
        [(names[0], self.first * turned), (names[1], self.second * raised)]
            .into_iter()
            .filter(|(name, left)| !name.is_empty() && left.abs() > WORTH_STARTING)
            .map(|(name, left)| (name, format!("{:.3} deg", left.to_degrees())))
            .collect()
    }
}

fn sign(sense: f64) -> &'static str {
    if sense < 0.0 { "-" } else { "" }
}

/// Where a scale begins, to a tenth of a degree, if that is no small error: in rad.
fn begins(left: f64) -> f64 {
    if left.abs() > NO_ERROR { f64::from(tenths(left)) * PI / 1800.0 } else { 0.0 }
}

fn tenths(angle: f64) -> i32 {
    (angle.to_degrees() * 10.0).round() as i32
}

/// The same as it stands behind a joint: ` + azimuth_begins`.
fn beginning(joint: &str, left: f64) -> String {
    if begins(left) == 0.0 { String::new() } else { format!(" + {joint}_begins") }
}

/// An angle between −π and π.
fn wrapped(angle: f64) -> f64 {
    (angle + PI).rem_euclid(2.0 * PI) - PI
}

/// The sense in which an angle follows a reading, and the constant between them; none if it does not.
fn followed(reading: &[f64], angle: &[f64], weight: &[f64]) -> Option<(f64, f64)> {
    let resultant = |sense: f64| {
        let mut sum = [0.0; 2];
        for ((reading, angle), weight) in reading.iter().zip(angle).zip(weight) {
            let between = angle - sense * reading;
            sum[0] += weight * between.cos();
            sum[1] += weight * between.sin();
        }
        let length = sum[0].hypot(sum[1]) / weight.iter().sum::<f64>();
        (length, sense, sum[1].atan2(sum[0]))
    };
    let [up, down] = [resultant(1.0), resultant(-1.0)];
    let best = if down.0 > up.0 { down } else { up };
    (best.0 > FOLLOWS).then_some((best.1, best.2))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(si: Vec<f64>) -> Read {
        Read { column: String::new(), unit: Some("rad"), notation: None, si }
    }

    #[test]
    fn where_a_scale_begins_is_no_error() {
        let reading: Vec<f64> = (0..30).map(f64::from).collect();
        let azimuth = reading.iter().map(|reading| -reading - 0.7).collect();
        let Some(frame) = Frame::following(&read(reading), &read(azimuth)) else { panic!("it follows") };
        assert_eq!(frame.turns("a"), "Rz(a + a_begins)");
        assert!(
            frame.scales(&["a"]).ends_with("const a_begins: angle = 0.6998770300497261;\n"),
            "{}",
            frame.scales(&["a"])
        );
        assert_eq!(frame.starts(["index", ""]), []);
    }

    #[test]
    fn every_usual_frame_is_recognised_by_its_rows() {
        let azimuth: Vec<f64> = (0..40).map(|row| 0.37 * f64::from(row)).collect();
        let elevation: Vec<f64> = (0..40).map(|row| 0.2 + 0.9 * (0.7 * f64::from(row)).sin().abs()).collect();
        type Direction = fn(f64, f64) -> [f64; 3];
        let frames: [(Direction, &str, &str, &str); 4] = [
            (|a, e| [a.sin() * e.cos(), a.cos() * e.cos(), e.sin()], "Rz(-a)", "Rx(e)", "0, 1, 0"),
            (|a, e| [a.cos() * e.cos(), a.sin() * e.cos(), e.sin()], "Rz(a)", "Ry(-e)", "1, 0, 0"),
            // x north, y east, z down.
            (|a, e| [a.cos() * e.cos(), a.sin() * e.cos(), -e.sin()], "Rz(a)", "Ry(e)", "1, 0, 0"),
            (|a, e| [-a.cos() * e.cos(), a.sin() * e.cos(), e.sin()], "Rz(-a)", "Ry(e)", "-1, 0, 0"),
        ];
        for (direction, turn, tilt, sight) in frames {
            let vectors: Vec<[f64; 3]> =
                azimuth.iter().zip(&elevation).map(|(&a, &e)| direction(a + 0.05, e)).collect();
            let frame = Frame::seen(&read(azimuth.clone()), &read(elevation.clone()), &vectors);
            let Some(frame) = frame else { panic!("{turn}, {tilt}") };
            assert_eq!(
                (frame.turn("a").as_str(), frame.tilt("e").as_str(), frame.sight()),
                (turn, tilt, sight)
            );
            // Readings 0.05 rad behind the truth.
            assert_eq!(frame.starts(["index", ""]), [("index", "2.865 deg".to_owned())]);
        }
        let nowhere: Vec<[f64; 3]> =
            (0..40).map(|row| [f64::from(row).sin(), f64::from(row).cos(), 0.0]).collect();
        assert_eq!(Frame::seen(&read(azimuth), &read(elevation), &nowhere), None);
    }
}
