//! What a calibration adds to a file, in every language that runs: standard uncertainties against J C Jᵀ by a Jacobian of
//! the interpreter, the measured region, and the last day.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Command;

use codegen::{Calibrated, Covariance, Form, Interpreter, Language, Measured, Unit, build, generate};
use model_core::{Chain, ObservableId, SymbolId};

use crate::{folder, output};

const MOUNT: &str = "chain Mount {
    const arm: length = 0.5;
    input range: length;
    body fork on ground { position_error: Rx(tilt); motion: Rz(azimuth); motion_error: Rz(index); }
    body tube on fork { position: Tz(arm); motion: Rx(elevation); motion_error: Rx(zero + sag*cos(elevation)), Ty(shift); }
    observe sight: direction(0, 1, 0) of tube;
    observe target: point(0, range, 0) of tube;
}";
const VALUES: [(&str, f64); 5] =
    [("tilt", 2e-4), ("index", -1e-3), ("zero", 3e-4), ("sag", 5e-5), ("shift", 2e-3)];
/// The constant is an estimate too; what `zero` and `sag` come to is known better than either.
const OF: [&str; 6] = ["tilt", "zero", "sag", "index", "shift", "arm"];
const SIGMAS: [f64; 6] = [1e-5, 4e-4, 4e-4, 2e-5, 1e-4, 3e-4];
/// Azimuth, elevation, range; and whether it is inside.
const POSES: [([f64; 3], bool); 7] = [
    ([0.3, 0.2, 5.0], true),
    ([0.3 + std::f64::consts::TAU, 0.9, 7.0], true),
    ([-0.1, 0.2, 5.0], false),
    ([1.1, 0.1, 8.0], false),
    ([0.5, 1.3, 5.0], false),
    ([0.5, 1.0, 2.9], false),
    ([0.5, f64::NAN, 5.0], false),
];

struct Case {
    chain: Chain,
    named: Vec<(SymbolId, f64)>,
    of: Vec<SymbolId>,
    rows: Vec<Vec<f64>>,
    region: Vec<Measured>,
}

impl Case {
    fn new() -> Self {
        let chain = Chain::from_text(MOUNT).unwrap();
        let id = |name: &str| chain.find_symbol(name).unwrap();
        let correlation = |a: usize, b: usize| match (a.min(b), a.max(b)) {
            (a, b) if a == b => 1.0,
            (1, 2) => -0.999,
            (0, 3) => 0.4,
            _ => 0.0,
        };
        let rows =
            (0..6).map(|a| (0..6).map(|b| SIGMAS[a] * SIGMAS[b] * correlation(a, b)).collect()).collect();
        let range = |name: &str, low, high, turns| Measured { symbol: id(name), low, high, turns };
        let region = vec![
            range("azimuth", 0.0, 1.0, true),
            range("elevation", 0.1, 1.2, true),
            range("range", 3.0, 9.0, false),
        ];
        let named = VALUES.map(|(name, value)| (id(name), value)).to_vec();
        Self { of: OF.map(id).to_vec(), named, rows, region, chain }
    }

    fn write(&self, language: Language, folder: &Path) {
        let observables = [ObservableId(0), ObservableId(1)];
        let covariance = Some(Covariance { of: &self.of, rows: &self.rows });
        let calibrated = Calibrated { covariance, region: &self.region, valid_until: Some("2027-06-30") };
        let unit = Unit {
            values: &self.named,
            calibrated,
            ..Unit::new(&self.chain, MOUNT, &observables, &[Form::ExactError, Form::Uncertainty])
        };
        for file in generate(&unit, language, "mount").unwrap() {
            fs::write(folder.join(format!("mount.{}", file.extension)), file.text).unwrap();
        }
    }

    /// √(J C Jᵀ), component by component.
    fn expected(&self, pose: &[f64; 3]) -> Vec<f64> {
        let observables = [ObservableId(0), ObservableId(1)];
        let program = build(&self.chain, &observables, Form::ExactJacobian, &self.of);
        let mut values = self.chain.nominal_values();
        for (id, value) in &self.named {
            values[id.index()] = *value;
        }
        for (name, value) in ["azimuth", "elevation", "range"].iter().zip(pose) {
            values[self.chain.find_symbol(name).unwrap().index()] = *value;
        }
        let mut out = vec![0.0; program.outputs().len()];
        Interpreter::new(&program).eval(&values, &mut out).unwrap();
        let variance = |row: &[f64]| -> f64 {
            let pairs = (0..6).flat_map(|a| (0..6).map(move |b| (a, b)));
            pairs.map(|(a, b)| row[a] * row[b] * self.rows[a][b]).sum()
        };
        out.chunks(6).map(|row| variance(row).sqrt()).collect()
    }

