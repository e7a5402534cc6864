//! A fingerprint of numbers: which pass a sum belongs to.

/// A number that is the same for the same numbers, and hardly for others.
///
/// Source: G. Fowler, L. C. Noll, K.-P. Vo, FNV-1a with 64 bits, IETF draft-eastlake-fnv.
pub(super) fn fingerprint(numbers: impl IntoIterator<Item = u64>) -> u64 {
    numbers.into_iter().flat_map(u64::to_le_bytes).fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}
