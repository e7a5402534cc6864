//! Cautions in words.

use super::columns;
use super::misreadings::{misread, strayed};
use super::numbers::{reading, short, times, told, told_in};
use calibration::diagnose::{Caution, LengthsOff, Moved, TwoPlaces, Uneven};
use observe::SiUnit;

/// A caution in a sentence.
#[must_use]
pub fn caution(caution: &Caution) -> String {
    match caution {
        Caution::WorseHeldOut { before, after, unit } => format!(
            "On data that nobody fitted it is worse with the effects: {} before, {} after. Do not correct with it.",
            short(*before, *unit),
            short(*after, *unit)
        ),
        Caution::HardlyMoreNumbers { numbers, unknowns } => format!(
            "{numbers} numbers were measured for {unknowns} unknowns: too few are left over to judge the noise by, or the errors."
        ),
        Caution::ForetoldBadly { fitted, held_out, unit } => format!(
            "Data that nobody fitted are off by {}, {} as much as those that were fitted ({}): single rows decide what comes out.",
            short(*held_out, *unit),
            times(held_out / fitted),
            short(*fitted, *unit)
        ),
        Caution::NotConfirmed { effects, p_value, before, after, unit } => format!(
            "{} stood out (p = {p_value:.3}), but data that nobody fitted do not confirm it: {} without, {} with. It was \
             left out; measure more to decide.",
            effects.join("; "),
            short(*before, *unit),
            short(*after, *unit)
        ),
        Caution::FollowsOrder { effects, remembers, setups, column } => {
            let why = match (column, setups, remembers) {
                (Some(column), ..) => format!("the rows differ by their `{column}`, and that"),
                (None, 2.., _) => {
                    format!("the rows fall into about {setups} set-ups, and differences between them")
                }
                (None, _, true) => "each row is off like the row before it, and that".to_owned(),
                (None, ..) => "noise".to_owned(),
            };
            let explain = if column.is_none() && *setups > 1 { "explain" } else { "explains" };
            let next = match column {
                Some(_) => "Rows with one value of it belong together.".to_owned(),
                None => "If the rows were measured in sessions, name their column: `group = \"…\"` in the study. To decide, measure the \
                         same poses again in another order."
                    .to_owned(),
            };
            format!(
                "{} stood out, but {why} {explain} these data as well. It was left out. {next}",
                effects.join("; ")
            )
        }
        Caution::WorseElsewhere { before, after, unit } => format!(
            "In regions of the joints that were left out it is worse with the effects: {} before, {} after. Correct only \
             where these data lie.",
            short(*before, *unit),
            short(*after, *unit)
        ),
        Caution::FewBehindAnEffect { effect, observations } => {
            format!(
                "{effect} stood out, but it rests on about {observations:.1} observations. It was left out; repeat them \
                 first."
            )
        }
        Caution::StationBehindAnEffect { effect, station } => format!(
            "{effect} stood out, but only by where station `{station}` is stated to be: without that it does not. It was left out. Check \
             that place; if it is right, declare the effect."
        ),
        Caution::LimitOfEffects { effects } => {
            format!("The search stopped at {effects} effects, as many as it may accept; there may be more.")
        }
        Caution::OfOnePlace { rows, places, beside_groups } => format!(
            "Rows of one place agree more with each other than chance explains: the {rows} rows count as {places} groups, a \
             place each. What a place shares is in the ±{}.",
            if *beside_groups { ", and what your groups share is in the noise" } else { "" }
        ),
        Caution::OffAlike { rows, of_stretch, stretches } => format!(
            "Rows that follow each other are off alike: something drifts, or a surface is not what it is taken for. The {rows} rows count \
             as {stretches} stretches of {of_stretch}: the ± are larger for it, and an effect has to show in most stretches. What nobody \
             fitted are whole objects, which were seen in the same stretches."
        ),
        Caution::NoisyReadings { reading, sigma, unit } => {
            let sigma = told(*sigma, *unit);
            format!(
                "Noise of about {sigma} in the readings of `{reading}` looks like this as well: what is read too high is followed by a \
                 residual that says so. If that is it, write `sigma` beside its column under [columns]."
            )
        }
        Caution::Drifts { share } => format!(
            "What is left drifts: rows remember those before them, which explains {:.0} % of its variance. The ± allow for it, but an \
             effect that changes slowly may hide in it. `serial = false` under [noise] searches the drift for a cause.",
            100.0 * share
        ),
        Caution::ReadingsNotAsStated { ratio } if *ratio < 1.0 => format!(
            "Readings are less uncertain than your study states under [columns], {} less.",
            times(1.0 / ratio)
        ),
        Caution::ReadingsNotAsStated { ratio } => {
            format!("Readings are {} as uncertain as your study states under [columns].", times(*ratio))
        }
        Caution::SetAsideShare { reading: name, from, to, unit, rows: [aside, there] } => {
            let own = reading(*unit, from.abs().max(to.abs()));
            format!(
                "{aside} of the {there} rows with {name} from {} to {} were set aside: they share something that the \
                 declaration lacks.",
                told_in(*from, &own),
                told_in(*to, &own)
            )
        }
        Caution::Scatters { what, label, times: ratio } => {
            let times = times(*ratio);
            match what {
                Uneven::Station => format!(
                    "The rows from station `{label}` scatter {times} as much as the others': did it move meanwhile?"
                ),
                Uneven::Plane => format!(
                    "The rows of `{label}` scatter {times} as much as the others': is it flat, and did it stay where it was?"
                ),
                Uneven::Circle => format!(
                    "The rows of `{label}` scatter {times} as much as the others': is it round, and did it stay where it was?"
                ),
                Uneven::Point | Uneven::Wire => format!(
                    "The rows of `{label}` scatter {times} as much as the others': did it move, or are labels swapped?"
                ),
            }
        }
        Caution::ScaleOrPlaces { range, body, axis, scale, uncertainty } => {
            let [scale, uncertainty] = [scale, uncertainty].map(|ratio| short(*ratio, SiUnit::METRE));
            format!(
                "A scale of `{range}` that nobody declared, {scale} ± {uncertainty} a metre, would put all stations where they are stated. If \
                 those places are right, declare it: T{axis}({range}_scale*{range}) in the motion_error of body {body}."
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
                    "{station}`{label}` comes out {} off level, {sigmas:.0} of its ±: was it levelled, and does the z of all other \
                     stations and of the objects point up?",
                    short(*turn_rad, SiUnit::RAD)
                ),
                Some(sigmas) => format!(
                    "{station}`{label}` comes out {far} from where the study states it, {sigmas:.0} of its ±: is {stated} wrong, or the \
                     label another's?"
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
                        "{station}`{label}` is {far} from where the study states it (x {x}, y {y}, z {z}{turn}), by all of its rows, which \
                         were set aside for that: is {stated} wrong, or the label another's? State it rightly, or leave it out of \
                         [{table}]."
                    )
                }
            }
        }
        Caution::FilesShareErrors { files, ratio } => format!(
            "Rows of one file share an error: what the {files} files say scatters with {} the variance that their rows explain. The ± \
             count each file as one.",
            times(*ratio)
        ),
        Caution::NotBorneOut { effects } => format!(
            "Every row does not bear out {}: with all rows it is no larger than its ±. Leave it out.",
            effects.join("; ")
        ),
        Caution::EveryRowNotFitted => {
            "The fit of every row did not converge: the errors are those of the rows that were searched."
                .to_owned()
        }
        Caution::NothingProposed { why } => {
            format!("What `[next]` asks for cannot be proposed: {why}.")
        }
        Caution::DeclarationNotFitted { steps } => format!(
            "The declaration as it was could not be fitted in {steps} steps: figures before mean little."
        ),
        Caution::NoiseExceedsStated { ratio } => {
            format!("The residual is {} as large as the stated noise.", times(*ratio))
        }
        Caution::StatedTooLarge { ratio } => {
            format!("Your stated uncertainties are {} too large.", times(1.0 / ratio))
        }
        Caution::DegreesAsRadians { source, joint, largest_rad } => format!(
            "{source}: `{joint}` reaches {largest_rad:.0} rad, {:.0} turns: are these degrees taken for radians?",
            largest_rad / std::f64::consts::TAU
        ),
        Caution::RadiansAsDegrees { source, joint, largest_rad } => format!(
            "{source}: `{joint}` stays within {:.1} deg: were radians taken for degrees?",
            largest_rad.to_degrees()
        ),
        Caution::OutOfPlace { source, but_for: Some([aside, rows]), .. } => format!(
            "{source}: {aside} of the {rows} rows are far off and were set aside; the others are near. Are labels swapped, or are those rows \
             another's?"
        ),
        Caution::OutOfPlace { source, rms, unit, measured_m, but_for: None } => match measured_m {
            None => format!(
                "{source}: the residual is {}: a swapped sign, swapped axes or a wrong unit is likely.",
                short(*rms, *unit)
            ),
            Some(measured) => format!(
                "{source}: the residual is {} where {} were measured: a wrong unit, a swapped sign or swapped axes are \
                 likely.",
                short(*rms, *unit),
                told(*measured, SiUnit::METRE)
            ),
        },
        Caution::ColumnMisread(misread) => columns::told(misread),
        Caution::Implausible { values } => columns::implausible(values),
        Caution::FitsOtherwise(otherwise) => misread(otherwise),
        Caution::StationsStrayed(own) => strayed(own),
        Caution::Moved(own) => moved(own),
        Caution::LengthsOff(own) => lengths_off(own),
        Caution::TwoPlaces(TwoPlaces { label, apart_m, rows: [one, other], objects: [some, all] }) => {
            let count = if *some > 1 {
                format!(", and so do those of {some} of {all} objects")
            } else {
                String::new()
            };
            format!(
                "The rows of `{label}` lie at two places {} apart ({one} and {other} rows){count}: are two things under one label, or did it move \
                 meanwhile? Of two things name the column that tells them apart, too: object = [\"…\", \"…\"].",
                short(*apart_m, SiUnit::METRE)
            )
        }
        Caution::ResidualIsRounding { rms, unit } => format!(
            "What is left, {}, is the rounding of the numbers: these data have no noise, so that no effect was searched for.",
            told(*rms, *unit)
        ),
        Caution::ErrorNotSmall { error, value_rad } => format!(
            "`{error}` comes out at {:.0} deg, which is no small error: a swapped sign, an axis or an offset in the \
             declaration?",
            value_rad.to_degrees()
        ),
    }
}

