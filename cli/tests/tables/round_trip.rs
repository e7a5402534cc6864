//! `simulate` → `eval` → `apply` → `calibrate`, over names, units and formats: the numbers stay what they are.

use proptest::prelude::*;
use proptest::sample::select;

use crate::support::Folder;
use crate::{column, done, words};

/// Names that look like units, like other columns, or like anything.
const NAMES: [&str; 19] = [
    "table_turn",
    "az_deg",
    "az",
    "u_mm",
    "u",
    "humidity_ppm",
    "x_hour",
    "row",
    "weight",
    "t_x",
    "deg",
    "q_rad",
    "p_um",
    "tip_rad",
    "a_b_c",
    "m",
    "mas_mas",
    "x1",
    "x_inch",
];

/// Names that mean something in the declaration below, or in the language.
const TAKEN: [&str; 38] = [
    "arm",
    "table",
    "head",
    "twist",
    "drift",
    "lift",
    "shift",
    "roll",
    "tip",
    "beam",
    "tip_x",
    "tip_y",
    "tip_z",
    "beam_x",
    "beam_y",
    "beam_z",
    "chain",
    "body",
    "on",
    "ground",
    "position",
    "motion",
    "observe",
    "point",
    "direction",
    "of",
    "input",
    "const",
    "length",
    "angle",
    "number",
    "pi",
    "sin",
    "cos",
    "tan",
    "cot",
    "sqrt",
    "ramp",
];

/// Three names, those above or any others, with or without the ending of a unit.
fn three_names() -> impl Strategy<Value = [String; 3]> {
    let any = "[a-z][a-z0-9_]{0,7}(_(deg|rad|arcsec|mm|um|m|km|mas|hour|inch|ppm|turn))?";
    let one = prop_oneof![select(&NAMES[..]).prop_map(str::to_owned), any];
    proptest::array::uniform3(one).prop_filter("three names that are free", |names| {
        let free = |name: &String| {
            let is_plain = !name.ends_with('_') && !name.contains("__");
            is_plain && !TAKEN.contains(&name.as_str()) && model_core::validate::is_name(name)
        };
        names.iter().all(free) && names[0] != names[1] && names[1] != names[2] && names[0] != names[2]
    })
}

#[cfg(feature = "parquet")]
const ENDINGS: [&str; 2] = ["csv", "parquet"];
#[cfg(not(feature = "parquet"))]
const ENDINGS: [&str; 1] = ["csv"];

