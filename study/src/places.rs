//! What a study says of objects and stations: where they are, how surely, and how large errors may be beside them.

use model_core::{Chain, ObservableId, Quantity, SymbolId, SymbolKind};
use nalgebra::Vector3;
use toml::Spanned;

use super::amount::{si, si_with_unit};
use super::estimated::matching;
use super::kind::{Kind, names_of, observes};
use super::mistakes::{Outcome, every, mistake};
use super::plan::SourcePlan;
use super::sights::check_sight;
use super::written::{ObjectTable, Observed, StationTable, Study, Table};
use fit::{BESIDE_OBJECTS, FitOptions};
use observe::kinds::Observes;
use observe::unknowns::{Freedom, Known, Object, Places, Pose, Shape, Station};
use tables::units::Amount;

/// Turns of a station whose shift alone has a stated uncertainty, rad: as good as not known.
const ANY_TURN_RAD: f64 = 10.0;

impl Study {
    /// Holds what is observed to the observable, and its columns to its kind.
    pub(super) fn check_observed(
        &self,
        chain: &Chain,
        id: ObservableId,
        written: &Spanned<Observed>,
    ) -> Outcome<()> {
        let (observed, place) = (written.get_ref(), written.span());
        let observable = chain.observable(id);
        let of = observes(observable);
        if !observed.kind.measures(of) {
            let what = match of {
                Observes::Orientation => "an orientation",
                Observes::Image => "an image point",
                Observes::Point => "a point",
                Observes::Direction => "a direction",
            };
            let message = format!("`{}` is {what}, which this kind does not measure", observable.name);
            let names = names_of(|kind| kind.measures(of));
            return Err(mistake(place, message, format!("write kind = {names}, or name another observable")));
        }
        check_sight(chain, id, written)?;
        let of_objects = observed.kind.observes_objects();
        if of_objects && observed.object.0.is_empty() {
            let help = "write `object = \"…\"`: the column that names the wall, the target or the socket of each row";
            return Err(mistake(place, "which object does each row observe?", help));
        }
        let names_places = !observed.object.0.is_empty() || !observed.station.0.is_empty();
        if names_places && !of_objects {
            let names = names_of(Kind::observes_objects);
            let help = format!("leave `object` and `station` out, or write kind = {names}");
            return Err(mistake(place, "what this kind observes is known row by row", help));
        }
        Ok(())
    }

    /// What is different where objects are unknown.
    pub(super) fn with_objects(&self, sources: &[SourcePlan], fit: &mut FitOptions) -> Outcome<()> {
        if !sources.iter().any(|source| source.measure.observes_object()) {
            return Ok(());
        }
        // Rows that follow each other belong to different objects: what they share is those.
        fit.noise.serial = false;
        fit.anchored = true;
        let Some(file) = &self.hold_out.file else { return Ok(()) };
        let place = self.text.find(file.as_str()).map_or(0..0, |start| start..start + file.len());
        let help = "leave `file` out: objects are held out, each estimated anew from its own rows";
        Err(mistake(place, "a second file has objects of its own, which nothing places", help))
    }

    /// Where the study says that stations and objects are.
    pub(super) fn places(&self, sources: &[SourcePlan]) -> Outcome<Places> {
        let said = self.stations.keys().chain(self.objects.keys()).next();
        if let (Some(name), true) = (said, !sources.iter().any(|source| source.measure.observes_object())) {
            let help = format!(
                "write kind = {} under [observed], or leave it out",
                names_of(Kind::observes_objects)
            );
            return Err(mistake(name.span(), "no data of this study observe objects from stations", help));
        }
        let mut shapes = sources.iter().filter_map(|source| source.measure.shape());
        if let (Some(name), true) = (self.objects.keys().next(), shapes.all(|shape| shape == Shape::Plane)) {
            let message = format!("`{}` is a plane, of which a place says nothing", name.get_ref());
            let help = "leave [objects] out; where two stations stood ([stations]) or a known length shows the scale";
            return Err(mistake(name.span(), message, help));
        }
        let (all, named): (Vec<_>, Vec<_>) =
            self.stations.iter().partition(|(name, _)| name.get_ref() == ALL);
        let level_rad = every(all.into_iter().map(|(_, table)| level_of_all(table)))?.first().copied();
        let of_station = |(name, table): (&Spanned<String>, &Spanned<StationTable>)| {
            let own = station(name.get_ref(), table)?;
            // Of a pose that is stated nothing else is.
            let level_rad = own.level_rad.or(level_rad.filter(|_| own.freedom == Freedom::Free));
            Ok(Station { level_rad, ..own })
        };
        let stations = every(named.into_iter().map(of_station));
        let objects = every(self.objects.iter().map(|(name, table)| object(name.get_ref(), table)));
        Ok(Places { stations: stations?, objects: objects?, level_rad })
    }

