//! SHA-256, by which a report names the very files that it was made from.

use std::io::{self, Read};

use sha2::{Digest, Sha256};

/// Bytes read at a time.
const AT_ONCE: usize = 1 << 16;

/// The digest of everything that is to be read, as 64 hexadecimal digits.
///
/// # Errors
/// It cannot be read.
pub fn hex(mut from: impl Read) -> io::Result<String> {
    let mut digest = Sha256::new();
    let mut read = vec![0; AT_ONCE];
    loop {
        match from.read(&mut read) {
            Ok(0) => return Ok(digest.finalize().iter().map(|byte| format!("{byte:02x}")).collect()),
            Ok(count) => digest.update(&read[..count]),
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
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
