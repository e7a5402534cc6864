//! Physical causes, plainly: the words that a person at the instrument would use for what the catalogue names.

use super::contest::percent;
use calibration::diagnose::Cause;
use effects::candidate::Dependence;

/// A share from which on a cause stands alone.
const SURE: f64 = 0.995;

/// A cause as one would say it: `the encoder of beta sits off centre`.
#[must_use]
pub fn cause(cause: &Cause) -> String {
    match cause.name.split_once(", times ") {
        Some((name, with)) => format!("{}, changing with {with}", plainly(name)),
        None => plainly(&cause.name),
    }
}

/// Causes in words, each once, with its share where a contest weighed several; one line for an encoder that errs several times per turn,
/// whatever the number.
#[must_use]
pub fn each_once<'a>(causes: impl Iterator<Item = &'a Cause>) -> Vec<String> {
    let mut told: Vec<(String, Vec<u32>, Vec<f64>)> = Vec::new();
    for cause in causes {
        let order = cause.name.strip_prefix("encoder error of ").and_then(|rest| {
            let (joint, order) = rest.strip_suffix(" per turn")?.rsplit_once(", ")?;
            Some((format!("the encoder of {joint} errs"), order.parse::<u32>().ok()?))
        });
        let (words, order) = order.map_or_else(|| (self::cause(cause), None), |(words, n)| (words, Some(n)));
        match told.iter_mut().find(|(known, ..)| *known == words) {
            Some((_, orders, shares)) => {
                orders.extend(order);
                shares.extend(cause.share);
            }
            None => told.push((words, order.into_iter().collect(), cause.share.into_iter().collect())),
        }
    }
    told.into_iter()
        .map(|(words, mut orders, shares)| {
            orders.sort_unstable();
            orders.dedup();
            let orders: Vec<String> = orders.iter().map(ToString::to_string).collect();
            let words = if orders.is_empty() {
                words
            } else {
                format!("{words} {} times per turn", orders.join(", "))
            };
            match shares.iter().sum::<f64>() {
                share if share > 0.0 && share < SURE => format!("{words} ({})", percent(share)),
                _ => words,
            }
        })
        .collect()
}

fn plainly(name: &str) -> String {
    let rest = |prefix: &str| name.strip_prefix(prefix).map(str::trim);
    if let Some(joint) = rest("encoder eccentricity of ") {
        return format!("the encoder of {joint} sits off centre");
    }
    if let Some(joint) = rest("encoder ellipticity of ") {
        return format!("the encoder disc of {joint} is oval or tilted");
    }
    if let Some(joint) = rest("encoder scale of ") {
        return format!("the encoder of {joint} has a wrong scale");
    }
    if let Some((joint, order)) = rest("encoder error of ").and_then(|rest| rest.rsplit_once(", ")) {
        return format!("the encoder of {joint} errs, {order}");
    }
    if let Some(joint) = rest("backlash of ") {
        return format!("the drive of {joint} has backlash");
    }
    if let Some((body, axis)) = rest("gravity flexure of ").and_then(at_its_axis) {
        return format!("{} sags under its own weight, {axis}", body_in_words(body));
    }
    if let Some(joint) = rest("wind-up of ").and_then(|joint| joint.strip_suffix(" under gravity")) {
        return format!("the axis of {joint} winds up under gravity");
    }
    if let Some((joint, body)) = rest("coupling of ").and_then(|rest| rest.split_once(" into ")) {
        let (body, order) = body.rsplit_once(", harmonic ").unwrap_or((body, "1"));
        return format!("moving {joint} {}, {}", pushed(body), times_a_turn(order));
    }
    if let Some((joints, body)) = name.split_once(" together in ") {
        return format!("moving {joints} together {}", pushed(body));
    }
    if let Some(joint) =
        rest("beam not along the ").and_then(|joint| joint.strip_suffix(" axis before its mirror"))
    {
        return format!("the beam comes in askew to the axis of {joint}, before its mirror");
    }
    name.to_owned()
}

/// `fork about x` in its two parts.
fn at_its_axis(place: &str) -> Option<(&str, &str)> {
    let at = place.rfind(" about ").or_else(|| place.rfind(" along "))?;
    Some((&place[..at], &place[at + 1..]))
}

