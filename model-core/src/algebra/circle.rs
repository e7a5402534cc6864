//! Products and derivatives of the functions of one angle, in the basis of [`Circle`].
//!
//! Fourier times Fourier is the product-to-sum rule. Anything with a pole goes through a Fourier
//! numerator over sinʲ θ cosᵏ θ, which is divided with remainder until it is a sum of basis elements.

use super::atom::Circle;
use super::rational::Rational;

/// A linear combination of basis elements; `None` is the constant 1. Elements may repeat.
pub(crate) type Combination = Vec<(Rational, Option<Circle>)>;

/// Appends `a · b` to `out`.
pub(crate) fn product(a: Circle, b: Circle, out: &mut Combination) {
    use Circle::{Cos, Sin};
    let half = Rational::half();
    match (a, b) {
        (Cos(m), Cos(n)) => {
            out.push((half.clone(), cosine(m.saturating_add(n))));
            out.push((half, cosine(m.abs_diff(n))));
        }
        (Sin(m), Sin(n)) => {
            out.push((half.clone(), cosine(m.abs_diff(n))));
            out.push((-&half, cosine(m.saturating_add(n))));
        }
        (Sin(m), Cos(n)) | (Cos(n), Sin(m)) => {
            // sin m cos n = ½ (sin (m + n) + sin (m − n))
            out.push((half.clone(), Some(Sin(m.saturating_add(n)))));
            if m > n {
                out.push((half, Some(Sin(m - n))));
            } else if n > m {
                out.push((-&half, Some(Sin(n - m))));
            }
        }
        _ => {
            let (left, right) = (Fraction::of(a), Fraction::of(b));
            left.times(&right).decompose(out);
        }
    }
}

/// Appends the derivative of `function` to `out`.
pub(crate) fn derivative(function: Circle, out: &mut Combination) {
    let whole = |k: u32| Rational::from(i64::from(k));
    match function {
        Circle::Cos(k) => out.push((-&whole(k), Some(Circle::Sin(k)))),
        Circle::Sin(k) => out.push((whole(k), Some(Circle::Cos(k)))),
        Circle::OverCos(k) => out.push((whole(k), Some(Circle::SinOverCos(k.saturating_add(1))))),
        Circle::OverSin(k) => out.push((-&whole(k), Some(Circle::CosOverSin(k.saturating_add(1))))),
        Circle::SinOverCos(k) => {
            // (sin / cosᵏ)′ = k / cosᵏ⁺¹ − (k − 1) / cosᵏ⁻¹
            out.push((whole(k), Some(Circle::OverCos(k.saturating_add(1)))));
            if k > 1 {
                out.push((-&whole(k - 1), Some(Circle::OverCos(k - 1))));
            }
        }
        Circle::CosOverSin(k) => {
            // (cos / sinᵏ)′ = (k − 1) / sinᵏ⁻¹ − k / sinᵏ⁺¹
            out.push((-&whole(k), Some(Circle::OverSin(k.saturating_add(1)))));
            if k > 1 {
                out.push((whole(k - 1), Some(Circle::OverSin(k - 1))));
            }
        }
    }
}

/// The value of a basis element at an angle in radians.
pub(crate) fn evaluate(function: Circle, angle_rad: f64) -> f64 {
    let over = |base: f64, k: u32| {
        i32::try_from(k).map_or_else(|_| base.powf(f64::from(k)), |k| base.powi(k)).recip()
    };
    let (sine, cosine) = angle_rad.sin_cos();
    match function {
        Circle::Cos(1) => cosine,
        Circle::Sin(1) => sine,
        Circle::Cos(k) => (f64::from(k) * angle_rad).cos(),
        Circle::Sin(k) => (f64::from(k) * angle_rad).sin(),
        Circle::OverCos(k) => over(cosine, k),
        Circle::SinOverCos(k) => sine * over(cosine, k),
        Circle::OverSin(k) => over(sine, k),
        Circle::CosOverSin(k) => cosine * over(sine, k),
    }
}

fn cosine(k: u32) -> Option<Circle> {
    (k > 0).then_some(Circle::Cos(k))
}

/// A Fourier numerator over `sinʲ θ cosᵏ θ`.
struct Fraction {
    numerator: Fourier,
    sine_power: usize,
    cosine_power: usize,
}

