//! Formulas as a referee meets them, of one arm: each true, and each with the slips that people make. Written before they were run.

use super::support::{help, verdict, verdicts};

const ARM: &str = "chain Arm { const l1 = 0.4; const l2 = 0.3; const d = 0.1;
 body base on ground { position_error: Rx(rx), Ry(ry); motion: Rz(q1); motion_error: Rz(e1); position: Tz(d); }
 body upper on base { motion: Ry(q2); motion_error: Ry(e2); position: Tx(l1); position_error: Tx(a1); }
 body fore on upper { motion: Ry(q3); motion_error: Ry(e3); position: Tx(l2); }
 observe tip: point(0, 0, 0) of fore; observe att: orientation of fore; observe dir: direction(1, 0, 0) of fore; }";

const SYMBOLS: &str = r#"
'\theta_1' = "q1"
'\theta_2' = "q2"
'\theta_3' = "q3"
'\epsilon_1' = "e1"
'\epsilon_2' = "e2"
'\epsilon_3' = "e3"
'\rho_x' = "rx"
'\rho_y' = "ry"
'\boldsymbol\rho' = "[rx, ry, 0]"
'\mathbf{p}' = "[cos(q1)*(l1*cos(q2) + l2*cos(q2+q3)), sin(q1)*(l1*cos(q2) + l2*cos(q2+q3)), d - l1*sin(q2) - l2*sin(q2+q3)]"
'\mathbf{z}_1' = '\begin{bmatrix} -\sin\theta_1 \\ \cos\theta_1 \\ 0 \end{bmatrix}'
'{}^0\mathbf{T}_1' = '\begin{bmatrix} R_z(\theta_1) & d\,\mathbf{e}_z \\ \mathbf{0}^T & 1 \end{bmatrix}'
'{}^1\mathbf{T}_2' = '\begin{bmatrix} R_y(\theta_2) & l_1 R_y(\theta_2)\,\mathbf{e}_x \\ \mathbf{0}^T & 1 \end{bmatrix}'
'{}^2\mathbf{T}_3' = '\begin{bmatrix} R_y(\theta_3) & l_2 R_y(\theta_3)\,\mathbf{e}_x \\ \mathbf{0}^T & 1 \end{bmatrix}'
'M' = '\begin{bmatrix} I & \mathbf{p}_0 \\ 0 & 1 \end{bmatrix}'
'\mathbf{p}_0' = "[l1 + l2, 0, d]"
'\xi_1' = { omega = "[0, 0, 1]", v = "[0, 0, 0]" }
'\xi_2' = { omega = "[0, 1, 0]", v = "[-d, 0, 0]" }
'\xi_3' = { omega = "[0, 1, 0]", v = "[-d, 0, l1]" }
"#;

fn of_arm(keys: &str) -> String {
    let file = format!(
        "chain = \"a\"\nrotations = \"vectors\"\n[symbols]\n{SYMBOLS}\n[[claim]]\nname = \"a\"\n{keys}\n"
    );
    verdict(ARM, &file)
}

/// A true statement, and slips: what stands in place of what.
type Case<'a> = (&'a str, &'a [(&'a str, &'a str)]);

