//! What a study says of effects: its own ones, which of the catalogue's may be found, and what they may follow.

use model_core::escape::is_unseen;
use model_core::{BodyId, Chain, ObservableId, Role, SymbolId, SymbolKind};
use toml::Spanned;

use super::mistakes::{Gathered, Outcome, every, mistake, plain, unknown, within};
use super::plan::Search;
use super::written::{OwnEffect, Study};
use effects::candidate::{Effect, Freedom, Place, Setting};
use effects::catalogue::{catalogue, chosen};
use effects::families::own;

/// The parts of a body that an effect can be in.
const PARTS: [(&str, Role); 2] =
    [("motion_error", Role::MotionError), ("position_error", Role::PositionError)];

/// Harmonics of an encoder that are looked for at most.
const MOST_HARMONICS: u64 = 400;
/// Lines that an encoder has at most.
const MOST_LINES: u64 = 10_000_000;
/// Functions that one effect of a study has at most.
const MOST_FUNCTIONS: usize = 100;
/// Letters of an effect's name at most.
const LONGEST_NAME: usize = 200;

impl Study {
    /// What the search is asked for; `observables` only if all of them could be read.
    pub(super) fn search(&self, chain: &Chain, observables: Option<&[ObservableId]>) -> Outcome<Search> {
        let mut mistakes = Gathered::default();
        let false_alarm = *self.search.false_alarm.get_ref();
        if !(false_alarm > 0.0 && false_alarm < 1.0) {
            let place = self.search.false_alarm.span();
            let message = "a share of false alarms lies between 0 and 1";
            mistakes.take::<()>(Err(mistake(place, message, "write 0.05")));
        }
        let mut inputs: Vec<SymbolId> =
            self.search.inputs.iter().filter_map(|name| chain.find_symbol(name.get_ref())).collect();
        inputs.extend(self.implied(chain).iter().filter_map(|(name, _)| chain.find_symbol(name)));
        let harmonics = &self.search.harmonics;
        mistakes.take(within(harmonics.span(), "harmonics", *harmonics.get_ref(), 0..=MOST_HARMONICS));
        let most = &self.search.most;
        mistakes.take(within(most.span(), "most", *most.get_ref(), 1..=1000));
        let lines =
            mistakes.take(every(self.search.lines.iter().map(|(name, lines)| encoder(chain, name, lines))));
        let own = mistakes.take(every(self.effect.iter().map(|written| own_effect(chain, written))));
        mistakes.none()?;
        let (Some(lines), Some(own)) = (lines, own) else {
            unreachable!("what is missing comes with a mistake")
        };
        let only = self.search.effects.iter().map(|name| name.get_ref().clone()).collect();
        let harmonics = *harmonics.get_ref() as u32;
        let most = usize::try_from(*most.get_ref()).unwrap_or(usize::MAX);
        let (functions, sequence) = (self.search.functions, self.search.sequence);
        let search = Search { false_alarm, most, functions, inputs, sequence, harmonics, lines, own, only };
        if let Some(observables) = observables {
            self.check_names(chain, observables, &search)?;
        }
        Ok(search)
    }

    /// Holds the names of effects that may be found to the catalogue of this chain.
    fn check_names(&self, chain: &Chain, observables: &[ObservableId], search: &Search) -> Outcome<()> {
        let setting = search.setting(chain, observables);
        let Err((number, near)) = chosen(&setting, catalogue(&setting), &search.only) else { return Ok(()) };
        let Some(name) = self.search.effects.get(number) else { unreachable!("what is refused was written") };
        let message = format!("no effect of this chain is called `{}`", name.get_ref());
        let help = near.map_or_else(
            || "write the name of an effect, of its family, or of a term of another field".to_owned(),
            |near| format!("did you mean `{near}`?"),
        );
        Err(mistake(name.span(), message, help))
    }
}

/// Lines a turn of an encoder.
fn encoder(chain: &Chain, name: &Spanned<String>, lines: &Spanned<u64>) -> Outcome<(SymbolId, u32)> {
    let joints = || chain.symbols_of(SymbolKind::Joint);
    let id = joints().find(|&id| chain.symbol(id).name == *name.get_ref()).ok_or_else(|| {
        let names: Vec<&str> = joints().map(|id| chain.symbol(id).name.as_str()).collect();
        unknown(name.span(), "joint", name.get_ref(), names.iter().copied())
    })?;
    within(lines.span(), "lines of an encoder", *lines.get_ref(), 1..=MOST_LINES)?;
    Ok((id, *lines.get_ref() as u32))
}

impl Search {
    /// What the catalogue is made for.
    #[must_use]
    pub fn setting<'a>(&'a self, chain: &'a Chain, observables: &'a [ObservableId]) -> Setting<'a> {
        Setting {
            chain,
            observables,
            inputs: &self.inputs,
            harmonics: self.harmonics,
            lines: &self.lines,
            own: &self.own,
        }
    }
}

fn own_effect(chain: &Chain, written: &OwnEffect) -> Outcome<Effect> {
    let name = written.name.get_ref();
    let prints = !name.trim().is_empty() && name.chars().count() <= LONGEST_NAME && !name.contains(is_unseen);
    if !prints {
        let message = "the name of an effect is a few words on one line";
        return Err(mistake(written.name.span(), message, "write name = \"ball screw of elevation\""));
    }
    let bodies = || chain.bodies.iter().map(|body| body.name.as_str());
    let body = (0_u16..).zip(bodies()).find(|(_, name)| *name == written.body.get_ref());
    let (body, _) =
        body.ok_or_else(|| unknown(written.body.span(), "body", written.body.get_ref(), bodies()))?;
    let role = match &written.part {
        None => Role::MotionError,
        Some(part) => {
            let known = PARTS.iter().find(|(word, _)| *word == part.get_ref());
            let (_, role) = known.ok_or_else(|| {
                unknown(part.span(), "part of a body", part.get_ref(), PARTS.iter().map(|(word, _)| *word))
            })?;
            *role
        }
    };
    let words = || Freedom::ALL.iter().map(|freedom| freedom.word());
    let freedom =
        Freedom::ALL.into_iter().find(|freedom| freedom.word() == written.moves.get_ref()).ok_or_else(
            || unknown(written.moves.span(), "degree of freedom", written.moves.get_ref(), words()),
        )?;
    if written.functions.get_ref().is_empty() {
        let help = "write functions = [\"cos(3*beta)\", \"sin(3*beta)\"]";
        return Err(mistake(written.functions.span(), "an effect has one function at least", help));
    }
    if written.functions.get_ref().len() > MOST_FUNCTIONS {
        let message = format!("an effect has at most {MOST_FUNCTIONS} functions");
        return Err(plain(written.functions.span(), message));
    }
    let texts: Vec<&str> = written.functions.get_ref().iter().map(|text| text.get_ref().as_str()).collect();
    let place = Place { body: BodyId(body), role, freedom };
    own(chain, written.name.get_ref(), place, &texts).map_err(|error| {
        // The text starts after its quote.
        let whole = written.functions.get_ref().get(error.function).map_or(0..0, Spanned::span);
        let start = whole.start + 1 + error.place.start;
        let end = (whole.start + 1 + error.place.end).min(whole.end);
        mistake(start.min(end)..end, error.message, error.help)
    })
}
