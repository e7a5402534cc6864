//! Names of other fields: each is held to the column that the algebra derives from a chain at its place.

use effects::catalogue::{catalogue, chosen, known_names, published};
use model_core::algebra::{AngleSum, Poly};
use model_core::{Chain, SymbolId, forms, syntax};

use crate::support::{Asked, SCANNER, example, mounts};

/// Unit vectors across, along and out of a line of sight at azimuth `a` and elevation `e`.
fn frame(a: SymbolId, e: SymbolId) -> [[Poly; 3]; 3] {
    let (cos_a, sin_a) = AngleSum::symbol(a).cos_sin();
    let (cos_e, sin_e) = AngleSum::symbol(e).cos_sin();
    [
        [cos_a.clone(), -&sin_a, Poly::zero()],
        [-&(&sin_a * &sin_e), -&(&cos_a * &sin_e), cos_e.clone()],
        [&sin_a * &cos_e, &cos_a * &cos_e, sin_e],
    ]
}

/// A published formula, read with the chain's own symbols; `None` for a formula of another mount.
fn formula(text: &str, chain: &Chain, mount: &Mount) -> Option<Poly> {
    let resolve = |name: &str| {
        if name == "z" {
            return chain.sight_angles.first().map(|angle| angle.symbol);
        }
        let joint = mount.letters.iter().position(|letter| *letter == name).map(|at| mount.joints[at]);
        chain.find_symbol(joint.unwrap_or(if name == "R" { "range" } else { name }))
    };
    let text = if text.is_empty() { "0" } else { text };
    Poly::from_expr(&syntax::parse_amount(text).unwrap(), resolve, |_| true).ok()
}

