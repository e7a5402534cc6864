//! What the module answers to what a person may drop, paste or type, right or wrong.

use std::fs;
use std::path::Path;

use web::Message;

fn ask(parts: &[(&str, &[u8])]) -> Message {
    let asked = parts.iter().fold(Message::default(), |asked, (name, content)| asked.with(name, *content));
    Message::from_bytes(&web::answer(&asked.to_bytes(), &|_| {})).expect("an answer is a message")
}

fn text<'m>(answer: &'m Message, name: &str) -> &'m str {
    answer.text(name).unwrap_or_else(|why| panic!("{why}: {answer:?}"))
}

fn file(from_root: &str) -> Vec<u8> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("web lies in the workspace");
    fs::read(root.join(from_root)).expect("a file of the workspace")
}

/// Why a table is refused.
fn refused(name: &str, table: &[u8]) -> String {
    let answer = ask(&[("do", b"begin"), ("name", name.as_bytes()), ("table", table)]);
    assert_eq!(text(&answer, "status"), "refused", "{name}");
    text(&answer, "why").to_owned()
}

#[test]
fn a_wrong_table_is_refused_in_words() {
    for (name, table, says) in [
        ("empty.csv", b"".as_slice(), "empty.csv"),
        ("blank.csv", b"\n\n\n", "blank.csv"),
        ("numbers.csv", b"1,2,3\n4,5,6\n", "the first line holds numbers"),
        ("header.csv", b"azimuth [deg],elevation [deg],x,y,z\n", "header.csv"),
        ("picture.png", b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x01\0\xff\xfe", "picture.png"),
        ("other.csv", b"apples,pears\n1,2\n3,4\n", "does not say which kind of instrument"),
        ("book.xlsx", b"PK\x03\x04\x14\0\x06\0", "book.xlsx"),
        ("<b>.csv", b"a\n1\n", "<b>.csv"),
    ] {
        let why = refused(name, table);
        assert!(why.contains(says), "{name}: {why}");
    }
}

#[test]
fn a_damaged_message_is_refused() {
    for request in [b"\x05\0\0\0do".as_slice(), b"\xff\xff\xff\xff", b"\x01\0\0\0\xff\x01\0\0\0a"] {
        let answer = Message::from_bytes(&web::answer(request, &|_| {})).expect("an answer");
        assert!(text(&answer, "why").contains("damaged at byte 0"), "{answer:?}");
    }
    assert!(text(&ask(&[]), "why").contains("no `do`"));
    assert!(text(&ask(&[("do", b"magic")]), "why").contains("`magic`"));
    let no_text = ask(&[("do", b"derive"), ("order", b"1"), ("chain", b"chain a {\xff}")]);
    assert!(text(&no_text, "why").contains("no text in UTF-8"), "{no_text:?}");
}

#[test]
fn every_message_comes_back() {
    let message = Message::default().with("", "").with("a", vec![0, 255]).with("table:ü, 1.csv", "x");
    assert_eq!(Message::from_bytes(&message.to_bytes()), Ok(message.clone()));
    assert_eq!(message.beginning("table:").collect::<Vec<_>>(), [("ü, 1.csv", b"x".as_slice())]);
}

#[test]
fn a_study_without_its_table_says_which_is_missing() {
    let answer = ask(&[
        ("do", b"calibrate"),
        ("study-name", b"study.toml"),
        ("study", &file("examples/course/study.toml")),
        ("chain", &file("examples/course/mount.chain")),
        ("date", b"2026-11-27"),
        ("table:other.csv", b"a\n1\n"),
    ]);
    assert!(text(&answer, "why").contains("`secret.csv`, which was not given"), "{answer:?}");
}

#[test]
fn a_printed_formula_has_its_verdict() {
    let chain = file("examples/course/mount.chain");
    let derived = ask(&[("do", b"derive"), ("order", b"1"), ("chain", &chain)]);
    let latex = text(&derived, "latex");
    let formula = latex.split_once('\n').expect("a title").1;
    let checked =
        |formula: &str| ask(&[("do", b"check"), ("chain", &chain), ("formula", formula.as_bytes())]);
    let right = checked(formula);
    assert_eq!(text(&right, "status"), "done", "{formula}\n{}", text(&right, "text"));
    let wrong = checked(&formula.replacen("\\sin", "\\cos", 1));
    assert_eq!(text(&wrong, "status"), "no", "{}", text(&wrong, "text"));
    assert!(text(&checked(" "), "why").contains("there is no formula"));
    assert_eq!(text(&checked("\\frac{"), "status"), "no");
}

/// The page forbids every script but its own and that of the report, which it knows by its checksum.
#[test]
fn the_page_allows_the_script_of_the_report() {
    let answer = ask(&[
        ("do", b"calibrate"),
        ("study-name", b"study.toml"),
        ("study", &file("examples/course/study.toml")),
        ("chain", &file("examples/course/mount.chain")),
        ("date", b"2026-11-27"),
        ("table:secret.csv", &file("examples/course/secret.csv")),
    ]);
    let report = text(&answer, "file:report.html");
    let script = report.split_once("<script>").and_then(|(_, behind)| behind.split_once("</script>"));
    let (script, _) = script.expect("the report has a script");
    let digest = tables::formats::sha256::hex(script.as_bytes()).expect("bytes are read");
    let bytes: Vec<u8> =
        (0..32).filter_map(|at| u8::from_str_radix(&digest[2 * at..2 * at + 2], 16).ok()).collect();
    let allowed = format!("'sha256-{}'", base64(&bytes));
    let page = String::from_utf8(file("web/page/index.html")).expect("UTF-8");
    assert!(page.contains(&allowed), "write {allowed} into the policy of web/page/index.html");
    assert!(page.contains("default-src 'none'") && page.contains("connect-src 'self'"));
    assert_eq!(report.matches("<script").count(), 2, "a script of the report is not allowed by the page");
}

fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::new();
    for three in bytes.chunks(3) {
        let bits =
            three.iter().enumerate().fold(0_u32, |bits, (at, byte)| bits | u32::from(*byte) << (16 - 8 * at));
        let letter = |at: usize| char::from(LETTERS[(bits >> (18 - 6 * at)) as usize & 63]);
        text.extend((0..4).map(|at| if at <= three.len() { letter(at) } else { '=' }));
    }
    text
}
