//! MATLAB and Octave: one function file that returns its evaluators, for numbers and for rows of many poses.

use model_core::{Chain, SymbolId, SymbolKind};

use super::names::{Names, Rules};
use super::notation::{Notation, Scope};
use super::unit::{self, Group, OF_REGION, Shared, describe_form, form_name};
use crate::lower::pose;
use crate::lower::tree::{Angle, Function, Name, Statement, Wave};
use crate::program::Form;
use model_core::escape::comments;

/// Names have 63 letters at most in MATLAB, and none of them is an underscore in front.
const RULES: Rules = Rules { words: &RESERVED, starts: &["_"], takes_letters: false, longest: 56 };

/// How the file is used.
const USE: &str = "
For MATLAB (R2016b or later) and GNU Octave. The function of the file returns a structure of evaluators, which take
structures of numbers, or of arrays of as many poses. Columns of what they return are poses; of a Jacobian, pages.
Sines and cosines, and their accuracy, are the language's.
";

/// Functions that evaluators call.
const SHARED: &str = "
function poses = trueaxis_poses(columns)
  counts = cellfun(@numel, columns);
  several = counts(counts ~= 1);
  poses = 1;
  if ~isempty(several)
    poses = several(1);
  end
  if any(several ~= poses)
    error('trueaxis:lengths', 'joints and inputs must be numbers, or arrays of as many poses');
  end
end

function trueaxis_check(what, given, names)
  if ~isstruct(given) || numel(fieldnames(given)) ~= numel(names) || ~all(isfield(given, names))
    error('trueaxis:fields', '%s must be a structure with the fields %s, and no other', what, strjoin(names, ', '));
  end
end
";

/// Functions of ramps and readings, where not a number stays not a number.
const CALLED: &str = "
function y = trueaxis_saturate(x)
  y = min(max(x, 0), 1);
  y(isnan(x)) = NaN;
end

function y = trueaxis_step(x)
  y = double(x >= 0);
  y(isnan(x)) = NaN;
end

function y = trueaxis_root(x)
  y = sqrt(max(x, 0));
  y(~(x >= 0)) = NaN;
end
";

/// Newton's steps from the joint readings, with central differences of 1e-5 rad or m.
const INVERSE: &str = "
  seen = exact_value(value, POSE);
  added = exact_error(without, POSE);
  target = seen.(observable) - added.(observable);
  rows = size(target, 2);
  at = joints;
  for m = 1:numel(names)
    at.(names{m}) = reshape(joints.(names{m}), 1, []) + zeros(1, rows);
  end
  start = at;
  left = target - seen.(observable);
  remaining = sqrt(sum(left .^ 2, 1));
  for round = 1:20
    slopes = zeros(size(target, 1), numel(names), rows);
    for m = 1:numel(names)
      moved = at;
      moved.(names{m}) = at.(names{m}) + 1e-5;
      above = exact_value(value, MOVED);
      moved.(names{m}) = at.(names{m}) - 1e-5;
      below = exact_value(value, MOVED);
      slopes(:, m, :) = reshape((above.(observable) - below.(observable)) / 2e-5, [], 1, rows);
    end
    step = zeros(numel(names), rows);
    for row = find(all(isfinite(left), 1) & reshape(all(all(isfinite(slopes), 1), 2), 1, []))
      slope = slopes(:, :, row);
      step(:, row) = pinv(slope, 1e-9 * norm(slope)) * left(:, row);
    end
    moved = at;
    for m = 1:numel(names)
      moved.(names{m}) = at.(names{m}) + step(m, :);
    end
    there = exact_value(value, MOVED);
    after = target - there.(observable);
    better = sqrt(sum(after .^ 2, 1)) < remaining;
    if ~any(better)
      break;
    end
    for m = 1:numel(names)
      at.(names{m})(better) = moved.(names{m})(better);
    end
    left(:, better) = after(:, better);
    remaining = sqrt(sum(left .^ 2, 1));
  end
  correction = struct();
  for m = 1:numel(names)
    correction.(names{m}) = at.(names{m}) - start.(names{m});
  end
