//! Inverse corrections of C++, MATLAB and JAX: with the readings that they give, the interpreter shows what it shows without
//! errors at the readings that they were asked for.

use std::fs;
use std::path::Path;
use std::process::Command;

use codegen::{Form, Interpreter, Language, Unit, build, generate};
use model_core::{Chain, SymbolId, SymbolKind};

use crate::{folder, output};

const ARM: &str = "chain Arm {
    body turn on ground { motion: Rz(a); motion_error: Rz(index), Rx(wobble), Tz(lift); }
    body upper on turn { position: Tx(0.4); motion: Ry(b); motion_error: Ry(bend*cos(b)), Rz(skew); }
    body slide on upper { motion: Tx(c); motion_error: Ty(side), Rz(0.1*skew); }
    observe tip: point(0.2, 0, 0.1) of slide;
    observe axis: direction(1, 0, 0) of slide;
}";
const ERRORS: [(&str, f64); 6] =
    [("index", 3e-3), ("wobble", -2e-3), ("lift", 1e-3), ("bend", 4e-3), ("skew", 2e-3), ("side", -3e-3)];
const POSES: [[f64; 3]; 3] = [[0.3, -0.5, 0.2], [2.1, 0.7, 0.5], [-1.2, 0.1, 0.35]];

/// What is shown at some readings, with the errors or without.
fn shown(chain: &Chain, observable: usize, joints: &[f64], with_errors: bool) -> Vec<f64> {
    let mut values = chain.nominal_values();
    for (name, value) in ERRORS.iter().filter(|_| with_errors) {
        values[chain.find_symbol(name).unwrap().index()] = *value;
    }
    let ids: Vec<SymbolId> = chain.symbols_of(SymbolKind::Joint).collect();
    for (id, value) in ids.iter().zip(joints) {
        values[id.index()] = *value;
    }
    let id = model_core::ObservableId(u16::try_from(observable).unwrap());
    let program = build(chain, &[id], Form::ExactValue, &[]);
    let mut out = vec![0.0; program.outputs().len()];
    Interpreter::new(&program).eval(&values, &mut out).unwrap();
    out
}

/// Checks what a driver printed: for each observable and pose, three corrections and what remains.
fn check(printed: &str) {
    let chain = Chain::from_text(ARM).unwrap();
    let mut numbers = printed.split_whitespace().map(|number| number.parse::<f64>().unwrap());
    for observable in 0..2 {
        for pose in POSES {
            let correction: [f64; 3] = std::array::from_fn(|_| numbers.next().unwrap());
            let remaining = numbers.next().unwrap();
            assert!(remaining < 1e-14, "{remaining}");
            let size = correction.iter().map(|part| part.abs()).fold(0.0, f64::max);
            assert!((1e-4..0.05).contains(&size), "{correction:?}");
            let moved: Vec<f64> = pose.iter().zip(correction).map(|(joint, by)| joint + by).collect();
            let (wanted, found) =
                (shown(&chain, observable, &pose, false), shown(&chain, observable, &moved, true));
            for (wanted, found) in wanted.iter().zip(found) {
                assert!((wanted - found).abs() < 1e-12, "{observable}, {pose:?}: {found} is not {wanted}");
            }
        }
    }
    assert_eq!(numbers.next(), None);
}

fn write(language: Language, folder: &Path) {
    let chain = Chain::from_text(ARM).unwrap();
    let observables = [model_core::ObservableId(0), model_core::ObservableId(1)];
    let forms = [Form::ExactValue, Form::ExactError, Form::ExactJacobian];
    let unit = Unit::new(&chain, ARM, &observables, &forms);
    for file in generate(&unit, language, "arm").unwrap() {
        fs::write(folder.join(format!("arm.{}", file.extension)), file.text).unwrap();
    }
}

/// `index = 0.003`, each between others.
fn errors(each: &dyn Fn(&str, f64) -> String) -> String {
    ERRORS.iter().map(|&(name, value)| each(name, value)).collect::<Vec<_>>().join("")
}

