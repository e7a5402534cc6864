//! From the lines of sight of a declaration that breaks no rule to those of its chain.

use proc_macro2::Span;

use super::Subject;
use super::amounts::Purpose;
use crate::chain::Chain;
use crate::chain::sight::SightError;
use crate::mistake::Mistake;

/// Gives the chain its angles from up and the bending of its lines of sight.
///
/// # Errors
/// Those that the algebra cannot follow.
pub fn complete(subject: &Subject<'_>, chain: &mut Chain) -> Result<(), Vec<Mistake<Span>>> {
    let mut mistakes = Vec::new();
    for input in subject.declaration.inputs() {
        let Some(between) = &input.between else { continue };
        let (Some(symbol), Some(observable)) =
            (subject.scope.find(&input.name.to_string()), chain.find_observable(&between.sight.to_string()))
        else {
            unreachable!("the rules let pass only angles of declared observables");
        };
        if let Err(error) = chain.set_sight_angle(symbol, observable) {
            mistakes.push(Mistake::new(between.sight.span(), error.to_string()).with_help(help(&error)));
        }
    }
    for amount in &subject.amounts {
        let (Purpose::Bend(observe), Some(value)) = (&amount.purpose, &amount.value) else { continue };
        let Some(observable) = chain.find_observable(&observe.name.to_string()) else { continue };
        // An angle that cannot be followed has been reported.
        let Some(angle) = chain.sight_angle_of(observable) else { continue };
        match angle.bending(value, &observe.documentation) {
            Ok(bend) => chain.observables[usize::from(observable.0)].bend = Some(bend),
            Err(error) => mistakes.push(
                Mistake::new(amount.written.place, error.to_string())
                    .with_help("write the amount with lower powers"),
            ),
        }
    }
    if mistakes.is_empty() { Ok(()) } else { Err(mistakes) }
}

fn help(error: &SightError) -> String {
    match error {
        SightError::NotADirection(_) => "name an observed direction".to_owned(),
        SightError::NotAlongAnAxis(name) => {
            format!("write `observe {name}: direction(0, 0, 1) of body;`, and turn the body by a `position`")
        }
        SightError::Gravity => {
            "write where down is with length one: `gravity: (-cos(latitude), 0, -sin(latitude));`".to_owned()
        }
        SightError::Turn(_) => "turn the body by whole multiples of joints and constant angles".to_owned(),
        SightError::TooLong(_) => "name a direction that fewer joints turn".to_owned(),
    }
}
