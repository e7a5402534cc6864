//! The first-order form derived as at the board: write the product, expand, drop products of errors, use the transpose, collect.
//!
//! Errors that follow each other are one group; between groups stand turns and shifts by design. Every step is compared with
//! the one before in the canonical form, and the last one with the form that is derived otherwise.

use super::{FormError, TableError, derive, error_table, nominal};
use crate::algebra::{AngleSum, Poly};
use crate::chain::{Chain, ObservableId, ObservableKind, TransformKind};

type Vector = [Poly; 3];
type Matrix = [Vector; 3];

/// A derivation in steps.
#[derive(Debug, Clone, PartialEq)]
pub struct Steps {
    /// Of which observable.
    pub observable: ObservableId,
    /// The groups of errors, from the ground.
    pub groups: Vec<Group>,
    /// What stands behind the last group.
    pub after: Vec<Elementary>,
    /// The vector without errors.
    pub nominal: Vector,
    /// What the errors add to first order: the sum of what the groups add.
    pub collected: Vector,
}

/// One turn or shift.
#[derive(Debug, Clone, PartialEq)]
pub struct Elementary {
    /// Turn or shift.
    pub kind: TransformKind,
    /// About or along which axis: 0, 1, 2.
    pub axis: usize,
    /// By how much.
    pub amount: Poly,
}

/// Errors that follow each other.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Group {
    /// The turns and shifts by design between the group before and this one.
    pub before: Vec<Elementary>,
    /// The small turns and shifts, in order.
    pub errors: Vec<Elementary>,
    /// The product of the small turns, each written as I + ε u×, multiplied out.
    pub expanded: Matrix,
    /// The same without products of errors: I + θ×.
    pub dropped: Matrix,
    /// θ, the sum of the small turns along their axes.
    pub turned: Vector,
    /// The sum of the small shifts.
    pub shifted: Vector,
    /// The vector behind the group, without errors.
    pub behind: Vector,
    /// θ × behind + shift, in the frame of the group.
    pub moved: Vector,
    /// θ in the frame that the observable is seen in: R θ.
    pub turned_outside: Vector,
    /// The vector behind the group in that frame: R behind.
    pub behind_outside: Vector,
    /// What the group adds in that frame: R (θ × behind + shift), which is R θ × R behind + R shift.
    pub added: Vector,
}

/// Derives an observable in steps.
///
/// # Errors
/// [`TableError`]: readings have no such steps, and the form must not be too large.
pub fn steps(chain: &Chain, id: ObservableId) -> Result<Steps, TableError> {
    let observable = chain.observable(id);
    if !observable.is_vector() {
        return Err(TableError::Readings(observable.name.clone()));
    }
    let form = derive(chain, id, 1)?;
    let is_point = observable.kind == ObservableKind::Point;
    let (mut groups, after) = groups(chain, id);
    let mut behind = observable.components.clone();
    carry(&mut behind, &after, is_point)?;
    for group in groups.iter_mut().rev() {
        group.add_up(chain);
        group.behind.clone_from(&behind);
        group.moved = sum(&cross(&group.turned, &group.behind), &group.shifted);
        carry(&mut behind, &group.before, is_point)?;
    }
    let mut outside = identity();
    let mut collected = Vector::default();
    for group in &mut groups {
        for one in group.before.iter().filter(|one| one.kind == TransformKind::Rotation) {
            outside = times(&outside, &rotation(one)?);
        }
        group.added = applied(&outside, &group.moved);
        group.turned_outside = applied(&outside, &group.turned);
        group.behind_outside = applied(&outside, &group.behind);
        let by_transpose =
            sum(&cross(&group.turned_outside, &group.behind_outside), &applied(&outside, &group.shifted));
        assert_same(&by_transpose, &group.added);
        collected = sum(&collected, &group.added);
    }
    let components = [0, 1, 2].map(|axis: usize| form.components[axis].above.clone());
    assert_same(&collected, &components);
    Ok(Steps { observable: id, groups, after, nominal: nominal(chain, id)?, collected })
}

/// Two steps say the same, or the derivation is wrong.
fn assert_same(one: &Vector, other: &Vector) {
    if one != other {
        unreachable!("a step of a derivation differs from the one before: {one:?} and {other:?}");
    }
}

