//! Files to come with the headings of a study: what their columns mean, and how what is observed is written there.

use model_core::{Chain, Mistakes, SymbolId};
use nalgebra::{UnitQuaternion, Vector3};

use super::column_plan::{ColumnAt, ColumnPlan};
use super::conversion::Conversion;
use super::mistakes::{Gathered, Outcome, Several, every, mistake};
use super::order::{order_of, times};
use super::plan::{Reading, SourcePlan};
use super::shown;
use super::trajectory::TrajectoryPlan;
use super::written::Study;
use observe::kinds::{Cells, Filled};
use observe::{Derived, direction_from_spherical, spherical_of_direction};
use tables::formats::{ColumnName, DataError, Options};

/// What the columns of a study's files mean, whatever the study asks for.
#[derive(Debug, Clone)]
pub struct Headings {
    /// The chain with the study's inputs behind its own symbols; its observables show vectors.
    pub chain: Chain,
    /// What is read, source by source.
    pub sources: Vec<SourcePlan>,
    /// The column by which the rows are ordered.
    pub order: Option<String>,
    /// How the files are written.
    pub format: Options,
    /// What joins the rows by time.
    pub trajectory: Option<TrajectoryPlan>,
}

/// From what the values of a joint or input come.
#[derive(Debug, Clone, PartialEq)]
pub enum Need {
    /// The column of a joint or input.
    Reading(SymbolId),
    /// A column of plain numbers of this name.
    Numbers(String),
    /// The column by which the rows are ordered.
    Order(String),
}

/// Rows in their order of acquisition.
#[derive(Debug, Clone, PartialEq)]
pub struct Sequence {
    /// The rows of the file, the first that was taken first.
    pub order: Vec<usize>,
    /// When each row of the file was taken, s; else the first row that does not say.
    pub times: Result<Vec<f64>, usize>,
}

impl Sequence {
    /// By the labels in the column of the order.
    #[must_use]
    pub fn of(labels: &[String]) -> Self {
        Self { order: order_of(labels), times: times(labels) }
    }
}

/// A column of what is observed, as it is written.
#[derive(Debug, Clone, PartialEq)]
pub struct ObservedColumn<'h> {
    /// Its key in `[observed]`.
    pub key: &'static str,
    /// Its name in the study, or its declared name.
    pub name: &'h str,
    /// What it measures.
    pub quantity: model_core::Quantity,
    /// The size of the unit that the study states, in SI, and its name.
    pub unit: Option<(f64, &'static str)>,
    /// How its numbers become readings.
    pub conversion: Conversion,
}

impl Study {
    /// What its columns mean to a chain that declares what the study names.
    ///
    /// # Errors
    /// Every name that the chain does not declare, with its place.
    pub fn headings(&self, chain: &Chain) -> Result<Headings, Mistakes> {
        self.resolved_headings(chain).map_err(|Several(mistakes)| Mistakes::locate(&self.text, mistakes))
    }

    /// The same study as a part of a longer text, in which its mistakes have their places.
    #[must_use]
    pub fn inside(self, text: &str) -> Self {
        Self { text: text.to_owned(), ..self }
    }

    fn resolved_headings(&self, chain: &Chain) -> Outcome<Headings> {
        let chain = self.with_inputs(chain)?;
        let mut mistakes = Gathered::default();
        let sources = mistakes.take(self.sources(&chain));
        let format = mistakes.take(self.format());
        let trajectory = mistakes.take(self.trajectory());
        mistakes.none()?;
        let (Some(sources), Some(format), Some(trajectory)) = (sources, format, trajectory) else {
            unreachable!("what is missing comes with a mistake")
        };
        // What is written in a unit is not read first, which would refuse a unit of something else.
        let places = std::iter::once(&self.observed).chain(self.also.iter().map(|also| &also.observed));
        every(sources.iter().zip(places).flat_map(|(source, observed)| {
            let other = |plan: &&ColumnPlan| plan.unit.is_some_and(|unit| unit.measures() != plan.measures);
            source.observed.iter().filter(other).map(|plan| {
                let message = format!("column `{}` is stated in a unit of something else", plan.name);
                let help = format!("write a unit such as {}", plan.measures.quantity().unit());
                Err::<(), _>(mistake(observed.span(), message, help))
            })
        }))?;
        let order = self.noise.order.clone();
        Ok(Headings { chain: shown::vectors(chain), sources, order, format, trajectory })
    }
}

impl Headings {
    /// From what the values of a joint or input come in the files of a source.
    #[must_use]
    pub fn needs(&self, source: usize, symbol: SymbolId) -> Vec<Need> {
        let need = |name: &str| {
            let reading = self.chain.find_symbol(name).filter(|id| self.column(source, *id).is_some());
            match reading {
                Some(id) => Need::Reading(id),
                None if self.order.as_deref() == Some(name) => Need::Order(name.to_owned()),
                None => Need::Numbers(name.to_owned()),
            }
        };
        match self.reading(source, symbol) {
            Some(Reading::Derived(derived)) => {
                let mut needs: Vec<Need> = derived.columns().into_iter().map(need).collect();
                // Which row comes before which is said by the order.
                let order = self.order.iter().filter(|_| derived.follows_rows());
                needs.extend(order.map(|name| Need::Order(name.clone())));
                needs
            }
            // What no study says the column of has a column of its own name.
            Some(Reading::Column(_) | Reading::Sighted) | None => vec![Need::Reading(symbol)],
        }
    }

