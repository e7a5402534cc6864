//! Who takes part, the rounds, and the table.

use crate::candidates::{self, Buffers};
use crate::check;
use crate::floors::Width;
use crate::lidar::{Path, path_taken};
use crate::threads;

const POSES: usize = 1_000_000 / 64 * 64;
const ROUNDS: usize = 25;

/// Something that is timed.
pub struct Candidate {
    /// Which form it computes.
    pub form: &'static str,
    /// What it is called in the table.
    pub name: String,
    /// Does all poses once.
    pub run: Box<dyn FnMut(&mut Buffers)>,
}

/// Takes the measurements and prints them.
pub fn run() {
    let mut state = 1;
    let joints = [(); 3].map(|()| (0..POSES).map(|_| random_angle(&mut state)).collect());
    let mut buffers = Buffers { joints, out: [(); 6].map(|()| vec![0.0; POSES]) };

    check::check(&mut buffers);
    let mut candidates = candidates::all();
    let mut best = vec![f64::INFINITY; candidates.len()];
    for _ in 0..ROUNDS {
        for (candidate, best) in candidates.iter_mut().zip(&mut best) {
            let start = processor_ns();
            (candidate.run)(&mut buffers);
            *best = best.min((processor_ns() - start) / POSES as f64);
        }
    }

    println!("path taken here: {:?}; floors on {:?}", path_taken(), Width::here());
    println!("{:22} {:28} {:>9} {:>8}", "form", "candidate", "ns a row", "/ floor");
    for (candidate, time) in candidates.iter().zip(&best) {
        let floor = candidates
            .iter()
            .zip(&best)
            .find(|(other, _)| other.form == candidate.form && other.name == floor_of(&candidate.name))
            .map(|(_, floor)| format!("{:8.3}", time / floor));
        println!("{:22} {:28} {time:9.2} {}", candidate.form, candidate.name, floor.unwrap_or_default());
    }
    drop(candidates);
    threads::run(&mut buffers);
}

/// Nanoseconds that this thread has spent on a processor, so that other programs' turns do not count.
#[cfg(target_os = "linux")]
#[allow(unsafe_code, reason = "the standard library does not know this clock")]
pub fn processor_ns() -> f64 {
    #[repr(C)]
    struct Time {
        seconds: i64,
        nanoseconds: i64,
    }
    unsafe extern "C" {
        fn clock_gettime(clock: i32, time: *mut Time) -> i32;
    }
    const THREAD_PROCESSOR_TIME: i32 = 3;
    let mut time = Time { seconds: 0, nanoseconds: 0 };
    // SAFETY: on 64-bit Linux a timespec is two 64-bit words, and the call fills them in or leaves them.
    let failed = unsafe { clock_gettime(THREAD_PROCESSOR_TIME, &mut time) };
    assert_eq!(failed, 0, "the system has no clock of a thread's processor time");
    time.seconds as f64 * 1e9 + time.nanoseconds as f64
}

/// Nanoseconds of the clock.
#[cfg(not(target_os = "linux"))]
pub fn processor_ns() -> f64 {
    use std::{sync::OnceLock, time::Instant};
    static START: OnceLock<Instant> = OnceLock::new();
    START.get_or_init(Instant::now).elapsed().as_secs_f64() * 1e9
}

/// An angle of one turn, by SplitMix64. Source: Steele, Lea, Flood, OOPSLA 2014.
fn random_angle(state: &mut u64) -> f64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (*state ^ (*state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    let unit = ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0;
    unit * std::f64::consts::PI
}

/// The floor that a candidate is held against.
fn floor_of(name: &str) -> &'static str {
    if name.contains("v3") { "floor AVX2" } else { "floor AVX-512" }
}

/// Whether a path can be measured here.
pub fn has(path: Path) -> bool {
    path <= path_taken()
}
