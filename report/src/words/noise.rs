//! The noise in words.

use super::components::side;
use super::numbers::{times, told};
use calibration::diagnose::{Diagnosis, SerialFound, VarianceFound};
use observe::NoiseOf;

/// What was found of the noise, a sentence each.
#[must_use]
pub fn noise(diagnosis: &Diagnosis) -> Vec<String> {
    let noise = &diagnosis.noise;
    let mut said = Vec::new();
    for series in &noise.series {
        let each = series.components.iter().zip(&series.sigma);
        let each: Vec<String> = each
            .map(|(name, &sigma)| match series.of_stated {
                true => format!("{} the stated value {}", times(sigma), side(name)),
                false => format!("{} {}", told(sigma, series.unit), side(name)),
            })
            .collect();
        said.push(format!("{}: standard deviation {}", series.source, each.join(", ")));
    }
    if let Some(stated) = noise.stated {
        let stated = told(stated, diagnosis.unit);
        said.push(format!(
            "the study states {stated}. Weights and uncertainties use the scatter of the residuals, since an effect may be missing"
        ));
    }
    if let Some(factor) = noise.readings_over_stated {
        let each = noise.readings.iter().map(|own| format!("{} {}", own.name, told(own.sigma, own.unit)));
        said.push(format!(
            "readings are {} as uncertain as the study states ({}). The standard deviations above come in addition",
            times(factor),
            each.collect::<Vec<_>>().join(", ")
        ));
    }
    for own in noise.variance.chunk_by(|one, next| one.noise_of == next.noise_of) {
        let terms: Vec<String> = own.iter().map(term).collect();
        let of = match own[0].noise_of {
            NoiseOf::Angles => "of angles",
            NoiseOf::Lengths => "of lengths",
            NoiseOf::Across => "sideways to the beam",
            NoiseOf::Pixels => "in the image",
        };
        said.push(format!(
            "the noise {of} depends on the joints. The logarithm of its variance is {}",
            terms.join(" ")
        ));
    }
    match noise.serial {
        Some(serial) => said.push(remembered(serial, noise.undeclared_order)),
        None if noise.undeclared_order => said.push(
            "consecutive rows share errors in the order of the file (drift, or an effect that the model does not contain). The \
             uncertainties include this"
                .to_owned(),
        ),
        None => {}
    }
    said
}

/// What consecutive rows share.
fn remembered(serial: SerialFound, undeclared_order: bool) -> String {
    let order =
        if undeclared_order { ", in the order of the file, which the study does not name" } else { "" };
    let axes = if serial.in_space { ", in directions fixed in space" } else { "" };
    format!(
        "consecutive rows share errors{order}{axes}. Their model is ARMA(1,1) with {:.3} and {:.3}",
        serial.autoregressive, serial.moving_average
    )
}

fn term(term: &VarianceFound) -> String {
    let multiple = if term.multiple == 1 { String::new() } else { format!("{}", term.multiple) };
    format!("{:+.2} {}({multiple}{})", term.coefficient, term.function, term.of)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_is_reported_with_its_order_and_its_axes() {
        let serial = |in_space| SerialFound { autoregressive: 0.9, moving_average: -0.25, in_space };
        assert_eq!(
            remembered(serial(false), false),
            "consecutive rows share errors. Their model is ARMA(1,1) with 0.900 and -0.250"
        );
        assert_eq!(
            remembered(serial(true), true),
            "consecutive rows share errors, in the order of the file, which the study does not name, in directions fixed in \
             space. Their model is ARMA(1,1) with 0.900 and -0.250"
        );
    }
}
