//! What a study says of effects: its own ones, which of the catalogue's may be found, and what they may follow.

use model_core::{BodyId, Chain, ObservableId, Role, SymbolId, SymbolKind};
use toml::Spanned;

use super::StudyError;
use super::plan::Search;
use super::written::{OwnEffect, Study};
use crate::candidate::{Effect, Freedom, Place, Setting};
use crate::catalogue::{catalogue, chosen};
use crate::effects::own;

/// The parts of a body that an effect can be in.
const PARTS: [(&str, Role); 2] =
    [("motion_error", Role::MotionError), ("position_error", Role::PositionError)];

impl Study {
    /// Lines a turn of encoders.
    pub(super) fn lines(&self, chain: &Chain) -> Result<Vec<(SymbolId, u32)>, StudyError> {
        let joints = || chain.symbols_of(SymbolKind::Joint);
        let line = |(name, lines): (&Spanned<String>, &Spanned<u32>)| {
            let id = joints().find(|&id| chain.symbol(id).name == *name.get_ref()).ok_or_else(|| {
                let names: Vec<&str> = joints().map(|id| chain.symbol(id).name.as_str()).collect();
                StudyError::unknown(name.span(), "joint", name.get_ref(), names.iter().copied())
            })?;
            if *lines.get_ref() == 0 {
                return Err(StudyError::new(
                    lines.span(),
                    "an encoder has lines",
                    "write how many a turn has",
                ));
            }
            Ok((id, *lines.get_ref()))
        };
        self.search.lines.iter().map(line).collect()
    }

    /// The study's own effects.
    pub(super) fn own_effects(&self, chain: &Chain) -> Result<Vec<Effect>, StudyError> {
        self.effect.iter().map(|written| own_effect(chain, written)).collect()
    }

    /// Holds the names of effects that may be found to the catalogue of this chain.
    pub(super) fn check_names(
        &self,
        chain: &Chain,
        observables: &[ObservableId],
        search: &Search,
    ) -> Result<(), StudyError> {
        let setting = search.setting(chain, observables);
        let Err((number, near)) = chosen(&setting, catalogue(&setting), &search.only) else { return Ok(()) };
        let Some(name) = self.search.effects.get(number) else { return Ok(()) };
        let message = format!("no effect of this chain is called `{}`", name.get_ref());
        let help = near.map_or_else(
            || "write the name of an effect, of its family, or of a term of another field".to_owned(),
            |near| format!("did you mean `{near}`?"),
        );
        Err(StudyError::new(name.span(), message, help))
    }
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

fn own_effect(chain: &Chain, written: &OwnEffect) -> Result<Effect, StudyError> {
    let bodies = || chain.bodies.iter().map(|body| body.name.as_str());
    let body = (0_u16..).zip(bodies()).find(|(_, name)| *name == written.body.get_ref());
    let (body, _) = body
        .ok_or_else(|| StudyError::unknown(written.body.span(), "body", written.body.get_ref(), bodies()))?;
    let role = match &written.part {
        None => Role::MotionError,
        Some(part) => {
            let known = PARTS.iter().find(|(word, _)| *word == part.get_ref());
            let (_, role) = known.ok_or_else(|| {
                StudyError::unknown(
                    part.span(),
                    "part of a body",
                    part.get_ref(),
                    PARTS.iter().map(|(word, _)| *word),
                )
            })?;
            *role
        }
    };
    let words = || Freedom::ALL.iter().map(|freedom| freedom.word());
    let freedom = Freedom::ALL
        .into_iter()
        .find(|freedom| freedom.word() == written.moves.get_ref())
        .ok_or_else(|| {
            StudyError::unknown(written.moves.span(), "degree of freedom", written.moves.get_ref(), words())
        })?;
    if written.functions.get_ref().is_empty() {
        let help = "write functions = [\"cos(3*beta)\", \"sin(3*beta)\"]";
        return Err(StudyError::new(written.functions.span(), "an effect has one function at least", help));
    }
    let texts: Vec<&str> = written.functions.get_ref().iter().map(|text| text.get_ref().as_str()).collect();
    let place = Place { body: BodyId(body), role, freedom };
    own(chain, written.name.get_ref(), place, &texts).map_err(|error| {
        // The text starts after its quote.
        let whole = written.functions.get_ref().get(error.function).map_or(0..0, Spanned::span);
        let start = whole.start + 1 + error.place.start;
        let end = (whole.start + 1 + error.place.end).min(whole.end);
        StudyError::new(start.min(end)..end, error.message, error.help)
    })
}
