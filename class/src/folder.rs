//! What a student gets: a sheet without solution, a declaration, data, a study and an empty answer.

use std::fmt::Write as _;

use model_core::escape::{line, markdown};

use crate::cause::Cause;
use crate::level::Level;
use crate::misread::Reading;
use crate::model::OBSERVABLE;
use crate::policy::DECLARED_ARCSEC;
use crate::refit::KIND;
use crate::sentence::SENTENCES;
use crate::task::Task;

/// The file that a student hands in beside [`AMENDED`].
pub const ANSWER: &str = "answer.toml";
/// The declaration that a student hands in.
pub const AMENDED: &str = "amended.chain";
/// The data.
const DATA: &str = "data.csv";

/// Characters from which on a folder takes no more of a name.
const KEPT: usize = 40;

/// The files of a student, by name. None says anything of the secret but what the data say.
#[must_use]
pub fn files(task: &Task, name: &str, mark: &str) -> Vec<(&'static str, String)> {
    vec![
        ("sheet.md", sheet(task, name, mark)),
        ("instrument.chain", task.instrument.declaration.to_owned()),
        (DATA, data(task)),
        ("pose.csv", pose(task)),
        ("study.toml", study(task)),
        (ANSWER, answer(task, mark)),
    ]
}

/// A name for a folder that every system takes: the number, and the letters and digits of the name.
#[must_use]
pub fn folder_name(number: usize, name: &str) -> String {
    let mut folder = format!("{number:03}");
    let mut gap = true;
    for letter in name.chars() {
        if folder.len() >= KEPT {
            break;
        }
        let plain = plain(letter);
        if !plain.is_empty() && gap {
            folder.push('-');
        }
        folder.push_str(&plain);
        gap = plain.is_empty();
    }
    folder
}

/// A letter without its accent, as a file name has it; nothing for what is no Latin letter or digit.
fn plain(letter: char) -> String {
    let lower: String = letter.to_lowercase().filter(|own| own.is_alphanumeric()).collect();
    let same = match lower.chars().next().unwrap_or_default() {
        'à'..='å' | 'ā' | 'ă' | 'ą' => "a",
        'ç' | 'ć' | 'ĉ' | 'ċ' | 'č' => "c",
        'ð' | 'ď' | 'đ' => "d",
        'è'..='ë' | 'ē' | 'ĕ' | 'ė' | 'ę' | 'ě' => "e",
        'ĝ' | 'ğ' | 'ġ' | 'ģ' => "g",
        'ì'..='ï' | 'ĩ' | 'ī' | 'į' | 'ı' | 'i' => "i",
        'ķ' => "k",
        'ĺ' | 'ļ' | 'ľ' | 'ł' => "l",
        'ñ' | 'ń' | 'ņ' | 'ň' => "n",
        'ò'..='ö' | 'ø' | 'ō' | 'ő' => "o",
        'ŕ' | 'ř' => "r",
        'ś' | 'ş' | 'š' | 'ș' => "s",
        'ţ' | 'ť' | 'ț' => "t",
        'ù'..='ü' | 'ũ' | 'ū' | 'ŭ' | 'ů' | 'ű' | 'ų' => "u",
        'ý' | 'ÿ' => "y",
        'ź' | 'ż' | 'ž' => "z",
        'æ' => "ae",
        'œ' => "oe",
        'ß' => "ss",
        'þ' => "th",
        own if own.is_ascii_alphanumeric() => return own.to_string(),
        _ => "",
    };
    same.to_owned()
}

fn headings(task: &Task) -> [String; 2] {
    task.instrument.joints().map(|joint| format!("{joint} [deg]"))
}

/// The rows as a table.
#[must_use]
pub fn data(task: &Task) -> String {
    let [first, second] = headings(task);
    let mut text = format!("{first},{second},temperature,set_up,x,y,z\n");
    for (pose, [x, y, z]) in &task.rows {
        let [first, second] = pose.joints_deg;
        let _ = writeln!(text, "{first},{second},{},{},{x:.9},{y:.9},{z:.9}", pose.temperature, pose.set_up);
    }
    text
}

fn pose(task: &Task) -> String {
    let [first, second] = headings(task);
    let pose = task.asked_pose;
    let [one, two] = pose.joints_deg;
    format!("{first},{second},temperature,second\n{one},{two},{},0\n", pose.temperature)
}

