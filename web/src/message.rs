//! What goes between a page and its module: parts with names, each as long as it says.
//!
//! A part is the length of its name, its name in UTF-8, the length of its content, and its content. Lengths are 4 bytes, the lowest first.

/// Parts with names, in order.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Message {
    parts: Vec<(String, Vec<u8>)>,
}

/// Why a message cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Broken {
    /// Its bytes end within a part, or a name is no text.
    #[error("the message to the module is damaged at byte {at}: reload the page")]
    Damaged {
        /// Where.
        at: usize,
    },
    /// A part is not there.
    #[error("the message to the module has no `{name}`: reload the page")]
    Missing {
        /// Which.
        name: String,
    },
    /// A text is none.
    #[error("{name}: byte {at} is no text in UTF-8: save the file as UTF-8, or choose another")]
    NotText {
        /// What is no text.
        name: String,
        /// Where it stops to be one.
        at: usize,
    },
}

impl Message {
    /// Takes bytes apart.
    ///
    /// # Errors
    /// They are damaged.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, Broken> {
        let mut parts = Vec::new();
        let mut rest = bytes;
        while !rest.is_empty() {
            let damaged = Broken::Damaged { at: bytes.len() - rest.len() };
            let part = piece(rest).and_then(|(name, behind)| {
                let (content, behind) = piece(behind)?;
                Some((String::from_utf8(name.to_vec()).ok()?, content.to_vec(), behind))
            });
            let (name, content, behind) = part.ok_or(damaged)?;
            parts.push((name, content));
            rest = behind;
        }
        Ok(Self { parts })
    }

    /// The message as bytes.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        for piece in self.parts.iter().flat_map(|(name, content)| [name.as_bytes(), content]) {
            // A browser's memory ends before this does.
            bytes.extend_from_slice(&u32::try_from(piece.len()).unwrap_or(u32::MAX).to_le_bytes());
            bytes.extend_from_slice(piece);
        }
        bytes
    }

    /// The message with one more part.
    #[must_use]
    pub fn with(mut self, name: &str, content: impl Into<Vec<u8>>) -> Self {
        self.parts.push((name.to_owned(), content.into()));
        self
    }

    /// A part, if it is there.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<&[u8]> {
        self.parts.iter().find(|(own, _)| own == name).map(|(_, content)| content.as_slice())
    }

    /// A part.
    ///
    /// # Errors
    /// It is not there.
    pub fn bytes(&self, name: &str) -> Result<&[u8], Broken> {
        self.find(name).ok_or_else(|| Broken::Missing { name: name.to_owned() })
    }

    /// A part that is a text.
    ///
    /// # Errors
    /// It is not there, or none.
    pub fn text(&self, name: &str) -> Result<&str, Broken> {
        std::str::from_utf8(self.bytes(name)?)
            .map_err(|error| Broken::NotText { name: name.to_owned(), at: error.valid_up_to() })
    }

    /// The parts whose names begin with something, each by the rest of its name.
    pub fn beginning<'m>(&'m self, with: &'m str) -> impl Iterator<Item = (&'m str, &'m [u8])> {
        self.parts
            .iter()
            .filter_map(move |(name, content)| Some((name.strip_prefix(with)?, content.as_slice())))
    }
}

/// The first piece of some bytes, and what is behind it.
fn piece(bytes: &[u8]) -> Option<(&[u8], &[u8])> {
    let (length, behind) = bytes.split_first_chunk()?;
    behind.split_at_checked(usize::try_from(u32::from_le_bytes(*length)).ok()?)
}