impl Fraction {
    fn of(function: Circle) -> Self {
        let (numerator, sine_power, cosine_power) = match function {
            Circle::Cos(_) | Circle::Sin(_) => (Fourier::of(function), 0, 0),
            Circle::OverCos(k) => (Fourier::one(), 0, k),
            Circle::SinOverCos(k) => (Fourier::of(Circle::Sin(1)), 0, k),
            Circle::OverSin(k) => (Fourier::one(), k, 0),
            Circle::CosOverSin(k) => (Fourier::of(Circle::Cos(1)), k, 0),
        };
        Self { numerator, sine_power: sine_power as usize, cosine_power: cosine_power as usize }
    }

    fn times(&self, other: &Self) -> Self {
        Self {
            numerator: self.numerator.times(&other.numerator),
            sine_power: self.sine_power + other.sine_power,
            cosine_power: self.cosine_power + other.cosine_power,
        }
    }

    /// Appends this as a sum of basis elements.
    fn decompose(self, out: &mut Combination) {
        let (j, k) = (self.sine_power, self.cosine_power);
        if j == 0 || k == 0 {
            return self.divide_out(out);
        }
        // Multiply by 1 = (sin² + cos²)ᵐ with m large enough that every term of the binomial loses one of
        // the two denominators.
        let m = j.div_ceil(2) + k.div_ceil(2) - 1;
        let mut binomial = Rational::ONE;
        for i in 0..=m {
            let (sines, cosines) = (2 * i, 2 * (m - i));
            let mut numerator = self.numerator.scaled(&binomial);
            for _ in 0..sines.saturating_sub(j) {
                numerator = numerator.times(&Fourier::of(Circle::Sin(1)));
            }
            for _ in 0..cosines.saturating_sub(k) {
                numerator = numerator.times(&Fourier::of(Circle::Cos(1)));
            }
            Self { numerator, sine_power: j.saturating_sub(sines), cosine_power: k.saturating_sub(cosines) }
                .divide_out(out);
            binomial = ratio(m - i, i + 1).map_or(Rational::ZERO, |factor| &binomial * &factor);
        }
    }

    /// Divides the numerator with remainder by the one base of the denominator until nothing is left.
    fn divide_out(self, out: &mut Combination) {
        let by_sine = self.sine_power > 0;
        let mut numerator = self.numerator;
        for power in (1..=self.sine_power.max(self.cosine_power)).rev() {
            let (quotient, one, other) =
                if by_sine { numerator.divide_by_sine() } else { numerator.divide_by_cosine() };
            let power = u32::try_from(power).unwrap_or(u32::MAX);
            let (pure, mixed) = if by_sine {
                (Circle::OverSin(power), Circle::CosOverSin(power))
            } else {
                (Circle::OverCos(power), Circle::SinOverCos(power))
            };
            out.extend([(one, Some(pure)), (other, Some(mixed))].into_iter().filter(|(c, _)| !c.is_zero()));
            numerator = quotient;
        }
        numerator.append_to(out);
    }
}

/// `numerator / denominator` of two counts.
fn ratio(numerator: usize, denominator: usize) -> Option<Rational> {
    Rational::new(i64::try_from(numerator).ok()?, i64::try_from(denominator).ok()?)
}

/// A Fourier polynomial of one angle: `cosines[k]` times cos kθ plus `sines[k]` times sin kθ.
struct Fourier {
    cosines: Vec<Rational>,
    sines: Vec<Rational>,
}

impl Fourier {
    fn zero(degree: usize) -> Self {
        Self { cosines: vec![Rational::ZERO; degree + 1], sines: vec![Rational::ZERO; degree + 1] }
    }

    fn one() -> Self {
        Self { cosines: vec![Rational::ONE], sines: vec![Rational::ZERO] }
    }

    /// One cosine or sine; only ever called for those.
    fn of(function: Circle) -> Self {
        match function {
            Circle::Cos(k) => {
                let mut series = Self::zero(k as usize);
                series.cosines[k as usize] = Rational::ONE;
                series
            }
            Circle::Sin(k) => {
                let mut series = Self::zero(k as usize);
                series.sines[k as usize] = Rational::ONE;
                series
            }
            _ => Self::one(),
        }
    }

    fn degree(&self) -> usize {
        self.cosines.len() - 1
    }