    /// Checks what a driver printed: the day; for each pose six uncertainties, and 1 inside or 0 outside; then, if there are
    /// functions of many poses, six uncertainties of each pose again.
    fn check(&self, printed: &str, has_rows: bool) {
        let mut words = printed.split_whitespace();
        assert_eq!(words.next(), Some("2027-06-30"));
        let mut numbers = words.map(|word| word.parse::<f64>().unwrap_or_else(|_| panic!("{word}")));
        for is_single in [true, false].into_iter().take(if has_rows { 2 } else { 1 }) {
            for (pose, is_inside) in POSES {
                for expected in self.expected(&pose) {
                    let found = numbers.next().unwrap();
                    let is_same = (found - expected).abs() <= 1e-12 * expected.max(1e-5);
                    assert!(
                        is_same || found.is_nan() && expected.is_nan(),
                        "{pose:?}: {found} is not {expected}"
                    );
                }
                if is_single {
                    assert_eq!(numbers.next(), Some(if is_inside { 1.0 } else { 0.0 }), "{pose:?}");
                }
            }
        }
        assert_eq!(numbers.next(), None);
    }
}

/// A joint or input of all poses, as a language writes numbers.
fn column(at: usize, not_a_number: &str) -> String {
    let text = |(pose, _): ([f64; 3], bool)| match pose[at] {
        number if number.is_nan() => not_a_number.to_owned(),
        number => format!("{number:?}"),
    };
    POSES.map(text).join(", ")
}

