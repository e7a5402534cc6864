//! The verdict: what a calibration comes to, and how that is decided.

use serde::Serialize;

use super::caution::Caution;
use super::ended::Ended;

/// What a calibration comes to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub enum Verdict {
    /// Every accepted effect is confounded with no other, competes with none, and nothing is left.
    #[serde(rename = "explained")]
    Explained,
    /// Nothing is left, but some effects have others that explain these data as well.
    #[serde(rename = "confounded")]
    Confounded,
    /// Effects at their places, but these data do not determine of which form: another function explains them as well.
    #[serde(rename = "form not determined")]
    FormNotDetermined,
    /// One function at one place, which no effect of the catalogue is, explains the data better than the catalogue.
    #[serde(rename = "unnamed function")]
    UnnamedFunction,
    /// The residual still has structure, and nothing at one place explains it.
    #[serde(rename = "structure remains")]
    StructureRemains,
    /// No effect stands out, yet the residual is larger than the noise that the study or the data state.
    #[serde(rename = "noise exceeds stated")]
    NoiseExceedsStated,
    /// No effect stands out from the noise.
    #[serde(rename = "nothing detectable")]
    NothingDetectable,
    /// Too few observations for what is to be estimated, or an effect that hangs on fewer than six is all that stands out.
    #[serde(rename = "too few observations")]
    TooFewObservations,
    /// A column is not what the study says: its unit, its sign, its place among the others.
    #[serde(rename = "column misread")]
    ColumnMisread,
    /// The fit did not end at a minimum, or with values that no small error has: its numbers mean nothing.
    #[serde(rename = "fit failed")]
    FitFailed,
}

impl Verdict {
    /// The key in `report.json`.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Self::Explained => "explained",
            Self::Confounded => "confounded",
            Self::FormNotDetermined => "form not determined",
            Self::UnnamedFunction => "unnamed function",
            Self::StructureRemains => "structure remains",
            Self::NoiseExceedsStated => "noise exceeds stated",
            Self::NothingDetectable => "nothing detectable",
            Self::TooFewObservations => "too few observations",
            Self::ColumnMisread => "column misread",
            Self::FitFailed => "fit failed",
        }
    }

    /// Whether there is a model to correct with.
    #[must_use]
    pub fn is_usable(self) -> bool {
        !matches!(self, Self::TooFewObservations | Self::ColumnMisread | Self::FitFailed)
    }
}

/// What the verdict hangs on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Evidence<'a> {
    /// How the last fit ended.
    pub ended: &'a Ended,
    /// Whether a function at one place beats the catalogue.
    pub unnamed: bool,
    /// Whether the residual has structure.
    pub structure: bool,
    /// Whether any effect was accepted.
    pub effects: bool,
    /// Whether each accepted effect is alone.
    pub alone: bool,
    /// Whether some effect could be another function.
    pub form_open: bool,
    /// What else was noticed.
    pub cautions: &'a [Caution],
}

/// The first that holds, the worst first.
pub(super) fn verdict(evidence: Evidence<'_>) -> Verdict {
    let any = |is: fn(&Caution) -> bool| evidence.cautions.iter().any(is);
    if any(|caution| matches!(caution, Caution::ColumnMisread(_))) {
        return Verdict::ColumnMisread;
    }
    match evidence.ended {
        Ended::TooFewObservations { .. } => return Verdict::TooFewObservations,
        Ended::NotConverged { .. } | Ended::FarOff { .. } | Ended::NoRest { .. } => {
            return Verdict::FitFailed;
        }
        Ended::Converged { .. } if any(|caution| matches!(caution, Caution::Implausible { .. })) => {
            return Verdict::FitFailed;
        }
        Ended::Converged { .. } => {}
    }
    let few = any(|caution| matches!(caution, Caution::FewBehindAnEffect { .. }));
    if few && !evidence.effects && !evidence.structure {
        Verdict::TooFewObservations
    } else if any(|caution| matches!(caution, Caution::ResidualIsRounding { .. })) && !evidence.effects {
        // Rounding has a structure of its own, and no noise to tell it from.
        Verdict::NothingDetectable
    } else if evidence.unnamed {
        Verdict::UnnamedFunction
    } else if evidence.structure {
        Verdict::StructureRemains
    } else if evidence.effects && evidence.form_open {
        Verdict::FormNotDetermined
    } else if evidence.effects && evidence.alone {
        Verdict::Explained
    } else if evidence.effects {
        Verdict::Confounded
    } else if any(|caution| matches!(caution, Caution::NoiseExceedsStated { .. })) {
        Verdict::NoiseExceedsStated
    } else {
        Verdict::NothingDetectable
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_is_said_first() {
        let (fine, failed) = (Ended::Converged { steps: 3 }, Ended::NotConverged { steps: 50 });
        let few = Ended::TooFewObservations { components: 2, parameters: 3, of_objects: 0 };
        let noisy = [Caution::NoiseExceedsStated { ratio: 2.3 }];
        let thin = [Caution::FewBehindAnEffect { effect: "drift".into(), observations: 3.1 }];
        let rounded = [Caution::ResidualIsRounding { rms: 1e-16, unit: observe::SiUnit::RAD }];
        let whole = Evidence {
            ended: &fine,
            unnamed: false,
            structure: false,
            effects: true,
            alone: true,
            form_open: false,
            cautions: &[],
        };
        let none = Evidence { effects: false, ..whole };
        for (evidence, expected) in [
            (whole, Verdict::Explained),
            (Evidence { alone: false, ..whole }, Verdict::Confounded),
            (Evidence { form_open: true, alone: false, ..whole }, Verdict::FormNotDetermined),
            (Evidence { form_open: true, structure: true, ..whole }, Verdict::StructureRemains),
            (Evidence { structure: true, ..whole }, Verdict::StructureRemains),
            (Evidence { structure: true, unnamed: true, ..whole }, Verdict::UnnamedFunction),
            (Evidence { cautions: &thin, ..none }, Verdict::TooFewObservations),
            (Evidence { cautions: &thin, ..whole }, Verdict::Explained),
            (Evidence { cautions: &thin, structure: true, ..none }, Verdict::StructureRemains),
            (Evidence { ended: &failed, ..whole }, Verdict::FitFailed),
            (Evidence { ended: &few, ..whole }, Verdict::TooFewObservations),
            (none, Verdict::NothingDetectable),
            (Evidence { cautions: &noisy, ..none }, Verdict::NoiseExceedsStated),
            (Evidence { cautions: &noisy, ..whole }, Verdict::Explained),
            (
                Evidence { cautions: &rounded, structure: true, unnamed: true, ..none },
                Verdict::NothingDetectable,
            ),
            (Evidence { cautions: &rounded, ..whole }, Verdict::Explained),
        ] {
            assert_eq!(verdict(evidence), expected, "{evidence:?}");
            assert_eq!(serde_json_key(expected), expected.key());
        }
    }

    /// The key that serde writes.
    fn serde_json_key(verdict: Verdict) -> String {
        toml::Value::try_from(verdict)
            .ok()
            .and_then(|value| value.as_str().map(str::to_owned))
            .unwrap_or_default()
    }
}