    fn scaled(&self, factor: &Rational) -> Self {
        let scale = |series: &[Rational]| series.iter().map(|value| value * factor).collect();
        Self { cosines: scale(&self.cosines), sines: scale(&self.sines) }
    }

    fn times(&self, other: &Self) -> Self {
        let mut result = Self::zero(self.degree() + other.degree());
        let half = Rational::half();
        let add = |target: &mut Rational, value: &Rational| *target = &*target + value;
        for m in 0..=self.degree() {
            let (cos_m, sin_m) = (&self.cosines[m] * &half, &self.sines[m] * &half);
            if cos_m.is_zero() && sin_m.is_zero() {
                continue;
            }
            for n in 0..=other.degree() {
                let (cos_n, sin_n) = (&other.cosines[n], &other.sines[n]);
                let (cc, ss) = (&cos_m * cos_n, &sin_m * sin_n);
                let (sc, cs) = (&sin_m * cos_n, &cos_m * sin_n);
                add(&mut result.cosines[m + n], &(&cc - &ss));
                add(&mut result.cosines[m.abs_diff(n)], &(&cc + &ss));
                add(&mut result.sines[m + n], &(&sc + &cs));
                // sin (m − n) from sin m cos n − cos m sin n
                let difference = &sc - &cs;
                let signed = if m >= n { difference } else { -&difference };
                add(&mut result.sines[m.abs_diff(n)], &signed);
            }
        }
        result.sines[0] = Rational::ZERO;
        result
    }

    /// `self = sin θ · quotient + one + other · cos θ`, with cos kθ ≡ cosᵏ 0 or π and sin kθ ≡ 0 there.
    fn divide_by_sine(mut self) -> (Self, Rational, Rational) {
        let mut quotient = Self::zero(self.degree().saturating_sub(1));
        for k in (2..=self.degree()).rev() {
            // cos k = cos (k − 2) − 2 sin θ sin (k − 1);  sin k = sin (k − 2) + 2 sin θ cos (k − 1)
            let (cosine, sine) = (self.cosines[k].clone(), self.sines[k].clone());
            quotient.sines[k - 1] = &quotient.sines[k - 1] - &(&cosine + &cosine);
            quotient.cosines[k - 1] = &quotient.cosines[k - 1] + &(&sine + &sine);
            self.cosines[k - 2] = &self.cosines[k - 2] + &cosine;
            if k > 2 {
                self.sines[k - 2] = &self.sines[k - 2] + &sine;
            }
        }
        let mut other = Rational::ZERO;
        if self.degree() >= 1 {
            other = self.cosines[1].clone();
            quotient.cosines[0] = &quotient.cosines[0] + &self.sines[1];
        }
        let one = self.cosines[0].clone();
        (quotient, one, other)
    }

    /// `self = cos θ · quotient + one + other · sin θ`.
    fn divide_by_cosine(mut self) -> (Self, Rational, Rational) {
        let mut quotient = Self::zero(self.degree().saturating_sub(1));
        for k in (2..=self.degree()).rev() {
            // cos k = 2 cos θ cos (k − 1) − cos (k − 2), and the same for sines
            let (cosine, sine) = (self.cosines[k].clone(), self.sines[k].clone());
            quotient.cosines[k - 1] = &quotient.cosines[k - 1] + &(&cosine + &cosine);
            quotient.sines[k - 1] = &quotient.sines[k - 1] + &(&sine + &sine);
            self.cosines[k - 2] = &self.cosines[k - 2] - &cosine;
            if k > 2 {
                self.sines[k - 2] = &self.sines[k - 2] - &sine;
            }
        }
        let mut other = Rational::ZERO;
        if self.degree() >= 1 {
            quotient.cosines[0] = &quotient.cosines[0] + &self.cosines[1];
            other = self.sines[1].clone();
        }
        let one = self.cosines[0].clone();
        (quotient, one, other)
    }

    fn append_to(self, out: &mut Combination) {
        for (k, (cosine, sine)) in (0u32..).zip(self.cosines.into_iter().zip(self.sines)) {
            if !cosine.is_zero() {
                out.push((cosine, self::cosine(k)));
            }
            if k > 0 && !sine.is_zero() {
                out.push((sine, Some(Circle::Sin(k))));
            }
        }
    }
}
