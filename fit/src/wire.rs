//! Passes and tallies as bytes, for several processes that accumulate one fit: the same bytes on every machine.
//!
//! Eight letters that say what they are and of which version, then whole numbers and f64, all with the lowest byte first.

use model_core::Chain;

use super::partial::{Partial, PartialError};
use super::stream::{Pass, streamed};
use super::sweep::{Tally, Weighting};
use super::{FitError, FitOptions, Model};
use observe::Observations;

/// What the bytes begin with; its end is the version of what follows.
const MAGIC: &[u8; 8] = b"TXTALLY1";

/// Letters of the magic that no version changes.
const NAME: usize = 7;

/// Parameters that bytes may speak of: beyond any chain, and a triangle of them is still counted without overflow.
const MOST: u64 = 1 << 20;

impl Tally {
    /// The tally as bytes.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let counts = [
            self.pass,
            self.partial.parameters as u64,
            self.kinds.len() as u64,
            self.rows,
            self.kept,
            self.partial.components,
        ];
        let sums = [self.objective, self.weighted_squares, self.weights, self.slopes, self.squares];
        let numbers = self.partial.packed().iter().chain(self.kinds.as_flattened()).chain(&sums);
        let mut bytes = MAGIC.to_vec();
        bytes.extend(counts.iter().flat_map(|count| count.to_le_bytes()));
        bytes.extend(numbers.flat_map(|number| number.to_le_bytes()));
        bytes
    }

    /// The tally that [`Tally::to_bytes`] wrote.
    ///
    /// # Errors
    /// The bytes are something else, of another version, cut off, or hold what is no number.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, PartialError> {
        let (magic, rest) = bytes.split_at_checked(MAGIC.len()).ok_or(PartialError::NotPartial)?;
        if magic[..NAME] != MAGIC[..NAME] {
            return Err(PartialError::NotPartial);
        }
        if magic != MAGIC {
            return Err(PartialError::Version);
        }
        let (words, odd) = rest.as_chunks::<8>();
        let Some((&[pass, parameters, kinds, rows, kept, components], words)) =
            words.split_first_chunk::<6>()
        else {
            return Err(PartialError::Length { expected: MAGIC.len() + 6 * 8, found: bytes.len() });
        };
        let [parameters, kinds] = [parameters, kinds].map(u64::from_le_bytes);
        if parameters > MOST || kinds > MOST {
            return Err(PartialError::NotPartial);
        }
        let (side, kinds) = (parameters as usize + 1, kinds as usize);
        let packed = side * (side + 1) / 2;
        let expected = packed + 2 * kinds + 5;
        if words.len() != expected || !odd.is_empty() {
            let expected = MAGIC.len() + (6 + expected) * 8;
            return Err(PartialError::Length { expected, found: bytes.len() });
        }
        let numbers: Vec<f64> = words.iter().map(|&word| f64::from_le_bytes(word)).collect();
        if !numbers.iter().all(|number| number.is_finite()) {
            return Err(PartialError::NotFinite);
        }
        let (packed, rest) = numbers.split_at(packed);
        let (kinds, sums) = rest.split_at(2 * kinds);
        let &[objective, weighted_squares, weights, slopes, squares] = sums else {
            unreachable!("the length was checked: five sums are left")
        };
        Ok(Self {
            pass: u64::from_le_bytes(pass),
            rows: u64::from_le_bytes(rows),
            kept: u64::from_le_bytes(kept),
            partial: Partial::of_packed(side - 1, u64::from_le_bytes(components), packed.to_vec()),
            kinds: kinds.as_chunks::<2>().0.to_vec(),
            objective,
            weighted_squares,
            weights,
            slopes,
            squares,
        })
    }
}

/// What the bytes of a pass begin with; its end is the version of what follows.
const PASS: &[u8; 8] = b"TXPASS01";

/// Why bytes are no pass over some rows.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum PassError {
    /// Bytes that are something else, or of another version.
    #[error("these bytes are no pass of a fit as this version writes them: run the same version everywhere")]
    NotPass,
    /// A pass over other symbols.
    #[error(
        "the pass is of a chain of {found} symbols, this one has {expected}: give every process the same declaration"
    )]
    OtherChain {
        /// Symbols of the chain.
        expected: usize,
        /// Values in the pass.
        found: usize,
    },
    /// The rows do not fit the chain.
    #[error(transparent)]
    Fit(#[from] FitError),
}

