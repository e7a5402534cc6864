//! A page of the book as a script: the files that it shows, the commands that it runs, and what they print.
//!
//! A code block of `sh` is run, each line that begins with `trueaxis`. A block of `text` directly behind it is what the
//! last of them prints; `…` there stands for anything. `<!-- file: NAME -->` before a block writes the block to a file,
//! `<!-- exit: 1 -->` says how the commands of the next block end
//! (so does `exit code 1` in a comment behind a command), and `sh,ignore` is a block that needs what is not here.

/// What a page does, in its order.
#[derive(Debug, Clone, PartialEq)]
pub enum Step {
    /// Writes a file.
    Write { name: String, text: String },
    /// Runs a command: its arguments, how it ends, and what it prints if the page shows that.
    Run { line: usize, arguments: Vec<String>, code: i32, shown: Option<Shown> },
}

/// An output that the page shows.
#[derive(Debug, Clone, PartialEq)]
pub struct Shown {
    /// The lines of the page that hold it, without the fences.
    pub lines: std::ops::Range<usize>,
    pub text: String,
}

struct Block {
    start: usize,
    end: usize,
    info: String,
    text: String,
    file: Option<String>,
    code: i32,
}

/// The steps of a page.
pub fn steps(page: &str) -> Vec<Step> {
    let lines: Vec<&str> = page.lines().collect();
    let blocks = blocks(&lines);
    let mut steps = Vec::new();
    for (at, block) in blocks.iter().enumerate() {
        if let Some(name) = &block.file {
            steps.push(Step::Write { name: name.clone(), text: block.text.clone() });
        }
        if block.info != "sh" {
            continue;
        }
        let shown = blocks.get(at + 1).filter(|next| {
            let between = &lines[block.end + 1..next.start];
            next.info == "text" && next.file.is_none() && between.iter().all(|line| line.trim().is_empty())
        });
        let mut runs: Vec<Step> = commands(&block.text)
            .into_iter()
            .map(|(arguments, code)| Step::Run {
                line: block.start + 1,
                arguments,
                code: code.unwrap_or(block.code),
                shown: None,
            })
            .collect();
        if let (Some(Step::Run { shown: last, .. }), Some(next)) = (runs.last_mut(), shown) {
            *last = Some(Shown { lines: next.start + 1..next.end, text: next.text.clone() });
        }
        steps.extend(runs);
    }
    steps
}

fn blocks(lines: &[&str]) -> Vec<Block> {
    let mut blocks = Vec::new();
    let (mut file, mut code) = (None, 0);
    let mut at = 0;
    while at < lines.len() {
        let line = lines[at].trim();
        if let Some(note) = line.strip_prefix("<!--").and_then(|rest| rest.strip_suffix("-->")) {
            if let Some(name) = note.trim().strip_prefix("file:") {
                file = Some(name.trim().to_owned());
            } else if let Some(number) = note.trim().strip_prefix("exit:") {
                code = number.trim().parse().expect("an exit code");
            }
        } else if let Some(info) = line.strip_prefix("```") {
            let length = lines[at + 1..].iter().take_while(|line| line.trim() != "```").count();
            let text = lines[at + 1..at + 1 + length].iter().map(|line| format!("{line}\n")).collect();
            blocks.push(Block {
                start: at,
                end: at + 1 + length,
                info: info.to_owned(),
                text,
                file: file.take(),
                code: std::mem::take(&mut code),
            });
            at += length + 1;
        }
        at += 1;
    }
    blocks
}

/// The arguments of each `trueaxis` in a block, lines continued with a backslash put together; and how it ends where a
/// comment behind it says so.
fn commands(text: &str) -> Vec<(Vec<String>, Option<i32>)> {
    text.replace("\\\n", " ")
        .lines()
        .filter_map(|line| {
            let words = words(line);
            let said = line.split_once("exit code ").and_then(|(_, rest)| rest.chars().next()?.to_digit(10));
            (words.first()? == "trueaxis").then(|| (words[1..].to_vec(), said.map(|code| code as i32)))
        })
        .collect()
}

/// Words as a shell splits them, for quotes and comments.
fn words(line: &str) -> Vec<String> {
    let mut words = Vec::new();
    let mut word: Option<String> = None;
    let mut quote = None;
    for c in line.chars() {
        match (quote, c) {
            (Some(open), c) if c == open => quote = None,
            (Some(_), c) => word.get_or_insert_default().push(c),
            (None, '\'' | '"') => {
                quote = Some(c);
                word.get_or_insert_default();
            }
            (None, '#') if word.is_none() => break,
            (None, c) if c.is_whitespace() => words.extend(word.take()),
            (None, c) => word.get_or_insert_default().push(c),
        }
    }
    words.extend(word);
    words
}

/// Whether a text is what the page shows, where `…` stands for anything, over lines too if it stands alone.
pub fn matches(shown: &str, printed: &str) -> bool {
    let mut rest = printed.trim_end();
    let mut pieces = shown.trim_end().split('…');
    let Some(first) = pieces.next() else { return rest.is_empty() };
    let Some(behind) = rest.strip_prefix(first) else { return false };
    rest = behind;
    let pieces: Vec<&str> = pieces.collect();
    for (at, piece) in pieces.iter().enumerate() {
        let last = at + 1 == pieces.len();
        let found =
            if last { rest.ends_with(piece).then(|| rest.len() - piece.len()) } else { rest.find(piece) };
        let Some(found) = found else { return false };
        rest = &rest[found + piece.len()..];
    }
    rest.is_empty()
}

#[test]
fn an_ellipsis_stands_for_anything() {
    assert!(matches("a …\nb\n", "a 1 2\nb"));
    assert!(matches("a\n…\nz", "a\nb\nc\nz\n"));
    assert!(!matches("a …\nb", "a 1\nc"));
    assert!(!matches("a", "a b"));
}

#[test]
fn a_page_is_read_in_its_order() {
    let page = "<!-- file: x.toml -->\n```toml\na = 1\n```\n\n```sh\ncargo x\ntrueaxis derive \"a b\" \\\n  c # why\n```\n\n```text\nout\n```\n";
    let [Step::Write { name, text }, Step::Run { arguments, shown: Some(shown), .. }] = &steps(page)[..]
    else {
        panic!("{:?}", steps(page))
    };
    assert_eq!((name.as_str(), text.as_str()), ("x.toml", "a = 1\n"));
    assert_eq!(arguments, &["derive", "a b", "c"]);
    assert_eq!(shown.text, "out\n");
}
