//! Kinds of statements beside closed forms, each true, and each with a slip.

use super::support::{verdict, verdicts};

/// Of true claims, and of claims that a slip spoils: the second text stands in place of the first.
fn holds_until(chain: &str, file: &str, from: &str, to: &str) {
    assert_eq!(verdict(chain, file), "holds", "{file}");
    let changed = file.replacen(from, to, 1);
    assert_ne!(changed, file, "{from}");
    assert_eq!(verdict(chain, &changed), "differs", "{changed}");
}

const ARM: &str = "chain Planar { const l1 = 0.5; const l2 = 0.25;
 body upper on ground { motion: Rz(q1); motion_error: Rz(e1); position: Tx(l1); }
 body fore on upper { motion: Rz(q2); motion_error: Rz(e2); position: Tx(l2); }
 observe tip: point(0, 0, 0) of fore; observe turned: orientation of fore; }";

#[test]
fn where_a_point_is() {
    holds_until(
        ARM,
        "chain = \"a\"\n[[claim]]\nname = \"a\"\nobservable = \"tip\"\nshows = '''\\begin{aligned} x &= l_1 c_1 + l_2 c_{12}\\\\ y &= l_1 s_1 + l_2 s_{12}\\\\ z &= 0\\end{aligned}'''\n",
        "s_{12}",
        "s_2",
    );
    holds_until(
        ARM,
        "chain = \"a\"\n[[claim]]\nname = \"a\"\nobservable = \"tip\"\norder = 1\nshows = ['l1*cos(q1) + l2*cos(q1 + q2) - e1*(l1*sin(q1) + l2*sin(q1 + q2)) - e2*l2*sin(q1 + q2)', 'l1*sin(q1) + l2*sin(q1 + q2) + e1*(l1*cos(q1) + l2*cos(q1 + q2)) + e2*l2*cos(q1 + q2)', '0']\n",
        "- e2",
        "+ e2",
    );
    holds_until(
        ARM,
        "chain = \"a\"\n[[claim]]\nname = \"a\"\nobservable = \"tip\"\norder = \"exact\"\nshows = ['l1*cos(q1 + e1) + l2*cos(q1 + q2 + e1 + e2)', 'l1*sin(q1 + e1) + l2*sin(q1 + q2 + e1 + e2)', '0']\n",
        "e1 + e2",
        "e1",
    );
}

#[test]
fn how_a_frame_stands() {
    holds_until(
        ARM,
        r#"chain = "a"
[[claim]]
name = "a"
body = "fore"
frame = '''\begin{bmatrix} c_{12} & -s_{12} & 0 & l_1 c_1 + l_2 c_{12}\\ s_{12} & c_{12} & 0 & l_1 s_1 + l_2 s_{12}\\ 0&0&1&0\\ 0&0&0&1\end{bmatrix}'''
"#,
        "-s_{12}",
        "s_{12}",
    );
    holds_until(
        ARM,
        r#"chain = "a"
[[claim]]
name = "a"
body = "fore"
in = "upper"
order = 1
frame = '''R_z(q_2)\left(\mathbf{I} + \begin{bmatrix} 0 & -e_2 & 0\\ e_2 & 0 & 0\\ 0&0&0\end{bmatrix}\right)'''
"#,
        "-e_2",
        "e_2",
    );
    holds_until(
        ARM,
        r#"chain = "a"
[symbols]
'\xi_1' = { omega = "[0, 0, 1]", v = "[0, 0, 0]" }
'\xi_2' = { omega = "[0, 0, 1]", v = "[0, -l1, 0]" }
'M' = '\begin{bmatrix} 1&0&0&l_1+l_2\\0&1&0&0\\0&0&1&0\\0&0&0&1\end{bmatrix}'
[[claim]]
name = "a"
body = "fore"
frame = '''e^{\hat{\xi}_1 q_1} e^{\hat{\xi}_2 q_2} M'''
"#,
        "\"[0, -l1, 0]\"",
        "\"[0, l1, 0]\"",
    );
    holds_until(
        ARM,
        r#"chain = "a"
[[claim]]
name = "a"
body = "fore"
frame = '''\mathrm{Rot}_z(q_1)\,\mathrm{Trans}_x(l_1)\,\mathrm{Rot}_z(q_2)\,\mathrm{Trans}_x(l_2)'''
"#,
        "Trans}_x(l_2)",
        "Trans}_y(l_2)",
    );
}

