//! What chance a student gets: a hash of the teacher's seed and the name, so that nobody who lacks the seed can draw it again.

use rand::SeedableRng as _;
use rand_chacha::ChaCha8Rng;
use tables::formats::sha256;

/// The chance of one student.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Seed(String);

/// What random numbers are for: each purpose has a stream of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// Poses of the data.
    Poses,
    /// What the instrument does.
    Secret,
    /// Noise of the data.
    Noise,
    /// Poses that only the teacher has.
    Unseen,
}

impl Seed {
    /// The chance of the student of a name, the `again`th of that name from zero, at a level.
    #[must_use]
    pub fn new(teacher: &str, name: &str, again: usize, level: u8) -> Self {
        // Lengths keep the parts apart: no two different inputs give one text.
        Self(digest(&format!(
            "class 1\n{}:{teacher}\n{}:{name}\n{again}\n{level}",
            teacher.len(),
            name.len()
        )))
    }

    /// The mark of a sheet: ten letters that say whose it is and nothing else.
    #[must_use]
    pub fn mark(&self) -> String {
        let digest = digest(&format!("mark\n{}", self.0));
        format!("{}-{}", &digest[..5], &digest[5..10])
    }

    /// Random numbers for a purpose.
    #[must_use]
    pub fn random(&self, purpose: Purpose) -> ChaCha8Rng {
        let mut bytes = [0; 32];
        for (byte, pair) in bytes.iter_mut().zip(self.0.as_bytes().chunks(2)) {
            let digit = |&digit: &u8| (digit as char).to_digit(16).unwrap_or_default() as u8;
            *byte = pair.iter().map(digit).fold(0, |byte, digit| 16 * byte + digit);
        }
        let mut random = ChaCha8Rng::from_seed(bytes);
        random.set_stream(purpose as u64);
        random
    }
}

/// The SHA-256 of a text, 64 hexadecimal digits.
#[must_use]
pub fn digest(text: &str) -> String {
    sha256::hex(text.as_bytes()).unwrap_or_else(|_| unreachable!("a text in memory can be read"))
}
