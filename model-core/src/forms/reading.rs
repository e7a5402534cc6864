//! Readings by degree in the errors: what a declaration implies of azimuths, elevations and ranges, derived from the exact
//! vector.
//!
//! With x + iy for the two components across an axis, ΔA is the imaginary part of log((x₁ + iy₁)/(x₀ + iy₀)), a power series
//! in the errors; so is ΔE with the distance from the axis and the height in their place, and that distance is a root of
//! 1 + q. The part of degree k of a series stands over the k-th power of its base, which is one where the algebra can carry
//! the division out.

use crate::algebra::{Fraction, Poly, Rational};
use crate::chain::reading::{Measures, Reading, SignedAxis};

/// The error of a reading up to an order in the errors.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadSeries {
    /// The error of the reading: radians or metres.
    pub value: Fraction,
    /// What has to be positive for this to be right, numbers apart: roots of squares that the form has a sign for.
    pub positive: Vec<Poly>,
}

/// Why a reading has no such form.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum NoSeries {
    /// A root stands in it that is no canonical form.
    Root,
    /// It is no smooth function of the errors where they are zero.
    NotSmooth,
    /// It is an image point.
    Image,
}

/// The error of a reading of a vector that is given by degree in the errors, from 0 to the order.
pub(super) fn read(reading: &Reading, parts: &[[Poly; 3]]) -> Result<ReadSeries, NoSeries> {
    let vector = Vector { parts };
    match reading.measures {
        Measures::Component(axis) => Ok(ReadSeries {
            value: Fraction::whole(sum(parts.iter().skip(1).map(|part| part[axis.index()].clone()))),
            positive: Vec::new(),
        }),
        Measures::Azimuth { zero, through } => Ok(vector.azimuth(zero, through)?.finish(&[])),
        Measures::CrossElevation { zero, through } => vector.cross_elevation(zero, through),
        Measures::Elevation { up } => vector.elevation(up),
        Measures::ZenithDistance { up } => {
            let elevation = vector.elevation(up)?;
            Ok(ReadSeries { value: elevation.value.negated(), ..elevation })
        }
        Measures::Range => vector.range(),
        Measures::OffAxis => Err(NoSeries::NotSmooth),
        Measures::Image(_) => Err(NoSeries::Image),
        Measures::Rotation(_) => unreachable!("how a body is turned is read of its three axes"),
    }
}

/// The small rotation vector of a body, whose three axes are given by degree in the errors, from 0 to the order.
///
/// Source: as in [`crate::exact`], ½ Σ n × d is the axis times sin θ; θ = sin θ + sin³θ/6 up to third order.
pub(super) fn rotation(axes: &[Vec<[Poly; 3]>; 3]) -> [Poly; 3] {
    let order = axes[0].len() - 1;
    let sine = |degree: usize| -> [Poly; 3] {
        std::array::from_fn(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let crossed = axes.iter().map(|parts| {
                let (nominal, error) = (&parts[0], &parts[degree]);
                &(&nominal[j] * &error[k]) - &(&nominal[k] * &error[j])
            });
            sum(crossed).scale(&Rational::half())
        })
    };
    let sines: Vec<[Poly; 3]> = (1..=order).map(sine).collect();
    let mut total: [Poly; 3] = std::array::from_fn(|i| sum(sines.iter().map(|part| part[i].clone())));
    if order >= 3 {
        let first = &sines[0];
        let square = sum(first.iter().map(|component| component * component));
        let sixth = Rational::new(1, 6).unwrap_or_else(|| unreachable!("six is not zero"));
        for (total, first) in total.iter_mut().zip(first) {
            *total = &*total + &(first * &square).scale(&sixth);
        }
    }
    total
}

/// A vector by degree in the errors.
struct Vector<'a> {
    parts: &'a [[Poly; 3]],
}

