//! How inputs are spoiled: what is right stays mostly right, so that the changes reach deep.

use rand::RngExt as _;
use rand_chacha::ChaCha8Rng;

use crate::intruders::INTRUDERS;

/// Changes of one input at most.
const CHANGES: usize = 6;
/// An input never grows beyond this, in bytes.
const LONGEST: usize = 1 << 16;

/// Numbers that stand in a digit's place.
const NUMBERS: [&str; 8] =
    ["0", "-0", "1e9", "1e308", "4294967296", "0.1", "00", "999999999999999999999999999999999999999"];

/// An input of the corpus, changed in a few places, or two of them joined.
pub fn changed(corpus: &[Vec<u8>], chance: &mut ChaCha8Rng) -> Vec<u8> {
    let pick = |chance: &mut ChaCha8Rng| corpus[chance.random_range(0..corpus.len())].clone();
    let mut input = pick(chance);
    for _ in 0..chance.random_range(1..=CHANGES) {
        let at = chance.random_range(0..=input.len());
        let end = (at + chance.random_range(0..=40)).min(input.len());
        match chance.random_range(0..10) {
            0..=2 => {
                let intruder = INTRUDERS[chance.random_range(0..INTRUDERS.len())];
                input.splice(at..at, intruder.bytes());
            }
            3 | 4 => drop(input.drain(at..end)),
            5 => {
                let part = input[at..end].to_vec();
                let times = 1 << chance.random_range(0..8);
                let repeated = part.iter().copied().cycle().take(part.len() * times).collect::<Vec<_>>();
                input.splice(at..at, repeated);
            }
            6 => {
                if let Some(byte) = input.get_mut(at) {
                    *byte ^= 1 << chance.random_range(0..8);
                }
            }
            7 => {
                let other = pick(chance);
                let from = chance.random_range(0..=other.len());
                input.truncate(at);
                input.extend(&other[from..]);
            }
            8 => {
                // Another number where one stands.
                let digits = input.iter().skip(at).position(u8::is_ascii_digit).map(|further| at + further);
                if let Some(digit) = digits {
                    let number = NUMBERS[chance.random_range(0..NUMBERS.len())];
                    input.splice(digit..=digit, number.bytes());
                }
            }
            _ => input.truncate(at),
        }
        input.truncate(LONGEST);
    }
    input
}
