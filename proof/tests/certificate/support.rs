//! Certificates as the tests ask for them.

#![allow(clippy::expect_used, clippy::panic, reason = "a test may fail loudly")]

use claims::checker::{Checker, ClosedForm, Order, PrintedVector, errors_named};
use claims::latex::PrintedSymbols;
use model_core::ObservableId;
use proof::{Certificate, Declared, Refusal};

/// The axioms of Coq's real numbers, as `Print Assumptions` prints them below `Axioms:`.
pub const AXIOMS: [&str; 3] = [
    "ClassicalDedekindReals.sig_not_dec : forall P : Prop, {~ ~ P} + {~ P}\n",
    "ClassicalDedekindReals.sig_forall_dec\n  : forall P : nat -> Prop,\n    (forall n : nat, {P n} + {~ P n}) ->\n    \
     {n : nat | ~ P n} + {forall n : nat, P n}\n",
    "FunctionalExtensionality.functional_extensionality_dep\n  : forall (A : Type) (B : A -> Type) (f g : forall x : A, B x),\n    \
     (forall x : A, f x = g x) -> f = g\n",
];

/// What Coq's arc tangent rests on besides, and with it every statement about an angle.
pub const EXCLUDED_MIDDLE: &str = "Classical_Prop.classic : forall P : Prop, P \\/ ~ P\n";

/// The paper's chain.
pub const MOBILE_LIDAR: &str = include_str!("../../../examples/mobile-lidar/mobile-lidar.chain");
/// A mount with six errors.
pub const ALT_AZIMUTH: &str = include_str!("../../../examples/alt-azimuth/alt-azimuth.chain");

pub fn declared(text: &str) -> Declared {
    Declared::from_text(text).unwrap_or_else(|mistakes| panic!("{}", mistakes.render("chain", text)))
}

pub fn observable(declared: &Declared, name: &str) -> ObservableId {
    declared.chain().find_observable(name).expect("declared")
}

/// A claim on an observable: the errors that it keeps, and what is printed.
pub struct Claim<'a> {
    pub observable: &'a str,
    pub order: u32,
    pub keep: &'a [&'a str],
    pub components: [&'a str; 3],
}

/// Adds the verdict on a claim; whether the claim holds.
pub fn add(
    certificate: &mut Certificate<'_>,
    declared: &Declared,
    name: &str,
    claim: &Claim<'_>,
) -> Result<bool, Refusal> {
    let chain = declared.chain();
    let mut kept: Vec<_> =
        claim.keep.iter().flat_map(|pattern| errors_named(chain, pattern).expect("a pattern")).collect();
    kept.sort_unstable();
    kept.dedup();
    let printed = PrintedVector::read(chain, &PrintedSymbols::of_chain(chain), &claim.components)
        .expect("a vector that can be read");
    let form = ClosedForm {
        observable: observable(declared, claim.observable),
        order: Order::UpTo(claim.order),
        only: None,
        faces: None,
        kept,
        printed,
    };
    let verdict = Checker::new(chain).closed_form(&form).expect("a closed form");
    certificate.closed_form(name, &form, &verdict)?;
    Ok(verdict.differences.is_empty())
}

/// The certificate of one claim; whether the claim holds.
pub fn of_claim(text: &str, claim: &Claim<'_>) -> (bool, String) {
    let declared = declared(text);
    let mut certificate = Certificate::new(&declared);
    let holds = add(&mut certificate, &declared, "the claim", claim).expect("a certificate");
    (holds, certificate.finish("test"))
}

/// The certificate of what is derived for every observable.
pub fn of_chain(text: &str, order: u32) -> Result<String, Refusal> {
    let declared = declared(text);
    let mut certificate = Certificate::new(&declared);
    for index in (0u16..).take(declared.chain().observables.len()) {
        certificate.derived(ObservableId(index), order)?;
    }
    Ok(certificate.finish("test"))
}

/// Equation (6) of the paper, which differs, and (7), which holds.
pub fn paper() -> String {
    let declared = declared(MOBILE_LIDAR);
    let mut certificate = Certificate::new(&declared);
    let keep = &["dtheta_*", "delta_*"];
    let equation_6 = Claim {
        observable: "pointing",
        order: 1,
        keep,
        components: [
            r"\Delta\theta_{y1}^0 \cos\beta + (\Delta\theta_{y2}^1 \cos\beta + \Delta\theta_{z2}^1 \sin\beta) \cos\alpha + \Delta\theta_{x3}^2 \cos\beta \sin\alpha",
            r"-\Delta\theta_{x1}^0 \cos\beta + (\Delta\theta_{y2}^1 \cos\beta + \Delta\theta_{z2}^1 \sin\beta) \sin\alpha - \Delta\theta_{x3}^2 \cos\alpha \sin\beta",
            r"-(\Delta\theta_{x1}^0 \cos\alpha + \Delta\theta_{y1}^0 \sin\alpha) \sin\beta - \Delta\theta_{x3}^2 \sin\beta",
        ],
    };
    let equation_7 = Claim {
        observable: "position",
        order: 1,
        keep,
        components: [
            r"\delta_{x2}^1 \cos\alpha - \delta_{y2}^1 \sin\alpha - \delta_{y3}^2 \cos\beta \sin\alpha",
            r"\delta_{y2}^1 \cos\alpha + \delta_{x2}^1 \sin\alpha + \delta_{y3}^2 \cos\beta \cos\alpha",
            r"\delta_{y3}^2 \sin\beta",
        ],
    };
    assert!(!add(&mut certificate, &declared, "equation (6)", &equation_6).expect("a certificate"));
    assert!(add(&mut certificate, &declared, "equation (7)", &equation_7).expect("a certificate"));
    certificate.finish("paper.toml")
}
