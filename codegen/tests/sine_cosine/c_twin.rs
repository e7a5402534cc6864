//! `kernel.c`, compiled and run, gives the bits of the Rust kernel.

use std::io::Write;
use std::process::{Command, Stdio};

use super::{on, paths, quadrant_edges, uniform, wide_angles};
use codegen::vector::{C, Path};

/// Reads f64s from standard input, writes sine and cosine of each on the path named by the first argument.
const MAIN: &str = r#"
#include <stdio.h>
#include <stdlib.h>

TRUEAXIS_INLINE void all(const int fused, const double *x, double *s, double *c, int n)
{
    int row;
    for (row = 0; row + TRUEAXIS_ROWS <= n; row += TRUEAXIS_ROWS)
        trueaxis_sin_cos_rows(fused, x + row, s + row, c + row);
}

static void portable(const double *x, double *s, double *c, int n) { all(0, x, s, c, n); }
#ifdef TRUEAXIS_HAS_PATHS
TRUEAXIS_TARGET_V3 static void v3(const double *x, double *s, double *c, int n) { all(1, x, s, c, n); }
TRUEAXIS_TARGET_V4 static void v4(const double *x, double *s, double *c, int n) { all(1, x, s, c, n); }
#endif

int main(int count, char **arguments)
{
    static double x[1 << 16], s[1 << 16], c[1 << 16];
    const int path = count > 1 ? atoi(arguments[1]) : 0;
    const int n = (int)fread(x, sizeof(double), 1 << 16, stdin);
    if (path == TRUEAXIS_PORTABLE)
        portable(x, s, c, n);
#ifdef TRUEAXIS_HAS_PATHS
    else if (path == TRUEAXIS_V3)
        v3(x, s, c, n);
    else
        v4(x, s, c, n);
#endif
    fwrite(s, sizeof(double), (size_t)n, stdout);
    fwrite(c, sizeof(double), (size_t)n, stdout);
    return 0;
}
"#;

fn compiled() -> std::path::PathBuf {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
    let (source, program) = (folder.join("sine_cosine.c"), folder.join("sine_cosine"));
    std::fs::write(&source, format!("{C}\n{MAIN}")).unwrap();
    let done = Command::new("cc")
        .args(["-std=c99", "-O2", "-ffp-contract=off", "-Wall", "-Wextra", "-Werror", "-o"])
        .arg(&program)
        .arg(&source)
        .status()
        .unwrap();
    assert!(done.success());
    program
}

#[test]
fn validate_the_same_bits_as_in_rust() {
    let program = compiled();
    let mut x = uniform(21, 10.0, 6400);
    x.extend(uniform(22, 1e6, 6400));
    x.extend(quadrant_edges(23, 640));
    x.extend(wide_angles(24, 640));
    x.extend([f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0, -0.0, f64::MIN_POSITIVE, 1e-310]);
    x.resize(x.len().next_multiple_of(64), 0.25);
    for path in paths() {
        let number = match path {
            Path::Portable => "0",
            Path::V3 => "1",
            Path::V4 => "2",
        };
        let mut child =
            Command::new(&program).arg(number).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
        let bytes: Vec<u8> = x.iter().flat_map(|x| x.to_le_bytes()).collect();
        child.stdin.take().unwrap().write_all(&bytes).unwrap();
        let output = child.wait_with_output().unwrap().stdout;
        let words: Vec<f64> =
            output.as_chunks::<8>().0.iter().map(|&bytes| f64::from_le_bytes(bytes)).collect();
        let (sines, cosines) = words.split_at(x.len());
        for ((x, found), expected) in x.iter().zip(sines.iter().zip(cosines)).zip(on(path, &x)) {
            let same = |a: f64, b: f64| a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan());
            let agrees = same(*found.0, expected.0) && same(*found.1, expected.1);
            assert!(agrees, "{path:?}, {x:?}: C {found:?}, Rust {expected:?}");
        }
    }
}
