//! A data set with a secret: drawn by chance, and drawn anew until its secret can be found and its answer is beyond doubt.

use rand::{Rng, RngExt as _};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;

use crate::cause::{Addition, Cause};
use crate::design::Design;
use crate::instrument::Instrument;
use crate::instruments::INSTRUMENTS;
use crate::level::Level;
use crate::misread::{Reading, Row};
use crate::model::Model;
use crate::policy::{
    ARCSEC_RAD, ATTEMPTS, DECLARED_ARCSEC, Difficulty, EXCLUDED, LARGEST_IS, LEAST_PREDICTION_ARCSEC,
    LEAST_SIGNATURE, POSSIBLE, SIZE_KNOWN_TO, UNSEEN_ROWS,
};
use crate::readings::{Pose, drawn, rounded};
use crate::seed::{Purpose, Seed};

/// A number that is asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Asked {
    /// What is true, arc seconds.
    pub truth_arcsec: f64,
    /// The standard uncertainty of whoever knows all causes, arc seconds.
    pub uncertainty_arcsec: f64,
}

/// Something that the instrument does and its declaration lacks.
#[derive(Debug, Clone, PartialEq)]
pub struct Effect {
    /// The true cause.
    pub cause: Cause,
    /// The errors that it adds, rad or rad/K, in the order of its terms.
    pub coefficients: Vec<f64>,
    /// Every cause of the sheet that these data cannot exclude, the true one among them, in the order of the sheet.
    pub possible: Vec<Cause>,
    /// Half the difference between its largest and its smallest amount over the rows, arc seconds.
    pub size_arcsec: f64,
    /// What it does to the measured x, y and z of each row, to first order, in standard deviations of the noise.
    pub signature: Vec<f64>,
}

/// A data set with its secret.
#[derive(Debug, Clone)]
pub struct Task {
    /// Its level.
    pub level: Level,
    /// The instrument.
    pub instrument: Instrument,
    /// The declared errors with their values, rad.
    pub declared: Vec<(String, f64)>,
    /// What the declaration lacks.
    pub effects: Vec<Effect>,
    /// How the file must be read.
    pub reading: Reading,
    /// The rows as the file has them.
    pub rows: Vec<Row>,
    /// The same, read rightly: poses alone.
    pub poses: Vec<Pose>,
    /// The pose of the prediction that is asked for.
    pub asked_pose: Pose,
    /// The declared error that is asked for.
    pub asked_error: &'static str,
    /// The size of the largest effect that follows a joint; the declared error; z of the error of the pointing at the asked pose.
    pub numbers: [Asked; 3],
    /// Poses that only the teacher has, and where the instrument points there.
    pub unseen: Vec<Row>,
}

/// No data set of a level could be solved: an instrument or a level is set wrongly.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("of {ATTEMPTS} data sets of level {level} none could be solved; take another seed")]
pub struct Unsolvable {
    level: u8,
}

/// What all attempts at one data set share: an instrument, poses, and what each cause would do there.
struct Ground {
    instrument: Instrument,
    difficulty: Difficulty,
    poses: Vec<Pose>,
    declared: Vec<String>,
    /// Of each declared error, in standard deviations of the noise.
    declared_columns: Vec<Vec<f64>>,
    /// Of each cause, of each of its errors, in the order of [`Cause::ALL`].
    cause_columns: Vec<Vec<Vec<f64>>>,
}

impl Task {
    /// The data set of a seed.
    ///
    /// # Errors
    /// No data set could be solved.
    pub fn draw(seed: &Seed, level: Level) -> Result<Self, Unsolvable> {
        let mut chance = seed.random(Purpose::Secret);
        let instrument = *of(&INSTRUMENTS, &mut chance);
        let difficulty = level.difficulty();
        let poses = drawn(&instrument, difficulty.rows, &mut seed.random(Purpose::Poses));
        let ground = Ground::new(instrument, difficulty, poses);
        for _ in 0..ATTEMPTS {
            if let Some(secret) = ground.attempt(&mut chance) {
                return Ok(ground.measured(level, secret, seed));
            }
        }
        Err(Unsolvable { level: level.into() })
    }

    /// The standard deviation of the noise in each of two directions, rad.
    #[must_use]
    pub fn noise_rad(&self) -> f64 {
        self.level.difficulty().noise_arcsec * ARCSEC_RAD
    }
}

/// A secret that can be found.
struct Secret {
    declared: Vec<f64>,
    effects: Vec<Effect>,
    reading: Reading,
    asked_error: usize,
    asked_pose: Pose,
    size: Asked,
}

