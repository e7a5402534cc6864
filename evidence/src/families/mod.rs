//! The registry of hypotheses: each is a family of columns with one variance, a price and a name.

mod direction;
mod gravity;
mod input;
mod offered;
mod order;
mod pair;
mod session;
mod simple;
mod smooth;
mod surface;

pub use crate::driver::Driver;
pub(crate) use session::add as add_setups;

use crate::function::{Function, Wave};
use crate::places::Places;
use crate::policy::Policy;
use crate::problem::{Problem, Rows};
use crate::shape::Shape;

/// The classes of families, each in a file of its own.
const FAMILIES: [fn(&Setting, &mut Dictionary); 9] = [
    simple::offer,
    direction::offer,
    gravity::offer,
    pair::offer,
    smooth::offer,
    surface::offer,
    input::offer,
    order::offer,
    session::offer,
];

/// A column: places times functions, summed.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Number of a distinct place, and the function that multiplies its column.
    pub terms: Vec<(usize, Function)>,
}

/// Families that share a price.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// One function with a name.
    Simple,
    /// Cosine and sine of one order.
    Pair,
    /// A smooth function whose spectrum falls steeply.
    Smooth,
    /// A smooth function with another spectrum.
    Rough,
    /// A function of two joints.
    Surface,
    /// A step at a date.
    Step,
    /// Wandering along the order of the rows.
    Order,
    /// Offsets of sessions or found set-ups.
    Setup,
    /// A shape of the library.
    Shape,
}

/// Where a family acts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Where {
    /// At a distinct place.
    Place(usize),
    /// At both tilts of a frame.
    Tilts(usize),
}

/// The function of a family.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Law {
    /// A constant.
    Constant,
    /// Proportional to the joint.
    Scale,
    /// Cotangent of the joint.
    Cot,
    /// Tangent of the joint.
    Tan,
    /// Direction of motion.
    Direction,
    /// Direction of motion times first harmonics.
    DirectionHarmonic,
    /// Direction of motion times a smooth function.
    DirectionSmooth,
    /// Cosine and sine of an order.
    Harmonic(usize),
    /// A tilt that turns with the joint, this often, in the sense of the sign.
    Whirl(i32),
    /// Products of first harmonics.
    Product,
    /// A smooth function; the spectrum is 0 (n^-4), 1 (n^-2), or one of the lengths.
    Smooth(usize),
    /// A function of two joints.
    Surface,
    /// Proportional to an input.
    Linear,
    /// A step at a part of the range of an input.
    StepAt(f64),
    /// Gravity's components in the place's frame.
    Gravity,
    /// Compliance by the mass at one load of the place.
    Compliance(usize),
    /// Compliance by all loads.
    AllLoads,
    /// Steps along the order, a random walk.
    Walk,
    /// An offset a session.
    Sessions,
    /// An offset a found set-up, of so many.
    Setups(usize),
    /// A shape.
    Shape(Shape),
    /// An effect of the caller's catalogue, by its number in [`Problem::offered`].
    Offered(usize),
}

/// A hypothesis: columns with one variance.
#[derive(Debug, Clone, PartialEq)]
pub struct Family {
    /// Its class.
    pub class: Class,
    /// Where it acts.
    pub place: Where,
    /// What it depends on.
    pub driver: Driver,
    /// Its function.
    pub law: Law,
    /// Numbers of its columns.
    pub columns: Vec<usize>,
    /// Relative standard deviations of its coefficients.
    pub relative: Vec<f64>,
    /// Log price beyond that of its class, nats.
    pub extra: f64,
    /// Log price, nats.
    pub price: f64,
}

impl Family {
    /// Whether it belongs to the noise: never a cause.
    #[must_use]
    pub fn is_noise(&self) -> bool {
        matches!(self.class, Class::Order | Class::Setup)
    }

    /// Whether its law is left open: a smooth function or a surface.
    #[must_use]
    pub fn is_open(&self) -> bool {
        matches!(self.law, Law::Smooth(_) | Law::Surface)
    }

    /// Whether it has a name of its own in the catalogue.
    #[must_use]
    pub fn is_named(&self) -> bool {
        matches!(self.class, Class::Simple | Class::Pair | Class::Step)
    }
}

/// What a class of families may read.
pub(crate) struct Setting<'a> {
    pub rows: &'a Rows,
    pub places: &'a Places,
    pub policy: &'a Policy,
    /// Loads of each distinct place whose torque is not zero.
    pub loads: Vec<Vec<usize>>,
    /// Whether gravity is known in the frame of each distinct place.
    pub gravity: Vec<bool>,
}

impl Setting<'_> {
    /// Whether the chain has few enough joints for every family at every place.
    pub fn few(&self) -> bool {
        self.rows.joints.len() as f64 <= self.policy.few_joints
    }

    pub fn joints(&self) -> std::ops::Range<usize> {
        0..self.rows.joints.len()
    }

    /// Numbers of the distinct places of the chain, without the measured range.
    pub fn chain_places(&self) -> impl Iterator<Item = usize> {
        (0..self.places.distinct.len()).filter(|&place| !self.places.distinct[place].is_range)
    }

    pub fn owns(&self, place: usize, joint: usize) -> bool {
        self.places.distinct[place].own.contains(&joint)
    }

    pub fn is_axis(&self, place: usize) -> bool {
        !self.places.distinct[place].own.is_empty()
    }

    pub fn turns(&self, place: usize) -> bool {
        self.places.distinct[place].turns
    }

    pub fn beside(&self, place: usize, joint: usize) -> bool {
        self.places.distinct[place].beside.contains(&joint)
    }
}

