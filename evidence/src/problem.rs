//! What a contest is asked about: rows, what moves, the places of the chain, the declared errors, the residual.

use crate::driver::Driver;
use crate::error::Error;

/// A variable that moves the chain, with its value in each row.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// Its name.
    pub name: String,
    /// Value of each row, rad or m.
    pub values: Vec<f64>,
    /// Sense of motion on arrival in each row, −1, 0 or 1, where it is known.
    pub direction: Option<Vec<f64>>,
    /// Whether its zero is the horizon, so that its cotangent or tangent means something.
    pub from_horizon: bool,
}

/// A measured side quantity, such as temperature.
#[derive(Debug, Clone, PartialEq)]
pub struct Input {
    /// Its name.
    pub name: String,
    /// Value of each row.
    pub values: Vec<f64>,
    /// Whether it is the time of measuring, which shares much with a slow path.
    pub is_time: bool,
}

/// What the rows have beside measured values: what a function of the dictionary may depend on.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Rows {
    /// Number of rows.
    pub count: usize,
    /// The joints.
    pub joints: Vec<Joint>,
    /// The side quantities.
    pub inputs: Vec<Input>,
    /// Number of the session of each row, where sessions are labelled.
    pub labels: Option<Vec<usize>>,
    /// Whether the rows are in the order in which they were measured.
    pub in_order: bool,
    /// Functions of a row that offered effects multiply the columns of places with: values of each row.
    pub given: Vec<Vec<f64>>,
}

/// An effect of the caller's catalogue, which may be told by its name.
#[derive(Debug, Clone, PartialEq)]
pub struct Offered {
    /// Its name.
    pub name: String,
    /// Number of the place in [`Problem::places`] that it is told at.
    pub place: usize,
    /// What it follows.
    pub driver: Driver,
    /// Periods a turn, of a harmonic.
    pub order: Option<usize>,
    /// For each coefficient the places that it moves, each with the number of its function in [`Rows::given`].
    pub columns: Vec<Vec<(usize, usize)>>,
}

/// A degree of freedom.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Freedom {
    /// A small rotation about an axis (0, 1, 2), rad.
    Rotation(u8),
    /// A small shift along an axis (0, 1, 2), m.
    Shift(u8),
    /// The measured range, m.
    Range,
}

/// Torque about a joint's axis by a unit mass at one later body.
#[derive(Debug, Clone, PartialEq)]
pub struct Load {
    /// The body that holds the mass.
    pub body: String,
    /// Torque in each row.
    pub torque: Vec<f64>,
}

/// A degree of freedom at one point of the chain.
#[derive(Debug, Clone, PartialEq)]
pub struct Place {
    /// Its name, such as `fork.Rz`.
    pub name: String,
    /// Number of its frame in [`Problem::frames`].
    pub frame: usize,
    /// What moves.
    pub freedom: Freedom,
    /// The joint that moves exactly this degree of freedom.
    pub own: Option<usize>,
    /// The joints that this place is beside in the chain.
    pub beside: Vec<usize>,
    /// Change of the measured components by a unit of it: N·m values, row by row.
    pub column: Vec<f64>,
    /// The same where all declared errors are zero, if known: by it places are merged, and dropped where it is zero.
    /// Errors that absorb much of an effect make columns of one place differ.
    pub nominal: Option<Vec<f64>>,
    /// Down in this place's frame, three components of N values, where gravity is declared.
    pub gravity: Option<[Vec<f64>; 3]>,
    /// Torques of gravity about this place's axis.
    pub loads: Vec<Load>,
}

impl Place {
    /// The column by which this place is compared with others.
    #[must_use]
    pub fn compared(&self) -> &[f64] {
        self.nominal.as_deref().unwrap_or(&self.column)
    }
}

/// A point of the chain at which degrees of freedom are offered, from the ground up.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Frame {
    /// Its name.
    pub name: String,
    /// The two places that tilt it about x and y.
    pub tilts: Option<[usize; 2]>,
    /// The joint below it and the two places across its axis, for whirls.
    pub whirl: Option<(usize, [usize; 2])>,
}

/// A declared error.
#[derive(Debug, Clone, PartialEq)]
pub struct Declared {
    /// Its name.
    pub name: String,
    /// Its estimate, where residual and columns are taken.
    pub estimate: f64,
    /// Change of the measured components by a unit of it: N·m values.
    pub column: Vec<f64>,
}

/// Everything that a contest reads.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// The rows.
    pub rows: Rows,
    /// Number of measured components of a row.
    pub components: usize,
    /// Observed less exact chain at the estimates: N·m values, row by row.
    pub residual: Vec<f64>,
    /// Stated uncertainty of each value, where it is stated.
    pub sigma: Option<Vec<f64>>,
    /// The declared errors.
    pub declared: Vec<Declared>,
    /// The frames, from the ground up.
    pub frames: Vec<Frame>,
    /// The places.
    pub places: Vec<Place>,
    /// Effects that are told by these names. Where there are any, no others are.
    pub offered: Vec<Offered>,
}

