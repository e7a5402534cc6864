//! `calibration.conf` of Universal Robots: what is added to the nominal Denavit-Hartenberg sizes of an arm.
//!
//! Source: Universal Robots, `ur_calibration` (ROS 2 documentation), and copies of `.urcontrol/calibration.conf` that laboratories publish: a
//! section `[mounting]` with lists of six numbers, `delta_theta` and `delta_alpha` in rad, `delta_a` and `delta_d` in m. Where two axes are
//! nearly parallel, `delta_d` goes to hundreds of metres and comes back on the next joint.

use std::f64::consts::FRAC_PI_2;

/// How many joints an arm has.
pub const JOINTS: usize = 6;

/// An arm, as it is designed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arm {
    /// What it is called.
    pub name: &'static str,
    /// d of each link by Denavit and Hartenberg, m.
    pub d: [f64; JOINTS],
    /// a of the second and the third, m; that of the others is zero.
    pub a: [f64; 2],
}

const fn arm(name: &'static str, d: [f64; JOINTS], a: [f64; 2]) -> Arm {
    Arm { name, d, a }
}

/// The arms whose sizes are known.
///
/// Source: Universal Robots, parameters for calculations of kinematics and dynamics.
pub const ARMS: &[Arm] = &[
    arm("UR3", [0.1519, 0.0, 0.0, 0.112_35, 0.085_35, 0.0819], [-0.243_65, -0.213_25]),
    arm("UR5", [0.089_159, 0.0, 0.0, 0.109_15, 0.094_65, 0.0823], [-0.425, -0.392_25]),
    arm("UR10", [0.1273, 0.0, 0.0, 0.163_941, 0.1157, 0.0922], [-0.612, -0.5723]),
    arm("UR3e", [0.151_85, 0.0, 0.0, 0.131_05, 0.085_35, 0.0921], [-0.243_55, -0.2132]),
    arm("UR5e", [0.1625, 0.0, 0.0, 0.1333, 0.0997, 0.0996], [-0.425, -0.3922]),
    arm("UR10e", [0.1807, 0.0, 0.0, 0.174_15, 0.119_85, 0.116_55], [-0.6127, -0.571_55]),
    arm("UR16e", [0.1807, 0.0, 0.0, 0.174_15, 0.119_85, 0.116_55], [-0.4784, -0.36]),
];

impl Arm {
    /// theta, d, a and alpha of each link, rad and m.
    #[must_use]
    pub fn links(&self) -> [[f64; 4]; JOINTS] {
        let twists = [FRAC_PI_2, 0.0, 0.0, FRAC_PI_2, -FRAC_PI_2, 0.0];
        let a = [0.0, self.a[0], self.a[1], 0.0, 0.0, 0.0];
        std::array::from_fn(|joint| [0.0, self.d[joint], a[joint], twists[joint]])
    }

    /// The sum of its sizes, m.
    #[must_use]
    pub fn reach_m(&self) -> f64 {
        self.d.iter().chain(&self.a).map(|size| size.abs()).sum()
    }
}

/// What is added to the sizes of each link.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Deltas {
    /// rad
    pub theta: [f64; JOINTS],
    /// m
    pub a: [f64; JOINTS],
    /// m
    pub d: [f64; JOINTS],
    /// rad
    pub alpha: [f64; JOINTS],
}

/// What is wrong with a file, and on which line.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: {why}")]
pub struct ConfError {
    /// From 1.
    pub line: usize,
    /// What is wrong, and what to write.
    pub why: String,
}

/// Whether a text is such a file.
#[must_use]
pub fn looks(text: &str) -> bool {
    text.lines().any(|line| line.trim() == "[mounting]") && text.contains("delta_theta")
}