#[test]
fn cpp() {
    let Some(compiler) = testkit::tool(testkit::CXX) else { return };
    let folder = folder("inverse-cpp");
    write(Language::Cpp, &folder);
    let poses = POSES.map(|[a, b, c]| format!("{{{a:?}, {b:?}, {c:?}}}")).join(", ");
    let of = |observable: &str| {
        format!(
            "    for (const of::Joints& joints : poses) {{
        of::Joints by;
        const double remaining = of::inverse_correction_{observable}(value, error, joints, by);
        std::printf(\"%.17g %.17g %.17g %.17g\\n\", by.a, by.b, by.c, remaining);
    }}
"
        )
    };
    let main = format!(
        "#include <cstdio>\n#include \"arm.hpp\"\nint main() {{\n    namespace of = trueaxis::arm;\n    of::Errors errors{{}};\n{}\
         \x20   const of::Joints poses[] = {{{poses}}};\n    const of::ExactValue value(errors);\n    const of::ExactError error(errors);\n{}{}}}\n",
        errors(&|name, value| format!("    errors.{name} = {value:?};\n")),
        of("tip"),
        of("axis")
    );
    fs::write(folder.join("main.cpp"), main).unwrap();
    let strict =
        ["-std=c++17", "-Wall", "-Wextra", "-Werror", "-pedantic", "-o", "main", "main.cpp", "arm.cpp"];
    output(Command::new(compiler).current_dir(&folder).args(strict));
    check(&output(&mut Command::new(folder.join("main"))));
}

#[test]
fn matlab() {
    let Some(octave) = testkit::tool(testkit::OCTAVE) else { return };
    let folder = folder("inverse-matlab");
    write(Language::Matlab, &folder);
    let column = |joint: usize| POSES.map(|pose| format!("{:?}", pose[joint])).join(", ");
    let main = format!(
        "of = arm();\nerrors = of.no_errors;\n{}joints = struct('a', [{}], 'b', [{}], 'c', [{}]);
value = of.prepare_exact_value(errors);\nwithout = of.prepare_exact_error(errors);
for name = {{'tip', 'axis'}}
  [by, remaining] = of.inverse_correction(name{{1}}, value, without, joints);
  printf('%.17g %.17g %.17g %.17g\\n', [by.a; by.b; by.c; remaining]);
end
",
        errors(&|name, value| format!("errors.{name} = {value:?};\n")),
        column(0),
        column(1),
        column(2)
    );
    fs::write(folder.join("main.m"), main).unwrap();
    let quiet = ["--no-history", "--norc", "--quiet", "main.m"];
    check(&output(Command::new(octave).current_dir(&folder).args(quiet)));
}

/// With `jit` and `vmap`; and derivatives by JAX itself agree with the file's own.
#[test]
fn jax() {
    let Some(python) = testkit::tool(testkit::JAX) else { return };
    let folder = folder("inverse-jax");
    write(Language::Jax, &folder);
    let column = |joint: usize| POSES.map(|pose| format!("{:?}", pose[joint])).join(", ");
    let main = format!(
        "import jax
jax.config.update('jax_enable_x64', True)
import jax.numpy as jnp
import arm

errors = arm.Errors({})
joints = arm.Joints(*jnp.array([[{}], [{}], [{}]]))
value, error = arm.prepare_exact_value(errors), arm.prepare_exact_error(errors)
for name in ['tip', 'axis']:
    each = jax.jit(jax.vmap(lambda joints: arm.inverse_correction(name, value, error, joints)))
    by, remaining = each(joints)
    for row in zip(*by, remaining):
        print(*(repr(float(number)) for number in row))

pose = arm.Joints(0.3, -0.5, 0.2)
exact = lambda errors: arm.exact_value(arm.prepare_exact_value(errors), pose)
jacobian = jax.jit(arm.exact_jacobian)(arm.prepare_exact_jacobian(errors), pose)
for own, derived in zip(jacobian, jax.jacfwd(exact)(errors)):
    for column, derivative in enumerate(derived):
        assert jnp.abs(own[:, column] - derivative).max() < 1e-14, (column, own, derivative)
gradient = jax.grad(lambda errors: exact(errors).tip[1])(errors)
for column, derivative in enumerate(gradient):
    assert abs(jacobian.tip[1, column] - derivative) < 1e-14
",
        errors(&|name, value| format!("{name}={value:?}, ")),
        column(0),
        column(1),
        column(2)
    );
    fs::write(folder.join("main.py"), main).unwrap();
    check(&output(Command::new(python).current_dir(&folder).arg("main.py")));
}