#[test]
fn a_jacobian_whole_and_in_blocks() {
    holds_until(
        ARM,
        r#"chain = "a"
[[claim]]
name = "a"
observable = ["tip", "turned"]
by = ["q1", "q2"]
jacobian = '''\begin{bmatrix} -l_1 s_1 - l_2 s_{12} & -l_2 s_{12}\\ l_1 c_1 + l_2 c_{12} & l_2 c_{12}\\ 0&0\\0&0\\0&0\\1&1\end{bmatrix}'''
"#,
        "l_2 c_{12}\\\\ 0",
        "l_2 c_{1}\\\\ 0",
    );
    holds_until(
        ARM,
        "chain = \"a\"\n[[claim]]\nname = \"a\"\nobservable = \"tip\"\nby = [\"e2\"]\njacobian = '[-l2*sin(q1 + q2); l2*cos(q1 + q2); 0]'\n",
        "l2*cos",
        "l1*cos",
    );
}

#[test]
fn a_table_of_denavit_and_hartenberg() {
    let file = r#"
[dh]
convention = "standard"
rows = [
    { theta = "q1", d = "d1", alpha = "pi/2" },
    { theta = "q2", a = "a2" },
]
[[claim]]
name = "a"
observable = "tool"
shows = ['a2*cos(q1)*cos(q2)', 'a2*sin(q1)*cos(q2)', 'd1 + a2*sin(q2)']
"#;
    holds_until("", file, "d1 + a2", "d1 - a2");
    let modified = file.replace("\"standard\"", "\"modified\"").replace("rows = [\n    { theta = \"q1\", d = \"d1\", alpha = \"pi/2\" },\n    { theta = \"q2\", a = \"a2\" },", "rows = [\n    { theta = \"q1\", d = \"d1\" },\n    { theta = \"q2\", alpha = \"pi/2\" }, { a = \"a2\" },");
    holds_until("", &modified, "d1 + a2", "d1 - a2");
}

const CAMERA: &str = "chain Cam { input X: length; input Y: length; input Z: length; const f: length; const cx: length; const cy: length; const k1; 
 body cam on ground { motion: Rz(turn); motion_error: Tx(tx), Ry(ry); }
 observe seen: point(X, Y, Z) of cam; }";

#[test]
fn where_a_camera_shows_a_point() {
    let chain = CAMERA.replace("motion: Rz(turn); ", "motion: Tx(slide); ");
    holds_until(
        &chain,
        "chain = \"c\"\n[[claim]]\nname = \"a\"\ncamera = { focal = \"f\", center = [\"cx\", \"cy\"] }\nimage = ['u = f \\frac{X + s}{Z} + c_x', 'v = \\frac{f\\,Y}{Z} + c_y']\n[symbols]\n's' = \"slide\"\n'c_x' = \"cx\"\n'c_y' = \"cy\"\n",
        "+ c_y",
        "- c_y",
    );
    holds_until(
        &chain,
        "chain = \"c\"\n[[claim]]\nname = \"a\"\ncamera = { focal = \"f\", radial = [\"k1\"] }\nimage = ['f*(X + slide)/Z*(1 + k1*((X + slide)^2 + Y^2)/Z^2)', 'f*Y/Z*(1 + k1*((X + slide)^2 + Y^2)/Z^2)']\n",
        "k1*((X",
        "2*k1*((X",
    );
    holds_until(
        &chain,
        "chain = \"c\"\n[[claim]]\nname = \"a\"\norder = 1\ncamera = { focal = \"f\", change = true }\nimage = ['f*(tx + Z*ry)/Z + f*(X + slide)*X*ry/Z^2 - 0', 'f*Y*X*ry/Z^2']\n",
        "f*Y*X",
        "-f*Y*X",
    );
}

#[test]
fn a_correction_is_the_error_with_its_sign_turned() {
    holds_until(
        ARM,
        "chain = \"a\"\n[[claim]]\nname = \"a\"\nobservable = \"tip\"\nkeep = [\"e2\"]\ncorrection = ['e2*l2*sin(q1 + q2)', '-e2*l2*cos(q1 + q2)', '0']\n",
        "'e2",
        "'-e2",
    );
}

