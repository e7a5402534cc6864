//! Times one pose of the generated Rust: see `src/bin/live_speed.rs`.

use std::hint::black_box;
use std::time::Instant;

mod lidar {
    include!(concat!(env!("OUT_DIR"), "/lidar.rs"));
}

const POSES: usize = 4096;
const PASSES: usize = 50;

/// Nanoseconds of one call.
fn time(mut work: impl FnMut(usize)) -> f64 {
    let start = Instant::now();
    for _ in 0..PASSES {
        (0..POSES).for_each(&mut work);
    }
    start.elapsed().as_secs_f64() * 1e9 / (PASSES * POSES) as f64
}

fn main() {
    let mut state = 7_u64;
    let mut angle = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        6.0 * (state >> 40) as f64 / (1_u64 << 24) as f64
    };
    let joints: Vec<lidar::Joints> =
        (0..POSES).map(|_| lidar::Joints { alpha: angle(), beta: angle(), gamma: angle() }).collect();
    let (correction, sure) = (lidar::ExactError::prepare(), lidar::Uncertainty::prepare());
    let correct = time(|row| {
        black_box(correction.eval(black_box(&joints[row])));
    });
    println!("1 correction: {correct:.3}");
    let both = time(|row| {
        let joints = black_box(&joints[row]);
        black_box((correction.eval(joints), sure.eval(joints)));
    });
    println!("2 correction and uncertainty: {both:.3}");
}
