//! What each spelling of the table is read as.

use proptest::prelude::*;

use super::*;

#[test]
fn each_spelling_means_one_unit_or_is_refused_with_both() {
    for unit in Unit::all() {
        for spelling in unit.spellings() {
            let same = |other: &Unit| other.spellings().any(|own| is_spelled(spelling, own));
            let sharing: Vec<Unit> =
                Unit::all().filter(|other| other.measures == unit.measures).filter(same).collect();
            assert_eq!(sharing, [unit], "{spelling} is of one unit that measures the same");
            assert_eq!(Unit::read(spelling, Some(unit.measures)), Ok(unit), "{spelling}");
            match Unit::read(spelling, None) {
                Ok(read) => assert!(
                    read == unit || (unit.measures == Measures::Time && read.name == "hour"),
                    "{spelling} is {read:?}"
                ),
                Err(error) => {
                    assert!(matches!(error, UnitError::TwoMeanings { .. }), "{spelling}: {error}");
                    assert!(unit.measures.needs_meaning(), "{spelling} of {unit:?} cannot be written");
                }
            }
        }
    }
    for two in TWO_MEANINGS {
        for spelling in two.spellings {
            let words = format!("`{spelling}` is {}: {}", two.meanings, two.instead);
            for wanted in [None, Some(Measures::Angle), Some(Measures::Length), Some(Measures::Number)] {
                let read = Unit::read(spelling, wanted).map_err(|error| error.to_string());
                assert_eq!(read, Err(words.clone()), "{wanted:?}");
            }
            // What the message says to write is read.
            for instead in two.instead.split('`').skip(1).step_by(2) {
                assert!(Unit::find(instead).is_some(), "{instead}");
            }
        }
    }
}

/// Source of the sizes: Python's `astropy.units` for angles (except mils, which are parts of a turn), NIST SP 811 for the others.
#[test]
fn sizes_are_those_of_the_literature() {
    for (text, si) in [
        ("deg", 0.017_453_292_519_943_295),
        ("gon", 0.015_707_963_267_948_967),
        ("arcmin", 2.908_882_086_657_216e-4),
        ("arcsec", 4.848_136_811_095_36e-6),
        ("mas", 4.848_136_811_095_36e-9),
        ("uas", 4.848_136_811_095_36e-12),
        ("hour", 0.261_799_387_799_149_4),
        ("turn", std::f64::consts::TAU),
        ("mil6400", 9.817_477_042_468_104e-4),
        ("mil6000", 1.047_197_551_196_597_6e-3),
        ("inch", 0.0254),
        ("ft", 0.3048),
        ("thou", 2.54e-5),
        ("mile", 1_609.344),
        ("mmHg", 133.322_387_415),
    ] {
        let read = Unit::find(text).map(Unit::in_si);
        approx::assert_relative_eq!(read.unwrap_or(f64::NAN), si, max_relative = 1e-15);
    }
    let [micro, mu] = ["µrad", "μrad"].map(|text| Unit::find(text).map(Unit::in_si));
    assert_eq!((micro, mu), (Some(1e-6), Some(1e-6)));
}

/// A suggestion that is taken changes no number by a factor that nobody notices.
#[test]
fn no_other_unit_is_suggested_for_few_letters() {
    let help = |text: &str| Unit::read(text, None).map_err(|error| error.to_string());
    for (text, said) in [
        ("x", "`x` is no unit: write rad, deg, arcmin, arcsec, m, mm or um"),
        ("ym", "`ym` is no unit: write rad, deg, arcmin, arcsec, m, mm or um"),
        ("MM", "`MM` is no unit: did you mean `mm`?"),
        ("M", "`M` is no unit: did you mean `m`?"),
        ("arcsecz", "`arcsecz` is no unit: did you mean `arcsec`?"),
        ("", "`` is no unit: write rad, deg, arcmin, arcsec, m, mm or um"),
    ] {
        assert_eq!(help(text), Err(said.to_owned()));
    }
}

#[test]
fn a_declared_time_knows_its_units() {
    for (text, seconds) in [("s", 1.0), ("min", 60.0), ("h", 3_600.0), ("hours", 3_600.0), ("d", 86_400.0)] {
        let read = Unit::read(text, Some(Measures::Time)).and_then(|unit| unit.factor(Measures::Time));
        assert_eq!(read, Ok(seconds), "{text}");
    }
    let hours = Unit::read("hours", Some(Measures::Angle)).map(Unit::name);
    assert_eq!(hours, Ok("hour"));
    let warm = Unit::find("fahrenheit").map(|unit| unit.factor(Measures::Temperature));
    assert_eq!(warm, Some(Err(UnitError::ShiftedZero { unit: "°F" })));
    assert_eq!(Unit::find("celsius").map(|unit| unit.factor(Measures::Temperature)), Some(Ok(1.0)));
}

#[test]
fn names_end_in_units_and_not_in_letters() {
    for (name, unit) in [
        ("az_deg", Some("deg")),
        ("az_degrees", Some("deg")),
        ("x_µm", Some("um")),
        ("pos_m", None),
        ("pos_in", None),
        ("pos_min", None),
        ("cosine_as", None),
        ("q_turns", None),
        ("ambient_celsius", None),
        ("deg", None),
        ("x_", None),
    ] {
        assert_eq!(Unit::behind_name(name).map(|(_, unit)| unit.name), unit, "{name}");
    }
}

proptest! {
    /// Whatever is written is a unit of the table or a message that says so.
    #[test]
    fn any_text_is_a_unit_or_is_refused(text in "[a-zA-Z°µμ'\" ]{0,8}") {
        match Unit::read(&text, None) {
            Ok(unit) => prop_assert!(unit.spellings().any(|own| is_spelled(&text, own))),
            Err(error) => {
                let start = format!("`{text}` is ");
                prop_assert!(error.to_string().starts_with(&start));
            }
        }
    }

    /// Numbers of a unit are its exact multiples.
    #[test]
    fn amounts_are_exact(number in -1000_i64..1000, at in 0..UNITS.len()) {
        let unit = UNITS[at];
        let exact = unit.amount(&Rational::from(number)).eval(&[PI]);
        approx::assert_relative_eq!(exact, number as f64 * unit.in_si(), max_relative = 1e-14);
    }
}
