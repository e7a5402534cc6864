//! The noise of simulated instruments, in units of σ.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal, StudentT};

/// How the noise of one run behaves; two components an observation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Noise {
    /// Normal, independent, the same everywhere.
    Even,
    /// Normal, standard deviation exp(0.6 cos β): a factor of 3.3 between the ends of the middle joint's range.
    Uneven,
    /// Student's t with 3 degrees of freedom, scaled to variance one.
    HeavyTails,
    /// Normal, one observation in twenty ten times as large.
    Outliers,
    /// First-order autoregressive, coefficient 0.9, variance one.
    Autoregressive,
    /// Normal, plus a random walk with steps of 0.1.
    RandomWalk,
}

impl Noise {
    /// As the page names it.
    pub fn words(self) -> &'static str {
        match self {
            Self::Even => "even noise",
            Self::Uneven => "uneven noise, exp(0.6 cos β)",
            Self::HeavyTails => "heavy tails, t₃",
            Self::Outliers => "5 % outliers of 10 σ",
            Self::Autoregressive => "AR(0.9) along a trajectory",
            Self::RandomWalk => "white + random walk (0.1 σ a step) along a trajectory",
        }
    }

    /// Whether it only means something in order of acquisition.
    pub fn remembers(self) -> bool {
        matches!(self, Self::Autoregressive | Self::RandomWalk)
    }

    /// Noise for observations at these readings of the middle joint.
    pub fn sample(self, beta_rad: &[f64], random: &mut ChaCha8Rng) -> Vec<[f64; 2]> {
        let normal =
            |random: &mut ChaCha8Rng| -> [f64; 2] { [(); 2].map(|()| StandardNormal.sample(random)) };
        let mut state: [f64; 2] = normal(random);
        if self == Self::RandomWalk {
            state = [0.0; 2];
        }
        beta_rad
            .iter()
            .map(|beta| match self {
                Self::Even => normal(random),
                Self::Uneven => normal(random).map(|e| (0.6 * beta.cos()).exp() * e),
                Self::HeavyTails => [(); 2].map(|()| heavy(random)),
                Self::Outliers => {
                    let far = if random.random_range(0.0..1.0) < 0.05 { 10.0 } else { 1.0 };
                    normal(random).map(|e| far * e)
                }
                Self::Autoregressive => {
                    let innovation = normal(random);
                    state = [0, 1].map(|at| 0.9 * state[at] + (1.0_f64 - 0.81).sqrt() * innovation[at]);
                    state
                }
                Self::RandomWalk => {
                    let (step, white) = (normal(random), normal(random));
                    state = [0, 1].map(|at| state[at] + 0.1 * step[at]);
                    [0, 1].map(|at| state[at] + white[at])
                }
            })
            .collect()
    }
}

/// Student's t with three degrees of freedom has variance three.
fn heavy(random: &mut ChaCha8Rng) -> f64 {
    StudentT::new(3.0).map_or(0.0, |t: StudentT<f64>| t.sample(random)) / 3.0_f64.sqrt()
}
