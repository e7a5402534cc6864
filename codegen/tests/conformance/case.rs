//! One chain of the suite: its generated files, its poses, and what the interpreter says.

use codegen::{File, Form, Interpreter, Language, Program, Unit, build, generate};
use model_core::{Chain, ObservableId, SymbolId, SymbolKind};

use crate::support::{CHAINS, errors, pose, random, read};

pub const FORMS: [(Form, &str); 5] = [
    (Form::ExactValue, "exact_value"),
    (Form::ExactError, "exact_error"),
    (Form::FirstOrderError, "first_order_error"),
    (Form::ExactJacobian, "exact_jacobian"),
    (Form::FirstOrderJacobian, "first_order_jacobian"),
];

/// Poses of a batch: more than a block, and a rest.
pub const ROWS: usize = 70;
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
    /// What generated code calls joints: joints, and the inputs that are read.
    pub joints: Vec<SymbolId>,
    /// All with the same errors.
    pub poses: Vec<Vec<f64>>,
}

impl Case {
    pub fn all() -> Vec<Self> {
        CHAINS.into_iter().map(|(name, text)| Self::new(name, text)).collect()
    }

    fn new(name: &'static str, text: &'static str) -> Self {
        let chain = read(name, text);
        let observables: Vec<ObservableId> =
            (0..u16::try_from(chain.observables.len()).unwrap()).map(ObservableId).collect();
        let mut random = random(8);
        let first = pose(&chain, &mut random, 1e-3);
        let moves = |id: &SymbolId| matches!(chain.symbol(*id).kind, SymbolKind::Joint | SymbolKind::Input);
        let symbols = || (0..u16::try_from(chain.symbols.len()).unwrap()).map(SymbolId);
        let poses = (0..ROWS)
            .map(|_| {
                let moved = pose(&chain, &mut random, 0.0);
                symbols().map(|id| if moves(&id) { moved[id.index()] } else { first[id.index()] }).collect()
            })
            .collect();
        let is_read = |id: &SymbolId| {
            FORMS.iter().any(|&(form, _)| {
                build(&chain, &observables, form, &errors(&chain)).inputs().iter().any(|(read, _)| read == id)
            })
        };
        let is_joint = |id: &SymbolId| chain.symbol(*id).kind == SymbolKind::Joint;
        let joints = symbols().filter(|id| is_joint(id) || (moves(id) && is_read(id))).collect();
        Self { name, text, observables, joints, poses, chain }
    }

    pub fn generate(&self, language: Language) -> Vec<File> {
        let unit = Unit {
            chain: &self.chain,
            declaration: self.text,
            observables: &self.observables,
            forms: &FORMS.map(|(form, _)| form),
            remainders: &[],
        };
        generate(&unit, language, self.name)
    }

    pub fn errors(&self) -> Vec<SymbolId> {
        errors(&self.chain)
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
            let per_observable = (program.outputs().len() / self.observables.len()).max(1);
            let scale = |output: usize| {
                let start = output / per_observable * per_observable;
                let outputs = expected.iter().flat_map(|out| &out[start..start + per_observable]);
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
