//! What the first bytes say of a file that is no text: compressed, or of another format.

/// The bytes that files begin with, what they are then, and what to do.
const KINDS: [(&[u8], &str); 6] = [
    (b"\x1F\x8B", "this is compressed with gzip: unpack it first, with `gunzip`"),
    (b"\x28\xB5\x2F\xFD", "this is compressed with zstd: unpack it first, with `unzstd`"),
    (b"\xFD7zXZ\0", "this is compressed with xz: unpack it first, with `unxz`"),
    (b"BZh91AY&SY", "this is compressed with bzip2: unpack it first, with `bunzip2`"),
    (b"PK\x03\x04", "this is a ZIP archive, or a spreadsheet: unpack it, or save the table as .csv"),
    (b"PAR1\x15", "this is a Parquet file: give it as a file whose name ends in .parquet"),
];

/// What a file that begins so is, and what to do, where that is no text.
pub(super) fn no_text(head: &[u8]) -> Option<&'static str> {
    KINDS.into_iter().find(|(first, _)| head.starts_with(first)).map(|(_, what)| what)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_none_of_these() {
        for text in ["azimuth,elevation\n", "PK,BZh,PAR1\n", "", "# PAR1\n"] {
            assert_eq!(no_text(text.as_bytes()), None, "{text}");
        }
        assert!(no_text(b"\x1F\x8B\x08\0").is_some_and(|what| what.contains("gunzip")));
    }
}
