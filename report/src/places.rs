//! Where objects and stations came out, as tables.

use network::{Origin, Placed, PlacedObject, PlacedStation};

use crate::residuals::Cells;

/// The files of such tables.
pub const NAMES: [&str; 2] = ["objects.csv", "stations.csv"];

type Columns<'a> = Vec<(String, Cells<'a>)>;

/// Every object, one a row; a column that none of them has is left out.
#[must_use]
pub fn objects<'a>(places: &Placed) -> Columns<'a> {
    let own = &places.objects;
    let numbers = |of: &dyn Fn(&PlacedObject) -> Option<f64>| Cells::Residuals(own.iter().map(of).collect());
    let texts = |of: &dyn Fn(&PlacedObject) -> String| Cells::Texts(own.iter().map(of).collect());
    let counts =
        |of: &dyn Fn(&PlacedObject) -> usize| Cells::Rows(own.iter().map(|own| of(own) as u64).collect());
    let place = |axis: usize| numbers(&|own| Some(own.place_m[axis]));
    let normal = |axis: usize| numbers(&|own| own.normal.map(|normal| normal[axis]));
    let sigma = |axis: usize| numbers(&|own| own.place_uncertainties_m[axis]);
    let columns = vec![
        ("object", texts(&|own| own.object.clone())),
        ("kind", texts(&|own| own.kind.to_owned())),
        ("origin", texts(&|own| told(own.origin).to_owned())),
        ("x [m]", place(0)),
        ("y [m]", place(1)),
        ("z [m]", place(2)),
        ("normal_x", normal(0)),
        ("normal_y", normal(1)),
        ("normal_z", normal(2)),
        ("offset [m]", numbers(&|own| own.offset_m)),
        ("radius [m]", numbers(&|own| own.radius_m)),
        ("x_sigma [m]", sigma(0)),
        ("y_sigma [m]", sigma(1)),
        ("z_sigma [m]", sigma(2)),
        ("normal_sigma [rad]", numbers(&|own| own.normal_uncertainty_rad)),
        ("offset_sigma [m]", numbers(&|own| own.offset_uncertainty_m)),
        ("radius_sigma [m]", numbers(&|own| own.radius_uncertainty_m)),
        ("rows", counts(&|own| own.rows)),
        ("rows_set_aside", counts(&|own| own.rows_set_aside)),
    ];
    named(columns.into_iter().filter(|(_, cells)| match cells {
        Cells::Residuals(numbers) => numbers.iter().any(Option::is_some),
        Cells::Rows(_) | Cells::Texts(_) | Cells::Numbers(_) => true,
    }))
}

/// Every station that rows name, one a row.
#[must_use]
pub fn stations<'a>(places: &Placed) -> Columns<'a> {
    let own = &places.stations;
    let numbers = |of: &dyn Fn(&PlacedStation) -> Option<f64>| Cells::Residuals(own.iter().map(of).collect());
    let texts = |of: &dyn Fn(&PlacedStation) -> String| Cells::Texts(own.iter().map(of).collect());
    let counts =
        |of: &dyn Fn(&PlacedStation) -> usize| Cells::Rows(own.iter().map(|own| of(own) as u64).collect());
    let place = |axis: usize| numbers(&|own| Some(own.place_m[axis]));
    let turn = |which: usize| numbers(&|own| Some(own.turns_rad[which]));
    let sigma = |axis: usize| numbers(&|own| own.place_uncertainties_m[axis]);
    let turn_sigma = |which: usize| numbers(&|own| own.turn_uncertainties_rad[which]);
    let columns = [
        ("station", texts(&|own| own.station.clone())),
        ("origin", texts(&|own| told(own.origin).to_owned())),
        ("x [m]", place(0)),
        ("y [m]", place(1)),
        ("z [m]", place(2)),
        ("heading [rad]", turn(2)),
        ("pitch [rad]", turn(1)),
        ("roll [rad]", turn(0)),
        ("x_sigma [m]", sigma(0)),
        ("y_sigma [m]", sigma(1)),
        ("z_sigma [m]", sigma(2)),
        ("heading_sigma [rad]", turn_sigma(2)),
        ("pitch_sigma [rad]", turn_sigma(1)),
        ("roll_sigma [rad]", turn_sigma(0)),
        ("rows", counts(&|own| own.rows)),
        ("rows_set_aside", counts(&|own| own.rows_set_aside)),
    ];
    named(columns.into_iter())
}

fn named<'a>(columns: impl Iterator<Item = (&'static str, Cells<'a>)>) -> Columns<'a> {
    columns.map(|(name, cells)| (name.to_owned(), cells)).collect()
}

fn told(origin: Origin) -> &'static str {
    match origin {
        Origin::Exact => "exact",
        Origin::Stated => "stated",
        Origin::Estimated => "estimated",
        Origin::Frame => "frame",
    }
}
