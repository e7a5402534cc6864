//! Formulas as MathML: what is shown of them, and that a page with them is well-formed.

use claims::latex::mathml;
use claims::show::{Format, Line, Piece, as_table};

/// Whether every element is closed where it was opened, and nothing stands in texts that could open another one. Reads the elements
/// letter by letter, and knows no MathML but how many parts an element takes.
pub fn is_well_formed(page: &str) -> bool {
    let mut open: Vec<(String, usize)> = Vec::new();
    let mut rest = page;
    while let Some(at) = rest.find('<') {
        let text = &rest[..at];
        let entities = ["&lt;", "&gt;", "&amp;", "&quot;", "&#39;"];
        let escaped = |at: usize| entities.iter().any(|entity| text[at..].starts_with(entity));
        if text.contains('>') || !text.match_indices('&').all(|(at, _)| escaped(at)) {
            return false;
        }
        let Some(end) = rest[at..].find('>') else { return false };
        let tag = &rest[at + 1..at + end];
        rest = &rest[at + end + 1..];
        if let Some(name) = tag.strip_prefix('/') {
            let Some((opened, parts)) = open.pop() else { return false };
            let wanted = match name {
                "mfrac" | "msub" | "msup" | "munder" | "mover" | "mroot" => Some(2),
                "msubsup" | "munderover" => Some(3),
                "mmultiscripts" => Some(4),
                _ => None,
            };
            if opened != name || wanted.is_some_and(|wanted| wanted != parts) {
                return false;
            }
        } else {
            if let Some((_, parts)) = open.last_mut() {
                *parts += 1;
            }
            let name = tag.split(' ').next().unwrap_or_default();
            let attributes = &tag[name.len()..];
            let is_word = name.chars().all(|c| c.is_ascii_alphanumeric());
            if !is_word || attributes.matches('"').count() % 2 == 1 {
                return false;
            }
            open.push((name.to_owned(), 0));
        }
    }
    open.is_empty() && !rest.contains(['<', '>'])
}

#[test]
fn formulas_are_set_as_they_are_printed() {
    for (text, wanted) in [
        (r"x^2", "<msup><mi>x</mi><mn>2</mn></msup>"),
        (r"\Delta\theta_{y1}^0", "<msubsup><mi>θ</mi><mrow><mi>y</mi><mn>1</mn></mrow><mn>0</mn></msubsup>"),
        (r"\frac{1}{2.5}", "<mfrac><mrow><mn>1</mn></mrow><mrow><mn>2.5</mn></mrow></mfrac>"),
        (r"a \approx b", "<mo>≈</mo>"),
        (r"a - b \cdot c", "<mo>−</mo><mi>b</mi><mo>·</mo>"),
        (
            r"{}^0\mathbf{p}",
            "<mmultiscripts><mi mathvariant=\"normal\">𝐩</mi><mprescripts></mprescripts><mrow></mrow><mn>0</mn></mmultiscripts>",
        ),
        (r"\sqrt{\vec r}", "<msqrt><mrow><mover accent=\"true\"><mi>r</mi>"),
        (r"\sum_{k=1}^{3} e_k", "<munderover><mo>∑</mo>"),
        (r"\left(\frac{a}{b}\right)^2", "<mo stretchy=\"true\">(</mo>"),
        (r"[x\ y\ z]^T", "<mi>x</mi><mi>y</mi><mi>z</mi>"),
        (r"a < b", "<mo>&lt;</mo>"),
        (r"\begin{bmatrix} 1 & 0 \\ 0 & 1 \end{bmatrix}", "<mtd><mrow><mn>1</mn></mrow></mtd>"),
        (r"\begin{aligned} x &= 1 \\ y &= 2 \end{aligned}", "text-align:right"),
        (r"\lVert \mathrm{range} \rVert", "<mo stretchy=\"false\">‖</mo><mi>range</mi>"),
    ] {
        let page = mathml(text).unwrap_or_else(|| panic!("{text} was not set"));
        assert!(page.contains(wanted), "{text}: {page}");
        assert!(is_well_formed(&page), "{text}: {page}");
    }
}

/// What is not known stays the code that it is, so that nothing is shown as something else.
#[test]
fn what_is_not_known_makes_no_mathml() {
    for text in [
        r"\unknowncommand x",
        r"\text{where the axis is level}",
        "x^",
        "x_1_2",
        r"\begin{bmatrix} 1",
        r"\mathcal{R}",
    ] {
        assert_eq!(mathml(text), None, "{text}");
    }
    let deep = format!("{}x{}", "{".repeat(5000), "}".repeat(5000));
    assert_eq!(mathml(&deep), None);
    assert_eq!(mathml(&r"\hat".repeat(3000)), None);
    assert!(mathml(&"(".repeat(3000)).is_some_and(|page| is_well_formed(&page)));
}

#[test]
fn a_page_of_verdicts_is_well_formed_whatever_it_shows() {
    let hostile = "<script>alert('1')</script> & \"x\" \u{202e}";
    let formula = |text: &str| Piece::Formula(text.to_owned());
    let line = Line {
        name: hostile.to_owned(),
        equation: vec![
            formula(r"\Delta x = \frac{a}{b} < 1"),
            formula(hostile),
            formula(r"\mathrm{<b>} \text{</math><img>} x"),
            Piece::Code(hostile.to_owned()),
        ],
        verdict: "differs",
        remarks: vec![vec![Piece::Words(hostile.to_owned()), formula(r"-\cos \alpha")]],
    };
    let page = as_table(hostile, &[line], Format::Html);
    assert!(
        page.contains("<mfrac>")
            && page.contains("<mo>−</mo><mi>cos</mi><mspace width=\"0.17em\"></mspace><mi>α</mi>"),
        "{page}"
    );
    assert!(!page.contains("<script") && !page.contains("<img") && !page.contains("<b>"), "{page}");
    assert!(!page.contains("http"), "{page}");
    let body = page.split_once("</head>").unwrap().1.replace("<br>", "");
    assert!(is_well_formed(&format!("<html>{body}")), "{page}");
}