/// The groups of errors on the way from the ground, and what stands behind the last.
fn groups(chain: &Chain, id: ObservableId) -> (Vec<Group>, Vec<Elementary>) {
    let is_error = error_table(chain);
    let is_point = chain.observable(id).kind == ObservableKind::Point;
    let mut groups: Vec<Group> = Vec::new();
    let mut group = Group::default();
    for passed in chain.way(id) {
        let factor = &passed.factor;
        if factor.kind == TransformKind::Translation && !is_point {
            continue;
        }
        let part = |order| {
            let amount = factor.amount.graded_part(|symbol| is_error[symbol.index()], order);
            (!amount.is_zero()).then(|| Elementary { kind: factor.kind, axis: factor.axis.index(), amount })
        };
        if let Some(designed) = part(0) {
            if !group.errors.is_empty() {
                groups.push(std::mem::take(&mut group));
            }
            group.before.push(designed);
        }
        group.errors.extend(part(1));
    }
    if group.errors.is_empty() {
        return (groups, group.before);
    }
    groups.push(group);
    (groups, Vec::new())
}

impl Group {
    /// Multiplies the small turns, drops products, and adds up.
    fn add_up(&mut self, chain: &Chain) {
        let is_error = error_table(chain);
        self.expanded = identity();
        for one in &self.errors {
            let sum = match one.kind {
                TransformKind::Rotation => &mut self.turned,
                TransformKind::Translation => &mut self.shifted,
            };
            sum[one.axis] = &sum[one.axis] + &one.amount;
            if one.kind == TransformKind::Rotation {
                let mut small = Vector::default();
                small[one.axis].clone_from(&one.amount);
                self.expanded = times(&self.expanded, &beside_one(&small));
            }
        }
        let below_two = |poly: &Poly| {
            let grade = |order| poly.graded_part(|symbol| is_error[symbol.index()], order);
            &grade(0) + &grade(1)
        };
        self.dropped = self.expanded.each_ref().map(|row| row.each_ref().map(below_two));
        let expected = beside_one(&self.turned);
        for (row, other) in self.dropped.iter().zip(&expected) {
            assert_same(row, other);
        }
    }
}

/// A vector through turns and shifts by design, from the device side.
fn carry(vector: &mut Vector, passed: &[Elementary], is_point: bool) -> Result<(), FormError> {
    for one in passed.iter().rev() {
        match one.kind {
            TransformKind::Rotation => *vector = applied(&rotation(one)?, vector),
            TransformKind::Translation if is_point => vector[one.axis] = &vector[one.axis] + &one.amount,
            TransformKind::Translation => {}
        }
    }
    Ok(())
}

fn rotation(one: &Elementary) -> Result<Matrix, FormError> {
    let axis = [crate::Axis::X, crate::Axis::Y, crate::Axis::Z][one.axis];
    let angle = AngleSum::from_poly(&one.amount).map_err(|error| FormError::new("", axis, error))?;
    let (cosine, sine) = angle.cos_sin();
    let (a, b) = ((one.axis + 1) % 3, (one.axis + 2) % 3);
    let mut matrix = identity();
    matrix[a][a].clone_from(&cosine);
    matrix[b][b] = cosine;
    matrix[a][b] = -&sine;
    matrix[b][a] = sine;
    Ok(matrix)
}

fn identity() -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| if i == j { Poly::one() } else { Poly::zero() }))
}

/// I + θ×.
fn beside_one([x, y, z]: &Vector) -> Matrix {
    let one = Poly::one;
    [[one(), -z, y.clone()], [z.clone(), one(), -x], [-y, x.clone(), one()]]
}

fn times(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| (0..3).fold(Poly::zero(), |sum, k| &sum + &(&a[i][k] * &b[k][j])))
    })
}

fn applied(matrix: &Matrix, vector: &Vector) -> Vector {
    matrix
        .each_ref()
        .map(|row| row.iter().zip(vector).fold(Poly::zero(), |sum, (entry, part)| &sum + &(entry * part)))
}

fn sum(a: &Vector, b: &Vector) -> Vector {
    std::array::from_fn(|axis| &a[axis] + &b[axis])
}

fn cross(a: &Vector, b: &Vector) -> Vector {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        &(&a[j] * &b[k]) - &(&a[k] * &b[j])
    })
}
