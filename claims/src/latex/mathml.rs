//! Formulas as MathML, which a browser sets in type without help from outside. What is not known to this writer makes no
//! MathML at all, so that a formula is never shown as another one.

mod brackets;
mod elements;

use super::commands::FUNCTIONS;
use super::left;
use super::signs;
use super::token::{Kind, Token};
use elements::{operator, table};
use model_core::escape::markup;

/// Parts within parts that are written, and tokens of one formula.
const DEEPEST: usize = 60;
const LONGEST: usize = 4000;

/// Functions and words of mathematics that are set upright.
const UPRIGHT: [&str; 18] = [
    "arcsin", "arccos", "arctan", "arccot", "sinh", "cosh", "tanh", "exp", "ln", "log", "lg", "arg", "det",
    "max", "min", "lim", "rank", "atan",
];

/// The space beside a function.
const THIN: &str = "<mspace width=\"0.17em\"></mspace>";

fn is_function(kind: &Kind) -> bool {
    matches!(kind, Kind::Command(name) if FUNCTIONS.contains(&name.as_str()) || UPRIGHT.contains(&name.as_str()))
}

/// Operators with their limits above and below.
const LARGE: [(&str, &str); 4] = [("sum", "∑"), ("prod", "∏"), ("int", "∫"), ("oint", "∮")];

/// A formula in LaTeX as an element of MathML; `None` where something in it is not known.
#[must_use]
pub fn mathml(text: &str) -> Option<String> {
    if has_sentence(text) {
        return None;
    }
    let tokens = left::as_set(text).ok().filter(|tokens| tokens.len() <= LONGEST)?;
    let mut writer = Writer { text, tokens: &tokens, at: 0, depth: 0 };
    let rows = writer.table(&|_| false)?;
    let inside = match rows.as_slice() {
        [row] if row.len() == 1 => row[0].clone(),
        _ => table(&rows, true),
    };
    (writer.at == tokens.len()).then(|| format!("<math displaystyle=\"true\">{inside}</math>"))
}

/// Whether a text in upright type has blanks in it, which tokens leave out.
fn has_sentence(text: &str) -> bool {
    ["\\text{", "\\mathrm{", "\\textrm{", "\\textit{", "\\mbox{"].iter().any(|command| {
        text.split(command).skip(1).any(|behind| {
            let inside = behind.split('}').next().unwrap_or_default();
            inside.trim().contains(' ') && !inside.contains('\\')
        })
    })
}

struct Writer<'a> {
    text: &'a str,
    tokens: &'a [Token],
    at: usize,
    depth: usize,
}

/// What ends a list of parts.
type Ends<'e> = &'e dyn Fn(&Kind) -> bool;

