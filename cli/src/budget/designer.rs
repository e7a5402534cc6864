//! What a designer asks of one observable, answered.

use std::path::Path;

use calibration::tolerance::{
    After, Allocation, Campaign, NotAllocated, Sensitivity, Simulation, Spread, Tolerance, Wish, after,
    allocate, registered, root_sum_square, simulate, worst_case,
};
use model_core::budget::{BudgetError, Poses};
use model_core::{Chain, ObservableId, SymbolId};
use nalgebra::DMatrix;

use super::options::{DesignerArguments, at_observable, is_meant_for};
use super::size;
use crate::evaluation::readings_of;
use crate::failure::Failure;
use crate::table_files::ReadingsTable;
use crate::terminal;

/// What the tolerances come to at one observable.
pub struct Designed {
    /// The columns over the poses.
    pub sensitivity: Sensitivity,
    /// What is allowed of each error.
    pub tolerances: Vec<Tolerance>,
    /// What to expect.
    pub now: Spread,
    /// The most that any combination does, by pose.
    pub worst: Vec<f64>,
    /// What was drawn.
    pub drawn: Option<Simulation>,
    /// What is wanted, rad or m, with the sizes for it.
    pub wanted: Option<(f64, Allocation)>,
    /// What remains after a campaign.
    pub remaining: Option<Remaining>,
    /// Whether a registration took out what moves everything.
    pub registered: bool,
}

/// What remains after a campaign.
pub struct Remaining {
    /// By how much.
    pub after: After,
    /// What was drawn of it.
    pub drawn: Option<Simulation>,
    /// The poses that are measured.
    pub poses: usize,
    /// The noise of each component, rad or m.
    pub sigma: f64,
}

impl Designed {
    /// Answers for one observable; none where what is asked is not meant for it and nobody named it.
    ///
    /// # Errors
    /// The poses, the campaign or what is wanted cannot be used.
    pub fn new(
        chain: &Chain,
        observable: ObservableId,
        sizes: &[f64],
        poses: &Poses,
        arguments: &DesignerArguments,
        is_named: bool,
    ) -> Result<Option<Self>, Failure> {
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
        Ok(Some(Self {
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

    /// The errors by their share in what is expected, the largest first.
    pub fn by_share<'a>(&self, shares: &'a [f64]) -> Vec<(SymbolId, &'a f64)> {
        let mut order: Vec<(SymbolId, &f64)> =
            self.tolerances.iter().map(|tolerance| tolerance.error).zip(shares).collect();
        order.sort_by(|a, b| b.1.total_cmp(a.1));
        order
    }
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
    let mut table = ReadingsTable::open(path, chain, None)?;
    let needed = readings_of(chain, observable);
    table.want(chain, &needed)?;
    let mut found: Vec<(SymbolId, Vec<f64>)> = needed.iter().map(|&id| (id, Vec::new())).collect();
    while let Some(rows) = table.next()? {
        for ((_, all), (_, some)) in found.iter_mut().zip(rows.readings) {
            all.extend(some);
        }
    }
    table.doubtful().for_each(terminal::warn);
    Ok(found)
}
