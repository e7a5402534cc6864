//! One chain of the suite: its generated files, its poses, and what the interpreter says.

use codegen::{File, Form, Interpreter, Language, NodeId, Op, Program, Stage, Unit, build, generate};
use model_core::{Chain, ObservableId, SymbolId, SymbolKind};

use crate::support::{CHAINS, READINGS, SIGHT, errors, pose, random, read};

pub const FORMS: [(Form, &str); 5] = [
    (Form::ExactValue, "exact_value"),
    (Form::ExactError, "exact_error"),
    (Form::FirstOrderError, "first_order_error"),
    (Form::ExactJacobian, "exact_jacobian"),
    (Form::FirstOrderJacobian, "first_order_jacobian"),
];

/// Poses of a batch: more than a block, and a rest.
pub const ROWS: usize = 70;
/// The row whose angles are beyond the reach of the fast reduction, in the last block.
const WIDE: usize = 69;
/// The rows of a batch that are computed one by one too.
pub const SINGLE: usize = 4;
/// The rows of a batch that are compared.
pub const COMPARED: [usize; 5] = [0, 1, 63, 64, 69];

/// Generated code may differ from the interpreter by this many units in the last place of the result's scale, where
/// its arithmetic differs.
const ULPS: f64 = 4.0;

pub struct Case {
    pub name: &'static str,
    pub text: &'static str,
    pub chain: Chain,
    pub observables: Vec<ObservableId>,
    /// The arguments of a pose, `joints` and `inputs`, with what each holds: joints, and the inputs that are read.
    pub pose: Vec<(&'static str, Vec<SymbolId>)>,
    /// All with the same errors.
    pub poses: Vec<Vec<f64>>,
}

impl Case {
    pub fn all() -> Vec<Self> {
        CHAINS.into_iter().chain([READINGS, SIGHT]).map(|(name, text)| Self::new(name, text)).collect()
    }

    /// How many numbers all observables show together.
    pub fn shown(&self) -> usize {
        self.chain.observables.iter().map(|observable| observable.shown.len()).sum()
    }

    fn new(name: &'static str, text: &'static str) -> Self {
        let chain = read(name, text);
        let observables: Vec<ObservableId> =
            (0..u16::try_from(chain.observables.len()).unwrap()).map(ObservableId).collect();
        let mut random = random(8);
        let first = pose(&chain, &mut random, 1e-3);
        let moves = |id: &SymbolId| matches!(chain.symbol(*id).kind, SymbolKind::Joint | SymbolKind::Input);
        let symbols = || (0..u16::try_from(chain.symbols.len()).unwrap()).map(SymbolId);
        let programs = FORMS.map(|(form, _)| build(&chain, &observables, form, &errors(&chain)));
        let is_joint = |id: &SymbolId| chain.symbol(*id).kind == SymbolKind::Joint;
        let takes_any_angle = programs.iter().all(|program| angles_are_joints(program, &is_joint));
        let poses = (0..ROWS)
            .map(|row| {
                let mut moved = pose(&chain, &mut random, 0.0);
                if row == WIDE && takes_any_angle {
                    symbols().filter(is_joint).for_each(|id| moved[id.index()] *= 1e20);
                }
                symbols().map(|id| if moves(&id) { moved[id.index()] } else { first[id.index()] }).collect()
            })
            .collect();
        let is_read = |id: &SymbolId| {
            programs.iter().any(|program| program.inputs().iter().any(|(read, _)| read == id))
        };
        let joints = symbols().filter(is_joint).collect::<Vec<_>>();
        let inputs = symbols().filter(|id| !is_joint(id) && moves(id) && is_read(id)).collect::<Vec<_>>();
        let mut pose = vec![("joints", joints), ("inputs", inputs)];
        pose.retain(|(_, symbols)| !symbols.is_empty());
        Self { name, text, observables, pose, poses, chain }
    }