    /// How large errors may be that the data do not show, where objects are unknown or the study says so.
    pub(super) fn tolerances(&self, chain: &Chain, sources: &[SourcePlan]) -> Outcome<Vec<(SymbolId, f64)>> {
        let of_objects = sources.iter().any(|source| source.measure.observes_object());
        let errors = chain.symbols_of(SymbolKind::Error);
        let mut sizes: Vec<(SymbolId, f64)> =
            if of_objects { errors.map(|id| (id, BESIDE_OBJECTS)).collect() } else { Vec::new() };
        for (id, size) in self.sizes(chain, &self.fit.tolerance, "a tolerance is positive")? {
            sizes.retain(|(known, _)| *known != id);
            sizes.push((id, size));
        }
        Ok(sizes)
    }

    /// How large errors may be that are findings.
    pub(super) fn plausible(&self, chain: &Chain) -> Outcome<Vec<(SymbolId, f64)>> {
        self.sizes(chain, &self.fit.plausible, "a limit is positive")
    }

    /// Positive sizes of errors by their names or patterns, SI.
    fn sizes(&self, chain: &Chain, written: &Table<Amount>, why: &str) -> Outcome<Vec<(SymbolId, f64)>> {
        let mut sizes: Vec<(SymbolId, f64)> = Vec::new();
        // Patterns first, so that a plain name wins over them.
        let is_pattern = |name: &str| model_core::names::is_pattern(name);
        let (patterns, names): (Vec<_>, Vec<_>) =
            written.iter().partition(|(name, _)| is_pattern(name.get_ref()));
        for (name, amount) in patterns.into_iter().chain(names) {
            for id in matching(chain, name)? {
                let quantity = chain.symbol(id).quantity;
                // A pattern means those that the unit can be of.
                let value = match si(amount.get_ref(), quantity, &amount.span()) {
                    Err(_) if is_pattern(name.get_ref()) => continue,
                    value => value?,
                };
                if !(value > 0.0 && value.is_finite()) {
                    return Err(mistake(amount.span(), why, "write \"5 mm\" or \"1 mrad\""));
                }
                sizes.retain(|(known, _)| *known != id);
                sizes.push((id, value));
            }
        }
        Ok(sizes)
    }
}

/// The label that stands for every station.
const ALL: &str = "*";

type Placed<'a, T> = &'a Spanned<T>;

/// How surely every station was levelled.
fn level_of_all(written: Placed<'_, StationTable>) -> Outcome<f64> {
    match level(written)? {
        Some((level_rad, true)) => Ok(level_rad),
        _ => {
            let help =
                "write `\"*\" = { levelled = \"5 arcsec\" }`, and poses under the labels of their stations";
            Err(mistake(
                written.span(),
                "of all stations together only that they were levelled can be stated",
                help,
            ))
        }
    }
}

/// How surely a station was levelled, rad, and whether that is all that is said of it; none where nothing says that it was.
fn level(written: Placed<'_, StationTable>) -> Outcome<Option<(f64, bool)>> {
    let (table, place) = (written.get_ref(), written.span());
    let Some(levelled) = &table.levelled else { return Ok(None) };
    if table.roll.is_some() || table.pitch.is_some() {
        let help = "leave out `roll` and `pitch`: both are zero, to within what `levelled` says";
        return Err(mistake(place, "a levelled station is upright", help));
    }
    let level_rad = si_with_unit("levelled", levelled, Quantity::Angle, &place)?;
    if !(level_rad > 0.0 && level_rad.is_finite()) {
        let help = "write how far off level it may be, `levelled = \"5 arcsec\"`";
        return Err(mistake(place, "the standard uncertainty of a level is positive", help));
    }
    let places = [&table.x, &table.y, &table.z, &table.heading, &table.sigma, &table.sigma_angle];
    let is_all = places.iter().all(|amount| amount.is_none()) && !table.rough;
    if !is_all && !table.rough {
        let help = "leave `levelled` out where the pose is known; write `rough = true` where it is not, or nothing but `levelled`";
        return Err(mistake(
            place,
            "`levelled` is for a station of which no place or heading is known",
            help,
        ));
    }
    Ok(Some((level_rad, is_all)))
}

