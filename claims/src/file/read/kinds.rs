//! The kinds of claims: one line a kind, with the keys that go with it and its reader.

use super::super::table::ClaimTable;
use super::{Place, Reader, span};
use crate::checker::Claim;

/// A kind of claim: its key, its name in messages, the keys that go with it, and its reader.
pub(super) struct Kind {
    pub key: &'static str,
    pub name: &'static str,
    pub takes: &'static [&'static str],
    pub place: fn(&ClaimTable) -> Option<Place>,
    pub read: fn(&mut Reader<'_>, &ClaimTable) -> Option<Claim>,
}

pub(super) const KINDS: [Kind; 17] = [
    Kind {
        key: "components",
        name: "a closed form",
        takes: &["observable", "order", "keep", "neglect", "component", "faces"],
        place: |claim| span(&claim.components),
        read: |reader, claim| reader.closed_form(claim),
    },
    Kind {
        key: "correction",
        name: "a correction",
        takes: &["observable", "order", "keep", "neglect", "component"],
        place: |claim| span(&claim.correction),
        read: |reader, claim| reader.correction(claim),
    },
    Kind {
        key: "shows",
        name: "a formula of what is shown",
        takes: &["observable", "component", "order", "keep", "neglect"],
        place: |claim| span(&claim.shows),
        read: |reader, claim| reader.shows(claim),
    },
    Kind {
        key: "frame",
        name: "the matrix of a frame",
        takes: &["body", "in", "order", "keep", "neglect"],
        place: |claim| span(&claim.frame),
        read: |reader, claim| reader.frame(claim),
    },
    Kind {
        key: "jacobian",
        name: "a Jacobian",
        takes: &["observable", "component", "by"],
        place: |claim| span(&claim.jacobian),
        read: |reader, claim| reader.jacobian(claim),
    },
    Kind {
        key: "image",
        name: "an image point",
        takes: &["observable", "order", "keep", "neglect", "camera"],
        place: |claim| span(&claim.image),
        read: |reader, claim| reader.image(claim),
    },
    Kind {
        key: "value",
        name: "a value",
        takes: &["observable"],
        place: |claim| span(&claim.value),
        read: |reader, claim| reader.value(claim),
    },
    Kind {
        key: "neglected",
        name: "a claim of what is neglected",
        takes: &["observable", "path", "range"],
        place: |claim| span(&claim.neglected),
        read: |reader, claim| reader.neglected(claim),
    },
    Kind {
        key: "equal",
        name: "an equality of two formulas",
        takes: &[],
        place: |claim| span(&claim.equal),
        read: |reader, claim| reader.equality(claim),
    },
    Kind {
        key: "total",
        name: "a total error",
        takes: &["observable", "keep", "neglect"],
        place: |claim| span(&claim.total),
        read: |reader, claim| reader.total(claim),
    },
    Kind {
        key: "compare",
        name: "a comparison",
        takes: &["observable", "path", "range"],
        place: |claim| span(&claim.compare),
        read: |reader, claim| reader.comparison(claim),
    },
    Kind {
        key: "size",
        name: "a size",
        takes: &["observable", "path", "range"],
        place: |claim| span(&claim.size),
        read: |reader, claim| reader.size(claim),
    },
    Kind {
        key: "bound",
        name: "a bound",
        takes: &["observable", "range"],
        place: |claim| span(&claim.bound),
        read: |reader, claim| reader.bound(claim),
    },
    Kind {
        key: "count",
        name: "a count",
        takes: &[],
        place: |claim| span(&claim.count),
        read: |reader, claim| reader.count(claim),
    },
    Kind {
        key: "rank",
        name: "a rank",
        takes: &["observable"],
        place: |claim| span(&claim.rank),
        read: |reader, claim| reader.rank(claim),
    },
    Kind {
        key: "confounded",
        name: "a claim of what is confounded",
        takes: &["observable"],
        place: |claim| span(&claim.confounded),
        read: |reader, claim| reader.confounded(claim),
    },
    Kind {
        key: "separable",
        name: "a claim of what is separable",
        takes: &["observable", "keep", "neglect"],
        place: |claim| span(&claim.separable),
        read: |reader, claim| reader.separable(claim),
    },
];

/// The keys that some kinds of claims have.
pub(super) fn particulars(claim: &ClaimTable) -> [(&'static str, Option<Place>); 12] {
    [
        ("observable", span(&claim.observable)),
        ("order", span(&claim.order)),
        ("keep", span(&claim.keep)),
        ("neglect", span(&claim.neglect)),
        ("component", span(&claim.component)),
        ("faces", span(&claim.faces)),
        ("path", span(&claim.path)),
        ("range", span(&claim.range)),
        ("body", span(&claim.body)),
        ("in", span(&claim.within)),
        ("by", span(&claim.by)),
        ("camera", span(&claim.camera)),
    ]
}
