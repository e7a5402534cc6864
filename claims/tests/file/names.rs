//! Names with amounts around them and lengths of vectors: what is true holds, and what is not does not.

use super::support::{verdict, verdicts};

const ARM: &str = "chain Arm { const l1: length; const l2: length; const k;
 body upper on ground { motion: Rz(q1); motion_error: Rz(e1); position: Tx(l1); position_error: Tx(a1); }
 body fore on upper { motion: Rz(q2); motion_error: Rz(e2); position: Tx(l2); position_error: Tx(a2); }
 observe tip: point(0, 0, 0) of fore;
 observe sky: azimuth, elevation of direction(1, 0, 0) of fore; }";

const SYMBOLS: &str = r#"chain = "a.chain"
[symbols]
'\mathbf{p}' = "[l1*cos(q1), l1*sin(q1), 0]"
'\hat e_\rho' = "[cos(q1), sin(q1), 0]"
'\dot t' = "k"
"#;

fn of_arm(keys: &str) -> String {
    verdict(ARM, &format!("{SYMBOLS}[[claim]]\nname = \"a\"\n{keys}\n"))
}

fn along_x(formula: &str) -> String {
    of_arm(&format!("observable = \"tip\"\ncomponent = \"x\"\nkeep = ['a1']\ncomponents = '''{formula}'''"))
}

fn is_judged(said: &str) -> bool {
    said == "holds" || said == "differs"
}

/// What stands around the name is taken away or divided by, so that a factor on the left decides.
#[test]
fn names_with_amounts_around_them() {
    for formula in [
        r"\Delta x - a_1 \cos q_1 = 0",
        r"\Delta x + a_1 = a_1 \cos q_1 + a_1",
        r"(\Delta x + a_1) = a_1 \cos q_1 + a_1",
        r"-\Delta x = -a_1 \cos q_1",
        r"l_1 \Delta x = l_1 a_1 \cos q_1",
        r"\Delta x \cos q_2 = a_1 \cos q_2 \cos q_1",
        r"\frac{\Delta x}{l_1} = \frac{a_1}{l_1} \cos q_1",
        r"\frac{\Delta x - a_1\cos q_1}{l_1} = 0",
        r"2\,\delta p_x / l_1 = 2 a_1 \cos q_1 / l_1",
        r"\mathrm{d}x - a_1 \cos q_1 = 0",
        r"e_x - a_1 \cos q_1 = 0",
    ] {
        assert_eq!(along_x(formula), "holds", "{formula}");
        let wrong = formula.replace(r"\cos q_1", r"\sin q_1");
        assert_eq!(along_x(&wrong), "differs", "{wrong}");
    }
    for formula in [
        r"l_1 \Delta x = a_1 \cos q_1",
        r"\Delta x \cos q_2 = a_1 \cos q_1",
        r"\frac{\Delta x}{l_1} = a_1 \cos q_1",
        r"-\Delta x = a_1 \cos q_1",
        r"\Delta x + a_1 = a_1 \cos q_1",
    ] {
        assert_eq!(along_x(formula), "differs", "{formula}");
    }
    for formula in [
        r"x_a - l_1 = a_1 \cos q_1",
        r"\sin\Delta x = a_1 \cos q_1",
        r"\delta(\cos q_1) = a_1 \cos q_1",
        r"\Delta x\,\Delta y\, l_1 = a_1 \cos q_1 l_1",
        r"\Delta x (1 + k) = a_1 \cos q_1",
        r"l_1 + l_2 = a_1 \cos q_1",
    ] {
        let said = along_x(formula);
        assert!(!is_judged(&said), "{formula}: {said}");
    }
}

#[test]
fn names_of_vectors_with_amounts_around_them() {
    let claim = |formula: &str| {
        of_arm(&format!("observable = \"tip\"\nkeep = ['a1', 'a2']\ncomponents = '''{formula}'''"))
    };
    let right = r"[a_1 \cos q_1 + a_2 \cos(q_1 + q_2), a_1 \sin q_1 + a_2 \sin(q_1 + q_2), 0]^T";
    for name in [
        r"\Delta\mathbf{r}",
        r"\begin{bmatrix} \Delta x \\ \Delta y \\ \Delta z \end{bmatrix}",
        r"(\Delta x, \Delta y, \Delta z)^T",
        r"\delta\mathbf{r}(q_1, q_2)",
        r"\mathbf{J}\,\delta\mathbf{a}",
    ] {
        assert_eq!(claim(&format!("{name} = {right}")), "holds", "{name}");
    }
    let sum = r"\Delta\mathbf{r} - R_z(q_1)[a_1, 0, 0]^T = R_z(q_1 + q_2)[a_2, 0, 0]^T";
    assert_eq!(claim(sum), "holds");
    assert_eq!(claim(&format!(r"2 \Delta\mathbf{{r}} = {right}")), "differs");
    // A length times a change may be a displacement of its own, as in `R\,\Delta\mathbf{n}`.
    for name in [
        r"l_1 \Delta\mathbf{r}",
        r"R_z(q_1)^T \Delta\mathbf{r}",
        r"\begin{bmatrix} \Delta x + a_1 \\ \Delta y \\ \Delta z \end{bmatrix}",
    ] {
        let said = claim(&format!("{name} = {right}"));
        assert!(said.contains("more than a name"), "{name}: {said}");
    }
}