    pub fn generate(&self, language: Language) -> Vec<File> {
        let forms = FORMS.map(|(form, _)| form);
        let unit = Unit::new(&self.chain, self.text, &self.observables, &forms);
        generate(&unit, language, self.name).unwrap()
    }

    pub fn errors(&self) -> Vec<SymbolId> {
        errors(&self.chain)
    }

    /// Something of each argument of a pose.
    pub fn of_pose(&self, of: &dyn Fn(&str, &[SymbolId]) -> String) -> String {
        self.pose.iter().map(|(argument, symbols)| of(argument, symbols)).collect::<Vec<_>>().join(", ")
    }

    /// The symbols of a pose.
    pub fn pose_symbols(&self) -> impl Iterator<Item = SymbolId> {
        self.pose.iter().flat_map(|(_, symbols)| symbols.iter().copied())
    }

    pub fn symbol_name(&self, id: SymbolId) -> &str {
        &self.chain.symbol(id).name
    }

    /// Values of symbols in the poses, as literals that every language reads exactly.
    pub fn column(&self, id: SymbolId) -> Vec<String> {
        self.poses.iter().map(|pose| format!("{:?}", pose[id.index()])).collect()
    }

    fn program(&self, form: Form) -> Program {
        build(&self.chain, &self.observables, form, &self.errors())
    }

    /// Takes what a driver prints of this chain: form by form, the single poses, then the rows of the batch.
    pub fn compare(&self, printed: &mut impl Iterator<Item = f64>, one_pose_is_exact: bool) {
        for (form, form_name) in FORMS {
            let program = self.program(form);
            let mut interpreter = Interpreter::new(&program);
            let expected: Vec<Vec<f64>> = self
                .poses
                .iter()
                .map(|pose| {
                    let mut out = vec![0.0; program.outputs().len()];
                    interpreter.eval(pose, &mut out).unwrap();
                    out
                })
                .collect();
            // One scale for each observable: its largest output.
            let columns = if form.is_jacobian() { self.errors().len() } else { 1 };
            let starts: Vec<usize> = std::iter::once(0)
                .chain(self.chain.observables.iter().scan(0, |end, observable| {
                    *end += observable.shown.len() * columns;
                    Some(*end)
                }))
                .collect();
            let scale = |output: usize| {
                let own = starts.windows(2).find(|ends| output < ends[1]).unwrap();
                let outputs = expected.iter().flat_map(|out| &out[own[0]..own[1]]);
                outputs.fold(0.0_f64, |scale, value| scale.max(value.abs()))
            };
            let scales: Vec<f64> = (0..program.outputs().len()).map(scale).collect();
            let mut check = |row: usize, is_exact: bool, what: &str| {
                for (output, expected) in expected[row].iter().enumerate() {
                    let found = printed.next().unwrap();
                    let tolerance = if is_exact { 0.0 } else { ULPS * f64::EPSILON * scales[output] };
                    assert!(
                        (found - expected).abs() <= tolerance,
                        "{}, {form_name}, {what} {row}, output {output}: {found:?} is not {expected:?}: {} ulp",
                        self.name,
                        (found - expected).abs() / (f64::EPSILON * scales[output])
                    );
                }
            };
            for row in 0..SINGLE {
                check(row, one_pose_is_exact, "pose");
            }
            for row in COMPARED {
                check(row, false, "row");
            }
        }
    }
}

/// Whether joints are read by sines and cosines alone, and these read nothing else.
fn angles_are_joints(program: &Program, is_joint: &dyn Fn(&SymbolId) -> bool) -> bool {
    let reads_joint = |node: NodeId| matches!(program.nodes()[node.index()], Op::Input(id) if is_joint(&id));
    program.stage(Stage::Evaluated).all(|(_, op)| match op {
        Op::Sin(angle) | Op::Cos(angle) => reads_joint(angle),
        _ => !op.operands().any(reads_joint),
    })
}