impl Vector<'_> {
    fn order(&self) -> usize {
        self.parts.len() - 1
    }

    fn along(&self, axis: SignedAxis) -> Vec<Poly> {
        let component = |part: &[Poly; 3]| {
            let component = &part[axis.axis.index()];
            if axis.is_negative { -component } else { component.clone() }
        };
        self.parts.iter().map(component).collect()
    }

    fn azimuth(&self, zero: SignedAxis, through: SignedAxis) -> Result<Series, NoSeries> {
        let (a, b) = (self.along(zero), self.along(through));
        let square = self.square_across(zero, through);
        if square.is_zero() {
            return Err(NoSeries::NotSmooth);
        }
        let divisor = Divisor::of(&square);
        let turn: Vec<[Poly; 2]> = (0..=self.order())
            .map(|k| {
                if k == 0 {
                    return [Poly::zero(), Poly::zero()];
                }
                let stretch = &(&a[0] * &a[k]) + &(&b[0] * &b[k]);
                let turn = &(&a[0] * &b[k]) - &(&b[0] * &a[k]);
                [stretch, turn].map(|part| divisor.divide(&part, k))
            })
            .collect();
        let turned = logarithm(&turn, &Poly::one());
        Ok(Series { parts: turned.into_iter().map(|[_, turn]| turn).collect(), divisors: vec![divisor] })
    }

    fn cross_elevation(&self, zero: SignedAxis, through: SignedAxis) -> Result<ReadSeries, NoSeries> {
        let azimuth = self.azimuth(zero, through)?;
        let across = root(&self.square_across(zero, through))?;
        let length = root(&self.square())?;
        let mut read = azimuth.finish(std::slice::from_ref(&across));
        // A length that no error and no joint changes is a constant or measured.
        let over = Fraction::new(Poly::one(), length.clone()).ok_or(NoSeries::Root)?;
        read.value = read.value.product_of_any_size(&over);
        read.positive.push(length);
        Ok(read.without_numbers())
    }

    fn elevation(&self, up: SignedAxis) -> Result<ReadSeries, NoSeries> {
        let height = self.along(up);
        let [a, b] = [1, 2].map(|next| (up.axis.index() + next) % 3);
        let square = sum([a, b].map(|axis| &self.parts[0][axis] * &self.parts[0][axis]));
        let across = root(&square)?;
        let near = Divisor::of(&square);
        let far = Divisor::of(&self.square());
        let stretch = self.stretch(&[a, b], &near);
        let turn: Vec<[Poly; 2]> = (0..=self.order())
            .map(|k| {
                if k == 0 {
                    return [Poly::zero(), Poly::zero()];
                }
                // Over the base of the near divisor to the power k, as the stretch is.
                let rise = &height[k] * &power(&near.rest, k);
                let re = &(&square * &stretch[k]) + &(&height[0] * &rise);
                let im = &rise - &(&height[0] * &stretch[k]);
                [re, im].map(|part| far.divide(&part, k))
            })
            .collect();
        // The imaginary parts are multiples of the distance from the axis, whose square is known.
        let turned = logarithm(&turn, &square);
        let parts = turned.into_iter().map(|[_, turn]| turn).collect();
        Ok(Series { parts, divisors: vec![near, far] }.finish(&[across]))
    }

    fn range(&self) -> Result<ReadSeries, NoSeries> {
        let square = self.square();
        let length = root(&square)?;
        let divisor = Divisor::of(&square);
        let parts = self.stretch(&[0, 1, 2], &divisor);
        Ok(Series { parts, divisors: vec![divisor] }.finish(&[length]))
    }

    /// |v₁|/|v₀| − 1 for the part of the vector along some axes: √(1 + q) − 1 = q/2 − q²/8 + q³/16.
    fn stretch(&self, axes: &[usize], divisor: &Divisor) -> Vec<Poly> {
        let order = self.order();
        let q: Vec<Poly> = (0..=order)
            .map(|k| {
                if k == 0 {
                    return Poly::zero();
                }
                let products = axes
                    .iter()
                    .flat_map(|&axis| (0..=k).map(move |i| &self.parts[i][axis] * &self.parts[k - i][axis]));
                divisor.divide(&sum(products), k)
            })
            .collect();
        let coefficients = [(1, 2), (-1, 8), (1, 16)];
        let mut total = vec![Poly::zero(); order + 1];
        let mut power = q.clone();
        for (index, coefficient) in coefficients.iter().take(order).enumerate() {
            if index > 0 {
                power = product(&power, &q);
            }
            add(&mut total, &power, *coefficient);
        }
        total
    }

    fn square(&self) -> Poly {
        sum(self.parts[0].iter().map(|component| component * component))
    }

    fn square_across(&self, one: SignedAxis, other: SignedAxis) -> Poly {
        sum([one, other].map(|axis| {
            let component = &self.parts[0][axis.axis.index()];
            component * component
        }))
    }
}

/// A series by degree, the part of degree k over the k-th power of the rests of all divisors.
struct Series {
    parts: Vec<Poly>,
    divisors: Vec<Divisor>,
}