/// A change of another size than what is shown is named by the whole product. A number or a sign could be a factor.
#[test]
fn a_side_that_changes_another_size_is_a_name_as_a_whole() {
    let chain = "chain T { body north on ground { motion: Rz(H); }
     body alidade on north { position_error: Tx(b); motion: Rz(-H); motion_error: Rz(-h0); }
     input R: length; observe target: point(0, R, 0) of alidade; }";
    let claim = |component: &str, formula: &str| {
        let file = format!(
            "chain = \"t\"\n[symbols]\n'h_0' = \"h0\"\n'K' = \"pi/2 - H\"\n[[claim]]\nname = \"a\"\ncomponent = \"{component}\"\ncomponents = '''{formula}'''\n"
        );
        verdict(chain, &file)
    };
    for name in [r"R \Delta H", r"\Delta H\,R", r"R\,\mathrm{d}H", r"R \delta K", r"\Delta x", "e_x"] {
        assert_eq!(claim("x", &format!(r"{name} = R h_0 + b \cos H")), "holds", "{name}");
        assert_eq!(claim("x", &format!(r"{name} = R h_0 - b \cos H")), "differs", "{name}");
    }
    assert_eq!(claim("y", r"\Delta R = b \sin H"), "holds");
    assert_eq!(claim("y", r"R \Delta y = b \sin H"), "differs");
    for name in [r"2 R \Delta H", r"-R \Delta H", r"R \Delta L", r"\frac{\Delta H}{b}", r"R \Delta p_{ee}"] {
        let said = claim("x", &format!(r"{name} = R h_0 + b \cos H"));
        assert!(said.contains("factors, or a part of the name?"), "{name}: {said}");
    }
    assert!(claim("x", r"R \Delta H - b \cos H = R h_0").contains("a part of the name?"));
}

#[test]
fn a_cosine_beside_a_name_is_a_factor_or_a_part_of_it() {
    let mount = |shown: &str| {
        format!(
            "chain M {{ body az on ground {{ motion: Rz(A); motion_error: Rz(IA); }}
             body el on az {{ position_error: Rx(N); motion: Ry(-E); motion_error: Ry(-IE), Rz(CA); }}
             observe sky: {shown} of direction(1, 0, 0) of el; }}"
        )
    };
    let claim = |shown: &str, component: &str, formula: &str| {
        let file = format!(
            "chain = \"m\"\n[symbols]\n'I_A' = \"IA\"\n'I_E' = \"IE\"\n'C' = \"CA\"\n[[claim]]\nname = \"a\"\ncomponent = \"{component}\"\ncomponents = '''{formula}'''\n"
        );
        verdict(&mount(shown), &file)
    };
    let (plain, sideways) = ("azimuth, elevation", "cross_elevation, elevation");

    let right = r"\Delta A \cos E = I_A \cos E - N \sin E + C";
    let wrong = r"\Delta A \cos E = I_A - N \tan E + C / \cos E";
    for (shown, component) in [(plain, "azimuth"), (sideways, "cross_elevation")] {
        assert_eq!(claim(shown, component, right), "holds");
        assert_eq!(claim(shown, component, wrong), "differs");
    }
    let azimuth = |formula: &str| claim(plain, "azimuth", formula);
    assert_eq!(azimuth(r"\Delta A = I_A - N\,\mathrm{tg}\,E + C \sec E"), "holds");
    assert_eq!(azimuth(r"A_{obs} - A = I_A - N \tan E + C / \cos E"), "holds");
    for name in [r"A - A_{obs}", r"A_{nom} - A", r"A_{obs} - E", r"A_{obs} + A"] {
        let said = azimuth(&format!(r"{name} = I_A - N \tan E + C / \cos E"));
        assert!(said.contains("more than a name"), "{name}: {said}");
    }
    let sideways_only = |formula: &str| claim(sideways, "cross_elevation", formula);
    assert!(sideways_only(&right.replacen(r"\Delta", r"2\Delta", 1)).contains("a part of the name?"));
    assert_eq!(claim(plain, "elevation", r"\Delta E \cos E = I_E"), "differs");
    assert_eq!(claim(sideways, "elevation", r"\Delta E \cos E = I_E \cos E"), "holds");
}

