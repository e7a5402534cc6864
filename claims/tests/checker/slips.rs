//! Formulas as texts, and slips made in them by changing the text: without the code under test.

use claims::checker::TermSlip;
use model_core::forms::Form;
use model_core::print::{self, Style};
use model_core::{Axis, Chain};
use testkit::Random;

/// The slips that are made.
#[derive(Debug, Clone, Copy)]
pub enum Slip {
    Missing,
    Sign,
    SineForCosine,
    Factor,
    OtherComponent,
}

impl Slip {
    pub const ALL: [Self; 5] =
        [Self::Missing, Self::Sign, Self::SineForCosine, Self::Factor, Self::OtherComponent];
}

/// What the checker has to say of a slip.
pub struct Expected {
    /// Component and error of every difference, in order.
    pub places: Vec<(Axis, String)>,
    /// Whether a diagnosis names the slip.
    pub is_right: fn(&TermSlip) -> bool,
}

/// What an error contributes to a component, as a text.
struct Contribution {
    axis: usize,
    error: usize,
    factor: String,
}

/// A first-order formula as a list of contributions.
pub struct Formula<'a> {
    style: Style,
    errors: Vec<&'a model_core::Symbol>,
    contributions: Vec<Contribution>,
}

const AXES: [Axis; 3] = [Axis::X, Axis::Y, Axis::Z];

impl<'a> Formula<'a> {
    pub fn new(chain: &'a Chain, form: &Form, style: Style) -> Self {
        let columns = form.columns(chain);
        let mut contributions = Vec::new();
        for (error, (_, column)) in columns.iter().enumerate() {
            for (axis, factor) in column.iter().enumerate().filter(|(_, factor)| !factor.is_zero()) {
                contributions.push(Contribution { axis, error, factor: print::poly(factor, chain, style) });
            }
        }
        let errors = columns.iter().map(|(error, _)| chain.symbol(*error)).collect();
        Self { style, errors, contributions }
    }

    /// The three components.
    pub fn texts(&self) -> [String; 3] {
        [0, 1, 2].map(|axis| {
            let terms: Vec<String> = self
                .contributions
                .iter()
                .filter(|contribution| contribution.axis == axis)
                .map(|Contribution { error, factor, .. }| match self.style {
                    Style::Text => format!("{}*({factor})", self.errors[*error].name),
                    _ => format!(r"\left({factor}\right) {}", self.errors[*error].latex),
                })
                .collect();
            if terms.is_empty() { "0".to_owned() } else { terms.join(" + ") }
        })
    }

    /// Makes one slip somewhere.
    pub fn slip(&mut self, random: &mut Random) -> (Slip, Expected) {
        let chosen = random.below(self.contributions.len());
        let waves: Vec<(usize, &str)> = ["sin", "cos"]
            .iter()
            .flat_map(|wave| self.contributions[chosen].factor.match_indices(wave))
            .collect();
        let mut slip = Slip::ALL[random.below(Slip::ALL.len())];
        if waves.is_empty() && matches!(slip, Slip::SineForCosine) {
            slip = Slip::Sign;
        }
        let Contribution { axis, error, .. } = self.contributions[chosen];
        let here = (AXES[axis], self.errors[error].name.clone());
        let is_right: fn(&TermSlip) -> bool = match slip {
            Slip::Missing => {
                self.contributions.remove(chosen);
                return (slip, Expected { places: vec![here], is_right: |slip| *slip == TermSlip::Missing });
            }
            Slip::Sign => {
                let factor = &mut self.contributions[chosen].factor;
                *factor = format!("-({factor})");
                |slip| *slip == TermSlip::Sign
            }
            Slip::SineForCosine => {
                let (at, wave) = waves[random.below(waves.len())];
                let other = if wave == "sin" { "cos" } else { "sin" };
                self.contributions[chosen].factor.replace_range(at..at + 3, other);
                |slip| matches!(slip, TermSlip::SineForCosine { sign: false, .. })
            }
            Slip::Factor => {
                let factor = &mut self.contributions[chosen].factor;
                *factor = format!("3({factor})")
                    .replace("3(", if self.style == Style::Text { "3*(" } else { "3(" });
                |slip| matches!(slip, TermSlip::Factor(factor) if *factor == 3.into())
            }
            Slip::OtherComponent => return self.move_to_other_component(chosen, here, random),
        };
        (slip, Expected { places: vec![here], is_right })
    }

    /// Moves a contribution into a component to which its error contributes nothing; drops it if there is none.
    fn move_to_other_component(
        &mut self,
        chosen: usize,
        here: (Axis, String),
        random: &mut Random,
    ) -> (Slip, Expected) {
        let error = self.contributions[chosen].error;
        let free: Vec<usize> = (0..3)
            .filter(|&axis| {
                !self.contributions.iter().any(|other| other.axis == axis && other.error == error)
            })
            .collect();
        if free.is_empty() {
            self.contributions.remove(chosen);
            return (
                Slip::Missing,
                Expected { places: vec![here], is_right: |slip| *slip == TermSlip::Missing },
            );
        }
        let axis = free[random.below(free.len())];
        self.contributions[chosen].axis = axis;
        let mut places = vec![(AXES[axis], here.1.clone()), here];
        places.sort_by_key(|(axis, _)| axis.index());
        let is_right = |slip: &TermSlip| matches!(slip, TermSlip::BelongsTo(_) | TermSlip::StandsIn(_));
        (Slip::OtherComponent, Expected { places, is_right })
    }
}
