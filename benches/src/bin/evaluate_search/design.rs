//! The instrument of the evaluation at simulated poses: readings, catalogue, and the linear problem of a search.

use std::error::Error;
use std::f64::consts::TAU;

use calibration::search::columns::{Columns, places};
use calibration::search::{ConfoundedSet, Problem, SetId, confounded_sets};
use effects::candidate::{Effect, EffectId};
use effects::catalogue::catalogue;
use faer::Mat;
use model_core::{Chain, SymbolId, exact};
use nalgebra::Vector3;
use observe::{Measure, Measured, Observations, Series, tangent_frame};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use study::{Plan, Study};

/// The instrument.
pub const TEXT: &str = include_str!("../../../../examples/mobile-lidar/mobile-lidar.chain");

/// σ of the simulated noise.
pub const SIGMA_RAD: f64 = 2.0 * TAU / 360.0 / 3600.0;

/// Anything that goes wrong.
pub type Failure = Box<dyn Error + Send + Sync>;

/// The side quantities measured beside the joints.
const INPUTS: [(&str, &str); 3] = [
    ("temperature", "temperature"),
    ("alpha_direction", "direction of alpha"),
    ("beta_direction", "direction of beta"),
];

/// How the poses follow each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Poses {
    /// Uniform over this share of the full turn, in no order.
    Random(f64),
    /// All joints turn at steady, incommensurate speeds; rows are in order of acquisition.
    Trajectory,
}

/// The instrument at some poses.
pub struct Design {
    pub plan: Plan,
    pub catalogue: Vec<Effect>,
    /// Readings; what was measured is what the instrument without errors would show.
    pub readings: Observations,
    /// Declared columns and candidates at unit noise, without a residual.
    pub problem: Problem,
    pub sets: Vec<ConfoundedSet>,
}

/// The study of the evaluation.
fn plan(sequence: bool) -> Result<Plan, Failure> {
    let columns: Vec<String> = INPUTS
        .iter()
        .map(|(name, meaning)| format!("{name} = {{ column = \"{name}\", meaning = \"{meaning}\" }}"))
        .collect();
    let inputs = INPUTS.map(|(name, _)| name);
    let study = format!(
        "chain = \"c\"\nobservable = \"pointing\"\ndata = \"d\"\n[columns]\n{}\n[observed]\nkind = \"direction\"\n\
         [search]\ninputs = {inputs:?}\nsequence = {sequence}\n",
        columns.join("\n")
    );
    let chain = Chain::from_text(TEXT).map_err(|mistakes| mistakes.render("mobile-lidar.chain", TEXT))?;
    Ok(Study::from_text(&study)?.plan(&chain)?)
}

impl Design {
    /// Simulates readings and sets the problem up.
    pub fn new(rows: usize, poses: Poses, seed: u64) -> Result<Self, Failure> {
        let plan = plan(poses == Poses::Trajectory)?;
        let readings = readings(&plan, rows, poses, seed)?;
        let observables = [plan.chain.find_observable("pointing").ok_or("no pointing")?];
        let setting = plan.search.setting(&plan.chain, &observables);
        let catalogue = catalogue(&setting);
        let values = plan.chain.nominal_values();
        let columns = Columns::at(&plan.chain, &readings, &plan.fit.estimate, &values, &places(&catalogue))?;
        let effects = columns.of_effects(&plan.chain, &catalogue, &readings.poses, &values);
        let all: Vec<&Vec<f64>> = effects.iter().flatten().collect();
        let n = columns.residual.len();
        let candidates = Mat::from_fn(n, all.len(), |i, j| all[j][i] / SIGMA_RAD);
        let mut blocks = Vec::new();
        let mut start = 0;
        for effect in &effects {
            blocks.push(start..start + effect.len());
            start += effect.len();
        }
        let declared = Mat::from_fn(n, columns.declared.ncols(), |i, j| columns.declared[(i, j)] / SIGMA_RAD);
        let hold_out = &plan.hold_out;
        let problem = Problem::new(
            declared.as_ref(),
            candidates.as_ref(),
            &blocks,
            &vec![0.0; n],
            &columns.row,
            hold_out.folds,
            hold_out.seed,
        )?;
        let sets = confounded_sets(&problem);
        Ok(Self { plan, catalogue, readings, problem, sets })
    }

    /// The readings of a joint or input.
    pub fn readings_of(&self, name: &str) -> &[f64] {
        self.plan.chain.find_symbol(name).and_then(|id| self.readings.poses.column(id)).unwrap_or_default()
    }

    /// A confounded set and a member of it, drawn evenly from all candidates that these poses show.
    pub fn draw(&self, random: &mut ChaCha8Rng) -> (SetId, EffectId) {
        let visible: Vec<(SetId, EffectId)> = (0..self.sets.len())
            .map(SetId)
            .flat_map(|set| self.sets[set].members.iter().map(move |&member| (set, member)))
            .collect();
        visible[random.random_range(0..visible.len())]
    }

