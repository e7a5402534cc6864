//! What a designer asks of one observable, answered.

use std::path::Path;

use model_core::budget::{BudgetError, Poses};
use model_core::{Chain, ObservableId, SymbolId};
use nalgebra::DMatrix;
use service::budget::{Designed, Remaining, size};
use service::evaluation::readings_of;
use service::tolerance::{
    Campaign, NotAllocated, Sensitivity, Wish, after, allocate, registered, root_sum_square, simulate,
    worst_case,
};
use tables::formats::Options;

use super::options::{DesignerArguments, at_observable, is_meant_for};
use crate::failure::Failure;
use crate::{table_files, terminal};

/// Answers for one observable; none where what is asked is not meant for it and nobody named it.
///
/// # Errors
/// The poses, the campaign or what is wanted cannot be used.
pub fn designed(
    chain: &Chain,
    observable: ObservableId,
    sizes: &[f64],
    poses: &Poses,
    arguments: &DesignerArguments,
    is_named: bool,
) -> Result<Option<Designed>, Failure> {
    let shown = chain.observable(observable);
    if !shown.is_vector() && !is_named {
        if arguments.is_asked() {
            let name = &shown.name;
            terminal::warn(format_args!(
                "{name} is left out of what tolerances come to: it shows single readings"
            ));
        }
        return Ok(None);
    }
    if !shown.is_vector() && !arguments.is_asked() {
        return Ok(None);
    }
    for text in [&arguments.wanted, &arguments.noise].into_iter().flatten() {
        if !is_named && !is_meant_for(text, shown.kind) {
            let name = &shown.name;
            terminal::warn(format_args!(
                "{name} is left out of what tolerances come to: {text} is not of its kind"
            ));
            return Ok(None);
        }
    }
    let input = |error: BudgetError| Failure::Input(error.to_string());
    let tolerances = arguments.tolerances(chain, sizes)?;
    let plain =
        Sensitivity::over(chain, observable, sizes, poses, arguments.poses as usize).map_err(input)?;
    let seen = |plain: Sensitivity| if arguments.registered { registered(&plain) } else { plain };
    let sensitivity = seen(plain);
    let now = root_sum_square(&sensitivity, &tolerances);
    let draw = |root: Option<&DMatrix<f64>>| {
        let simulate = |draws| simulate(&sensitivity, &tolerances, root, draws as usize, arguments.seed);
        arguments.draws.map(simulate)
    };
    let wanted = match &arguments.wanted {
        None => None,
        Some(text) => {
            let wanted = at_observable("--wanted", text, &shown.name, shown.kind)?;
            let (costs, finest) = arguments.limits(chain, &tolerances)?;
            let wish = Wish { wanted, costs, finest };
            let allocation = allocate(&sensitivity, &tolerances, &wish).map_err(|why| {
                not_allocated(&shown.name, text, &why, model_core::budget::unit(chain, observable))
            })?;
            Some((wanted, allocation))
        }
    };
    let remaining = match (&arguments.campaign, &arguments.noise) {
        (Some(campaign), Some(noise)) => {
            let sigma = at_observable("--noise", noise, &shown.name, shown.kind)?;
            let measured = match campaign.parse::<usize>() {
                Ok(0) => {
                    return Err(Failure::Input("--campaign 0: there is nothing to measure".to_owned()));
                }
                Ok(count) if count <= 1_000_000 => {
                    Sensitivity::over(chain, observable, sizes, poses, count).map_err(input)?
                }
                Ok(_) => {
                    return Err(Failure::Input(format!("--campaign {campaign}: at most 1000000 poses")));
                }
                Err(_) => {
                    let readings = readings(chain, observable, Path::new(campaign))?;
                    Sensitivity::at(chain, observable, sizes, &readings).map_err(input)?
                }
            };
            let campaign = Campaign { sensitivity: seen(measured), sigma };
            let poses = campaign.sensitivity.poses();
            let after = after(&sensitivity, &campaign, &tolerances);
            let drawn = draw(Some(&after.root));
            Some(Remaining { after, drawn, poses, sigma })
        }
        _ => None,
    };
    Ok(Some(Designed {
        worst: worst_case(&sensitivity, &tolerances),
        drawn: draw(None),
        registered: arguments.registered,
        sensitivity,
        tolerances,
        now,
        wanted,
        remaining,
    }))
}

fn not_allocated(name: &str, wanted: &str, why: &NotAllocated, unit: &'static str) -> Failure {
    Failure::Input(match why {
        NotAllocated::Unreachable { smallest, .. } => format!(
            "--wanted {wanted}: {name} cannot be held to it; with every error at its --finest the root sum square is {}: want more than that, or make the finest sizes smaller",
            size(*smallest, unit)
        ),
        NotAllocated::Mean | NotAllocated::Nothing => format!("--wanted {wanted}, {name}: {why}"),
    })
}

/// The readings of a table of poses, SI.
fn readings(
    chain: &Chain,
    observable: ObservableId,
    path: &Path,
) -> Result<Vec<(SymbolId, Vec<f64>)>, Failure> {
    let mut table = table_files::open_kept(path, chain, Options::default(), None)?;
    let needed = readings_of(chain, observable);
    table.want(chain, &needed)?;
    let mut found: Vec<(SymbolId, Vec<f64>)> = needed.iter().map(|&id| (id, Vec::new())).collect();
    while let Some(rows) = table.next_rows()? {
        for ((_, all), (_, some)) in found.iter_mut().zip(rows.readings) {
            all.extend(some);
        }
    }
    table.doubtful().for_each(terminal::warn);
    Ok(found)
}
