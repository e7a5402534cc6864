//! How sharp bounds are: for the gallery and 200 random chains, the bound over the largest difference that a fixed search finds.
//!
//! `cargo run --release -p trueaxis-benches --bin bound_sharpness` from the root of the repository; `--list` prints every ratio.
//! The chains and their sizes follow from one seed; half of the joints have a range.
#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "a program of its own, run by hand")]

use std::fmt::Write;
use std::path::Path;

use claims::file::{File, declaration_of_dh};
use model_core::remainder::{Domain, bound, search};
use model_core::{Chain, ObservableId, SymbolKind};

const SEED: u64 = 20_261_127;
const CHAINS: u64 = 200;
/// Of each search, at least.
const EVALUATIONS: usize = 100_000;

/// SplitMix64.
struct Random(u64);

impl Random {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn below(&mut self, count: usize) -> usize {
        (self.uniform() * count as f64) as usize
    }

    fn pick<'a>(&mut self, from: &[&'a str]) -> &'a str {
        from[self.below(from.len())]
    }
}

/// A chain of two to six bodies, each with up to four errors, a joint and a constant transform.
fn random_chain(random: &mut Random) -> String {
    let mut text = String::from("chain Random {\n const k0: angle = 0.677; const k1: angle = 1.2;\n");
    let (bodies, mut errors) = (2 + random.below(5), 0);
    for body in 0..bodies {
        let lower = if body == 0 { "ground".to_owned() } else { format!("b{}", body - 1) };
        let _ = writeln!(text, " body b{body} on {lower} {{");
        if random.uniform() < 0.6 {
            let amount = random.pick(&["k0", "-k0", "2*k1", "pi/2", "k1"]);
            let _ = writeln!(text, "  position: R{}({amount});", random.pick(&["x", "y", "z"]));
        }
        if random.uniform() < 0.4 {
            let _ = writeln!(text, "  position: T{}(0.4);", random.pick(&["x", "y", "z"]));
        }
        for role in ["position_error", "motion", "motion_error"] {
            if role == "motion" {
                if random.uniform() < 0.8 {
                    let amount = random.pick(&["q", "-q", "2*q"]);
                    let _ = writeln!(text, "  motion: R{}({amount}{body});", random.pick(&["x", "y", "z"]));
                }
                continue;
            }
            for _ in 0..random.below(4) {
                let kind = random.pick(&["Rx", "Ry", "Rz", "Rx", "Ry", "Rz", "Tx", "Ty", "Tz"]);
                let factor = if random.uniform() < 0.15 { "*sin(k0)" } else { "" };
                let _ = writeln!(text, "  {role}: {kind}(e{errors}{factor});");
                errors += 1;
            }
        }
        text.push_str(" }\n");
    }
    let last = bodies - 1;
    let _ = writeln!(text, " observe d: direction(0.5, 1, 1) of b{last};");
    let _ = writeln!(text, " observe p: point(0.2, -1, 0.7) of b{last};\n}}");
    text
}

/// The largest difference that a search of as many starts finds as make the evaluations.
fn largest(chain: &Chain, id: ObservableId, domain: &Domain) -> f64 {
    let (mut starts, mut before) = (4, 0);
    loop {
        let found = search(chain, id, domain, starts, 1).unwrap();
        // Of very many errors the search itself makes fewer.
        let is_done = found.evaluations >= EVALUATIONS || found.evaluations <= before;
        if is_done || found.value == 0.0 {
            return found.value;
        }
        before = found.evaluations;
        starts = (1.05 * f64::from(starts) * EVALUATIONS as f64 / before as f64).ceil() as u32;
    }
}

/// The declaration of a claims file, which names a chain or lists a table of Denavit and Hartenberg.
fn declaration(file: &Path) -> Option<String> {
    let claims: File = toml::from_str(&std::fs::read_to_string(file).unwrap()).unwrap();
    match (&claims.dh, &claims.chain) {
        (Some(table), _) => declaration_of_dh(table.get_ref()).ok(),
        (None, Some(chain)) => std::fs::read_to_string(file.with_file_name(chain.get_ref())).ok(),
        (None, None) => None,
    }
}

