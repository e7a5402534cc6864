"""A chain over arrays from Python, interpreted and compiled, beside generated C and Rust that nothing stands around.

    python benches/python/compiled.py [--rounds N]

For the mobile lidar (30 errors, direction), a million random poses, one thread, results into arrays that are there: nanoseconds a
row of the thread's processor time, the least of rounds in which all take turns. C and Rust are the functions of many poses that
`Chain.generate` writes, called with columns once their form is prepared. Needs the Python package, cc and rustc; not part of CI.
"""

import argparse
import ctypes
import pathlib
import subprocess
import tempfile
import time

import numpy as np

import trueaxis

ROOT = pathlib.Path(__file__).resolve().parents[2]
ROWS = 1_000_000
FORMS = {
    "first-order error": "first_order_error",
    "exact error": "exact_error",
    "first-order Jacobian": "first_order_jacobian",
    "exact Jacobian": "exact_jacobian",
}


def c_library(chain, folder):
    """The generated C with a function a form that takes errors and columns, and prepares once."""
    text = chain.generate("c", "pointing")
    for ending, content in text.items():
        (folder / f"mobile_lidar.{ending}").write_text(content)
    fields = ", ".join(f"errors[{at}]" for at in range(len(chain.errors)))
    joints = ", ".join(f"pose[{at}]" for at in range(len(chain.joints)))
    code = '#include "mobile_lidar.c"\n'
    for form in FORMS.values():
        is_jacobian = form.endswith("jacobian")
        result = "jacobian" if is_jacobian else "observed"
        outs = (
            f"for (int i = 0; i < 3; i++) for (int k = 0; k < {len(chain.errors)}; k++) "
            f"out.pointing[i][k] = into + (i * {len(chain.errors)} + k) * rows;"
            if is_jacobian
            else "for (int i = 0; i < 3; i++) out.pointing[i] = into + i * rows;"
        )
        code += (
            f"static mobile_lidar_{form}_prepared prepared_{form};\n"
            f"void prepare_{form}(const double *errors) {{ mobile_lidar_errors given = {{ {fields} }};"
            f" mobile_lidar_{form}_prepare(&given, &prepared_{form}); }}\n"
            f"void rows_{form}(size_t rows, const double *const *pose, double *into) {{\n"
            f"    mobile_lidar_joint_rows joints = {{ {joints} }}; mobile_lidar_{result}_rows out;\n    {outs}\n"
            f"    mobile_lidar_{form}_rows(&prepared_{form}, rows, &joints, &out); }}\n"
        )
    (folder / "c.c").write_text(code)
    options = ["-O3", "-ffp-contract=off", "-std=c99", "-shared", "-fPIC"]
    subprocess.run(["cc", *options, "-o", folder / "c.so", folder / "c.c"], check=True)
    return ctypes.CDLL(str(folder / "c.so"))