end
";

/// Whether a file of this name can hold a function of this name.
pub(super) fn is_function_name(name: &str) -> bool {
    let starts = name.chars().next().is_some_and(|letter| letter.is_ascii_alphabetic());
    let goes_on = name.chars().all(|letter| letter.is_ascii_alphanumeric() || letter == '_');
    starts && goes_on && name.len() <= 63 && !RESERVED.contains(&name)
}

/// The text of the file, whose function is called as the file is.
pub(crate) fn write(shared: &Shared<'_>, file_name: &str) -> String {
    let names = Names::new(shared.unit.chain, RULES);
    let file = File { shared, names: &names };
    let mut text = comments::matlab(&format!("{}{USE}", shared.preamble()));
    text.push_str(&file.fields());
    text.push_str(&format!("\nfunction evaluators = {file_name}()\n  evaluators = struct();\n"));
    if let Some(errors) = &shared.errors {
        text.push_str("  % No errors.\n");
        for &id in &errors.symbols {
            text.push_str(&format!("  evaluators.no_errors.{} = 0;\n", names.symbol(id)));
        }
    }
    let mut handles = Vec::new();
    for function in &shared.functions {
        let name = form_name(function.form);
        handles.extend([format!("prepare_{name}"), name.to_owned()]);
    }
    let inverse = file.inverse();
    handles.extend((!inverse.is_empty()).then(|| "inverse_correction".to_owned()));
    handles.extend(shared.region.as_ref().map(|_| "in_measured_region".to_owned()));
    if let Some(date) = shared.unit.calibrated.valid_until {
        text.push_str(&format!(
            "  % The last day on which the calibration counts.\n  evaluators.valid_until = '{date}';\n"
        ));
    }
    text.extend(handles.iter().map(|name| format!("  evaluators.{name} = @{name};\n")));
    text.push_str("end\n");
    for function in &shared.functions {
        text.push_str(&file.form(function));
    }
    text + &file.region() + &inverse + SHARED + CALLED
}

/// One file.
struct File<'a> {
    shared: &'a Shared<'a>,
    names: &'a Names,
}

