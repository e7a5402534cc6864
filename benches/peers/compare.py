"""Our generated code beside that of SymPy, CasADi, SymForce and wrenfold, in one run and one table.

    python3 benches/peers/compare.py [--rounds N]

Installs the peers from their packages into target/peers/venv, lets each write its code for the same three forms from
lidar.py, compiles it as delivered (one call a row, -O3 for the processor at hand) with ours from `trueaxis generate`, holds
every one against ours on a thousand poses, and times them in turns. A peer that does not install, generate or compile is
said so in the table. Needs cc, c++ and cargo; not part of CI.
"""

import argparse
import csv
import os
import pathlib
import platform
import subprocess
import sys
import venv

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
BUILD = ROOT / "target" / "peers"
PYTHON = BUILD / "venv" / "bin" / "python"
PACKAGES = {"SymPy": "sympy", "CasADi": "casadi", "SymForce": "symforce", "wrenfold": "wrenfold"}
# Needed ratios: the fastest peer's time over ours.
GOALS = {"first_order_error": 17, "exact_error": 29, "first_order_jacobian": 11}


def run(*command, **options):
    """Runs a command; returns why it failed, or None."""
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False, **options)
    if done.returncode == 0:
        return None
    lines = (done.stderr or done.stdout).strip().splitlines()
    return lines[-1] if lines else f"exit code {done.returncode}"


def install():
    """Why each peer is not there, or None."""
    if not PYTHON.exists():
        venv.create(BUILD / "venv", with_pip=True)
    return {peer: run(PYTHON, "-m", "pip", "install", "--quiet", package) for peer, package in PACKAGES.items()}


def generate(peer, form):
    """Lets a peer write its code, in its own process; returns the sources or why there are none."""
    folder = BUILD / peer.lower()
    code = f"import sys; sys.path.insert(0, {str(HERE)!r}); import generators; print(*generators.write({peer!r}, {form!r}, {str(folder)!r}), sep='\\n')"
    done = subprocess.run([PYTHON, "-c", code], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        return None, done.stderr.strip().splitlines()[-1]
    return [pathlib.Path(line) for line in done.stdout.splitlines() if line.startswith(str(folder))], None


def compile_source(source):
    """An object file, or why there is none."""
    compiler = ["c++", "-std=c++17"] if source.suffix == ".cpp" else ["cc", "-std=c99"]
    # SymForce's headers include Eigen, of which functions of scalars use no more than what it includes itself.
    stub = BUILD / "stub" / "Eigen"
    stub.mkdir(parents=True, exist_ok=True)
    (stub / "Core").write_text("#include <cmath>\n")
    includes = [f"-I{path}" for path in [source.parent, BUILD, stub.parent, *(BUILD / "venv" / "include").glob("site/*")]]
    target = source.with_suffix(source.suffix + ".o")
    return target, run(*compiler, "-O3", "-march=native", *includes, "-c", source, "-o", target)


def peers(missing):
    """Object files of the peers, their entries for the driver, and why some have none."""
    objects, entries, reasons = [], [], {}
    for peer in PACKAGES:
        for index, form in enumerate(GOALS):
            why = missing[peer] and f"not installed: {missing[peer]}"
            sources = []
            if not why:
                sources, why = generate(peer, form)
            for source in sources or []:
                target, failed = compile_source(source)
                objects.append(target)
                why = why or failed
            if why:
                reasons[peer, form] = why
                objects = [target for target in objects if target.parent != BUILD / peer.lower() or form not in target.name]
            else:
                entries.append((peer, index, f"{peer.lower()}_{form}"))
    return objects, entries, reasons


def ours():
    """Our code, as the command writes it."""
    objects = []
    for language, ending in [("c", "c"), ("rust", "rs")]:
        why = run(
            "cargo", "run", "-q", "-p", "trueaxis-cli", "--", "generate", "examples/mobile-lidar/mobile-lidar.chain", "--language", language,
            "--observable", "pointing", "--observable", "position", "--out", BUILD / f"lidar.{ending}", cwd=ROOT,
        )  # fmt: skip
        if why:
            sys.exit(f"trueaxis generate: {why}")
    for command in [
        ["cc", "-std=c99", "-O3", "-c", BUILD / "lidar.c", "-o", BUILD / "lidar.o"],
        ["rustc", "--edition", "2024", "--crate-type", "staticlib", "-C", "opt-level=3", HERE / "ours.rs", "-o", BUILD / "libours.a"],
    ]:
        why = run(*command, env={**os.environ, "LIDAR": str(BUILD)})
        if why:
            sys.exit(f"{command[0]}: {why}")
        objects.append(command[-1])
    return objects


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=15)
    rounds = parser.parse_args().rounds
    BUILD.mkdir(parents=True, exist_ok=True)
    sys.path.insert(0, str(HERE))
    import lidar

    objects, entries, reasons = peers(install())
    declared = "".join(f'extern "C" void {function}(const double *, const double *, double *);\n' for _, _, function in entries)
    listed = "".join(f'    {{"{peer}", {form}, {function}}},\n' for peer, form, function in entries)
    places = "".join(f"{{{row}, {column}}}, " for row, column in lidar.derivatives())
    (BUILD / "peers.inc").write_text(
        f"{declared}static const struct {{\n    const char *name;\n    int form;\n    Peer peer;\n}} PEERS[] = {{\n{listed}}};\n"
        f"static const int DERIVATIVES[][2] = {{{places}}};\n"
    )
    driver = BUILD / "driver"
    why = run("c++", "-std=c++17", "-O3", "-march=native", f"-I{BUILD}", HERE / "driver.cpp", *objects, *ours(), "-o", driver, "-lpthread", "-ldl", "-lm")
    if why:
        sys.exit(f"driver: {why}")
    printed = subprocess.run([driver, str(rounds)], capture_output=True, text=True, check=True).stdout

    rows = {(who, form): (float(off), float(ns)) for who, form, off, ns in csv.reader(printed.splitlines())}
    model = next((line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")), platform.processor())
    print(f"{model}; ns a row, one thread, processor time, least of {rounds} rounds; load {os.getloadavg()[0]:.1f}")
    for form, goal in GOALS.items():
        print(f"\n{form.replace('_', ' ')}")
        timed = {who: ns for (who, of), (_, ns) in rows.items() if of == form}
        fastest = min((ns for who, ns in timed.items() if who in PACKAGES), default=float("nan"))
        for peer in PACKAGES:
            if (peer, form) in reasons:
                print(f"  {peer:14} {reasons[peer, form]}")
            elif timed[peer] == float("inf"):
                print(f"  {peer:14} wrong: off by {rows[peer, form][0]:.2g}")
            else:
                print(f"  {peer:14} {timed[peer]:8.2f}   differs from ours by at most {rows[peer, form][0]:.1g}")
        for who in ["trueaxis C", "trueaxis Rust"]:
            print(f"  {who:14} {timed[who]:8.2f}   fastest peer / ours {fastest / timed[who]:5.1f} (goal {goal})")


if __name__ == "__main__":
    main()