def rust_library(chain, folder):
    """The same of generated Rust."""
    (folder / "mobile_lidar.rs").write_text(chain.generate("rust", "pointing")["rs"])
    fields = ", ".join(f"{name}: e[{at}]" for at, name in enumerate(chain.errors))
    joints = ", ".join(f"{name}: column({at})" for at, name in enumerate(chain.joints))
    code = (
        "#[allow(dead_code)] mod lidar { include!(\"mobile_lidar.rs\"); }\n"
        "use lidar::*;\nuse std::slice::{from_raw_parts, from_raw_parts_mut};\nuse std::sync::OnceLock;\n"
    )
    for form in FORMS.values():
        kind = "".join(word.capitalize() for word in form.split("_"))
        static, many = f"PREPARED_{form.upper()}", len(chain.errors)
        column = "unsafe { from_raw_parts_mut(into.add((i * MANY + k) * rows), rows) }"
        if form.endswith("jacobian"):
            out = f"Observed {{ pointing: std::array::from_fn(|i| std::array::from_fn(|k| {column.replace('MANY', str(many))})) }}"
        else:
            out = f"Observed {{ pointing: std::array::from_fn(|i| {column.replace('MANY + k', '1')}) }}"
        code += (
            f"static {static}: OnceLock<{kind}> = OnceLock::new();\n"
            f'#[unsafe(no_mangle)] pub unsafe extern "C" fn prepare_{form}(e: *const f64) {{\n'
            f"    let e = unsafe {{ from_raw_parts(e, {many}) }};\n"
            f"    {static}.get_or_init(|| {kind}::prepare(&Errors {{ {fields} }})); }}\n"
            f'#[unsafe(no_mangle)] pub unsafe extern "C" fn rows_{form}(rows: usize, pose: *const *const f64, into: *mut f64) {{\n'
            "    let column = |i| unsafe { from_raw_parts(*pose.add(i), rows) };\n"
            f"    let joints = JointRows {{ {joints} }};\n"
            f"    {static}.get().unwrap().eval_rows(&joints, {out}).unwrap(); }}\n"
        )
    (folder / "rust.rs").write_text(code)
    options = ["--edition", "2024", "-C", "opt-level=3", "--crate-type", "cdylib", "-A", "warnings"]
    subprocess.run(["rustc", *options, "-o", folder / "rust.so", folder / "rust.rs"], check=True)
    return ctypes.CDLL(str(folder / "rust.so"))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=15)
    rounds = parser.parse_args().rounds
    chain = trueaxis.Chain.from_file(ROOT / "examples" / "mobile-lidar" / "mobile-lidar.chain")
    start = time.perf_counter()
    compiled = chain.compiled("pointing")
    print(f"compiled in {time.perf_counter() - start:.1f} s")
    random = np.random.default_rng(1)
    readings = {name: random.uniform(-np.pi, np.pi, ROWS) for name in chain.joints}
    errors = {name: float(random.uniform(-1e-4, 1e-4)) for name in chain.errors}
    pose = (ctypes.c_void_p * len(readings))(*(column.ctypes.data for column in readings.values()))
    values = np.array([errors[name] for name in chain.errors])

    def forms_of(it, observable=None):
        one = {"errors": errors, "observable": observable, "threads": 1}
        return {
            "first-order error": lambda out: it.first_order(readings, out=out, **one),
            "exact error": lambda out: it.exact(readings, out=out, **one),
            "first-order Jacobian": lambda out: it.jacobian(readings, out=out, **one),
            "exact Jacobian": lambda out: it.jacobian(readings, form="exact", out=out, **one),
        }

    def forms_in(library):
        def bare(form):
            getattr(library, f"prepare_{form}")(ctypes.c_void_p(values.ctypes.data))
            rows = getattr(library, f"rows_{form}")
            rows.argtypes, rows.restype = [ctypes.c_size_t, ctypes.c_void_p, ctypes.c_void_p], None
            return lambda out: rows(ROWS, ctypes.addressof(pose), out.ctypes.data)

        return {name: bare(form) for name, form in FORMS.items()}

    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        candidates = {
            "Python, interpreted": forms_of(chain, "pointing"),
            "Python, compiled": forms_of(compiled),
            "generated C": forms_in(c_library(chain, folder)),
            "generated Rust": forms_in(rust_library(chain, folder)),
        }
        print(f"{'form':22}" + "".join(f"{name:>22}" for name in candidates) + f"{'Rust / compiled':>18}")
        for form in FORMS:
            shape = (3, len(chain.errors), ROWS) if form.endswith("Jacobian") else (3, ROWS)
            expected, out = np.empty(shape), np.empty(shape)
            candidates["Python, interpreted"][form](expected)
            for name, forms in candidates.items():
                forms[form](out)
                assert np.abs(out - expected).max() < 1e-14, (form, name)
            del expected
            best = dict.fromkeys(candidates, np.inf)
            turns = list(candidates)
            for _ in range(rounds):
                # Whoever comes after another finds its caches.
                turns.append(turns.pop(0))
                for name in turns:
                    start = time.thread_time_ns()
                    candidates[name][form](out)
                    best[name] = min(best[name], (time.thread_time_ns() - start) / ROWS)
            ratio = best["generated Rust"] / best["Python, compiled"]
            print(f"{form:22}" + "".join(f"{ns:22.2f}" for ns in best.values()) + f"{ratio:18.2f}", flush=True)
    few = {name: column[:64] for name, column in readings.items()}
    for name, it in [("interpreted", chain), ("compiled", compiled)]:
        times = []
        for _ in range(2000):
            start = time.thread_time_ns()
            it.exact(few, errors, "pointing")
            times.append(time.thread_time_ns() - start)
        print(f"a call of 64 rows, {name}: {min(times) / 1000:.0f} µs")


if __name__ == "__main__":
    main()
