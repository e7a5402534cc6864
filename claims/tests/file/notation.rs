//! Notations that papers use for one true formula, and the same with a slip in it.

use super::support::{help, verdict, verdicts};

const SCANNER: &str = "chain B {
 input rho: length;
 const a_x: length; const a_y: length; const a_z: length;
 body veh on ground { motion: Rz(psi); position: Tx(a_x), Ty(a_y), Tz(a_z); position_error: Tx(dax), Ty(day), Tz(daz); }
 body scan on veh { position_error: Rx(wx), Ry(wy), Rz(wz); motion: Rx(alpha); motion_error: Rx(e1*cos(alpha) + e2*cos(2*alpha) + e3*cos(3*alpha)); }
 observe p: point(0, 0, rho) of scan;
 observe o: orientation of scan in veh;
}";

const SYMBOLS: &str = r#"
chain = "b.chain"
[symbols]
'\omega_x' = "wx"
'\omega_y' = "wy"
'\omega_z' = "wz"
'\delta a_x' = "dax"
'\delta a_y' = "day"
'\delta a_z' = "daz"
'e_1' = "e1"
'e_2' = "e2"
'e_3' = "e3"
'\mathbf{r}' = "[0, -rho*sin(alpha), rho*cos(alpha)]"
'\vec{\omega}' = "[wx, wy, wz]"
'\vec{a}' = "[dax, day, daz]"
'\mathbf{R}' = '\begin{bmatrix}\cos\psi&-\sin\psi&0\\ \sin\psi&\cos\psi&0\\0&0&1\end{bmatrix}'
'{}^{g}\mathbf{C}_{v}' = "[[cos(psi), -sin(psi), 0], [sin(psi), cos(psi), 0], [0, 0, 1]]"
"#;

fn of_scanner(observable: &str, components: &str) -> String {
    let keep = if observable == "o" { "keep = ['w*']" } else { "keep = ['w*', 'da*']" };
    let file = format!(
        "{SYMBOLS}\n[[claim]]\nname = \"a\"\nobservable = \"{observable}\"\n{keep}\ncomponents = '''{components}'''\n"
    );
    verdict(SCANNER, &file)
}

