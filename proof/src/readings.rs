//! Statements about readings: components alone, azimuths, elevations, ranges. Each is a derivative of a function that the
//! library defines; what a formula has to satisfy for that follows from the vector and its derivatives, which are proved first.

use std::fmt::Write as _;

use super::declared::without_places;
use super::differs::Place;
use super::expanded::Expanded;
use super::section::{Question, Section};
use super::{Certificate, Refusal, ordinal};
use claims::checker::{ClosedForm, FormVerdict};
use model_core::algebra::{Fraction, Poly};
use model_core::chain::reading::{Measures, Reading, SignedAxis};
use model_core::chain::{Axis, ObservableId};
use model_core::expr::{Expr, Node};
use model_core::forms;
use model_core::symbol::SymbolKind;

/// A reading with a formula for its error.
struct Formula {
    reading: Reading,
    /// As written.
    written: Expr<()>,
    /// What that says.
    value: Fraction,
}

impl Certificate<'_> {
    /// States and proves the errors of what an observable shows that is no whole vector.
    pub(super) fn derived_readings(&mut self, observable: ObservableId, order: u32) -> Result<(), Refusal> {
        let chain = self.declared.chain();
        let shown = chain.observable(observable).shown.clone();
        only_first_order(&shown, order)?;
        let form = forms::derive(chain, observable, order)?;
        let formulas = self.formulas(&shown, &form.components)?;
        let question = Question {
            observable: Some(observable),
            order,
            kept: chain.symbols_of(SymbolKind::Error).collect(),
            put_in: Vec::new(),
        };
        let title =
            format!("What {} shows: its error to {} order", self.observable(observable), ordinal(order));
        let name = self.names.give(&chain.observable(observable).name);
        let section = Section::of_readings(self, &question, &[&formulas])?;
        let section = section.hold(&name, &title, "derived", &formulas)?;
        self.finish_section(section, &name, "holds");
        Ok(())
    }

    /// States printed formulas for what an observable shows that is no whole vector, or for one number of it, and proves the
    /// verdict.
    pub(super) fn printed_readings(
        &mut self,
        title: &str,
        claim: &ClosedForm,
        order: u32,
        verdict: &FormVerdict,
    ) -> Result<(), Refusal> {
        let shown = &self.declared.chain().observable(claim.observable).shown;
        let places: Vec<usize> = match claim.only {
            Some(axis) => vec![axis.index()],
            None => (0..shown.len()).collect(),
        };
        let chosen: Vec<Reading> = places.iter().map(|place| shown[*place]).collect();
        only_first_order(&chosen, order)?;
        let printed: Vec<Formula> = places
            .iter()
            .zip(&chosen)
            .map(|(place, reading)| {
                let component = &claim.printed.components[*place];
                let written = without_places(&component.expression);
                Formula { reading: *reading, written, value: component.value.clone() }
            })
            .collect();
        let question = Question {
            observable: Some(claim.observable),
            order,
            kept: claim.kept.clone(),
            put_in: Vec::new(),
        };
        let words: Vec<&str> = chosen.iter().map(|reading| reading.word).collect();
        let title_of = |verdict: &str| {
            let observable = self.observable(claim.observable);
            let (words, order) = (words.join(", "), ordinal(order));
            format!("{title}: the error of {words} of {observable} to {order} order, as printed: {verdict}")
        };
        let (holds, differs) = (title_of("holds"), title_of("differs from what the chain implies"));
        let name = self.names.give(title);
        if verdict.differences.is_empty() {
            let section = Section::of_readings(self, &question, &[&printed])?;
            let section = section.hold(&name, &holds, "printed", &printed)?;
            self.finish_section(section, &name, "holds");
        } else {
            let derived: Vec<Fraction> = places.iter().map(|place| verdict.derived[*place].clone()).collect();
            let derived = self.formulas(&chosen, &derived)?;
            let wrong = verdict.differences.iter().map(|difference| difference.component.index());
            let wrong: Vec<usize> =
                wrong.filter_map(|place| places.iter().position(|other| *other == place)).collect();
            let section = Section::of_readings(self, &question, &[&printed, &derived])?;
            let section = section.differ(&name, &differs, [&printed, &derived], &wrong)?;
            self.finish_section(section, &name, "differs");
        }
        Ok(())
    }

    fn formulas(&self, shown: &[Reading], values: &[Fraction]) -> Result<Vec<Formula>, Refusal> {
        let formula = |(reading, value): (&Reading, &Fraction)| {
            let above = self.as_printed(&value.above)?;
            let written = if value.is_whole() {
                above
            } else {
                let below = self.as_printed(&value.below)?;
                Expr { node: Node::Div(Box::new(above), Box::new(below)), place: () }
            };
            Ok(Formula { reading: *reading, written, value: value.clone() })
        };
        shown.iter().zip(values).map(formula).collect()
    }
}

impl<'c> Section<'c> {
    fn of_readings(
        certificate: &'c Certificate<'c>,
        question: &'c Question,
        formulas: &[&[Formula]],
    ) -> Result<Self, Refusal> {
        let written: Vec<&Expr<()>> =
            formulas.iter().copied().flatten().map(|formula| &formula.written).collect();
        Self::new(certificate, question, &written)
    }

