//! Cautions in words.

use super::columns;
use super::ladder::{model, size};
use super::numbers::{reading, short, times, told, told_in};
use calibration::diagnose::{Caution, LengthsOff, Moved, TwoPlaces, Uneven};
use observe::SiUnit;

/// A caution in sentences.
#[must_use]
pub fn caution(caution: &Caution) -> String {
    match caution {
        Caution::WorseHeldOut { before, after, unit } => format!(
            "The effects increase the error on held-out data from {} to {}. Do not correct with them.",
            size(*before, *unit),
            size(*after, *unit)
        ),
        Caution::HardlyMoreNumbers { numbers, unknowns } => format!(
            "{numbers} measured numbers for {unknowns} unknowns are too few to check the noise or the errors. Measure more rows."
        ),
        Caution::ForetoldBadly { fitted, held_out, unit } if !held_out.is_finite() => format!(
            "Held-out data miss by more than the measured region is wide, fitted data by {}. Single rows decide the result. Measure more rows.",
            short(*fitted, *unit)
        ),
        Caution::ForetoldBadly { fitted, held_out, unit } => format!(
            "Held-out data miss by {}, fitted data by {} ({}). Single rows decide the result. Measure more rows.",
            short(*held_out, *unit),
            short(*fitted, *unit),
            times(held_out / fitted)
        ),
        Caution::SimplerPredictsBetter { model: simplest, simpler, declared, unit, spared, written } => {
            let others = match spared.len() {
                1 => "other error".to_owned(),
                count => format!("other {count} errors"),
            };
            let act = if *written {
                format!(
                    "The {others} were not estimated. To estimate them, measure more rows, or name them under `[report] wanted`."
                )
            } else {
                format!(
                    "These rows are too few or too alike to gain from the {others}. Fix them at zero, or measure more rows."
                )
            };
            format!(
                "On held-out data, {} ({}) predicts better than all declared errors ({}). {act}",
                model(*simplest),
                size(*simpler, *unit),
                size(*declared, *unit)
            )
        }
        Caution::NotConfirmed { effects, p_value, before, after, unit } => {
            let goes = if after > before { "increases" } else { "hardly changes" };
            format!(
                "{} appeared (p = {p_value:.3}), but it {goes} the error on held-out data ({} without, {} with). The model was not changed. \
                 Measure more rows to decide.",
                effects.join(", "),
                size(*before, *unit),
                size(*after, *unit)
            )
        }
        Caution::FollowsOrder { effects, remembers, setups, column } => {
            let why = match (column, setups, remembers) {
                (Some(column), ..) => format!("a change with the column `{column}`"),
                (None, 2.., _) => format!("a change between about {setups} set-ups"),
                (None, _, true) => "a slow drift from row to row".to_owned(),
                (None, ..) => "noise".to_owned(),
            };
            let next = match column {
                Some(column) => format!("Group the rows by that column: `group = {column:?}` in the study."),
                None => "If the rows were measured in sessions, name their column: `group = \"…\"` in the study. Otherwise measure the \
                         same poses again in another order."
                    .to_owned(),
            };
            if effects.is_empty() {
                return format!("Rows are off together: there is {why}. {next}");
            }
            format!(
                "{} appeared, but cannot be separated from {why}. The model was not changed. {next}",
                effects.join(", ")
            )
        }
        Caution::WorseElsewhere { before, after, unit } => format!(
            "In unmeasured regions of the joints the effects increase the error from {} to {}. Correct only within the measured range.",
            size(*before, *unit),
            size(*after, *unit)
        ),
        Caution::FewBehindAnEffect { effect, observations } => {
            format!(
                "{effect} appeared, but only about {observations:.1} rows support it. The model was not changed. Repeat these rows."
            )
        }
        Caution::StationBehindAnEffect { effect, station } => format!(
            "{effect} appeared, but only the stated place of station `{station}` supports it. The model was not changed. Check that place. \
             If the place is right, declare the effect."
        ),
        Caution::LimitOfEffects { effects } => {
            format!(
                "The search stopped at its limit of {effects} effects. To look for more, raise `[search] most`."
            )
        }
        Caution::OfOnePlace { rows, places, beside_groups } => format!(
            "Rows of one place share errors. The {rows} rows count as {places} groups, one for each place. The ± {} this.",
            if *beside_groups { "and the noise of your groups include" } else { "include" }
        ),
        Caution::OffAlike { rows, stretches, .. } => format!(
            "Consecutive rows share errors (drift, or a surface that is not flat). Uncertainties were enlarged: {rows} rows count as \
             {stretches} independent blocks. Held-out data are whole objects, seen in the same blocks."
        ),
        Caution::NoisyReadings { reading, sigma, unit } => {
            let sigma = told(*sigma, *unit);
            format!(
                "Noise of about {sigma} in the readings of `{reading}` cannot be separated from this effect. If the readings are that \
                 noisy, write `sigma` beside their column under [columns]."
            )
        }
        Caution::Drifts { share } => format!(
            "The residual drifts: neighbouring rows explain {:.0} % of its variance. The ± include this drift. To search for the cause of the \
             drift, write `serial = false` under [noise].",
            100.0 * share
        ),
        Caution::ReadingsNotAsStated { ratio } if *ratio < 1.0 => format!(
            "Your readings are {} less uncertain than the study states. Correct `sigma` under [columns].",
            times(1.0 / ratio)
        ),
        Caution::ReadingsNotAsStated { ratio } => {
            format!(
                "Your readings are {} as uncertain as the study states. Correct `sigma` under [columns].",
                times(*ratio)
            )
        }
        Caution::SetAsideShare { reading: name, from, to, unit, rows: [aside, there] } => {
            let own = reading(*unit, from.abs().max(to.abs()));
            format!(
                "{aside} of the {there} rows with `{name}` from {} to {} are outliers. They share an error that the model does not \
                 contain. Check these rows.",
                told_in(*from, &own),
                told_in(*to, &own)
            )
        }
        Caution::Scatters { what, label, times: ratio } => {
            let times = times(*ratio);
            match what {
                Uneven::Station => format!(
                    "The rows from station `{label}` scatter {times} as much as other rows. Check whether the station moved."
                ),
                Uneven::Plane => format!(
                    "The rows of `{label}` scatter {times} as much as other rows. Check whether the surface is flat, and whether it moved."
                ),
                Uneven::Circle => format!(
                    "The rows of `{label}` scatter {times} as much as other rows. Check whether the circle is round, and whether it moved."
                ),
                Uneven::Point | Uneven::Wire => format!(
                    "The rows of `{label}` scatter {times} as much as other rows. Check whether it moved, and whether labels are swapped."
                ),
            }
        }
        Caution::ScaleOrPlaces { range, body, axis, scale, uncertainty } => {
            let [scale, uncertainty] = [scale, uncertainty].map(|ratio| short(*ratio, SiUnit::METRE));
            format!(
                "An undeclared scale of `{range}`, {scale} ± {uncertainty} per metre, would bring all stations to their stated places. If \
                 those places are right, declare this scale: `T{axis}({range}_scale*{range})` in the motion_error of body {body}."
            )
        }
        Caution::NotWhereStated { what, label, sigmas, away_m, shift_m, turn_rad } => {
            let (station, stated, table) = match what {
                Uneven::Station => ("Station ", "its pose", "stations"),
                _ => ("", "a coordinate", "objects"),
            };
            let far = short(*away_m, SiUnit::METRE);
            match sigmas {
                Some(sigmas) if *what == Uneven::Station && *away_m == 0.0 => format!(
                    "{station}`{label}` is fitted {} out of level, {sigmas:.0} times its ±. Check whether it was levelled, and whether z \
                     points up everywhere.",
                    short(*turn_rad, SiUnit::RAD)
                ),
                Some(sigmas) => format!(
                    "{station}`{label}` is fitted {far} away from its stated place, {sigmas:.0} times its ±. Check {stated} and the labels."
                ),
                None => {
                    let own = reading(SiUnit::METRE, *away_m);
                    let [x, y, z] = shift_m.map(|shift| told_in(shift, &own));
                    let turn = if *turn_rad > 0.0 {
                        format!(", turned by {}", short(*turn_rad, SiUnit::RAD))
                    } else {
                        String::new()
                    };
                    format!(
                        "{station}`{label}` is {far} away from its stated place (x {x}, y {y}, z {z}{turn}) by all of its rows. They were \
                         excluded as outliers. Correct {stated} or the label, or remove the entry from [{table}]."
                    )
                }
            }
        }
        Caution::FilesShareErrors { files, ratio } => format!(
            "Rows of one file share an error. The {files} files scatter with {} the variance that their rows explain. The ± count each \
             file as one row.",
            times(*ratio)
        ),
        Caution::NotBorneOut { effects } => format!(
            "With all rows, {} is no larger than its ±. Remove it from the model.",
            effects.join(", ")
        ),
        Caution::EveryRowNotFitted => {
            "The fit of every row did not converge. The errors come from the rows of the search alone."
                .to_owned()
        }
        Caution::NothingProposed { why } => {
            format!("The study asks for measurements under `[next]`, but none can be proposed ({why}).")
        }
        Caution::DeclarationNotFitted { steps } => format!(
            "The declaration without the effects could not be fitted in {steps} steps. Do not use the figures before."
        ),
        Caution::NoiseExceedsStated { ratio } => {
            format!(
                "The residual is {} as large as the stated noise. Check `sigma` under [noise].",
                times(*ratio)
            )
        }
        Caution::StatedTooLarge { ratio } => {
            format!(
                "Your stated uncertainties are {} too large. Check `sigma` under [noise].",
                times(1.0 / ratio)
            )
        }
        Caution::OutOfPlace { source, but_for: Some([aside, rows]), .. } => format!(
            "In {source}, {aside} of the {rows} rows are outliers by a large distance. Check their labels, objects and stations."
        ),
        Caution::OutOfPlace { source, rms, unit, measured_m, but_for: None } => match measured_m {
            None => format!(
                "In {source}, the residual is {}. Check for a reversed sign, exchanged axes or a wrong unit.",
                short(*rms, *unit)
            ),
            Some(measured) => format!(
                "In {source}, the residual is {} at a measured {}. Check for a wrong unit, a reversed sign or exchanged axes.",
                short(*rms, *unit),
                told(*measured, SiUnit::METRE)
            ),
        },
        Caution::ColumnMisread(misread) => columns::told(misread),
        Caution::Implausible { values } => columns::implausible(values),
        Caution::ByTheClock(own) => columns::by_the_clock(own),
        Caution::StationsStrayed(own) => columns::strayed(own),
        Caution::Moved(own) => moved(own),
        Caution::LengthsOff(own) => lengths_off(own),
        Caution::TwoPlaces(TwoPlaces { label, apart_m, rows: [one, other], objects: [some, all] }) => {
            let count =
                if *some > 1 { format!(", as are those of {some} of {all} objects") } else { String::new() };
            format!(
                "The rows of `{label}` are at two places {} apart ({one} and {other} rows){count}. Check whether it moved, or whether two \
                 objects share one label. If two share one, also name the column that separates them: `object = [\"…\", \"…\"]`.",
                short(*apart_m, SiUnit::METRE)
            )
        }
        Caution::ResidualIsRounding { rms, unit } => format!(
            "The residual of {} is the rounding of the numbers. These data have no noise, so no search was made.",
            told(*rms, *unit)
        ),
        Caution::ErrorNotSmall { error, value_rad } => format!(
            "`{error}` is {:.0} deg, too large for a small error. Check signs, axes and offsets in the declaration.",
            value_rad.to_degrees()
        ),
    }
}

/// Stations that seem to have moved.
fn moved(own: &Moved) -> String {
    let Moved { station, shift_m, turn_rad, instead_of } = own;
    let by = format!("{} and {}", short(*shift_m, SiUnit::METRE), short(*turn_rad, SiUnit::RAD));
    let who = match station {
        Some(label) => format!("Station `{label}` likely moved by {by} during its rows."),
        None => format!("The stations likely moved during their rows, each by up to {by}."),
    };
    format!("{who} {} Fix the station firmly and measure again.", better_than(instead_of))
}

/// Lengths that seem to be measured from another zero.
fn lengths_off(LengthsOff { by_m, instead_of }: &LengthsOff) -> String {
    let long = if *by_m > 0.0 { "long" } else { "short" };
    format!(
        "The lengths are likely too {long} by {}. {} Check where the scale of the bar begins, correct the lengths and calibrate again. Or \
         write `kind = \"wire\"`, which estimates this offset.",
        short(by_m.abs(), SiUnit::METRE),
        better_than(instead_of)
    )
}

fn better_than(instead_of: &[String]) -> String {
    match instead_of {
        [] => "This explains the data better.".to_owned(),
        some => format!("This explains the data better than {}.", some.join(", ")),
    }
}
