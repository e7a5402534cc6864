//! The checked chain: what a declaration means, once every rule of the language holds.
//!
//! It has no places in a source text; those stay in [`crate::syntax`].

pub mod image;
pub mod reading;
pub mod sight;

use std::borrow::Cow;

use crate::algebra::Poly;
use crate::ramp::Ramp;
use crate::symbol::{Symbol, SymbolId, SymbolKind};
use image::Image;
use reading::Reading;
use sight::{Bend, SightAngle};

/// A body of one chain: an index into [`Chain::bodies`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct BodyId(pub u16);

/// An observable of one chain: an index into [`Chain::observables`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ObservableId(pub u16);

/// An instrument: bodies hung on each other from the ground up, and what it shows.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    /// The declared name: `MobileLidar`.
    pub name: String,
    /// Documentation from the `///` lines above the declaration.
    pub documentation: String,
    /// Every symbol in order of declaration or first use; the first is π.
    pub symbols: Vec<Symbol>,
    /// Bodies, each after its lower body.
    pub bodies: Vec<Body>,
    /// Observables in order of declaration.
    pub observables: Vec<Observable>,
    /// The ramps that amounts use, in order; each is a symbol of its own.
    pub ramps: Vec<Ramp>,
    /// The angles between directions and up that it has names for.
    pub sight_angles: Vec<SightAngle>,
    /// Where down is, in the ground frame; need not be of length one. −z unless declared.
    pub gravity: [Poly; 3],
}

/// A rigid part of the instrument.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    /// The declared name: `middle`.
    pub name: String,
    /// Documentation from the `///` lines above the body.
    pub documentation: String,
    /// The body it hangs on; `None` is the ground.
    pub lower: Option<BodyId>,
    /// Its elementary transforms, multiplied left to right.
    pub factors: Vec<Factor>,
}

/// One elementary transform of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct Factor {
    /// What it is for.
    pub role: Role,
    /// Rotation or shift.
    pub kind: TransformKind,
    /// About or along which axis.
    pub axis: Axis,
    /// By how much: rad for rotations, m for shifts.
    pub amount: Poly,
    /// Documentation of the factor, or of its group.
    pub documentation: String,
}

/// What a factor is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Role {
    /// Where the body sits on its lower body, by design.
    Position,
    /// How it was assembled otherwise.
    PositionError,
    /// How a joint moves it.
    Motion,
    /// How the motion differs from that.
    MotionError,
}

/// The two kinds of elementary transform.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum TransformKind {
    /// `Rx Ry Rz`: rotation about an axis, right-handed, rad.
    Rotation,
    /// `Tx Ty Tz`: shift along an axis, m.
    Translation,
}

/// A coordinate axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Axis {
    /// The x axis.
    X,
    /// The y axis.
    Y,
    /// The z axis.
    Z,
}

impl Axis {
    /// 0, 1 or 2.
    #[must_use]
    pub fn index(self) -> usize {
        self as usize
    }
}

impl std::fmt::Display for Axis {
    /// `x`, `y` or `z`.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(["x", "y", "z"][self.index()])
    }
}

/// What an instrument shows: a vector of one body, in the ground frame or in that of another body, and which numbers of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Observable {
    /// The declared name: `pointing`.
    pub name: String,
    /// Documentation from the `///` lines above it.
    pub documentation: String,
    /// A direction or a point.
    pub kind: ObservableKind,
    /// Its components in the frame of `body`; amounts of constants and inputs. Those of an image point are in that of `frame`.
    pub components: [Poly; 3],
    /// The body that carries it; the camera that sees an image point.
    pub body: BodyId,
    /// The body in whose frame it is seen, or to which an image point is fixed; `None` is the ground.
    pub frame: Option<BodyId>,
    /// The numbers that it shows of its vector, one to three; the components x, y, z unless the declaration says otherwise.
    pub shown: Vec<Reading>,
    /// The camera, where an image point is observed.
    pub image: Option<Box<Image>>,
    /// How the line of sight is bent on its way to the target.
    pub bend: Option<Bend>,
}

/// One elementary transform on the way to an observable.
#[derive(Debug, Clone, PartialEq)]
pub struct Passed<'a> {
    /// The body that it belongs to.
    pub body: BodyId,
    /// The transform; the opposite one of the declaration's on the way out of the frame of a body.
    pub factor: Cow<'a, Factor>,
    /// Whether it is the opposite one.
    pub is_reversed: bool,
}

/// Whether an observable is moved by shifts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ObservableKind {
    /// A direction (homogeneous 0): rotations alone move it; no unit.
    Direction,
    /// A point (homogeneous 1): in metres. A point at a measured range is a point with an input in it.
    Point,
}

impl Chain {
    /// The symbol behind an id.
    #[must_use]
    pub fn symbol(&self, id: SymbolId) -> &Symbol {
        &self.symbols[id.index()]
    }

