// The paths of the vector code: which instructions it may use, and how a processor is asked for them.
//
// Part of the text that goes unchanged into generated files, as are `kernel.rs` and `wide.rs`: nothing but `core`.

/// Which instructions vector code runs on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Path {
    /// What every processor of the target has; a·b + c is rounded twice.
    Portable,
    /// x86-64-v3: AVX2 and FMA.
    V3,
    /// x86-64-v4: AVX-512 F, BW, CD, DQ and VL, and FMA.
    V4,
}

/// How a·b + c is computed: the only thing in which the paths differ in value.
pub trait Arithmetic: Copy {
    /// Whether a·b + c is rounded once.
    const FUSED: bool;

    /// a·b + c.
    fn mul_add(self, a: f64, b: f64, c: f64) -> f64;
}

/// Product and sum rounded one after the other; right on every processor.
#[derive(Debug, Clone, Copy)]
pub struct Portable;

impl Arithmetic for Portable {
    const FUSED: bool = false;

    #[inline(always)]
    fn mul_add(self, a: f64, b: f64, c: f64) -> f64 {
        a * b + c
    }
}

/// Product and sum rounded once, by the processor's own instruction. Its field is private: [`run`] alone makes one,
/// after the processor has said that it has FMA.
#[cfg(target_arch = "x86_64")]
#[derive(Debug, Clone, Copy)]
pub struct Fused(());

#[cfg(target_arch = "x86_64")]
impl Arithmetic for Fused {
    const FUSED: bool = true;

    #[inline(always)]
    fn mul_add(self, a: f64, b: f64, c: f64) -> f64 {
        use core::arch::x86_64::{_mm_cvtsd_f64, _mm_fmadd_sd, _mm_set_sd};
        // SAFETY: a `Fused` exists only where the processor has FMA.
        unsafe { _mm_cvtsd_f64(_mm_fmadd_sd(_mm_set_sd(a), _mm_set_sd(b), _mm_set_sd(c))) }
    }
}

/// Work on slices that is compiled once for every path.
pub trait Work {
    /// Does it. Implementations are `#[inline(always)]`, so that they are compiled with the path's instructions.
    fn run<A: Arithmetic>(self, arithmetic: A);
}

/// The best path of this processor, asked once.
#[cfg(target_arch = "x86_64")]
#[must_use]
pub fn path() -> Path {
    use core::sync::atomic::{AtomicU8, Ordering};
    // Threads that meet here at once find the same answer.
    static FOUND: AtomicU8 = AtomicU8::new(0);
    match FOUND.load(Ordering::Relaxed) {
        1 => Path::Portable,
        2 => Path::V3,
        3 => Path::V4,
        _ => {
            let path = ask_processor();
            let code = match path {
                Path::Portable => 1,
                Path::V3 => 2,
                Path::V4 => 3,
            };
            FOUND.store(code, Ordering::Relaxed);
            path
        }
    }
}

/// The best path of this processor.
#[cfg(not(target_arch = "x86_64"))]
#[must_use]
pub fn path() -> Path {
    Path::Portable
}

/// Reads the processor's feature words. Source: Intel 64 Software Developer's Manual, volume 2, CPUID, and
/// volume 1, 13.3 and 15.2 (the operating system must save the wide registers too).
#[cfg(target_arch = "x86_64")]
#[allow(unused_unsafe, reason = "reading the feature words is safe from some compiler version on")]
fn ask_processor() -> Path {
    use core::arch::x86_64::{__cpuid, __cpuid_count, _xgetbv};
    #[target_feature(enable = "xsave")]
    fn saved_registers() -> u64 {
        // SAFETY: `xsave` is enabled here, and register 0 exists wherever it is.
        unsafe { _xgetbv(0) }
    }
    let all = |word: u32, bits: &[u32]| bits.iter().all(|bit| word >> bit & 1 == 1);
    // SAFETY: every x86-64 processor has CPUID; leaf 7 is read only where leaf 0 says that it exists.
    let (last, basic) = unsafe { (__cpuid(0).eax, __cpuid(1).ecx) };
    // FMA, OSXSAVE, AVX.
    if last < 7 || !all(basic, &[12, 27, 28]) {
        return Path::Portable;
    }
    // SAFETY: as above.
    let extended = unsafe { __cpuid_count(7, 0).ebx };
    // SAFETY: OSXSAVE says that XGETBV may be executed.
    let saved = unsafe { saved_registers() };
    // AVX2; then AVX-512 F, DQ, CD, BW, VL.
    if saved & 0x06 != 0x06 || !all(extended, &[5]) {
        Path::Portable
    } else if saved & 0xe6 == 0xe6 && all(extended, &[16, 17, 28, 30, 31]) {
        Path::V4
    } else {
        Path::V3
    }
}

/// Runs the work on the wanted path, or on the best one that this processor has if that is less.
#[inline]
pub fn run(wanted: Path, work: impl Work) {
    #[cfg(target_arch = "x86_64")]
    {
        #[target_feature(enable = "avx2,fma")]
        fn v3(work: impl Work, fused: Fused) {
            work.run(fused);
        }
        #[target_feature(enable = "avx512f,avx512bw,avx512cd,avx512dq,avx512vl,avx2,fma")]
        fn v4(work: impl Work, fused: Fused) {
            work.run(fused);
        }
        match wanted.min(path()) {
            Path::Portable => work.run(Portable),
            // SAFETY: `path` has found AVX2 and FMA.
            Path::V3 => unsafe { v3(work, Fused(())) },
            // SAFETY: `path` has found the AVX-512 parts named above, AVX2 and FMA.
            Path::V4 => unsafe { v4(work, Fused(())) },
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    {
        let _ = wanted;
        work.run(Portable);
    }
}
