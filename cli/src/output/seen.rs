//! A table or a text that is written to a terminal instead of a file: a cell commands nothing there. Whatever goes on to a file or to
//! another program stays byte by byte.

use std::io::{self, IsTerminal, Write};

use model_core::escape::Screen;

/// What is written to, and how.
pub enum Seen<W: Write> {
    /// As it is.
    AsItIs(W),
    /// With every letter seen; the bytes of a letter that has only begun wait.
    Shown(W, Vec<u8>),
}

impl<W: Write + IsTerminal> Seen<W> {
    /// Shows letters where a person looks.
    pub fn new(out: W) -> Self {
        if out.is_terminal() { Self::Shown(out, Vec::new()) } else { Self::AsItIs(out) }
    }
}

impl<W: Write> Write for Seen<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let (out, begun) = match self {
            Self::AsItIs(out) => return out.write(bytes),
            Self::Shown(out, begun) => (out, begun),
        };
        begun.extend_from_slice(bytes);
        let mut done = 0;
        for chunk in begun.utf8_chunks() {
            out.write_all(Screen::from(chunk.valid()).as_str().as_bytes())?;
            done += chunk.valid().len();
            // Up to three bytes at the end may be the start of a letter.
            let is_start = done + chunk.invalid().len() == begun.len()
                && std::str::from_utf8(chunk.invalid()).is_err_and(|error| error.error_len().is_none());
            if !is_start {
                out.write_all(chunk.invalid().escape_ascii().to_string().as_bytes())?;
                done += chunk.invalid().len();
            }
        }
        begun.drain(..done);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Self::AsItIs(out) => out.flush(),
            Self::Shown(out, begun) => {
                out.write_all(begun.escape_ascii().to_string().as_bytes())?;
                begun.clear();
                out.flush()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_are_seen_however_they_are_cut() {
        let bytes = "a,é\u{1b}]0;x\u{7}\u{202e},日\n".as_bytes();
        for cut in 1..bytes.len() {
            let mut seen = Seen::Shown(Vec::new(), Vec::new());
            for part in bytes.chunks(cut) {
                assert!(matches!(seen.write(part), Ok(length) if length == part.len()));
            }
            assert!(seen.write(b"\xff\xc3").is_ok() && seen.flush().is_ok());
            let Seen::Shown(out, _) = seen else { unreachable!("it was made so") };
            assert_eq!(
                String::from_utf8_lossy(&out),
                "a,é\\u{1b}]0;x\\u{7}\\u{202e},日\n\\xff\\xc3",
                "{cut}"
            );
        }
    }
}
