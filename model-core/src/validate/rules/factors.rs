//! Rules about the words of factors: their roles and axes.

use proc_macro2::Span;

use super::super::Subject;
use super::super::words::{ROLES, TRANSFORMS, advice, meaning, transform};
use crate::mistake::Mistake;

pub fn role_is_known(subject: &Subject<'_>, mistakes: &mut Vec<Mistake<Span>>) {
    for group in subject.declaration.bodies().flat_map(|body| &body.groups) {
        if meaning(&ROLES, &group.role).is_none() {
            mistakes.push(
                Mistake::new(group.role.span(), format!("unknown role `{}`", group.role))
                    .with_help(advice(&ROLES, &group.role)),
            );
        }
    }
}

pub fn axis_is_known(subject: &Subject<'_>, mistakes: &mut Vec<Mistake<Span>>) {
    let groups = subject.declaration.bodies().flat_map(|body| &body.groups);
    for factor in groups.flat_map(|group| &group.factors) {
        if transform(&factor.axis).is_none() {
            mistakes.push(
                Mistake::new(factor.axis.span(), format!("unknown axis `{}`", factor.axis))
                    .with_help(advice(&TRANSFORMS, &factor.axis)),
            );
        }
    }
}