impl Ground {
    fn new(instrument: Instrument, difficulty: Difficulty, poses: Vec<Pose>) -> Self {
        let sigma = difficulty.noise_arcsec * ARCSEC_RAD;
        let all = model(&instrument, Cause::ALL);
        let whitened = |names: &[String]| {
            let ids: Vec<_> = names.iter().map(|name| symbol(&all, name)).collect();
            let mut columns = all.columns(&instrument, &poses, &ids);
            columns.iter_mut().flatten().for_each(|number| *number /= sigma);
            columns
        };
        let bare = model(&instrument, []);
        let declared: Vec<String> =
            bare.errors().iter().map(|&id| bare.chain.symbol(id).name.clone()).collect();
        let cause_columns = Cause::ALL.map(|cause| whitened(&parameters(cause, &instrument))).into();
        let declared_columns = whitened(&declared);
        Self { instrument, difficulty, poses, declared, declared_columns, cause_columns }
    }

    fn columns_of(&self, cause: Cause) -> &[Vec<f64>] {
        &self.cause_columns[cause as usize]
    }

    /// A secret, unless chance made one that cannot be found or has a doubtful answer.
    fn attempt(&self, chance: &mut ChaCha8Rng) -> Option<Secret> {
        let largest = DECLARED_ARCSEC * ARCSEC_RAD;
        let declared: Vec<f64> =
            self.declared.iter().map(|_| chance.random_range(-largest..largest)).collect();
        let (causes, reading) = self.causes(chance);
        let mut effects: Vec<Effect> = causes.iter().map(|&cause| self.effect(cause, chance)).collect();
        for at in 0..effects.len() {
            effects[at].possible = self.possible(&effects, at)?;
        }
        let confounded = effects.iter().filter(|effect| effect.possible.len() > 1).count();
        if confounded != usize::from(self.difficulty.is_confounded) {
            return None;
        }
        let size = self.size(&effects)?;
        let pose = *drawn(&self.instrument, 1, chance).first()?;
        let joints_deg = pose.joints_deg.map(|angle| rounded(angle, 0));
        let asked_pose = Pose { joints_deg, temperature: 15.0, set_up: 1 };
        let asked_error = usize::from(chance.random::<bool>());
        Some(Secret { declared, effects, reading, asked_error, asked_pose, size })
            .filter(|secret| self.asked(secret)[2].truth_arcsec.abs() >= LEAST_PREDICTION_ARCSEC)
    }

    /// Causes of chance, as many as the level asks for, and how the file must be read.
    fn causes(&self, chance: &mut ChaCha8Rng) -> (Vec<Cause>, Reading) {
        let mut causes: Vec<Cause> = Vec::new();
        while causes.len() < self.difficulty.effects {
            let cause = *of(&Cause::ALL, chance);
            if !cause.is_of_set_ups() && !causes.contains(&cause) {
                causes.push(cause);
            }
        }
        if !self.difficulty.is_disturbed {
            return (causes, Reading::AsLabelled);
        }
        if chance.random::<bool>() {
            return (causes, *of(&Reading::ALL[1..], chance));
        }
        causes.push(*of(&[Cause::LevelledAnew, Cause::ZeroedAnew], chance));
        (causes, Reading::AsLabelled)
    }

    /// Every cause that the data allow for one effect beside the others; none where the effect cannot be found, or where chance could
    /// decide about a cause.
    fn possible(&self, effects: &[Effect], at: usize) -> Option<Vec<Cause>> {
        let own = &effects[at];
        let is_other =
            |cause: Cause| cause != own.cause && effects.iter().any(|effect| effect.cause == cause);
        let others = effects.iter().filter(|effect| effect.cause != own.cause);
        let beside: Vec<&Vec<f64>> = self
            .declared_columns
            .iter()
            .chain(others.flat_map(|effect| self.columns_of(effect.cause)))
            .collect();
        if Design::new(beside.iter().copied()).left_of(&own.signature) < LEAST_SIGNATURE {
            return None;
        }
        let mut possible = Vec::new();
        for cause in Cause::ALL.into_iter().filter(|&cause| !is_other(cause)) {
            let design = Design::new(beside.iter().copied().chain(self.columns_of(cause)));
            match design.left_of(&own.signature) {
                left if left <= POSSIBLE => possible.push(cause),
                left if left < EXCLUDED => return None,
                _ => {}
            }
        }
        Some(possible)
    }

