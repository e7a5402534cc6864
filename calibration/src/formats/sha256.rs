//! SHA-256, by which a report names the very files that it was made from.
//!
//! Source: NIST, FIPS PUB 180-4, "Secure Hash Standard" (2015), sections 4.1.2, 5 and 6.2.

use std::io::{self, Read};

/// Bytes read at a time: a multiple of a block's 64.
const AT_ONCE: usize = 1 << 16;

/// The digest of everything that is to be read, as 64 hexadecimal digits.
///
/// # Errors
/// It cannot be read.
pub fn hex(mut from: impl Read) -> io::Result<String> {
    let mut state = FIRST;
    let mut read = vec![0; AT_ONCE];
    let mut length = 0_u64;
    loop {
        let mut filled = 0;
        while filled < read.len() {
            match from.read(&mut read[filled..]) {
                Ok(0) => break,
                Ok(count) => filled += count,
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
        length += filled as u64;
        let mut blocks = read[..filled].chunks_exact(64);
        blocks.by_ref().for_each(|block| compress(&mut state, block));
        if filled == read.len() {
            continue;
        }
        let mut last = blocks.remainder().to_vec();
        last.push(0x80);
        while last.len() % 64 != 56 {
            last.push(0);
        }
        last.extend((length * 8).to_be_bytes());
        last.chunks_exact(64).for_each(|block| compress(&mut state, block));
        return Ok(state.iter().map(|word| format!("{word:08x}")).collect());
    }
}

/// The first 32 bits of the fractional parts of the square roots of the first eight primes.
const FIRST: [u32; 8] =
    [0x6a09_e667, 0xbb67_ae85, 0x3c6e_f372, 0xa54f_f53a, 0x510e_527f, 0x9b05_688c, 0x1f83_d9ab, 0x5be0_cd19];

/// The first 32 bits of the fractional parts of the cube roots of the first 64 primes.
#[rustfmt::skip]
const ROUND: [u32; 64] = [
    0x428a_2f98, 0x7137_4491, 0xb5c0_fbcf, 0xe9b5_dba5, 0x3956_c25b, 0x59f1_11f1, 0x923f_82a4, 0xab1c_5ed5,
    0xd807_aa98, 0x1283_5b01, 0x2431_85be, 0x550c_7dc3, 0x72be_5d74, 0x80de_b1fe, 0x9bdc_06a7, 0xc19b_f174,
    0xe49b_69c1, 0xefbe_4786, 0x0fc1_9dc6, 0x240c_a1cc, 0x2de9_2c6f, 0x4a74_84aa, 0x5cb0_a9dc, 0x76f9_88da,
    0x983e_5152, 0xa831_c66d, 0xb003_27c8, 0xbf59_7fc7, 0xc6e0_0bf3, 0xd5a7_9147, 0x06ca_6351, 0x1429_2967,
    0x27b7_0a85, 0x2e1b_2138, 0x4d2c_6dfc, 0x5338_0d13, 0x650a_7354, 0x766a_0abb, 0x81c2_c92e, 0x9272_2c85,
    0xa2bf_e8a1, 0xa81a_664b, 0xc24b_8b70, 0xc76c_51a3, 0xd192_e819, 0xd699_0624, 0xf40e_3585, 0x106a_a070,
    0x19a4_c116, 0x1e37_6c08, 0x2748_774c, 0x34b0_bcb5, 0x391c_0cb3, 0x4ed8_aa4a, 0x5b9c_ca4f, 0x682e_6ff3,
    0x748f_82ee, 0x78a5_636f, 0x84c8_7814, 0x8cc7_0208, 0x90be_fffa, 0xa450_6ceb, 0xbef9_a3f7, 0xc671_78f2,
];

/// One round, in which nothing moves but the two words that change: the letters are passed in turn.
macro_rules! round {
    ($a:ident $b:ident $c:ident $d:ident $e:ident $f:ident $g:ident $h:ident, $k:expr, $w:expr) => {
        let s1 = $e.rotate_right(6) ^ $e.rotate_right(11) ^ $e.rotate_right(25);
        let t1 = $h.wrapping_add(s1).wrapping_add($e & $f ^ !$e & $g).wrapping_add($k).wrapping_add($w);
        let s0 = $a.rotate_right(2) ^ $a.rotate_right(13) ^ $a.rotate_right(22);
        $d = $d.wrapping_add(t1);
        $h = t1.wrapping_add(s0.wrapping_add($a & $b ^ $a & $c ^ $b & $c));
    };
}

fn compress(state: &mut [u32; 8], block: &[u8]) {
    let mut w = [0_u32; 64];
    for (word, bytes) in w.iter_mut().zip(block.chunks_exact(4)) {
        *word = u32::from_be_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
    }
    for t in 16..64 {
        let s0 = w[t - 15].rotate_right(7) ^ w[t - 15].rotate_right(18) ^ w[t - 15] >> 3;
        let s1 = w[t - 2].rotate_right(17) ^ w[t - 2].rotate_right(19) ^ w[t - 2] >> 10;
        w[t] = w[t - 16].wrapping_add(s0).wrapping_add(w[t - 7]).wrapping_add(s1);
    }
    let [mut a, mut b, mut c, mut d, mut e, mut f, mut g, mut h] = *state;
    let ((w, _), (k, _)) = (w.as_chunks::<8>(), ROUND.as_chunks::<8>());
    for (w, k) in w.iter().zip(k) {
        round!(a b c d e f g h, k[0], w[0]);
        round!(h a b c d e f g, k[1], w[1]);
        round!(g h a b c d e f, k[2], w[2]);
        round!(f g h a b c d e, k[3], w[3]);
        round!(e f g h a b c d, k[4], w[4]);
        round!(d e f g h a b c, k[5], w[5]);
        round!(c d e f g h a b, k[6], w[6]);
        round!(b c d e f g h a, k[7], w[7]);
    }
    for (word, new) in state.iter_mut().zip([a, b, c, d, e, f, g, h]) {
        *word = word.wrapping_add(new);
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::hex;

    /// The examples of FIPS 180 (one block, two blocks), the empty text, and a million letters.
    #[test]
    fn the_standards_examples_hold() {
        for (text, digest) in [
            (String::new(), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"),
            ("abc".to_owned(), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"),
            (
                "abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq".to_owned(),
                "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1",
            ),
            ("a".repeat(1_000_000), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0"),
        ] {
            assert_eq!(hex(text.as_bytes()).unwrap(), digest);
        }
    }
}
