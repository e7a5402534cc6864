//! Notations of an audit: formulas of instruments that had no part in the reader's making. Each line was refused or misread once.

use super::support::{verdict, verdicts};

const ARM: &str = "chain Scara { const a1: length; const a2: length; const h: length;
 body l1 on ground { position: Tz(h); motion: Rz(q1); motion_error: Rz(c1*cos(q1) + s1*sin(q1)); position: Tx(a1); position_error: Tx(da1); }
 body l2 on l1 { motion: Rz(q2); position: Tx(a2); position_error: Tx(da2); }
 body quill on l2 { position: Rx(pi); motion: Tz(d3); motion_error: Tz(dd3); }
 observe tip: point(0, 0, 0) of quill; }";

fn of_arm(symbols: &str, keys: &str) -> String {
    verdict(ARM, &format!("chain = \"a\"\n[symbols]\n{symbols}\n[[claim]]\nname = \"a\"\n{keys}\n"))
}

const REACH: &str =
    r"shows = '''\begin{pmatrix} a_1 c_1 + a_2 c_{12} \\ a_1 s_1 + a_2 s_{12} \\ h - d_3 \end{pmatrix}'''";

/// The declaration has an error of that name.
#[test]
fn a_cosine_is_not_taken_for_a_declared_letter() {
    let said = of_arm("", REACH);
    assert!(said.contains("is `c_{1}` the declared `c1`, or cos(q1)?"), "{said}");
    // The table of symbols prints these errors in another way, or says what the letters are.
    assert_eq!(of_arm("'c^{(1)}' = \"c1\"\n's^{(1)}' = \"s1\"", REACH), "holds");
    assert_eq!(of_arm("'c_1' = \"cos(q1)\"\n's_1' = \"sin(q1)\"", REACH), "holds");
    let harmonics = "keep = ['c1', 's1']\ncomponents = ['-(a_1 \\sin q_1 + a_2 \\sin(q_1+q_2))(c_1 \\cos q_1 + s_1 \\sin q_1)', '(a_1 \\cos q_1 + a_2 \\cos(q_1+q_2))(c_1 \\cos q_1 + s_1 \\sin q_1)', '0']";
    assert_eq!(of_arm("'c_1' = \"c1\"\n's_1' = \"s1\"", harmonics), "holds");
    assert_eq!(of_arm("'c_1' = \"c1\"\n's_1' = \"s1\"", &harmonics.replacen("+ s_1", "- s_1", 1)), "differs");
}

/// What is kept is the lengths of the links and the stroke.
fn lines(formula: &str) -> String {
    of_arm("", &format!("keep = ['da*', 'dd3']\ncomponents = \"\"\"{formula}\"\"\""))
}

#[test]
fn lines_of_programs_as_they_are_written() {
    let vectors = "Rz1 = [cos(q1) -sin(q1) 0; sin(q1) cos(q1) 0; 0 0 1];
Rz2 = [cos(q2) -sin(q2) 0
       sin(q2) cos(q2) 0
       0 0 1];
dp = Rz1*[da1; 0; 0] + Rz1*Rz2*[da2; 0; -dd3];";
    for text in [
        vectors,
        "double ca = cos(q1), sa = sin(q1);\nconst double cb = cos(q1 + q2), sb = sin(q1 + q2);\ndouble dx = da1*ca + da2*cb;\ndouble dy = da1*sa + da2*sb;\ndouble dz = -dd3;",
        "from math import sin, cos\nimport numpy as np\nA = np.array([[cos(q1), -sin(q1), 0], [sin(q1), cos(q1), 0], [0, 0, 1]])\nB = np.array([[cos(q2), -sin(q2), 0], [sin(q2), cos(q2), 0], [0, 0, 1]])\ndp = A.dot(np.array([da1, 0, 0])) + A.dot(B).dot(np.array([[da2], [0], [-dd3]]).flatten())",
        "dx = da1*cos(q1) + da2*cos(q1 + q2)\ndy = da1*sin(q1) + da2*sin(q1 + q2)\ndz = -dd3",
    ] {
        assert_eq!(lines(text), "holds", "{text}");
        assert_eq!(lines(&text.replace("-dd3", "dd3")), "differs", "{text}");
        assert_eq!(lines(&text.replacen("sin(q1", "cos(q1", 1)), "differs", "{text}");
    }
    assert!(lines("dp = [da1*cos(q1) -da2, 0, 0];").contains("does a new entry begin"), "mixed lists");
}

/// A line that gives a declared name another value would leave it open which one is meant below.
#[test]
fn a_name_that_a_line_gives_anew_is_asked_for() {
    let said = lines("c1 = np.cos(q1)\ns1 = np.sin(q1)\ndp = np.array([da1*c1, da1*s1, -dd3])");
    assert!(said.contains("is `c1` here the declared one"), "{said}");
    assert!(lines("d3 = np.cos(q1)\ndp = np.array([da1*d3, 0, 0])").contains("is `d3` here"));
}

