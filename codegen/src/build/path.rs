//! The way from the ground to an observable as steps, each split into what the design says and what the
//! errors add to it.

use model_core::algebra::Poly;
use model_core::image::INTRINSICS;
use model_core::readings::Reading;
use model_core::{Axis, Chain, ObservableId, ObservableKind, SymbolId, SymbolKind, TransformKind};

use super::vectors::Vector;
use crate::builder::Value;

/// An amount in two parts.
#[derive(Clone)]
pub(super) struct Split {
    /// The amount where every error is zero.
    pub(super) nominal: Poly,
    /// The rest of it.
    pub(super) error: Poly,
}

impl Split {
    fn new(chain: &Chain, amount: &Poly) -> Self {
        let nominal = amount.graded_part(|symbol| is_error(chain, symbol), 0);
        let error = amount - &nominal;
        Self { nominal, error }
    }
}

/// One factor on the way: an elementary transform by its nominal amount and one by the error, which commute.
#[derive(Clone)]
pub(super) struct Step {
    pub(super) kind: TransformKind,
    pub(super) axis: Axis,
    pub(super) amount: Split,
}

/// The way to an observable.
#[derive(Clone)]
pub(super) struct Path {
    /// From the frame that it is seen in up.
    pub(super) steps: Vec<Step>,
    pub(super) kind: ObservableKind,
    /// In the frame of the body that carries it.
    pub(super) components: [Split; 3],
    /// The camera, where an image point is observed.
    pub(super) camera: Option<Box<Camera>>,
    /// What is shown of it.
    pub(super) shown: Vec<Reading>,
}

/// The numbers of a camera.
pub(super) type Camera = [Split; INTRINSICS];

impl Path {
    /// Whether nothing but components is shown.
    pub(super) fn has_components_only(&self) -> bool {
        self.shown.iter().all(|reading| reading.component().is_some())
    }

    /// Whether it is shown how a body is turned, and no vector.
    pub(super) fn is_orientation(&self) -> bool {
        self.shown.iter().any(|reading| reading.rotation().is_some())
    }

    /// The same way to the three axes of the body.
    pub(super) fn to_axes(&self) -> [Self; 3] {
        std::array::from_fn(|axis| Self {
            components: std::array::from_fn(|i| Split {
                nominal: if i == axis { Poly::one() } else { Poly::zero() },
                error: Poly::zero(),
            }),
            ..self.clone()
        })
    }

    /// The axes of the components that are shown.
    pub(super) fn axes(&self) -> impl Iterator<Item = usize> {
        self.shown.iter().filter_map(|reading| reading.component().map(Axis::index))
    }

    /// The components of the small rotation vector that are shown.
    pub(super) fn rotations_of(&self, turned: &Vector) -> impl Iterator<Item = Value> {
        let axes = self.shown.iter().filter_map(|reading| reading.rotation().map(Axis::index));
        axes.map(|axis| turned[axis])
    }

    /// The components of a vector that are shown.
    pub(super) fn components_of(&self, vector: &Vector) -> impl Iterator<Item = Value> {
        self.axes().map(|axis| vector[axis])
    }
}

/// Shifts do not move directions, so the way of a direction has none.
pub(super) fn path(chain: &Chain, observable: ObservableId) -> Path {
    let shown = chain.observable(observable).shown.clone();
    let kind = chain.observable(observable).kind;
    let steps = chain
        .way(observable)
        .into_iter()
        .map(|passed| passed.factor)
        .filter(|factor| kind == ObservableKind::Point || factor.kind == TransformKind::Rotation)
        .map(|factor| Step {
            kind: factor.kind,
            axis: factor.axis,
            amount: Split::new(chain, &factor.amount),
        })
        .collect();
    let components =
        chain.observable(observable).components.each_ref().map(|amount| Split::new(chain, amount));
    let camera = chain.observable(observable).image.as_ref();
    let camera =
        camera.map(|image| Box::new(image.intrinsics.each_ref().map(|amount| Split::new(chain, amount))));
    Path { steps, kind, components, camera, shown }
}

pub(super) fn is_error(chain: &Chain, symbol: SymbolId) -> bool {
    chain.symbol(symbol).kind == SymbolKind::Error
}