    /// An effect of chance of a cause.
    fn effect(&self, cause: Cause, chance: &mut ChaCha8Rng) -> Effect {
        let [low, high] = self.difficulty.amplitude_arcsec;
        let amplitude = chance.random_range(low..high) * ARCSEC_RAD;
        let phase: f64 = chance.random_range(0.0..std::f64::consts::TAU);
        let sign = if phase.sin() < 0.0 { -1.0 } else { 1.0 };
        let coefficients = match cause {
            // Down, whatever chance says.
            Cause::Gravity => vec![-self.instrument.raises * amplitude],
            // Over a range of about 20 K.
            Cause::Temperature => vec![sign * amplitude / 10.0],
            // Between two set-ups, whose mean the declared errors take.
            Cause::ZeroedAnew => vec![2.0 * sign * amplitude],
            _ => vec![amplitude * phase.cos(), amplitude * phase.sin()],
        };
        let mut signature = vec![0.0; 3 * self.poses.len()];
        for (column, coefficient) in self.columns_of(cause).iter().zip(&coefficients) {
            signature.iter_mut().zip(column).for_each(|(sum, derivative)| *sum += coefficient * derivative);
        }
        let weights = self.half_range(cause, &coefficients);
        let size: f64 = weights.iter().zip(&coefficients).map(|(weight, own)| weight * own).sum();
        Effect { cause, coefficients, possible: Vec::new(), size_arcsec: size / ARCSEC_RAD, signature }
    }

    /// By what each coefficient counts in half the difference between the largest and the smallest amount. Of a cause with several
    /// factors, of the first.
    fn half_range(&self, cause: Cause, coefficients: &[f64]) -> Vec<f64> {
        let additions = cause.additions(&self.instrument);
        let terms = additions.first().map_or(&[][..], |addition: &Addition| &addition.terms);
        let functions = |pose: &Pose| terms.iter().map(|(_, function)| function.value(pose)).collect();
        let rows: Vec<Vec<f64>> = self.poses.iter().map(functions).collect();
        let amount = |own: &[f64]| own.iter().zip(coefficients).map(|(f, c)| f * c).sum::<f64>();
        let compare = |a: &&Vec<f64>, b: &&Vec<f64>| amount(a).total_cmp(&amount(b));
        let mut weights = vec![0.0; coefficients.len()];
        if let (Some(most), Some(least)) = (rows.iter().max_by(compare), rows.iter().min_by(compare)) {
            let halves = most.iter().zip(least).map(|(most, least)| (most - least) / 2.0);
            weights.iter_mut().zip(halves).for_each(|(weight, half)| *weight = half);
        }
        weights
    }

    /// The size that is asked for, if it is beyond doubt which and how large.
    fn size(&self, effects: &[Effect]) -> Option<Asked> {
        let mut sized: Vec<&Effect> =
            effects.iter().filter(|effect| effect.cause.follows_a_joint()).collect();
        sized.sort_by(|a, b| b.size_arcsec.total_cmp(&a.size_arcsec));
        let largest = *sized.first()?;
        let next = sized.get(1).map_or(0.0, |effect| effect.size_arcsec);
        let mut weights = vec![0.0; self.declared.len()];
        for effect in effects {
            let asked = f64::from(u8::from(effect.cause == largest.cause));
            weights.extend(self.half_range(effect.cause, &effect.coefficients).iter().map(|own| asked * own));
        }
        let uncertainty_arcsec = self.design(effects).uncertainty(&weights) / ARCSEC_RAD;
        let is_clear = largest.possible.len() == 1
            && largest.size_arcsec >= LARGEST_IS * next
            && uncertainty_arcsec <= SIZE_KNOWN_TO * largest.size_arcsec;
        is_clear.then_some(Asked { truth_arcsec: largest.size_arcsec, uncertainty_arcsec })
    }