#[test]
fn matrices_and_totals_with_factors_on_the_left() {
    let jacobian = |formula: &str| {
        of_arm(&format!("observable = \"tip\"\nby = ['a1', 'a2']\njacobian = '''{formula}'''"))
    };
    let right =
        r"\begin{bmatrix} \cos q_1 & \cos(q_1 + q_2) \\ \sin q_1 & \sin(q_1 + q_2) \\ 0 & 0 \end{bmatrix}";
    for name in [
        "J",
        r"\mathbf{J}(\mathbf{q})",
        r"\frac{\partial \mathbf{p}}{\partial \mathbf{a}}",
        r"\partial p/\partial a",
        r"J = \partial p/\partial a",
    ] {
        assert_eq!(jacobian(&format!("{name} = {right}")), "holds", "{name}");
    }
    assert_eq!(jacobian(&format!("-J = {right}")), "differs");
    assert_eq!(jacobian(&format!("2 J = {right}")), "differs");
    let total = |formula: &str| {
        of_arm(&format!("observable = \"tip\"\nkeep = ['a1', 'a2']\ntotal = '''{formula}'''"))
    };
    let root = r"\sqrt{a_1^2 + a_2^2 + 2 a_1 a_2 \cos q_2}";
    for name in [r"\|\Delta \mathbf{r}\|", r"|\Delta r|", r"\sigma", r"\lVert\Delta r\rVert"] {
        assert_eq!(total(&format!("{name} = {root}")), "holds", "{name}");
    }
    assert!(total(&format!(r"2\sigma = {root}")).contains("more than a name"));
    let length = r"\lVert (a_1 + a_2 \cos q_2, a_2 \sin q_2, 0) \rVert";
    assert_eq!(total(length), "holds");
    assert_eq!(total(&length.replace('+', "-")), "differs");
}

#[test]
fn lengths_and_names_with_accents() {
    let equal = |a: &str, b: &str| of_arm(&format!("equal = ['''{a}''', '''{b}''']"));
    for (a, b) in [
        (r"|\mathbf p|^2", "l_1^2"),
        (r"\lVert\mathbf p\rVert^2", "l_1^2"),
        (r"\left\| \mathbf p \right\|^{2} + 1", "l_1^2 + 1"),
        (r"\norm{\mathbf p}^4", "l_1^4"),
        (r"2|\mathbf p|^2|k|^2", "2 l_1^2 k^2"),
        (r"\hat{e}_\rho^T \hat{\mathbf e}_x", r"\cos q_1"),
        (r"\hat e_\rho \cdot \hat e_\rho", "1"),
        (r"\dot t^2", r"k \dot{t}"),
        (r"[l_1\ l_2\ 0]^T \cdot [1\;1\;0]^T", "l_1 + l_2"),
        (r"\operatorname{tg} q_1 \operatorname{ctg} q_1", "1"),
    ] {
        assert_eq!(equal(a, b), "holds", "{a}");
        assert_eq!(equal(a, &format!("{b} + l_2")), "differs", "{a}");
    }
    assert_eq!(equal(r"\|\mathbf p\|", r"\sqrt{l_1^2}"), "holds");
    assert_eq!(equal(r"\|\mathbf p\|", r"\sqrt{l_1^2 + k}"), "differs");
    assert!(equal(r"|\mathbf p|", "l_1").contains("a length is a root"));
    assert!(equal(r"|\mathbf p", "l_1").contains("the bar that closes"));
    // Without a transposition a list with spaces could be a product.
    assert!(!is_judged(&equal(r"[l_1\ l_2\ 0]\,[1\ 1\ 0]^T", "l_1 + l_2")));
    for bars in ["|", r"\|", r"|\|"] {
        assert!(!is_judged(&equal(&format!("{}k{}", bars.repeat(300), bars.repeat(300)), "k")));
    }
}

/// A number of several parts is rounded where its last part is.
#[test]
fn a_number_of_which_nobody_sees_how_far_it_is_rounded_is_refused() {
    let file = format!(
        "{SYMBOLS}[[claim]]\nname = \"a\"\nobservable = \"tip\"\nvalue = {{ of = \"shown\", equals = [\"1 mm 5\", \"0 mm\", \"0 mm\"] }}\n"
    );
    let said = verdicts(ARM, &file);
    assert!(said.iter().all(|(_, said)| !is_judged(said)), "{said:?}");
}