/// How a mount calls its joints, and how published formulas do.
struct Mount {
    joints: [&'static str; 2],
    letters: [&'static str; 2],
}

/// Whether two formulas are one another's multiples at every pose, by a number or by a function of the latitude.
fn alike(a: &[Poly], b: &[Poly], chain: &Chain) -> bool {
    let first = a.iter().zip(b).find(|(a, b)| !a.is_zero() && !b.is_zero());
    let Some((first_a, first_b)) = first else { return false };
    let number = |p: &Poly| p.terms().next().map(|term| term.coefficient);
    let (Some(of_a), Some(of_b)) = (number(first_a), number(first_b)) else { return false };
    let latitude = chain.find_symbol("latitude").map_or_else(AngleSum::default, AngleSum::symbol);
    [Poly::one(), Poly::cos(&latitude), Poly::sin(&latitude)].into_iter().any(|factor| {
        let (of_a, of_b) = (factor.scale(&of_a), Poly::one().scale(&of_b));
        a.iter().zip(b).all(|(a, b)| a * &of_b == b * &of_a)
    })
}

#[test]
fn every_name_is_the_column_that_the_chain_has_at_that_place() {
    let plain = || Mount { joints: ["azimuth", "elevation"], letters: ["A", "E"] };
    let kinds = [plain(), Mount { joints: ["ha", "dec"], letters: ["h", "d"] }, plain()];
    let mut held: Vec<(&str, String)> = Vec::new();
    for (asked, mount) in mounts().iter().zip(kinds) {
        let effects = asked.catalogue();
        let names = known_names(&asked.setting(), &effects);
        let observable = asked.observables[0];
        for (effect, names) in effects.iter().zip(&names).filter(|(_, names)| !names.is_empty()) {
            // By another way than the catalogue's: the first order of the exact product with the effect in it.
            let (amended, errors) = effect.add_to(&asked.plan.chain).unwrap();
            let columns = forms::derive(&amended, observable, 1).unwrap().columns(&amended);
            let frame = frame(
                amended.find_symbol(mount.joints[0]).unwrap(),
                amended.find_symbol(mount.joints[1]).unwrap(),
            );
            let ranged = amended.find_symbol("range").is_some();
            let shapes: Vec<Vec<Poly>> = errors
                .iter()
                .map(|error| {
                    let (_, column) = columns.iter().find(|(id, _)| id == error).unwrap();
                    let part = |direction: &[Poly; 3]| {
                        direction.iter().zip(column).fold(Poly::zero(), |sum, (d, c)| &sum + &(d * c))
                    };
                    frame.iter().take(if ranged { 3 } else { 2 }).map(part).collect()
                })
                .collect();
            for name in names {
                let published = published();
                let holds = published
                    .iter()
                    .filter(|published| published.name == name.name && published.field == name.field)
                    .any(|published| {
                        let parts = [&published.across, &published.along, &published.radial];
                        let parts = parts.into_iter().take(if ranged { 3 } else { 2 });
                        let known: Option<Vec<Poly>> =
                            parts.map(|text| formula(text, &amended, &mount)).collect();
                        known.is_some_and(|known| shapes.iter().any(|shape| alike(shape, &known, &amended)))
                    });
                assert!(holds, "{name} is not the column of {}", effect.name);
                held.push((name.field, name.name.clone()));
            }
        }
    }
    held.sort();
    held.dedup();
    assert!(held.len() > 60, "{}", held.len());
}

#[test]
fn names_belong_to_the_effects_that_their_fields_mean() {
    let [alt_azimuth, equatorial, scanner] = mounts();
    let check = |asked: &Asked, wanted: &[(&str, &str)]| {
        let effects = asked.catalogue();
        let names = known_names(&asked.setting(), &effects);
        for (name, effect) in wanted {
            let found: Vec<&str> = effects
                .iter()
                .zip(&names)
                .filter(|(_, names)| names.iter().any(|known| known.name == *name))
                .map(|(effect, _)| effect.name.as_str())
                .collect();
            assert!(found.contains(effect), "{name} is {found:?}, not {effect}");
        }
    };
    check(
        &alt_azimuth,
        &[
            ("IA", "constant rotation of fork about z"),
            ("IE", "constant rotation of tube about x"),
            ("CA", "constant rotation of tube about z"),
            ("NPAE", "constant rotation of tube axis about y"),
            ("AN", "constant rotation of fork axis about x"),
            ("AW", "constant rotation of fork axis about y"),
            ("TF", "gravity flexure of tube about x"),
            ("TX", "refraction, cot of elevation"),
            ("ACES", "encoder eccentricity of azimuth"),
            ("ECEC", "encoder eccentricity of elevation"),
            ("HASA2", "encoder ellipticity of azimuth"),
            ("HZCZ", "encoder eccentricity of elevation"),
            ("HECA", "coupling of azimuth into tube about x, harmonic 1"),
            ("HSCA2", "coupling of azimuth into tube about z, harmonic 2"),
            ("HSSE3", "tilt about z of the elevation axis, 3 per turn"),
        ],
    );
    check(
        &equatorial,
        &[
            ("IH", "constant rotation of fork about z"),
            ("ID", "constant rotation of tube about x"),
            ("CH", "constant rotation of tube about z"),
            ("NP", "constant rotation of tube axis about y"),
            ("ME", "constant rotation of fork axis about x"),
            ("MA", "constant rotation of fork axis about y"),
            ("TF", "droop of tube under gravity"),
            ("TX", "refraction, tangent of the zenith distance"),
            ("FO", "gravity flexure of fork about x"),
            ("DAF", "gravity flexure of tube about z"),
            ("HCES", "encoder eccentricity of ha"),
            ("DCEC", "encoder eccentricity of dec"),
            ("PHH", "encoder scale of ha"),
            ("HDSD4", "encoder error of dec, 4 per turn"),
        ],
    );
    check(
        &scanner,
        &[
            ("A0", "range zero"),
            ("A1", "range scale"),
            ("B3", "encoder eccentricity of azimuth"),
            ("B4", "encoder ellipticity of azimuth"),
            ("B6", "constant rotation of telescope about z"),
            ("B7", "constant rotation of telescope axis about y"),
            ("C0", "constant rotation of telescope about x"),
            ("x2", "constant shift of telescope axis along y"),
            ("x3", "constant shift of telescope along x"),
            ("x7", "constant rotation of telescope axis about y"),
            ("x8x", "encoder eccentricity of azimuth"),
            ("x9z", "encoder eccentricity of elevation"),
            ("x10", "range zero"),
            ("x12a", "encoder ellipticity of elevation"),
        ],
    );
}

#[test]
fn a_line_of_sight_that_runs_otherwise_has_no_names() {
    let chain = example("mobile-lidar/mobile-lidar.chain");
    let asked = Asked::of(&chain, "pointing", "direction", "");
    let names = known_names(&asked.setting(), &asked.catalogue());
    assert!(names.iter().all(Vec::is_empty));
}

#[test]
fn a_study_chooses_by_any_name() {
    let chosen_by = |words: &[&str]| -> Vec<String> {
        let asked = Asked::of(&example("alt-azimuth/alt-azimuth.chain"), "sight", "direction", "");
        let setting = asked.setting();
        let words: Vec<String> = words.iter().map(|word| (*word).to_owned()).collect();
        let kept = chosen(&setting, catalogue(&setting), &words).unwrap();
        kept.into_iter().map(|effect| effect.name).collect()
    };
    // A fork that leans, or a tube that bends sideways as it is raised, looks the same.
    assert_eq!(
        chosen_by(&["TPOINT NPAE"]),
        [
            "constant rotation of fork about y",
            "constant rotation of tube axis about y",
            "gravity flexure of tube about z"
        ]
    );
    assert_eq!(
        chosen_by(&["refraction", "encoder scale of *"]),
        [
            "encoder scale of azimuth",
            "encoder scale of elevation",
            "refraction, cot of elevation",
            "refraction, cube of cot of elevation"
        ]
    );
    let with = Asked::of(SCANNER, "target", "point", "[search]\neffects = [\"x10\"]\n");
    assert_eq!(with.plan.search.only, ["x10"]);
}