    /// Everything that is fitted, if all causes are known.
    fn design(&self, effects: &[Effect]) -> Design<'_> {
        let causes = effects.iter().flat_map(|effect| self.columns_of(effect.cause));
        Design::new(self.declared_columns.iter().chain(causes))
    }

    /// The names of everything that is fitted, in the order of [`Ground::design`], with the true values.
    fn truth(&self, secret: &Secret) -> Vec<(String, f64)> {
        let declared = self.declared.iter().cloned().zip(secret.declared.iter().copied());
        let effects = secret.effects.iter().flat_map(|effect| {
            parameters(effect.cause, &self.instrument).into_iter().zip(effect.coefficients.iter().copied())
        });
        declared.chain(effects).collect()
    }

    fn true_model(&self, secret: &Secret) -> (Model, Vec<f64>) {
        let model = model(&self.instrument, secret.effects.iter().map(|effect| effect.cause));
        let mut values = model.chain.nominal_values();
        for (name, value) in self.truth(secret) {
            values[symbol(&model, &name).index()] = value;
        }
        (model, values)
    }

    /// The numbers that are asked for, with what is true and how well it can be known.
    fn asked(&self, secret: &Secret) -> [Asked; 3] {
        let design = self.design(&secret.effects);
        let (model, values) = self.true_model(secret);
        let ids: Vec<_> = self.truth(secret).iter().map(|(name, _)| symbol(&model, name)).collect();
        let asked = symbol(&model, self.instrument.asked[secret.asked_error]);
        let of_error: Vec<f64> = ids.iter().map(|&id| f64::from(u8::from(id == asked))).collect();
        let pose = [secret.asked_pose];
        let columns = model.columns(&self.instrument, &pose, &ids);
        let upwards: Vec<f64> = columns.iter().map(|column| column[2]).collect();
        let z = |values: &[f64]| model.pointing(&self.instrument, &pose, values)[0][2];
        let number = |truth_rad: f64, weights: &[f64]| Asked {
            truth_arcsec: truth_rad / ARCSEC_RAD,
            uncertainty_arcsec: design.uncertainty(weights) / ARCSEC_RAD,
        };
        [
            secret.size,
            number(values[asked.index()], &of_error),
            number(z(&values) - z(&model.chain.nominal_values()), &upwards),
        ]
    }

    /// The data of a secret.
    fn measured(self, level: Level, secret: Secret, seed: &Seed) -> Task {
        let (model, values) = self.true_model(&secret);
        let mut noise = seed.random(Purpose::Noise);
        let sigma = self.difficulty.noise_arcsec * ARCSEC_RAD;
        let noisy = |direction: &[f64; 3]| {
            // Normal noise along x, y and z is normal along any two directions across once the length is one again.
            let moved = direction.map(|own| own + sigma * noise.sample::<f64, _>(StandardNormal));
            let length = moved.iter().map(|own| own * own).sum::<f64>().sqrt();
            moved.map(|own| rounded(own / length, 9))
        };
        let measured: Vec<_> =
            model.pointing(&self.instrument, &self.poses, &values).iter().map(noisy).collect();
        let rows = self.poses.iter().copied().zip(measured).map(|row| secret.reading.written(row)).collect();
        let others = drawn(&self.instrument, UNSEEN_ROWS, &mut seed.random(Purpose::Unseen));
        let unseen = model.pointing(&self.instrument, &others, &values);
        let numbers = self.asked(&secret);
        Task {
            level,
            instrument: self.instrument,
            declared: self.declared.into_iter().zip(secret.declared).collect(),
            effects: secret.effects,
            reading: secret.reading,
            rows,
            poses: self.poses,
            asked_pose: secret.asked_pose,
            asked_error: self.instrument.asked[secret.asked_error],
            numbers,
            unseen: others.into_iter().zip(unseen).collect(),
        }
    }
}

/// The declaration of an instrument with what some causes add.
#[must_use]
pub fn declaration(instrument: &Instrument, causes: impl IntoIterator<Item = Cause>) -> String {
    let additions = causes.into_iter().flat_map(|cause| cause.additions(instrument));
    let written: Vec<_> = additions.map(|own| (own.behind, own.factor(instrument))).collect();
    instrument.with(written)
}

fn model(instrument: &Instrument, causes: impl IntoIterator<Item = Cause>) -> Model {
    Model::of(&declaration(instrument, causes), instrument)
        .unwrap_or_else(|error| unreachable!("the declarations of the instruments are tested: {error}"))
}

/// The names of the errors that a cause adds.
fn parameters(cause: Cause, instrument: &Instrument) -> Vec<String> {
    let additions = cause.additions(instrument);
    additions.iter().flat_map(|own| own.terms.iter().map(|(name, _)| (*name).to_owned())).collect()
}

fn symbol(model: &Model, name: &str) -> model_core::SymbolId {
    model.chain.find_symbol(name).unwrap_or_else(|| unreachable!("`{name}` stands in the declaration"))
}

fn of<'a, T>(all: &'a [T], chance: &mut impl Rng) -> &'a T {
    &all[chance.random_range(0..all.len())]
}