impl Pass {
    /// What a process that has the declaration and the study needs to make this pass.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let counts = [self.weighting as u64, self.values.len() as u64];
        let mut bytes = PASS.to_vec();
        bytes.extend(counts.iter().flat_map(|count| count.to_le_bytes()));
        bytes.extend(self.values.iter().chain(&self.floor).flat_map(|number| number.to_le_bytes()));
        bytes
    }

    /// The pass that [`Pass::to_bytes`] wrote, over rows with the series of these.
    ///
    /// # Errors
    /// The bytes are something else, or of another chain; or the rows do not fit the chain.
    pub fn from_bytes(
        bytes: &[u8],
        chain: &Chain,
        rows: &Observations,
        options: &FitOptions,
    ) -> Result<Self, PassError> {
        let numbers = bytes.strip_prefix(PASS).ok_or(PassError::NotPass)?;
        let (words, []) = numbers.as_chunks::<8>() else { return Err(PassError::NotPass) };
        let Some((&[weighting, values], words)) = words.split_first_chunk::<2>() else {
            return Err(PassError::NotPass);
        };
        let weighting = [Weighting::Full, Weighting::Huber, Weighting::Biweight]
            .into_iter()
            .find(|known| *known as u64 == u64::from_le_bytes(weighting))
            .ok_or(PassError::NotPass)?;
        let numbers: Vec<f64> = words.iter().map(|&word| f64::from_le_bytes(word)).collect();
        let count = usize::try_from(u64::from_le_bytes(values)).map_err(|_| PassError::NotPass)?;
        let (values, floor) = numbers.split_at_checked(count).ok_or(PassError::NotPass)?;
        let expected = chain.symbols.len();
        if values.len() != expected {
            return Err(PassError::OtherChain { expected, found: values.len() });
        }
        if !numbers.iter().all(|number| number.is_finite()) || !floor.iter().all(|floor| *floor > 0.0) {
            return Err(PassError::NotPass);
        }
        let model = Model::new(chain, &rows.poses, &options.estimate)?;
        let noise = streamed(&options.noise);
        Ok(Self { model, values: values.to_vec(), floor: floor.to_vec(), noise, weighting })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tally() -> Tally {
        let partial = Partial::of_packed(1, 7, vec![1.0, -2.5, 1e-300]);
        Tally {
            pass: 9,
            rows: 5,
            kept: 4,
            kinds: vec![[1.5, 2.0]],
            objective: 0.25,
            partial,
            ..Tally::new(1, 1)
        }
    }

    #[test]
    fn bytes_are_what_they_were() {
        let bytes = tally().to_bytes();
        assert_eq!(Tally::from_bytes(&bytes), Ok(tally()));
        // The promise: of this version, these bytes and no others.
        assert_eq!(bytes.len(), 8 + 6 * 8 + (3 + 2 + 5) * 8);
        assert_eq!(&bytes[..24], b"TXTALLY1\x09\0\0\0\0\0\0\0\x01\0\0\0\0\0\0\0");
        assert_eq!(bytes[56..64], 1.0_f64.to_le_bytes());
    }

    #[test]
    fn spoiled_bytes_are_refused() {
        let bytes = tally().to_bytes();
        for end in 0..bytes.len() {
            assert!(Tally::from_bytes(&bytes[..end]).is_err(), "{end}");
        }
        let spoiled = |at: usize, with: u8| {
            let mut bytes = bytes.clone();
            bytes[at] = with;
            Tally::from_bytes(&bytes)
        };
        assert_eq!(spoiled(0, b'U'), Err(PartialError::NotPartial));
        assert_eq!(spoiled(7, b'2'), Err(PartialError::Version));
        assert_eq!(spoiled(16, 2), Err(PartialError::Length { expected: 160, found: 136 }));
        assert_eq!(spoiled(23, 255), Err(PartialError::NotPartial));
        assert_eq!(spoiled(63, 0x7f), Err(PartialError::NotFinite));
        let longer = [bytes.as_slice(), &[0]].concat();
        assert_eq!(Tally::from_bytes(&longer), Err(PartialError::Length { expected: 136, found: 137 }));
    }

    #[test]
    fn what_does_not_belong_together_is_not_merged() {
        let merged = |other: Tally| tally().merge(&other).map(|_| ());
        assert_eq!(merged(tally()), Ok(()));
        assert_eq!(merged(Tally { pass: 8, ..tally() }), Err(PartialError::Passes));
        assert_eq!(
            merged(Tally { pass: 9, ..Tally::new(2, 1) }),
            Err(PartialError::Columns { one: 1, other: 2 })
        );
        assert_eq!(
            merged(Tally { pass: 9, ..Tally::new(1, 3) }),
            Err(PartialError::Kinds { one: 1, other: 3 })
        );
    }
}