/// What is done to `outer about x`: `tilts the body outer about x`.
fn pushed(place: &str) -> String {
    let does = if place.contains(" along ") { "shifts" } else { "tilts" };
    match at_its_axis(place) {
        Some((body, axis)) => format!("{does} {} {axis}", body_in_words(body)),
        None => format!("{does} {}", body_in_words(place)),
    }
}

/// `the body middle`; a name of several words is told as these.
pub(super) fn body_in_words(body: &str) -> String {
    format!("the body {}", body.replace('_', " "))
}

fn times_a_turn(order: &str) -> String {
    match order {
        "1" => "once per turn".to_owned(),
        "2" => "twice per turn".to_owned(),
        order => format!("{order} times per turn"),
    }
}

/// Degrees to four decimals, without zeros at the end.
fn degrees(value: f64) -> String {
    format!("{value:.4}").trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// How an effect follows what drives it: `once per turn of beta`, `in proportion to temperature`.
#[must_use]
pub fn form(form: &Dependence, driver: &str) -> String {
    if let Dependence::Described(words) = form
        && words.starts_with("product")
    {
        return format!("with {} together", driver.replace(", ", " and "));
    }
    let (driver, with) = driver.split_once(", ").unwrap_or((driver, ""));
    let told = match form {
        Dependence::Harmonic { order: 1 } => format!("once per turn of {driver}"),
        Dependence::Harmonic { order: 2 } => format!("twice per turn of {driver}"),
        Dependence::Harmonic { order } => {
            format!("{order} times per turn of {driver} (every {} deg)", degrees(360.0 / f64::from(*order)))
        }
        Dependence::Linear => format!("in proportion to {driver}"),
        Dependence::Constant => "always the same".to_owned(),
        Dependence::Described(other) => match other.strip_prefix("gravity ") {
            Some(rest) => format!("as gravity pulls {rest}"),
            None if driver.is_empty() || other.contains(driver) => format!("as {other}"),
            None => format!("with {driver} ({other})"),
        },
    };
    if with.is_empty() { told } else { format!("{told}, changing with {with}") }
}

/// A sentence's start. A name of the instrument's own, which digits and underscores show, stays as it is.
#[must_use]
pub fn sentence_case(text: &str) -> String {
    let first = text.split([' ', ',', ':']).next().unwrap_or_default();
    if first.contains(|letter: char| letter == '_' || letter.is_ascii_digit()) {
        return text.to_owned();
    }
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use calibration::diagnose::Relation;

    fn named(name: &str) -> Cause {
        Cause {
            name: name.to_owned(),
            family: "",
            body: String::new(),
            relation: Relation::Competing,
            share: None,
            published: Vec::new(),
            causes: "",
            looks: "",
            check: "",
        }
    }

    #[test]
    fn an_encoder_that_errs_often_is_one_line() {
        let names = [
            "encoder error of q1, 10 per turn",
            "encoder eccentricity of q1",
            "encoder error of q1, 3 per turn",
            "encoder error of q2, 4 per turn",
        ];
        let causes = names.map(named);
        assert_eq!(
            each_once(causes.iter().chain(&causes)),
            [
                "the encoder of q1 errs 3, 10 times per turn",
                "the encoder of q1 sits off centre",
                "the encoder of q2 errs 4 times per turn"
            ]
        );
    }

    #[test]
    fn bodies_are_told_as_such() {
        let told = |name| cause(&named(name));
        assert_eq!(
            told("gravity flexure of axis_2 about x, times pier"),
            "the body axis 2 sags under its own weight, about x, changing with pier"
        );
        assert_eq!(
            told("coupling of beta into outer about x, harmonic 2"),
            "moving beta tilts the body outer about x, twice per turn"
        );
        assert_eq!(
            told("q2 and q3 together in joint2 about z"),
            "moving q2 and q3 together tilts the body joint2 about z"
        );
        assert_eq!(sentence_case("q2_a wanders"), "q2_a wanders");
        assert_eq!(sentence_case("étagère"), "Étagère");
        assert_eq!(
            form(&"gravity along z of tube".into(), "gravity, pier"),
            "as gravity pulls along z of tube, changing with pier"
        );
    }
}