    /// The whole proof that formulas are the errors.
    fn hold(
        mut self,
        module: &str,
        title: &str,
        prefix: &str,
        formulas: &[Formula],
    ) -> Result<String, Refusal> {
        let proofs = self.proofs(prefix, formulas)?;
        self.open(module, title)?;
        self.seen();
        self.define(prefix, formulas);
        self.claim_of(prefix, formulas);
        self.prepare()?;
        self.write_steps()?;
        self.out.push_str(&proofs);
        let parts: Vec<String> =
            formulas.iter().map(|formula| format!("{prefix}_{}_is_right", formula.reading.word)).collect();
        let _ = writeln!(self.out, "Theorem holds : claim.\nProof. exact {}. Qed.", conjunction(&parts));
        Ok(self.close_all(module))
    }

    /// The whole proof that a printed formula is not the error.
    fn differ(
        mut self,
        module: &str,
        title: &str,
        [printed, derived]: [&[Formula]; 2],
        wrong: &[usize],
    ) -> Result<String, Refusal> {
        let proofs = self.proofs("derived", derived)?;
        self.open(module, title)?;
        self.seen();
        self.define("printed", printed);
        self.claim_of("printed", printed);
        self.define("derived", derived);
        self.prepare()?;
        self.write_steps()?;
        self.out.push_str(&proofs);
        let place = *wrong.first().ok_or(Refusal::NoWitness)?;
        let (here, there) = (&printed[place], &derived[place]);
        let difference =
            &(&here.value.above * &there.value.below) - &(&there.value.above * &here.value.below);
        let expanded = |value: &Fraction| -> Result<[Expanded; 2], Refusal> {
            Ok([Expanded::new(&value.above)?, Expanded::new(&value.below)?])
        };
        let quotients = [expanded(&here.value)?, expanded(&there.value)?];
        let Place { at: [first, second], premises, intros, by_value, points } =
            self.place(Expanded::new(&difference)?, &quotients, &[])?;
        let word = here.reading.word;
        let pattern = match printed.len() {
            1 => "C0".to_owned(),
            2 => "[C0 C1]".to_owned(),
            _ => "[C0 [C1 C2]]".to_owned(),
        };
        let unique = unique(&here.reading);
        let _ = writeln!(
            self.out,
            "\n(* Where the two are different numbers: {word} is {first} as printed, {second} as derived. *)\n\
             Lemma there : {premises}~ claim.\nProof.\n  intros {intros} {pattern}.\n  \
             assert (E : printed_{word} = {first}) by (cbv [printed_{word}]; {by_value}).\n  \
             assert (D : derived_{word} = {second}) by (cbv [derived_{word}]; {by_value}).\n  \
             assert (H := {unique} C{place} derived_{word}_is_right). rewrite E, D in H. different H.\nQed."
        );
        self.conclude("So the formula as printed is not the error.", &points)?;
        Ok(self.close(module))
    }

    /// What the instrument shows, as a vector.
    fn seen(&mut self) {
        let kind = self.kind_name();
        let _ = writeln!(
            self.out,
            "Definition seen (t : R) : vec := shown {kind} (instrument t) vector.\n\
             Lemma is_seen : seen = fun t => shown {kind} (instrument t) vector. Proof. reflexivity. Qed."
        );
    }

    fn define(&mut self, prefix: &str, formulas: &[Formula]) {
        for formula in formulas {
            let written = self.written(&formula.written);
            let _ = writeln!(self.out, "Definition {prefix}_{} : R :=\n  {written}.", formula.reading.word);
        }
    }

    fn claim_of(&mut self, prefix: &str, formulas: &[Formula]) {
        let parts: Vec<String> = formulas.iter().map(|formula| self.part(prefix, formula)).collect();
        let _ = writeln!(self.out, "Definition claim : Prop :=\n  {}.", parts.join(" /\\\n  "));
    }

    /// `elevation_error (Plus Z) seen printed_elevation`
    fn part(&self, prefix: &str, formula: &Formula) -> String {
        let order = self.question.order;
        let said = match formula.reading.measures {
            Measures::Component(axis) => format!("component_error {order} {}", capital(axis)),
            Measures::Azimuth { zero, through } => format!("azimuth_error {} {}", half(zero), half(through)),
            Measures::CrossElevation { zero, through } => {
                format!("cross_elevation_error {} {}", half(zero), half(through))
            }
            Measures::Elevation { up } => format!("elevation_error {}", half(up)),
            Measures::ZenithDistance { up } => format!("zenith_distance_error {}", half(up)),
            Measures::Range => "range_error".to_owned(),
            Measures::OffAxis | Measures::Rotation(_) | Measures::Image(_) => unreachable!("refused before"),
        };
        format!("{said} seen {prefix}_{}", formula.reading.word)
    }

