//! Sines and cosines of the vector kernel as raw f64s, for `benches/accuracy/measure.py`.
//!
//! Usage: `sine_points PATH COUNT SEED RANGE` with the path `portable`, `v3` or `v4` and the range `narrow` (uniform in
//! |x| ≤ 1e6), `small` (uniform in |x| ≤ 10), `edges` (the f64s nearest to each multiple of π/2) or `wide` (any f64).
//! Writes x, sin x, cos x of each point, little-endian.

use std::io::{BufWriter, Error, ErrorKind, Write, stdout};

use codegen::vector::{Arithmetic, Path, ROWS, Waves, Work, path, run, sin_cos_rows};

struct Block<'a> {
    x: &'a [f64; ROWS],
    sine: &'a mut [f64; ROWS],
    cosine: &'a mut [f64; ROWS],
}

impl Work for Block<'_> {
    #[inline(always)]
    fn run<A: Arithmetic>(self, arithmetic: A) {
        let mut waves = Waves::NEW;
        let (sine, cosine) = sin_cos_rows(arithmetic, self.x, &mut waves);
        (*self.sine, *self.cosine) = (*sine, *cosine);
    }
}

/// SplitMix64. Source: Steele, Lea, Flood, OOPSLA 2014.
fn next(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (*state ^ (*state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

fn point(range: &str, index: u64, state: &mut u64) -> Option<f64> {
    let unit = |word: u64| (word >> 11) as f64 / (1u64 << 52) as f64 - 1.0;
    match range {
        "narrow" => Some(1e6 * unit(next(state))),
        "small" => Some(10.0 * unit(next(state))),
        "edges" => {
            let edge = (index / 3 % 636_619 + 1) as f64 * std::f64::consts::FRAC_PI_2;
            Some([edge.next_down(), edge, edge.next_up()][(index % 3) as usize])
        }
        "wide" => Some(f64::from_bits(next(state))),
        _ => None,
    }
}

fn main() -> Result<(), Error> {
    let usage = || Error::new(ErrorKind::InvalidInput, "usage: sine_points portable|v3|v4 COUNT SEED RANGE");
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [wanted, count, seed, range] = arguments.as_slice() else { return Err(usage()) };
    let wanted = match wanted.as_str() {
        "portable" => Path::Portable,
        "v3" => Path::V3,
        "v4" => Path::V4,
        _ => return Err(usage()),
    };
    if wanted > path() {
        return Err(Error::new(ErrorKind::Unsupported, "this processor does not have that path"));
    }
    let count: u64 = count.parse().map_err(|_| usage())?;
    let mut state: u64 = seed.parse().map_err(|_| usage())?;
    let mut out = BufWriter::new(stdout().lock());
    let mut index = 0;
    while index < count {
        let mut x = [0.0; ROWS];
        for x in &mut x {
            *x = point(range, index, &mut state).ok_or_else(usage)?;
            index += 1;
        }
        let (mut sine, mut cosine) = ([0.0; ROWS], [0.0; ROWS]);
        run(wanted, Block { x: &x, sine: &mut sine, cosine: &mut cosine });
        for ((x, sine), cosine) in x.iter().zip(&sine).zip(&cosine) {
            for value in [x, sine, cosine] {
                out.write_all(&value.to_le_bytes())?;
            }
        }
    }
    out.flush()
}
