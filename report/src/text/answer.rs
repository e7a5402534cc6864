//! The answer, on one screen; and in full what it had no room for.

use std::fmt::Write as _;

use crate::style::{BAD, CAREFUL, GOOD, HEADING};
use crate::words::{self, Answers, Step, Tone, sentence_case};
use crate::wrap::paragraph;
use calibration::diagnose::Diagnosis;

use super::{LINES, Page};

/// Effects that the answer names.
const EFFECTS: usize = 3;
/// Effects and causes that it names together.
const NAMED: usize = 4;

impl Page {
    /// What a person acts on: a screen of 24 lines has room for it, and for the cautions that there mostly are none of.
    pub(super) fn answer(&mut self, answers: &Answers, diagnosis: &Diagnosis) {
        let style = match answers.tone {
            Tone::Good => GOOD,
            Tone::Ambiguous | Tone::Careful => CAREFUL,
            Tone::Bad => BAD,
        };
        self.styled(style, &answers.badge.to_uppercase());
        let _ = writeln!(self.text);
        self.say("", &answers.happened);
        if let Some(chance) = &answers.chance {
            self.say("", &format!("{}.", sentence_case(chance)));
        }
        if let Some(goal) = &answers.goal {
            self.say("", goal);
        }
        // What the verdict says already is no caution beside it.
        let cautions = diagnosis.cautions.iter().map(words::caution).filter(|own| *own != answers.happened);
        for caution in cautions {
            let mut told = String::new();
            paragraph(&mut told, "Caution: ", &caution, self.layout.width);
            self.styled(CAREFUL, "Caution");
            let _ = write!(self.text, "{}", told.strip_prefix("Caution").unwrap_or(&told));
        }
        self.wanted(diagnosis);
        self.what(answers);
        self.title("How much better");
        self.say("  ", &answers.better);
        self.title("What to do next");
        for (number, step) in (1..).zip(&answers.next) {
            if is_told_at_once(number, step) {
                self.step(number, step);
            } else {
                self.say(&format!("  {number}. "), &format!("{}.", step.title));
            }
        }
    }

    /// What it is, where, and why.
    fn what(&mut self, answers: &Answers) {
        if answers.what.is_empty() {
            return;
        }
        self.title("What it is");
        answers.what.iter().take(EFFECTS).for_each(|what| self.say("  ", what));
        if answers.what.len() > EFFECTS {
            self.say("  ", &format!("{} smaller effects follow below.", answers.what.len() - EFFECTS));
        }
        if let [place] = answers.places.as_slice() {
            self.say("  ", &format!("{}.", sentence_case(place)));
        }
        match answers.causes.as_slice() {
            [] => {}
            [one] => self.say("  ", &format!("Likely cause: {one}.")),
            causes if named(answers) == 0 => {
                self.say("  ", &format!("{} possible causes follow below.", causes.len()));
            }
            causes => {
                self.say("  ", "Possible causes, each to be checked:");
                self.causes(causes, named(answers));
            }
        }
    }

    fn causes(&mut self, causes: &[String], most: usize) {
        causes.iter().take(most).for_each(|cause| self.say("  - ", cause));
        if causes.len() > most {
            self.say("  - ", &format!("and {} more", causes.len() - most));
        }
    }

    fn step(&mut self, number: usize, step: &Step) {
        self.say(&format!("  {number}. "), &format!("{}. {}", step.title, step.text));
        for line in step.command.iter().flat_map(|command| command.lines()) {
            let _ = writeln!(self.text, "     {line}");
        }
    }

    /// What the answer had no room for: every effect, place and cause, and how to take each step.
    pub(super) fn in_full(&mut self, answers: &Answers) {
        if answers.what.len() > EFFECTS {
            self.list("Every effect", &answers.what);
        }
        if answers.places.len() > 1 {
            let places: Vec<String> =
                answers.places.iter().map(|place| format!("{}.", sentence_case(place))).collect();
            self.list("Where", &places);
        }
        if answers.causes.len() > named(answers) {
            self.heading("Every possible cause");
            let most = if self.layout.verbose { usize::MAX } else { 2 * LINES };
            self.causes(&answers.causes, most);
        }
        let steps = (1..).zip(&answers.next).filter(|(number, step)| !is_told_at_once(*number, step));
        let steps: Vec<(usize, &Step)> = steps.collect();
        if !steps.is_empty() {
            self.heading("How to do the other steps");
            steps.into_iter().for_each(|(number, step)| self.step(number, step));
        }
    }

    /// A heading within the answer.
    pub(super) fn title(&mut self, title: &str) {
        self.styled(HEADING, title);
        let _ = writeln!(self.text);
    }
}

/// How many causes the answer names: of more than two effects none, because a cause without its effect is no answer.
fn named(answers: &Answers) -> usize {
    match (answers.causes.len(), answers.what.len()) {
        (1, _) => 1,
        (_, effects) if effects >= EFFECTS => 0,
        (_, effects) => NAMED - effects.max(1),
    }
}

/// Whether the answer tells how to take a step: the first one, and what a command does.
fn is_told_at_once(number: usize, step: &Step) -> bool {
    number == 1 || step.command.as_ref().is_some_and(|command| command.starts_with("trueaxis "))
}
