//! Mutants of printed numbers at one pose, and of what is neglected because it is small: a planar arm by trigonometry.

use super::support;
use super::tree::Random;

const PLANAR: &str = "chain Planar { const l1: length = 0.5; const l2: length = 0.3;
 body upper on ground { motion: Rz(q1); motion_error: Rz(e1); position: Tx(l1); position_error: Tx(d1); }
 body fore on upper { motion: Rz(q2); motion_error: Rz(e2); position: Tx(l2); }
 observe tip: point(0, 0, 0) of fore; }";

/// Mutants of each kind.
const MADE: usize = 200;

fn uniform(random: &mut Random, from: f64, to: f64) -> f64 {
    from + (to - from) * random.below(1 << 20) as f64 / f64::from(1 << 20)
}

/// Where the tip is.
fn tip([q1, q2]: [f64; 2], [e1, e2, d1]: [f64; 3]) -> [f64; 3] {
    let (upper, fore) = (q1 + e1, q1 + e1 + q2 + e2);
    [(0.5 + d1) * upper.cos() + 0.3 * fore.cos(), (0.5 + d1) * upper.sin() + 0.3 * fore.sin(), 0.0]
}

#[test]
fn no_printed_number_gets_a_wrong_verdict() {
    let mut random = Random(29);
    let (mut holding, mut differing) = (0, 0);
    for _ in 0..MADE {
        let degrees =
            [uniform(&mut random, -170.0, 170.0), uniform(&mut random, -170.0, 170.0)].map(f64::round);
        let seconds = [uniform(&mut random, -90.0, 90.0), uniform(&mut random, -90.0, 90.0)].map(f64::round);
        let um = uniform(&mut random, -200.0, 200.0).round();
        let arcsec = std::f64::consts::PI / 648_000.0;
        let errors = [seconds[0] * arcsec, seconds[1] * arcsec, um * 1e-6];
        let is_shown = random.below(2) == 0;
        let pose = degrees.map(f64::to_radians);
        let (with, without) = (tip(pose, errors), tip(pose, [0.0; 3]));
        let (unit, factor) = if is_shown { ("mm", 1e3) } else { ("um", 1e6) };
        let right = [0, 1, 2].map(|at| factor * if is_shown { with[at] } else { with[at] - without[at] });
        let decimals = 1 + random.below(3);
        let mut printed = right;
        let at = random.below(2);
        let last = 10f64.powi(-i32::try_from(decimals).unwrap());
        match random.below(6) {
            0 => printed[at] = -printed[at],
            1 => printed[at] += last * (1 + random.below(3)) as f64,
            2 => printed.swap(0, 1),
            3 => printed[at] *= 1.0 + 0.01 * uniform(&mut random, 1.0, 5.0),
            _ => {}
        }
        let texts = printed.map(|value| format!("{value:.decimals$}"));
        let off = texts
            .iter()
            .zip(right)
            .map(|(text, right)| (text.parse::<f64>().unwrap() - right).abs() / last)
            .fold(0.0, f64::max);
        if (off - 0.5).abs() < 1e-3 {
            continue;
        }
        let [x, y, z] = texts.map(|text| format!("\"{text} {unit}\""));
        let of = if is_shown { "of = \"shown\", " } else { "" };
        let [q1, q2] = degrees;
        let [e1, e2] = seconds;
        let file = format!(
            "chain = \"a\"\n[[claim]]\nname = \"a\"\nobservable = \"tip\"\nvalue = {{ {of}at = {{ q1 = \"{q1} deg\", q2 = \"{q2} deg\" }}, \
             errors = {{ e1 = \"{e1} arcsec\", e2 = \"{e2} arcsec\", d1 = \"{um} um\" }}, equals = [{x}, {y}, {z}] }}\n"
        );
        let truth = if off < 0.5 { "holds" } else { "differs" };
        assert_eq!(support::verdict(PLANAR, &file), truth, "{off} of the last digit: {file}");
        if off < 0.5 { holding += 1 } else { differing += 1 }
    }
    assert!(holding > MADE / 5 && differing > MADE / 5, "{holding} {differing}");
}

#[test]
fn nothing_is_called_negligible_that_is_not() {
    let mut random = Random(31);
    for _ in 0..MADE {
        let size = uniform(&mut random, 1.0, 50.0).round();
        let arcsec = std::f64::consts::PI / 648_000.0;
        // The largest over all poses: the stretched arm, its fore part, and the shift itself.
        let (error, largest) =
            [("e1", 0.8 * size * arcsec), ("e2", 0.3 * size * arcsec), ("d1", size * 1e-6)][random.below(3)];
        let unit = if error == "d1" { "um" } else { "arcsec" };
        let limit = format!("{:.2}", largest * 1e6 * uniform(&mut random, 0.5, 1.5));
        let ratio = limit.parse::<f64>().unwrap() * 1e-6 / largest;
        if (ratio - 1.0).abs() < 1e-3 {
            continue;
        }
        let file = format!(
            "chain = \"a\"\n[[claim]]\nname = \"a\"\nobservable = \"tip\"\nneglected = {{ errors = {{ {error} = \"{size} {unit}\" }}, \
             at_most = \"{limit} um\" }}\n"
        );
        let truth = if ratio > 1.0 { "holds" } else { "differs" };
        assert_eq!(support::verdict(PLANAR, &file), truth, "{ratio}: {file}");
    }
}