#[test]
fn numbers_at_a_pose() {
    holds_until(
        ARM,
        "chain = \"a\"\n[[claim]]\nname = \"a\"\nobservable = \"tip\"\nvalue = { at = { q1 = \"90 deg\", q2 = \"0 deg\" }, errors = { e1 = \"10 arcsec\" }, equals = [\"-36.4 um\", \"0.0 um\", \"0.0 um\"] }\n",
        "-36.4",
        "-36.5",
    );
    holds_until(
        ARM,
        "chain = \"a\"\n[[claim]]\nname = \"a\"\nobservable = \"tip\"\nvalue = { of = \"shown\", at = { q1 = \"pi/2\" }, equals = [\"0.000\", \"0.750\", \"0\"] }\n",
        "0.750",
        "0.751",
    );
}

#[test]
fn formulas_are_compared_without_a_chain() {
    holds_until(
        "",
        "[[claim]]\nname = \"a\"\nequal = ['\\sin(\\alpha + \\beta)\\,\\Delta\\theta_1', '\\Delta\\theta_1(\\sin\\alpha\\cos\\beta + \\cos\\alpha\\sin\\beta)']\n",
        "+ \\cos",
        "- \\cos",
    );
    holds_until("", "[[claim]]\nname = \"a\"\nequal = ['x*tan(b)', 'x*sin(b)/cos(b)']\n", "tan", "cot");
}

/// One number of what is shown, and one row of a Jacobian.
#[test]
fn one_component_of_what_is_shown_and_of_a_jacobian() {
    let claim = |keys: &str| format!("chain = \"a\"\n[[claim]]\nname = \"a\"\n{keys}\n");
    holds_until(
        ARM,
        &claim("observable = \"tip\"\ncomponent = \"y\"\nshows = 'p_y = l_1 s_1 + 0 c_1 + l_2 s_{12}'"),
        "s_{12}",
        "s_{2}",
    );
    holds_until(
        ARM,
        &claim(
            "observable = \"tip\"\ncomponent = \"x\"\nby = [\"q2\"]\njacobian = '\\partial x/\\partial q_2 = -l_2 \\sin(q_1 + q_2)'",
        ),
        "-l_2",
        "l_2",
    );
    holds_until(
        ARM,
        &claim(
            "observable = \"turned\"\ncomponent = \"rotation_z\"\nby = [\"q1\", \"q2\"]\njacobian = '\\begin{bmatrix} 1 & 1 \\end{bmatrix}'",
        ),
        "1 & 1",
        "1 & 0",
    );
    for wrong in [
        "observable = \"tip\"\ncomponent = \"y\"\nshows = 'p_x = l_1 \\cos q_1'",
        "observable = [\"tip\", \"turned\"]\ncomponent = \"x\"\nby = [\"q1\"]\njacobian = '0'",
        "observable = \"tip\"\ncomponent = \"w\"\nshows = '0'",
    ] {
        let said = verdict(ARM, &claim(wrong));
        assert!(said != "holds" && said != "differs", "{wrong}: {said}");
    }
}

/// Two matrices that are said to be equal are compared entry by entry.
#[test]
fn matrices_that_are_equal() {
    let file = |rotations: &str, right: &str| {
        format!(
            "chain = \"a\"\n{rotations}\n[[claim]]\nname = \"a\"\nequal = '''R_z(q_1) R_y(q_2) = \\begin{{bmatrix}} c_1 c_2 & {right}s_1 & c_1 s_2 \\\\ s_1 c_2 & c_1 & s_1 s_2 \\\\ -s_2 & 0 & c_2 \\end{{bmatrix}}'''\n"
        )
    };
    let said = |rotations: &str, right: &str| -> Vec<String> {
        verdicts(ARM, &file(rotations, right)).into_iter().map(|(_, said)| said).collect()
    };
    let vectors = "rotations = \"vectors\"";
    assert_eq!(said(vectors, "-"), vec!["holds"; 9]);
    let wrong = said(vectors, "");
    assert_eq!([&wrong[0], &wrong[1], &wrong[8]], ["holds", "differs", "holds"]);
    assert!(said("rotations = \"axes\"", "-").contains(&"differs".to_owned()));
    // To which order a product of small turns is meant, nobody says.
    let small = "chain = \"a\"\n[symbols]\n'\\mathbf{a}' = \"[0, 0, e1]\"\n'\\mathbf{b}' = \"[0, 0, e2]\"\n[[claim]]\nname = \"a\"\nequal = ['(I_3 + [\\mathbf{a}]_\\times)(I_3 + [\\mathbf{b}]_\\times)', 'I_3 + [\\mathbf{a}]_\\times + [\\mathbf{b}]_\\times']\n";
    let said = verdict(ARM, small);
    assert!(said.contains("equal to some order only"), "{said}");
}