const STATEMENTS: &[Case<'_>] = &[
    (
        r"observable = 'tip'
shows = '\begin{bmatrix} c_1(l_1 c_2 + l_2 c_{23}) \\ s_1 (l_1 c_2 + l_2 c_{2+3}) \\ d - l_1 s_2 - l_2 s_{2,3} \end{bmatrix}'",
        &[("- l_2 s", "+ l_2 s"), ("s_1 (", "c_1 ("), ("c_{2+3}", "c_{2-3}")],
    ),
    (
        r"observable = 'tip'
shows = '\begin{align} p_x &= \cos\theta_1\left[l_1\cos\theta_2 + l_2\cos(\theta_2+\theta_3)\right],\nonumber\\ p_y &= \sin\theta_1\left[l_1\cos\theta_2 + l_2\cos(\theta_2+\theta_3)\right],\\ p_z &= d - l_1\sin\theta_2 - l_2\sin(\theta_2+\theta_3).\end{align}'",
        &[(r"p_y &= \sin", r"p_y &= \cos"), ("d - l_1", "d + l_1"), (r"l_2\sin", r"2 l_2\sin")],
    ),
    (
        r"body = 'fore'
frame = '\begin{bmatrix} c_1&-s_1&0&0\\s_1&c_1&0&0\\0&0&1&d\\0&0&0&1\end{bmatrix}\begin{bmatrix}c_2&0&s_2&l_1c_2\\0&1&0&0\\-s_2&0&c_2&-l_1s_2\\0&0&0&1\end{bmatrix}\begin{bmatrix}c_3&0&s_3&l_2c_3\\0&1&0&0\\-s_3&0&c_3&-l_2s_3\\0&0&0&1\end{bmatrix}'",
        &[("-l_1s_2", "l_1s_2"), ("s_1&c_1&0&0", "s_1&c_1&0&d"), ("l_2c_3", "l_1c_3")],
    ),
    (
        r"body = 'fore'
frame = '\mathrm{Rot}(z,\theta_1)\,\mathrm{Trans}(z,d)\,\mathrm{Rot}(y,\theta_2)\,\mathrm{Trans}(x,l_1)\,\mathrm{Rot}(y,\theta_3)\,\mathrm{Trans}(x,l_2)'",
        &[
            (r"\mathrm{Rot}(y,\theta_2)\,\mathrm{Trans}(x,l_1)", r"\mathrm{Trans}(x,l_1)\,\mathrm{Rot}(y,\theta_2)"),
            (r"\theta_3)", r"-\theta_3)"),
        ],
    ),
    (
        r"body = 'fore'
frame = '{}^0\mathbf{T}_3 = {}^0\mathbf{T}_1\,{}^1\mathbf{T}_2\,{}^2\mathbf{T}_3'",
        &[(r"{}^1\mathbf{T}_2\,{}^2\mathbf{T}_3", r"{}^2\mathbf{T}_3\,{}^1\mathbf{T}_2")],
    ),
    (
        r"body = 'fore'
frame = 'T(\theta) = e^{\hat\xi_1\theta_1}e^{\hat\xi_2\theta_2}e^{\hat\xi_3\theta_3}M'",
        &[
            (r"e^{\hat\xi_2\theta_2}e^{\hat\xi_3\theta_3}", r"e^{\hat\xi_3\theta_3}e^{\hat\xi_2\theta_2}"),
            (r"\hat\xi_2\theta_2", r"\hat\xi_3\theta_2"),
        ],
    ),
    (
        r"observable = 'tip'
by = ['q1', 'q2', 'q3']
jacobian = 'J_v = \begin{bmatrix} -s_1(l_1c_2+l_2c_{23}) & -c_1(l_1s_2+l_2s_{23}) & -l_2c_1s_{23}\\ c_1(l_1c_2+l_2c_{23}) & -s_1(l_1s_2+l_2s_{23}) & -l_2s_1s_{23}\\ 0 & -(l_1c_2+l_2c_{23}) & -l_2c_{23}\end{bmatrix}'",
        &[("-l_2c_1s", "l_2c_1s"), (r"-l_2c_{23}\end", r"-l_1c_{23}\end"), ("-s_1(l_1s_2", "-s_1(l_1c_2")],
    ),
    (
        r"observable = 'att'
by = ['q1', 'q2', 'q3']
jacobian = 'J_\omega = \begin{bmatrix} 0 & -\sin\theta_1 & -\sin\theta_1\\ 0&\cos\theta_1&\cos\theta_1\\ 1&0&0\end{bmatrix}'",
        &[(r"0 & -\sin", r"0 & \sin"), ("1&0&0", "1&0&1")],
    ),
    (
        r"observable = ['tip', 'att']
by = ['q2']
jacobian = '\begin{bmatrix} \mathbf{z}_1\times(\mathbf{p}-d\,\mathbf{e}_z)\\ \mathbf{z}_1\end{bmatrix}'",
        &[(r"\mathbf{p}-d\,\mathbf{e}_z", r"d\,\mathbf{e}_z-\mathbf{p}"), ("-d", "+d")],
    ),
    (
        r"observable = 'tip'
keep = ['e1', 'e2', 'e3']
components = '\delta\mathbf{p} = \begin{bmatrix} -s_1(l_1c_2+l_2c_{23}) & -c_1(l_1s_2+l_2s_{23}) & -l_2c_1s_{23}\\ c_1(l_1c_2+l_2c_{23}) & -s_1(l_1s_2+l_2s_{23}) & -l_2s_1s_{23}\\ 0 & -(l_1c_2+l_2c_{23}) & -l_2c_{23}\end{bmatrix}\begin{bmatrix}\epsilon_1\\ \epsilon_2\\ \epsilon_3\end{bmatrix}'",
        &[(r"\epsilon_2\\ \epsilon_3", r"\epsilon_3\\ \epsilon_2")],
    ),
    (
        r"body = 'base'
order = 1
frame = '(I + S(\boldsymbol\rho))\,R_z(\theta_1)\,(I + \epsilon_1 S(\mathbf{e}_z)) + O(\epsilon^2)'",
        &[
            (r"(I + S(\boldsymbol\rho))\,R_z(\theta_1)", r"R_z(\theta_1)\,(I + S(\boldsymbol\rho))"),
            (r"I + \epsilon_1", r"I - \epsilon_1"),
            (r"\epsilon_1 S", r"2\epsilon_1 S"),
        ],
    ),
    (
        r"observable = 'tip'
keep = ['rx', 'ry']
components = '\delta\mathbf{p} = -[\mathbf{p}]_\times\boldsymbol\rho'",
        &[("-[", "[")],
    ),
    (
        r"observable = 'dir'
keep = ['e1', 'e2']
correction = '\begin{bmatrix} \epsilon_1\sin\theta_1\cos(\theta_2+\theta_3) + \epsilon_2\cos\theta_1\sin(\theta_2+\theta_3)\\ -\epsilon_1\cos\theta_1\cos(\theta_2+\theta_3)+\epsilon_2\sin\theta_1\sin(\theta_2+\theta_3)\\ \epsilon_2\cos(\theta_2+\theta_3)\end{bmatrix}'",
        &[(r"-\epsilon_1\cos", r"\epsilon_1\cos"), (r"\epsilon_2\cos(\theta_2", r"-\epsilon_2\cos(\theta_2")],
    ),
    (
        r"observable = 'tip'
component = 'x'
keep = ['e3']
components = '-l_2 \epsilon_3 {\sin(\theta_1+\theta_2+\theta_3) - \sin(\theta_1-\theta_2-\theta_3) \over 2}'",
        &[(r"- \sin", r"+ \sin"), (r"\over 2", r"\over 4"), ("-l_2", "-l_1")],
    ),
    (
        r"equal = ['\det\begin{bmatrix} -l_1 s_1 - l_2 s_{12} & -l_2 s_{12}\\ l_1 c_1 + l_2 c_{12} & l_2 c_{12}\end{bmatrix}', 'l_1 l_2 \sin\theta_2']",
        &[(r"l_2 \sin", r"l_2 \cos"), (r"'l_1 l_2", r"'-l_1 l_2")],
    ),
    (
        "observable = 'tip'
shows = \"\"\"
p[2] = d - l1*sin(q2) - l2*sin(q2 + q3);
p[0] = cos(q1)*(l1*cos(q2) + l2*cos(q2 + q3));
p[1] = sin(q1)*(l1*cos(q2) + l2*cos(q2 + q3));\"\"\"",
        &[("- l1", "+ l1"), ("p[1] = sin", "p[1] = cos")],
    ),
    (
        "observable = 'tip'
shows = \"\"\"
p(1) = cos(q1)*(l1*cos(q2) + l2*cos(q2 + q3));
p(2) = sin(q1)*(l1*cos(q2) + l2*cos(q2 + q3));
p(3) = d - l1*sin(q2) - l2*sin(q2 + q3);\"\"\"",
        &[("- l1", "+ l1"), ("p(2) = sin", "p(2) = cos")],
    ),
    (
        "observable = 'tip'
shows = \"\"\"
Rz = [cos(q1) -sin(q1) 0; sin(q1) cos(q1) 0; 0 0 1];
Ry = [cos(q2) 0 sin(q2); 0 1 0; -sin(q2) 0 cos(q2)];
Ry3 = [cos(q3) 0 sin(q3); 0 1 0; -sin(q3) 0 cos(q3)];
p = Rz*([0 0 d].' + Ry*([l1; 0; 0] + Ry3*[l2; 0; 0]));\"\"\"",
        &[("Ry*([l1", "Ry'*([l1"), ("[0 0 d]", "[0 d 0]")],
    ),
    (
        "observable = 'tip'
keep = ['rx', 'ry']
components = \"\"\"
p = np.array([np.cos(q1)*(l1*np.cos(q2)+l2*np.cos(q2+q3)), np.sin(q1)*(l1*np.cos(q2)+l2*np.cos(q2+q3)), d - l1*np.sin(q2) - l2*np.sin(q2+q3)])
dp = np.cross(np.array([rx, ry, 0]), p)\"\"\"",
        &[("np.array([rx, ry, 0]), p", "p, np.array([rx, ry, 0])"), ("[rx, ry", "[ry, rx")],
    ),
    (
        "observable = 'tip'
neglected = { errors = { a1 = \"1 um\" }, at_most = \"1.01 um\" }",
        &[("1.01", "0.99")],
    ),
];

#[test]
fn a_true_statement_holds_and_a_slip_differs() {
    for (keys, slips) in STATEMENTS {
        assert_eq!(of_arm(keys), "holds", "{keys}");
        for (from, to) in *slips {
            let changed = keys.replacen(from, to, 1);
            assert_ne!(&changed, keys, "{from}");
            assert_eq!(of_arm(&changed), "differs", "{changed}");
        }
    }
}

/// What nobody defines is read as it usually is where the formula holds so; another one is asked for, with the line to write.
#[test]
fn a_usual_meaning_needs_a_formula_that_holds() {
    let row = |formula: &str| {
        of_arm(&format!("observable = 'tip'\ncomponent = 'z'\nby = ['q2']\njacobian = '{formula}'"))
    };
    for (right, wrong, symbol) in [
        (r"-l_1 \cos\theta_2 - l_2 c_{23}", r"-l_1 \cos\theta_2 + l_2 c_{23}", "c_{23}"),
        (
            r"-l_1 \cos\theta_2 - l_2 \cos\theta_{23}",
            r"-l_2 \cos\theta_2 - l_2 \cos\theta_{23}",
            r"\theta_{23}",
        ),
    ] {
        assert_eq!(row(right), "holds", "{right}");
        assert_eq!(row(wrong), format!("unknown symbol `{symbol}`"), "{wrong}");
    }
    // What another claim of the file abbreviates is known.
    let file = format!(
        "chain = \"a\"\n[symbols]\n{SYMBOLS}\n[[claim]]\nname = \"a\"\nequal = 'c_1^2 + s_1^2 = 1'\n[[claim]]\nname = \"b\"\nobservable = 'dir'\ncomponent = 'z'\nshows = 's_{{23}}'\n"
    );
    let said: Vec<String> = verdicts(ARM, &file).into_iter().map(|(_, said)| said).collect();
    assert_eq!(said, ["holds", "differs"]);
}

/// The help of a refusal, and what the line does that it asks for.
#[test]
fn a_refusal_gives_the_line_that_mends_it() {
    let check = |symbols: &str, keys: &str| {
        let file = format!("chain = \"a\"\n[symbols]\n{SYMBOLS}{symbols}\n[[claim]]\nname = \"a\"\n{keys}\n");
        verdict(ARM, &file)
    };
    let wrong = "observable = 'dir'\ncomponent = 'z'\nshows = 's_{23}'";
    let file = format!("chain = \"a\"\n[symbols]\n{SYMBOLS}\n[[claim]]\nname = \"a\"\n{wrong}\n");
    assert_eq!(help(ARM, &file), "name it under [symbols]: 's_{23}' = \"sin(q2 + q3)\"");
    assert_eq!(check("'s_{23}' = \"sin(q2 + q3)\"", wrong), "differs");
    let small = ARM.replace("e2", "ey").replace("e3", "ez");
    let of_small = |symbols: &str| {
        verdict(
            &small,
            &format!(
                "chain = \"a\"\n[symbols]\n'\\theta_2' = \"q2\"\n'\\theta_3' = \"q3\"\n{symbols}\n[[claim]]\nname = \"a\"\nobservable = 'dir'\ncomponent = 'z'\nkeep = ['ey']\ncomponents = '-e_y \\cos(\\theta_2 + \\theta_3)'\n"
            ),
        )
    };
    assert_eq!(of_small(""), "is `e_y` the declared `ey`, or a unit vector?");
    assert_eq!(of_small("'e_y' = \"ey\""), "holds");
    assert_eq!(
        check("", r"equal = ['\det R_z(\theta_1) R_z(\theta_2)', '1']"),
        "does the determinant end before this factor, or behind it?"
    );
    assert_eq!(check("", r"equal = ['\det(R_z(\theta_1) R_z(\theta_2))', '1']"), "holds");
    assert_eq!(
        check("", r"equal = ['\det \begin{bmatrix} 1 & 2 \end{bmatrix}', '1']"),
        "a vector of 2 has no determinant"
    );
    let parts = "observable = 'tip'\nshows = \"\"\"p[0] = cos(q1);\np[2] = sin(q1);\np[3] = 0;\"\"\"";
    assert_eq!(check("", parts), "these numbers of components do not follow one another");
}

/// A determinant is an equation to judge and no definition of a letter; what one equation abbreviates the others do, too.
#[test]
fn a_paper_with_determinants_and_lone_sines() {
    let source = r"We write $c_i=\cos\theta_i$.
$$ \det(R_z(q_1) R_y(q_2)) = 1 $$
$$ p_x = c_1(l_1 c_2 + l_2 c_{23}), \quad p_y = s_1(l_1 c_2 + l_2 c_{23}) $$
$$ \frac{\partial p_z}{\partial q_2} = -l_1 c_2 - l_2 c_{23} $$
$$ \frac{\partial p_z}{\partial q_3} = -l_1 c_{23} $$";
    let chain = model_core::Chain::symbolic_from_text(ARM).unwrap();
    let drawn = claims::paper::draft(source, claims::paper::Kind::Tex, &chain, "paper", "a");
    let said: Vec<String> = verdicts(ARM, &drawn.text).into_iter().map(|(_, said)| said).collect();
    assert_eq!(said, ["holds"; 4], "{}\n{:?}", drawn.text, drawn.unread);
    assert!(drawn.unread.len() == 1 && drawn.unread[0].1.contains("q_3"), "{:?}", drawn.unread);
}

/// Formulas without a backslash, and matrices that nobody defines, without a chain.
#[test]
fn letters_alone_are_symbols() {
    let equal = |formulas: &str| {
        let mut said: Vec<String> = verdicts("", &format!("[[claim]]\nname = \"a\"\nequal = {formulas}\n"))
            .into_iter()
            .map(|(_, said)| said)
            .collect();
        said.dedup();
        said.join(", ")
    };
    for [right, wrong] in [
        [r"['R_x(a)R_x(b)', 'R_x(a+b)']", r"['R_x(a)R_x(b)', 'R_x(a+2b)']"],
        [r"['R_z(\alpha)^T', 'R_z(-\alpha)']", r"['R_z(\alpha)^T', 'R_z(\alpha)']"],
        [
            r"['\begin{vmatrix} a & b\\ c & d\end{vmatrix}', 'a d - b c']",
            r"['\begin{vmatrix} a & b\\ c & d\end{vmatrix}', 'a d + b c']",
        ],
        [r"'\sin^2 a = {1 - \cos 2a \over 2}'", r"'\sin^2 a = {1 + \cos 2a \over 2}'"],
        [r"'1 + \boxed{a \over b} = {b + a \over b}'", r"'1 + \boxed{a \over b} = {1 + a \over b}'"],
        [
            r"['\mathbf{e}_x \times \mathbf{e}_y', '\mathbf{e}_z']",
            r"['\mathbf{e}_y \times \mathbf{e}_x', '\mathbf{e}_z']",
        ],
        [
            r"['R_z(\alpha)R_y(\beta)\mathbf{e}_z', '\begin{bmatrix} c_\alpha s_\beta \\ s_\alpha s_\beta \\ c_\beta \end{bmatrix}']",
            r"['R_z(\alpha)R_y(\beta)\mathbf{e}_z', '\begin{bmatrix} s_\alpha s_\beta \\ c_\alpha s_\beta \\ c_\beta \end{bmatrix}']",
        ],
        [
            r"['I - [\mathbf{e}_x]_\times^2', '\begin{bmatrix} 1&0&0\\0&2&0\\0&0&2\end{bmatrix}']",
            r"['I - [\mathbf{e}_x]_\times^2', '\begin{bmatrix} 1&0&0\\0&2&0\\0&0&0\end{bmatrix}']",
        ],
    ] {
        assert_eq!(equal(right), "holds", "{right}");
        let said = equal(wrong);
        assert!(said.contains("differs"), "{wrong}: {said}");
    }
    assert_eq!(of_arm("body = 'base'\nframe = 'R_z(q_1) T_z(d)'"), "holds");
    assert_eq!(of_arm("body = 'base'\nframe = 'R_z(q_1) T_x(d)'"), "differs");
    assert_eq!(of_arm("body = 'upper'\nin = 'base'\nframe = 'R_y(q_2)'"), "holds");
    assert_eq!(of_arm("body = 'upper'\nin = 'base'\nframe = 'R_y(q_1)'"), "differs");
    assert_eq!(of_arm("equal = 'c_1^2 + s_1^2 = 1'"), "holds");
    // Without a chain nobody says what the numbers count.
    let doubt = "are `c_{1}` and `s_{1}` variables, or a cosine and a sine?";
    assert_eq!(equal(r"['{c_1} a + {s_1} b', '{s_1} b + {c_1} a']"), "holds");
    assert_eq!(equal(r"['{c_1}^2 + {s_1}^2', '1']"), doubt);
    // A misspelt name is no product of letters.
    assert_eq!(of_arm("equal = ['l1*dl', '0']"), "unknown name `dl`");
}