fn station(label: &str, written: Placed<'_, StationTable>) -> Outcome<Station> {
    let (table, place) = (written.get_ref(), written.span());
    let level = level(written)?;
    let level_rad = level.map(|(level_rad, _)| level_rad);
    if level.is_some_and(|(_, is_all)| is_all) {
        return Ok(Station { level_rad, ..Station::unknown(label.to_owned()) });
    }
    let needed = [("x", &table.x), ("y", &table.y), ("z", &table.z), ("heading", &table.heading)];
    if let Some((missing, _)) = needed.iter().find(|(_, amount)| amount.is_none() && !table.rough) {
        let message = format!("what is the `{missing}` of this station? Left out, it would count as zero");
        let help = "write x, y, z and heading (roll and pitch are zero where they are left out), or `rough = true` where the pose \
                    is a start alone, or `levelled` alone; leave the station out where nothing is known of it";
        return Err(mistake(place, message, help));
    }
    let of = |name: &str, amount: &Option<Amount>, quantity| {
        amount.as_ref().map_or(Ok(0.0), |amount| si_with_unit(name, amount, quantity, &place))
    };
    let length = |name, amount| of(name, amount, Quantity::Length);
    let angle = |name, amount| of(name, amount, Quantity::Angle);
    let shift = Vector3::new(length("x", &table.x)?, length("y", &table.y)?, length("z", &table.z)?);
    let turns = [("roll", &table.roll), ("pitch", &table.pitch), ("heading", &table.heading)];
    let [roll, pitch, heading] = turns.map(|(name, amount)| angle(name, amount));
    let pose = Pose::new(shift, roll?, pitch?, heading?);
    let sigma = (length("sigma", &table.sigma)?, angle("sigma_angle", &table.sigma_angle)?);
    let freedom = match (table.rough, &table.sigma, &table.sigma_angle) {
        (true, None, None) => Freedom::Free,
        (true, ..) => {
            let help = "leave out `rough`, or the uncertainties";
            return Err(mistake(place, "a rough pose is a start alone and has no uncertainty", help));
        }
        (false, None, None) => Freedom::Given,
        (false, Some(_), None) => {
            Freedom::Within { shift_m: positive(sigma.0, &place)?, turn_rad: ANY_TURN_RAD }
        }
        (false, Some(_), Some(_)) => {
            Freedom::Within { shift_m: positive(sigma.0, &place)?, turn_rad: positive(sigma.1, &place)? }
        }
        (false, None, Some(_)) => {
            let help = "write `sigma = \"1 mm\"` for its coordinates beside `sigma_angle`";
            return Err(mistake(place, "how surely are the coordinates of this station known?", help));
        }
    };
    Ok(Station { label: label.to_owned(), freedom, known: Known::Yes, pose, level_rad })
}

fn object(label: &str, written: Placed<'_, ObjectTable>) -> Outcome<Object> {
    let (table, place) = (written.get_ref(), written.span());
    let length = |name: &str, amount: &Amount| si_with_unit(name, amount, Quantity::Length, &place);
    let at = Vector3::new(length("x", &table.x)?, length("y", &table.y)?, length("z", &table.z)?);
    let freedom = match (table.rough, &table.sigma) {
        (true, None) => Freedom::Free,
        (true, Some(_)) => {
            let help = "leave out `rough` or `sigma`";
            return Err(mistake(place, "a rough place is a start alone and has no uncertainty", help));
        }
        (false, None) => Freedom::Given,
        (false, Some(sigma)) => {
            Freedom::Within { shift_m: positive(length("sigma", sigma)?, &place)?, turn_rad: ANY_TURN_RAD }
        }
    };
    Ok(Object { freedom, known: Known::Yes, place: at, ..Object::unknown(label.to_owned(), Shape::Point) })
}

fn positive(sigma: f64, place: &std::ops::Range<usize>) -> Outcome<f64> {
    if sigma > 0.0 && sigma.is_finite() {
        return Ok(sigma);
    }
    let help = "leave it out where the place is exact, or write `rough = true` where it is not known";
    Err(mistake(place.clone(), "a standard uncertainty is positive", help))
}
