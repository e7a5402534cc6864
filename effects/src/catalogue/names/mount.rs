//! Mounts whose line of sight runs as published formulas have it: azimuth from y through x, elevation towards z.

use model_core::algebra::{AngleSum, Poly};
use model_core::{ObservableId, ObservableKind, Role, SymbolId, SymbolKind};

use crate::candidate::{Freedom, Place, Setting, seen, whole};

/// Which formulas apply.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// The lower axis is plumb; a direction is observed.
    AltAzimuth,
    /// The lower axis points to the pole; a direction is observed.
    Equatorial,
    /// The lower axis is plumb; a point at a measured range is observed.
    Scanner,
}

/// A chain recognised as one of them.
pub(super) struct Mount {
    pub kind: Kind,
    pub observable: ObservableId,
    /// Azimuth or hour angle.
    pub azimuth: SymbolId,
    /// Elevation or declination.
    pub elevation: SymbolId,
    pub range: Option<SymbolId>,
    pub latitude: Option<SymbolId>,
    /// The zenith distance, where the chain has a name for it.
    pub zenith: Option<SymbolId>,
    /// Unit vectors across, along and out, in the ground frame.
    pub frame: [[Poly; 3]; 3],
}

impl Mount {
    /// Recognises a chain of two turning joints by what it observes, as a formula.
    pub fn of(setting: &Setting<'_>) -> Option<Self> {
        let &observable = setting.observables.first()?;
        let joints = setting.turning();
        let [lower, upper] = joints.as_slice() else { return None };
        let (cos_a, sin_a) = AngleSum::symbol(lower.symbol).cos_sin();
        let (cos_e, sin_e) = AngleSum::symbol(upper.symbol).cos_sin();
        let frame = [
            [cos_a.clone(), -&sin_a, Poly::zero()],
            [-&(&sin_a * &sin_e), -&(&cos_a * &sin_e), cos_e.clone()],
            [&sin_a * &cos_e, &cos_a * &cos_e, sin_e],
        ];
        let ranges = setting.ranges();
        let range = match (setting.chain.observable(observable).kind, ranges.as_slice()) {
            (ObservableKind::Direction, _) => None,
            (ObservableKind::Point, [(_, _, range)]) => Some(*range),
            (ObservableKind::Point, _) => return None,
        };
        let length = range.map_or_else(Poly::one, Poly::symbol);
        let out = |axis: usize| &frame[2][axis] * &length;
        (observed(setting, observable)? == [out(0), out(1), out(2)]).then_some(())?;
        let plumb = setting.chain.gravity == [Poly::zero(), Poly::zero(), whole(-1)];
        let latitude = latitude(setting);
        let kind = match (plumb, range, latitude) {
            (true, None, _) => Kind::AltAzimuth,
            (true, Some(_), _) => Kind::Scanner,
            (false, None, Some(_)) => Kind::Equatorial,
            _ => return None,
        };
        let (azimuth, elevation) = (lower.symbol, upper.symbol);
        let zenith = setting.chain.sight_angle_of(observable).map(|angle| angle.symbol);
        Some(Self { kind, observable, azimuth, elevation, range, latitude, zenith, frame })
    }
}

/// What is observed, in the ground frame.
fn observed(setting: &Setting<'_>, observable: ObservableId) -> Option<[Poly; 3]> {
    let shown = setting.chain.observable(observable);
    if shown.frame.is_some() || shown.is_orientation() || shown.is_image() {
        return None;
    }
    let &body = setting.chain.path(shown.body).first()?;
    let place = Place { body, role: Role::PositionError, freedom: Freedom::ALL[0] };
    let seen = seen::observed(setting, observable, place)?;
    let component = |axis: usize| {
        let mut unit = [Poly::zero(), Poly::zero(), Poly::zero()];
        unit[axis] = Poly::one();
        Some(seen::dot(&seen::from_ground(setting, &unit, place)?, &seen))
    };
    Some([component(0)?, component(1)?, component(2)?])
}

/// The constant φ if gravity is (0, −cos φ, −sin φ).
fn latitude(setting: &Setting<'_>) -> Option<SymbolId> {
    let constants = setting.chain.symbols_of(SymbolKind::Constant);
    constants.into_iter().find(|&constant| {
        let (cosine, sine) = AngleSum::symbol(constant).cos_sin();
        setting.chain.gravity == [Poly::zero(), -&cosine, -&sine]
    })
}