fn declaration([turn, slide, input]: [&str; 3]) -> String {
    format!(
        "chain Named {{
    const arm: length = 0.25;
    input {input};
    body table on ground {{ motion: Rz({turn}); motion_error: Rz(twist + drift*{input}), Tz(lift); }}
    body head on table {{ position: Tx(arm); motion: Ty({slide}); motion_error: Ty(shift), Rx(roll); }}
    observe tip: point(0.1, 0.2, 0.3) of head;
    observe beam: direction(0, 1, 0) of head;
}}
"
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn what_a_command_writes_every_command_reads(
        names in three_names(),
        endings in proptest::array::uniform3(select(&ENDINGS[..])),
        seed in 0_u32..1000,
    ) {
        let names = [&names[0], &names[1], &names[2]].map(String::as_str);
        let folder = Folder::new(&format!("round-trip-{seed}"));
        folder.write("named.chain", declaration(names));
        folder.write("e.toml", "twist = \"100 arcsec\"\ndrift = 1e-5\nlift = \"0.2 mm\"\nroll = 1e-4\nshift = \"-0.3 mm\"\n");
        let [turn, slide, input] = names;
        let [simulated, evaluated, applied] = [0, 1, 2].map(|at| format!("{at}.{}", endings[at]));
        let simulate = |noise: &[&str], out: &str| {
            let slide = format!("{slide}=-0.4..0.5 m");
            let input = format!("{input}=10..30");
            let mut arguments = vec!["simulate", "named.chain", "--errors", "e.toml", "--poses", "60", "--out", out];
            for noise in noise {
                arguments.extend(["--noise", noise]);
            }
            let seed = seed.to_string();
            let range = format!("{turn}=-100..170 deg");
            for range in [&range, &slide, &input] {
                arguments.extend(["--range", range]);
            }
            arguments.extend(["--seed", &seed]);
            assert_eq!(done(&folder.trueaxis(&arguments)), "");
        };
        simulate(&["0"], &simulated);
        simulate(&["0"], "simulated.csv");
        let exact = folder.read("simulated.csv");
        // Each of these reads what the one before it wrote, in its format, and computes the same again.
        for (command, data, out) in [
            ("eval named.chain --quantity value", &simulated, &evaluated),
            ("apply named.chain", &evaluated, &applied),
            ("apply named.chain", &applied, &"last.csv".to_owned()),
        ] {
            done(&words(&folder, &format!("{command} --errors e.toml --data {data} --out {out}")));
        }
        let last = folder.read("last.csv");
        prop_assert_eq!(exact.lines().count(), 61);
        let header = exact.lines().next().unwrap_or_default();
        for name in header.split(',') {
            let (exact, last) = (column(&exact, name), column(&last, name));
            if !name.starts_with("beam") {
                prop_assert_eq!(exact, last, "{}", name);
                continue;
            }
            // What is simulated is of length one to the last digit.
            for (exact, last) in exact.iter().zip(&last) {
                let (exact, last): (f64, f64) = (exact.parse()?, last.parse()?);
                prop_assert!((exact - last).abs() < 1e-15, "{}: {} and {}", name, exact, last);
            }
        }
        // The same rows tell the errors that they were made with.
        let noisy = format!("noisy.{}", endings[1]);
        simulate(&["1 arcsec", "1 um"], &noisy);
        folder.write("study.toml", format!(
            "chain = \"named.chain\"\nobservable = \"tip\"\ndata = \"{noisy}\"\n[observed]\nkind = \"point\"\n[search]\n\
             inputs = [\"{input}\"]\neffects = [\"encoder\"]\n[hold_out]\nfolds = 3\n"
        ));
        done(&words(&folder, "calibrate study.toml --out result"));
        done(&words(&folder, &format!(
            "apply result/amended.chain --errors result/errors.toml --data {applied} --observable tip --out told.csv"
        )));
        let told = folder.read("told.csv");
        for axis in ["tip_x", "tip_y", "tip_z"] {
            for (told, exact) in column(&told, axis).iter().zip(column(&exact, axis)) {
                let (told, exact): (f64, f64) = (told.parse()?, exact.parse()?);
                prop_assert!((told - exact).abs() < 1e-5, "{}: {} and {}", axis, told, exact);
            }
        }
        // What it says of each row is read again too.
        done(&words(&folder, "eval result/amended.chain --errors result/errors.toml --data result/residuals.csv \
            --observable tip --out again.csv"));
    }
}

#[test]
fn an_observable_whose_columns_have_the_name_of_a_joint_is_refused() {
    let folder = Folder::new("column-taken");
    folder.write("taken.chain", declaration(["tip_x", "u", "t"])).write("e.toml", "");
    folder.write("poses.csv", "tip_x [deg],u,t\n10,0.1,20\n");
    for words in [
        "eval taken.chain --errors e.toml --data poses.csv --out out.csv",
        "simulate taken.chain --errors e.toml --poses 3 --noise 0 --seed 1 --range u=0..1 --range t=0..1 --out out.csv",
    ] {
        let run = crate::words(&folder, words);
        assert_eq!(run.code, 2, "{run}");
        assert!(run.stderr.contains("`tip_x` is both a joint or input"), "{run}");
    }
}

#[test]
fn a_far_range_is_written_with_its_unit_and_read_without_a_doubt() {
    let folder = Folder::new("far");
    folder.write("named.chain", declaration(["turn", "slide", "t"])).write("e.toml", "");
    let simulate = "simulate named.chain --errors e.toml --poses 20 --noise 0 --seed 1 --range slide=0..90m --range t=0..1";
    let run = words(&folder, &format!("{simulate} --range turn=0..40turn --out far.csv"));
    assert_eq!(done(&run), "");
    assert!(folder.read("far.csv").starts_with("t,turn [rad],slide [m],"), "{}", folder.read("far.csv"));
    assert_eq!(
        done(&words(&folder, "apply named.chain --errors e.toml --data far.csv --observable beam --out -")),
        "warning: the input's own columns `beam_x`, `beam_y`, `beam_z` were replaced\n"
    );
}