#[test]
fn displays_as_they_are_set() {
    let rows = |equals: &str| {
        format!(
            r"\Delta x {equals} \Delta a_1 \cos q_1 + \Delta a_2 \cos(q_1 + q_2) \\ \Delta y {equals} \Delta a_1 \sin q_1 {{}}+ \Delta a_2 \sin(q_1 + q_2) \\ \Delta z {equals} -\Delta d_3"
        )
    };
    for (open, equals, close) in [
        (r"\left. \begin{array}{rcl}", "&=&", r"\end{array} \right\}"),
        (r"\begin{dcases}", "=", r"\end{dcases}"),
        (r"\begin{rcases}", "&=", r"\end{rcases}"),
        (r"\begin{subequations} \label{all} \begin{align}", "&=", r"\end{align} \end{subequations}"),
        (r"\begin{IEEEeqnarray}{rCl}", "&=&", r"\end{IEEEeqnarray}"),
        (r"\begin{equation} \begin{alignedat}{2}", "&=", r"\end{alignedat} \end{equation}"),
    ] {
        let text = format!("{open} {} {close}", rows(equals));
        let claim = |text: &str| of_arm("", &format!("keep = ['da*', 'dd3']\ncomponents = '''{text}'''"));
        assert_eq!(claim(&text), "holds", "{text}");
        assert_eq!(claim(&text.replace("{}+", "{}-")), "differs", "{text}");
    }
}

#[test]
fn matrices_as_they_are_set() {
    let frame = |text: &str| of_arm("", &format!("body = \"l1\"\nframe = '''{text}'''"));
    for text in [
        r"\cos q_1\, I + \sin q_1\, [\mathbf{e}_z]_\times + (1 - \cos q_1)\, \mathbf{e}_z \mathbf{e}_z^T",
        r"I + \sin q_1 [\mathbf{e}_z]_\times + (1 - \cos q_1) [\mathbf{e}_z]_\times^2",
        r"\operatorname{Rot}(\hat{z}, q_1)",
        r"\begin{bmatrix*}[r] \cos q_1 & -\sin q_1 & 0 \\ \sin q_1 & \cos q_1 & 0 \\ 0 & 0 & 1 \end{bmatrix*}",
    ] {
        assert_eq!(frame(text), "holds", "{text}");
    }
    assert_eq!(
        frame(r"I + \sin q_1 [\mathbf{e}_z]_\times + (1 + \cos q_1) [\mathbf{e}_z]_\times^2"),
        "differs"
    );
    let said = frame(r"\mathbf{R} \mathbf{t}^T");
    assert!(said.contains("unknown symbol"), "{said}");
}

const MOUNT: &str = "chain M { body az on ground { position_error: Rx(u), Ry(w); motion: Rz(-hz); } body el on az { position_error: Ry(k); motion: Rx(pi/2 - z); motion_error: Rx(-i), Rz(-c); } observe ang: azimuth(y, x), zenith_distance of direction(0, 1, 0) of el; }";

#[test]
fn signs_that_are_pasted_and_derivatives_of_angles() {
    let claim = |keys: &str| {
        let file =
            format!("chain = \"m\"\n[symbols]\n'V' = \"z\"\n'H' = \"hz\"\n[[claim]]\nname = \"a\"\n{keys}\n");
        let found = verdicts(MOUNT, &file);
        assert_eq!(found.len(), 1, "{found:?}");
        found[0].1.clone()
    };
    let pasted = "components = ['c/sin V + k·cot V + (u·sin H + w·cos H)·cot V', 'i − u·cos H + w·sin H']";
    assert_eq!(claim(pasted), "holds");
    assert_eq!(claim(&pasted.replace('−', "+")), "differs");
    let jacobian = r"by = ['u', 'c', 'i']
jacobian = '\begin{bmatrix} \sin H \cot V & \csc V & 0 \\ -\cos H & 0 & 1 \end{bmatrix}'";
    assert_eq!(claim(jacobian), "holds");
    assert_eq!(claim(&jacobian.replace(r"-\cos", r"\cos")), "differs");
    assert!(claim("by = ['hz', 'z']\njacobian = '[[1, 0], [0, 1]]'").contains("by errors only"));
    let dropped = r"keep = ['i']
components = ['0', 'i + O(\|\mathbf{i}\|^2)']";
    assert_eq!(claim(dropped), "holds");
}

#[test]
fn a_table_of_symbols_takes_what_a_paper_prints() {
    for vector in ["(a_1, 0, h)^T", "[a1, 0, h]^T", "[a1 0 h]'"] {
        let symbols = format!("'\\mathbf{{d}}' = \"{vector}\"");
        let claim = r"equal = ['\mathbf{e}_z^T \mathbf{d} + \mathbf{e}_x^T \mathbf{d}', 'h + a_1']";
        assert_eq!(of_arm(&symbols, claim), "holds", "{vector}");
    }
}