/// Stations that seem to have moved.
fn moved(own: &Moved) -> String {
    let Moved { station, shift_m, turn_rad, instead_of } = own;
    let by = format!(
        "{} and {} in the order of its rows",
        short(*shift_m, SiUnit::METRE),
        short(*turn_rad, SiUnit::RAD)
    );
    let (who, by) = match station {
        Some(label) => (format!("Station `{label}` seems"), format!("by {by}")),
        None => ("The stations seem".to_owned(), format!("each by up to {by}")),
    };
    format!(
        "{who} to have moved while measuring, {by}: {}. Let it stand firmly, and measure again.",
        better_than(instead_of)
    )
}

/// Lengths that seem to be told from another zero.
fn lengths_off(LengthsOff { by_m, instead_of }: &LengthsOff) -> String {
    let long = if *by_m > 0.0 { "long" } else { "short" };
    format!(
        "The lengths seem to be too {long} by {}: {}. See where the bar's scale begins and correct the lengths, or write kind = \"wire\", \
         which estimates what they have too much, and calibrate again.",
        short(by_m.abs(), SiUnit::METRE),
        better_than(instead_of)
    )
}

fn better_than(instead_of: &[String]) -> String {
    match instead_of {
        [] => "that explains these data better".to_owned(),
        some => format!("that explains these data better than {}", some.join(", ")),
    }
}
