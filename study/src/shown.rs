//! Observables that show angles or a range: what their columns mean for a fit, which knows vectors.
//!
//! A fit compares the vector of the observable with a measured one, so an azimuth and an elevation become a direction by
//! the convention of the declaration, and the convention is needed no more.

use std::ops::Range;

use model_core::readings::{COMPONENTS, IMAGE, Measures, ROTATION, SignedAxis};
use model_core::{Axis, Chain, Observable};
use nalgebra::Vector3;

use super::mistakes::{Outcome, mistake};
use super::written::Kind;
use observe::kinds::OfReadings;
use observe::{direction_from_spherical, spherical_of_direction};

/// Where two measured angles are zero, and which way they turn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Convention {
    zero: SignedAxis,
    through: SignedAxis,
    up: SignedAxis,
    /// Whether the second angle is counted from `up`.
    from_zenith: bool,
}

impl Convention {
    /// The direction of an azimuth and an elevation, rad, and whether that elevation is one.
    pub(crate) fn direction(&self, azimuth_rad: f64, second_rad: f64) -> (Vector3<f64>, f64) {
        let elevation = if self.from_zenith { std::f64::consts::FRAC_PI_2 - second_rad } else { second_rad };
        let along = |axis: SignedAxis| {
            let mut unit = Vector3::zeros();
            unit[axis.axis.index()] = if axis.is_negative { -1.0 } else { 1.0 };
            unit
        };
        // From y through x: the one convention of the data.
        let direction = direction_from_spherical(azimuth_rad, elevation);
        let vector =
            along(self.through) * direction.x + along(self.zero) * direction.y + along(self.up) * direction.z;
        (vector, elevation)
    }

    /// The two angles of a vector, rad, as [`Self::direction`] takes them.
    pub(crate) fn angles(&self, vector: &Vector3<f64>) -> [f64; 2] {
        let along = |axis: SignedAxis| {
            if axis.is_negative { -vector[axis.axis.index()] } else { vector[axis.axis.index()] }
        };
        let turned = Vector3::new(along(self.through), along(self.zero), along(self.up));
        let [azimuth_rad, elevation_rad] = spherical_of_direction(&turned);
        let from_zenith = std::f64::consts::FRAC_PI_2 - elevation_rad;
        [azimuth_rad, if self.from_zenith { from_zenith } else { elevation_rad }]
    }
}

/// What the two angles of an observable mean; `None` for a vector, which `[observed]` has the words for.
pub(super) fn convention(
    observable: &Observable,
    kind: Kind,
    place: &Range<usize>,
) -> Outcome<Option<Convention>> {
    let measures: Vec<Measures> = observable.shown.iter().map(|reading| reading.measures).collect();
    if observable.is_vector() {
        return Ok(None);
    }
    if observable.is_image() {
        if observable.shown == IMAGE {
            return Ok(None);
        }
        let message = format!("`{}` shows a part of an image point, which no kind measures", observable.name);
        return Err(mistake(
            place.clone(),
            message,
            "observe all of it: `image(…) of …`, without a reading before it",
        ));
    }
    if observable.is_orientation() {
        if observable.shown == ROTATION {
            return Ok(None);
        }
        let message =
            format!("`{}` shows a part of how a body is turned, which no kind measures", observable.name);
        return Err(mistake(
            place.clone(),
            message,
            "observe all of it: `orientation of …`, without a reading before it",
        ));
    }
    let shown: Vec<String> = observable.shown.iter().map(|reading| reading.written()).collect();
    let name = &observable.name;
    match (measures.as_slice(), kind.of_readings()) {
        (
            &[
                Measures::Azimuth { zero, through },
                ref second @ (Measures::Elevation { up } | Measures::ZenithDistance { up }),
            ],
            OfReadings::TwoAngles,
        ) => {
            if [zero, through].iter().any(|axis| axis.axis == up.axis) {
                let message = format!("the two angles of `{name}` are not counted about one axis");
                return Err(mistake(
                    place.clone(),
                    message,
                    "measure the elevation towards the axis of the azimuth",
                ));
            }
            let from_zenith = matches!(second, Measures::ZenithDistance { .. });
            Ok(Some(Convention { zero, through, up, from_zenith }))
        }
        ([Measures::Range], OfReadings::Range) => Ok(None),
        ([Measures::Azimuth { .. }, Measures::Elevation { .. } | Measures::ZenithDistance { .. }], _) => {
            let help = "write kind = \"spherical\", with `azimuth` and `elevation` for the two in this order";
            Err(mistake(place.clone(), format!("`{name}` shows {}", shown.join(" and ")), help))
        }
        ([Measures::Range], _) => {
            Err(mistake(place.clone(), format!("`{name}` shows a range"), "write kind = \"range\""))
        }
        _ => {
            let help = "calibrate with an azimuth and an elevation (kind = \"spherical\"), a range, or the vector itself: \
                        kind = \"direction\", \"offset\" or \"point\"";
            Err(mistake(
                place.clone(),
                format!("`{name}` shows {}, which no kind measures", shown.join(", ")),
                help,
            ))
        }
    }
}

/// The chain as fits know it: every observable shows its vector, how a body is turned, or an image point and its distance.
pub(super) fn vectors(mut chain: Chain) -> Chain {
    for observable in chain.observables.iter_mut().filter(|observable| !observable.is_orientation()) {
        observable.shown = match observable.is_image() {
            // Behind a camera nothing is seen, so a fit knows on which side a point is.
            true => [&IMAGE[..], &COMPONENTS[2..]].concat(),
            false => COMPONENTS.to_vec(),
        };
    }
    chain
}

/// The name of the column that `eval` and `simulate` write for the first or second number that an observable shows.
pub(super) fn column(observable: &Observable, place: Axis) -> String {
    format!("{}_{}", observable.name, observable.label(place.index()))
}