impl<'a> Writer<'a> {
    fn peek(&self) -> Option<&'a Token> {
        self.tokens.get(self.at)
    }

    fn is_at_mark(&self, mark: char) -> bool {
        self.peek().is_some_and(|token| token.kind == Kind::Mark(mark))
    }

    /// Rows of cells up to an end, which is left.
    fn table(&mut self, ends: Ends<'_>) -> Option<Vec<Vec<String>>> {
        let mut rows = vec![Vec::new()];
        loop {
            let cell = self.row(&|kind| ends(kind) || matches!(kind, Kind::Row | Kind::Mark('&')))?;
            rows.last_mut()?.push(cell);
            match self.peek().map(|token| &token.kind) {
                Some(Kind::Row) => rows.push(Vec::new()),
                Some(Kind::Mark('&')) => {}
                _ => break,
            }
            self.at += 1;
        }
        // A row that was ended and has nothing in it.
        let is_empty = |row: &Vec<String>| row.iter().all(|cell| cell == "<mrow></mrow>");
        if rows.len() > 1 && rows.last().is_some_and(is_empty) {
            rows.pop();
        }
        Some(rows)
    }

    /// Parts side by side up to an end, which is left.
    fn row(&mut self, ends: Ends<'_>) -> Option<String> {
        let mut out = String::from("<mrow>");
        while let Some(token) = self.peek() {
            if ends(&token.kind) {
                break;
            }
            // A function stands apart from what it multiplies, and from an angle without brackets.
            let is_function = is_function(&token.kind);
            if is_function && out.len() > "<mrow>".len() && !out.ends_with("</mo>") {
                out.push_str(THIN);
            }
            out.push_str(&self.scripted()?);
            let is_angle = |kind: &Kind| !matches!(kind, Kind::Mark(_)) && !ends(kind);
            if is_function && self.peek().is_some_and(|next| is_angle(&next.kind)) {
                out.push_str(THIN);
            }
        }
        out.push_str("</mrow>");
        Some(out)
    }

    /// A part with what stands above and below it, on its right and on its left.
    fn scripted(&mut self) -> Option<String> {
        let mut before = None;
        if self.peek()?.kind == Kind::Left {
            self.at += 1;
            before = Some(self.scripts()?);
        }
        let is_large = matches!(&self.peek()?.kind, Kind::Command(name) if LARGE.iter().any(|(large, _)| large == name) || name == "lim");
        let mut base = self.part()?;
        while self.is_at_mark('\'') {
            self.at += 1;
            base = format!("<msup>{base}<mo>′</mo></msup>");
        }
        let [lower, upper] = self.scripts()?;
        let [under, sub] = if is_large { ["munder", "mover"] } else { ["msub", "msup"] };
        let both = if is_large { "munderover" } else { "msubsup" };
        base = match (lower, upper) {
            (None, None) => base,
            (Some(lower), None) => format!("<{under}>{base}{lower}</{under}>"),
            (None, Some(upper)) => format!("<{sub}>{base}{upper}</{sub}>"),
            (Some(lower), Some(upper)) => format!("<{both}>{base}{lower}{upper}</{both}>"),
        };
        let Some([lower, upper]) = before else { return Some(base) };
        let or_nothing = |script: Option<String>| script.unwrap_or_else(|| "<mrow></mrow>".to_owned());
        let (lower, upper) = (or_nothing(lower), or_nothing(upper));
        Some(format!("<mmultiscripts>{base}<mprescripts></mprescripts>{lower}{upper}</mmultiscripts>"))
    }

    /// What stands below and above, in this order.
    fn scripts(&mut self) -> Option<[Option<String>; 2]> {
        let mut found = [None, None];
        while let Some(Token { kind: Kind::Mark(mark @ ('_' | '^')), .. }) = self.peek() {
            let place = usize::from(*mark == '^');
            self.at += 1;
            if found[place].is_some() {
                return None;
            }
            found[place] = Some(self.argument()?);
        }
        Some(found)
    }

    /// A group in braces, or one part.
    fn argument(&mut self) -> Option<String> {
        if self.is_at_mark('{') { self.group() } else { self.part() }
    }

    /// What stands in braces; `{a \over b}` is a fraction.
    fn group(&mut self) -> Option<String> {
        let over = Kind::Command("over".to_owned());
        self.at += 1;
        let mut inside = self.row(&|kind| *kind == Kind::Mark('}') || *kind == over)?;
        if self.peek()?.kind == over {
            self.at += 1;
            let below = self.row(&|kind| *kind == Kind::Mark('}'))?;
            inside = format!("<mfrac>{inside}{below}</mfrac>");
        }
        self.is_at_mark('}').then(|| {
            self.at += 1;
            inside
        })
    }

    /// One letter, number, sign or group.
    fn part(&mut self) -> Option<String> {
        if self.depth == DEEPEST {
            return None;
        }
        self.depth += 1;
        let part = self.part_of(self.peek()?);
        self.depth -= 1;
        part
    }

    fn part_of(&mut self, token: &Token) -> Option<String> {
        match &token.kind {
            Kind::Digit(_) => Some(self.number()),
            Kind::Mark('{') => self.group(),
            Kind::Mark('(' | '[') | Kind::OpenBrace => self.fenced(),
            Kind::Mark('^' | '_' | '}' | '&') | Kind::Row | Kind::End(_) | Kind::Left | Kind::Name(_) => None,
            Kind::Begin(name) => {
                self.at += 1;
                self.environment(name)
            }
            Kind::Word(word) => {
                self.at += 1;
                Some(self.identifier(token, word))
            }
            Kind::Command(command) => {
                self.at += 1;
                self.command(token, command)
            }
            Kind::Math => {
                self.at += 1;
                Some("<mrow></mrow>".to_owned())
            }
            Kind::Wide => {
                self.at += 1;
                Some("<mspace width=\"1em\"></mspace>".to_owned())
            }
            Kind::CloseBrace => {
                self.at += 1;
                Some(operator("}", false))
            }
            Kind::Mark(mark) => {
                self.at += 1;
                Some(operator(&self.sign_of(token, *mark)?, false))
            }
        }
    }

    /// Digits and points that stand side by side.
    fn number(&mut self) -> String {
        let mut digits = String::new();
        let mut end = None;
        while let Some(token) = self.peek() {
            let digit = match token.kind {
                Kind::Digit(digit) => digit,
                Kind::Mark('.')
                    if matches!(self.tokens.get(self.at + 1), Some(Token { kind: Kind::Digit(_), .. })) =>
                {
                    '.'
                }
                _ => break,
            };
            if end.is_some_and(|end| token.place.start != end) {
                break;
            }
            end = Some(token.place.end);
            digits.push(digit);
            self.at += 1;
        }
        format!("<mn>{digits}</mn>")
    }

    /// A letter or a word, in the type that it is set in.
    fn identifier(&self, token: &Token, word: &str) -> String {
        let shown: String =
            if token.bold { word.chars().map(signs::bold).collect() } else { word.to_owned() };
        let is_upright =
            word.chars().count() == 1 && (token.bold || self.text[token.place.clone()].starts_with('\\'));
        let variant = if is_upright { " mathvariant=\"normal\"" } else { "" };
        format!("<mi{variant}>{}</mi>", markup(&shown))
    }

    /// The sign of a mark as the text has it: `\approx` is read as `=`, and shown as it is.
    fn sign_of(&self, token: &Token, mark: char) -> Option<String> {
        let written = self.text[token.place.clone()].trim();
        if let Some(command) = written.strip_prefix('\\') {
            return match command.chars().next() {
                Some(letter) if letter.is_ascii_alphabetic() => signs::sign(command)
                    .map(|(sign, _)| sign)
                    .or_else(|| matches!(mark, '[' | ']' | '/').then(|| mark.to_string())),
                _ => Some(mark.to_string()),
            };
        }
        let mut letters = written.chars();
        Some(match (letters.next(), letters.next(), mark) {
            (_, _, '-') => "−".to_owned(),
            (Some(only), None, _) if !only.is_ascii() => only.to_string(),
            (_, _, '\'') => "′".to_owned(),
            _ => mark.to_string(),
        })
    }

    fn command(&mut self, token: &Token, command: &str) -> Option<String> {
        if is_function(&token.kind) {
            return Some(format!("<mi>{command}</mi>"));
        }
        if let Some((_, sign)) = LARGE.iter().find(|(name, _)| *name == command) {
            return Some(operator(sign, false));
        }
        if let Some(above) = signs::accent(command) {
            let inside = self.argument()?;
            let above = operator(above, false);
            return Some(format!("<mover accent=\"true\">{inside}{above}</mover>"));
        }
        if super::commands::FRACTIONS.contains(&command) {
            let above = self.argument()?;
            let below = self.argument()?;
            return Some(format!("<mfrac>{above}{below}</mfrac>"));
        }
        if command == "sqrt" {
            if self.is_at_mark('[') {
                self.at += 1;
                let index = self.row(&|kind| *kind == Kind::Mark(']'))?;
                self.at += usize::from(self.is_at_mark(']'));
                let inside = self.argument()?;
                return Some(format!("<mroot>{inside}{index}</mroot>"));
            }
            return Some(format!("<msqrt>{}</msqrt>", self.argument()?));
        }
        if matches!(command, "lvert" | "rvert" | "vert") {
            return Some(operator("|", false));
        }
        if matches!(command, "lVert" | "rVert" | "Vert") {
            return Some(operator("‖", false));
        }
        let (sign, is_letter) = signs::sign(command)?;
        if !is_letter {
            return Some(operator(&sign, false));
        }
        // Capital Greek letters stand upright.
        let is_upright = token.bold || sign.chars().all(char::is_uppercase);
        let shown: String = if token.bold { sign.chars().map(signs::bold).collect() } else { sign };
        let variant = if is_upright { " mathvariant=\"normal\"" } else { "" };
        Some(format!("<mi{variant}>{shown}</mi>"))
    }
}