fn study(task: &Task) -> String {
    let [first, second] = task.instrument.joints();
    let [first_heading, second_heading] = headings(task);
    format!(
        "chain      = \"instrument.chain\"
observable = \"{OBSERVABLE}\"
data       = \"{DATA}\"

[columns]
{first} = {{ column = \"{first_heading}\", unit = \"deg\" }}
{second} = {{ column = \"{second_heading}\", unit = \"deg\" }}
second = {{ derive = \"is(set_up, 2)\" }}

[observed]
kind = \"{KIND}\"
x = \"x\"
y = \"y\"
z = \"z\"

[search]
inputs = [\"temperature\", \"second\"]
"
    )
}

fn answer(task: &Task, mark: &str) -> String {
    format!(
        "# Whose sheet this answers. Leave it as it is.
mark = \"{mark}\"

# One entry for each thing that is missing, by the words of the sheet.
# Where the data cannot choose, write both: \"wobble or temperature\".
causes = []

# How the columns must be read, by the words of the sheet.
reading = \"as_labelled\"

# The number of the sentence that is right.
sentence = 0

# Three numbers in seconds of arc, each with its standard uncertainty. Remove the first # and write yours.
# size       = {{ value = 0.0, uncertainty = 0.0 }}
# error      = {{ value = 0.0, uncertainty = 0.0 }}    # {}
# prediction = {{ value = 0.0, uncertainty = 0.0 }}
",
        task.asked_error
    )
}

/// What a level says beforehand of the secret.
fn promise(level: Level) -> &'static str {
    match u8::from(level) {
        1 => "It does one thing that its declaration lacks.",
        2 => "It does two things that its declaration lacks.",
        3 => "It does three things that its declaration lacks. The data do not decide every cause.",
        _ => {
            "It does one thing that its declaration lacks. Beside that, a column is not what its heading says, or the two \
             set-ups differ."
        }
    }
}

/// What is to be done about columns and set-ups, where a level promises that.
fn disturbed(level: Level) -> &'static str {
    if level.difficulty().is_disturbed {
        "\n   If the report proposes another reading of a column, compare it with the readings below, change `study.toml` and fit \
         again. If the set-ups differ, say so in the declaration. `Rx(e*second)` is an error `e` of the second set-up alone. Declare \
         it before you decide what else is missing."
    } else {
        ""
    }
}

fn sheet(task: &Task, name: &str, mark: &str) -> String {
    let [first, second] = task.instrument.joints();
    let [one, two] = task.asked_pose.joints_deg;
    let list = |lines: Vec<String>| lines.iter().map(|own| format!("{own}\n")).collect::<String>();
    let causes =
        list(Cause::ALL.iter().map(|cause| format!("- `{}`: {}", cause.word(), cause.words())).collect());
    let readings = Reading::ALL.iter();
    let readings =
        list(readings.map(|own| format!("- `{}`: {}", own.word(), own.words(&task.instrument))).collect());
    let sentences = list((1..).zip(SENTENCES).map(|(number, own)| format!("{number}. {own}")).collect());
    format!(
        "# An instrument with a secret

For {name}. Mark of this sheet: `{mark}`. Level {level}.

{words} {promise}

`instrument.chain` declares its errors, each below {declared:.0}″. `{DATA}` has {rows} rows, with a noise of about {noise:.0}″ in \
each of two directions. The first axis is the one that `{first}` turns. The second is the one that `{second}` turns. In the middle of \
the rows the instrument was set up anew; `set_up` says in which set-up a row was measured. In the declaration `second` is 1 in the \
second set-up and 0 in the first.

## What to do

1. Fit and look: `trueaxis calibrate study.toml --out result`, then open `result/report.html`.{disturbed}
2. Decide what is missing. The report names causes that are not on this sheet, too. Leave those out. To test a cause of this sheet, write \
its factor into the declaration and fit. The data exclude it if its residual (RMS, fitted data) is more than 2 % larger than the \
smallest.
3. Write what is missing into a copy of the declaration, `{AMENDED}`. `result/{AMENDED}` is a copy with what the program found.
4. Fit your copy. Write `chain = \"{AMENDED}\"` into `study.toml`, and calibrate again with `--out final`.
5. Answer in `{ANSWER}`, and hand in both files in this folder.

## What to answer

**`causes`**: what is missing, by these words.

{causes}
**`reading`**: how the columns must be read. Where two readings fit, the right one needs no error of {declared:.0}″ or more.

{readings}
**`size`**: the size of the largest effect that follows `{first}` or `{second}`. It is half the difference between the largest and the \
smallest amount of its factor over your rows. For `a*cos({first}) + b*sin({first})` over a full turn that is √(a² + b²). Over less than a turn, let a spreadsheet find both amounts. \
If the size is u·a + v·b with numbers u and v, its variance is u² var(a) + v² var(b) + 2uv cov(a, b). `final/instrument.toml` has the \
covariance in rad².

**`error`**: the value of `{asked}`.

**`prediction`**: z of the error of the pointing at `{first}` = {one}°, `{second}` = {two}°, at 15 °C in the first set-up. \
`trueaxis eval final/{AMENDED} --errors final/errors.toml --data pose.csv --out -` computes it in rad. One rad is 206 265″. \
`trueaxis apply final/instrument.toml --data pose.csv --uncertainty --out -` computes its ± as `z_uncertainty`.

**`sentence`**: the number of the one sentence that is right.

{sentences}
Every number has the unit ″. Each ± is one standard uncertainty. A ± that is far too wide or too small costs points.
",
        name = markdown(&line(name)),
        level = u8::from(task.level),
        words = task.instrument.words,
        promise = promise(task.level),
        disturbed = disturbed(task.level),
        declared = DECLARED_ARCSEC,
        rows = task.rows.len(),
        noise = task.level.difficulty().noise_arcsec,
        asked = task.asked_error,
    )
}