/// All families with their columns.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Dictionary {
    /// The columns.
    pub columns: Vec<Column>,
    /// The families.
    pub families: Vec<Family>,
    /// Columns of each place, for finding one again.
    by_place: Vec<Vec<usize>>,
}

impl Dictionary {
    /// Every family of a problem, with prices.
    #[must_use]
    pub fn of(problem: &Problem, places: &Places, policy: &Policy) -> Self {
        let given = |distinct: &crate::places::Distinct| &problem.places[distinct.place];
        let moved =
            |load: &crate::problem::Load| load.torque.iter().any(|torque| torque.abs() > policy.rounding);
        let setting = Setting {
            rows: &problem.rows,
            places,
            policy,
            loads: places
                .distinct
                .iter()
                .map(|place| {
                    (0..).zip(&given(place).loads).filter(|(_, load)| moved(load)).map(|(at, _)| at).collect()
                })
                .collect(),
            gravity: places.distinct.iter().map(|place| given(place).gravity.is_some()).collect(),
        };
        let mut dictionary = Self::default();
        for offer in FAMILIES {
            offer(&setting, &mut dictionary);
        }
        if !problem.offered.is_empty() {
            // What is told has to have a name that the caller knows.
            dictionary.keep(&|family| !family.is_named());
            offered::offer(problem, places, policy, &mut dictionary);
        }
        dictionary.set_prices(&problem.rows, policy);
        dictionary
    }

    /// Leaves out families, and columns that no other one needs.
    pub(crate) fn keep(&mut self, wanted: &dyn Fn(&Family) -> bool) {
        self.families.retain(wanted);
        let all = std::mem::take(&mut self.columns);
        self.by_place.clear();
        let mut renumbered: Vec<Option<usize>> = vec![None; all.len()];
        for at in 0..self.families.len() {
            for own in 0..self.families[at].columns.len() {
                let old = self.families[at].columns[own];
                let new = match renumbered[old] {
                    Some(new) => new,
                    None => self.column(all[old].terms.clone()),
                };
                renumbered[old] = Some(new);
                self.families[at].columns[own] = new;
            }
        }
    }

    /// The number of a column, new or known.
    pub(crate) fn column(&mut self, terms: Vec<(usize, Function)>) -> usize {
        let place = terms[0].0;
        if self.by_place.len() <= place {
            self.by_place.resize(place + 1, Vec::new());
        }
        if let Some(&known) = self.by_place[place].iter().find(|&&known| self.columns[known].terms == terms) {
            return known;
        }
        self.columns.push(Column { terms });
        self.by_place[place].push(self.columns.len() - 1);
        self.columns.len() - 1
    }

    /// Adds a family at one place; functions come with their relative standard deviations.
    pub(crate) fn add(
        &mut self,
        (class, law): (Class, Law),
        place: usize,
        driver: Driver,
        functions: Vec<(Function, f64)>,
        extra: f64,
    ) {
        let (mut columns, mut relative) = (Vec::new(), Vec::new());
        for (function, deviation) in functions {
            columns.push(self.column(vec![(place, function)]));
            relative.push(deviation);
        }
        self.push(Family {
            class,
            place: Where::Place(place),
            driver,
            law,
            columns,
            relative,
            extra,
            price: 0.0,
        });
    }

    /// Adds a family.
    pub(crate) fn push(&mut self, family: Family) -> usize {
        self.families.push(family);
        self.families.len() - 1
    }

    fn set_prices(&mut self, rows: &Rows, policy: &Policy) {
        let mut pairs: Vec<(Where, Driver)> =
            self.families.iter().filter(|family| family.class == Class::Pair).map(Family::site).collect();
        pairs.sort_unstable();
        pairs.dedup();
        let of_class: Vec<f64> = self
            .families
            .iter()
            .map(|family| self.families.iter().filter(|other| other.class == family.class).count() as f64)
            .collect();
        for (family, of_class) in self.families.iter_mut().zip(of_class) {
            let class = match family.class {
                Class::Pair => (policy.harmonic_sum * pairs.len() as f64).ln(),
                Class::Smooth => of_class.ln() + policy.price_smooth,
                Class::Rough | Class::Surface => of_class.ln() + policy.price_rough,
                Class::Step => of_class.ln() + policy.price_step,
                Class::Order => of_class.ln() + policy.price_order,
                Class::Simple | Class::Setup | Class::Shape => of_class.ln(),
            };
            let of_time = matches!(family.driver, Driver::Input(input) if rows.inputs[input].is_time);
            family.price = class + family.extra + if of_time { policy.price_time } else { 0.0 };
        }
    }
}

impl Family {
    /// Place and driver.
    #[must_use]
    pub fn site(&self) -> (Where, Driver) {
        (self.place, self.driver)
    }
}

/// Cosine and sine of an order.
pub(crate) fn waves(joint: usize, order: usize) -> [Wave; 2] {
    [false, true].map(|sine| Wave { joint, order, sine })
}