impl File<'_> {
    /// What the fields of each argument and of the results are.
    fn fields(&self) -> String {
        let mut text = String::new();
        for group in self.shared.pose.iter().chain(&self.shared.errors) {
            text.push_str(&format!(
                "%\n{}",
                comments::matlab(&format!("{}: {}", group.argument, group.about))
            ));
            for &id in &group.symbols {
                let about = self.shared.describe(id);
                text.push_str(&comments::matlab(&format!("  {}: {about}", self.names.symbol(id))));
            }
        }
        text.push_str("%\n% What comes out:\n");
        for &id in self.shared.unit.observables {
            let about = self.shared.describe_observable(id);
            text.push_str(&comments::matlab(&format!("  {}: {about}", self.names.observable(id))));
        }
        text
    }

    /// `joints, inputs`
    fn arguments(&self) -> String {
        self.shared.pose.iter().map(|group| group.argument).collect::<Vec<_>>().join(", ")
    }

    /// Refuses fields that are unknown or missing.
    fn check(&self, group: &Group) -> String {
        format!("  trueaxis_check('{0}', {0}, {1});\n", group.argument, self.listed(group))
    }

    /// `{'alpha', 'beta'}`
    fn listed(&self, group: &Group) -> String {
        let names: Vec<String> =
            group.symbols.iter().map(|&id| format!("'{}'", self.names.symbol(id))).collect();
        format!("{{{}}}", names.join(", "))
    }

    fn form(&self, function: &unit::Function) -> String {
        let (form, shared) = (function.form, self.shared);
        let (name, about) = (form_name(form), describe_form(form));
        let lowered = pose(&function.program);
        let matlab = Matlab { chain: shared.unit.chain, names: self.names };
        let prepared = matlab.statements(&lowered.prepared);
        let kept: String = lowered
            .kept
            .iter()
            .enumerate()
            .map(|(place, value)| format!("  p({}) = {};\n", place + 1, matlab.text(value)))
            .collect();
        let count = lowered.kept.len();
        let errors = shared.errors.as_ref();
        let (argument, check) = (
            errors.map_or("", |group| group.argument),
            errors.map_or_else(String::new, |group| self.check(group)),
        );
        let read = self.read(&matlab);
        let evaluated = matlab.statements(&lowered.evaluated);
        let parameters =
            [vec!["p".to_owned()], shared.pose.iter().map(|group| group.argument.to_owned()).collect()];
        let parameters = parameters.concat().join(", ");
        let mut stores = String::new();
        for &id in shared.unit.observables {
            let (observable, shown) = (self.names.observable(id), shared.shown(id));
            let shape = match form.is_jacobian() {
                true => format!("{shown}, {}, poses", shared.columns_of(form)),
                false => format!("{shown}, poses"),
            };
            stores.push_str(&format!("  out.{observable} = zeros({shape});\n"));
        }
        for (place, value) in self.places(form).iter().zip(&lowered.outputs) {
            stores.push_str(&format!("  out.{place} = {};\n", matlab.text(value)));
        }
        format!(
            "
function p = prepare_{name}({argument})
  % Does what {name} needs once for a set of errors.
{check}  p = zeros(1, {count});
{prepared}{kept}end

function out = {name}({parameters})
{}  % `p` is what prepare_{name} returned.
{read}{evaluated}{stores}end
",
            indented(&comments::matlab(about))
        )
    }

    /// The columns of a pose, checked, and how many poses there are.
    fn read(&self, matlab: &Matlab<'_>) -> String {
        let mut text: String = self.shared.pose.iter().map(|group| self.check(group)).collect();
        for group in &self.shared.pose {
            for &id in &group.symbols {
                let (column, name) = (matlab.symbol(id), self.names.symbol(id));
                text.push_str(&format!("  {column} = reshape({}.{name}, 1, []);\n", group.argument));
            }
        }
        let columns = self.shared.pose_symbols().map(|id| matlab.symbol(id)).collect::<Vec<_>>().join(", ");
        text + &format!("  poses = trueaxis_poses({{{columns}}});\n")
    }

    /// Whether poses lie in the measured region.
    fn region(&self) -> String {
        let Some(program) = &self.shared.region else { return String::new() };
        let lowered = pose(program);
        let matlab = Matlab { chain: self.shared.unit.chain, names: self.names };
        let (read, evaluated) = (self.read(&matlab), matlab.statements(&lowered.evaluated));
        let inside = lowered.outputs.iter().map(|value| matlab.text(value)).collect::<String>();
        format!(
            "
function inside = in_measured_region({})
{}{read}{evaluated}  inside = ({inside}) + zeros(1, poses) > 0.5;
end
",
            self.arguments(),
            indented(&comments::matlab(OF_REGION))
        )
    }

    /// Where each output goes: `pointing(1, :)`, of a Jacobian `pointing(1, 2, :)`.
    fn places(&self, form: Form) -> Vec<String> {
        let columns = self.shared.columns_of(form);
        let place = |id, component: usize, column: usize| {
            let observable = self.names.observable(id);
            match form.is_jacobian() {
                true => format!("{observable}({}, {}, :)", component + 1, column + 1),
                false => format!("{observable}({}, :)", component + 1),
            }
        };
        let observables = self.shared.unit.observables.iter();
        observables
            .flat_map(|&id| (0..self.shared.shown(id)).map(move |component| (id, component)))
            .flat_map(|(id, component)| (0..columns).map(move |column| place(id, component, column)))
            .collect()
    }

    /// The joint readings that make up for the errors.
    fn inverse(&self) -> String {
        let Some(joints) = self.shared.joints_to_correct() else { return String::new() };
        let observables: Vec<String> =
            self.shared.with_inverse().map(|id| format!("'{}'", self.names.observable(id))).collect();
        if observables.is_empty() {
            return String::new();
        }
        let (pose, named) = (self.arguments(), observables.join(", "));
        let body = INVERSE.replace("POSE", &pose).replace("MOVED", &pose.replacen("joints", "moved", 1));
        format!(
            "
function [correction, remaining] = inverse_correction(observable, value, without, {pose})
  % What to add to the joint readings so that an observable with the errors is what it is at these readings without them;
  % and the distance that remains: more than rounding where no readings do that.
  % `value` is what prepare_exact_value returned, `without` what prepare_exact_error did.
  if ~any(strcmp(observable, {{{named}}}))
    error('trueaxis:observable', 'the observable is one of %s', strjoin({{{named}}}, ', '));
  end
  names = {};{body}",
            self.listed(joints)
        )
    }
}

