//! What control words mean to the lexer: nothing, a space, a typeface, a sign; and what is said of those that no
//! formula may hold.

/// Control words that only move ink, or that size the bracket behind them.
pub(super) const WITHOUT_MEANING: [&str; 32] = [
    "hline",
    "left",
    "right",
    "middle",
    "big",
    "Big",
    "bigg",
    "Bigg",
    "bigl",
    "bigr",
    "Bigl",
    "Bigr",
    "biggl",
    "biggr",
    "Biggl",
    "Biggr",
    "thinspace",
    "negthinspace",
    "enspace",
    "displaystyle",
    "textstyle",
    "scriptstyle",
    "nonumber",
    "notag",
    "limits",
    "nolimits",
    "strut",
    "mathstrut",
    "rm",
    "it",
    "bf",
    "allowbreak",
];

/// Of [`WITHOUT_MEANING`], those that size a bracket, which `.` leaves out.
pub(super) const SIZES: [&str; 3] = ["left", "right", "middle"];

/// Control words that set what follows in another typeface.
pub(super) const TYPEFACES: [&str; 14] = [
    "pmb",
    "mathrm",
    "mathit",
    "mathbf",
    "mathsf",
    "mathnormal",
    "boldsymbol",
    "bm",
    "text",
    "textrm",
    "textit",
    "textbf",
    "mbox",
    "operatorname",
];

/// Of [`TYPEFACES`], those that make a letter another one: `\mathbf{r}` may be a vector where `r` is its length.
pub(super) const BOLD: [&str; 5] = ["mathbf", "boldsymbol", "bm", "textbf", "pmb"];

/// Control words that change the typeface up to the end of the group: `{\rm sin}`.
pub(super) const SWITCHES: [&str; 6] = ["rm", "it", "bf", "sf", "normalfont", "mit"];

/// Wide spaces: they part formulas from each other and from their number, and never two factors.
pub(super) const WIDE: [&str; 6] = ["quad", "qquad", "hfill", "hfil", "eqno", "leqno"];

/// Control words that are dropped with their argument.
pub(super) const NOTES: [&str; 2] = ["label", "tag"];

/// The same, but wide spaces.
pub(super) const DISTANCES: [&str; 2] = ["hspace", "hskip"];

/// Relations that part a name from its formula.
pub(super) const RELATIONS: [&str; 9] =
    ["approx", "simeq", "cong", "equiv", "doteq", "triangleq", "eqsim", "coloneqq", "approxeq"];

/// The functions of the language of amounts, as control words.
pub(super) const FUNCTIONS: [&str; 6] = ["sin", "cos", "tan", "cot", "sec", "csc"];

/// The function that other countries call by another word: `\operatorname{tg}`.
pub(super) fn other_word(word: &str) -> Option<&'static str> {
    Some(match word {
        "tg" => "tan",
        "ctg" | "cotg" => "cot",
        "cosec" => "csc",
        _ => return None,
    })
}

/// The function of three arguments, `\operatorname{ramp}(x, from, to)`.
pub(super) const RAMP: &str = "ramp";

/// The determinant of a matrix.
pub(super) const DETERMINANT: &str = "det";

/// Inverse functions as they are printed, the two-armed one by its first letters.
const INVERSES: [&str; 11] =
    ["arcsin", "arccos", "arctan", "arccot", "arctg", "arcctg", "asin", "acos", "atan", "acot", "atg"];

/// What to write in place of an inverse function.
pub(super) const INVERSE_HELP: &str = r"claim the form to an order in the errors: to first order the arc tangent of a small quotient is the quotient, `\frac{…}{…}`; an angle itself is observed, `observe sky: azimuth of direction(…) of body;`";

/// Whether a word is an inverse function: `arctan`, `Arctan`, `atan`, `atan2`, `atantwo`.
pub(super) fn is_inverse(word: &str) -> bool {
    let word = word.to_ascii_lowercase();
    let of_one = word.strip_suffix("two").or_else(|| word.strip_suffix('2'));
    INVERSES.contains(&of_one.unwrap_or(&word))
}

/// Fractions.
pub(super) const FRACTIONS: [&str; 4] = ["frac", "tfrac", "dfrac", "cfrac"];

/// Why a control word (or what it stands for) cannot be read, and what to write; `None` if it may be a symbol.
pub(super) fn refusal(command: &str) -> Option<(&'static str, &'static str)> {
    Some(match command {
        "pm" | "mp" => {
            ("two signs at once are two formulas", "write one claim for each sign, with `+` and with `-`")
        }
        inverse if is_inverse(inverse) => {
            ("an inverse function is no sum of products of sines and cosines", INVERSE_HELP)
        }
        "sinh" | "cosh" | "tanh" | "exp" | "ln" | "log" | "lg" | "arg" | "max" | "min" => (
            "this function is not known to closed forms",
            "sines, cosines, tangents and their reciprocals are",
        ),
        "sum" | "prod" | "int" | "oint" | "lim" | "partial" | "nabla" => {
            ("sums, integrals and derivatives are not carried out", "write out what comes of it")
        }
        "cdots" | "ldots" | "dots" | "vdots" | "ddots" => {
            ("something is left out here", "write the formula in full")
        }
        "le" | "leq" | "ge" | "geq" | "ll" | "gg" | "lt" | "gt" | "lesssim" | "gtrsim" | "leqslant"
        | "geqslant" | "neq" | "ne" | "propto" | "sim" | "in" | "to" | "rightarrow" | "Rightarrow" => {
            ("this relation is no equation", "a bound is a claim of its own: `bound = { … }`")
        }
        "over" | "atop" | "choose" => ("this fraction has no braces", r"write `\frac{…}{…}`"),
        "vert" | "lvert" | "rvert" | "mid" | "Vert" | "lVert" | "rVert" | "abs" | "norm" => (
            "an absolute value is no sum of products",
            "a total error is a claim of its own: `total = '\\sqrt{…}'`",
        ),
        "eqref" | "ref" | "cite" | "footnote" => ("a reference is no part of a formula", "leave it out"),
        _ => return None,
    })
}