/// Notations of the same true formula.
const TRUE: &[&str] = &[
    r"R_z(\psi)(\vec{\omega}\times\mathbf{r} + \vec{a})",
    r"\mathbf R_{z}(\psi)\,(\vec{\omega}\times\mathbf{r} + \vec{a})",
    r"\mathrm{Rot}(z, \psi)(\vec{\omega}\times\mathbf{r} + \vec{a})",
    r"R_z(-\psi)^T(\vec{\omega}\times\mathbf{r} + \vec{a})",
    r"R_z^{T}(-\psi)(\vec{\omega}\times\mathbf{r} + \vec{a})",
    r"R_z(-\psi)^{-1}(\vec{\omega}\times\mathbf{r} + \vec{a})",
    r"\mathbf{R}([\vec{\omega}]_\times\mathbf{r} + \vec{a})",
    r"\mathbf{R}([\vec{\omega}\times]\mathbf{r} + \vec{a})",
    r"\mathbf{R}(S(\vec{\omega})\mathbf{r} + \vec{a})",
    r"\mathbf{R}(\mathrm{skew}(\vec{\omega})\mathbf{r} + \vec{a})",
    r"\mathbf{R}(\hat{\vec{\omega}}\mathbf{r} + \vec{a})",
    r"\mathbf{R}(\vec{\omega}^{\times}\mathbf{r} + \vec{a})",
    r"\mathbf{R}(\vec{\omega}_\times\mathbf{r} + \vec{a})",
    r"-\mathbf{R}[\mathbf{r}]_\times\vec{\omega} + \mathbf{R}\vec{a}",
    r"\mathbf{R}\,(\vec{a} - S(\mathbf{r})\vec{\omega})",
    r"{}^g\mathbf{C}_v(\vec{\omega}\times\mathbf{r} + \vec{a})",
    r"^g\mathbf{C}_v(\vec{\omega}\times\mathbf{r} + \vec{a})",
    r"\prescript{g}{}{\mathbf{C}}_v(\vec{\omega}\times\mathbf{r} + \vec{a})",
    r"\delta\mathbf{p} = \mathbf{R}\,(\vec{\omega}\times\mathbf{r} + \vec{a}) + O(\omega^2)",
    r"\mathbf{R}\left(\left(\mathbf{I} + [\vec\omega]_\times\right)\mathbf{r} - \mathbf{r} + \vec{a}\right)",
    r"\mathbf{R}\left(\left(I_3 + [\vec\omega]_\times\right)\mathbf{r} - I_{3\times3}\mathbf{r} + \vec{a}\right)",
    r"\mathbf{R}\left(e^{\hat{\vec\omega}}\mathbf{r} - \mathbf{r} + \vec{a}\right)",
    r"\mathbf{R}\left((\mathbf{I} - [\vec\omega]_\times)^{-1}\mathbf{r} - \mathbf{r} + \vec{a}\right)",
    r"\begin{bmatrix}\mathbf{I}_3&\mathbf{0}\end{bmatrix}\begin{bmatrix}\mathbf{R}&\mathbf{0}\\ \mathbf{0}^T&1\end{bmatrix}\begin{bmatrix}\vec{\omega}\times\mathbf{r} + \vec{a}\\1\end{bmatrix}",
    "c\\psi(\\omega_y\\rho\\cos\\alpha + \\omega_z\\rho\\sin\\alpha + \\delta a_x) - s\\psi(-\\omega_x\\rho\\cos\\alpha + \\delta a_y)\\\\\\sin\\psi(\\omega_y\\rho\\cos\\alpha + \\omega_z\\rho\\sin\\alpha + \\delta a_x) + \\cos\\psi(-\\omega_x\\rho\\cos\\alpha + \\delta a_y)\\\\-\\omega_x\\rho\\sin\\alpha + \\delta a_z",
    "\\mathrm c_\\psi(\\omega_y\\rho c_\\alpha + \\omega_z\\rho s_\\alpha + \\delta a_x) - \\mathrm s_\\psi(-\\omega_x\\rho c_\\alpha + \\delta a_y)\\\\ s_\\psi(\\omega_y\\rho c_\\alpha + \\omega_z\\rho s_\\alpha + \\delta a_x) + c_\\psi(-\\omega_x\\rho c_\\alpha + \\delta a_y)\\\\-\\omega_x\\rho s_\\alpha + \\delta a_z",
    "```math\n\\begin{aligned}\\delta x &= \\cos\\psi(\\omega_y\\rho\\cos\\alpha + \\omega_z\\rho\\sin\\alpha + \\delta a_x) - \\sin\\psi(-\\omega_x\\rho\\cos\\alpha + \\delta a_y)\\\\ \\delta y &= \\sin\\psi(\\omega_y\\rho\\cos\\alpha + \\omega_z\\rho\\sin\\alpha + \\delta a_x) + \\cos\\psi(-\\omega_x\\rho\\cos\\alpha + \\delta a_y)\\\\ \\delta z &= -\\omega_x\\rho\\sin\\alpha + \\delta a_z\\end{aligned}\n```",
    "$$\\delta x = \\cos\\psi(\\omega_y\\rho\\cos\\alpha + \\omega_z\\rho\\sin\\alpha + \\delta a_x) - \\sin\\psi(-\\omega_x\\rho\\cos\\alpha + \\delta a_y)$$\n$$\\delta y = \\sin\\psi(\\omega_y\\rho\\cos\\alpha + \\omega_z\\rho\\sin\\alpha + \\delta a_x) + \\cos\\psi(-\\omega_x\\rho\\cos\\alpha + \\delta a_y)$$\n$$\\delta z = -\\omega_x\\rho\\sin\\alpha + \\delta a_z$$",
    "\\begin{equation}\\begin{split}\\delta x &= \\cos\\psi(\\omega_y\\rho\\cos\\alpha + \\omega_z\\rho\\sin\\alpha + \\delta a_x)\\\\ &\\quad - \\sin\\psi(-\\omega_x\\rho\\cos\\alpha + \\delta a_y)\\\\ \\delta y &= \\sin\\psi(\\omega_y\\rho\\cos\\alpha + \\omega_z\\rho\\sin\\alpha + \\delta a_x) + \\cos\\psi(-\\omega_x\\rho\\cos\\alpha + \\delta a_y)\\\\ \\delta z &= -\\omega_x\\rho\\sin\\alpha + \\delta a_z\\end{split}\\end{equation}",
];

