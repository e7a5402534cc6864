"""Each peer's own code for the three forms, left as it comes, with a wrapper of one signature around it:

    void NAME(const double *errors, const double *joints, double *out);

Every generator gets the outputs of a form in lists of its own numbers, shares common parts by the peer's own means, and
writes files; what it returns is the wrapper's source.
"""

import pathlib

import lidar

FORMS = ["first_order_error", "exact_error", "first_order_jacobian"]
SYMBOLS = lidar.JOINTS + lidar.ERRORS


def symbols_of(form):
    """What a form reads: the Jacobian at zero has no errors in it."""
    return lidar.JOINTS if form == "first_order_jacobian" else SYMBOLS


def outputs(form, values, sin, cos):
    """The form's outputs as a list; of the Jacobian those that are not zero."""
    if form == "first_order_jacobian":
        rows = lidar.first_order_jacobian(values, sin, cos)
        return [rows[i][j] for i, j in lidar.derivatives()]
    return getattr(lidar, form)(values, sin, cos)


def arguments(form):
    """The wrapper's inputs, one by one."""
    return [f"joints[{lidar.JOINTS.index(n)}]" if n in lidar.JOINTS else f"errors[{lidar.ERRORS.index(n)}]" for n in symbols_of(form)]


def wrapper(name, body):
    return f'extern "C" void {name}(const double *errors, const double *joints, double *out)\n{{\n    (void)errors;\n{body}}}\n'


def sympy(form, folder):
    """C by `codegen`, with its common subexpression elimination."""
    import sympy as sp
    from sympy.utilities.codegen import C99CodeGen

    values = {name: sp.Symbol(name, real=True) for name in symbols_of(form)}
    out = sp.Matrix(outputs(form, values, sp.sin, sp.cos))
    generator = C99CodeGen(project="peers", cse=True)
    target = sp.MatrixSymbol("out", *out.shape)
    routine = generator.routine(f"sympy_code_{form}", sp.Eq(target, out), [*values.values(), target], None)
    generator.write([routine], str(folder / f"sympy_code_{form}"), to_files=True)
    body = f"    sympy_code_{form}({', '.join(arguments(form))}, out);\n"
    return f'extern "C" {{\n#include "sympy_code_{form}.h"\n}}\n' + wrapper(f"sympy_{form}", body), [f"sympy_code_{form}.c"]


def casadi(form, folder):
    """C by `Function.generate`, after `cse`."""
    import casadi as ca

    values = {name: ca.SX.sym(name) for name in symbols_of(form)}
    joints = ca.vertcat(*(values[name] for name in lidar.JOINTS))
    inputs = [joints] if form == "first_order_jacobian" else [joints, ca.vertcat(*(values[name] for name in lidar.ERRORS))]
    out = ca.cse(ca.vertcat(*outputs(form, values, ca.sin, ca.cos)))
    name = f"casadi_code_{form}"
    generator = ca.CodeGenerator(f"{name}.c", {"with_header": True})
    generator.add(ca.Function(name, inputs, [out]))
    generator.generate(str(folder) + "/")
    given = "joints" if len(inputs) == 1 else "joints, errors"
    # The sizes of the work arrays are the generated code's own.
    body = f"""    const double *arguments[{name}_SZ_ARG] = {{{given}}};
    double *results[{name}_SZ_RES] = {{out}};
    casadi_int whole[{name}_SZ_IW + 1];
    double work[{name}_SZ_W + 1];
    {name}(arguments, results, whole, work, 0);
"""
    return f'#include "{name}.h"\n' + wrapper(f"casadi_{form}", body), [f"{name}.c"]


def symforce(form, folder):
    """C++ by `Codegen`: a header of templates."""
    import symforce as sf_package

    sf_package.set_epsilon_to_number(0.0)
    import symforce.symbolic as sf
    from symforce import codegen
    from symforce.values import Values

    values = {name: sf.Symbol(name) for name in symbols_of(form)}
    results = outputs(form, values, sf.sin, sf.cos)
    generator = codegen.Codegen(
        inputs=Values(**values),
        outputs=Values(**{f"out{i}": sf.S(value) for i, value in enumerate(results)}),
        config=codegen.CppConfig(),
        name=f"symforce_code_{form}",
    )
    generator.generate_function(output_dir=folder, skip_directory_nesting=True)
    pointers = "".join(f", out + {i}" for i in range(len(results)))
    body = f"    sym::SymforceCode{''.join(word.capitalize() for word in form.split('_'))}<double>({', '.join(arguments(form))}{pointers});\n"
    return f'#include "symforce_code_{form}.h"\n' + wrapper(f"symforce_{form}", body), []


def wrenfold(form, folder):
    """C++ by `generate_function`: a header of templates."""
    from wrenfold import FloatScalar, code_generation, sym

    def expressions(*numbers):
        results = outputs(form, dict(zip(symbols_of(form), numbers)), sym.sin, sym.cos)
        return [code_generation.OutputArg(sym.integer(r) if isinstance(r, int) else r, f"out{i}") for i, r in enumerate(results)]

    # The generator reads names and types of the inputs off the function's signature.
    names = symbols_of(form)
    typed = ", ".join(f"{name}: FloatScalar" for name in names)
    space = {"FloatScalar": FloatScalar, "expressions": expressions}
    exec(f"def wrenfold_code_{form}({typed}):\n    return expressions({', '.join(names)})\n", space)
    generator = code_generation.CppGenerator()
    text = code_generation.generate_function(space[f"wrenfold_code_{form}"], generator)
    code_generation.mkdir_and_write_file(generator.apply_preamble(text, namespace="gen"), folder / f"wrenfold_code_{form}.h")
    count = len(outputs(form, {name: sym.symbols(name) for name in names}, sym.sin, sym.cos))
    places = "".join(f", out[{i}]" for i in range(count))
    body = f"    gen::wrenfold_code_{form}<double>({', '.join(arguments(form))}{places});\n"
    return f'#include "wrenfold_code_{form}.h"\n' + wrapper(f"wrenfold_{form}", body), []


PEERS = {"SymPy": ("sympy", sympy), "CasADi": ("casadi", casadi), "SymForce": ("symforce", symforce), "wrenfold": ("wrenfold", wrenfold)}


def write(peer, form, folder):
    """Writes a peer's code and wrapper; returns the sources to compile."""
    package, generator = PEERS[peer]
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    text, sources = generator(form, folder)
    (folder / f"wrapper_{form}.cpp").write_text(text)
    return [folder / source for source in sources] + [folder / f"wrapper_{form}.cpp"]
