//! Exact division by a polynomial in symbols, where it leaves nothing.

use super::atom::Atom;
use super::poly::Poly;

/// Terms of the quotient at which a division gives up.
const LONGEST: usize = 2000;

impl Poly {
    /// This over a polynomial of powers of symbols alone, if that divides it; `None` if it does not, or if the quotient is
    /// unreasonably long.
    #[must_use]
    pub fn exact_quotient(&self, divisor: &Self) -> Option<Self> {
        if divisor.atoms.iter().any(|atom| !atom.is_power()) {
            return None;
        }
        let head = divisor.terms.first()?;
        let inverse = head.coefficient.recip()?;
        let mut left = self.clone();
        let mut quotient = Self::zero();
        while let Some(first) = left.terms.first() {
            if quotient.len() == LONGEST {
                return None;
            }
            // The order of terms is a monomial order: the first term of a product is the product of the first terms.
            let key = monomial_quotient(left.key(0), divisor.key(0))?;
            let mut part = Self::zero();
            part.push(&first.coefficient * &inverse, &key);
            left = &left - &(&part * divisor);
            quotient.push(part.terms.remove(0).coefficient, &key);
        }
        Some(quotient.normalised())
    }
}

/// A product of atoms over one of powers.
fn monomial_quotient(above: &[Atom], below: &[Atom]) -> Option<Vec<Atom>> {
    let mut result = Vec::with_capacity(above.len());
    let mut divided = 0;
    for &atom in above {
        match below.iter().find(|other| atom.meets(**other)) {
            None => result.push(atom),
            Some(other) => {
                divided += 1;
                let power = atom.number().checked_sub(other.number())?;
                if power > 0 {
                    result.push(Atom::power(atom.symbol(), power));
                }
            }
        }
    }
    (divided == below.len()).then_some(result)
}
