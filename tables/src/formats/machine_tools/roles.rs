//! Which columns of a test of a machine tool are what, by the words of their names.

use crate::formats::{ColumnName, words};

/// What the machine was told or what it read.
const READ: &[&str] = &[
    "commanded",
    "command",
    "cmd",
    "programmed",
    "program",
    "nc",
    "cnc",
    "set",
    "setpoint",
    "target",
    "desired",
    "machine",
    "reading",
    "indicated",
    "indication",
    "probed",
];
/// What is known by something better.
const TRUE: &[&str] = &[
    "true",
    "truth",
    "actual",
    "calibrated",
    "calibration",
    "certified",
    "certificate",
    "reference",
    "ref",
    "tracker",
    "laser",
    "real",
];
const NOMINAL: &[&str] = &["nominal", "nom"];
const MEASURED: &[&str] = &["measured", "meas", "measurement"];
const DEVIATION: &[&str] = &[
    "d",
    "δ",
    "delta",
    "deviation",
    "deviations",
    "dev",
    "error",
    "err",
    "displacement",
    "disp",
    "diff",
    "difference",
];
const BAR: &[&str] = &["bar", "ballbar"];
const RADIUS: &[&str] = &["radius", "radial", "length", "r"];
const ANGLE: &[&str] = &["angle", "theta", "phi", "polar"];
/// What is measured to calibrate a machine that reads it.
const ARTEFACT: &[&str] = &["ball", "sphere", "plate", "artefact", "artifact"];
/// Words that say nothing of a side.
const PLAIN: &[&str] = &[
    "position",
    "pos",
    "axis",
    "coordinate",
    "coord",
    "centre",
    "center",
    "tool",
    "tcp",
    "point",
    "of",
    "in",
    "the",
    "linear",
    "rotary",
    "grid",
    "table",
];

/// Columns for x, y and z, or for turns about them.
pub type Three = [Option<usize>; 3];

/// What a table of a test does not say, with what to write.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Lack(pub String);

/// Whose positions a column has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    Read,
    True,
    Nominal,
    Measured,
    Unsaid,
}

const SIDES: usize = 5;

/// What one column is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Role {
    Position(Side, usize),
    Deviation(usize),
    Turn(usize),
    BarDeviation,
    /// A deviation of something.
    AnyDeviation,
    /// A length of a bar, measured or nominal.
    Bar(Side),
    /// A radius or a length without a word for a side.
    Radius,
    Angle,
}

/// The columns of a test of a machine tool.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Columns {
    positions: [Three; SIDES],
    /// Deviations of positions.
    pub deviations: Three,
    /// Angles of rotary axes a, b and c.
    pub turns: Three,
    /// Deviation of the length of a bar.
    pub bar_deviation: Option<usize>,
    /// A deviation of which no word says what it is of.
    pub deviation: Option<usize>,
    /// Measured length of a bar.
    pub bar: Option<usize>,
    /// Nominal length of a bar.
    pub radius: Option<usize>,
    /// The angle on a circle.
    pub angle: Option<usize>,
    has_artefact: bool,
    /// Two columns that are the same by their names.
    twice: Option<[usize; 2]>,
}

/// Positions that the machine read, and the same as they were.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pair {
    /// As the machine read them.
    pub read: Three,
    /// As they were.
    pub truth: Three,
}

/// Positions of which one side has to be made of deviations.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Alone {
    /// The positions.
    pub positions: Three,
    /// Whether the machine read them; else they are true.
    pub are_read: bool,
}

