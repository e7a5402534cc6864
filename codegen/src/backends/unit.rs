//! What goes into one generated file, and what every language says about it.

use model_core::{Chain, ObservableId, Quantity, SymbolId, SymbolKind};

use super::names::{Names, camel_case};
use crate::build::{Builds, Covariance, Measured};
use crate::program::{Form, Program};
use model_core::escape::comments;

/// What a generated file is made from.
#[derive(Debug, Clone)]
pub struct Unit<'a> {
    /// The chain.
    pub chain: &'a Chain,
    /// The text of its declaration, quoted in the file.
    pub declaration: &'a str,
    /// The observables, computed together so that they share what they have in common.
    pub observables: &'a [ObservableId],
    /// What is computed of them, a function each.
    pub forms: &'a [Form],
    /// Errors and constants whose values are written into the file, in SI: the file has no fields for these errors.
    pub values: &'a [(SymbolId, f64)],
    /// Whether the file has functions of many poses too.
    pub rows: bool,
    /// The numbers that the file computes with. Single precision is for processors that have no other: Rust and C, one pose.
    pub precision: Precision,
    /// What a reader of the file should know beside the declaration, line by line: how far exact and first-order error
    /// are apart, and in which box of errors.
    pub remarks: &'a [String],
    /// What a calibration says beside the values.
    pub calibrated: Calibrated<'a>,
}

/// What a calibration says of an instrument beside the values of its errors and constants.
#[derive(Debug, Clone, Copy, Default)]
pub struct Calibrated<'a> {
    /// How sure those are: for [`Form::Uncertainty`].
    pub covariance: Option<Covariance<'a>>,
    /// The region that was measured; the file has a function that says whether a pose lies in it.
    pub region: &'a [Measured],
    /// The last day on which the calibration counts, as `2027-06-30`; the file has it as a constant.
    pub valid_until: Option<&'a str>,
}

impl<'a> Unit<'a> {
    /// A file without values or remarks, with functions of many poses.
    #[must_use]
    pub fn new(
        chain: &'a Chain,
        declaration: &'a str,
        observables: &'a [ObservableId],
        forms: &'a [Form],
    ) -> Self {
        let precision = Precision::Double;
        Self {
            chain,
            declaration,
            observables,
            forms,
            values: &[],
            rows: true,
            precision,
            remarks: &[],
            calibrated: Calibrated::default(),
        }
    }
}

/// The numbers that a generated file computes with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Precision {
    /// f64: 53 bits.
    Double,
    /// f32: 24 bits.
    Single,
}

/// A form of a unit, as a program.
pub(crate) struct Function {
    pub(crate) form: Form,
    pub(crate) program: Program,
}

/// The symbols that one argument of a function holds.
pub(crate) struct Group {
    pub(crate) kind: SymbolKind,
    /// What an argument that holds them is called: `joints`.
    pub(crate) argument: &'static str,
    /// What they are.
    pub(crate) about: &'static str,
    pub(crate) symbols: Vec<SymbolId>,
}

impl Group {
    /// The group of some symbols, if there are any.
    pub(crate) fn new(kind: SymbolKind, symbols: Vec<SymbolId>) -> Option<Self> {
        let (argument, about) = match kind {
            SymbolKind::Joint => ("joints", "Where the joints stand, by their encoders."),
            SymbolKind::Input => ("inputs", "What is measured beside the joints."),
            SymbolKind::Error => ("errors", "What differs from the design: nothing where all are zero."),
            SymbolKind::Constant => ("constants", "The sizes of the geometry."),
            SymbolKind::Pi | SymbolKind::Ramp | SymbolKind::SightAngle => return None,
        };
        if symbols.is_empty() { None } else { Some(Self { kind, argument, about, symbols }) }
    }

    /// The type of one set of them: `Joints`.
    pub(crate) fn type_name(&self) -> String {
        camel_case(self.argument)
    }

    /// One of them: `joint`.
    pub(crate) fn singular(&self) -> &'static str {
        self.argument.strip_suffix('s').unwrap_or(self.argument)
    }
}

/// What the functions of one file have in common.
pub(crate) struct Shared<'a> {
    pub(crate) unit: &'a Unit<'a>,
    pub(crate) functions: Vec<Function>,
    /// Joints, and the inputs that some function reads: arguments of every function of a pose.
    pub(crate) pose: Vec<Group>,
    /// Errors without a value of their own.
    pub(crate) errors: Option<Group>,
    /// Every error: the columns of Jacobians.
    pub(crate) columns: Vec<SymbolId>,
    /// Whether a pose lies in the region that was measured, 1 or 0, where one is known.
    pub(crate) region: Option<Program>,
}