#[test]
fn every_notation_of_a_true_formula_holds() {
    let wrong: Vec<(&&str, String)> =
        TRUE.iter().map(|text| (text, of_scanner("p", text))).filter(|(_, said)| said != "holds").collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn a_slip_in_any_notation_is_no_truth() {
    for text in TRUE {
        for (from, to) in [
            (r"\mathbf{r}", r"2\mathbf{r}"),
            (r"+ \vec{a}", r"- \vec{a}"),
            (r"\omega_x\rho", r"\omega_z\rho"),
        ] {
            let changed = text.replacen(from, to, 1);
            if changed != **text {
                assert_ne!(of_scanner("p", &changed), "holds", "{changed}");
            }
        }
    }
}

#[test]
fn how_a_body_is_turned_is_read_as_matrix_or_quaternion() {
    for text in [
        r"\mathbf{R} \approx \mathbf{I} + \begin{bmatrix}0&-\omega_z&\omega_y\\ \omega_z&0&-\omega_x\\-\omega_y&\omega_x&0\end{bmatrix}",
        r"\mathbf{I} + [\vec\omega]_\times",
        r"(\mathbf{I} + [\vec\omega]_\times)(\mathbf{I} + [\vec\omega]_\times)(\mathbf{I} - [\vec\omega]_\times)",
        r"e^{[\vec\omega]_\times}",
    ] {
        let file = format!(
            "{SYMBOLS}\n[[claim]]\nname = \"a\"\nobservable = \"o\"\nkeep = ['w*']\ncomponents = '''{text}'''\n"
        );
        let found = verdicts(SCANNER, &file);
        assert!(found.len() == 5 && found.iter().all(|(_, said)| said == "holds"), "{text}: {found:?}");
    }
    for text in [
        r"q \approx \begin{bmatrix}1\\ \tfrac12\omega_x\\ \tfrac12\omega_y\\ \tfrac12\omega_z\end{bmatrix}",
        r"\begin{bmatrix}1\\ \tfrac12\vec\omega\end{bmatrix}",
        r"\begin{bmatrix}\frac{1}{2}\vec\omega\\ 1\end{bmatrix}",
    ] {
        assert_eq!(of_scanner("o", text), "holds", "{text}");
    }
    assert_eq!(of_scanner("o", r"\begin{bmatrix}1\\ \vec\omega\end{bmatrix}"), "differs");
}

/// A matrix of blocks that a paper defines elsewhere: the refusal gives the line of each, and with these lines it is judged.
#[test]
fn blocks_that_are_not_defined_are_asked_for() {
    let blocks = r"\begin{bmatrix}\mathbf{A}&\mathbf{t}\\ \mathbf{0}^T&1\end{bmatrix}\begin{bmatrix}\mathbf{r}\\1\end{bmatrix}";
    let file = |symbols: &str| {
        let keys = "observable = \"p\"\nkeep = ['w*', 'da*']";
        format!(
            "rotations = \"vectors\"{SYMBOLS}{symbols}\n[[claim]]\nname = \"a\"\n{keys}\ncomponents = '{blocks}'\n"
        )
    };
    let line = "name it under [symbols]: ";
    let matrix = r#"'\mathbf{A}' = "[[…, …, …], […, …, …], […, …, …]]""#;
    assert_eq!(help(SCANNER, &file("")), format!("{line}{matrix}"));
    let first = r"'\mathbf{A}' = 'R_z(\psi) [\vec\omega]_\times'";
    assert_eq!(help(SCANNER, &file(first)), format!(r#"{line}'\mathbf{{t}}' = "[…, …, …]""#));
    let [right, wrong] = [r"R_z(\psi) \vec{a}", r"\vec{a}"].map(|shift| {
        let symbols = format!("{first}\n'\\mathbf{{t}}' = '{shift}'");
        verdict(SCANNER, &file(&symbols))
    });
    assert_eq!([right, wrong], ["holds", "differs"]);
}

#[test]
fn sums_are_written_out() {
    let claim = |text: &str| {
        format!(
            "{SYMBOLS}\n[[claim]]\nname = \"a\"\nobservable = \"o\"\nkeep = ['e*']\ncomponents = ['{text}', '0', '0']\n"
        )
    };
    for text in [
        r"\sum_{k=1}^{3} e_k \cos(k\alpha)",
        r"\sum_{k=1}^3 e_{k} \cos k\alpha",
        r"\sum_{k=1}^{2} \left(e_k \cos k\alpha\right) + e_3 \cos 3\alpha",
    ] {
        assert_eq!(verdict(SCANNER, &claim(text)), "holds", "{text}");
    }
    assert_eq!(verdict(SCANNER, &claim(r"\sum_{k=1}^{3} e_k \sin(k\alpha)")), "differs");
    assert!(verdict(SCANNER, &claim(r"\sum_k e_k \cos(k\alpha)")).contains("from where to where"));
    assert!(verdict(SCANNER, &claim(r"\sum_{k=1}^{3} e_k \cos k\alpha + e_k")).contains("may belong"));
}

/// What is meant otherwise by others is not decided without being told.
#[test]
fn conventions_that_decide_are_asked_for() {
    let turned = r"R_z(-\psi)(\vec{\omega}\times\mathbf{r} + \vec{a})";
    let said = of_scanner("p", turned);
    assert!(said.contains("can turn vectors or axes"), "{said}");
    let file = |rotations: &str| {
        format!(
            "rotations = \"{rotations}\"{SYMBOLS}\n[[claim]]\nname = \"a\"\nobservable = \"p\"\nkeep = ['w*', 'da*']\ncomponents = '''{turned}'''\n"
        )
    };
    assert_eq!(verdict(SCANNER, &file("axes")), "holds");
    assert_eq!(verdict(SCANNER, &file("vectors")), "differs");
}

const MACHINE: &str = "chain M { body X on ground { motion: Tx(x); motion_error: Tx(dxx), Ty(dyx), Tz(dzx), Rx(exx), Ry(eyx), Rz(ezx); }
 body Y on X { position_error: Rz(sxy); motion: Ty(y); motion_error: Tx(dxy), Ty(dyy), Tz(dzy), Rx(exy), Ry(eyy), Rz(ezy); }
 body Z on Y { position_error: Ry(sxz), Rx(syz); motion: Tz(z); motion_error: Tx(dxz), Ty(dyz), Tz(dzz); }
 observe p: point(0, 0, 0) of Z; }";

#[test]
fn a_product_of_small_matrices_holds_to_first_order() {
    let matrices = r"\begin{bmatrix} 1 & -\epsilon_z(x) & \epsilon_y(x) & x+\delta_x(x) \\ \epsilon_z(x) & 1 & -\epsilon_x(x) & \delta_y(x)\\ -\epsilon_y(x) & \epsilon_x(x) & 1 & \delta_z(x)\\ 0&0&0&1\end{bmatrix}\begin{bmatrix} 1 & -\epsilon_z(y) & \epsilon_y(y) & \delta_x(y) \\ \epsilon_z(y) & 1 & -\epsilon_x(y) & y+\delta_y(y)\\ -\epsilon_y(y) & \epsilon_x(y) & 1 & \delta_z(y)\\ 0&0&0&1\end{bmatrix} \begin{bmatrix} 0\\0\\z\\1\end{bmatrix} - \begin{bmatrix} x\\y\\z\\1\end{bmatrix}";
    let mut symbols = String::new();
    for (printed, name) in [(r"\delta", "d"), (r"\epsilon", "e")] {
        for axis in ["x", "y", "z"] {
            for of in ["x", "y"] {
                symbols += &format!("'{printed}_{axis}({of})' = \"{name}{axis}{of}\"\n");
            }
        }
    }
    let file = |text: &str| {
        format!("chain = \"m\"\n[symbols]\n{symbols}[[claim]]\nname = \"a\"\nkeep = ['d?x', 'd?y', 'e*']\ncomponents = '''{text}'''\n")
            .replace("'d?x', 'd?y', 'e*'", "'dxx', 'dyx', 'dzx', 'exx', 'eyx', 'ezx', 'dxy', 'dyy', 'dzy', 'exy', 'eyy', 'ezy'")
    };
    assert_eq!(verdict(MACHINE, &file(matrices)), "holds");
    assert_eq!(verdict(MACHINE, &file(&matrices.replacen(r"x+\delta_x(x)", r"x-\delta_x(x)", 1))), "differs");
}

const POLAR: &str = "chain Eq {
 const phi: angle;
 body polar on ground { position_error: Rx(MA), Ry(-ME); motion: Rz(-h); motion_error: Rz(-IH); }
 body tube on polar { position_error: Rx(NP); motion: Ry(-delta); motion_error: Ry(-ID), Rz(-CH); }
 observe sky: hour_angle, declination of direction(1, 0, 0) of tube;
 observe los: direction(1, 0, 0) of tube;
}";

#[test]
fn lines_of_programs_are_formulas() {
    let file = |components: &str| {
        format!("chain = \"p\"\n[[claim]]\nname = \"a\"\nobservable = 'sky'\ncomponents = {components}\n")
    };
    for components in [
        "['+MA*cos(h)*tan(delta) + ME*sin(h)*tan(delta) + IH + NP*tan(delta) + CH/cos(delta)','-MA*sin(h) + ME*cos(h) + ID']",
        "['+MA*np.cos(h)*np.tan(delta) + ME*np.sin(h)*np.tan(delta) + IH + NP*np.tan(delta) + CH/np.cos(delta)','-MA*np.sin(h) + ME*np.cos(h) + ID']",
        "['dh = MA*cos(h).*tan(delta) + ME*sin(h).*tan(delta) + IH + NP*tan(delta) + CH./cos(delta);','dd = -MA*sin(h) + ME*cos(h) + ID;']",
        "['double dh = MA*cos(h)*tan(delta) + ME*sin(h)*tan(delta) + IH + NP*tan(delta) + CH/cos(delta);','double dd = -MA*sin(h) + ME*cos(h) + 1.0f*ID;']",
        "'np.array([MA*np.cos(h)*np.tan(delta) + ME*np.sin(h)*np.tan(delta) + IH + NP*np.tan(delta) + CH/np.cos(delta), -MA*np.sin(h) + ME*np.cos(h) + ID])'",
        "\"\"\"c = np.cos(h)\ns = np.sin(h)\nt = np.tan(delta)\ndh = MA*c*t + ME*s*t + IH + NP*t + CH/np.cos(delta)\ndd = -MA*s + ME*c + ID\n\"\"\"",
        "['IH + (MA*cos(h) + ME*sin(h) + NP)*sin(delta)/cos(delta) + CH*cos(delta)**-1', '-MA*sin(h) + ME*cos(h) + ID']",
    ] {
        assert_eq!(verdict(POLAR, &file(components)), "holds", "{components}");
    }
    for (components, said) in [
        ("['MA*np.cos(h)*np.tan(delta)', '0']", "differs"),
        ("['double x = 1/2*MA;', '0']", "in C the quotient"),
        ("['np.cos(h)^2*MA', '0']", "no power"),
        ("['np.exp(h)*MA', '0']", "not known"),
        ("['2 MA np.cos(h)', '0']", "nothing stands between"),
    ] {
        let found = verdict(POLAR, &file(components));
        assert!(found.contains(said), "{components}: {found}");
    }
}

#[test]
fn names_of_angles_are_no_components() {
    let gimbal = "chain G { body az on ground { position_error: Rx(tx), Ry(ty); motion: Rz(psi); motion_error: Rz(b); } body el on az { position_error: Rx(n); motion: Ry(-theta); motion_error: Ry(-b2), Rz(c); } observe los: azimuth, elevation of direction(1,0,0) of el; }";
    let file = |names: [&str; 2]| {
        format!(
            "chain = \"g\"\n[symbols]\n'b_2' = \"b2\"\n[[claim]]\nname = \"a\"\nkeep = ['b', 'b2']\ncomponents = '''\\begin{{aligned}} {} &= b \\\\ {} &= b_2 \\end{{aligned}}'''\n",
            names[0], names[1]
        )
    };
    for names in [
        [r"\Delta_{az}", r"\Delta_{el}"],
        [r"\Delta Az", r"\Delta El"],
        [r"\delta\theta_x", r"\delta\theta_y"],
        [r"\delta\theta_z", r"\delta\theta_y"],
        [r"\Delta Hz", r"\Delta z"],
    ] {
        assert_eq!(verdict(gimbal, &file(names)), "holds", "{names:?}");
    }
}

#[test]
fn bold_letters_are_letters_of_their_own() {
    let file = |components: &str| {
        format!(
            "chain = \"b\"\n[symbols]\n'\\boldsymbol{{\\omega}}' = \"[wx, wy, wz]\"\n'\\omega' = \"wx\"\n'\\delta{{\\psi}}' = \"dax\"\n'\\delta\\boldsymbol{{\\theta}}' = \"[wx, wy, wz]\"\n'{{}}^0\\mathbf{{p}}' = \"[wx, wy, wz]\"\n'^{{b}}R_{{s}}' = \"[[1,0,0],[0,1,0],[0,0,1]]\"\n[[claim]]\nname = \"a\"\nobservable = \"o\"\nkeep = ['w*']\ncomponents = '''{components}'''\n"
        )
    };
    for components in [
        r"\boldsymbol{\omega}",
        r"\delta\boldsymbol{\theta}",
        r"\bm{\omega}",
        r"{}^0\mathbf p",
        r"\,^bR_s\,\boldsymbol\omega",
        r"\begin{bmatrix}\omega\\ \mathbf{e}_y^T\boldsymbol\omega\\ \boldsymbol\omega\cdot\mathbf{e}_z\end{bmatrix}",
    ] {
        assert_eq!(verdict(SCANNER, &file(components)), "holds", "{components}");
    }
}

/// `A = B = C`: each formula is a claim.
#[test]
fn chains_of_equalities_are_as_many_claims() {
    let said = |equal: &str| {
        let found = verdicts("", &format!("[[claim]]\nname = \"a\"\nequal = {equal}\n"));
        found.into_iter().map(|(name, verdict)| format!("{name}: {verdict}")).collect::<Vec<_>>()
    };
    assert_eq!(
        said(r"'\sin 2a = 2 \sin a \cos a = \sin a + \cos a'"),
        ["a: equality 1: holds", "a: equality 2: differs"]
    );
    assert_eq!(said(r"'2 \sin a \cos a = \sin 2a'"), ["a: holds"]);
    assert_eq!(
        said(r"['\cos 2a', '1 - 2 \sin^2 a', '2 \cos^2 a - 1', '\cos^2 a']"),
        ["a: equality 1: holds", "a: equality 2: holds", "a: equality 3: differs"]
    );
    assert_eq!(said(r"'\sin a'").len(), 1);
    let chain = "chain L { const l: length; body b on ground { motion: Rz(q); motion_error: Rz(e); } observe p: point(l, 0, 0) of b; }";
    let file = |components: &str| {
        verdicts(
            chain,
            &format!(
                "chain = \"a\"\n[symbols]\n'\\epsilon' = \"e\"\n[[claim]]\nname = \"a\"\ncomponents = {components}\n"
            ),
        )
    };
    let holds = |side: &str| (format!("a: side {side}"), "holds".to_owned());
    let several =
        r"['\Delta x = -l \epsilon \sin q = -\epsilon l \cos q \tan q', '\Delta y = l \epsilon \cos q', '0']";
    assert_eq!(file(several), [holds("2"), holds("3")]);
    let wrong = file(&several.replace(r"\tan q", ""));
    assert_eq!(wrong, [holds("2"), ("a: side 3".to_owned(), "differs".to_owned())]);
    let vector = r"'\Delta\mathbf{p} = \begin{bmatrix} -l \epsilon \sin q \\ l \epsilon \cos q \\ 0 \end{bmatrix} = \epsilon \begin{bmatrix} 0 \\ 0 \\ 1 \end{bmatrix} \times \begin{bmatrix} l \cos q \\ l \sin q \\ 0 \end{bmatrix}'";
    assert_eq!(file(vector), [holds("2"), holds("3")]);
}

/// Equations in one line, and definitions among them.
#[test]
fn equations_beside_one_another_are_told_apart() {
    let beside = |text: &str| claims::latex::equations_beside(text);
    assert_eq!(
        beside(r"\mathbf{u} = (a,\; b,\; 0)^{\mathsf T},\quad \mathbf{k}=(0,0,1)^{\mathsf T}."),
        [r"\mathbf{u} = (a,\; b,\; 0)^{\mathsf T}", r"\mathbf{k}=(0,0,1)^{\mathsf T}"]
    );
    assert_eq!(beside(r"\begin{align} A &= b, & C &= d \end{align}").len(), 2);
    assert!(beside(r"A = b \quad (6)").is_empty());
    assert!(beside(r"A = b \\ C = d,\quad E = f").is_empty());
    // A list is no chain.
    assert_eq!(claims::latex::equalities_of(r"u = (a, b),\quad k = c").len(), 1);
    assert_eq!(claims::latex::equalities_of(r"u = (a, b) = k").len(), 2);
}