/// The ratio of each observable that has a bound and can differ.
fn ratios(name: &str, chain: &Chain, domain: &Domain, all: &mut Vec<(f64, String)>) {
    for index in 0..chain.observables.len() {
        let id = ObservableId(u16::try_from(index).unwrap());
        let bound = match bound(chain, id, domain) {
            Ok(bound) => bound,
            Err(error) => {
                println!("no bound: {name} {}: {error}", chain.observable(id).name);
                continue;
            }
        };
        let found = largest(chain, id, domain);
        if found > 1e-15 && bound.value >= found {
            all.push((
                bound.value / found,
                format!("{name} {}: {:.3e}", chain.observable(id).name, bound.value),
            ));
        } else if bound.value < found * (1.0 - 1e-9) && found > 1e-13 {
            println!("ABOVE THE BOUND: {name} {} {} {found}", chain.observable(id).name, bound.value);
        }
    }
}

fn report(title: &str, all: &mut [(f64, String)]) {
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let at = |share: f64| all[((all.len() - 1) as f64 * share).round() as usize].0;
    println!(
        "{title}: {} ratios, median {:.3}, 95 % {:.3}, largest {:.3}",
        all.len(),
        at(0.5),
        at(0.95),
        at(1.0)
    );
    if std::env::args().any(|argument| argument == "--list") {
        all.iter().for_each(|(ratio, name)| println!("  {ratio:.3} {name}"));
    }
}

fn main() {
    let mut gallery = Vec::new();
    let mut files: Vec<_> =
        std::fs::read_dir("examples/gallery").unwrap().map(|file| file.unwrap().path()).collect();
    files.sort();
    for file in files.iter().filter(|file| file.extension().is_some_and(|ending| ending == "toml")) {
        let text = declaration(file).unwrap();
        let chain = Chain::symbolic_from_text(&text).unwrap();
        if chain.symbols_of(SymbolKind::Error).next().is_none() {
            println!("no errors: {}", file.display());
            continue;
        }
        let mut domain = Domain::new(&chain);
        for error in chain.symbols_of(SymbolKind::Error) {
            // A milliradian, or a millimetre.
            domain.set_size(&chain, error, 1e-3).unwrap();
        }
        for moved in chain.symbols_of(SymbolKind::Joint).chain(chain.symbols_of(SymbolKind::Input)) {
            domain.set_range(&chain, moved, 0.2, 1.2).unwrap();
        }
        ratios(&file.display().to_string(), &chain, &domain, &mut gallery);
    }
    report("gallery", &mut gallery);
    let mut random = Random(SEED);
    let mut by_size: Vec<(f64, Vec<(f64, String)>)> =
        vec![(1e-5, vec![]), (1e-2, vec![]), (0.3, vec![]), (1.5, vec![])];
    for number in 0..CHAINS {
        let text = random_chain(&mut random);
        let chain = Chain::from_text(&text).unwrap();
        let slot = random.below(by_size.len());
        let size = by_size[slot].0;
        let mut domain = Domain::new(&chain);
        for error in chain.symbols_of(SymbolKind::Error) {
            domain.set_size(&chain, error, size * random.uniform()).unwrap();
        }
        for joint in chain.symbols_of(SymbolKind::Joint) {
            let (low, width) = (6.0 * random.uniform(), 3.0 * random.uniform());
            if random.uniform() < 0.5 {
                domain.set_range(&chain, joint, low, low + width).unwrap();
            }
        }
        ratios(&format!("random {number}"), &chain, &domain, &mut by_size[slot].1);
    }
    let mut all: Vec<(f64, String)> = gallery;
    for (size, mut ratios) in by_size {
        report(&format!("random, errors up to {size}"), &mut ratios);
        all.append(&mut ratios);
    }
    report("all", &mut all);
}
