//! Strings that a file may hold to do harm: they command a terminal, end a comment, open an element, begin a test, forge a message.
//!
//! What would act says `injected`, so that a test can look for the word where nothing should act.

/// Letters that nobody sees: every control character but NUL, marks of direction, separators of lines, letters without width.
fn unseen() -> impl Iterator<Item = char> {
    let ranges = [
        '\u{1}'..='\u{1f}',
        '\u{7f}'..='\u{9f}',
        '\u{ad}'..='\u{ad}',
        '\u{61c}'..='\u{61c}',
        '\u{200b}'..='\u{200f}',
        '\u{2028}'..='\u{202e}',
        '\u{2060}'..='\u{2064}',
        '\u{2066}'..='\u{2069}',
        '\u{feff}'..='\u{feff}',
        '\u{e0041}'..='\u{e0042}',
    ];
    ranges.into_iter().flatten()
}

/// What does something in some target.
const PAYLOADS: [&str; 110] = [
    // Terminals.
    "\u{1b}]0;injected\u{7}",
    "\u{1b}[31mX",
    "\u{1b}[2J\u{1b}[H",
    "\u{1b}P1$r\u{1b}\\",
    "\u{1b}[6n",
    "\u{9b}31mX",
    "\u{9d}0;injected\u{9c}",
    "\u{1b}]8;;http://injected\u{1b}\\X\u{1b}]8;;\u{1b}\\",
    "\u{1b}[1m\u{1b}[31merror\u{1b}[0m: injected",
    "\u{1b}c",
    "a\u{8}\u{8}b",
    "ok\rerror: injected",
    "x\nerror: injected",
    "x\r\nwarning: injected",
    "x\n  --> injected:1:1",
    "\u{202e}detcejni",
    "\u{2066}a\u{2069}",
    "x\u{2028}error: injected",
    "x\u{85}error: injected",
    "a\u{200b}b",
    "\tinjected",
    "\n\n\n",
    "\u{1b}",
    "\u{9b}",
    // Documentation of Rust and Markdown.
    "```\npanic!(\"injected\");\n```",
    "~~~\npanic!(\"injected\");\n~~~",
    "    panic!(\"injected\");",
    "\tpanic!(\"injected\");",
    "-      panic!(\"injected\");",
    "1.     panic!(\"injected\");",
    ">     panic!(\"injected\");",
    "> ```\n> panic!(\"injected\");",
    "a\n\n        panic!(\"injected\");",
    "* ```rust\n  panic!(\"injected\");",
    "[injected](javascript:injected)",
    "<img src=x onerror=injected>",
    "![injected](http://injected)",
    "[injected]: http://injected",
    "# injected",
    "injected\n===",
    "| injected |\n|---|",
    "`unpaired",
    "``two``",
    "\\`",
    "$\\input{injected}$",
    "&lt;injected&gt;",
    // Comments and texts of languages.
    "*/ injected(); /*",
    "*/",
    "/*",
    "//",
    "\\",
    "??/",
    "\\ ",
    "\"\"\"\nraise SystemExit('injected')\n\"\"\"",
    "'''",
    "\"",
    "'",
    "#",
    "%",
    "#error injected",
    "globalThis.injected = 1;",
    "raise SystemExit('injected')",
    "compile_error!(\"injected\");",
    "${injected}",
    "`${injected}`",
    "%injected",
    "%{\ninjected\n%}",
    "*) Axiom injected : False. (*",
    "(* \"",
    "#endif\n#error injected",
    "_Pragma(\"injected\")",
    // HTML, SVG and scripts.
    "<script>injected()</script>",
    "</script><script>injected()</script>",
    "<!--<script>",
    "-->",
    "]]>",
    "\" onload=\"injected()",
    "' onload='injected()",
    "</style><injected>",
    "<injected>",
    "</title><injected>",
    "<svg onload=injected()>",
    "javascript:injected()",
    "&#60;injected&#62;",
    // LaTeX.
    "\\input{injected}",
    "\\immediate\\write18{injected}",
    "$ injected $",
    "}\\injected{",
    "\\end{align*}\\injected",
    "^^5cinput{injected}",
    // JSON, TOML, tables, shells and names.
    "\",\"injected\":\"",
    "\"\ninjected = 1\n",
    "=HYPERLINK(\"injected\")",
    "a,b;c\td",
    "$(injected)",
    "`injected`",
    "; injected",
    "../../injected",
    "__proto__",
    "constructor",
    "%s%n%x",
    "{injected}",
    "{{injected}}",
    "=cmd|'/c injected'!A0",
    "+injected()",
    "@injected",
    "%APPDATA%\\injected",
    "CON",
    "~/injected",
    "a\u{202a}\u{202b}\u{202c}\u{202d}\u{2068}b",
];

/// Two hundred strings.
#[must_use]
pub fn hostile() -> Vec<String> {
    let letters = unseen().map(|letter| format!("a{letter}b"));
    letters.chain(PAYLOADS.map(str::to_owned)).collect()
}

/// Whether a letter does something to a reader's screen, or shows nothing; a line break and a tab do no harm where lines are written.
///
/// Written apart from the code that is tested.
#[must_use]
pub fn acts_on_a_screen(letter: char) -> bool {
    let number = u32::from(letter);
    !matches!(letter, '\n' | '\t')
        && (number < 0x20
            || (0x7f..0xa0).contains(&number)
            || [0xad, 0x61c, 0xfeff].contains(&number)
            || [0x200b..=0x200f, 0x2028..=0x202e, 0x2060..=0x2069, 0xe0000..=0xe007f]
                .iter()
                .any(|range| range.contains(&number)))
}
