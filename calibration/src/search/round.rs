//! One round: the declaration with the effects accepted so far is fitted, and the search starts from there.

use super::SearchError;
use super::context::{Context, Found};
use super::fitted::Fitted;
use crate::search::posed::Posed;
use crate::search::{Accepted, Class, Selection, classes, select};

/// A fit, and the search that starts from it.
pub(crate) struct Round<'a> {
    pub fitted: Fitted,
    pub posed: Posed<'a>,
    /// Effects that these data cannot tell apart.
    pub classes: Vec<Class>,
}

impl<'a> Round<'a> {
    /// At a fit.
    pub fn at(whole: &Context<'a>, fitted: Fitted) -> Result<Self, SearchError> {
        let posed = Posed::at(whole, &fitted)?;
        let classes = classes(&posed.problem);
        Ok(Self { fitted, posed, classes })
    }

    /// The class that an effect belongs to.
    pub fn class_of(&self, effect: usize) -> Option<usize> {
        self.classes.iter().position(|class| class.members.contains(&effect))
    }

    /// The classes of the accepted effects.
    pub fn accepted_classes(&self) -> Vec<usize> {
        self.fitted.found.iter().filter_map(|found| self.class_of(found.effect)).collect()
    }

    /// The linear search from the accepted effects.
    pub fn selection(&self, whole: &Context<'_>) -> Selection {
        let start: Vec<Accepted> = self
            .fitted
            .found
            .iter()
            .filter_map(|found| {
                Some(Accepted { class: self.class_of(found.effect)?, p_value: found.p_value })
            })
            .collect();
        select(&self.posed.problem, &self.classes, &start, |_| true, &whole.options)
    }

    /// What the search ends with: accepted effects keep their name and p, a new class lends its first member's.
    pub fn search(&self, whole: &Context<'_>) -> Vec<Found> {
        let kept = self.accepted_classes();
        self.selection(whole)
            .accepted
            .into_iter()
            .map(|accepted| match kept.iter().position(|&class| class == accepted.class) {
                Some(at) => self.fitted.found[at].clone(),
                None => {
                    let alike = self.classes[accepted.class].members.clone();
                    Found { effect: alike[0], p_value: accepted.p_value, alike }
                }
            })
            .collect()
    }
}