impl Problem {
    /// Measured values: rows times components.
    #[must_use]
    pub fn values(&self) -> usize {
        self.rows.count * self.components
    }

    /// Checks lengths, references and values.
    ///
    /// # Errors
    ///
    /// The first list that has a wrong length, refers to what there is not, or holds a value that is not finite.
    pub fn check(&self) -> Result<(), Error> {
        if self.values() == 0 {
            return Err(Error::Empty);
        }
        let (rows, values) = (self.rows.count, self.values());
        check_list("the residual", &self.residual, values)?;
        if let Some(sigma) = &self.sigma {
            check_list("the stated uncertainty", sigma, values)?;
            if let Some((at, &value)) = sigma.iter().enumerate().find(|(_, value)| **value <= 0.0) {
                return Err(Error::Sigma { at, value });
            }
        }
        self.rows.check()?;
        for error in &self.declared {
            check_list(&format!("the column of `{}`", error.name), &error.column, values)?;
            check_list(&format!("the estimate of `{}`", error.name), &[error.estimate], 1)?;
        }
        for place in &self.places {
            let name = |what: &str| format!("{what} of place `{}`", place.name);
            check_list(&name("the column"), &place.column, values)?;
            if let Some(nominal) = &place.nominal {
                check_list(&name("the nominal column"), nominal, values)?;
            }
            check_index(&name("the frame"), place.frame, "frames", self.frames.len())?;
            for &joint in place.own.iter().chain(&place.beside) {
                check_index(&name("a joint"), joint, "joints", self.rows.joints.len())?;
            }
            for component in place.gravity.iter().flatten() {
                check_list(&name("gravity"), component, rows)?;
            }
            for load in &place.loads {
                check_list(&name(&format!("the torque of `{}`", load.body)), &load.torque, rows)?;
            }
        }
        for effect in &self.offered {
            let name = format!("effect `{}`", effect.name);
            check_index(&name, effect.place, "places", self.places.len())?;
            for &(place, function) in effect.columns.iter().flatten() {
                check_index(&name, place, "places", self.places.len())?;
                check_index(&name, function, "functions", self.rows.given.len())?;
            }
            match effect.driver {
                Driver::Joint(joint) => check_index(&name, joint, "joints", self.rows.joints.len())?,
                Driver::Joints(first, second) => {
                    check_index(&name, first.max(second), "joints", self.rows.joints.len())?;
                }
                Driver::Input(input) => check_index(&name, input, "inputs", self.rows.inputs.len())?,
                Driver::Nothing | Driver::Gravity | Driver::Order => {}
            }
        }
        for frame in &self.frames {
            let name = format!("frame `{}`", frame.name);
            for place in frame.tilts.iter().chain(frame.whirl.iter().map(|(_, pair)| pair)).flatten() {
                check_index(&name, *place, "places", self.places.len())?;
            }
            if let Some((joint, _)) = frame.whirl {
                check_index(&name, joint, "joints", self.rows.joints.len())?;
            }
        }
        Ok(())
    }
}

impl Rows {
    /// Checks that every list has one finite value a row.
    ///
    /// # Errors
    ///
    /// The first list that does not.
    pub fn check(&self) -> Result<(), Error> {
        for joint in &self.joints {
            check_list(&format!("joint `{}`", joint.name), &joint.values, self.count)?;
            if let Some(direction) = &joint.direction {
                check_list(&format!("the direction of `{}`", joint.name), direction, self.count)?;
            }
        }
        for input in &self.inputs {
            check_list(&format!("input `{}`", input.name), &input.values, self.count)?;
        }
        for (number, values) in self.given.iter().enumerate() {
            check_list(&format!("function {number}"), values, self.count)?;
        }
        match &self.labels {
            Some(labels) if labels.len() != self.count => {
                Err(Error::Length { what: "the labels".into(), found: labels.len(), wanted: self.count })
            }
            _ => Ok(()),
        }
    }
}

fn check_list(what: &str, values: &[f64], wanted: usize) -> Result<(), Error> {
    if values.len() != wanted {
        return Err(Error::Length { what: what.into(), found: values.len(), wanted });
    }
    match values.iter().enumerate().find(|(_, value)| !value.is_finite()) {
        Some((at, &value)) => Err(Error::NotFinite { what: what.into(), at, value }),
        None => Ok(()),
    }
}

fn check_index(what: &str, index: usize, of: &'static str, count: usize) -> Result<(), Error> {
    if index < count {
        return Ok(());
    }
    Err(Error::Reference { what: what.into(), index, of, count })
}