/// Two spaces before each line.
fn indented(text: &str) -> String {
    text.lines().map(|line| format!("  {line}\n")).collect()
}

/// How MATLAB writes a program. Names of a declaration are names of fields alone, and no variable's.
struct Matlab<'a> {
    chain: &'a Chain,
    names: &'a Names,
}

impl Notation for Matlab<'_> {
    fn symbol(&self, id: SymbolId) -> String {
        match self.chain.symbol(id).kind {
            SymbolKind::Ramp | SymbolKind::SightAngle => {
                unreachable!("a ramp or an angle of sight is computed from what is read")
            }
            SymbolKind::Error => format!("errors.{}", self.names.symbol(id)),
            SymbolKind::Joint | SymbolKind::Input => format!("q{}", id.index()),
            SymbolKind::Pi | SymbolKind::Constant => self.number(super::declared(self.chain, id)),
        }
    }

    fn product(&self, a: &str, b: &str) -> String {
        format!("{a} .* {b}")
    }

    fn quotient(&self, a: &str, b: &str) -> String {
        format!("{a} ./ {b}")
    }

    fn call(&self, function: Function, a: &str) -> String {
        match function {
            Function::Saturate => format!("trueaxis_saturate({a})"),
            Function::Step => format!("trueaxis_step({a})"),
            Function::Root => format!("trueaxis_root({a})"),
        }
    }

    fn arc_tangent(&self, y: &str, x: &str) -> String {
        format!("atan2({y}, {x})")
    }

    fn name(&self, name: Name) -> String {
        match name {
            Name::Kept(place) => format!("p({})", place + 1),
            Name::Wave(wave, Angle::Symbol(id)) => {
                let wave = if wave == Wave::Sine { "sin" } else { "cos" };
                format!("{wave}_{}", id.index())
            }
            other => Scope::Pose.name(other, self.names),
        }
    }
}

impl Matlab<'_> {
    fn statements(&self, statements: &[Statement]) -> String {
        let mut text = String::new();
        for statement in statements {
            match statement {
                Statement::Let(name, value) => {
                    text.push_str(&format!("  {} = {};\n", self.name(*name), self.text(value)));
                }
                Statement::SinCos { angle, sine, cosine } => {
                    for (function, name) in [("sin", sine), ("cos", cosine)] {
                        if let Some(name) = name {
                            let (name, angle) = (self.name(*name), self.text(angle));
                            text.push_str(&format!("  {name} = {function}({angle});\n"));
                        }
                    }
                }
                Statement::Angles(_)
                | Statement::SinCosOfRows(_)
                | Statement::EachRow(_)
                | Statement::Store(..) => unreachable!("MATLAB is written from what is done for one pose"),
            }
        }
        text
    }
}

/// Words of MATLAB and Octave that a name in a declaration may be.
#[rustfmt::skip]
const RESERVED: [&str; 45] = [
    "break", "case", "catch", "classdef", "continue", "do", "else", "elseif", "end", "end_try_catch",
    "end_unwind_protect", "endclassdef", "endenumeration", "endevents", "endfor", "endfunction", "endif",
    "endmethods", "endparfor", "endproperties", "endspmd", "endswitch", "endwhile", "enumeration", "events", "for",
    "function", "global", "if", "methods", "otherwise", "parfor", "persistent", "properties", "return", "spmd",
    "static", "switch", "try", "until", "unwind_protect", "unwind_protect_cleanup", "while", "varargin", "varargout",
];
