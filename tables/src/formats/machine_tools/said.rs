//! What lines above the header of a test of a machine tool state: `# radius = 150 mm`.

use model_core::unit::{Measures, Unit};

use super::roles::Lack;
use crate::formats::clipped;
use crate::formats::decimal::parse;

/// What stands before the deviation that a line defines, and behind it.
const TRUE: &[&str] = &["actual", "true", "calibrated", "reference", "measured", "tool", "spindle", "sphere"];
const READ: &[&str] =
    &["commanded", "programmed", "target", "machine", "reading", "table", "workpiece", "nest"];

/// In which plane a circle was gone round, and the axes of its angle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Plane {
    /// The axis at an angle of zero, and that at a quarter turn.
    pub axes: [usize; 2],
    /// Whether a line says it.
    pub is_said: bool,
}

/// Along which axes a displacement was measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Along {
    /// Those of the table, which turn with it.
    Table,
    /// Those of the machine.
    Machine,
}

/// The lines above a header.
pub(super) struct Said<'c>(pub &'c str);

impl Said<'_> {
    fn of(&self, names: &[&str]) -> Option<String> {
        self.0.lines().find_map(|line| {
            let (name, value) = line.trim_start_matches('#').split_once(['=', ':'])?;
            names.contains(&name.trim().to_lowercase().as_str()).then(|| value.trim().to_owned())
        })
    }

    /// The nominal length of a bar, m.
    pub fn radius_m(&self) -> Result<Option<f64>, Lack> {
        let Some(text) = self.of(&["radius", "nominal radius", "bar length", "length"]) else {
            return Ok(None);
        };
        let wrong = || Lack(format!("`{}` is no length: write `# radius = 150 mm`", clipped(&text)));
        let end = text.find(|letter: char| letter.is_alphabetic()).ok_or_else(wrong)?;
        let (number, unit) = text.split_at(end);
        let number = parse(number.trim(), b'\n').filter(|number| number.is_finite() && *number > 0.0);
        let unit = Unit::read(unit.trim(), Some(Measures::Length)).ok();
        let unit = unit.filter(|unit| unit.measures() == Measures::Length);
        Ok(Some(number.ok_or_else(wrong)? * unit.ok_or_else(wrong)?.in_si()))
    }

    /// The plane of a circle; xy where no line says it.
    pub fn plane(&self) -> Result<Plane, Lack> {
        let Some(text) = self.of(&["plane"]) else { return Ok(Plane { axes: [0, 1], is_said: false }) };
        let axes = match text.to_lowercase().as_str() {
            "xy" => [0, 1],
            "yz" => [1, 2],
            "zx" => [2, 0],
            "xz" => [0, 2],
            _ => {
                return Err(Lack(format!(
                    "`{}` is no plane: write `# plane = XY`, YZ or ZX",
                    clipped(&text)
                )));
            }
        };
        Ok(Plane { axes, is_said: true })
    }

    /// What a line makes of deviations: true positions minus those of the machine, or the opposite; none where no line does.
    pub fn is_true_minus_read(&self) -> Result<Option<bool>, Lack> {
        let Some(text) = self.of(&["deviation", "deviations", "error"]) else { return Ok(None) };
        let lower = text.to_lowercase().replace(" minus ", " - ").replace('−', "-");
        let sides: Vec<[bool; 2]> = lower
            .split('-')
            .map(|part| [TRUE, READ].map(|of| part.split_whitespace().any(|word| of.contains(&word))))
            .collect();
        match sides[..] {
            [[true, false], [false, true]] => Ok(Some(true)),
            [[false, true], [true, false]] => Ok(Some(false)),
            _ => Err(Lack(format!(
                "`{}` does not define a deviation: write `# deviation = actual - commanded`, or the opposite",
                clipped(&text)
            ))),
        }
    }

    /// Along which axes displacements were measured.
    pub fn along(&self) -> Result<Option<Along>, Lack> {
        let Some(text) = self.of(&["displacement", "displacements"]) else { return Ok(None) };
        match text.to_lowercase().trim_start_matches("along the ").trim_end_matches("'s axes").trim() {
            "table" | "axes of the table" => Ok(Some(Along::Table)),
            "machine" | "axes of the machine" => Ok(Some(Along::Machine)),
            _ => Err(Lack(format!(
                "displacements along `{}`: write `# displacement = table` or `# displacement = machine`",
                clipped(&text)
            ))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_state_lengths_planes_and_signs() {
        assert_eq!(Said("# Radius = 150 mm\n").radius_m(), Ok(Some(0.15)));
        assert_eq!(Said("#radius: 0,3m").radius_m(), Ok(Some(0.3)));
        assert_eq!(Said("# made on Monday").radius_m(), Ok(None));
        for text in ["# radius = 150", "# radius = mm", "# radius = -1 mm", "# radius = 3 deg", "# radius ="]
        {
            assert!(Said(text).radius_m().is_err(), "{text}");
        }
        assert_eq!(Said("# plane = ZX").plane(), Ok(Plane { axes: [2, 0], is_said: true }));
        assert!(Said("# plane = XA").plane().is_err());
        for (text, expected) in [
            ("# deviation = actual - commanded", true),
            ("# deviation = commanded minus actual", false),
            ("# deviation = machine − calibrated", false),
            ("# deviation = tool - table", true),
        ] {
            assert_eq!(Said(text).is_true_minus_read(), Ok(Some(expected)), "{text}");
        }
        assert!(Said("# deviation = small").is_true_minus_read().is_err());
        assert_eq!(Said("# displacement = table").along(), Ok(Some(Along::Table)));
        assert!(Said("# displacement = sideways").along().is_err());
    }
}