impl<'a> Shared<'a> {
    pub(crate) fn new(unit: &'a Unit<'a>) -> Self {
        let columns: Vec<SymbolId> = unit.chain.symbols_of(SymbolKind::Error).collect();
        let Calibrated { covariance, region, .. } = unit.calibrated;
        let builds = Builds { chain: unit.chain, values: unit.values, covariance };
        // A chain without errors has no Jacobians.
        let functions: Vec<Function> = unit
            .forms
            .iter()
            .map(|&form| Function { form, program: builds.build(unit.observables, &[form], &columns) })
            .filter(|function| !function.program.outputs().is_empty())
            .collect();
        let is_read =
            |id: SymbolId| functions.iter().any(|f| f.program.inputs().iter().any(|&(read, _)| read == id));
        let inputs = unit.chain.symbols_of(SymbolKind::Input).filter(|&id| is_read(id)).collect();
        let joints = unit.chain.symbols_of(SymbolKind::Joint).collect();
        let pose = [Group::new(SymbolKind::Joint, joints), Group::new(SymbolKind::Input, inputs)];
        let region: Vec<Measured> = region.iter().copied().filter(|range| is_read(range.symbol)).collect();
        let has_value = |id: &SymbolId| unit.values.iter().any(|(symbol, _)| symbol == id);
        let errors = columns.iter().copied().filter(|id| !has_value(id)).collect();
        Self {
            unit,
            functions,
            pose: pose.into_iter().flatten().collect(),
            errors: Group::new(SymbolKind::Error, errors),
            columns,
            region: (!region.is_empty()).then(|| builds.region(&region)),
        }
    }

    /// Whether there are functions of many poses: without joints and inputs there is one pose.
    pub(crate) fn has_rows(&self) -> bool {
        self.unit.rows && self.unit.precision == Precision::Double && !self.pose.is_empty()
    }

    /// Whether a form has a function without branches beside its usual one. In single precision that is the usual one.
    pub(crate) fn has_variant_without_branch(&self, form: Form) -> bool {
        form == Form::FirstOrderError && self.unit.precision == Precision::Double
    }

    /// The joints that an inverse correction moves, where the file can have one: it is made of exact value and exact error.
    pub(crate) fn joints_to_correct(&self) -> Option<&Group> {
        let has = |form| self.functions.iter().any(|function| function.form == form);
        let is_possible = has(Form::ExactValue)
            && has(Form::ExactError)
            && self.unit.precision == Precision::Double
            && !self.columns.is_empty();
        self.pose.iter().find(|group| is_possible && group.kind == SymbolKind::Joint)
    }

    /// The observables that an inverse correction is made for: those that show components. Readings of angles jump.
    pub(crate) fn with_inverse(&self) -> impl Iterator<Item = ObservableId> {
        let shows_components = |id: &ObservableId| self.unit.chain.observable(*id).has_components_only();
        self.unit.observables.iter().copied().filter(shows_components)
    }

    /// The symbols of a pose, in order.
    pub(crate) fn pose_symbols(&self) -> impl Iterator<Item = SymbolId> {
        self.pose.iter().flat_map(|group| group.symbols.iter().copied())
    }

    /// How many numbers an observable shows.
    pub(crate) fn shown(&self, id: ObservableId) -> usize {
        self.unit.chain.observable(id).shown.len()
    }

    /// The number that every observable shows, if it is one.
    pub(crate) fn shown_by_each(&self) -> Option<usize> {
        let mut counts = self.unit.observables.iter().map(|&id| self.shown(id));
        let first = counts.next()?;
        counts.all(|count| count == first).then_some(first)
    }