impl Columns {
    /// Those of a header.
    #[must_use]
    pub fn of<'n>(header: impl IntoIterator<Item = &'n ColumnName>) -> Self {
        let mut own = Self::default();
        let mut unsaid = None;
        for (at, name) in header.into_iter().enumerate() {
            let words = words(&name.stem);
            own.has_artefact |= words.iter().any(|word| ARTEFACT.contains(&word.as_str()));
            let place = match role(&words) {
                None => continue,
                Some(Role::Position(side, axis)) => &mut own.positions[side as usize][axis],
                Some(Role::Deviation(axis)) => &mut own.deviations[axis],
                Some(Role::Turn(axis)) => &mut own.turns[axis],
                Some(Role::BarDeviation) => &mut own.bar_deviation,
                Some(Role::AnyDeviation) => &mut own.deviation,
                Some(Role::Bar(Side::Nominal | Side::True | Side::Read)) => &mut own.radius,
                Some(Role::Bar(Side::Measured | Side::Unsaid)) => &mut own.bar,
                Some(Role::Radius) => &mut unsaid,
                Some(Role::Angle) => &mut own.angle,
            };
            match *place {
                Some(before) => own.twice = Some([before, at]),
                None => *place = Some(at),
            }
        }
        // A radius beside its deviation is nominal. Alone it may be anything's.
        let deviates = own.bar_deviation.is_some() || own.deviation.is_some();
        own.radius = own.radius.or(unsaid.filter(|_| deviates));
        own
    }

    /// Whether it is of axes that turn.
    #[must_use]
    pub fn turns_any(&self) -> bool {
        self.turns.iter().any(Option::is_some)
    }

    /// The positions of a side, where there are any.
    fn side(&self, side: Side) -> Option<Three> {
        let own = self.positions[side as usize];
        own.iter().any(Option::is_some).then_some(own)
    }

    /// The positions that the machine was told, whatever else there is; those without a word for a side where no other are.
    ///
    /// # Errors
    /// Two columns have the same meaning.
    pub fn commanded(&self) -> Result<Option<Three>, Lack> {
        self.once()?;
        Ok(self.side(Side::Read).or(self.side(Side::Unsaid)).or(self.side(Side::Nominal)))
    }

    fn once(&self) -> Result<(), Lack> {
        match self.twice {
            None => Ok(()),
            Some([one, other]) => Err(Lack(format!(
                "columns {} and {} have the same meaning by their names: take one of them out of the table",
                one + 1,
                other + 1
            ))),
        }
    }

    /// What the machine read and what was true, where both have columns.
    ///
    /// # Errors
    /// Nothing says which is which.
    pub fn pair(&self) -> Result<Option<Pair>, Lack> {
        self.once()?;
        let [read, truth, nominal, measured, unsaid] =
            [Side::Read, Side::True, Side::Nominal, Side::Measured, Side::Unsaid].map(|side| self.side(side));
        let pair = |read, truth| Ok(Some(Pair { read, truth }));
        match (read, truth, nominal, measured, unsaid) {
            (Some(read), Some(truth), ..) => pair(read, truth),
            // A plate has nominal places for its balls.
            (Some(read), None, Some(truth), ..) if self.has_artefact => pair(read, truth),
            (Some(read), None, _, Some(truth), _) => pair(read, truth),
            (Some(read), None, Some(truth), ..) | (Some(read), None, None, None, Some(truth)) => {
                pair(read, truth)
            }
            (None, Some(truth), _, Some(read), _)
            | (None, Some(truth), Some(read), None, _)
            | (None, Some(truth), None, None, Some(read)) => pair(read, truth),
            (None, None, Some(known), Some(read), _) | (None, None, None, Some(read), Some(known))
                if self.has_artefact =>
            {
                pair(read, known)
            }
            (None, None, Some(_), Some(_), _) | (None, None, None, Some(_), Some(_)) => Err(Lack(
                "were the positions measured by the machine, or was the machine measured? write `calibrated x` and `machine x`, or \
                 `commanded x` and `true x`, into the names of the columns"
                    .to_owned(),
            )),
            _ => Ok(None),
        }
    }

    /// The positions that have deviations beside them and nothing else.
    ///
    /// # Errors
    /// Nothing says whose they are.
    pub fn alone(&self) -> Result<Option<Alone>, Lack> {
        self.once()?;
        let all = [Side::Read, Side::True, Side::Nominal, Side::Measured, Side::Unsaid];
        let mut there = all.into_iter().filter_map(|side| Some((side, self.side(side)?)));
        let (Some((side, positions)), None) = (there.next(), there.next()) else { return Ok(None) };
        let is_plate = self.has_artefact && !self.turns_any();
        let are_read = match side {
            Side::Read => true,
            Side::True => false,
            Side::Nominal | Side::Unsaid => !is_plate,
            Side::Measured => {
                return Err(Lack(
                    "deviations need the commanded or the calibrated positions beside them: write `commanded x` or `calibrated x` into the \
                     names of the columns"
                        .to_owned(),
                ));
            }
        };
        Ok(Some(Alone { positions, are_read }))
    }
}