impl Series {
    /// All degrees together, times some roots: where a root's own square is divided by, √D/Dⁿ is 1/(√D Dⁿ⁻¹).
    fn finish(&self, roots: &[Poly]) -> ReadSeries {
        let order = self.parts.len() - 1;
        let base = self.divisors.iter().fold(Poly::one(), |base, divisor| &base * &divisor.rest);
        let mut above = sum(self.parts.iter().enumerate().map(|(k, part)| part * &power(&base, order - k)));
        let mut divided: Vec<bool> = vec![false; roots.len()];
        let mut below = Poly::one();
        for divisor in &self.divisors {
            let own =
                roots.iter().position(|root| root * root == divisor.rest && divisor.rest != Poly::one());
            let exponent = match own {
                Some(at) => {
                    below = &below * &roots[at];
                    divided[at] = true;
                    order - 1
                }
                None => order,
            };
            below = &below * &power(&divisor.rest, exponent);
        }
        for (root, _) in roots.iter().zip(divided).filter(|(_, divided)| !divided) {
            above = &above * root;
        }
        match Fraction::new(above, below) {
            Some(value) => ReadSeries { value, positive: roots.to_vec() }.without_numbers(),
            None => unreachable!("a length that is zero has been refused"),
        }
    }
}

impl ReadSeries {
    fn without_numbers(mut self) -> Self {
        self.positive.retain(|root| root.as_constant().is_none());
        for root in &mut self.positive {
            // What is a positive number of times as large is as positive.
            let first = root.terms().next().and_then(|term| term.coefficient.abs().recip());
            *root = root.scale(&first.unwrap_or(Rational::ONE));
        }
        self.positive.dedup();
        self
    }
}

/// A polynomial to divide by: `1/p = inverse/rest`, with a rest of one where the division can be carried out.
struct Divisor {
    inverse: Poly,
    rest: Poly,
}

impl Divisor {
    fn of(square: &Poly) -> Self {
        let content = square.monomial_content();
        let waves = square.without_monomial(&content);
        let inverse = waves.recip().or_else(|| {
            let inverse = waves.square_root()?.recip()?;
            Some(&inverse * &inverse)
        });
        match inverse {
            Some(inverse) => {
                let rest = content.iter().fold(Poly::one(), |product, &(symbol, n)| {
                    (0..n).fold(product, |product, _| &product * &Poly::symbol(symbol))
                });
                Self { inverse, rest }
            }
            None => Self { inverse: Poly::one(), rest: square.clone() },
        }
    }

    /// A part of degree `k`, once divided, over the k-th power of the rest.
    fn divide(&self, part: &Poly, k: usize) -> Poly {
        &(part * &self.inverse) * &power(&self.rest, k - 1)
    }
}

fn root(square: &Poly) -> Result<Poly, NoSeries> {
    if square.is_zero() {
        return Err(NoSeries::NotSmooth);
    }
    square.square_root().ok_or(NoSeries::Root)
}

/// log(1 + w) = w − w²/2 + w³/3 of a complex series without constant part; the unit of the imaginary parts has the square
/// `−square`.
fn logarithm(w: &[[Poly; 2]], square: &Poly) -> Vec<[Poly; 2]> {
    let order = w.len() - 1;
    let split = |part: usize| -> Vec<Poly> { w.iter().map(|both| both[part].clone()).collect() };
    let (re, im) = (split(0), split(1));
    let (mut power_re, mut power_im) = (re.clone(), im.clone());
    let mut total = [vec![Poly::zero(); order + 1], vec![Poly::zero(); order + 1]];
    for n in 1..=order {
        if n > 1 {
            let crossed: Vec<Poly> = product(&power_im, &im).iter().map(|part| part * square).collect();
            let straight = product(&power_re, &re);
            let next_re =
                straight.iter().zip(&crossed).map(|(straight, crossed)| straight - crossed).collect();
            let (one, other) = (product(&power_re, &im), product(&power_im, &re));
            power_im = one.iter().zip(&other).map(|(one, other)| one + other).collect();
            power_re = next_re;
        }
        let n = i64::try_from(n).unwrap_or_else(|_| unreachable!("orders are small"));
        let coefficient = (if n % 2 == 1 { 1 } else { -1 }, n);
        add(&mut total[0], &power_re, coefficient);
        add(&mut total[1], &power_im, coefficient);
    }
    let [re, im] = total;
    re.into_iter().zip(im).map(|(re, im)| [re, im]).collect()
}

fn add(total: &mut [Poly], part: &[Poly], (above, below): (i64, i64)) {
    let factor =
        Rational::new(above, below).unwrap_or_else(|| unreachable!("no coefficient stands over zero"));
    for (total, part) in total.iter_mut().zip(part) {
        *total = &*total + &part.scale(&factor);
    }
}

/// The product of two series, as far as they go.
fn product(a: &[Poly], b: &[Poly]) -> Vec<Poly> {
    (0..a.len()).map(|k| sum((0..=k).map(|i| &a[i] * &b[k - i]))).collect()
}

fn power(base: &Poly, exponent: usize) -> Poly {
    (0..exponent).fold(Poly::one(), |product, _| &product * base)
}

fn sum(parts: impl IntoIterator<Item = Poly>) -> Poly {
    parts.into_iter().fold(Poly::zero(), |sum, part| &sum + &part)
}
