//! Quotients as text.

use super::{Hand, Style, by_hand};
use crate::algebra::Fraction;
use crate::chain::Chain;

impl Fraction {
    /// The formula in a style.
    #[must_use]
    pub fn show(&self, chain: &Chain, style: Style) -> String {
        self.show_by(chain, style, &Hand::default())
    }

    /// The formula in a style and in the way of a paper.
    #[must_use]
    pub fn show_by(&self, chain: &Chain, style: Style, hand: &Hand) -> String {
        let part = |poly| by_hand(poly, chain, style, hand);
        if self.is_whole() {
            return part(&self.above);
        }
        match style {
            Style::Text => format!("({})/({})", part(&self.above), part(&self.below)),
            Style::Latex => format!("\\frac{{{}}}{{{}}}", part(&self.above), part(&self.below)),
            Style::Markdown => format!("${}$", self.show_by(chain, Style::Latex, hand)),
        }
    }
}
