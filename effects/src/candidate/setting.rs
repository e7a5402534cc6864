//! What the catalogue is made for: a chain, what was observed, and what was measured beside the joints.

use model_core::algebra::AngleSum;
use model_core::{
    Axis, BodyId, Chain, ObservableId, ObservableKind, Role, SymbolId, SymbolKind, TransformKind,
};

use super::{Effect, Freedom, Kind, Place, seen};

/// What the catalogue is made for.
#[derive(Debug, Clone, Copy)]
pub struct Setting<'a> {
    /// The chain as declared, with every side quantity as an input.
    pub chain: &'a Chain,
    /// What was observed.
    pub observables: &'a [ObservableId],
    /// Side quantities that effects may use.
    pub inputs: &'a [SymbolId],
    /// The highest harmonic of an encoder.
    pub harmonics: u32,
    /// Lines a turn of the encoders that the study gives them for.
    pub lines: &'a [(SymbolId, u32)],
    /// Effects that the study brings with it; they come first.
    pub own: &'a [Effect],
}

/// A joint and what it moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct JointAxis {
    /// The joint.
    pub symbol: SymbolId,
    /// The body that it moves.
    pub body: BodyId,
    /// About or along what.
    pub freedom: Freedom,
    /// Whether the body turns against the sense of the reading, as with `Rz(-azimuth)`.
    pub reversed: bool,
}

impl JointAxis {
    /// Whether it is an angle.
    #[must_use]
    pub fn turns(&self) -> bool {
        self.freedom.kind == TransformKind::Rotation
    }

    /// About or along the joint's own axis, after the motion: where an encoder's error sits.
    #[must_use]
    pub fn place(&self) -> Place {
        Place { body: self.body, role: Role::MotionError, freedom: self.freedom }
    }
}

impl Setting<'_> {
    /// Bodies that carry something observed or the frame that it is seen in, from the ground up.
    #[must_use]
    pub fn bodies(&self) -> Vec<BodyId> {
        let of = |&id: &ObservableId| {
            let observable = self.chain.observable(id);
            let ends = [Some(observable.body), observable.frame];
            ends.into_iter().flatten().flat_map(|body| self.chain.path(body))
        };
        let mut bodies: Vec<BodyId> = self.observables.iter().flat_map(of).collect();
        bodies.sort_unstable();
        bodies.dedup();
        bodies
    }

    /// Whether a small motion at a place moves anything observed.
    #[must_use]
    pub fn moves(&self, place: Place) -> bool {
        seen::moves(self, place)
    }

    /// Turns that move nothing that is observed, of bodies and of the axes that they turn about.
    #[must_use]
    pub fn unmoved(&self) -> Vec<Place> {
        let mut places = Vec::new();
        for body in self.bodies() {
            for role in [Role::PositionError, Role::MotionError] {
                places.extend(Freedom::rotations().map(|freedom| Place { body, role, freedom }));
            }
        }
        places.retain(|&place| !self.moves(place));
        places
    }

    /// Whether what is fixed to a body may change with an input: the side of the pier or the face, the direction of motion,
    /// or another quantity by which the declaration multiplies errors. Not what an accepted effect multiplies: a declaration
    /// has the same candidates before and after it was amended.
    #[must_use]
    pub fn reverses(&self, input: SymbolId) -> bool {
        match Kind::of(self, input) {
            Kind::Side | Kind::Direction(_) => return true,
            Kind::Other => {}
            _ => return false,
        }
        let errors = self.chain.bodies.iter().flat_map(|body| &body.factors);
        errors
            .filter(|factor| matches!(factor.role, Role::PositionError | Role::MotionError))
            .any(|factor| factor.amount.symbols().contains(&input))
    }

    /// Whether something observed is a direction.
    #[must_use]
    pub fn aims(&self) -> bool {
        self.observables.iter().any(|&id| {
            let observable = self.chain.observable(id);
            observable.kind == ObservableKind::Direction && !observable.is_orientation()
        })
    }

    /// Whether a joint moves a body on its lower one.
    #[must_use]
    pub fn is_moved(&self, body: BodyId) -> bool {
        self.chain.body(body).factors.iter().any(|factor| factor.role == Role::Motion)
    }

    /// The joints of the bodies observed, each with the body and the degree of freedom that it moves.
    #[must_use]
    pub fn joints(&self) -> Vec<JointAxis> {
        let mut joints = Vec::new();
        for body in self.bodies() {
            for factor in self.chain.body(body).factors.iter().filter(|f| f.role == Role::Motion) {
                let angle = AngleSum::from_poly(&seen::nominal(self, factor)).ok();
                for symbol in factor.amount.symbols() {
                    if self.chain.symbol(symbol).kind == SymbolKind::Joint {
                        let freedom = Freedom { kind: factor.kind, axis: factor.axis };
                        let multiples = angle.as_ref().map_or(&[][..], |angle| angle.multiples());
                        let reversed = multiples.iter().any(|&(id, times)| id == symbol && times < 0);
                        joints.push(JointAxis { symbol, body, freedom, reversed });
                    }
                }
            }
        }
        joints
    }

    /// The joints that turn.
    #[must_use]
    pub fn turning(&self) -> Vec<JointAxis> {
        self.joints().into_iter().filter(JointAxis::turns).collect()
    }

    /// Measured ranges: the body that observes, the axis along which it does, and the input.
    #[must_use]
    pub fn ranges(&self) -> Vec<(BodyId, Axis, SymbolId)> {
        let mut ranges = Vec::new();
        for &id in self.observables {
            let observable = self.chain.observable(id);
            if observable.is_image() {
                continue;
            }
            for (component, axis) in observable.components.iter().zip([Axis::X, Axis::Y, Axis::Z]) {
                let inputs = component.symbols().into_iter();
                let inputs = inputs.filter(|&symbol| self.chain.symbol(symbol).kind == SymbolKind::Input);
                ranges.extend(inputs.map(|input| (observable.body, axis, input)));
            }
        }
        ranges
    }

    /// The name of a symbol.
    #[must_use]
    pub fn name(&self, symbol: SymbolId) -> &str {
        &self.chain.symbol(symbol).name
    }

    /// The name of a body.
    #[must_use]
    pub fn body_name(&self, body: BodyId) -> &str {
        &self.chain.body(body).name
    }
}