    /// What belongs to each number that is shown, observable by observable.
    pub(crate) fn by_observable<'t, T>(&self, mut rows: &'t [T]) -> Vec<(ObservableId, &'t [T])> {
        let mut parts = Vec::new();
        for &id in self.unit.observables {
            let (own, rest) = rows.split_at(self.shown(id).min(rows.len()));
            parts.push((id, own));
            rows = rest;
        }
        parts
    }

    /// Where each output of a form goes, in order: components of a field for each observable, or columns of them.
    pub(crate) fn places(&self, form: Form, names: &Names) -> Vec<String> {
        let mut places = Vec::new();
        for &id in self.unit.observables {
            for component in 0..self.shown(id) {
                let component = format!("{}[{component}]", names.observable(id));
                if form.is_jacobian() {
                    places.extend((0..self.columns.len()).map(|column| format!("{component}[{column}]")));
                } else {
                    places.push(component);
                }
            }
        }
        places
    }

    /// How many numbers a form has for each component of an observable.
    pub(crate) fn columns_of(&self, form: Form) -> usize {
        if form.is_jacobian() { self.columns.len() } else { 1 }
    }

    /// What a reader of the file has to know, without comment marks.
    pub(crate) fn preamble(&self) -> String {
        let chain = self.unit.chain;
        let mut text = if chain.documentation.is_empty() {
            format!("The chain {}.\n", chain.name)
        } else {
            format!("{}\n", chain.documentation)
        };
        text.push_str(&format!(
            "\nGenerated by trueaxis {} from the declaration below: change that, not this file.\n\
             Angles are in radians, lengths in metres, points and directions in the ground frame.\n",
            env!("CARGO_PKG_VERSION")
        ));
        for &id in self.unit.observables {
            let observable = chain.observable(id);
            let mut said = Vec::new();
            if !observable.is_vector() {
                said.extend(observable.shown.iter().map(|reading| reading.describe()));
            }
            let frame = observable
                .frame
                .filter(|_| !observable.is_image())
                .map(|frame| format!("in the frame of {}", chain.body(frame).name));
            if !said.is_empty() || frame.is_some() {
                let parts = [Some(said.join(", ")).filter(|said| !said.is_empty()), frame];
                let parts: Vec<String> = parts.into_iter().flatten().collect();
                text.push_str(&format!("{}: {}.\n", observable.name, parts.join(", ")));
            }
        }
        if self.unit.precision == Precision::Single {
            text.push_str(
                "Single precision: sines and cosines are at most 0.9 units in the last place off for any angle, by the same\n\
                 instructions for every angle.\n",
            );
        }
        if let Some(date) = self.unit.calibrated.valid_until {
            text.push_str(&format!("This calibration is valid until {date}.\n"));
        }
        if self.region.is_some() {
            text.push_str("Measured over:\n");
        }
        for range in self.unit.calibrated.region.iter().filter(|_| self.region.is_some()) {
            let symbol = chain.symbol(range.symbol);
            let (low, high, unit) = (range.low, range.high, symbol.quantity.unit());
            text.push_str(&format!("    {} from {low:?} to {high:?} {unit}\n", symbol.name));
        }
        for remark in self.unit.remarks {
            text.push_str(remark);
            text.push('\n');
        }
        if !self.unit.values.is_empty() {
            text.push_str("Written into this file:\n");
            for &(id, value) in self.unit.values {
                let symbol = chain.symbol(id);
                text.push_str(&format!("    {} = {value:?} {}\n", symbol.name, symbol.quantity.unit()));
            }
        }
        text.push('\n');
        for line in comments::lines(self.unit.declaration.trim_end()) {
            text.push_str(format!("    {line}").trim_end());
            text.push('\n');
        }
        text
    }

    /// What a symbol is, on one line, with its unit.
    pub(crate) fn describe(&self, id: SymbolId) -> String {
        let symbol = self.unit.chain.symbol(id);
        let words = comments::line(&symbol.documentation);
        let words = words.trim_end_matches('.');
        let unit = match symbol.quantity {
            Quantity::Angle | Quantity::Length => symbol.quantity.unit(),
            Quantity::Number => "number",
        };
        if words.is_empty() { format!("`{}` ({unit}).", symbol.name) } else { format!("{words} ({unit}).") }
    }

    /// What an observable is, on one line.
    pub(crate) fn describe_observable(&self, id: ObservableId) -> String {
        let observable = self.unit.chain.observable(id);
        let words = comments::line(&observable.documentation);
        if words.is_empty() { format!("The observable `{}`.", observable.name) } else { words }
    }
}

/// A form's name in generated files.
#[must_use]
pub fn form_name(form: Form) -> &'static str {
    match form {
        Form::ExactValue => "exact_value",
        Form::ExactError => "exact_error",
        Form::FirstOrderError => "first_order_error",
        Form::ExactJacobian => "exact_jacobian",
        Form::FirstOrderJacobian => "first_order_jacobian",
        Form::Uncertainty => "uncertainty",
    }
}

/// What a form is, on one line.
pub(crate) fn describe_form(form: Form) -> &'static str {
    match form {
        Form::ExactValue => "The observables with errors, exact: x, y and z.",
        Form::ExactError => {
            "What the errors add to the observables, exact at any size of the errors: x, y and z."
        }
        Form::FirstOrderError => {
            "What the errors add to the observables, to order 1 (products of errors dropped): x, y and z."
        }
        Form::ExactJacobian => {
            "Derivatives of the observables with respect to every error, at the errors given: rows x, y and z, a column for each error."
        }
        Form::FirstOrderJacobian => {
            "Derivatives of the observables with respect to every error where all errors are zero (order 1): rows x, y and z, a column for each error."
        }
        Form::Uncertainty => {
            "The standard uncertainty of the observables with errors, by the covariance of the calibration: of x, y and z, in the unit of each."
        }
    }
}

/// What the function of the measured region says, on one line.
pub(crate) const OF_REGION: &str = "Whether a pose lies in the measured region. Outside nothing confirms the correction. A reading that is no number is outside.";