    /// Coefficients (in units of the functions, times σ) of a candidate in a random direction, of the size that gives
    /// its projected effect an RMS of `snr` σ a component; with the projected effect in σ.
    pub fn amplitudes(&self, candidate: EffectId, snr: f64, random: &mut ChaCha8Rng) -> (Vec<f64>, Vec<f64>) {
        let rows = self.problem.rows();
        let block = self.problem.block(candidate);
        let mut coefficients = vec![0.0; block.len()];
        let mut effect = vec![0.0; rows.nrows()];
        for column in self.problem.columns(candidate) {
            let drawn: f64 = StandardNormal.sample(random);
            coefficients[column - block.start] = drawn / self.problem.length(column);
            effect.iter_mut().zip(rows.col(column).iter()).for_each(|(e, z)| *e += drawn * z);
        }
        let rms = rms(&effect);
        let scale = if rms > 0.0 { snr / rms } else { 0.0 };
        coefficients.iter_mut().for_each(|c| *c *= scale);
        effect.iter_mut().for_each(|e| *e *= scale);
        (coefficients, effect)
    }

    /// Observations of a chain with some values of its symbols, with noise in σ. `bent` may change the readings that the
    /// instrument truly has (its joints are not where they say).
    pub fn observe(
        &self,
        readings: &Observations,
        chain: &Chain,
        mut values: Vec<f64>,
        noise: &[[f64; 2]],
        bent: impl Fn(SymbolId, f64) -> f64,
    ) -> Observations {
        let path = exact::Path::new(chain, readings.poses.series[0].observable);
        let measured = noise
            .iter()
            .enumerate()
            .map(|(row, noise)| {
                for (id, column) in &readings.poses.columns {
                    values[id.index()] = bent(*id, column[row]);
                }
                let aim = path.value(&values).normalize();
                let [across, along] = tangent_frame(&aim);
                let moved: Vector3<f64> = aim + SIGMA_RAD * (across * noise[0] + along * noise[1]);
                Measured::Direction(moved.normalize())
            })
            .collect();
        Observations { measured, ..readings.clone() }
    }

    /// The readings with more poses after them, inputs as in the first row.
    pub fn and(&self, joints: &[String], poses: &[Vec<f64>]) -> Observations {
        let mut more = self.readings.clone();
        let rows = more.rows() + poses.len();
        for (id, column) in &mut more.poses.columns {
            let name = &self.plan.chain.symbol(*id).name;
            let at = joints.iter().position(|joint| joint == name);
            let first = column.first().copied().unwrap_or_default();
            column.extend(poses.iter().map(|pose| at.and_then(|at| pose.get(at)).copied().unwrap_or(first)));
        }
        more.measured.resize(rows, Measured::Direction(Vector3::z()));
        more.groups = (0..).take(rows).collect();
        more.row_numbers = (1..).take(rows).collect();
        more.poses.series[0].rows = 0..rows;
        more
    }

    /// What joints that are not where they say do to the residual components, in σ.
    pub fn change(&self, bent: impl Fn(SymbolId, f64) -> f64) -> Vec<f64> {
        let still = vec![[0.0; 2]; self.readings.rows()];
        let chain = &self.plan.chain;
        let moved = self.observe(&self.readings, chain, chain.nominal_values(), &still, bent);
        let pairs = self.readings.measured.iter().zip(&moved.measured);
        pairs
            .flat_map(|(from, to)| {
                let (Some(from), Some(to)) = (from.vector(), to.vector()) else {
                    unreachable!("both are directions")
                };
                tangent_frame(from).map(|axis| axis.dot(to) / SIGMA_RAD)
            })
            .collect()
    }
}

/// Root mean square.
pub fn rms(values: &[f64]) -> f64 {
    (values.iter().map(|v| v * v).sum::<f64>() / values.len().max(1) as f64).sqrt()
}

fn readings(plan: &Plan, rows: usize, poses: Poses, seed: u64) -> Result<Observations, Failure> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let symbol = |name: &str| plan.chain.find_symbol(name).ok_or(format!("no {name}"));
    let mut columns: Vec<(SymbolId, Vec<f64>)> = Vec::new();
    let mut turns = 0.0;
    for name in ["alpha", "beta", "gamma"] {
        turns += 2.7;
        let column = (0..rows).map(|row| match poses {
            Poses::Random(share) => share * random.random_range(-TAU / 2.0..TAU / 2.0),
            Poses::Trajectory => {
                let turned = (turns + f64::sqrt(turns)) * TAU * row as f64 / rows as f64;
                (turned + TAU / 2.0).rem_euclid(TAU) - TAU / 2.0
            }
        });
        columns.push((symbol(name)?, column.collect()));
    }
    for (name, _) in INPUTS {
        let column = (0..rows).map(|_| match name {
            "temperature" => random.random_range(10.0..30.0),
            _ => f64::from(random.random_range(0..2)) * 2.0 - 1.0,
        });
        columns.push((symbol(name)?, column.collect()));
    }
    columns.sort_by_key(|(id, _)| *id);
    let observable = plan.chain.find_observable("pointing").ok_or("no pointing")?;
    let mut readings = Observations {
        poses: observe::Poses {
            series: vec![Series {
                observable,
                measure: Measure::Direction,
                rows: 0..rows,
                source: "simulated".to_owned(),
            }],
            columns,
        },
        groups: (0..).take(rows).collect(),
        row_numbers: (1..).take(rows).collect(),
        in_sequence: poses == Poses::Trajectory,
        ..Observations::default()
    };
    let mut values = plan.chain.nominal_values();
    let path = exact::Path::new(&plan.chain, observable);
    for row in 0..rows {
        for (id, column) in &readings.poses.columns {
            values[id.index()] = column[row];
        }
        readings.measured.push(Measured::Direction(path.value(&values).normalize()));
    }
    Ok(readings)
}