#[test]
fn rust() {
    let (case, folder) = (Case::new(), folder("calibrated-rust"));
    case.write(Language::Rust, &folder);
    let [azimuth, elevation, range] = [0, 1, 2].map(|at| column(at, "f64::NAN"));
    let main = format!(
        "#[allow(dead_code)]\nmod mount;\nuse mount::*;\nfn main() {{
    println!(\"{{VALID_UNTIL}}\");
    let (azimuth, elevation, range) = ([{azimuth}], [{elevation}], [{range}]);
    let prepared = Uncertainty::prepare();
    for row in 0..{count} {{
        let (joints, inputs) = (Joints {{ azimuth: azimuth[row], elevation: elevation[row] }}, Inputs {{ range: range[row] }});
        let out = prepared.eval(&joints, &inputs);
        for number in out.sight.into_iter().chain(out.target) {{ println!(\"{{number:?}}\"); }}
        println!(\"{{}}\", u8::from(in_measured_region(&joints, &inputs)));
    }}
    let mut rows = [[0.0; {count}]; 6];
    let [a, b, c, d, e, f] = &mut rows;
    let out = Observed {{ sight: [&mut a[..], b, c], target: [&mut d[..], e, f] }};
    prepared.eval_rows(&JointRows {{ azimuth: &azimuth, elevation: &elevation }}, &InputRows {{ range: &range }}, out).unwrap();
    for row in 0..{count} {{ for column in &rows {{ println!(\"{{:?}}\", column[row]); }} }}
}}
",
        count = POSES.len()
    );
    fs::write(folder.join("main.rs"), main).unwrap();
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    output(Command::new(rustc).current_dir(&folder).args(["--edition=2024", "-Dwarnings", "main.rs"]));
    case.check(&output(&mut Command::new(folder.join("main"))), true);
}

#[test]
fn c_and_cpp() {
    let (case, folder) = (Case::new(), folder("calibrated-c"));
    case.write(Language::C, &folder);
    let [azimuth, elevation, range] = [0, 1, 2].map(|at| column(at, "0.0 / 0.0"));
    let mut main = format!(
        "#include <stdio.h>\n#include \"mount.h\"\nint main(void) {{
    static const double azimuth[] = {{{azimuth}}}, elevation[] = {{{elevation}}}, range[] = {{{range}}};
    static double rows[6][{count}];
    const mount_joint_rows joint_rows = {{azimuth, elevation}};
    const mount_input_rows input_rows = {{range}};
    const mount_observed_rows out_rows = {{{{rows[0], rows[1], rows[2]}}, {{rows[3], rows[4], rows[5]}}}};
    mount_uncertainty_prepared prepared;
    int row, at;
    mount_uncertainty_prepare(&prepared);
    puts(mount_valid_until);
    for (row = 0; row < {count}; row++) {{
        const mount_joints joints = {{azimuth[row], elevation[row]}};
        const mount_inputs inputs = {{range[row]}};
        mount_observed out;
        mount_uncertainty(&prepared, &joints, &inputs, &out);
        for (at = 0; at < 6; at++)
            printf(\"%.17g\\n\", at < 3 ? out.sight[at] : out.target[at - 3]);
        printf(\"%d\\n\", mount_in_measured_region(&joints, &inputs));
    }}
    mount_uncertainty_rows(&prepared, {count}, &joint_rows, &input_rows, &out_rows);
    for (row = 0; row < {count}; row++)
        for (at = 0; at < 6; at++)
            printf(\"%.17g\\n\", rows[at][row]);
    return 0;
}}
",
        count = POSES.len()
    );
    fs::write(folder.join("main.c"), &main).unwrap();
    let strict = ["-Wall", "-Wextra", "-Werror", "-pedantic", "-o", "main"];
    let cc = std::env::var_os("CC").unwrap_or_else(|| "cc".into());
    output(Command::new(cc).current_dir(&folder).arg("-std=c99").args(strict).args(["main.c", "mount.c"]));
    case.check(&output(&mut Command::new(folder.join("main"))), true);

    let Some(compiler) = testkit::tool(testkit::CXX) else { return };
    case.write(Language::Cpp, &folder);
    main = main
        .replace("mount.h", "mount.hpp")
        .replace("puts(mount_valid_until)", "puts(trueaxis::mount::valid_until)")
        .replace(
            "mount_in_measured_region(&joints, &inputs)",
            "trueaxis::mount::in_measured_region(joints, inputs)",
        );
    fs::write(folder.join("main.cpp"), main).unwrap();
    output(
        Command::new(compiler)
            .current_dir(&folder)
            .arg("-std=c++17")
            .args(strict)
            .args(["main.cpp", "mount.cpp"]),
    );
    case.check(&output(&mut Command::new(folder.join("main"))), true);
}

#[test]
fn javascript() {
    let Some(node) = testkit::tool(testkit::NODE) else { return };
    let (case, folder) = (Case::new(), folder("calibrated-javascript"));
    case.write(Language::Javascript, &folder);
    let [azimuth, elevation, range] = [0, 1, 2].map(|at| column(at, "NaN"));
    let main = format!(
        "import {{ prepareUncertainty, uncertainty, inMeasuredRegion, validUntil }} from './mount.js';
const [azimuth, elevation, range] = [[{azimuth}], [{elevation}], [{range}]];
const p = prepareUncertainty();
console.log(validUntil);
azimuth.forEach((_, row) => {{
  const joints = {{ azimuth: azimuth[row], elevation: elevation[row] }}, inputs = {{ range: range[row] }};
  Object.values(uncertainty(p, joints, inputs)).flat().forEach((number) => console.log(String(number)));
  console.log(inMeasuredRegion(joints, inputs) ? 1 : 0);
}});
"
    );
    fs::write(folder.join("package.json"), "{\"type\": \"module\"}").unwrap();
    fs::write(folder.join("main.js"), main).unwrap();
    case.check(&output(Command::new(node).current_dir(&folder).arg("main.js")), false);
}

/// NumPy and JAX.
fn python(language: Language, tool: testkit::Tool, name: &str, before: &str) {
    let Some(python) = testkit::tool(tool) else { return };
    let (case, folder) = (Case::new(), folder(name));
    case.write(language, &folder);
    let [azimuth, elevation, range] = [0, 1, 2].map(|at| column(at, "float('nan')"));
    let mut main = format!(
        "{before}import numpy as np
import mount

azimuth, elevation, range_ = np.array([{azimuth}]), np.array([{elevation}]), np.array([{range}])
p = mount.prepare_uncertainty()
print(mount.VALID_UNTIL)
out = mount.uncertainty(p, mount.Joints(azimuth, elevation), mount.Inputs(range_))
inside = mount.in_measured_region(mount.Joints(azimuth, elevation), mount.Inputs(range_))
"
    );
    for row in 0..POSES.len() {
        let _ = write!(
            main,
            "one = mount.uncertainty(p, mount.Joints(azimuth[{row}], elevation[{row}]), mount.Inputs(range_[{row}]))
print(*(repr(float(number)) for number in [*one.sight, *one.target]), int(inside[{row}]))
"
        );
    }
    main.push_str("for row in range(len(azimuth)):\n    print(*(repr(float(column[row])) for column in [*out.sight, *out.target]))\n");
    fs::write(folder.join("main.py"), main).unwrap();
    case.check(&output(Command::new(python).current_dir(&folder).arg("main.py")), true);
}

#[test]
fn numpy() {
    python(Language::Numpy, testkit::NUMPY, "calibrated-numpy", "");
}

#[test]
fn jax() {
    let double = "import jax\njax.config.update('jax_enable_x64', True)\n";
    python(Language::Jax, testkit::JAX, "calibrated-jax", double);
}

#[test]
fn matlab() {
    let Some(octave) = testkit::tool(testkit::OCTAVE) else { return };
    let (case, folder) = (Case::new(), folder("calibrated-matlab"));
    case.write(Language::Matlab, &folder);
    let [azimuth, elevation, range] = [0, 1, 2].map(|at| column(at, "NaN"));
    let main = format!(
        "of = mount();
joints = struct('azimuth', [{azimuth}], 'elevation', [{elevation}]);
inputs = struct('range', [{range}]);
p = of.prepare_uncertainty();
printf('%s\\n', of.valid_until);
out = of.uncertainty(p, joints, inputs);
printf('%.17g\\n', [out.sight; out.target; of.in_measured_region(joints, inputs)]);
printf('%.17g\\n', [out.sight; out.target]);
"
    );
    fs::write(folder.join("main.m"), main).unwrap();
    let quiet = ["--no-history", "--norc", "--quiet", "main.m"];
    case.check(&output(Command::new(octave).current_dir(&folder).args(quiet)), true);
}