/// What a column of these words is; none of a column with a word that no such test has.
fn role(words: &[String]) -> Option<Role> {
    let (mut linear, mut turn) = (None, None);
    let [mut deviates, mut is_bar, mut is_radius, mut is_angle] = [false; 4];
    let [mut read, mut truth, mut nominal, mut measured] = [false; 4];
    for word in words {
        let word = word.as_str();
        let letter = |text: &str, of: [&str; 3]| of.iter().position(|own| *own == text);
        let behind = word.strip_prefix('d').or(word.strip_prefix('δ')).unwrap_or_default();
        if let Some(axis) = letter(word, ["x", "y", "z"]) {
            linear = linear.is_none().then_some(axis);
            linear?;
        } else if let Some(axis) = letter(word, ["a", "b", "c"]) {
            turn = turn.is_none().then_some(axis);
            turn?;
        } else if let Some(axis) = letter(behind, ["x", "y", "z"]) {
            (linear, deviates) = (Some(axis), true);
        } else if behind == "r" {
            (is_radius, deviates) = (true, true);
        } else {
            let is = |of: &[&str]| of.contains(&word);
            let known = [
                (&mut deviates, is(DEVIATION)),
                (&mut is_bar, is(BAR)),
                (&mut is_radius, is(RADIUS)),
                (&mut is_angle, is(ANGLE)),
                (&mut read, is(READ)),
                (&mut truth, is(TRUE)),
                (&mut nominal, is(NOMINAL)),
                (&mut measured, is(MEASURED)),
            ];
            let mut any = is(PLAIN) || is(ARTEFACT);
            for (flag, found) in known {
                *flag |= found;
                any |= found;
            }
            if !any {
                return None;
            }
        }
    }
    let side = match (read, truth, nominal, measured) {
        (true, false, ..) => Side::Read,
        (false, true, ..) => Side::True,
        (false, false, true, false) => Side::Nominal,
        (false, false, false, true) => Side::Measured,
        (false, false, false, false) => Side::Unsaid,
        _ => return None,
    };
    match (linear, turn, is_bar || is_radius, is_angle) {
        (Some(axis), None, false, false) if deviates => Some(Role::Deviation(axis)),
        (Some(axis), None, false, false) => Some(Role::Position(side, axis)),
        (None, Some(axis), false, false) if !deviates => Some(Role::Turn(axis)),
        (None, None, true, false) if deviates => Some(Role::BarDeviation),
        (None, None, true, false) if !is_bar && side == Side::Unsaid => Some(Role::Radius),
        (None, None, true, false) => Some(Role::Bar(side)),
        (None, None, false, true) if !deviates => Some(Role::Angle),
        (None, None, false, false) if deviates => Some(Role::AnyDeviation),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn columns(header: &str) -> Columns {
        let header: Vec<ColumnName> = header.split(',').map(ColumnName::parse).collect();
        Columns::of(&header)
    }

    #[test]
    fn names_say_what_columns_are() {
        for (name, expected) in [
            ("commanded X [mm]", Some(Role::Position(Side::Read, 0))),
            ("X_mm", Some(Role::Position(Side::Unsaid, 0))),
            ("Position Y (mm)", Some(Role::Position(Side::Unsaid, 1))),
            ("nominal_z", Some(Role::Position(Side::Nominal, 2))),
            ("Calibrated ball z", Some(Role::Position(Side::True, 2))),
            ("nominal calibrated x", Some(Role::Position(Side::True, 0))),
            ("dX [µm]", Some(Role::Deviation(0))),
            ("ΔY_um", Some(Role::Deviation(1))),
            ("deviation z [um]", Some(Role::Deviation(2))),
            ("sphere displacement x", Some(Role::Deviation(0))),
            ("C [deg]", Some(Role::Turn(2))),
            ("commanded A [deg]", Some(Role::Turn(0))),
            ("radial deviation [um]", Some(Role::BarDeviation)),
            ("deviation [um]", Some(Role::AnyDeviation)),
            ("dr_um", Some(Role::BarDeviation)),
            ("nominal radius [mm]", Some(Role::Bar(Side::Nominal))),
            ("bar length [mm]", Some(Role::Bar(Side::Unsaid))),
            ("R [mm]", Some(Role::Radius)),
            ("angle [deg]", Some(Role::Angle)),
            ("tip_x_mm", None),
            ("std_x", None),
            ("x y", None),
            ("commanded true x", None),
            ("temperature", None),
            ("", None),
        ] {
            let words = words(&ColumnName::parse(name).stem);
            let found = if words.is_empty() { None } else { role(&words) };
            assert_eq!(found, expected, "{name}");
        }
    }

    #[test]
    fn a_radius_beside_its_deviation_is_nominal() {
        let bar = |header: &str| {
            let own = columns(header);
            (own.bar, own.radius, own.bar_deviation)
        };
        assert_eq!(bar("x,y,radius,dr"), (None, Some(2), Some(3)));
        assert_eq!(bar("x,y,radius"), (None, None, None));
        assert_eq!(bar("x,y,measured radius"), (Some(2), None, None));
        assert_eq!(bar("x,y,bar length,radial deviation"), (Some(2), None, Some(3)));
        assert_eq!(bar("x,y,nominal length,radius error"), (None, Some(2), Some(3)));
        assert_eq!(bar("x,y,radius,deviation"), (None, Some(2), None));
    }

    #[test]
    fn which_side_the_machine_read_is_said_or_asked() {
        let pair = |header: &str| columns(header).pair();
        let read = |header: &str| pair(header).map(|pair| pair.map(|pair| pair.read[0]));
        for header in [
            "commanded x,measured x",
            "commanded x,x",
            "machine x,nominal x",
            "x,true x",
            "nominal x,actual x",
            "ball,x,calibrated x",
        ] {
            assert_eq!(read(header), Ok(Some(Some(header.matches(',').count() - 1))), "{header}");
        }
        for header in ["ball,nominal x,measured x", "sphere,x,measured x", "plate,calibrated x,measured x"] {
            assert_eq!(read(header), Ok(Some(Some(2))), "{header}");
        }
        for header in ["nominal x,measured x", "x,measured x"] {
            assert!(read(header).is_err_and(|Lack(why)| why.contains("calibrated x")), "{header}");
        }
        assert!(read("x,position x").is_err_and(|Lack(why)| why.contains("columns 1 and 2")));
        for header in ["x,y,z", "true x,nominal_q", "azimuth,elevation"] {
            assert_eq!(read(header), Ok(None), "{header}");
        }
    }

    #[test]
    fn deviations_are_of_the_machine_or_of_what_it_reads() {
        let are_read = |header: &str| columns(header).alone().map(|alone| alone.map(|alone| alone.are_read));
        assert_eq!(are_read("x,dx"), Ok(Some(true)));
        assert_eq!(are_read("ball,x,dx"), Ok(Some(false)));
        assert_eq!(are_read("calibrated x,dx"), Ok(Some(false)));
        assert_eq!(are_read("sphere,commanded x,dx"), Ok(Some(true)));
        assert_eq!(are_read("x,c,sphere dx"), Ok(Some(true)));
        assert!(are_read("measured x,dx").is_err());
        assert_eq!(are_read("commanded x,true x,dx"), Ok(None));
    }
}