impl Deltas {
    /// Reads a file. Other keys, the checksums of the joints among them, are not read.
    ///
    /// # Errors
    /// A list that is not of six finite numbers, or one that is missing or there twice.
    pub fn of(text: &str) -> Result<Self, ConfError> {
        let mut found: [Option<[f64; JOINTS]>; 4] = [None; 4];
        let (mut is_inside, mut last) = (false, 1);
        for (line, text) in (1..).zip(text.trim_start_matches('\u{feff}').lines()) {
            last = line;
            let text = text.split('#').next().unwrap_or_default().trim();
            if text.starts_with('[') && text.ends_with(']') && !text.contains('=') {
                is_inside = text == "[mounting]";
                continue;
            }
            let Some((key, value)) = text.split_once('=').filter(|_| is_inside) else { continue };
            let Some(at) = KEYS.iter().position(|known| *known == key.trim()) else { continue };
            let bad = |why: String| ConfError { line, why };
            if found[at].is_some() {
                return Err(bad(format!("`{}` is there twice: leave one out", KEYS[at])));
            }
            let numbers = six(value.trim()).ok_or_else(|| {
                bad(format!("`{}` is no list of six numbers: write [0, 0, 0, 0, 0, 0]", KEYS[at]))
            })?;
            found[at] = Some(numbers);
        }
        let of = |at: usize| {
            found[at].ok_or_else(|| ConfError {
                line: last,
                why: format!("the file ends without `{}` under [mounting]", KEYS[at]),
            })
        };
        Ok(Self { theta: of(0)?, a: of(1)?, d: of(2)?, alpha: of(3)? })
    }

    /// The file with these numbers.
    #[must_use]
    pub fn text(&self) -> String {
        let lists = [&self.theta, &self.a, &self.d, &self.alpha];
        let line = |(key, list): (&&str, &[f64; JOINTS])| {
            let numbers: Vec<String> = list.iter().map(|number| format!("{number:e}")).collect();
            format!("{key} = [{}]\n", numbers.join(", "))
        };
        let lines: String = KEYS.iter().zip(lists).map(line).collect();
        format!("[mounting]\n{lines}calibration_status = 2\n")
    }
}

const KEYS: [&str; 4] = ["delta_theta", "delta_a", "delta_d", "delta_alpha"];

fn six(text: &str) -> Option<[f64; JOINTS]> {
    let inside = text.strip_prefix('[')?.strip_suffix(']')?;
    let numbers: Vec<f64> = inside
        .split(',')
        .map(|word| word.trim().parse().ok().filter(|number: &f64| number.is_finite()))
        .collect::<Option<_>>()?;
    numbers.try_into().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = "[mounting]\ndelta_theta = [ 0, 0.6731, -0.8223, 0.1492, 1.22e-06, 0]\ndelta_a = [0.0001, 0.13, 0.006, 0, 0, 0]\n\
                        delta_d = [0.0002, 681.73, -696.41, 14.6725, -0.0001, -0.0009]\ndelta_alpha = [0, 0, 0, 0, 0, 0] # rad\n\
                        joint_checksum = [0xb435bb63, 0xb441d7b1, 0, 0, 0, 0]\ncalibration_status = 2   # 2 == Linearised\n";

    #[test]
    fn what_is_written_is_read_back() {
        assert!(looks(FILE) && !looks("[mounting]\n"));
        let Ok(deltas) = Deltas::of(FILE) else { panic!("it is one") };
        assert_eq!((deltas.d[1], deltas.theta[2]), (681.73, -0.8223));
        assert_eq!(Deltas::of(&deltas.text()), Ok(deltas));
        assert_eq!(Deltas::of(&FILE.replace('\n', "\r\n")), Ok(deltas));
    }

    #[test]
    fn what_is_wrong_has_its_line() {
        for (from, to, why) in [
            ("681.73, ", "", "line 4: `delta_d` is no list of six numbers"),
            ("681.73", "x", "line 4: `delta_d` is no list"),
            ("681.73", "1e999", "line 4: `delta_d` is no list"),
            ("delta_alpha", "delta_beta", "the file ends without `delta_alpha`"),
            ("delta_alpha", "delta_d", "line 5: `delta_d` is there twice"),
        ] {
            let said = Deltas::of(&FILE.replace(from, to)).map_err(|error| error.to_string());
            assert!(said.as_ref().is_err_and(|said| said.contains(why)), "{why}: {said:?}");
        }
    }
}