    /// The id of a declared name.
    #[must_use]
    pub fn find_symbol(&self, name: &str) -> Option<SymbolId> {
        let index = self.symbols.iter().position(|symbol| symbol.name == name)?;
        u16::try_from(index).ok().map(SymbolId)
    }

    /// Every symbol of one kind, in order.
    pub fn symbols_of(&self, kind: SymbolKind) -> impl Iterator<Item = SymbolId> + '_ {
        (0u16..)
            .zip(&self.symbols)
            .filter(move |(_, symbol)| symbol.kind == kind)
            .map(|(index, _)| SymbolId(index))
    }

    /// The body behind an id.
    #[must_use]
    pub fn body(&self, id: BodyId) -> &Body {
        &self.bodies[usize::from(id.0)]
    }

    /// The observable behind an id.
    #[must_use]
    pub fn observable(&self, id: ObservableId) -> &Observable {
        &self.observables[usize::from(id.0)]
    }

    /// The id of a declared observable.
    #[must_use]
    pub fn find_observable(&self, name: &str) -> Option<ObservableId> {
        let index = self.observables.iter().position(|observable| observable.name == name)?;
        u16::try_from(index).ok().map(ObservableId)
    }

    /// Every factor of every body, then those that bend lines of sight.
    pub fn factors(&self) -> impl Iterator<Item = &Factor> {
        let bends = self.observables.iter().filter_map(|observable| observable.bend.as_ref());
        self.bodies.iter().flat_map(|body| &body.factors).chain(bends.flat_map(|bend| &bend.factors))
    }

    /// The same, to be changed.
    pub fn factors_mut(&mut self) -> impl Iterator<Item = &mut Factor> {
        let bends = self.observables.iter_mut().filter_map(|observable| observable.bend.as_mut());
        let bodies = self.bodies.iter_mut().flat_map(|body| &mut body.factors);
        bodies.chain(bends.flat_map(|bend| &mut bend.factors))
    }

    /// The bodies from the ground up to `body`, that one included.
    #[must_use]
    pub fn path(&self, body: BodyId) -> Vec<BodyId> {
        let mut path: Vec<BodyId> = std::iter::successors(Some(body), |&id| self.body(id).lower).collect();
        path.reverse();
        path
    }

    /// Every transform on the way from the frame that an observable is seen in to the body that carries it, in the order
    /// they multiply; behind them what bends the line of sight. Bodies that both hang on turn both alike, and are not on the way.
    #[must_use]
    pub fn way(&self, observable: ObservableId) -> Vec<Passed<'_>> {
        let observable = self.observable(observable);
        let (mut up, mut down) =
            (self.path(observable.body), observable.frame.map_or_else(Vec::new, |frame| self.path(frame)));
        if observable.is_image() {
            // What carries the point is seen by the body, and not the other way round.
            std::mem::swap(&mut up, &mut down);
        }
        let common = up.iter().zip(&down).take_while(|(a, b)| a == b).count();
        let reversed = down[common..].iter().rev().flat_map(|&body| {
            let factors = self.body(body).factors.iter().rev();
            factors.map(move |factor| {
                let opposite = Factor { amount: -&factor.amount, ..factor.clone() };
                Passed { body, factor: Cow::Owned(opposite), is_reversed: true }
            })
        });
        let straight = up[common..].iter().flat_map(|&body| {
            let factors = self.body(body).factors.iter();
            factors.map(move |factor| Passed { body, factor: Cow::Borrowed(factor), is_reversed: false })
        });
        let body = observable.body;
        let bent = observable.bend.iter().flat_map(|bend| &bend.factors);
        let bent = bent.map(move |factor| Passed { body, factor: Cow::Borrowed(factor), is_reversed: false });
        reversed.chain(straight).chain(bent).collect()
    }

    /// The symbols that an observable depends on: of the transforms on its way and of its components, in order.
    #[must_use]
    pub fn symbols_of_way(&self, observable: ObservableId) -> Vec<SymbolId> {
        let way = self.way(observable);
        let amounts = way.iter().map(|passed| &passed.factor.amount);
        let mut symbols: Vec<SymbolId> = amounts
            .chain(self.observable(observable).amounts())
            .flat_map(|amount| self.symbols_in(amount))
            .collect();
        symbols.sort_unstable();
        symbols.dedup();
        symbols
    }
}

impl Observable {
    /// Whether it shows where a camera sees a point.
    #[must_use]
    pub fn is_image(&self) -> bool {
        self.image.is_some()
    }

    /// Its own amounts: the components, and the numbers of the camera.
    pub fn amounts(&self) -> impl Iterator<Item = &Poly> {
        self.components.iter().chain(self.image.iter().flat_map(|image| &image.intrinsics))
    }
}
