//! The columns of `[observed]`: which they are, what they measure, and what they are called where the study does not say.

use model_core::{Axis, Chain, ObservableId, ObservableKind, Quantity};
use toml::Spanned;

use super::column_plan::{ColumnPlan, column_plan};
use super::mistakes::{Outcome, every, mistake};
use super::orientation::{self, Form};
use super::shown;
use super::written::{Column, Kind, Observed};
use observe::Measure;

/// What a source observes, and in which columns.
pub(super) struct ObservedColumns {
    pub measure: Measure,
    /// In their order.
    pub columns: Vec<ColumnPlan>,
    /// The key of each in `[observed]`.
    pub keys: Vec<&'static str>,
    /// How an orientation is written, where one is observed.
    pub orientation: Option<Form>,
}

/// The columns of `[observed]` in their order, and what they measure.
pub(super) fn observed_columns(
    chain: &Chain,
    id: ObservableId,
    written: &Spanned<Observed>,
) -> Outcome<ObservedColumns> {
    let (observed, place) = (written.get_ref(), written.span());
    let observable = chain.observable(id);
    let xyz = [("x", &observed.x), ("y", &observed.y), ("z", &observed.z)];
    let (azimuth, elevation) = if observed.ha.is_some() || observed.dec.is_some() {
        (("ha", &observed.ha), ("dec", &observed.dec))
    } else {
        (("azimuth", &observed.azimuth), ("elevation", &observed.elevation))
    };
    // An observable that shows an azimuth and an elevation has a column of its own name for each.
    let has_pair = !observable.is_vector() && observable.shown.len() == 2;
    let only_azimuth = azimuth.1.is_some() && elevation.1.is_none() && !has_pair;
    let mut orientation = None;
    let of_object = || match observed.kind.of_object(observed.radius.is_some()) {
        Some(measure) => measure,
        None => unreachable!("rows of this kind observe an object"),
    };
    let (measure, quantity, keys) = match observed.kind {
        Kind::Direction => (Measure::Direction, Quantity::Number, xyz.to_vec()),
        Kind::Point => (Measure::Point, Quantity::Length, xyz.to_vec()),
        Kind::Spherical if only_azimuth => (Measure::Azimuth, Quantity::Angle, vec![azimuth]),
        Kind::Spherical => (Measure::Direction, Quantity::Angle, vec![azimuth, elevation]),
        Kind::Offset => {
            let keys = vec![("cross", &observed.cross), ("along", &observed.along)];
            (Measure::Direction, Quantity::Angle, keys)
        }
        Kind::Range => (Measure::Range, Quantity::Length, vec![("range", &observed.range)]),
        Kind::Plane | Kind::Target | Kind::Fixed => (of_object(), Quantity::Length, Vec::new()),
        Kind::Circle | Kind::Sphere => {
            let radius = [("radius", &observed.radius)].into_iter().filter(|(_, own)| own.is_some());
            (of_object(), Quantity::Length, radius.collect())
        }
        Kind::Wire | Kind::Distance => (of_object(), Quantity::Length, vec![("length", &observed.length)]),
        Kind::Sight if observable.kind == ObservableKind::Point => {
            (Measure::Beam, Quantity::Angle, Vec::new())
        }
        Kind::Sight => (of_object(), Quantity::Angle, Vec::new()),
        Kind::Orientation => {
            let (form, keys) = orientation::form(observed, &place)?;
            orientation = Some(form);
            (Measure::Orientation, form.quantity(), keys)
        }
    };
    let unread = observed
        .columns()
        .into_iter()
        .find(|(key, column)| column.is_some() && keys.iter().all(|(read, _)| read != key));
    if let Some((key, _)) = unread {
        let read: Vec<String> = keys.iter().map(|(key, _)| format!("`{key}`")).collect();
        let help = if read.is_empty() {
            "leave it out, or write another kind".to_owned()
        } else {
            format!("it reads {}: leave the other out, or write another kind", read.join(", "))
        };
        return Err(mistake(place, format!("`{key}` is no column of this kind"), help));
    }
    // What `simulate` and `eval` write needs no naming.
    let of_its_own = |name: String| ColumnPlan::declared(name, quantity);
    let plan = |(key, column): (&str, &Option<Column>)| match column {
        Some(column) => column_plan(column, quantity, &place, false),
        None if matches!(orientation, None | Some(Form::FromDesign)) && is_of_vector(key) => {
            Ok(of_its_own(format!("{}_{key}", observable.name)))
        }
        None if !observable.is_vector() && orientation.is_none() => {
            let place = if matches!(key, "elevation" | "dec") { Axis::Y } else { Axis::X };
            Ok(of_its_own(shown::column(observable, place)))
        }
        None => {
            let unit = if quantity == Quantity::Number { "" } else { ", unit = \"…\"" };
            let help = format!("write `{key} = {{ column = \"…\"{unit} }}`");
            Err(mistake(place.clone(), format!("no column is named for `{key}`"), help))
        }
    };
    let written: Vec<&'static str> = keys.iter().map(|(key, _)| *key).collect();
    let columns = every(keys.into_iter().map(plan))?;
    Ok(ObservedColumns { measure, columns, keys: written, orientation })
}

/// Whether a key is a component, whose column `simulate` and `eval` call by the observable and the key.
fn is_of_vector(key: &str) -> bool {
    matches!(key, "x" | "y" | "z" | "rotation_x" | "rotation_y" | "rotation_z")
}