    /// That each formula is the error; what has to hold for it becomes a condition.
    fn proofs(&mut self, prefix: &str, formulas: &[Formula]) -> Result<String, Refusal> {
        let Some(last) = self.states.last() else { unreachable!("the vector itself is the first state") };
        let nominal = last.each_ref().map(|jet| jet[0].clone());
        let square = |axes: &[Axis]| {
            axes.iter().fold(Poly::zero(), |sum, axis| {
                let component = &nominal[axis.index()];
                &sum + &(component * component)
            })
        };
        let everything = square(&[Axis::X, Axis::Y, Axis::Z]);
        let mut out = String::new();
        for formula in formulas {
            let name = format!("{prefix}_{}", formula.reading.word);
            let last = format!("cbv [{name}]; angles; settle");
            let proof = match formula.reading.measures {
                Measures::Component(axis) => {
                    format!(
                        "apply (component_reached _ {} _ _ _ _ _ step_0); [reflexivity|]. cbv [component_list]. \
                         symmetry. transitivity {name}; [reflexivity|]. symmetry. cbv [{name}]; angles; total",
                        capital(axis)
                    )
                }
                Measures::Azimuth { zero, through } => {
                    let product = self.add_square(&square(&[zero.axis, through.axis]))?;
                    let axes = format!("{} {}", half(zero), half(through));
                    format!(
                        "apply (azimuth_reached _ _ _ _ _ _ _ step_0 {axes} _ _ _ _ _ eq_refl eq_refl); [not_zero {product}|{last}]"
                    )
                }
                Measures::CrossElevation { zero, through } => {
                    let across = self.add_root(&square(&[zero.axis, through.axis]))?;
                    let length = self.add_root(&everything)?;
                    let axes = format!("{} {}", half(zero), half(through));
                    format!(
                        "apply (cross_elevation_reached _ _ _ _ _ _ _ step_0 {axes} _ _ _ _ ({across}) ({length}) _ eq_refl eq_refl); \
                         [positive|settle|positive|settle|{last}]"
                    )
                }
                Measures::Elevation { up } | Measures::ZenithDistance { up } => {
                    let [a, b] = match up.axis {
                        Axis::X => [Axis::Y, Axis::Z],
                        Axis::Y => [Axis::X, Axis::Z],
                        Axis::Z => [Axis::X, Axis::Y],
                    };
                    let across = self.add_root(&square(&[a, b]))?;
                    let axis = half(up);
                    let rule = match formula.reading.measures {
                        Measures::Elevation { .. } => "elevation_reached",
                        _ => "zenith_distance_reached",
                    };
                    format!(
                        "apply ({rule} _ _ _ _ _ _ _ step_0 {axis} _ _ ({across}) _ eq_refl); [positive|settle|{last}]"
                    )
                }
                Measures::Range => {
                    let length = self.add_root(&everything)?;
                    format!("apply (range_reached _ _ _ _ _ _ _ step_0 ({length})); [positive|settle|{last}]")
                }
                Measures::OffAxis | Measures::Rotation(_) | Measures::Image(_) => {
                    unreachable!("refused before")
                }
            };
            let statement = self.part(prefix, formula);
            let _ = writeln!(
                out,
                "\nTheorem {name}_is_right : {statement}.\nProof.\n  rewrite is_seen, same_chain. {proof}.\nQed."
            );
        }
        Ok(out)
    }
}

/// Angles and lengths are certified to first order, and orientations not at all.
fn only_first_order(shown: &[Reading], order: u32) -> Result<(), Refusal> {
    if let Some(reading) = shown.iter().find(|reading| reading.rotation().is_some()) {
        return Err(Refusal::Orientation { reading: reading.words() });
    }
    if let Some(reading) = shown.iter().find(|reading| reading.image().is_some()) {
        return Err(Refusal::Image { reading: reading.words() });
    }
    let above = shown.iter().find(|reading| order > 1 && reading.component().is_none());
    above.map_or(Ok(()), |reading| Err(Refusal::ReadingToOrder { reading: reading.words(), order }))
}

/// The theorem that a reading has one error.
fn unique(reading: &Reading) -> &'static str {
    match reading.measures {
        Measures::Component(_) => "one_component _ _ _ _ _",
        Measures::Azimuth { .. } => "one_azimuth _ _ _ _ _",
        Measures::CrossElevation { .. } => "one_cross_elevation _ _ _ _ _",
        Measures::Elevation { .. } => "one_elevation _ _ _ _",
        Measures::ZenithDistance { .. } => "one_zenith_distance _ _ _ _",
        Measures::Range => "one_range _ _ _",
        Measures::OffAxis | Measures::Rotation(_) | Measures::Image(_) => unreachable!("refused before"),
    }
}

/// `(conj a (conj b c))`
fn conjunction(parts: &[String]) -> String {
    match parts {
        [] => unreachable!("an observable shows something"),
        [one] => one.clone(),
        [first, rest @ ..] => format!("(conj {first} {})", conjunction(rest)),
    }
}

fn capital(axis: Axis) -> &'static str {
    ["X", "Y", "Z"][axis.index()]
}

fn half(axis: SignedAxis) -> String {
    format!("({} {})", if axis.is_negative { "Minus" } else { "Plus" }, capital(axis.axis))
}