    /// How a joint or input follows from other columns of a source, if it does.
    #[must_use]
    pub fn derived(&self, source: usize, symbol: SymbolId) -> Option<&Derived> {
        match self.reading(source, symbol)? {
            Reading::Derived(derived) => Some(derived),
            Reading::Column(_) | Reading::Sighted => None,
        }
    }

    /// Finds the column of a joint or input in a file of a source, where the study says which; `declared` are the names of the chain.
    ///
    /// # Errors
    /// It is not there, or there twice, or its unit is none or measures something else.
    pub fn find(
        &self,
        source: usize,
        symbol: SymbolId,
        (header, file): (&[ColumnName], &str),
        declared: &[&str],
    ) -> Option<Result<ColumnAt, DataError>> {
        self.column(source, symbol).map(|plan| plan.find(header, declared, file))
    }

    /// Finds the columns of what is observed in a file of a source, in order.
    ///
    /// # Errors
    /// One is not there, or there twice, or its unit is none or measures something else.
    pub fn find_observed(
        &self,
        source: usize,
        (header, file): (&[ColumnName], &str),
        declared: &[&str],
    ) -> Result<Vec<ColumnAt>, DataError> {
        let plans = self.sources.get(source).map_or(&[][..], |source| &source.observed);
        plans.iter().map(|plan| plan.find(header, declared, file)).collect()
    }

    /// The column of a joint or input as the study writes it: its name, the size of its unit, SI, with that unit's name, and how its numbers
    /// become readings.
    #[must_use]
    pub fn written(
        &self,
        source: usize,
        symbol: SymbolId,
    ) -> Option<(&str, (f64, &'static str), Conversion)> {
        let plan = self.column(source, symbol)?;
        let unit = plan.unit.or_else(|| ColumnName::parse(&plan.name).unit());
        let unit = unit.filter(|unit| unit.measures() == plan.measures);
        let unit = unit.map_or((1.0, plan.measures.quantity().unit()), |unit| (unit.in_si(), unit.name()));
        Some((&plan.name, unit, plan.conversion))
    }

    fn reading(&self, source: usize, symbol: SymbolId) -> Option<&Reading> {
        let readings = &self.sources.get(source)?.readings;
        readings.iter().find(|(id, _)| *id == symbol).map(|(_, reading)| reading)
    }

    fn column(&self, source: usize, symbol: SymbolId) -> Option<&ColumnPlan> {
        match self.reading(source, symbol)? {
            Reading::Column(plan) => Some(plan),
            Reading::Derived(_) | Reading::Sighted => None,
        }
    }
}

impl SourcePlan {
    /// How its columns are filled with what the chain shows; `None` where its rows hold what a chain alone does not show.
    #[must_use]
    pub fn filled(&self) -> Option<Filled> {
        self.way.filled
    }

    /// The columns of what is observed, in order.
    pub fn observed_columns(&self) -> impl Iterator<Item = ObservedColumn<'_>> {
        self.observed.iter().zip(&self.observed_keys).map(|(plan, key)| ObservedColumn {
            key,
            name: &plan.name,
            quantity: plan.measures.quantity(),
            unit: plan.unit.map(|unit| (unit.in_si(), unit.name())),
            conversion: plan.conversion,
        })
    }

    /// The direction or point that the numbers of its observed columns say, SI; none where they say none by themselves.
    #[must_use]
    pub fn target(&self, numbers: &[f64]) -> Option<Vector3<f64>> {
        self.way.filled.filter(|filled| !filled.beside_nominal)?;
        let measured = (self.way.read)(&mut Given { numbers, source: self }).ok()?;
        measured.vector().copied()
    }

    /// The azimuth and the elevation (or what the observable counts for it) of a vector, rad.
    #[must_use]
    pub fn angles(&self, vector: &Vector3<f64>) -> [f64; 2] {
        match &self.convention {
            Some(convention) => convention.angles(vector),
            None => spherical_of_direction(vector),
        }
    }
}

/// What a row says that has nothing but what is observed.
struct Given<'a> {
    numbers: &'a [f64],
    source: &'a SourcePlan,
}

impl Cells for Given<'_> {
    fn at(&self, column: usize) -> f64 {
        self.numbers.get(column).copied().unwrap_or(f64::NAN)
    }

    fn direction(&self, azimuth_rad: f64, second_rad: f64) -> (Vector3<f64>, f64) {
        match &self.source.convention {
            Some(convention) => convention.direction(azimuth_rad, second_rad),
            None => (direction_from_spherical(azimuth_rad, second_rad), second_rad),
        }
    }

    fn nominal(&mut self) -> Vector3<f64> {
        Vector3::from_element(f64::NAN)
    }

    fn orientation(&mut self) -> Result<UnitQuaternion<f64>, String> {
        Err("an orientation is no target".to_owned())
    }
}
