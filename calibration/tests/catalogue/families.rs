//! Which effects follow from which chain.

use effects::families::FAMILIES;

use crate::support::{Asked, SCANNER, example};

fn names(asked: &Asked) -> Vec<String> {
    asked.catalogue().into_iter().map(|effect| effect.name).collect()
}

/// Every side quantity that a family asks for.
const EVERYTHING: &str = "\
[columns]
azimuth_direction = { derive = \"direction(azimuth)\" }
azimuth_rate = { derive = \"rate(azimuth, time)\" }
elevation_rate = { derive = \"rate(elevation, time)\" }
azimuth_turns = { derive = \"turns(azimuth)\" }
elevation_face = { derive = \"face(elevation)\" }
range_phase = { derive = \"phase(range, 0.6 m)\" }
session_2 = { derive = \"is(night, 2)\" }
session_3 = { derive = \"is(night, 3)\" }
rotator = { column = \"rotator\", unit = \"deg\", meaning = \"rotator\" }
temperature = { column = \"air\", meaning = \"temperature\" }
elapsed = { derive = \"elapsed(time)\" }
[[effect]]
name = \"cable\"
body = \"alidade\"
moves = \"Rz\"
functions = [\"azimuth^2\"]
[search]
lines = { azimuth = 3600 }
inputs = [\"temperature\", \"pressure\", \"azimuth_direction\", \"azimuth_rate\", \"elevation_rate\", \"azimuth_turns\",
          \"elevation_face\", \"range_phase\", \"session_2\", \"session_3\", \"rotator\", \"elapsed\"]
";

#[test]
fn every_family_has_members() {
    let points = Asked::of(SCANNER, "target", "point", EVERYTHING);
    let text = SCANNER.replace("point(0, range, 0)", "direction(0, 1, 0)");
    let inverse = "[columns]\nrange_inverse = { derive = \"inverse(range)\" }\n[search]\ninputs = [\"range_inverse\"]\n";
    // The parallax of a direction needs a range beside it: another observable of the same chain.
    let text = text
        .replace("of telescope;\n", "of telescope;\n    observe mark: point(0, range, 0) of telescope;\n");
    let mut directions = Asked::of(&text, "target", "direction", inverse);
    directions.observables.push(directions.plan.chain.find_observable("mark").unwrap());
    // Levers that change with the joints behind: an arm.
    let arm = Asked::of(ARM, "tip", "point", "");
    let gantry = Asked::of(GANTRY, "tip", "point", "");
    let found = [points.catalogue(), directions.catalogue(), arm.catalogue(), gantry.catalogue()].concat();
    // Shapes and high harmonics are taken up in the course of a calibration.
    let listed = |name| !["shape", "high harmonic"].contains(&name);
    for family in FAMILIES.iter().filter(|family| listed(family.name)) {
        assert!(found.iter().any(|effect| effect.family == family.name), "{} has no member", family.name);
    }
    for name in [
        "latency common to all encoders",
        "sub-divisional error of azimuth, 2 per line",
        "index step of azimuth",
        "cyclic error of range, once a wavelength",
        "offset of a session in telescope about x",
        "play of azimuth about x",
        "wind-up of elevation under gravity",
        "beam not along the elevation axis before its mirror",
        "elapsed in alidade axis about x",
        "parallax of telescope about x",
        "radial motion of the azimuth axis, 8 per turn backward",
    ] {
        assert!(found.iter().any(|effect| effect.name == name), "{name}");
    }
}

const ARM: &str = "chain Arm {
    const base_ry: angle = 0;
    body base on ground { position: Ry(base_ry); }
    body upper on base { motion: Ry(shoulder); motion_error: Ry(dshoulder); }
    body forearm on upper { position: Tx(0.5); motion: Ry(elbow); motion_error: Ry(delbow); }
    body hand on forearm { position: Tx(0.4); position_error: Tx(dx); }
    observe tip: point(0.1, 0, 0) of hand;
}";

const GANTRY: &str = "chain Gantry {
    body bridge on ground { motion: Tx(x); motion_error: Tx(dx); }
    body head on bridge { motion: Rz(turn); motion_error: Rz(dturn); }
    observe tip: point(0.1, 0, 0) of head;
}";

/// What shifts has no disc, whose second head would be on the other side.
#[test]
fn a_scale_of_a_joint_that_shifts_is_no_encoder_of_a_turn() {
    let asked = Asked::of(GANTRY, "tip", "point", "");
    let family =
        |name: &str| asked.catalogue().into_iter().find(|effect| effect.name == name).unwrap().family;
    assert_eq!(family("encoder scale of x"), "linear scale");
    assert_eq!(family("encoder scale of turn"), "encoder");
    let checks = FAMILIES.iter().find(|family| family.name == "linear scale").unwrap().check;
    assert!(checks.contains("interferometer") && !checks.contains("disc"), "{checks}");
}

/// The lever of a weight is how far out it stands, level: by plain trigonometry. A base of unknown tilt counts as upright.
#[test]
fn compliance_follows_the_lever_of_each_weight() {
    let asked = Asked::of(ARM, "tip", "point", "");
    let (catalogue, chain) = (asked.catalogue(), &asked.plan.chain);
    let [shoulder, elbow] = ["shoulder", "elbow"].map(|name| chain.find_symbol(name).unwrap().index());
    let torque = |name: &str, s: f64, e: f64| {
        let effect = catalogue.iter().find(|effect| effect.name == name).unwrap();
        let mut values = chain.nominal_values();
        (values[shoulder], values[elbow]) = (s, e);
        effect.functions[0].amount.eval(&values)
    };
    for (s, e) in [(0.3_f64, -1.1_f64), (2.0, 0.4), (-0.7, 2.9)] {
        let of = |joint: &str, body: &str| {
            torque(&format!("compliance of {joint} under the weight of {body}"), s, e)
        };
        approx::assert_relative_eq!(of("shoulder", "forearm"), 0.5 * s.cos(), epsilon = 1e-12);
        let level = 0.5 * s.cos() + 0.4 * (s + e).cos();
        approx::assert_relative_eq!(of("shoulder", "hand"), level, epsilon = 1e-12);
        approx::assert_relative_eq!(of("elbow", "hand"), 0.4 * (s + e).cos(), epsilon = 1e-12);
    }
}

/// A torso carries both arms, whichever hand is observed: the lever of the other hand, by plain trigonometry.
#[test]
fn compliance_counts_the_other_arm() {
    let text = "chain TwoArms {
        body torso on ground { motion: Ry(lean); motion_error: Ry(dlean); }
        body left on torso { position: Ty(0.2), Tz(0.5); motion: Ry(left_shoulder); }
        body left_hand on left { position: Tx(0.6); position_error: Tx(dx); }
        body right on torso { position: Ty(-0.2), Tz(0.5); motion: Ry(right_shoulder); }
        body right_hand on right { position: Tx(0.7); }
        observe tip: point(0, 0, 0) of left_hand;
    }";
    let asked = Asked::of(text, "tip", "point", "[columns]\nright_shoulder = { column = \"r\" }\n");
    let (catalogue, chain) = (asked.catalogue(), &asked.plan.chain);
    let of = |name: &str| catalogue.iter().find(|effect| effect.name == name);
    let effect = of("compliance of lean under the weight of right_hand").unwrap();
    let mut values = chain.nominal_values();
    let (lean, shoulder) = (0.4_f64, -1.3_f64);
    values[chain.find_symbol("lean").unwrap().index()] = lean;
    values[chain.find_symbol("right_shoulder").unwrap().index()] = shoulder;
    let level = 0.5 * lean.sin() + 0.7 * (lean + shoulder).cos();
    approx::assert_relative_eq!(effect.functions[0].amount.eval(&values), level, epsilon = 1e-12);
    // What the other shoulder carries does not wind up this one, and the other shoulder moves nothing that is observed.
    assert!(of("compliance of left_shoulder under the weight of right_hand").is_none());
    assert!(of("compliance of right_shoulder under the weight of right_hand").is_none());
}

#[test]
fn what_moves_nothing_is_no_candidate() {
    let chain = example("alt-azimuth/alt-azimuth.chain");
    let names = names(&Asked::of(&chain, "sight", "direction", ""));
    // The line of sight is y of the tube: a turn about it moves nothing, and no shift moves a direction.
    for absent in [
        "constant rotation of tube about y",
        "constant shift of tube about x",
        "wind-up of azimuth under gravity",
    ] {
        assert!(!names.iter().any(|name| name == absent), "{absent}");
    }
    // So a tilt of the elevation axis shows one component: forward and backward are one effect.
    assert!(names.iter().any(|name| name == "tilt about z of the elevation axis, 3 per turn"));
    assert!(!names.iter().any(|name| name.starts_with("tilt of the elevation axis")));
    assert!(names.iter().any(|name| name == "tilt of the azimuth axis, 3 per turn backward"));
}

#[test]
fn the_mobile_lidar_has_its_candidates() {
    let chain = example("mobile-lidar/mobile-lidar.chain");
    let plain = Asked::of(&chain, "pointing", "direction", "").catalogue();
    let mut by_family: Vec<(&str, usize)> = Vec::new();
    for effect in &plain {
        match by_family.iter_mut().find(|(name, _)| *name == effect.family) {
            Some((_, count)) => *count += 1,
            None => by_family.push((effect.family, 1)),
        }
    }
    insta::assert_debug_snapshot!(by_family);
}

#[test]
fn rows_in_sequence_bring_direction_and_drift() {
    let chain = example("alt-azimuth/alt-azimuth.chain");
    let more = "[noise]\norder = \"time\"\n[search]\nsequence = true\n";
    let names = names(&Asked::of(&chain, "sight", "direction", more));
    for name in ["backlash of azimuth", "play of elevation about z", "elapsed in tube about x"] {
        assert!(names.iter().any(|found| found == name), "{name}: {names:?}");
    }
}

/// A column called otherwise, declared to be the same, is the same: families go by what an input is, not by its name.
#[test]
fn a_declared_meaning_counts_and_a_name_does_not() {
    let families = |input: &str| {
        let text = ARM.replacen("    body base", &format!("    input {input};\n    body base"), 1);
        let name = input.split(':').next().unwrap_or_default();
        let study = format!("[columns]\n{name} = {{ column = \"a\" }}\n[search]\ninputs = [\"{name}\"]\n");
        let of = Asked::of(&text, "tip", "point", &study).catalogue().into_iter();
        of.filter(|effect| effect.driver == name).map(|effect| effect.family).collect::<Vec<_>>()
    };
    let plain = families("zahl");
    for (meaning, family) in [
        ("temperature", "thermal"),
        ("time", "drift"),
        ("side", "flop"),
        ("direction of shoulder", "backlash"),
    ] {
        for name in ["temperature", "elapsed", "pier", "shoulder_direction", "x"] {
            assert_eq!(families(name), plain, "{name}");
            let declared = families(&format!("{name}: {meaning}"));
            assert!(declared.contains(&family) && !plain.contains(&family), "{name}: {meaning} {declared:?}");
        }
    }
}

/// A declination is no altitude: its axis is level at two hour angles alone, and the tangent of it says nothing of the air. The
/// zenith distance follows from both joints.
#[test]
fn refraction_follows_the_zenith_distance() {
    let of = |text: &str, kind: &str| {
        let all = names(&Asked::of(text, "sight", kind, ""));
        all.into_iter().filter(|name| name.starts_with("refraction")).collect::<Vec<_>>()
    };
    let equatorial = example("equatorial/equatorial.chain");
    assert_eq!(
        of(&equatorial, "direction"),
        [
            "refraction, tangent of the zenith distance",
            "refraction, cube of the tangent of the zenith distance"
        ]
    );
    let mount = example("alt-azimuth/alt-azimuth.chain");
    assert_eq!(
        of(&mount, "direction"),
        ["refraction, cot of elevation", "refraction, cube of cot of elevation"]
    );
    // Where up is not known with its length, the zenith distance is not known.
    let unknown = equatorial.replace("gravity: (0, -cos(latitude)", "gravity: (0, -2*cos(latitude)");
    assert_eq!(of(&unknown, "direction"), Vec::<String>::new());
}
