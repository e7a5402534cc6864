//! Who competes again where a contest is repeated on some of its rows.

use crate::bench::State;
use crate::families::{Class, Driver, Family, Law, Where};
use crate::likelihood::Active;
use crate::outcome::Outcome;
use crate::places::Places;

/// The families that gain something in a contest: beside nothing, beside the explanation that is told, or in the place of one of its
/// causes. A family that gains nothing of all rows wins on few of their parts, and most of a contest's time goes to such families.
#[derive(Debug, Clone, PartialEq)]
pub struct Contenders {
    families: Vec<(Class, Site, Driver, Law)>,
}

/// Where a family acts, by numbers of the problem: those of distinct places hang on the rows.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Site {
    Place(usize),
    Tilts(usize),
}

impl Site {
    fn of(family: &Family, places: &Places) -> Self {
        match family.place {
            Where::Place(place) => Self::Place(places.distinct[place].place),
            Where::Tilts(frame) => Self::Tilts(frame),
        }
    }
}

impl Contenders {
    /// Whether a family competes. What belongs to the noise always does.
    #[must_use]
    pub fn has(&self, family: &Family, places: &Places) -> bool {
        let key = || (family.class, Site::of(family, places), family.driver, family.law);
        family.is_noise() || self.families.contains(&key())
    }
}

impl Outcome<'_> {
    /// Who competes where the contest is repeated.
    #[must_use]
    pub fn contenders(&self) -> Contenders {
        let (bench, told) = (self.bench(), self.told());
        let mut states = vec![(Active::new(), State { memory: None, ..told.state })];
        states.push((told.active.clone(), told.state));
        for cause in bench.causes(&told.active) {
            let others = told.active.iter().copied().filter(|&(family, _)| family != cause).collect();
            states.push((others, told.state));
        }
        let mut most = vec![f64::NEG_INFINITY; bench.dictionary.families.len()];
        for (active, state) in states {
            let gains = bench.view(state).scan(&active, &|_| true);
            for (most, gain) in most.iter_mut().zip(gains) {
                *most = most.max(gain.nats);
            }
        }
        let families = bench.dictionary.families.iter().zip(most).enumerate();
        let competes = families.filter(|(at, (_, most))| *most >= bench.policy.repeated || told.has(*at));
        let key =
            |family: &Family| (family.class, Site::of(family, &bench.places), family.driver, family.law);
        Contenders { families: competes.map(|(_, (family, _))| key(family)).collect() }
    }
}
