//! Correlated noise: a row remembers the one before, or rows of a group share an offset.

use crate::noise::serial::Memory;
use crate::noise::{Noise, Offsets};

/// What rows share that the fit took for independent.
pub(super) enum Shared {
    /// Nothing was found.
    Nothing,
    /// A memory of the row before, in some order.
    Memory(Memory, Order),
    /// An offset of their group, and the standard deviation of the rows' own noise in units of what the fit assumed.
    Offsets(Offsets, f64),
}

/// The order in which rows remember.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Order {
    /// The declared order of acquisition.
    Declared,
    /// That of the file, which nobody declared.
    OfFile,
    /// The same, of data that cannot tell memory from an effect that the chain lacks.
    Doubtful,
}

impl Shared {
    /// The noise of a fit with what rows share in it.
    pub fn in_noise(self, mut noise: Noise) -> Noise {
        let own = match &self {
            Self::Nothing => return noise,
            Self::Memory(_, Order::Doubtful) => {
                noise.undeclared_order = true;
                return noise;
            }
            Self::Memory(memory, _) => memory.innovation,
            Self::Offsets(_, own) => *own,
        };
        noise.sigma.iter_mut().for_each(|sigma| *sigma *= own);
        match self {
            Self::Nothing => {}
            Self::Memory(memory, order) => {
                noise.floor.iter_mut().for_each(|floor| *floor *= own * memory.serial.gain());
                (noise.serial, noise.in_space) = (Some(memory.serial), memory.in_space);
                noise.undeclared_order = order == Order::OfFile;
            }
            Self::Offsets(offsets, _) => {
                noise.floor.iter_mut().for_each(|floor| *floor *= own);
                noise.offsets = Some(offsets);
            }
        }
        noise
    }
}
