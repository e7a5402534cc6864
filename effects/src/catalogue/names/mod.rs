//! Names that other fields have for effects of the catalogue: TPOINT terms, parameters of laser scanners, ISO 230-1.
//!
//! A name is published with a formula, across and along the line of sight; it belongs to every effect of a chain whose
//! first-order column is that formula up to a factor, which the algebra decides. So it holds for chains whose line of
//! sight runs as theirs does: azimuth (or hour angle) from y through x, elevation (or declination) from the xy plane
//! towards z. Signs are not part of a name: they follow each field's own conventions. Those of TPOINT are its own.

mod errors;
mod mount;
mod pointing;
mod scanner;
mod slides;
mod tpoint;

use model_core::algebra::{BasisFunction, Poly};
use model_core::{SymbolId, SymbolKind, TransformKind, syntax};

use crate::candidate::{Effect, Setting, seen};
pub use errors::names_of_errors;
pub use mount::Kind;
use mount::Mount;
pub use pointing::{PointingTerm, PointingTerms};

/// A formula that was published under a name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Published {
    /// Whose name it is: `TPOINT`.
    pub field: &'static str,
    /// `TF`
    pub name: String,
    /// `flexure of the tube`
    pub meaning: &'static str,
    /// For which instruments.
    kind: Kind,
    /// Change across the line of sight, towards growing azimuth (on the sky, or in metres); `A`, `E` and `R` are azimuth,
    /// elevation and range, `h` and `d` hour angle and declination.
    pub across: String,
    /// Along it, towards growing elevation.
    pub along: String,
    /// In range; empty where no range is measured.
    pub radial: String,
    /// What becomes of it on the other side of the pier.
    sides: Sides,
}

/// What becomes of a formula where an instrument points through the pole, or in its second face.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Sides {
    /// It is the same.
    Same,
    /// It changes its sign.
    Reversed,
    /// The language cannot say it.
    Unsaid,
}

/// A name of an effect.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Name {
    /// `TPOINT`
    pub field: &'static str,
    /// `TF`
    pub name: String,
}

impl std::fmt::Display for Name {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} {}", self.field, self.name)
    }
}

/// Every published formula, whatever the chain.
#[must_use]
pub fn published() -> Vec<Published> {
    [tpoint::alt_azimuth(), tpoint::equatorial(), scanner::additional(), scanner::nist()].concat()
}

/// The names of each of some effects, that is of any of its functions; for chains whose line of sight runs in another way
/// those of slides alone.
#[must_use]
pub fn known_names(setting: &Setting<'_>, effects: &[Effect]) -> Vec<Vec<Name>> {
    let of_slides = effects.iter().map(|effect| slides::name(setting, effect).into_iter().collect());
    let Some(mount) = Mount::of(setting) else { return of_slides.collect() };
    let shapes = shapes(&mount);
    let names_of = |effect: &Effect| {
        let own = effect.functions.iter().filter_map(|function| {
            let mut sum = [Poly::zero(), Poly::zero(), Poly::zero()];
            for place in effect.places() {
                let unit = mount.unit(setting, place)?;
                for amount in function.at(effect.place, place) {
                    for (sum, unit) in sum.iter_mut().zip(&unit) {
                        *sum = &*sum + &(unit * amount);
                    }
                }
            }
            Some(sum)
        });
        let own: Vec<Shape> = own.collect();
        let names =
            shapes.iter().filter(|(_, shape)| own.iter().any(|own| proportional(setting, own, shape)));
        names.map(|(name, _)| name.clone()).collect()
    };
    effects.iter().map(names_of).collect()
}

/// The formulas that were published for such a mount, in its symbols.
fn shapes(mount: &Mount) -> Vec<(Name, Shape)> {
    let own = published().into_iter().filter(|published| published.kind == mount.kind);
    own.filter_map(|published| {
        let shape = mount.formula(&published)?;
        Some((Name { field: published.field, name: published.name }, shape))
    })
    .collect()
}

/// A first-order change of what is observed: across, along and in range.
type Shape = [Poly; 3];

/// Whether two shapes are one another's multiples by something that no joint or input moves, and not zero.
fn proportional(setting: &Setting<'_>, a: &Shape, b: &Shape) -> bool {
    let moves = |id: SymbolId| {
        matches!(
            setting.chain.symbol(id).kind,
            SymbolKind::Joint | SymbolKind::Input | SymbolKind::Ramp | SymbolKind::SightAngle
        )
    };
    let parts = |shape: &Shape| shape.each_ref().map(|part| part.split_by(moves));
    let (a, b) = (parts(a), parts(b));
    let functions = |parts: &[Vec<(BasisFunction, Poly)>; 3]| {
        parts.each_ref().map(|part| part.iter().map(|(function, _)| function.clone()).collect::<Vec<_>>())
    };
    if functions(&a) != functions(&b) {
        return false;
    }
    let pairs: Vec<(&Poly, &Poly)> =
        a.iter().flatten().zip(b.iter().flatten()).map(|((_, a), (_, b))| (a, b)).collect();
    let Some(&(of_a, of_b)) = pairs.first() else { return false };
    pairs.iter().all(|&(a, b)| a * of_b == b * of_a)
}

impl Mount {
    /// A published formula with the chain's own symbols; `None` if the language cannot say it.
    fn formula(&self, published: &Published) -> Option<Shape> {
        let resolve = |name: &str| -> Option<SymbolId> {
            match name {
                "A" | "h" => Some(self.azimuth),
                "E" | "d" => Some(self.elevation),
                "R" => self.range,
                "latitude" => self.latitude,
                "z" => self.zenith,
                _ => None,
            }
        };
        let amount = |text: &str| {
            let expression = syntax::parse_amount(if text.is_empty() { "0" } else { text }).ok()?;
            Poly::from_expr(&expression, resolve, |_| true).ok()
        };
        Some([amount(&published.across)?, amount(&published.along)?, amount(&published.radial)?])
    }

    /// What a unit motion at a place does to what is observed.
    fn unit(&self, setting: &Setting<'_>, place: crate::candidate::Place) -> Option<Shape> {
        let axis = place.freedom.axis;
        let mut motion = [Poly::zero(), Poly::zero(), Poly::zero()];
        match place.freedom.kind {
            // The cross product of the axis and what is observed.
            TransformKind::Rotation => {
                let seen = seen::observed(setting, self.observable, place)?;
                let (a, b) = seen::others(axis);
                motion[a.index()] = -&seen[b.index()];
                motion[b.index()] = seen[a.index()].clone();
            }
            TransformKind::Translation if self.range.is_some() => motion[axis.index()] = Poly::one(),
            TransformKind::Translation => return Some(motion),
        }
        let project = |direction| Some(seen::dot(&seen::from_ground(setting, direction, place)?, &motion));
        let [across, along, radial] = &self.frame;
        let radial = if self.range.is_some() { project(radial)? } else { Poly::zero() };
        Some([project(across)?, project(along)?, radial])
    }
}
